# SPDX-License-Identifier: GPL-3.0-or-later
"""Soft machines: what softens runs away if its machine is too soft; energy, folders, refusals."""

from __future__ import annotations

import json

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh, require_balance
from soft_machines import require_descent

import flexpm
from flexpm.cli import main as cli

#: A bar of square cells with a weak line between its middle rows, or two cubes, one on the other.
WIDTH, CELLS, CUBE = 0.01, 6, 0.005
AREA = {2: WIDTH * 0.01, 3: CUBE**2}
LENGTH = {2: 0.5 * CELLS * WIDTH, 3: 2.0 * CUBE}
UP = {2: (0.0, 1.0), 3: (0.0, 0.0, 1.0)}
#: Stiffness and tensile strength of the line, or of the contact between the cubes.
STIFFNESS, STRENGTH = 1e14, 1e6
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])
DIMENSIONS = pytest.mark.parametrize("dimension", [2, 3])


def softening(dimension: int) -> flexpm.Specimen:
    if dimension == 3:
        half = 0.5 * CUBE
        spheres = np.array([[half, half, half, half], [half, half, 3.0 * half, half]])
        sizes = {"width": CUBE, "depth": CUBE, "height": LENGTH[3]}
        return flexpm.Specimen.from_spheres(spheres, **sizes)
    places = [(0.5 * WIDTH * i, 0.5 * WIDTH * j) for j in range(CELLS) for i in range(2)]
    square = 0.5 * WIDTH * np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    made = flexpm.Specimen.from_polygons([square + place for place in places], 0.01)
    return made.with_joints({"weak": [[-WIDTH, 0.5 * LENGTH[2]], [2 * WIDTH, 0.5 * LENGTH[2]]]})


def pulled(dimension: int, model: str, energy: float, machine: float | None = None, **leaves):
    """The specimen in a machine, what softens with a fracture energy [N/m]."""
    yade.O.reset()
    law = {
        **{"normal_stiffness": STIFFNESS, "tensile_strength": STRENGTH, "cohesion": 1e8},
        **{"friction": 0.5, "tensile_fracture_energy": energy, "shear_fracture_energy": 1e3},
    }
    if dimension == 2:
        law["shear_stiffness"] = 0.4 * STIFFNESS
        law = {f"joint.weak.{key}": value for key, value in law.items()}
    rock = flexpm.materials.load("augig-table2-bilinear", model).with_set(law, model)
    rig = flexpm.PartRig(flexpm.build(softening(dimension), rock, model), **leaves)
    low = rig.platen(0, friction=0.5 if dimension == 2 else 0.0, bonded=True)
    top = rig.platen(2, bonded=True)
    sizes = {"area": AREA[dimension], "length": LENGTH[dimension]}
    rig.drive(top, UP[dimension], against=low, machine=machine, **sizes)
    return rig, top


def compliance_of_rest(dimension: int, model: str) -> float:
    """Way over stress of the specimen and its platens, but not of what softens [m/Pa]."""
    rig, _ = pulled(dimension, model, 100.0)
    return AREA[dimension] * 1e-9 / rig.elastic(displacement=1e-9).load - 1.0 / STIFFNESS


@MODELS
@pytest.mark.parametrize(("dimension", "over"), [(2, 1.05), (2, 0.95), (3, 1.1), (3, 0.9)])
def test_what_softens_runs_away_in_a_machine_that_is_too_soft(model, dimension, over):
    rest, area = compliance_of_rest(dimension, model), AREA[dimension]
    slope = 1.0 / (2.0 * rest)  # of softening [Pa/m]
    critical = area / (1.0 / slope - rest)
    energy = 0.5 * STRENGTH * (STRENGTH / STIFFNESS + STRENGTH / slope)
    rig, top = pulled(dimension, model, energy, over * critical)
    require_descent(rig, top, over * critical, STRENGTH * area, stable=over > 1.0)
    # two grains run away within some twenty steps, the last of which ends beyond the crack
    require_balance(rig, 1e-4 if dimension == 2 else 1e-5 if over > 1.0 else 2e-3)


@DIMENSIONS
@MODELS
def test_static_solutions_are_in_series_with_the_machine(dimension, model):
    rest, area = compliance_of_rest(dimension, model), AREA[dimension]
    machine = 0.5 * area / rest
    rig, top = pulled(dimension, model, 100.0, machine)
    state = rig.elastic(displacement=1e-8)
    stiffness = 1.0 / (1.0 / machine + (rest + 1.0 / STIFFNESS) / area)
    assert state.load == pytest.approx(stiffness * 1e-8, rel=1e-6)
    assert state.displacement(top)[-1] == pytest.approx(1e-8 - state.load / machine, rel=1e-6)
    assert state.way == 1e-8
    assert rig.elastic(load=state.load).way == pytest.approx(1e-8, rel=1e-6)


@pytest.mark.parametrize("counted", [True, False])
def test_a_crosshead_stays_where_it_is_as_a_part_is_pressed(counted):
    """A block on its base under a pressed lid; the part that a machine holds is on its right.

    Whether the load is the mean of both sides' or not, the spring bears what its own part does.
    """
    box = flexpm.Specimen.box(0.012, 0.012, 0.012, seed=1)

    def held(machine: float | None):
        rig = flexpm.PartRig(fresh(box, "augig-table7"))
        base, lid, wall, jack = (rig.platen(side) for side in (0, 2, 3, 1))
        rig.drive(jack, (-1, 0, 0), against=wall if counted else base, machine=machine)
        return rig, lid, jack

    rig, lid, jack = held(None)
    push = rig.elastic({lid: 1e6}).force(jack)[0]
    machine = -rig.elastic({lid: 0.0}, displacement=1e-8).force(jack)[0] / 1e-8
    rig, lid, jack = held(machine)
    soft = rig.elastic({lid: 1e6})
    # half of what the wall without a spring would bear
    assert soft.force(jack)[0] == pytest.approx(0.5 * push, rel=1e-4)
    assert soft.way == pytest.approx(0.0, abs=1e-15)
    assert soft.displacement(jack)[0] == pytest.approx(-soft.force(jack)[0] / machine, rel=1e-4)


@DIMENSIONS
def test_a_machine_is_given_once_and_to_one_plate_along_its_normal(dimension):
    rig, top = pulled(dimension, "rigid", 100.0)
    both, up = [top, rig._all_parts[0]], UP[dimension]
    side = np.array([-1.0, *[0.0] * (dimension - 1)])
    for parts, way, machine, message in (
        (top, up, 0.0, "drive: machine = 0.0 N/m, must be > 0"),
        (top, up, -1.0, "drive: machine = -1.0 N/m, must be > 0"),
        (top, up, np.nan, "drive: machine = nan"),
        (top, up, "k", "drive: machine = 'k'"),
        (both, up, 1e6, "drive: a machine needs exactly one driven plate"),
        (top, up - side, 1e6, "drive: machine: direction = (0.70"),
    ):
        assert refusal("", rig.drive, parts, way, machine=machine).startswith(message)
    rig.drive(top, up, machine=1e6)
    rig.drive(top, up, machine=1e6)  # as a scene that is taken up again does
    refusal("must be as given before, 1000000", rig.drive, top, up, machine=2e6)
    assert rig.layout["drive"]["machine"] == 1e6
    assert [one.get("machine") for one in rig.parts] == [None, 1e6]
    refusal("machine is behind a plate that does not load", rig.drive, rig.platen(1), side)
    assert [one["gauge"] for one in rig.gauges] == ["crosshead_displacement", "machine_energy"]


def test_a_pressed_plate_is_taken_over_by_its_machine():
    """Its force goes on from there, and its crosshead, which begins to count, does not jump."""
    box = flexpm.Specimen.box(0.012, 0.012, 0.018, seed=1)
    rig = flexpm.PartRig(fresh(box, "augig-table7"))
    base, top = rig.platen(0), rig.platen(2)
    rig.press(top, 5e6)
    stiff = flexpm.elastic(box, "augig-table7")["youngs_modulus"] * top.area / 0.018
    rig.drive(top, (0, 0, -1), against=base, area=top.area, length=0.018, machine=stiff)
    rig.strain_to(5e-4)
    record = rig.record
    grown = record["load"][-1] - 5e6 * top.area
    assert record["load"][0] == pytest.approx(5e6 * top.area, rel=0.02)
    behind = (record["crosshead_displacement"] - record["displacement"])[[0, -1]]
    assert behind[1] == pytest.approx(grown / stiff, rel=0.01)
    assert abs(behind[0]) < 0.03 * behind[1]
    stored = 0.5 * record["load"][-1] ** 2 / stiff
    assert record["machine_energy"][-1] == pytest.approx(stored, rel=0.01)
    names = ("kinetic", "elastic", "damage", "friction", "damping", "drag")
    stored = sum(record[f"{name}_energy"][-1] for name in names) - rig.initial_energy
    assert stored == pytest.approx(record["boundary_work"][-1], rel=1e-4)


@DIMENSIONS
def test_a_soft_machine_in_a_folder_is_made_again_to_the_same_bytes(
    dimension, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    rig, _ = pulled(dimension, "rigid", 100.0, 1e8, out="first", report=False)
    rig.strain_to(1e-6)
    rig.finish()
    inputs = json.loads((tmp_path / "first" / "result.json").read_text())["inputs"]
    assert inputs["drive"]["machine"] == 1e8
    yade.O.reset()
    assert cli.main(["rerun", "first", "--out", "second", "--no-report"]) == 0
    for name in ("curve.csv", "final.vtu"):
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "second" / name).read_bytes()
