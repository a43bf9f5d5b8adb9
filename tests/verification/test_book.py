# SPDX-License-Identifier: GPL-3.0-or-later
"""The verification book: its table is that of its measurements, which can be repeated."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from book import BOOK, HEADER, book, read
from book import CASES as WANTED
from book_cases import CASES

ROOT = Path(__file__).resolve().parents[2]
#: Largest error at the finest of each case [%]: what the book claims.
CLAIMS = {
    **dict.fromkeys(("vp flexible", "vs flexible", "vp rigid", "vs rigid"), 1.0),
    **dict.fromkeys(("onset flexible", "onset rigid"), 0.1),
    **dict.fromkeys(("sliding flexible", "sliding rigid"), 1.0),
    **dict.fromkeys(("sliding far flexible", "sliding far rigid"), 1.0),
    **dict.fromkeys(("K_I beam", "K_I half-disc", "closed crack"), 3.0),
    "rubbing crack": 3.0,
    "kink": 14.0,
    "strip opened": 2.0,
    "strip sheared": 4.0,
}


def errors(name: str) -> dict[float, list[float]]:
    """Errors of a case, by fineness [%]."""
    found: dict[float, list[float]] = {}
    for row in read():
        if row["case"] == name:
            error = 100.0 * (float(row["ratio"]) - 1.0)
            found.setdefault(float(row["fineness"]), []).append(error)
    return found


def test_the_page_shows_the_table_of_the_measurements():
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([HEADER, *book(read())])
    assert BOOK.read_text(encoding="utf-8") == text.getvalue()
    page = (ROOT / "doc" / "validation.rst").read_text(encoding="utf-8")
    assert f"../{BOOK.relative_to(ROOT)}" in page


def test_every_case_is_measured():
    assert CASES.keys() == WANTED.keys() == CLAIMS.keys()
    measured = {(one["case"], float(one["fineness"])) for one in read()}
    assert measured == {(name, one) for name, case in WANTED.items() for one in case.finenesses}


@pytest.mark.parametrize("name", CLAIMS)
def test_errors_are_within_the_claims_and_fall(name):
    means = {fineness: sum(one) / len(one) for fineness, one in errors(name).items()}
    finest = max(means)
    assert abs(means[finest]) < CLAIMS[name]
    if WANTED[name].converges:
        falling = [abs(means[one]) for one in sorted(means)]
        assert falling == sorted(falling, reverse=True)


def measured_again(name: str, fineness: float, number: int) -> None:
    """Measure a run of a case once more: the same within what processors differ by."""
    (before,) = (
        float(row["ratio"])
        for row in read()
        if (row["case"], float(row["fineness"]), int(row["number"])) == (name, fineness, number)
    )
    assert CASES[name](fineness, number).ratio == pytest.approx(before, rel=1e-6)


#: Cases whose coarsest run takes half a minute and more, too.
LONG = ("rubbing crack", "strip opened", "strip sheared", "sliding far flexible")


@pytest.mark.long
@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=[pytest.mark.slow] * (one in LONG)) for one in CASES]
)
def test_the_coarsest_run_is_what_the_book_says(name):
    measured_again(name, min(WANTED[name].finenesses), 1)


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_the_finest_run_is_what_the_book_says(name):
    measured_again(name, max(WANTED[name].finenesses), 1)
