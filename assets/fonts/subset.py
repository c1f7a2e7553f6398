#!/usr/bin/env python3
"""Makes NotoSansSC-gb2312-level1.otf, the Chinese fallback font of the window. See README.md beside this file."""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from fontTools.ttLib import TTFont

HERE = Path(__file__).resolve().parent
OUTPUT = HERE / "NotoSansSC-gb2312-level1.otf"
SOURCE = Path("/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc")
SIMPLIFIED_CHINESE = 2  # the face's number inside the collection


def gb2312_level_1():
    """The 3,755 most frequent characters: rows 16 to 55 of GB 2312 (row 55 ends at cell 89)."""
    for row in range(16, 56):
        for cell in range(1, 95):
            if (row, cell) <= (55, 89):
                yield bytes((0xA0 + row, 0xA0 + cell)).decode("gb2312")


def punctuation():
    """CJK punctuation, full-width forms, and the general punctuation Chinese texts share with others."""
    yield from map(chr, range(0x3000, 0x3020))
    yield from map(chr, range(0xFF01, 0xFF5F))
    yield from map(chr, range(0xFFE0, 0xFFE6))
    yield from map(chr, range(0x20, 0x7F))
    yield from "·×÷±°–—‘’“”•…‰′″℃№→←↑↓≤≥≠√✓①②③④⑤⑥⑦⑧⑨⑩"


def used_in_the_program():
    """Every Chinese character of the sources, level 1 or not: names of countries need some rare ones."""
    chinese = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef]")
    for source in sorted((HERE.parent.parent / "src").rglob("*.rs")):
        yield from chinese.findall(source.read_text(encoding="utf-8"))


def make(source, characters):
    with tempfile.NamedTemporaryFile("w", suffix=".txt", encoding="utf-8") as file:
        file.write("".join(sorted(characters)))
        file.flush()
        subprocess.run(
            [
                sys.executable, "-m", "fontTools.subset", str(source), f"--font-number={SIMPLIFIED_CHINESE}",
                f"--text-file={file.name}", f"--output-file={OUTPUT}", "--no-hinting", "--desubroutinize",
                "--layout-features=", "--drop-tables+=vhea,vmtx,GPOS,GSUB,BASE,VORG", "--no-recalc-timestamp",
            ],
            check=True,
        )


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("source", nargs="?", type=Path, default=SOURCE, help="NotoSansCJK-Regular.ttc")
    arguments.add_argument("--check", action="store_true", help="make nothing; fail if a text cannot be shown")
    arguments = arguments.parse_args()

    common = set(gb2312_level_1()) | set(punctuation())
    used = set(used_in_the_program())
    if not arguments.check:
        make(arguments.source, common | used)

    covered = set(map(chr, TTFont(OUTPUT).getBestCmap()))
    print(f"{OUTPUT.name}: {len(covered)} characters, {OUTPUT.stat().st_size} bytes")
    print(f"beyond the common ones, for texts of the program: {''.join(sorted(used - common)) or 'none'}")
    if missing := "".join(sorted((common | used) - covered)):
        sys.exit(f"missing: {missing}")


if __name__ == "__main__":
    main()
