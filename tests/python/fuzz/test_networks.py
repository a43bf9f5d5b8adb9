# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture networks of any tables: a specimen that is cut and read back, or one line."""

from __future__ import annotations

import math

import pytest
from fuzz_child import Child, drawing
from hypothesis import given
from hypothesis import strategies as st

ODD = st.sampled_from([0.0, -1.0, 1e-300, 1e300, math.nan, math.inf, 2**70, "a", None, True, []])
LENGTH = st.floats(5e-4, 0.03)
ANGLE = st.floats(-180.0, 180.0)
CONCENTRATION = st.floats(1e-3, 1e4)


def law(name, **values):
    return st.fixed_dictionaries({"law": st.just(name), **values})


LENGTHS = st.one_of(
    law("constant", value=LENGTH),
    law("lognormal", mean=LENGTH, deviation=LENGTH, smallest=LENGTH, largest=LENGTH),
    law("power", exponent=st.floats(1.5, 6.0), smallest=LENGTH, largest=LENGTH),
)
ANGLES = st.one_of(
    law("constant", angle=ANGLE),
    law("von-mises", angle=ANGLE, concentration=CONCENTRATION),
    law(
        "fisher",
        dip=st.floats(0.0, 90.0),
        dip_direction=ANGLE,
        concentration=CONCENTRATION,
        weight=st.sampled_from(["sine", "none"]),
    ),
)
SETS = st.fixed_dictionaries(
    {"intensity": st.floats(1.0, 400.0), "length": LENGTHS, "orientation": ANGLES}
)


@st.composite
def networks(draw):
    """One or two sets, one of ten with a value that has no sense or is missing."""
    names = draw(st.lists(st.sampled_from(["a", "b", "a b", ""]), min_size=1, max_size=2))
    table = {"seed": draw(st.integers(0, 9)), "set": {name: draw(SETS) for name in names}}
    if draw(st.integers(0, 9)) == 0:
        place = table["set"][names[0]]
        key = draw(st.sampled_from(["intensity", "length", "orientation"]))
        if isinstance(place[key], dict) and draw(st.booleans()):
            place, key = place[key], draw(st.sampled_from(sorted(place[key])))
        if draw(st.booleans()):
            place[key] = draw(ODD)
        else:
            del place[key]
    return table


@pytest.fixture(scope="module")
def child():
    one = Child("networks")
    yield one
    one.close()


@given(networks())
@drawing(100)
def test_any_network_cuts_or_is_refused(child, network):
    said = child.run(network)
    assert said == "done" or said.startswith("InputError: "), said
    assert "\n" not in said
