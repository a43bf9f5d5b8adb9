# SPDX-License-Identifier: GPL-3.0-or-later
"""Punch-through shear in 2D and 3D: bridges that are one joint, rock, refusals."""

from __future__ import annotations

import json

import numpy as np
import pytest
from refusals import refusal, refused_command

import flexpm
from flexpm import Specimen
from flexpm.cli.main import main
from flexpm.errors import InputError
from flexpm.laboratory.carrying_out import carry_out
from flexpm.laboratory.plan import plan_run
from flexpm.materials.material import default_name
from flexpm.runs.run_spec import RunSpec
from flexpm.specimens.space.notch import notched

WIDTH, HEIGHT, THICKNESS = 0.04, 0.024, 0.01
NOTCH, DISTANCE = 0.005, 0.016
PRESSURE, FRICTION, COHESION = 2e6, 0.5, 2e6
LAW = {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": FRICTION}
BONDED = {"cohesion": COHESION, "tensile_strength": 1e6, "shear_fracture_energy": 20.0}
SMALL = ["--width", "0.04", "--height", "0.024", "--quiet"]


@pytest.fixture(scope="module")
def bridged() -> flexpm.Specimen:
    """A rectangle whose two bridges are one joint each."""
    whole = flexpm.Specimen.rectangle(WIDTH, HEIGHT, thickness=THICKNESS, seed=1)
    places = [0.5 * (WIDTH + side * DISTANCE) for side in (-1.0, 1.0)]
    return whole.with_joints({"bridge": [[(x, NOTCH), (x, HEIGHT - NOTCH)] for x in places]})


def punched(specimen: flexpm.Specimen, model: str, law: dict[str, float], **options: float):
    values = {f"joint.bridge.{key}": value for key, value in (LAW | law).items()}
    material = flexpm.materials.load("augig-table7").with_set(values)
    options = {"model": model, "notch": NOTCH, "distance": DISTANCE} | options
    spec = RunSpec.from_options("punch", options, material, specimen.spec)
    return carry_out(plan_run(spec, specimen, material))


def bridges(result: flexpm.Result) -> float:
    """Length of both bridges as cut, over twice the height [-]."""
    return 1.0 - 2.0 * result.notch_depth / HEIGHT


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_bridges_without_cohesion_carry_the_friction_of_the_pressure(bridged, model):
    """What presses on the sides goes through the bridges alone: mu p H over their length."""
    result = punched(bridged, model, {}, confinement=PRESSURE)
    stress = FRICTION * PRESSURE / bridges(result)
    assert result.status == "ok"
    assert result.peak_stress is None and not result.failed
    assert result.curve["shear_stress"].max() == pytest.approx(stress, rel=0.01)
    assert result.residual_strength == pytest.approx(stress, rel=2e-3)
    load = 2.0 * FRICTION * PRESSURE * HEIGHT * THICKNESS
    assert result.curve["load"][-1] == pytest.approx(load, rel=2e-3)
    assert result.energy_error < 1e-3
    assert result.tensile_cracks == result.shear_cracks == 0


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_bonded_bridges_carry_cohesion_and_friction_then_friction(bridged, model):
    """They soften from their tips on: a little less than both at once."""
    result = punched(bridged, model, BONDED, confinement=PRESSURE)
    rest = FRICTION * PRESSURE / bridges(result)
    assert result.status == "ok"
    assert 0.95 * (COHESION + rest) < result.peak_stress <= 1.01 * (COHESION + rest)
    assert result.residual_strength == pytest.approx(rest, rel=0.01)
    area = 2.0 * bridges(result) * HEIGHT * THICKNESS
    assert result.peak_load == pytest.approx(result.peak_stress * area, rel=1e-12)
    assert result.curve["damage_energy"][-1] == pytest.approx(20.0 * area, rel=0.02)
    load, way = result.curve["load"], result.curve["displacement"]
    work = np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(way))
    assert result.fracture_energy == pytest.approx(work / area, rel=1e-12)


def test_without_walls_bridges_carry_their_cohesion_alone(bridged):
    result = punched(bridged, "rigid", BONDED | {"tensile_strength": 1e8}, max_displacement=1e-5)
    assert 0.88 * COHESION < result.peak_stress <= 1.01 * COHESION


@pytest.mark.long
def test_rock_is_run_compared_and_run_again(tmp_path, capsys):
    asked = ["punch", *SMALL, "--confinement", "2e6", "--distance", "0.018"]
    first = tmp_path / "first"
    assert main(["run", *asked, "--model", "rigid", "--out", str(first)]) == 0
    told = capsys.readouterr().out
    assert "peak shear stress" in told and "residual strength" in told
    content = json.loads((first / "result.json").read_text())
    assert content["inputs"]["distance"] == 0.018
    assert content["inputs"]["notch"] == pytest.approx(0.2 * 0.024)
    assert content["peak_stress"] > content["residual_strength"] > 0.0
    assert "distance" in (first / "report.html").read_text()
    assert main(["rerun", str(first), "--quiet", "--out", str(tmp_path / "again")]) == 0
    assert "the same as in" in capsys.readouterr().out
    both = [
        "compare",
        *asked[:5],
        *asked[-2:],
        "--quiet",
        "--models",
        "rigid,flexible",
        "--max-displacement",
    ]
    assert main([*both, "2e-6", "--out", str(tmp_path / "both")]) == 0
    assert "G [J/m2]" in capsys.readouterr().out


@pytest.mark.long
def test_a_study_varies_its_own_options(tmp_path, capsys):
    file = tmp_path / "distances.toml"
    file.write_text(
        '[common]\ntest = "punch"\nmodel = "rigid"\nwidth = 0.04\nheight = 0.024\n'
        "max_displacement = 2e-6\n[grid]\ndistance = [0.014, 0.018]\n"
    )
    assert main(["study", str(file), "--quiet", "--out", str(tmp_path / "study")]) == 0
    table = (tmp_path / "study" / "table.csv").read_text()
    assert "distance" in table and "0.014" in table and "0.018" in table


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"notch": 0.02}, "notch = 0.02 m, must be < "),
        ({"notch": -1e-3}, "notch = -0.001 m, must be >= 0"),
        ({"distance": 0.005}, "distance = 0.005 m, must be > 0.009"),
        ({"distance": 0.075}, "distance = 0.075 m, must be < 0.062"),
        ({"max_displacement": 1.0}, "max_displacement = 1.0 m, must be < 0.04"),
        ({"distance": "far"}, "distance = 'far' m, must be a number"),
        ({"model": "inner"}, "model of punch = 'inner', must be one of flexible, rigid"),
        ({"span": 0.01}, "span = 0.01 m, must not be given for punch"),
    ],
)
def test_what_has_no_sense_is_refused(options, message):
    material = flexpm.materials.load(None, "rigid")
    refusal(message, RunSpec.from_options, "punch", {"model": "rigid"} | options, material)


def test_the_library_takes_its_own_options():
    """As keywords, and refuses what no test has."""
    whole = flexpm.Specimen.rectangle(WIDTH, HEIGHT, thickness=THICKNESS, seed=1)
    few = {"max_displacement": 1e-7, "distance": 0.018}
    result = flexpm.run("punch", whole, model="rigid", **few)
    assert result.inputs["distance"] == 0.018
    assert RunSpec.from_json(result.inputs).to_json() == result.inputs
    with pytest.raises(InputError, match="option = 'distanse', unknown .did you mean distance"):
        flexpm.run("punch", whole, model="rigid", distanse=0.018)


def test_distance_is_for_punch_alone(tmp_path, capsys):
    run = ["run", "shear", "--distance", "0.01", "--out", str(tmp_path)]
    refused_command(capsys, "distance = 0.01 m, must not be given for shear", *run)


#: Two hundred grains.
BLOCK, DEPTH = (0.03, 0.008, 0.02), 0.008
SLIT, APART = 0.003, 0.0115


@pytest.fixture(scope="module")
def block():
    return Specimen.box(*BLOCK, seed=1)


def test_notches_come_from_below_and_from_above(block):
    places = [0.5 * (BLOCK[0] + side * APART) for side in (-1.0, 1.0)]
    asked = [
        (x, BLOCK[2] - SLIT if above else SLIT, above) for x in places for above in (False, True)
    ]
    cut = notched(block, asked)
    assert cut.cells.volumes.sum() == pytest.approx(block.cells.volumes.sum(), rel=1e-12)
    assert cut.depths() == pytest.approx([SLIT] * 4, abs=0.4 * block.mean_diameter)
    lines = cut.lines()
    assert lines[:, 0, 1].tolist() == [0.0, BLOCK[2], 0.0, BLOCK[2]]
    assert np.abs(lines[:, 1, 1] - lines[:, 0, 1]) == pytest.approx(cut.depths())
    assert (lines[:, :, 0] == np.repeat(places, 2)[:, None]).all()


@pytest.mark.long
@pytest.mark.parametrize(("model", "pressure"), [("flexible", 0.0), ("rigid", 10e6)])
def test_both_bridges_bear_the_load(block, model, pressure):
    asked = {"notch": SLIT, "distance": APART, "max_displacement": 1e-4}
    result = flexpm.run(
        "punch", block, default_name(model), model, rate=4.0, confinement=pressure, **asked
    )
    assert result.energy_error < 0.01
    assert result.notch_depth == pytest.approx(SLIT, abs=0.4 * block.mean_diameter)
    area = 2.0 * DEPTH * (BLOCK[2] - 2.0 * result.notch_depth)
    curve = result.curve
    assert curve["load"] == pytest.approx(area * curve["axial_stress"])
    assert np.array_equal(curve["shear_stress"], curve["axial_stress"])
    assert result.peak_load == pytest.approx(area * curve["axial_stress"].max())
    assert 5e6 < curve["axial_stress"].max() < 120e6
    rising = slice(1, int(np.argmax(curve["axial_stress"])))
    assert np.median(curve["end_mismatch"][rising]) < 0.05


@pytest.mark.long
def test_a_pressure_of_the_walls_bears_more(block):
    asked = {
        "notch": SLIT,
        "distance": APART,
        "max_displacement": 2e-4,
        "rate": 4.0,
    }
    low, high = (
        flexpm.run(
            "punch", block, default_name("rigid"), "rigid", confinement=pressure, **asked
        ).peak_load
        for pressure in (1e6, 12e6)
    )
    assert high > 1.5 * low
