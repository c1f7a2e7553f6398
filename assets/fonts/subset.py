#!/usr/bin/env python3
"""Makes the fallback fonts of the window, one for Chinese and one for Japanese. See README.md beside this file."""

import argparse
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterable

from fontTools.ttLib import TTFont

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parent.parent / "src"
JAPANESE_TEXTS = SOURCES / "texts" / "ja"
COLLECTION = Path("/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc")


def table(encoding, first, last):
    """The characters of a national standard from one position (row, cell) to another, in the order of its rows."""
    for row in range(first[0], last[0] + 1):
        for cell in range(1, 95):
            if first <= (row, cell) <= last:
                yield bytes((0xA0 + row, 0xA0 + cell)).decode(encoding)


def chinese():
    """The 3,755 most frequent characters: level 1 of GB 2312."""
    yield from table("gb2312", (16, 1), (55, 89))


def japanese():
    """Symbols, kana (half-width ones too) and the 2,965 most frequent kanji: level 1 of JIS X 0208."""
    yield from table("euc_jp", (1, 1), (1, 94))
    yield from table("euc_jp", (4, 1), (4, 83))
    yield from table("euc_jp", (5, 1), (5, 86))
    yield from map(chr, range(0xFF61, 0xFFA0))
    yield from table("euc_jp", (16, 1), (47, 51))


def punctuation():
    """CJK punctuation, full-width forms, and the general punctuation these texts share with others."""
    yield from map(chr, range(0x3000, 0x3020))
    yield from map(chr, range(0xFF01, 0xFF5F))
    yield from map(chr, range(0xFFE0, 0xFFE6))
    yield from map(chr, range(0x20, 0x7F))
    yield from "·×÷±°–—‘’“”•…‰′″℃№→←↑↓≤≥≠√✓①②③④⑤⑥⑦⑧⑨⑩"


def used_in(sources):
    """Every Chinese or Japanese character of these sources: names of countries need some rare ones."""
    wanted = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef]")
    for source in sorted(sources):
        yield from wanted.findall(source.read_text(encoding="utf-8"))


@dataclass
class Face:
    """A font to be made: one face of the collection, with the frequent characters and those of its texts."""

    name: str
    number: int  # inside the collection
    frequent: Callable[[], Iterable[str]]
    is_its_text: Callable[[Path], bool]

    @property
    def path(self):
        return HERE / self.name

    def make(self, collection, characters):
        with tempfile.NamedTemporaryFile("w", suffix=".txt", encoding="utf-8") as file:
            file.write("".join(sorted(characters)))
            file.flush()
            subprocess.run(
                [
                    sys.executable, "-m", "fontTools.subset", str(collection), f"--font-number={self.number}",
                    f"--text-file={file.name}", f"--output-file={self.path}", "--no-hinting", "--desubroutinize",
                    "--layout-features=", "--drop-tables+=vhea,vmtx,GPOS,GSUB,BASE,VORG", "--no-recalc-timestamp",
                ],
                check=True,
            )

    def check(self, common, used):
        """What the font lacks."""
        covered = set(map(chr, TTFont(self.path).getBestCmap()))
        print(f"{self.name}: {len(covered)} characters, {self.path.stat().st_size} bytes")
        print(f"beyond the frequent ones, for texts of the program: {''.join(sorted(used - common)) or 'none'}")
        return "".join(sorted((common | used) - covered))


FACES = [
    Face("NotoSansSC-gb2312-level1.otf", 2, chinese, lambda source: JAPANESE_TEXTS not in source.parents),
    Face("NotoSansJP-jis-level1.otf", 0, japanese, lambda source: JAPANESE_TEXTS in source.parents),
]


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("collection", nargs="?", type=Path, default=COLLECTION, help="NotoSansCJK-Regular.ttc")
    arguments.add_argument("--check", action="store_true", help="make nothing; fail if a text cannot be shown")
    arguments = arguments.parse_args()

    missing = []
    for face in FACES:
        common = set(face.frequent()) | set(punctuation())
        used = set(used_in(filter(face.is_its_text, SOURCES.rglob("*.rs"))))
        if not arguments.check:
            face.make(arguments.collection, common | used)
        if lacks := face.check(common, used):
            missing.append(f"{face.name} lacks {lacks}")
    if missing:
        sys.exit("\n".join(missing))


if __name__ == "__main__":
    main()
