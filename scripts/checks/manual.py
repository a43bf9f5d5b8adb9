#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that the manual stays short: all pages of doc/ but the record and the generated reference.

    scripts/checks/manual.py [ROOT]

What is said twice, or tells how a thing was found out, does not belong there (doc/record). Lines
have at most 120 columns; a row of a table, an address and the text that stands for a picture cannot
be broken and may have more. Pages on solids, laws of pairs and what follows these have lines of
their own beside the rest's: 500 in the end.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

#: Lines of solids, laws of pairs, networks, folders and states of own tests; to be raised with what
#: is added, to 500.
ADDED = 379
MOST_LINES = 2600 + ADDED
COLUMNS = 120
UNBROKEN = re.compile(r"^ +\S.* \| |https?://|^ +:alt: ")


def main() -> int:
    """Report lines that are too wide, and a manual that is too long; 1 if there is any."""
    root = Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).resolve().parents[2]
    lines = wide = 0
    for page in sorted((root / "doc").glob("*.rst")):
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            lines += 1
            if len(line) > COLUMNS and not UNBROKEN.search(line):
                wide += 1
                print(f"doc/{page.name}:{number}: {len(line)} columns, must be <= {COLUMNS}")
    if lines > MOST_LINES:
        print(
            f"manual: lines = {lines}, must be <= {MOST_LINES}; say it once, or in doc/record",
        )
    else:
        print(f"manual: {lines} lines")
    return 1 if wide or lines > MOST_LINES else 0


if __name__ == "__main__":
    sys.exit(main())
