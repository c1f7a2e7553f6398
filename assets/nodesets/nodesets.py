#!/usr/bin/env python3
"""Reduces the published NodeSets of the OPC Foundation to the facts the virtual controller serves.

    nodesets.py FOLDER           writes di.json and robotics.json beside this script
    nodesets.py --check FOLDER   exits with 1 if they differ from what FOLDER gives

FOLDER holds Opc.Ua.Di.NodeSet2.xml and Opc.Ua.Robotics.NodeSet2.xml: the folder `nodesets` of the npm package
`node-opcua-nodesets` in the version that README.md names.

What is kept: every node but those of the deprecated type dictionaries, with its id, class, BrowseName, DisplayName where
it differs, the attributes of its class, its value, and every reference once, as a forward reference. What is left out:
descriptions, documentation links, and the dictionaries (OPC 10000-5 annex D), whose facts are in the definitions.
A node is `MODEL:NUMBER`; the models are `ua`, `di` and `robotics`.
"""

import argparse
import json
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

NODESET = "{http://opcfoundation.org/UA/2011/03/UANodeSet.xsd}"
TYPES = "{http://opcfoundation.org/UA/2008/02/Types.xsd}"
MODELS = {
    "http://opcfoundation.org/UA/": "ua",
    "http://opcfoundation.org/UA/DI/": "di",
    "http://opcfoundation.org/UA/Robotics/": "robotics",
}
FILES = {"di": "Opc.Ua.Di.NodeSet2.xml", "robotics": "Opc.Ua.Robotics.NodeSet2.xml"}
HAS_DESCRIPTION, HAS_TYPE_DEFINITION = "ua:39", "ua:40"
DICTIONARY_TYPES = {"ua:69", "ua:72"}  # DataTypeDescriptionType, DataTypeDictionaryType


class NodeSet:
    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        uris = ["http://opcfoundation.org/UA/"] + [uri.text for uri in root.find(NODESET + "NamespaceUris")]
        self.models = [MODELS[uri] for uri in uris]
        self.aliases = {alias.get("Alias"): alias.text for alias in root.find(NODESET + "Aliases")}
        model = root.find(NODESET + "Models")[0]
        self.header = {
            "namespace": model.get("ModelUri"),
            "version": model.get("Version"),
            "publication_date": model.get("PublicationDate"),
        }
        self.nodes = {}
        self.references = set()
        for element in root:
            if element.get("NodeId"):
                self.add(element)
        self.drop_dictionaries()

    def id(self, text):
        text = self.aliases.get(text, text)
        namespace, _, number = text.rpartition(";")
        index = int(namespace.removeprefix("ns=") or 0)
        return f"{self.models[index]}:{int(number.removeprefix('i='))}"

    def name(self, text):
        index, _, name = text.partition(":") if text[:1].isdigit() and text[1:2] == ":" else ("0", ":", text)
        return f"{self.models[int(index)]}:{name}"

    def add(self, element):
        id = self.id(element.get("NodeId"))
        node = {"id": id, "class": element.tag.removeprefix(NODESET + "UA"), "name": self.name(element.get("BrowseName"))}
        display = element.findtext(NODESET + "DisplayName")
        if display != node["name"].partition(":")[2]:
            node["display"] = display
        for flag in ("IsAbstract", "Symmetric"):
            if element.get(flag) == "true":
                node[flag.removeprefix("Is").lower()] = True
        inverse = element.findtext(NODESET + "InverseName")
        if inverse:
            node["inverse"] = inverse
        if node["class"].startswith("Variable"):
            node["data_type"] = self.id(element.get("DataType", "i=24"))
            if element.get("ValueRank"):
                node["rank"] = int(element.get("ValueRank"))
            if element.get("ArrayDimensions"):
                node["dimensions"] = [int(length) for length in element.get("ArrayDimensions").split(",")]
            value = element.find(NODESET + "Value")
            if value is not None:
                node["value"] = self.value(value[0])
        definition = element.find(NODESET + "Definition")
        if definition is not None:
            node["definition"] = [self.field(field) for field in definition]
        self.nodes[id] = node
        for reference in element.iter(NODESET + "Reference"):
            other = self.id(reference.text)
            ends = (other, id) if reference.get("IsForward") == "false" else (id, other)
            self.references.add((ends[0], self.id(reference.get("ReferenceType")), ends[1]))

    def field(self, field):
        fact = {"name": field.get("Name")}
        if field.get("Value") is not None:
            fact["value"] = int(field.get("Value"))
        else:
            fact["data_type"] = self.id(field.get("DataType"))
            fact["rank"] = int(field.get("ValueRank", -1))
        return fact

    def value(self, element):
        kind = element.tag.removeprefix(TYPES)
        if kind.startswith("ListOf"):
            return {"type": kind.removeprefix("ListOf"), "list": [self.scalar(item) for item in element]}
        return {"type": kind, "scalar": self.scalar(element)}

    def scalar(self, element):
        kind = element.tag.removeprefix(TYPES)
        text = (element.text or "").strip()
        if kind in ("Boolean",):
            return text == "true"
        if kind in ("Int32", "UInt32"):
            return int(text)
        if kind in ("String", "DateTime", "ByteString"):
            return text
        if kind == "LocalizedText":
            return (element.findtext(TYPES + "Text") or "").strip()
        if kind == "QualifiedName":
            index = int(element.findtext(TYPES + "NamespaceIndex") or 0)
            return f"{self.models[index]}:{element.findtext(TYPES + 'Name')}"
        if kind == "ExtensionObject":
            argument = element.find(TYPES + "Body").find(TYPES + "Argument")
            return {
                "name": argument.findtext(TYPES + "Name"),
                "data_type": self.id(argument.find(TYPES + "DataType").findtext(TYPES + "Identifier")),
                "rank": int(argument.findtext(TYPES + "ValueRank")),
            }
        raise ValueError(f"a value of the type {kind}")

    def drop_dictionaries(self):
        dropped = {
            source for source, kind, target in self.references if kind == HAS_TYPE_DEFINITION and target in DICTIONARY_TYPES
        }
        # Their properties, and the properties' properties.
        while True:
            below = {target for source, _, target in self.references if source in dropped and target in self.nodes}
            below = {id for id in below - dropped if self.nodes[id]["class"] == "Variable"}
            if not below:
                break
            dropped |= below
        self.nodes = {id: node for id, node in self.nodes.items() if id not in dropped}
        self.references = {
            reference
            for reference in self.references
            if reference[1] != HAS_DESCRIPTION and reference[0] not in dropped and reference[2] not in dropped
        }

    def text(self):
        def number(id):
            return (id.partition(":")[0], int(id.partition(":")[2]))

        def line(value):
            return json.dumps(value, ensure_ascii=False, separators=(",", ":"))

        header = ",\n".join(f'"{key}":{line(value)}' for key, value in self.header.items())
        nodes = ",\n".join(line(self.nodes[id]) for id in sorted(self.nodes, key=number))
        references = ",\n".join(
            line(reference) for reference in sorted(self.references, key=lambda ends: [number(id) for id in ends])
        )
        return f'{{\n{header},\n"nodes":[\n{nodes}\n],\n"references":[\n{references}\n]\n}}\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    for model, file in FILES.items():
        text = NodeSet(arguments.folder / file).text()
        path = Path(__file__).parent / f"{model}.json"
        if not arguments.check:
            path.write_text(text, encoding="utf-8")
        elif path.read_text(encoding="utf-8") != text:
            sys.exit(f"{path.name} is not what {file} gives: run nodesets.py without --check")


main()
