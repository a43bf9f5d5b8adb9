# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates of solids on a spherical seat: no moment there, static solutions, round faces, folders."""

from __future__ import annotations

import importlib

import numpy as np
import pytest

import flexpm
from flexpm.errors import InputError

# importing flexpm has told Python where YADE is
yade = importlib.import_module("yade")
SIZE = 0.012
DOWN = (0, 0, -1)
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def block(model: str, *, seated: bool):
    """A block that is held at one half of its base, below a platen, and both parts."""
    yade.O.reset()
    box = flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(flexpm.build(box, "augig-table7", model))
    base = rig.hold(box=((0, 0, 0), (0.6 * SIZE, SIZE, 0.2 * SIZE)))
    top = rig.platen(2, seated=seated)
    rig.drive(top, DOWN, against=base)
    return rig, base, top


def eccentricity(force: np.ndarray, moment: np.ndarray, base, middle: np.ndarray) -> float:
    """How far the load is off the middle of the platen, by what the base bears, in sizes [-]."""
    whole = moment + np.cross(np.array(base.place) - middle, force)
    return float(np.hypot(*whole[:2]) / abs(force[2]) / SIZE)


@MODELS
def test_a_seated_platen_loads_through_its_middle(model):
    """What holds the block bears a moment about the seat only if the platen is not seated."""
    found = {}
    for seated in (False, True):
        rig, base, top = block(model, seated=seated)
        middle = np.array(top.place)
        state = rig.elastic(way=1e-8)
        linear = eccentricity(
            *(np.array(of(base)) for of in (state.force, state.moment)), base, middle
        )
        if seated:
            rig.angle_of("tilt", top)
        rig.strain_to(2e-6)
        rig.relax()
        stepped = eccentricity(np.array(base.force), np.array(base.moment), base, middle)
        found[seated] = linear, stepped
    assert max(found[True]) < 1e-3
    assert min(found[False]) > 0.05
    # it goes down where nothing is below, at larger x
    angle = np.array(state.angle(top))
    assert angle[1] > 5.0 * abs(angle[0])
    assert angle[2] == 0.0
    factor = top.displacement[2] / state.displacement(top)[2]
    assert np.array(top.angle) == pytest.approx(
        factor * angle, rel=0.1, abs=0.05 * factor * angle[1]
    )
    assert rig.record["tilt"][-1] == pytest.approx(np.linalg.norm(top.angle), rel=0.01)
    energies = rig.built.solver.energies()
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert sum(energies.values()) == pytest.approx(given, rel=1e-5)


@MODELS
def test_seats_lie_down_on_a_mantle_and_press_evenly(model):
    """Facets of a mantle are inclined to a plate before it; the nearest three bear it at first."""
    yade.O.reset()
    core = flexpm.Specimen.cylinder(SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(flexpm.build(core, "augig-table7", model))
    place, edge = (0.5 * SIZE, 0.0, 0.65 * SIZE), 0.4 * SIZE
    plate = rig.support(place, edge, normal=(-1, 0, 0), seated=True, strip=1e13)
    base = rig.hold(box=((-SIZE, -SIZE, 0.0), (SIZE, SIZE, 0.15 * SIZE)))
    laid = np.array(plate.angle)
    assert laid[0] == 0.0
    assert 1e-4 < np.linalg.norm(laid) < 0.5
    assert rig.parts[0]["seated"]
    assert "seated" not in rig.parts[1]
    state = rig.elastic({plate: 2e6})
    turned = np.array(state.angle(plate)) - laid
    assert np.linalg.norm(turned) < 0.05
    rig.press(plate, 2e6)
    pushed = 2e6 * plate.area
    assert -plate.force[0] == pytest.approx(pushed, rel=2e-3)
    assert base.force[0] == pytest.approx(pushed, rel=2e-3)
    assert np.linalg.norm(np.array(plate.angle) - laid) > 0.0
    rig.drive(plate, (-1, 0, 0), against=base)
    before = rig.built.solver.energies()
    rig.strain_to(1e-6)
    energies = rig.built.solver.energies()
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert sum(energies.values()) == pytest.approx(given, rel=1e-3)
    assert energies["elastic_energy"] > before["elastic_energy"]


@MODELS
@pytest.mark.parametrize("turned", [0.0, 40.0, 90.0, 200.0])
def test_a_plate_that_was_laid_on_a_mantle_loads_it_at_once(model, turned):
    """What it lies on counts as touched, wherever it lies: static solutions and steps agree."""
    yade.O.reset()
    core = flexpm.Specimen.cylinder(SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(flexpm.build(core, "augig-table7", model))
    x, y = np.cos(np.radians(turned)), np.sin(np.radians(turned))
    base = rig.hold(box=((-SIZE, -SIZE, 0.0), (SIZE, SIZE, 0.15 * SIZE)))
    place = (0.5 * SIZE * x, 0.5 * SIZE * y, 0.65 * SIZE)
    plate = rig.support(place, 0.4 * SIZE, normal=(-x, -y, 0), seated=True)
    assert np.linalg.norm(np.array(plate.place)[:2]) == pytest.approx(0.5 * SIZE, rel=0.06)
    rig.drive(plate, (-x, -y, 0), against=base)
    state = rig.elastic(way=1e-8)
    rig.strain_to(1e-7)
    load, way = rig.record["load"][-1], rig.record["displacement"][-1]
    # few contacts bear at first, more as it goes on
    assert 0.3 * state.load / 1e-8 < load / way < 3.0 * state.load / 1e-8
    energies = rig.built.solver.energies()
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert sum(energies.values()) == pytest.approx(given, rel=1e-3)


def test_seats_alone_are_refused():
    yade.O.reset()
    rig = flexpm.SolidPartRig(flexpm.build(flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)))
    low, top = rig.platen(0, seated=True), rig.platen(2, seated=True)
    rig.drive(top, DOWN, against=low)
    with pytest.raises(InputError, match="load: parts = all seated, must hold"):
        rig.strain_to(1e-6)


@MODELS
def test_a_pressed_plate_bears_its_pressure_beside_a_soft_machine(model):
    """Also where a load is asked for, of which the machine gives a part of the way."""
    yade.O.reset()
    box = flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(flexpm.build(box, "augig-table7", model))
    low, top, left, right = (rig.platen(side) for side in (0, 2, 3, 1))
    rig.drive(top, DOWN, against=low, machine=1e8)
    state = rig.elastic({left: 1e6, right: 1e6}, load=1e3)
    assert state.load == pytest.approx(1e3)
    assert state.force(left)[0] == pytest.approx(1e6 * left.area, rel=1e-3)
    assert state.force(right)[0] == pytest.approx(-1e6 * right.area, rel=1e-3)
