# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs and outlines of any kind: a specimen that steps, or one line that says why not."""

from __future__ import annotations

import itertools
import math

import pytest
from fuzz_child import Child, drawing
from hypothesis import example, given
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
        "drop_hidden": draw(st.booleans()),
        "closed": draw(st.booleans()),
        "short_edge": draw(st.sampled_from([0.0, 0.1, 0.2]) | ODD),
        "model": draw(st.sampled_from(["flexible", "rigid", "inner-un"])),
    }


@st.composite
def tilings(draw):
    """Rows of bricks, grains within them, rings that are closed, and now and then what is wrong.

    Grains lie anywhere: within a brick or another grain, over its edges, on a corner, at a place
    that another one has already.
    """
    across, up = draw(st.integers(1, 3)), draw(st.integers(1, 3))
    shifts = [draw(st.sampled_from([0.0, 0.25, 0.4])) if across > 1 else 0.0 for _ in range(up)]
    rings = []
    for row, shift in enumerate(shifts):
        places = [0.0, *(column + shift for column in range(1, across)), float(across)]
        rings += [
            [[x, row], [y, row], [y, row + 1.0], [x, row + 1.0]]
            for x, y in itertools.pairwise(places)
        ]
    for _ in range(draw(st.integers(0, 5))):
        corners = draw(st.integers(3, 7))
        x, y = draw(st.floats(0.0, across)), draw(st.floats(0.0, up))
        if draw(st.integers(0, 5)) == 0:
            x, y = draw(st.sampled_from([ring[0] for ring in rings]))
        radius = draw(st.sampled_from([0.05, 0.1, 0.2, 0.3, 1e-3, 1.0]))
        turn = draw(st.floats(0.0, 6.0))
        angles = [turn + 2.0 * math.pi * corner / corners for corner in range(corners)]
        rings.append([[x + radius * math.cos(a), y + radius * math.sin(a)] for a in angles])
    if draw(st.integers(0, 5)) == 0:
        del rings[draw(st.integers(0, len(rings) - 1))]
    if rings and draw(st.integers(0, 9)) == 0:
        ring = rings[draw(st.integers(0, len(rings) - 1))]
        ring[draw(st.integers(0, len(ring) - 1))][draw(st.integers(0, 1))] = draw(ODD)
    closed = draw(st.booleans())
    return {
        "rings": [[*ring, list(ring[0])] if closed else ring for ring in rings],
        "order": draw(st.booleans()),
        "holes": draw(st.booleans()),
        "model": draw(st.sampled_from(["flexible", "rigid"])),
    }


@pytest.fixture(scope="module")
def child():
    one = Child("discs")
    yield one
    one.close()


#: Sides of a solid and the axes that they are held along.
HELD = st.tuples(st.sampled_from([4, 5, 0, 3, 6, -1, 2**31 - 1]), st.sampled_from(["y", "xz", ""]))


@st.composite
def solids(draw):
    """Spheres in a box or a cylinder: anywhere, on a lattice, and now and then out of all sense."""
    box = draw(st.booleans())
    if draw(st.booleans()):
        edge = draw(st.integers(2, 4))
        step = 0.01 / edge
        axis = [step * (place + 0.5) for place in range(edge)]
        rows = [[*place, 0.5 * step] for place in itertools.product(axis, repeat=3)]
    else:
        place = st.floats(1e-4, 0.0099) | st.sampled_from([0.002, 0.005, 0.008])
        row = st.tuples(place, place, place, st.floats(5e-4, 4e-3))
        rows = [list(one) for one in draw(st.lists(row, max_size=14))]
    if not box:  # stands about the z axis
        rows = [[x - 0.005, y - 0.005, *others] for x, y, *others in rows]
    if rows and draw(st.integers(0, 4)) == 0:
        rows[draw(st.integers(0, len(rows) - 1))][draw(st.integers(0, 3))] = draw(ODD)
    cylinder = {"diameter": 0.016, "height": 0.01}
    return {
        "spheres": rows,
        "sizes": {"width": 0.01, "depth": 0.01, "height": 0.01} if box else cylinder,
        "drop_hidden": draw(st.booleans()),
        "short_edge": draw(ODD if draw(st.integers(0, 9)) == 0 else st.sampled_from([0.0, 0.1])),
        "model": draw(st.sampled_from(["flexible", "rigid", "jcfpm", "cohfrict", "inner"])),
        "interaction_range": draw(st.sampled_from([None, None, None, 1.3, math.nan])),
        # none at all, drawn, or given: mostly as many as there are grains
        "minerals": draw(
            st.none()
            | st.just([])
            | st.lists(st.integers(-1, 2), min_size=len(rows), max_size=len(rows))
        ),
        "held": draw(st.lists(HELD, max_size=2)),
    }


@pytest.fixture(scope="module")
def spheres():
    one = Child("spheres")
    yield one
    one.close()


#: A sphere alone has no bonds for a model of spheres.
ALONE = {
    "spheres": [[0.0028125, 0.0028125, 0.0078125, 0.00390625]],
    "sizes": {"diameter": 0.016, "height": 0.01},
    "drop_hidden": False,
    "short_edge": 0.0,
    "model": "jcfpm",
    "interaction_range": None,
    "minerals": None,
    "held": [],
}


#: A sphere whose centre lies on a face to within round-off leaves cohfrict no radius.
ON_A_FACE = {
    **ALONE,
    "spheres": [[1e-300, 0.005, 0.005, 0.003], [0.007, 0.005, 0.005, 0.003]],
    "sizes": {"width": 0.01, "depth": 0.01, "height": 0.01},
    "model": "cohfrict",
}


@given(solids())
@example(ALONE)
@example(ON_A_FACE)
@drawing(100)
def test_any_spheres_in_a_solid_step_or_are_refused(spheres, solid):
    said = spheres.run(solid)
    assert said.startswith(("done", "InputError: ")), said
    assert "\n" not in said


@pytest.fixture(scope="module")
def cells():
    one = Child("cells")
    yield one
    one.close()


@given(specimens())
@drawing(200)
def test_any_discs_in_any_outline_step_or_are_refused(child, specimen):
    said = child.run(specimen)
    assert said == "done" or said.startswith(("InputError: ", "RuntimeError: ")), said
    assert "\n" not in said


@pytest.mark.long
@given(tilings())
@drawing(150)
def test_any_cells_with_grains_within_them_step_or_are_refused(cells, tiling):
    said = cells.run(tiling)
    assert said.startswith(("done", "InputError: ")), said
    assert "\n" not in said


@st.composite
def images(draw):
    """A few labels on a few pixels, some of them holes, and now and then what is wrong."""
    rows, columns = draw(st.integers(2, 9)), draw(st.integers(2, 9))
    kinds = draw(st.integers(1, 6))
    row = st.lists(st.integers(0, kinds - 1), min_size=columns, max_size=columns)
    odd = draw(st.integers(0, 9)) == 0
    mineral = st.sampled_from([0, 0, 1, 1, None])
    return {
        "labels": draw(st.lists(row, min_size=rows, max_size=rows)),
        "pixel": draw(ODD if odd else st.sampled_from([1e-4, 1e-3])),
        "minerals": draw(st.none() | st.lists(mineral, min_size=kinds, max_size=kinds)),
        "edge": draw(st.sampled_from([None, None, None, 2e-3, 1e-2, 0.0, math.nan])),
        "smallest": draw(st.sampled_from([1, 1, 2, 4, 9, 0])),
        "model": draw(st.sampled_from(["flexible", "rigid"])),
    }


@st.composite
def bodies(draw):
    """Planes that cut a box or a cylinder, and now and then a corner that is moved."""
    plane = st.floats(0.01, 0.99) | st.sampled_from([0.25, 0.5, 0.5 + 1e-9, 0.5 + 1e-3])
    planes = st.lists(plane, max_size=2, unique=True)
    return {
        "planes": draw(st.lists(planes, min_size=3, max_size=3)),
        "facets": draw(st.sampled_from([0, 0, 16, 17, 24, 8])),
        "moved": draw(st.integers(0, 99)),
        "by": draw(st.sampled_from([0.0, 0.0, 0.0, 1e-12, 1e-3, 0.3])),
        "scale": draw(st.sampled_from([0.01, 0.01, 0.01, 1.0]) | ODD),
        "short_edge": draw(st.sampled_from([0.0, 0.0, 0.06, 0.2, -1.0, math.nan])),
        "model": draw(st.sampled_from(["flexible", "rigid"])),
    }


@pytest.fixture(scope="module")
def labels():
    one = Child("labels")
    yield one
    one.close()


@pytest.fixture(scope="module")
def own_cells():
    one = Child("bodies")
    yield one
    one.close()


@given(images())
@drawing(80)
def test_any_image_steps_or_is_refused(labels, image):
    said = labels.run(image)
    assert said.startswith(("done", "InputError: ")), said
    assert "\n" not in said


@given(bodies())
@drawing(40)
def test_any_cells_of_a_solid_step_or_are_refused(own_cells, body):
    said = own_cells.run(body)
    assert said.startswith(("done", "InputError: ")), said
    assert "\n" not in said
