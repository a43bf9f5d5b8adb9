#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that go() and action() of the YADE adapters stay short: unpack, call the kernel, pack.

Usage: scripts/checks/adapter_length.py [ROOT]. Prints one line per violation; exit code 1 if any.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

LIMIT = 25
_START = re.compile(r"\b(?:go|action)\s*\([^;{}]*\)\s*(?:const\s*)?(?:override\s*)?\{")


def bodies(text: str) -> Iterator[tuple[int, int]]:
    """Yield first line and number of lines between the braces of each go() and action()."""
    for match in _START.finditer(text):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        inside = text[match.end() : end - 1].strip("\n")
        lines = len(inside.splitlines()) if inside.strip() else 0
        yield text.count("\n", 0, match.start()) + 1, lines


def main() -> int:
    """Print too long bodies in the tree given as argument, or in this one."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    found = 0
    for path in sorted((root / "pkg/flexpm/yade").rglob("*.[ch]pp")):
        for line, length in bodies(path.read_text()):
            if length > LIMIT:
                found += 1
                rule = f"{length} lines, must be <= {LIMIT}; move work out"
                print(f"adapter length: {path}:{line}: {rule}")
    print(f"adapter length: {found} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
