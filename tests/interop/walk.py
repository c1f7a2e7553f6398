#!/usr/bin/env python3
"""asyncua reads the whole address space of a server into a file: one line of JSON a node, in no order.

    {"id": "ns=1;i=5", "class": "Variable", "name": "1:Name", "data_type": "i=11", "rank": -1, "value": "Double",
     "references": [["i=40", true, "i=63"], …]}

A reference is its type, whether it is forward, and the other node. `value` is the type of the value, or its bad status.
A node that references lead to and that cannot be read has {"id": …, "error": status}. Exit code 3: asyncua is missing.
"""

import argparse
import asyncio
import json
import sys

try:
    from asyncua import Client, ua
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)

BATCH = 200
ATTRIBUTES = [ua.AttributeIds.NodeClass, ua.AttributeIds.BrowseName, ua.AttributeIds.DataType]
ATTRIBUTES += [ua.AttributeIds.ValueRank, ua.AttributeIds.Value]


async def references(client, nodes):
    """Every reference of each node."""
    parameters = ua.BrowseParameters()
    parameters.View.Timestamp = ua.get_win_epoch()
    parameters.RequestedMaxReferencesPerNode = 500
    for node in nodes:
        description = ua.BrowseDescription()
        description.NodeId = node
        description.BrowseDirection = ua.BrowseDirection.Both
        description.IncludeSubtypes = True
        description.ReferenceTypeId = ua.NodeId()
        description.ResultMask = ua.BrowseResultMask.All
        parameters.NodesToBrowse.append(description)
    results = await client.uaclient.browse(parameters)
    found = []
    for result in results:
        of_node = list(result.References or [])
        while result.ContinuationPoint:
            following = ua.BrowseNextParameters()
            following.ContinuationPoints = [result.ContinuationPoint]
            (result,) = await client.uaclient.browse_next(following)
            of_node += result.References or []
        found.append(of_node)
    return found


def description(node, values):
    kind, name, data_type, rank, value = values
    if not kind.StatusCode.is_good():
        return {"id": node.to_string(), "error": kind.StatusCode.name}
    told = {"id": node.to_string(), "class": ua.NodeClass(kind.Value.Value).name.rstrip("_")}
    told["name"] = f"{name.Value.Value.NamespaceIndex}:{name.Value.Value.Name}"
    if data_type.StatusCode.is_good():
        told["data_type"] = data_type.Value.Value.to_string()
        told["rank"] = int(rank.Value.Value)
    if told["class"] == "Variable":
        good = value.StatusCode.is_good()
        told["value"] = value.Value.VariantType.name if good else value.StatusCode.name
    return told


async def walk(url, output):
    known = {ua.NodeId(84)}
    waiting = list(known)
    async with Client(url, timeout=60) as client:
        with open(output, "w", encoding="utf-8") as file:
            while waiting:
                batch, waiting = waiting[:BATCH], waiting[BATCH:]
                found = await references(client, batch)
                reads = ua.ReadParameters()
                for node in batch:
                    for attribute in ATTRIBUTES:
                        reads.NodesToRead.append(ua.ReadValueId(node, attribute))
                values = await client.uaclient.read(reads)
                for at, (node, of_node) in enumerate(zip(batch, found)):
                    of_attributes = values[at * len(ATTRIBUTES) : (at + 1) * len(ATTRIBUTES)]
                    told = description(node, of_attributes)
                    told["references"] = [
                        [r.ReferenceTypeId.to_string(), r.IsForward, r.NodeId.to_string()] for r in of_node
                    ]
                    file.write(json.dumps(told) + "\n")
                    for reference in of_node:
                        for other in (reference.ReferenceTypeId, reference.NodeId):
                            other = ua.NodeId(other.Identifier, other.NamespaceIndex)
                            if other not in known:
                                known.add(other)
                                waiting.append(other)
    return {"ok": True, "nodes": len(known)}


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--url")
parser.add_argument("--output")
arguments = parser.parse_args()
print(json.dumps(asyncio.run(walk(arguments.url, arguments.output))))
