# SPDX-License-Identifier: GPL-3.0-or-later
"""Refusals are one line: quantity, value, unit, rule, remedy."""

import numpy as np
import pytest
from refusals import refusal

from flexpm.errors import InputError
from flexpm.require import (
    NOT_NEGATIVE,
    POSITIVE,
    Bounds,
    require_known,
    require_number,
    require_one_of,
    require_whole,
)


@pytest.mark.parametrize(
    ("value", "bounds", "message"),
    [
        (0.0, POSITIVE, "height = 0.0 m, must be > 0; give a larger value"),
        (-1, NOT_NEGATIVE, "height = -1 m, must be >= 0; give a larger value"),
        (1.0, Bounds(below=1.0), "height = 1.0 m, must be < 1; give a smaller value"),
        (1.5, Bounds(at_most=1.0), "height = 1.5 m, must be <= 1; give a smaller value"),
        (float("nan"), POSITIVE, "height = nan m, must be finite"),
        (10**400, POSITIVE, "must be finite"),
        (True, POSITIVE, "height = True m, must be a number"),
        ("tall", POSITIVE, "height = 'tall' m, must be a number; write it without quotes"),
    ],
)
def test_a_number_out_of_range_is_named_with_the_rule(value, bounds, message):
    refusal(message, require_number, "height", value, bounds, "m")


def test_a_reason_takes_the_place_of_the_direction():
    why = "a notch is shorter than the beam is high; use a larger height"
    line = refusal(
        "notch = 2 m, must be < 1: a notch",
        require_number,
        "notch",
        2,
        Bounds(below=1.0),
        "m",
        why=why,
    )
    assert line.endswith(why)


def test_numbers_in_range_become_floats_and_whole_numbers_integers():
    number = require_number("x", 2, Bounds(above=1.0, at_most=2.0))
    assert (number, type(number)) == (2.0, float)
    assert type(require_whole("n", np.int64(3))) is int
    for value in (3.0, True, "3"):
        refusal("must be a whole number", require_whole, "n", value)
    refusal("n = -1, must be >= 0", require_whole, "n", -1, NOT_NEGATIVE)


def test_names_are_refused_with_the_nearest_or_all_choices():
    with pytest.raises(InputError, match=r"did you mean rigid.*known are rigid, soft"):
        require_known("model", "rigit", ("rigid", "soft"))
    refusal("points = 4, must be one of 1, 2", require_one_of, "points", 4, (1, 2))
    require_known("model", "soft", ("rigid", "soft"))
    require_one_of("points", 2, (1, 2))
