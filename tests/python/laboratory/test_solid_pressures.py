# SPDX-License-Identifier: GPL-3.0-or-later
"""Own tests of solids under pressures: fluids, plates that are pressed and driven, static ones."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError

SIZE, MATERIAL = 0.012, "augig-table7"
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def rig_of(specimen, model="flexible"):
    return flexpm.SolidPartRig(fresh(specimen, MATERIAL, model))


@pytest.fixture(scope="module")
def core():
    return flexpm.Specimen.cylinder(SIZE, 2.0 * SIZE, seed=1)


@pytest.fixture(scope="module")
def box():
    return flexpm.Specimen.box(SIZE, SIZE, 1.5 * SIZE, seed=1)


@pytest.mark.long
@MODELS
def test_a_fluid_on_the_mantle_and_a_plate_press_alike(core, model):
    rig, pressure = rig_of(core, model), 5e6
    base, top = rig.platen(0), rig.platen(2)
    rig.press(top, pressure)
    rig.fluid(pressure, side=1)
    stress = np.array(rig.built.solver.balance()["mean_stress"]) / pressure
    assert stress == pytest.approx([-1.0, -1.0, -1.0, 0.0, 0.0, 0.0], abs=2e-3)
    assert -top.force[2] == pytest.approx(pressure * top.area, rel=1e-3)
    # the pressed plate is driven: its pressure ends, and its force goes on from there
    rig.gauge("wide", (-0.5 * SIZE, 0.0, SIZE), (0.5 * SIZE, 0.0, SIZE), strain=True)
    rig.drive(top, (0, 0, -1), against=base, area=top.area, length=2.0 * SIZE)
    rig.strain_to(5e-4)
    record = rig.record
    assert record["axial_stress"][0] == pytest.approx(pressure, rel=0.05)
    alone = flexpm.elastic(core, MATERIAL, model)
    wide = record["wide"][-1] / record["axial_strain"][-1]
    assert 0.0 < wide < 1.3 * alone["poissons_ratio"]
    names = ("kinetic", "elastic", "damage", "friction", "damping", "drag")
    stored = sum(record[f"{name}_energy"][-1] for name in names) - rig.initial_energy
    assert stored == pytest.approx(record["boundary_work"][-1], rel=1e-4)
    # it follows another pressure
    rig.relax()
    rig.fluid(2e6, side=1)
    stress = rig.built.solver.balance()["mean_stress"]
    assert [-stress[0], -stress[1]] == pytest.approx([2e6, 2e6], rel=5e-3)


def test_sides_that_a_fluid_cannot_press_are_refused(core, box):
    rig = rig_of(core)
    refused = (
        ({"side": 3}, "fluid: side = 3, must be one of 0, 1, 2, the sides of a cylinder"),
        ({}, "fluid: give exactly one of side and hole"),
        ({"side": []}, "fluid: side = none, must be >= 1"),
        ({"side": 1.5}, "fluid: side = 1.5, must be a whole number"),
        ({"side": 1, "hole": 0}, "fluid: give exactly one of side and hole"),
        ({"hole": 0}, "fluid: hole = 0, the specimen has none; give a side"),
    )
    for sides, told in refused:
        refusal(told, rig.fluid, 1e6, **sides)
    refusal("fluid: pressure = -1.0 Pa, must be >= 0", rig.fluid, -1.0, side=1)
    refusal(
        "side = 6, must be one of 0, 1, 2, 3, 4, 5", lambda: rig_of(box).fluid(1e6, side=[1, 6])
    )


@MODELS
def test_a_fluid_in_a_hole_presses_on_its_wall(box, model):
    """A shaft from the top pushes down with the area of its mouth; all sides make a mean stress."""
    top, pressure = 1.5 * SIZE, 5e6
    shaft = {"point": (0.5 * SIZE, 0.5 * SIZE, top), "axis": (0, 0, -1), "diameter": 0.5 * SIZE}
    cut = box.with_holes([{**shaft, "length": 0.5 * SIZE}])
    rig = rig_of(cut, model)
    base = rig.platen(0)
    refusal("fluid: hole = 1, must be <= 0", rig.fluid, pressure, hole=1)
    rig.fluid(pressure, hole=0)
    mouth = SIZE**2 - area_on(cut, 2)
    assert mouth == pytest.approx(0.0625 * np.pi * SIZE**2, rel=0.05)
    assert base.force[2] == pytest.approx(pressure * mouth, rel=3e-3)
    rig.fluid(pressure, side=[1, 2, 3, 4, 5])
    stress = np.array(rig.built.solver.balance()["mean_stress"]) / pressure
    assert stress == pytest.approx([-1.0, -1.0, -1.0, 0.0, 0.0, 0.0], abs=2e-3)
    assert base.force[2] == pytest.approx(pressure * SIZE**2, rel=2e-3)


@pytest.mark.slow
def test_a_thick_ring_under_a_fluid_grows_as_lame_says():
    """Plane stress: the ends are free, and the bottom is held along the axis alone."""
    inner, outer, pressure = 0.004, 0.012, 2e6
    ring = flexpm.Specimen.cylinder(2.0 * outer, 0.008).with_holes(
        [{"point": (0, 0, 0), "axis": (0, 0, 1), "diameter": 2.0 * inner}]
    )
    rock = flexpm.elastic(flexpm.Specimen.cylinder(SIZE, 2.0 * SIZE), MATERIAL, "flexible")
    young, poisson = rock["youngs_modulus"], rock["poissons_ratio"]
    rig = rig_of(ring)
    rig.hold(where=lambda _x, _y, z: z < 1e-9, axes="z")
    rig.fluid(pressure, hole=0)
    state = rig.built.snapshot()
    places, ways = state.reference[:, :2], (state.positions - state.reference)[:, :2]
    radius = np.hypot(*places.T)
    grows = np.einsum("ij,ij->i", places, ways) / radius
    for share in (1.0, 1.5, 2.25, 3.0):
        near = np.abs(radius / inner - share) < 0.03 * share
        mean = radius[near].mean()
        told = (1.0 - poisson) * mean + (1.0 + poisson) * outer**2 / mean
        lame = pressure * inner**2 / (young * (outer**2 - inner**2)) * told
        assert grows[near].mean() == pytest.approx(lame, rel=0.05)


def area_on(specimen, side):
    """Area of the faces on a flat side of a box [m2]."""
    cells, total = specimen.cells, 0.0
    for face in np.flatnonzero(cells.faces[:, 2] == side):
        first, end = cells.face_offsets[face : face + 2]
        corners = cells.vertices[cells.face_vertices[first:end]]
        arms = corners - corners[0]
        total += 0.5 * np.linalg.norm(np.cross(arms[1:-1], arms[2:]).sum(axis=0))
    return total


@MODELS
def test_a_static_solution_under_pressures_is_where_steps_lead(box, model):
    rig = rig_of(box, model)
    walls = {side: rig.platen(side) for side in (0, 3, 5)}
    top, right = rig.platen(2), rig.platen(1)
    pressures = {top: 6e6, right: 2e6}
    refusal("nothing loads the specimen", rig.elastic)
    found = rig.elastic(pressures)
    for part, pressure in pressures.items():
        along = np.dot(part.normal, found.force(part))
        assert along == pytest.approx(pressure * part.area, rel=1e-6)
    assert found.force(walls[0])[2] == pytest.approx(6e6 * top.area, rel=1e-6)
    assert found.force(walls[3])[0] == pytest.approx(2e6 * right.area, rel=1e-6)
    assert found.force(walls[5]) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6 * 6e6 * top.area)
    # a load of what is driven beside a pressure is the same, and pressures superpose
    rig.drive(top, (0, 0, -1), against=walls[0])
    driven = rig.elastic({right: 2e6}, load=6e6 * top.area)
    assert driven.load == pytest.approx(6e6 * top.area)
    assert driven.way == pytest.approx(-found.displacement(top)[2], rel=1e-6)
    assert driven.force(right) == pytest.approx(found.force(right), rel=1e-6)
    far = np.abs(found.positions - found.reference).max()
    assert np.abs(driven.positions - found.positions).max() < 1e-6 * far
    assert rig.elastic().force(top) == rig.elastic({right: 0.0}).force(top) == (0.0, 0.0, 0.0)
    refusal("is driven; leave it out", rig.elastic, {top: 1e6})
    refusal("pressures = 3, must be a table", rig.elastic, 3)
    # a plate without a pressure may move: nothing presses on it
    assert rig.elastic({right: 0.0}, displacement=1e-6).force(right)[0] == pytest.approx(
        0.0, abs=1e-4
    )
    assert rig.elastic(displacement=1e-6).force(right)[0] < -1.0
    assert yade.O.iter == 0
    rig.press(pressures)
    for part in pressures:
        way = np.dot(part.normal, part.displacement)
        assert way == pytest.approx(np.dot(part.normal, found.displacement(part)), rel=0.02)


@pytest.mark.parametrize("strips", [(1e12, None), (1e11, 2e11)])
def test_strips_are_in_series_with_what_is_between_them(box, strips):
    ways = []
    for layers in ((None, None), strips):
        rig = rig_of(box)
        floor, top = (rig.platen(side, strip=one) for side, one in zip((0, 2), layers, strict=True))
        rig.drive(top, (0, 0, -1), against=floor)
        ways.append(rig.elastic(load=100.0).way)
    alone = sum(1.0 / one for one in strips if one is not None) * 100.0 / top.area
    # what bears more evenly gives a little less
    assert ways[1] - ways[0] == pytest.approx(alone, rel=2e-3)
    assert [part.get("strip") for part in rig.parts] == list(strips)
    with pytest.raises(InputError, match="must be given for a bonded or seated .* or a strip"):
        rig.support((0.5 * SIZE, 0.5 * SIZE, 1.5 * SIZE), strip=1e12)


@MODELS
def test_the_load_of_plates_follows_its_set_point(box, model):
    rig = rig_of(box, model)
    base, top = rig.platen(0, bonded=True), rig.platen(2, bonded=True)
    rig.drive(top, (0, 0, 1), against=base, area=top.area, length=1.5 * SIZE, strength=10e6)
    rig.load(flexpm.Loading(kind="waiting", control="load"))
    record = rig.record
    peak = int(np.argmax(record["load"]))
    missed = np.abs(record["load"] - record["set_point"])[: int(0.9 * peak)]
    assert missed.max() < 0.02 * record["load"].max()
    # held nodes have no springs whose forces could be told ahead
    rig = rig_of(box, model)
    low = rig.hold(box=((0, 0, 0), (SIZE, SIZE, 0.3 * SIZE)))
    high = rig.hold(where=lambda _x, _y, z: z > 1.2 * SIZE)
    rig.drive(high, (0, 0, 1), against=low)
    with pytest.raises(InputError, match="control = 'load', must be left out here"):
        rig.load(flexpm.Loading(kind="waiting", control="load"))
