# SPDX-License-Identifier: GPL-3.0-or-later
"""Holes in 3D specimens: volumes, walls, files and refusals. SI units."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refusal

import flexpm
from flexpm.errors import InputError

SIDES = (0.012, 0.012, 0.016)
BORE = {"point": (0.006, 0.0, 0.008), "axis": (0, 2, 0), "diameter": 0.006}
SHAFT = {"low": (0.004, -1.0, 0.005), "high": (0.009, 1.0, 0.011)}
ROOM = {"low": (0.004, 0.003, 0.005), "high": (0.009, 0.009, 0.011)}
SLOT = {"low": (-1.0, -1.0, 0.012), "high": (1.0, 0.004, 1.0)}
FAULT = {"fault": {"point": (0.006, 0.006, 0.008), "dip": 50.0, "dip_direction": 30.0}}


@pytest.fixture(scope="module")
def box():
    return flexpm.Specimen.box(*SIDES)


def wall_vectors(cells, number=0):
    """Area vector of each face on the wall of a hole, into the hole, and a corner of it."""
    vectors, places = [], []
    for face in np.flatnonzero(cells.faces[:, 2] == cells.first_hole + number):
        ends = cells.face_offsets[face : face + 2]
        corners = cells.vertices[cells.face_vertices[ends[0] : ends[1]]]
        arms = corners - corners[0]
        vectors.append(0.5 * np.cross(arms[1:-1], arms[2:]).sum(axis=0))
        places.append(corners[0])
    return np.array(vectors), np.array(places)


def require_closed(cells):
    """Each cell is closed: the area vectors of its faces add up to nothing."""
    sums, size = np.zeros((cells.cells, 3)), 0.0
    for face, (first, second, _) in enumerate(cells.faces):
        ends = cells.face_offsets[face : face + 2]
        corners = cells.vertices[cells.face_vertices[ends[0] : ends[1]]]
        arms = corners - corners[0]
        vector = 0.5 * np.cross(arms[1:-1], arms[2:]).sum(axis=0)
        size = max(size, float(np.linalg.norm(vector)))
        sums[first] += vector
        if second >= 0:
            sums[second] -= vector
    assert np.abs(sums).max() < 1e-12 * size


@pytest.mark.parametrize("hole", [SHAFT, ROOM, {**BORE, "facets": 8}])
def test_a_hole_with_flat_walls_takes_its_volume(box, hole):
    cut = box.with_holes([hole])
    told = cut.told_holes[0]
    section = 0.25 * math.pi * 0.006**2 if "axis" in hole else 0.005 * 0.006
    length = 0.006 if hole is ROOM else 0.012
    assert told.volume == pytest.approx(section * length, rel=1e-12)
    assert told.facets == (10 if "axis" in hole else 6)
    exact = 1e-6 if told.deviation == 0.0 else 0.02
    assert cut.hole_volume == pytest.approx(told.volume, rel=exact)
    whole = math.fsum(cut.cells.volumes) + cut.hole_volume
    assert whole == pytest.approx(math.prod(SIDES), rel=1e-12)
    assert told.deviation < 0.3 * cut.mean_diameter
    require_closed(cut.cells)
    least = cut.meshes().volumes.min()
    assert least > 1e-9 * cut.mean_diameter**3


def test_a_room_within_the_rock_has_a_closed_wall(box):
    """Its area vectors add up to nothing, and the theorem of Gauss gives the removed volume."""
    cut = box.with_holes([ROOM])
    vectors, places = wall_vectors(cut.cells)
    area = cut.told_holes[0].wall_area
    assert np.linalg.norm(vectors, axis=1).sum() == pytest.approx(area, rel=1e-12)
    assert np.abs(vectors.sum(axis=0)).max() < 1e-12 * area
    volume = -np.einsum("ij,ij->", vectors, places) / 3.0
    assert volume == pytest.approx(cut.hole_volume, rel=1e-2)
    exact = 2.0 * (0.005 * 0.006 + 0.006 * 0.006 + 0.005 * 0.006)
    assert area == pytest.approx(exact, rel=0.03)


def test_a_hollow_cylinder_has_the_area_of_its_ring():
    core = flexpm.Specimen.cylinder(0.015, 0.01)
    cut = core.with_holes([{"point": (0, 0, 0), "axis": (0, 0, 1), "diameter": 0.005}])
    told = cut.told_holes[0]
    assert told.volume == pytest.approx(0.25 * math.pi * 0.005**2 * 0.01, rel=1e-12)
    facet = 2.0 * math.sqrt(0.25 * math.pi * 0.005**2 * math.tan(math.pi / 16) / 16)
    assert told.facets == 18
    assert told.wall_area == pytest.approx(16 * facet * 0.01, rel=0.15)
    assert cut.hole_volume == pytest.approx(told.volume, rel=0.03)


def test_holes_joints_and_minerals_are_saved_and_loaded_with_the_same_bits(box, tmp_path):
    minerals = np.arange(len(box.spheres)) % 2
    cut = box.with_minerals(minerals).with_holes([BORE]).with_joints(FAULT).with_holes([SLOT])
    assert (cut.minerals == minerals[cut.grains]).all()
    assert [len(cut.holes), cut.spec.joint_names] == [2, ("fault",)]
    found = cut.told_cuts["fault"]
    assert 0.0 < found.cut < found.within
    # cuts are made again: joints first, then holes in their order
    other = box.with_minerals(minerals).with_joints(FAULT).with_holes([BORE, SLOT])
    assert np.array_equal(other.cells.vertices, cut.cells.vertices)
    cut.save(tmp_path / "solid.json")
    again = flexpm.Specimen.load_solid(tmp_path / "solid.json")
    assert again.spec == cut.spec
    for name in ("spheres", "minerals", "grains", "edge_joints"):
        assert np.array_equal(getattr(again, name), getattr(cut, name))
    for name in ("vertices", "volumes", "faces", "joints"):
        assert np.array_equal(getattr(again.cells, name), getattr(cut.cells, name))
    assert cut.statistics()["holes"][0]["facets"] == 18


def test_a_second_hole_takes_what_the_first_has_left(box):
    """A bore along a shaft: only a segment of its section is left."""
    first, second = box.with_holes([SHAFT, BORE]).told_holes
    assert first.volume == pytest.approx(0.005 * 0.006 * 0.012, rel=1e-12)
    section = 0.25 * math.pi * 0.006**2
    # the shaft spans the diameter along z, and reaches 2 mm to the left and 3 mm to the right
    left = 0.003**2 * math.acos(2.0 / 3.0) - 0.002 * math.sqrt(0.003**2 - 0.002**2)
    assert section > left > 0.0
    assert second.volume == pytest.approx(0.012 * left, rel=0.2)


@pytest.mark.parametrize(
    ("holes", "words"),
    [
        ([], "holes = .*, must be a list of one or more holes"),
        (BORE, "holes = .*, must be a list of one or more holes"),
        ([3], "hole 0 = 3, must be a table"),
        ([{**BORE, "radius": 1.0}], "hole 0: key = 'radius'"),
        ([{"point": (0, 0, 0), "axis": (0, 0, 1)}], "hole 0: diameter is missing"),
        ([{**BORE, "axis": (0, 0, 0)}], "hole 0: axis = .*, must not be zero"),
        ([{**BORE, "axis": (0, 1)}], "hole 0: axis = .*, must be three numbers"),
        ([{**BORE, "diameter": 0.001}], "hole 0: diameter = 0.001 m, must be >= 0.00"),
        ([{**BORE, "length": 1e-4}], "hole 0: length = 0.0001 m, must be >= 0.00"),
        ([{**BORE, "facets": 3}], "hole 0: facets = 3, must be >= 6"),
        ([{"low": (0, 0, 0), "high": (0, 1, 1)}], "hole 0: size along x = 0 m, must be >="),
        ([BORE, BORE], "hole 1 = .*, is hole 0 again; leave it out"),
        ([{**BORE, "point": (1.0, 0, 0)}], "hole 0: volume inside the rock = 0 m3, must be"),
        ([{"low": (-1, -1, -1), "high": (1, 1, 1)}], "holes: cells left = 0, must be >= 1"),
    ],
)
def test_what_is_no_hole_is_refused(box, holes, words):
    refusal(words, box.with_holes, holes)


def test_what_a_specimen_with_holes_cannot_do_is_refused(box):
    cut = box.with_holes([BORE])
    refusal("hole 1 = .*, is hole 0 again", cut.with_holes, [BORE])
    plate = flexpm.Specimen.rectangle(0.02, 0.02, 0.01)
    refusal("with_holes: specimen = .*, must be 3D: .*Specimen.polygon", plate.with_holes, [BORE])
    refusal("without_grains: cells = cut or given", cut.without_grains, [0])
    refusal("model = jcfpm, must be flexible or rigid", cut.spec.require_alike, "jcfpm")
    refusal("joints or holes = ", type(cut).pack, cut.spec)


@settings(max_examples=15, deadline=None)
@given(
    st.tuples(*3 * [st.floats(-1.0, 1.0)]).filter(lambda axis: math.hypot(*axis) > 0.1),
    st.tuples(*3 * [st.floats(0.2, 0.8)]),
    st.floats(0.003, 0.007),
    st.none() | st.floats(0.004, 0.01),
    st.integers(6, 24),
)
def test_any_bore_leaves_sound_cells(box, axis, place, diameter, length, facets):
    point = [one * size for one, size in zip(place, SIDES, strict=True)]
    hole = {"point": point, "axis": axis, "diameter": diameter, "facets": facets}
    try:
        cut = box.with_holes([hole if length is None else {**hole, "length": length}])
    except InputError as error:
        assert "a face is too narrow" in str(error)
        return
    told = cut.told_holes[0]
    require_closed(cut.cells)
    assert cut.meshes().volumes.min() > 0.0
    whole = math.fsum(box.cells.volumes)
    assert math.fsum(cut.cells.volumes) < whole
    # slivers on both sides of the wall, of at most 0.15 mean diameters
    assert abs(cut.hole_volume - told.volume) < 0.15 * cut.mean_diameter * told.wall_area
    assert cut.cells.hole_cuts[0, 1] == pytest.approx(told.volume, rel=0.5)
