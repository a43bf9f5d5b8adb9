# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates of solids on a spherical seat: no moment there, static solutions, round faces, folders."""

from __future__ import annotations

import importlib

import numpy as np
import pytest

import flexpm

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
    place, edge = (0.5 * SIZE, 0.0, 0.5 * SIZE), 0.4 * SIZE
    plate = rig.support(place, edge, normal=(-1, 0, 0), seated=True, strip=1e13)
    base = rig.hold(box=((-SIZE, -SIZE, 0.0), (SIZE, SIZE, 0.3 * SIZE)))
    laid = np.array(plate.angle)
    assert laid[0] == 0.0
    assert 1e-4 < np.linalg.norm(laid) < 0.5
    assert rig.parts[0]["seated"]
    assert "seated" not in rig.parts[1]
    rig.press(plate, 2e6)
    pushed = 2e6 * plate.area
    assert -plate.force[0] == pytest.approx(pushed, rel=2e-3)
    assert base.force[0] == pytest.approx(pushed, rel=2e-3)
    assert np.linalg.norm(np.array(plate.angle) - laid) > 0.0
