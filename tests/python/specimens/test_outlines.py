# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens of any outline, with holes: area, grains that are seen whole, refused input."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refusal

import flexpm
from flexpm.errors import InputError
from flexpm.report.maps import cell_polygons
from flexpm.specimens.specimen import Specimen

L_SHAPE = [(0, 0), (0.02, 0), (0.02, 0.01), (0.01, 0.01), (0.01, 0.03), (0, 0.03)]
SQUARE = [(0, 0), (0.02, 0), (0.02, 0.02), (0, 0.02)]


def area(ring):
    x, y = np.asarray(ring, dtype=float).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def circle(x, y, radius, corners=24):
    angle = 2.0 * math.pi * np.arange(corners) / corners
    return np.column_stack((x + radius * np.cos(angle), y + radius * np.sin(angle)))


def require_cells(specimen, expected):
    """Cells fill an area [m2] and see all their edges; contacts lie between two cells."""
    cells = specimen.tessellation
    assert math.fsum(cells.cell_areas) == pytest.approx(expected, rel=1e-12)
    assert cells.cell_areas.min() > 0.0
    for polygon, (x, y, _) in zip(cell_polygons(cells), specimen.discs, strict=True):
        out = polygon - (x, y)
        following = np.roll(out, -1, axis=0)
        assert (out[:, 0] * following[:, 1] - out[:, 1] * following[:, 0]).min() > 0.0
    a, b = cells.vertices[cells.boundary_edges[:, 1]], cells.vertices[cells.boundary_edges[:, 2]]
    rim = 0.5 * float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))
    assert rim == pytest.approx(expected, rel=1e-12)


def test_an_l_with_a_hole():
    hole = circle(0.005, 0.02, 0.0025)
    specimen = Specimen.polygon(L_SHAPE, 0.08, holes=[hole])
    require_cells(specimen, area(L_SHAPE) - area(hole))
    assert specimen.kind == "polygon"
    assert len(specimen.holes) == 1
    cut = np.isclose(specimen.radii, np.sqrt(specimen.tessellation.cell_areas / math.pi))
    assert 0 < cut.sum() < len(cut)  # grains on the outline; those inside keep their discs
    figures = specimen.statistics()
    mean = figures["cell_area"] / figures["grains"]
    assert figures["smallest_cell_area"] > 0.02 * mean
    assert figures["fan_smallest_angle"] > 1.0
    assert flexpm.build(specimen).counts()["grains"] == figures["grains"]


def test_sides_are_those_of_the_corners():
    specimen = Specimen.polygon(L_SHAPE, 0.08)
    cells = specimen.tessellation
    for number, corner in enumerate(specimen.outline):
        way = specimen.outline[(number + 1) % len(specimen.outline)] - corner
        edges = cells.boundary_edges[cells.boundary_edges[:, 3] == number]
        length = 0.0
        for _, start, end, _ in edges:
            for place in (start, end):
                off = cells.vertices[place] - corner
                assert abs(way[0] * off[1] - way[1] * off[0]) < 1e-12 * np.hypot(*way)
            length += np.hypot(*(cells.vertices[end] - cells.vertices[start]))
        assert length == pytest.approx(np.hypot(*way), rel=1e-12)


def test_either_sense_and_any_first_corner_give_the_same_rectangle():
    first = Specimen.polygon(SQUARE, 0.08, seed=2)
    turned = Specimen.polygon([SQUARE[2], SQUARE[1], SQUARE[0], SQUARE[3]], 0.08, seed=2)
    assert first.kind == turned.kind == "rectangle"
    np.testing.assert_array_equal(first.tessellation.vertices, turned.tessellation.vertices)
    np.testing.assert_array_equal(first.outline, turned.outline)
    assert first.spec == turned.spec


def test_a_plate_with_a_hole_is_softer():
    """A rectangle with a hole has the elastic constants of a plate with less to carry."""
    hole = circle(0.01, 0.02, 0.003)
    outline = [(0, 0), (0.02, 0), (0.02, 0.04), (0, 0.04)]
    whole = flexpm.elastic(Specimen.polygon(outline, 0.08))["youngs_modulus"]
    open_ = flexpm.elastic(Specimen.polygon(outline, 0.08, holes=[hole]))["youngs_modulus"]
    assert 0.8 * whole < open_ < 0.95 * whole


def test_a_rectangle_is_sawn_as_stiff_as_it_is_packed():
    outline = [(0, 0), (0.04, 0), (0.04, 0.08), (0, 0.08)]
    sawn = flexpm.elastic(Specimen.polygon(outline, 0.08))
    packed = flexpm.elastic(Specimen.rectangle(0.04, 0.08, 0.08))
    assert sawn["youngs_modulus"] == pytest.approx(packed["youngs_modulus"], rel=1e-3)


def test_a_hole_within_one_grain():
    hole = circle(0.0101, 0.0103, 0.0006, 8)
    specimen = Specimen.polygon(SQUARE, 0.08, holes=[hole], seed=4)
    require_cells(specimen, area(SQUARE) - area(hole))


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.floats(0.35, 1.0), min_size=5, max_size=12),
    st.floats(0.0, 0.3),
    st.integers(0, 20),
)
def test_any_star_with_a_hole(radii, bore, seed):
    angle = 2.0 * math.pi * np.arange(len(radii)) / len(radii)
    sizes = 0.02 * np.array(radii)
    corners = np.column_stack((sizes * np.cos(angle), sizes * np.sin(angle)))
    # a hole that fits between the centre and the nearest side
    inner = 0.6 * bore * 0.02 * 0.35 * math.cos(math.pi / len(radii))
    holes = [circle(0.0, 0.0, inner, 7)] if inner > 2e-4 else []
    specimen = Specimen.polygon(corners, 0.08, holes=holes, seed=seed)
    require_cells(specimen, area(corners) - sum(map(area, holes)))


@pytest.mark.parametrize(
    ("corners", "holes", "message"),
    [
        ([(0, 0), (0.02, 0.02), (0.02, 0), (0, 0.02)], (), "must not cross or touch side"),
        (SQUARE[:2], (), "polygon: corners = 2, must be >= 3"),
        ([(0, 0), (0.02, 0), (0, 0.0001)], (), "angle at corner 1 = 0.286"),
        (SQUARE, [circle(0.02, 0.01, 0.004)], "hole 0: corner 0 = .* must lie inside the polygon"),
        (
            SQUARE,
            [circle(0.008, 0.01, 0.003), circle(0.012, 0.01, 0.003)],
            "hole 1: corner 0 = .* must lie outside hole 0",
        ),
        ([(0, 0), (math.nan, 0), (0, 1)], (), "must be finite"),
        ("square", (), "not numbers"),
        (SQUARE, "holes", "must be a list of polygons"),
        (1e-2 * np.array(SQUARE), (), "largest diameter = 0.004 m, must be <= half"),
    ],
)
def test_outlines_that_cannot_be(corners, holes, message):
    refusal(message, Specimen.polygon, corners, 0.08, holes=holes)


@pytest.mark.parametrize("model", ["jcfpm", "cohfrict"])
def test_spheres_have_no_sawn_grains(model):
    with pytest.raises(
        InputError, match=f"model = {model}, must be flexible or rigid .* sawn grains"
    ):
        flexpm.run("uniaxial", Specimen.polygon(SQUARE, 0.08), model=model)
