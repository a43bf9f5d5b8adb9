# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs and outlines of any kind: a specimen that steps, or one line that says why not."""

from __future__ import annotations

import math

import pytest
from fuzz_child import Child, examples
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

ODD = st.sampled_from([0.0, -1e-3, 1e-300, 1e300, math.nan, math.inf])
PLACE = st.floats(0.0, 0.02) | st.sampled_from([0.0, 0.005, 0.01, 0.02])
CENTRES = st.lists(st.lists(PLACE, min_size=2, max_size=2), max_size=14)
POLYGONS = st.sampled_from(
    [
        [[0.0, 0.0], [0.02, 0.0], [0.02, 0.02], [0.0, 0.02]],
        [[0.0, 0.0], [0.02, 0.0], [0.01, 0.02]],
        [[0.0, 0.0], [0.02, 0.0], [0.03, 0.01], [0.02, 0.02], [0.0, 0.02], [-0.01, 0.01]],
        [[0.0, 0.0], [0.02, 0.0], [0.02, 1e-9], [0.0, 1e-9]],
        [[0.0, 0.0], [0.0, 0.02], [0.02, 0.02], [0.02, 0.0]],
        [[0.0, 0.0], [0.02, 0.02], [0.02, 0.0], [0.0, 0.02]],
        [[0.0, 0.0], [0.02, 0.0]],
        [],
    ]
)
CIRCLES = st.fixed_dictionaries({"x": PLACE, "y": PLACE, "radius": st.floats(1e-3, 0.03) | ODD})


@st.composite
def specimens(draw):
    """Discs, most of them in their outline, a number of them out of all sense."""
    centres = draw(CENTRES)
    radii = [draw(st.floats(5e-4, 4e-3)) for _ in centres]
    if centres and draw(st.integers(0, 4)) == 0:
        which = draw(st.integers(0, len(centres) - 1))
        if draw(st.booleans()):
            radii[which] = draw(ODD)
        else:
            centres[which][draw(st.integers(0, 1))] = draw(ODD)
    if draw(st.integers(0, 9)) == 0:
        radii = radii[1:]
    return {
        "centres": centres,
        "radii": radii,
        "outline": draw(POLYGONS | POLYGONS | CIRCLES),
        "thickness": draw(st.sampled_from([0.01, 0.01, 0.01, 1e-9, 1e6]) | ODD),
        "short_edge": draw(st.sampled_from([0.0, 0.1, 0.2]) | ODD),
        "model": draw(st.sampled_from(["flexible", "rigid", "inner-un"])),
    }


@pytest.fixture(scope="module")
def child():
    one = Child("discs")
    yield one
    one.close()


@given(specimens())
@settings(max_examples=examples(200), deadline=None, suppress_health_check=list(HealthCheck))
def test_any_discs_in_any_outline_step_or_are_refused(child, specimen):
    said = child.run(specimen)
    assert said == "done" or said.startswith(("InputError: ", "RuntimeError: ")), said
    assert "\n" not in said
