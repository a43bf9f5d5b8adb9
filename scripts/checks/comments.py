#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check comments: they begin with their subject, and no line of the kernel passes 100 columns.

    scripts/checks/comments.py [--fix] [ROOT]

--fix breaks comments that are too wide.

A comment that begins "Of ..." leaves its subject to the reader. One behind a member on its line may
begin "of ...": its subject is the name before it. clang-format breaks code at 100 columns; comments
it leaves alone.
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

FOLDERS = ("pkg", "py", "tests", "scripts")
SUFFIXES = (".cpp", ".hpp", ".py", ".pyi", ".txt", "")
#: Where lines have 100 columns and no other tool looks: ruff does so for Python.
NARROW = ("pkg/flexpm/kernel", "tests/kernel")
COLUMNS = 100
#: A comment, a docstring or an entry of one that begins so.
NO_SUBJECT = re.compile(r"""(?://[/!]?<?|\#:?|\"\"\"|^\s+\w+:)[ ]*Of[ ]""", re.VERBOSE)
LINE = re.compile(r"^(\s*(?://[/!]?|#:?) ?)(\s*)(.*)$")
#: Where a paragraph of a comment begins anew.
BEGINS = re.compile(r"@\w+|Deviation D\d+|[-*] |\d+\. ")


def without_subject(lines: list[str]) -> Iterator[int]:
    """Numbers of the lines that begin a comment without its subject, from 1."""
    before = False  # whether the line above is of the same comment
    for number, line in enumerate(lines, 1):
        found = LINE.match(line)
        starts = found is not None and not before and re.match(r"[oO]f ", found[3])
        if starts or NO_SUBJECT.search(line):
            yield number
        before = found is not None and bool(found[3]) and not found[3].endswith((".", ":"))


def broken(paragraph: list[str]) -> list[str]:
    """A paragraph of a comment with lines of at most 100 columns."""
    if all(len(line) <= COLUMNS for line in paragraph):
        return paragraph
    parts = [LINE.match(line) for line in paragraph]
    assert all(parts)
    marker, first, text = parts[0].groups()  # type: ignore[union-attr]
    hanging = parts[1][2] if len(parts) > 1 else first  # type: ignore[index]
    if len(parts) == 1 and re.match(r"@(param|throws|return)", text):
        hanging = first + 8 * " "
    words = [text] + [part[3] for part in parts[1:] if part]
    spaced = re.match(r"@\w+( \S+)?  ", text)  # two blanks behind a word of Doxygen stay two
    kept = spaced[0].replace(" ", "\0") if spaced else ""
    joined = kept + " ".join(words)[len(kept) :]
    lines = textwrap.wrap(
        joined,
        COLUMNS,
        initial_indent=marker + first,
        subsequent_indent=marker + hanging,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line.replace("\0", " ") for line in lines]


def rewrapped(lines: list[str]) -> list[str]:
    """All lines, with the comments broken that pass the width."""
    done: list[str] = []
    paragraph: list[str] = []
    inside = ""  # marker and indent that a further line of the paragraph has
    for line in [*lines, ""]:
        found = LINE.match(line)
        text = found[3] if found else ""
        goes_on = found and text and not BEGINS.match(text) and "```" not in text
        if paragraph and goes_on and found:
            start = found[1] + found[2]
            first = len(paragraph) == 1
            head = LINE.match(paragraph[0])
            assert head
            hangs = first and head[1] == found[1] and bool(BEGINS.match(head[3]))
            if start == inside or (hangs and len(found[2]) < 40):
                inside = start
                paragraph.append(line)
                continue
        done += broken(paragraph)
        paragraph = []
        if found and text and len(found[2]) < 3:
            paragraph, inside = [line], found[1] + found[2]
        else:
            done.append(line)
    return done[:-1]


def main() -> int:
    """Report what breaks a rule; 1 if anything does."""
    fix = "--fix" in sys.argv[1:]
    given = [Path(one) for one in sys.argv[1:] if not one.startswith("--")]
    root = given[0] if given else Path(__file__).resolve().parents[2]
    faults = 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in SUFFIXES or not path.is_file() or path.is_symlink():
                continue
            try:
                text = path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue
            name = str(path.relative_to(root))
            lines = text.split("\n")
            narrow = name.startswith(NARROW) and path.suffix in (".cpp", ".hpp")
            if fix and narrow:
                lines = rewrapped(lines)
                if "\n".join(lines) != text:
                    path.write_text("\n".join(lines), encoding="utf-8")
            for number in without_subject(lines):
                print(f"{name}:{number}: comment begins with 'Of', must begin with its subject")
                faults += 1
            for number, line in enumerate(lines, 1):
                if narrow and len(line) > COLUMNS:
                    print(f"{name}:{number}: {len(line)} columns, must be <= {COLUMNS}")
                    faults += 1
    print(f"comments: {f'{faults} faults' if faults else 'in order'}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
