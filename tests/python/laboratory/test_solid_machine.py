# SPDX-License-Identifier: GPL-3.0-or-later
"""Soft machines in space: a pair that softens runs away, static solutions, folders, refusals."""

from __future__ import annotations

import importlib
import json

import numpy as np
import pytest
from soft_machines import require_balance, require_descent

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError

# importing flexpm has told Python where YADE is
yade = importlib.import_module("yade")
SIZE = 0.005
AREA, LENGTH = SIZE**2, 2.0 * SIZE
#: Stiffness and tensile strength of the contact between both grains.
STIFFNESS, STRENGTH = 1e14, 1e6
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def pulled(model: str, energy: float, machine: float | None = None, **leaves: object):
    """Two cubes, one on the other, in a machine; their contact has a fracture energy [N/m]."""
    yade.O.reset()
    half = 0.5 * SIZE
    spheres = np.array([[half, half, half, half], [half, half, 3.0 * half, half]])
    made = flexpm.Specimen.from_spheres(spheres, width=SIZE, depth=SIZE, height=LENGTH)
    law = {
        "normal_stiffness": STIFFNESS,
        "tensile_strength": STRENGTH,
        "cohesion": 1e8,
        "friction": 0.5,
        "tensile_fracture_energy": energy,
        "shear_fracture_energy": 1e3,
    }
    rock = flexpm.materials.load("augig-table2-bilinear", model).with_set(law, model)
    rig = flexpm.SolidPartRig(flexpm.build(made, rock, model), **leaves)
    low, top = rig.platen(0, bonded=True), rig.platen(2, bonded=True)
    rig.drive(top, (0, 0, 1), against=low, area=AREA, length=LENGTH, machine=machine)
    return rig, top


def compliance_of_rest(model: str) -> float:
    """Way over stress of both platens and the cubes, but not of the contact [m/Pa]."""
    rig, _ = pulled(model, 100.0)
    return AREA * 1e-9 / rig.elastic(way=1e-9).load - 1.0 / STIFFNESS


@MODELS
@pytest.mark.parametrize("over", [1.1, 0.9])
def test_a_pair_that_softens_runs_away_in_a_machine_that_is_too_soft(model, over):
    rest = compliance_of_rest(model)
    slope = 1.0 / (2.0 * rest)  # of softening [Pa/m]
    critical = AREA / (1.0 / slope - rest)
    energy = 0.5 * STRENGTH * (STRENGTH / STIFFNESS + STRENGTH / slope)
    rig, top = pulled(model, energy, over * critical)
    require_descent(rig, top, over * critical, STRENGTH * AREA, stable=over > 1.0)
    # two grains run away within some twenty steps, the last of which ends beyond the crack
    require_balance(rig, 1e-5 if over > 1.0 else 2e-3)


@MODELS
def test_static_solutions_are_in_series_with_the_machine(model):
    rest = compliance_of_rest(model)
    machine = 0.5 * AREA / rest
    rig, top = pulled(model, 100.0, machine)
    state = rig.elastic(way=1e-8)
    stiffness = 1.0 / (1.0 / machine + (rest + 1.0 / STIFFNESS) / AREA)
    assert state.load == pytest.approx(stiffness * 1e-8, rel=1e-6)
    assert state.displacement(top)[2] == pytest.approx(1e-8 - state.load / machine, rel=1e-6)
    assert state.way == 1e-8
    assert rig.elastic(load=state.load).way == pytest.approx(1e-8, rel=1e-6)


@pytest.mark.parametrize("counted", [True, False])
def test_a_crosshead_stays_where_it_is_as_a_part_is_pressed(counted):
    """A block on its base under a pressed lid; the part that a machine holds is on its right.

    Whether the load is the mean of both sides' or not, the spring bears what its own part does.
    """
    box = flexpm.Specimen.box(0.012, 0.012, 0.012, seed=1)

    def held(machine: float | None):
        yade.O.reset()
        rig = flexpm.SolidPartRig(flexpm.build(box, "augig-table7"))
        base, lid, wall, jack = (rig.platen(side) for side in (0, 2, 3, 1))
        rig.drive(jack, (-1, 0, 0), against=wall if counted else base, machine=machine)
        return rig, lid, jack

    rig, lid, jack = held(None)
    push = rig.elastic({lid: 1e6}).force(jack)[0]
    machine = -rig.elastic({lid: 0.0}, way=1e-8).force(jack)[0] / 1e-8
    rig, lid, jack = held(machine)
    soft = rig.elastic({lid: 1e6})
    # half of what the wall without a spring would bear
    assert soft.force(jack)[0] == pytest.approx(0.5 * push, rel=1e-4)
    assert soft.way == pytest.approx(0.0, abs=1e-15)
    assert soft.displacement(jack)[0] == pytest.approx(-soft.force(jack)[0] / machine, rel=1e-4)


def test_a_machine_is_given_once_and_to_one_plate_along_its_normal():
    rig, top = pulled("rigid", 100.0)
    up = (0, 0, 1)
    for call, message in (
        (lambda: rig.drive(top, up, machine=0.0), "drive: machine = 0.0 N/m, must be > 0"),
        (lambda: rig.drive(top, (0, 1, 1), machine=1e6), "drive: machine: direction = (0, 0.70"),
    ):
        with pytest.raises(InputError) as error:
            call()
        assert str(error.value).startswith(message), str(error.value)
    rig.drive(top, up, machine=1e6)
    rig.drive(top, up, machine=1e6)  # as a scene that is taken up again does
    with pytest.raises(InputError, match="must be as given before, 1000000"):
        rig.drive(top, up, machine=2e6)
    assert rig.laid["drive"]["machine"] == 1e6
    assert [one.get("machine") for one in rig.parts] == [None, 1e6]
    with pytest.raises(InputError, match="machine = behind a plate that does not load"):
        rig.drive(rig.platen(1), (-1, 0, 0))
    assert [one["gauge"] for one in rig.gauges] == ["crosshead", "machine_energy"]


def test_a_pressed_plate_is_taken_over_by_its_machine():
    """Its force goes on from there, and its crosshead, which begins to count, does not jump."""
    yade.O.reset()
    box = flexpm.Specimen.box(0.012, 0.012, 0.018, seed=1)
    rig = flexpm.SolidPartRig(flexpm.build(box, "augig-table7"))
    base, top = rig.platen(0), rig.platen(2)
    rig.press(top, 5e6)
    stiff = flexpm.elastic(box, "augig-table7")["youngs_modulus"] * top.area / 0.018
    rig.drive(top, (0, 0, -1), against=base, area=top.area, length=0.018, machine=stiff)
    rig.strain_to(5e-4)
    record = rig.record
    grown = record["load"][-1] - 5e6 * top.area
    assert record["load"][0] == pytest.approx(5e6 * top.area, rel=0.02)
    behind = (record["crosshead"] - record["displacement"])[[0, -1]]
    assert behind[1] == pytest.approx(grown / stiff, rel=0.01)
    assert abs(behind[0]) < 0.03 * behind[1]
    assert record["machine_energy"][-1] == pytest.approx(
        0.5 * record["load"][-1] ** 2 / stiff, rel=0.01
    )
    names = ("kinetic", "elastic", "damage", "friction", "damping", "drag")
    stored = sum(record[f"{name}_energy"][-1] for name in names) - rig.initial_energy
    assert stored == pytest.approx(record["boundary_work"][-1], rel=1e-4)


def test_a_soft_machine_in_a_folder_is_made_again_to_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rig, _ = pulled("rigid", 100.0, 1e8, out="first", report=False)
    rig.strain_to(1e-6)
    rig.finish()
    inputs = json.loads((tmp_path / "first" / "result.json").read_text())["inputs"]
    assert inputs["drive"]["machine"] == 1e8
    yade.O.reset()
    assert cli.main(["rerun", "first", "--out", "second", "--no-report"]) == 0
    for name in ("curve.csv", "final.vtu"):
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "second" / name).read_bytes()
