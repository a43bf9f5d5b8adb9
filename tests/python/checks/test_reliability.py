# SPDX-License-Identifier: GPL-3.0-or-later
"""The page on reliability has a row for each finding, and the tests that it names are there."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "doc" / "record" / "reliability.rst").read_text(encoding="utf-8")
#: Findings of the trials of version 0.2: letter, or letter and number.
FINDINGS = [
    *(f"R{n}" for n in range(1, 25)),
    *"ABCD",
    *(f"F{n}" for n in range(1, 9)),
    *(f"H{n}" for n in range(1, 12)),
    *(f"N{n}" for n in range(1, 17)),
]


def sources() -> dict[str, str]:
    """Text of the test files by their name without its ending; kernel and Python may share one."""
    found: dict[str, str] = {}
    for file in sorted((ROOT / "tests").rglob("test_*")):
        if file.suffix in (".py", ".cpp"):
            found[file.stem] = found.get(file.stem, "") + file.read_text(encoding="utf-8")
    return found


def missing(page: str) -> list[str]:
    """What a page names as a test and is none."""
    texts = sources()
    parts = re.findall(r'``(test_\w+)(?:::(\w+)| "([^"`]+)")?``', page)
    wrong = []
    for file, function, case in parts:
        text = texts.get(file, "")
        cases = re.sub(r'"\s*"', "", text)  # a long name is in pieces
        there = (
            f"\ndef {function}(" in text
            if function
            else re.search(rf'TEST_CASE\(\s*"{re.escape(case)}"', cases)
            if case
            else text
        )
        if not there:
            wrong.append("::".join(one for one in (file, function, case) if one))
    return wrong


def test_each_finding_has_its_row_with_tests():
    table = PAGE.partition(".. list-table:: Trials of version 0.2")[2].partition("\n\nBelow")[0]
    rows = re.findall(r"^   \* - (\w+)\n((?:     .*\n?)+)", table, re.MULTILINE)
    assert [number for number, _ in rows] == FINDINGS
    for number, cells in rows:
        assert len(re.findall(r"^     - ", cells, re.MULTILINE)) == 3, number
        assert re.search(r'``test_\w+(::\w+| "[^"]+")``', cells), number


def test_the_tests_that_the_page_names_are_there():
    assert len(re.findall(r"``test_\w+(?:::| )", PAGE)) > 100
    assert missing(PAGE) == []


def test_a_test_that_is_gone_is_found():
    page = '``test_parts::test_gone`` ``test_gone`` ``test_plate "a gone case"`` ``test_parts``'
    assert missing(page) == ["test_parts::test_gone", "test_gone", "test_plate::a gone case"]
