# SPDX-License-Identifier: GPL-3.0-or-later
"""Soft machines: a bar with a weak line runs away if its machine is too soft; energy; refusals."""

from __future__ import annotations

import json

import numpy as np
import pytest
from soft_machines import require_balance, require_descent

import flexpm  # isort: skip  (first: it tells Python where YADE is)
import yade

from flexpm.cli import main as cli
from flexpm.errors import InputError

WIDTH, THICKNESS, CELLS = 0.01, 0.01, 6
LENGTH, AREA = 0.5 * CELLS * WIDTH, WIDTH * THICKNESS
#: Stiffness and tensile strength of the weak line.
STIFFNESS, STRENGTH = 1e14, 1e6


def bar_of_cells() -> flexpm.Specimen:
    """Cells in two columns, a line between the middle rows."""
    places = [(0.5 * WIDTH * i, 0.5 * WIDTH * j) for j in range(CELLS) for i in range(2)]
    square = 0.5 * WIDTH * np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    cells = [square + place for place in places]
    made = flexpm.Specimen.from_polygons(cells, THICKNESS)
    return made.with_joints({"weak": [[-WIDTH, 0.5 * LENGTH], [2 * WIDTH, 0.5 * LENGTH]]})


def pulled(model: str, energy: float, machine: float | None = None, **leaves: object):
    """The bar in a machine, its line with a fracture energy [N/m]."""
    yade.O.reset()
    law = {
        "normal_stiffness": STIFFNESS,
        "shear_stiffness": 0.4 * STIFFNESS,
        "tensile_strength": STRENGTH,
        "cohesion": 1e8,
        "friction": 0.5,
        "tensile_fracture_energy": energy,
        "shear_fracture_energy": 1e3,
    }
    rock = flexpm.materials.load("augig-table2-bilinear", model)
    rock = rock.with_set({f"joint.weak.{key}": value for key, value in law.items()}, model)
    rig = flexpm.PartRig(flexpm.build(bar_of_cells(), rock, model), **leaves)
    low, top = rig.platen(0, friction=0.5, bonded=True), rig.platen(2, bonded=True)
    rig.drive(top, (0.0, 1.0), against=low, area=AREA, length=LENGTH, machine=machine)
    return rig, top


def compliance_of_rest(model: str) -> float:
    """L / E of the bar with its contacts but the line [m/Pa]."""
    rig, _ = pulled(model, 100.0)
    return AREA * 1e-9 / rig.elastic(way=1e-9).load - 1.0 / STIFFNESS


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("over", [1.05, 0.95])
def test_a_bar_with_a_weak_line_runs_away_in_a_machine_that_is_too_soft(model, over):
    rest = compliance_of_rest(model)
    slope = 1.0 / (2.0 * rest)  # of softening [Pa/m]
    critical = AREA / (1.0 / slope - rest)
    energy = 0.5 * STRENGTH * (STRENGTH / STIFFNESS + STRENGTH / slope)
    rig, top = pulled(model, energy, over * critical)
    require_descent(rig, top, over * critical, STRENGTH * AREA, stable=over > 1.0)
    require_balance(rig, 1e-4)


def test_the_static_solution_is_in_series_with_the_machine():
    rest = compliance_of_rest("flexible")
    machine = 0.5 * AREA / rest
    rig, top = pulled("flexible", 100.0, machine)
    state = rig.elastic(way=1e-8)
    stiffness = 1.0 / (1.0 / machine + (rest + 1.0 / STIFFNESS) / AREA)
    assert state.load == pytest.approx(stiffness * 1e-8, rel=1e-6)
    assert state.displacement(top)[1] == pytest.approx(1e-8 - state.load / machine, rel=1e-6)
    assert state.way == 1e-8
    same = rig.elastic(load=state.load)
    assert same.way == pytest.approx(1e-8, rel=1e-6)


def test_a_machine_is_given_once_and_to_one_plate_along_its_normal():
    rig, top = pulled("rigid", 100.0)
    low = rig._all_parts[0]
    up = (0.0, 1.0)
    for call, message in (
        (lambda: rig.drive(top, up, machine=0.0), "drive: machine = 0.0 N/m, must be > 0"),
        (lambda: rig.drive(top, up, machine=-1.0), "drive: machine = -1.0 N/m, must be > 0"),
        (lambda: rig.drive(top, up, machine=np.nan), "drive: machine = nan"),
        (lambda: rig.drive(top, up, machine="k"), "drive: machine = 'k'"),
        (lambda: rig.drive([top, low], up, machine=1e6), "drive: machine: parts = others than one"),
        (lambda: rig.drive(top, (1.0, 1.0), machine=1e6), "drive: machine: direction = (0.70"),
    ):
        with pytest.raises(InputError) as error:
            call()
        assert str(error.value).startswith(message), str(error.value)
        assert "\n" not in str(error.value)
    rig.drive(top, up, machine=1e6)
    rig.drive(top, up, machine=1e6)  # as a scene that is taken up again does
    with pytest.raises(InputError, match="must be as given before, 1000000"):
        rig.drive(top, up, machine=2e6)
    assert rig.laid["drive"]["machine"] == 1e6
    assert [one["gauge"] for one in rig.gauges] == ["crosshead", "machine_energy"]


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
