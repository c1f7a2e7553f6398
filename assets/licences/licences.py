#!/usr/bin/env python3
"""Makes licences.json, the licences of everything linked into the program. See README.md beside this file."""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
OUTPUT = HERE / "licences.json"
TARGETS = ["x86_64-unknown-linux-gnu", "aarch64-unknown-linux-gnu", "x86_64-pc-windows-gnu"]


def linked_crates(edges):
    """Name, version and licence expression of every crate that cargo tree names, this program left out."""
    crates = set()
    for target in TARGETS:
        command = ["cargo", "tree", "--locked", "--target", target, "-e", edges, "--prefix", "none", "--no-dedupe"]
        command += ["--format", "{p}|{l}"]
        tree = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for line in tree.splitlines():
            if "|" not in line:
                continue
            package, licence = line.split("|")
            name, version = package.split()[:2]
            if name != "opcua-configurator":
                crates.add((name, version.removeprefix("v"), licence.removesuffix(" (*)")))
    return crates


def others():
    """What is linked in besides crates: name, version, licence, text."""
    mit = (ROOT / "LICENSE-MIT").read_text(encoding="utf-8")
    apache = (ROOT / "LICENSE-APACHE").read_text(encoding="utf-8")
    font = (ROOT / "assets/fonts/OFL.txt").read_text(encoding="utf-8")
    node_sets = (ROOT / "assets/nodesets/LICENSE.txt").read_text(encoding="utf-8")
    for face in ("JP", "SC"):
        yield f"Noto Sans CJK {face} (subset)", "2.004", "OFL-1.1", [font]
    yield "OPC UA Devices NodeSet", "1.04.0", "MIT", [node_sets]
    yield "OPC UA Robotics NodeSet", "1.01.2", "MIT", [node_sets]
    rust = "Copyright (c) The Rust Project Contributors\n\n" + mit.split("\n\n", 2)[2]
    yield "Rust standard library", "", "MIT OR Apache-2.0", [rust, apache]


def make():
    with tempfile.TemporaryDirectory() as folder:
        found = Path(folder) / "about.json"
        subprocess.run(
            ["cargo", "about", "generate", "--locked", "--format", "json", "-c", HERE / "about.toml", "-o", found],
            cwd=ROOT,
            check=True,
        )
        return reduce(json.loads(found.read_text(encoding="utf-8")))


def reduce(about):
    """Each text once, and for each crate the numbers of its texts."""
    texts, components = [], {}

    def number(text):
        text = "\n".join(line.rstrip() for line in text.replace("\r\n", "\n").strip("\n").split("\n"))
        if text not in texts:
            texts.append(text)
        return texts.index(text)

    expressions = {(name, version): licence for name, version, licence in linked_crates("normal")}
    for licence in about["licenses"]:
        for user in licence["used_by"]:
            key = (user["crate"]["name"], user["crate"]["version"])
            if key in expressions:
                components.setdefault(key, []).append(number(licence["text"]))
    entries = [
        {"name": name, "version": version, "licence": expressions[name, version], "texts": sorted(set(numbers))}
        for (name, version), numbers in components.items()
    ]
    for name, version, licence, texts_of in others():
        entry = {"name": name, "version": version, "licence": licence, "texts": [number(text) for text in texts_of]}
        entries.append(entry)
    entries.sort(key=lambda entry: (entry["name"].lower(), entry["version"]))
    return {"components": entries, "texts": texts}


def check():
    known = json.loads(OUTPUT.read_text(encoding="utf-8"))
    known = {(entry["name"], entry["version"], entry["licence"]) for entry in known["components"]}
    besides = {(name, version, licence) for name, version, licence, _ in others()}
    missing = (linked_crates("normal,no-proc-macro") | besides) - known
    left_over = known - linked_crates("normal") - besides
    for name, version, licence in sorted(missing):
        print(f"missing: {name} {version} ({licence})")
    for name, version, licence in sorted(left_over):
        print(f"not linked any more: {name} {version} ({licence})")
    if missing or left_over:
        sys.exit("licences.json is not current: see assets/licences/README.md")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--check", action="store_true", help="only check that licences.json is current")
    arguments.add_argument("--about", type=Path, help="JSON that cargo about made already")
    arguments = arguments.parse_args()
    if arguments.check:
        check()
        return
    made = reduce(json.loads(arguments.about.read_text(encoding="utf-8"))) if arguments.about else make()
    lines = json.dumps(made, ensure_ascii=False, indent=1, sort_keys=True)
    OUTPUT.write_text(lines + "\n", encoding="utf-8")
    print(f"{len(made['components'])} components, {len(made['texts'])} texts")


main()
