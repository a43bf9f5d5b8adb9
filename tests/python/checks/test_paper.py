# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges of the paper's statements: verdicts on tables whose answer is known."""

from __future__ import annotations

import sys
from pathlib import Path

import pandas
import pytest

PAPER = Path(__file__).parents[3] / "scripts" / "paper"
A, B = {"model": "a"}, {"model": "b"}
BOTH = {"one": A, "other": B}


@pytest.fixture(scope="module")
def judge():
    sys.path.insert(0, str(PAPER))
    try:
        import judge
    finally:
        sys.path.remove(str(PAPER))
    return judge


def table(strength, seeds=(1, 2, 3)):
    """Strength by (model, x, seed) of two models at three x."""
    return pandas.DataFrame(
        {"model": model, "x": x, "seed": seed, "strength": strength(model, x, seed)}
        for model in "ab"
        for x in (1.0, 2.0, 4.0)
        for seed in seeds
    )


def scattered(model, x, seed):
    """Model a is 10 % above b; both grow in proportion to x, and packings differ by 20 %."""
    return (1.1 if model == "a" else 1.0) * x * (1.0 + 0.2 * seed)


def test_models_are_compared_packing_by_packing(judge):
    found = table(scattered)
    assert judge.above(found, "strength", A, B, ["x"]).startswith("reproduced; ")
    assert judge.above(found, "strength", B, A, ["x"]).startswith("not reproduced; ")
    assert "+10 to +10 % at 3 points" in judge.above(found, "strength", A, B, ["x"])
    assert judge.alike(found, "strength", A, B, {"x": 1.0}).startswith("not reproduced; ")


def test_a_difference_below_its_error_is_scatter(judge):
    found = table(lambda model, x, seed: 1.0 + (0.1 * (seed - 2) if model == "a" else 0.0))
    told = judge.above(found, "strength", A, B, ["x"])
    assert told.startswith("within scatter, more than 1000 packings would decide; ")
    assert judge.alike(found, "strength", A, B, {"x": 1.0}).startswith("reproduced; ")


def test_the_number_of_packings_that_would_decide_brings_the_error_down_to_the_mean(judge):
    """Mean 0.04 and standard error 0.1 / sqrt(3) of three packings: 3 (0.1 / 0.04)^2 / 3 = 6.25."""
    found = table(lambda model, x, seed: 1.0 + (0.04 + 0.1 * (seed - 2) if model == "a" else 0.0))
    told = judge.above(found, "strength", A, B, ["x"])
    assert told.startswith("within scatter, about 7 packings would decide; ")


def test_a_single_packing_tells_nothing(judge):
    told = judge.above(table(scattered, seeds=(1,)), "strength", A, B, ["x"])
    assert told.startswith("too few packings; ")
    alone = table(scattered, seeds=(1,)).query("x == 1").assign(x=8.0)
    most = pandas.concat([table(scattered), alone])
    assert "at 3 points" in judge.above(most, "strength", A, B, ["x"])


def test_a_statement_that_holds_here_and_there_is_counted(judge):
    found = table(
        lambda model, x, seed: (2.0 if (model == "a") == (x > 1.0) else 1.0) + 0.01 * seed
    )
    told = judge.above(found, "strength", A, B, ["x"])
    assert told.startswith("in part: holds at 2 and is against at 1 of 3 points; ")


@pytest.mark.parametrize(
    ("told", "verdict"),
    [
        ("reproduced; +3.0 %", "reproduced"),
        ("not reproduced; +3.0 %", "not reproduced"),
        ("one: reproduced; +3 %. other: reproduced; +4 %", "reproduced"),
        ("one: reproduced; +3 %. other: not reproduced; -4 %", "in part"),
        ("in part: holds at 1 and is against at 1 of 3 points", "in part"),
        ("within scatter, about 7 packings would decide; +1 %", "within scatter"),
    ],
)
def test_a_statement_has_the_verdict_of_all_its_cases(judge, told, verdict):
    assert judge.overall(told) == verdict


def test_a_sweep_is_judged_by_its_ends(judge):
    found = table(scattered)
    assert "one: reproduced; +300.0" in judge.each(
        found, judge.grows, BOTH, measure="strength", x="x", at=[]
    )
    assert judge.falls(found, "strength", "x", [], A).startswith("not reproduced; +300.0")
    assert judge.negligible(found, "strength", "x", [], A).startswith("not reproduced; ")
    assert judge.stronger(found, "strength", "x", A, B, []).startswith("within scatter, ")
    steep = table(lambda model, x, seed: x ** (2.0 if model == "a" else 1.0) + 0.01 * seed)
    assert judge.stronger(steep, "strength", "x", A, B, []).startswith("reproduced; ")


def test_a_sweep_without_one_of_its_ends_is_not_judged(judge):
    found = table(lambda model, x, seed: x if model == "b" or x > 1.0 else float("nan"))
    assert judge.grows(found, "strength", "x", [], A) == judge.NOT_RUN
    assert judge.grows(found, "strength", "x", [], B).startswith("reproduced; +300.0")


def test_a_line_is_straight_and_a_square_is_not(judge):
    line, square = table(scattered), table(lambda model, x, seed: x * x)
    assert judge.straight(line, "strength", "x", [], A).startswith("reproduced; ")
    assert judge.straight(square, "strength", "x", [], A).startswith("not reproduced; ")


def test_quotients_stand_above_or_below_one(judge):
    found = table(lambda model, x, seed: (0.9 if model == "a" else 1.2) + 0.001 * seed)
    assert judge.below_one(found, "strength", A, ["x"]) == "reproduced; 0.90 to 0.90"
    assert judge.above_one(found, "strength", B, ["x"]) == "reproduced; 1.20 to 1.20"
    assert judge.above_one(found, "strength", A, ["x"]).startswith("not reproduced; ")
    assert judge.meets(found, "strength", 0.92, A | {"x": 1.0}).startswith("reproduced; ")
    assert judge.meets(found, "strength", 1.0, A | {"x": 1.0}).startswith("not reproduced; ")


def test_a_mean_lies_between_or_closer(judge):
    found = table(lambda model, x, seed: x)
    first, middle, last = ({"x": x} for x in (1.0, 2.0, 4.0))
    assert judge.between(found, "strength", [first, last], middle, A).startswith("reproduced; ")
    assert judge.between(found, "strength", [first, middle], last, A).startswith("not reproduced")
    assert judge.closer(found, "strength", first, last, middle).startswith("reproduced; ")
    assert judge.closer(found, "strength", last, first, middle).startswith("not reproduced; ")


def test_what_was_not_run_is_said_so(judge):
    found, nowhere = table(scattered), {"model": "c"}
    assert judge.above(found, "strength", nowhere, B, ["x"]) == judge.NOT_RUN
    assert judge.grows(found, "strength", "x", [], nowhere) == judge.NOT_RUN
    assert judge.below_one(found, "strength", nowhere) == judge.NOT_RUN
    assert judge.between(found, "strength", [A, nowhere], B, {}) == judge.NOT_RUN
    assert judge.straight(found, "friction_angle", "x", [], A) == judge.NOT_RUN
    missing = judge.each(found, judge.grows, {"one": nowhere}, measure="strength", x="x", at=[])
    assert missing == judge.NOT_RUN
