# SPDX-License-Identifier: GPL-3.0-or-later
"""Doubtful inputs and results are said, the usual ones are not."""

from __future__ import annotations

import json

import pytest

from flexpm.cli import main as cli
from flexpm.materials import material as materials
from flexpm.results import doubts
from flexpm.runs.input_names import models_of, shape_of
from flexpm.runs.run_spec import TESTS, RunSpec, described
from flexpm.specimens.space.any_spec import spec_type
from flexpm.specimens.spec import SpecimenSpec

SAW = "--set joint.saw.normal_stiffness=1e13 --set joint.saw.shear_stiffness=1e13"
TINY = ["--width", "0.012", "--height", "0.024", "--quiet"]


@pytest.mark.parametrize("preset", [None, *materials.preset_names()])
@pytest.mark.parametrize("test", TESTS)
def test_no_preset_and_no_default_is_doubtful(test, preset):
    for model in models_of(test):
        chosen = materials.load(preset, model)
        if materials.elastic_set_name(model) in chosen.elastic:
            shape = shape_of(test)
            specimen = spec_type(shape)(shape)
            spec = RunSpec(test, specimen, described(chosen, model), model)
            assert doubts.of_inputs(spec.to_json()) == []


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ("--set cohesion=30", "cohesion = 30"),
        ("--set tensile_strength=8.5", "tensile_strength = 8.5"),
        ("--set friction=30", "friction = 30"),
        ("--set young=25.8", "young = 25.8"),
        ("--width 20 --height 40", "width = 20"),
        ("--diameters 3,4 --width 12 --height 24", "height = 24"),
        (f"{SAW} --set joint.saw.friction=30", "joint saw friction = 30"),
    ],
)
def test_inputs_in_other_units_are_said_before_the_run(capsys, monkeypatch, arguments, says):
    monkeypatch.setattr(cli.inputs, "load_yade", lambda: 1 / 0)  # nothing runs
    assert cli.main(["elastic", *TINY, *arguments.split()]) == 3
    assert f"warning: {says}, is unusual" in capsys.readouterr().out


def test_a_normal_stress_in_other_units_is_doubtful():
    material = described(materials.load("augig-table7", "flexible"), "flexible")
    spec = RunSpec("shear", SpecimenSpec("rectangle"), material, normal_stress=2.0)
    assert "normal_stress = 2, is unusual" in doubts.of_inputs(spec.to_json())[0]


@pytest.mark.parametrize(
    ("test", "cohesion", "rate", "told"),
    [
        # the rock has 30 MPa; errors of these: doc/record/rates
        ("biaxial", 2e6, 1.0, True),
        ("biaxial", 2e6, 0.25, False),
        ("biaxial", 8e6, 1.0, False),
        ("biaxial", 8e6, 4.0, True),
        ("biaxial", 0.0, 4.0, False),
        ("shear", 2e6, 4.0, False),
    ],
)
def test_a_joint_that_is_weak_beside_the_rock_is_doubtful(test, cohesion, rate, told):
    rock = materials.load("augig-table7", "flexible")
    keys = {
        "normal_stiffness": 1e14,
        "shear_stiffness": 3e13,
        "cohesion": cohesion,
        "friction": 0.5,
    }
    weak = rock.with_set({f"joint.a.{key}": value for key, value in keys.items()}, "flexible")
    spec = RunSpec(test, SpecimenSpec("rectangle"), described(weak, "flexible"), rate=rate)
    found = doubts.of_inputs(spec.to_json())
    assert [line.partition(" = ")[0] for line in found] == ["joint a: strength"] * told


def test_doubts_about_a_result():
    assert doubts.of_result("ok", 0.009, 0.04, 1.0) == []
    assert doubts.of_result("ok", None, None, None) == []
    lines = doubts.of_result("not_quasistatic", 0.02, 0.06, 8.0)
    assert [line.split(" ")[0] for line in lines] == ["status", "energy_error", "load"]
    assert all(line.endswith("lower the rate (--rate, now 8)") for line in lines)


def test_doubts_about_what_moves():
    usual = {"at the peak": 0.001, "at the end": 0.14, "at the end under a pressure": 0.07}
    assert doubts.of_motion(usual, 1.6) == []
    assert doubts.of_motion({}, None) == []
    lines = doubts.of_motion({"at the peak": 0.03, "at the end under a pressure": 0.11}, 1550.0)
    assert [line.split(",")[0] for line in lines[:2]] == [
        "kinetic energy = 3 % of the work at the peak",
        "kinetic energy = 11 % of the work at the end under a pressure",
    ]
    assert lines[2].startswith("largest_parting = 1.55e+03 mean diameters")


@pytest.mark.long
def test_a_loading_beyond_sense_is_said_on_the_screen_and_in_the_file(capsys, tmp_path):
    arguments = ["run", "tension", *TINY, "--rate", "1e4", "--loading", "constant"]
    assert cli.main([*arguments, "--out", str(tmp_path)]) == 3
    shown = [line for line in capsys.readouterr().out.splitlines() if line.startswith("warning")]
    result = json.loads((tmp_path / "result.json").read_text())
    assert (result["status"], result["peak_stress"]) == ("no_peak", None)
    assert shown == [f"warning: {line}" for line in result["warnings"]]
    assert any("load and reaction" in line for line in shown)
