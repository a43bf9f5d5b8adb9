#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check the lines of the manual: all pages of doc/ except the record and the generated reference.

    scripts/checks/manual.py [ROOT]

Lines have at most 120 columns; a row of a table, an address and the text that stands for a picture
cannot be broken and may have more. A long page is a warning only: a page is split by topic, and the
evidence behind a rule belongs in doc/record.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

#: Lines of one page without a warning.
MOST_LINES = 200
COLUMNS = 120
UNBROKEN = re.compile(r"^ +\S.* \| |https?://|^ +:alt: ")


def main() -> int:
    """Report wide lines and warn of long pages; 1 if a line is too wide."""
    root = Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).resolve().parents[2]
    total = wide = 0
    for page in sorted((root / "doc").glob("*.rst")):
        lines = page.read_text(encoding="utf-8").splitlines()
        total += len(lines)
        if len(lines) > MOST_LINES:
            print(f"manual: warning: doc/{page.name}: {len(lines)} lines, more than {MOST_LINES}")
        for number, line in enumerate(lines, 1):
            if len(line) > COLUMNS and not UNBROKEN.search(line):
                wide += 1
                print(f"doc/{page.name}:{number}: {len(line)} columns, must be <= {COLUMNS}")
    print(f"manual: {total} lines")
    return 1 if wide else 0


if __name__ == "__main__":
    sys.exit(main())
