# SPDX-License-Identifier: GPL-3.0-or-later
"""A specimen that counts as balanced under a pressure bears it: stress and force in closed form."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import failure
from scenes import fresh

import flexpm
from flexpm.rigs import rig as rigs
from flexpm.rigs.part_rig import PartRig

PRESSURE = 10e6
THICKNESS = 0.01
#: What balance is asked for [-].
SHARE = 1e-3

SIZES = [
    (0.02, 1),
    (0.02, 3),
    (0.04, 1),
    pytest.param(0.08, 1, marks=pytest.mark.slow),  # the paper's size, 1630 grains
    pytest.param(0.25, 1, marks=pytest.mark.slow),  # 16 000 grains
]


def built(width: float, seed: int, model: str) -> flexpm.Model:
    specimen = flexpm.Specimen.rectangle(width, 2.0 * width, THICKNESS, seed=seed)
    return fresh(specimen, model=model)


def stresses(model: flexpm.Model) -> np.ndarray:
    """Mean pressure along x and y over the one that acts [-]."""
    return -np.array(model.solver.balance()["mean_stress"][:2]) / PRESSURE


def reaction(model: flexpm.Model) -> float:
    """Force of what holds the bottom [N]."""
    if plates := model.solver.plates():
        return plates[0]["force"][1]
    bodies, ids = yade.O.bodies, model.solver.bodyIds
    nodes = model.solver.sideNodes(rigs.BOTTOM).tolist()
    return -sum(bodies[ids[grain]].shape.forces[node][1] for grain, node in nodes)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize(("width", "seed"), SIZES)
def test_the_mean_stress_is_the_pressure_when_forces_balance(width, seed, model):
    """And it stays so: no wave that runs on has just passed through its middle."""
    grains = built(width, seed, model)
    flexpm.rig(grains).confine(PRESSURE)
    # volumes and forces are those of the deformed specimen: 0.03 % at this pressure
    share = SHARE + 3e-4
    force = PRESSURE * width * THICKNESS
    steps = yade.O.iter
    for _ in range(4):
        assert stresses(grains) == pytest.approx([1.0, 1.0], abs=share)
        assert reaction(grains) == pytest.approx(force, rel=share)
        for _ in range(steps // 4):
            yade.O.step()
    assert stresses(grains) == pytest.approx([1.0, 1.0], abs=share)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("width", [0.02, 0.04])
def test_what_holds_against_a_pressed_part_bears_its_force(width, model):
    grains = built(width, 1, model)
    rig = PartRig(grains)
    floor, lid = rig.platen(rigs.BOTTOM), rig.platen(rigs.TOP)
    walls = rig.platen(rigs.LEFT), rig.platen(rigs.RIGHT)
    rig.drive([floor], (0.0, 1.0))
    rig.press(lid, PRESSURE)
    force = PRESSURE * width * THICKNESS
    steps = yade.O.iter
    for _ in range(4):
        assert lid.force[1] == pytest.approx(-force, rel=SHARE)
        assert floor.force[1] == pytest.approx(force, rel=SHARE)
        assert stresses(grains)[1] == pytest.approx(1.0, abs=SHARE + 3e-4)
        assert walls[0].force[0] == pytest.approx(-walls[1].force[0], rel=2.0 * SHARE)
        for _ in range(steps // 4):
            yade.O.step()


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("pressure", [4e6, 12e6])
def test_a_confined_loading_begins_at_the_pressure(model, pressure):
    """Rows of its first tenth stand on the pressure and the modulus, a few steps of waves apart."""
    specimen = flexpm.Specimen.rectangle(0.04, 0.08, THICKNESS, seed=1)
    young = flexpm.elastic(specimen, model=model)["youngs_modulus"]
    rig = flexpm.rig(fresh(specimen, model=model))
    rig.confine(pressure)
    rig.strain_to(2e-4)
    record = rig.record
    expected = pressure + young * record["axial_strain"]
    early = record["axial_strain"] < 1e-4
    assert record["axial_stress"][0] == pytest.approx(expected[0], abs=0.01 * pressure)
    assert record["axial_stress"][early] == pytest.approx(expected[early], rel=0.015)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("pressure", [4e6, 12e6])
def test_the_first_row_of_a_run_stands_on_the_pressure(model, pressure):
    """At its fastest a row is few steps: a zero of the strain one step late would show."""
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, THICKNESS, seed=1)
    young = flexpm.elastic(specimen, model=model)["youngs_modulus"]
    record = flexpm.run("biaxial", specimen, model=model, confinement=pressure, max_strain=3e-4)
    for row in range(3):
        expected = pressure + young * record.curve["axial_strain"][row]
        assert record.curve["axial_stress"][row] == pytest.approx(expected, rel=0.01)


def test_a_wave_shows_in_the_mean_stress(monkeypatch):
    """Each node is nearly in balance meanwhile: to look at nodes alone is not enough."""
    grains = built(0.04, 1, "flexible")
    rig = flexpm.rig(grains)
    monkeypatch.setattr(rigs, "AT_REST", np.inf)
    rig.confine(PRESSURE)
    assert rig.unbalanced() < 0.01
    assert rig.balance().largest > 3.0 * SHARE


@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm", "cohfrict"])
def test_a_pressure_that_is_not_borne_is_refused_in_one_line(model, monkeypatch):
    monkeypatch.setattr(rigs, "REST_CROSSINGS", 1)
    monkeypatch.setattr(rigs, "AT_REST", 1e-6)
    rig = flexpm.rig(built(0.02, 1, model))
    line = r"confine: imbalance = .* of 1e\+07 Pa \(reactions .*, mean stress .*, motion .*\), must"
    failure(line, rig.confine, PRESSURE)


def test_waves_that_nothing_damps_are_named():
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, THICKNESS, seed=1)
    rig = flexpm.rig(fresh(specimen, model="rigid", dynamic=True, damping=0.0))
    failure(r"damping = 0, take 0\.2 or above", rig.confine, PRESSURE)


@pytest.mark.parametrize("model", ["jcfpm", "cohfrict"])
def test_spheres_balance_too(model):
    rig = flexpm.rig(built(0.02, 1, model))
    rig.confine(PRESSURE)
    assert rig.balance().largest < SHARE
    for _ in range(yade.O.iter):
        yade.O.step()
    assert rig.balance().largest < SHARE


@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm"])
def test_a_pressure_rises_as_gently_after_other_steps(model):
    """Where it counted from step 0 it was there at once, waves had up to 64 times the energy."""
    steps, motion = [], []
    for before in (0, 500):
        grains = built(0.02, 1, model)
        rig = flexpm.rig(grains)
        for _ in range(before):
            yade.O.step()
        largest = [0.0]

        def look(_, grains=grains, largest=largest):
            if model == "jcfpm":
                now = yade.utils.kineticEnergy()
            else:
                now = grains.solver.energies()["kinetic_energy"]
            largest[0] = max(largest[0], now)

        rig.watch = look
        rig.confine(PRESSURE)
        steps.append(yade.O.iter - before)
        motion += largest
    assert steps[1] == steps[0]
    assert motion[1] == pytest.approx(motion[0], rel=0.01)


def test_a_pressure_that_is_raised_goes_on_from_where_it_was():
    grains = built(0.02, 1, "flexible")
    rig, there = flexpm.rig(grains), []
    rig.confine(0.5 * PRESSURE)
    rig.watch = lambda _: there.append(stresses(grains)[1])
    rig.confine(PRESSURE)
    assert min(there) > 0.499
    assert max(there) < 1.02
    assert there[-1] == pytest.approx(1.0, abs=SHARE + 3e-4)


def test_a_part_that_is_pressed_again_goes_on_from_its_pressure():
    rig, there = PartRig(built(0.02, 1, "rigid")), []
    floor, lid = rig.platen(rigs.BOTTOM), rig.platen(rigs.TOP, friction=0.5)
    rig.drive([floor], (0.0, 1.0))
    rig.press(lid, 0.5 * PRESSURE)
    rig.watch = lambda _: there.append(-lid.force[1] / (PRESSURE * 0.02 * THICKNESS))
    rig.press(lid, PRESSURE)
    assert min(there) > 0.499
    assert there[-1] == pytest.approx(1.0, abs=SHARE)
