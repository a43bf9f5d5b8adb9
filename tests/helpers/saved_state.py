# SPDX-License-Identifier: GPL-3.0-or-later
"""What scenes hold of flexpm's classes, as the headers say: a number, and the members beneath it.

    /usr/bin/python3 tests/helpers/saved_state.py

writes the list that tests compare with, once the number has been raised.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PKG = ROOT / "pkg" / "flexpm"
LIST = ROOT / "tests" / "yade" / "saved_state.txt"
#: The number, its one home.
_NUMBER = re.compile(r"assemblyVersion = (\d+);")
_CLASS = re.compile(r"YADE_CLASS_BASE\w+\((\w+), *(\w+)")
#: Type, name and flags of an attribute of YADE.
_ATTRIBUTE = re.compile(r"^\t*\(\((.+?), (\w+),.*?,([^\",]*), \"", re.MULTILINE)
_MEMBER = re.compile(r'visit\("(\w+)", [^)]*\);')


def number() -> int:
    """The number with which all classes stand in scenes."""
    header = PKG / "yade" / "bindings" / "assembly_archive.hpp"
    return int(_NUMBER.findall(header.read_text())[0])


def members() -> list[str]:
    """Each saved member, in its order: of classes in YADE, of parts of the kernel's state."""
    found = []
    for file in sorted((PKG / "yade").glob("[!a]*/*.hpp")):
        for part in re.split(r"(?=YADE_CLASS_BASE)", file.read_text())[1:]:
            if about := _CLASS.match(part):
                name, base = about.groups()
                found.append(f"{name}: {base}")
                found += [
                    f"{name}: {kind} {attribute}"
                    for kind, attribute, flags in _ATTRIBUTE.findall(part)
                    if "noSave" not in flags
                ]
    for file in sorted(PKG.glob("kernel/*/*.hpp")):
        found += [f"{file.stem}: {name}" for name in _MEMBER.findall(file.read_text())]
    return found


def listed() -> tuple[int, list[str]]:
    """Number and members of the list."""
    first, *lines = LIST.read_text().splitlines()
    return int(first.rpartition(" ")[2]), lines


def main() -> None:
    """Write the list anew."""
    if LIST.exists() and listed()[1] != members() and listed()[0] >= number():
        sys.exit(f"saved_state: assemblyVersion = {number()}, must be > {listed()[0]}; raise it")
    LIST.write_text("\n".join([f"state {number()}", *members()]) + "\n")


if __name__ == "__main__":
    main()
