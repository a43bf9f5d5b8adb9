# SPDX-License-Identifier: GPL-3.0-or-later
"""Doubtful inputs and results are said, the usual ones are not."""

from __future__ import annotations

import dataclasses
import json

import pytest

from flexpm.cli import main as cli
from flexpm.dimensions import is_solid
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
    shape = shape_of(test)
    specimen, solid = spec_type(shape)(shape), is_solid(shape)
    for model in models_of(test):
        chosen = materials.load(preset, model, solid=solid)
        if materials.elastic_set_name(model) in chosen.elastic:
            spec = RunSpec(test, specimen, described(chosen, model), model)
            told = doubts.of_inputs(spec.to_json())
            of_another = not chosen.made_for.suits(model, solid=solid)
            assert [line.partition(",")[0] for line in told] == [
                f"material = {preset}"
            ] * of_another
            assert not (of_another and preset is None)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ("--set cohesion=30", "cohesion = 30"),
        ("--set tensile_strength=8.5", "tensile_strength = 8.5"),
        ("--set friction=30", "friction = 30"),
        ("--set young=25.8", "young = 25.8"),
        (f"{SAW} --set joint.saw.friction=30", "joint saw friction = 30"),
    ],
)
def test_inputs_in_other_units_are_said_before_the_run(capsys, monkeypatch, arguments, says):
    monkeypatch.setattr(cli.inputs, "load_yade", lambda: 1 / 0)  # nothing runs
    assert cli.main(["elastic", *TINY, *arguments.split()]) == 3
    assert f"warning: {says}, is unusual" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            "--diameters 2,4 --width 20 --height 40",
            "width = 20 m, height = 40 m, unusual: specimens have 1e-06",
        ),
        ("--width 0.02 --height 2.1", "height = 2.1 m, unusual: specimens have 1e-06 to 2 m"),
        ("--thickness 80", "thickness = 80 m, unusual: specimens have 1e-06 to 2 m"),
        # one line, though grains are unusual, too
        ("--diameters 0.3,0.4 --width 1.2 --height 2.4", "height = 2.4 m, unusual"),
        ("--diameters 0.1,0.2 --width 1.2 --height 1.9", "diameters of grains = 0.1 to 0.2 m"),
        (
            "--diameters 5e-7,2e-6 --width 1e-5 --height 2e-5",
            "diameters of grains = 5e-07 to 2e-06 m, unusual: grains have 1e-06 to 0.1 m",
        ),
        (
            "--shape box --width 0.02 --depth 20 --height 0.04 --diameters 0.003,0.01",
            "depth = 20 m",
        ),
        ("--shape box --width 1 --depth 1 --height 1 --diameters 0.1,0.2", "diameters of grains"),
        ("--width 2 --height 2 --diameters 0.1,0.1", ""),
        ("--width 1e-5 --height 2e-5 --diameters 1e-6,2e-6", ""),
    ],
)
def test_lengths_in_other_units_are_said_once_before_the_run(capsys, monkeypatch, arguments, says):
    monkeypatch.setattr(cli.inputs, "load_yade", lambda: 1 / 0)  # nothing runs
    assert cli.main(["elastic", *TINY, *arguments.split()]) == 3
    told = [line for line in capsys.readouterr().out.splitlines() if line.startswith("warning")]
    told = [line for line in told if "mean diameter of the grains" not in line]
    assert len(told) == bool(says)
    assert not says or (says in told[0] and told[0].endswith("; the unit is m, 20 mm is 0.02"))


@pytest.mark.parametrize("how", ["polygon", "image", "micrometres"])
def test_lengths_of_given_grains_are_told(how, capsys):
    flexpm = pytest.importorskip("flexpm")
    if how == "polygon":  # its sizes are in no input
        corners = [(0.0, 0.0), (4.967, 0.0), (4.967, 4.417), (1.0, 4.0)]
        made = flexpm.Specimen.polygon(corners, 0.01, diameters=(0.4, 0.6))
        says = "width = 4.967 m, height = 4.417 m"
    else:
        pixel = 0.5 if how == "image" else 1e-7
        made = flexpm.Specimen.from_labels([[1, 1, 2, 2]] * 6 + [[3, 3, 4, 4]] * 6, pixel, 1.0)
        says = "width = 2 m, height = 6 m" if how == "image" else "width = 4e-07 m"
    (told,) = doubts.of_lengths(made.extent, (made.mean_diameter,))
    assert told.startswith(says.replace("width = 2 m, ", "")), told
    rig = flexpm.PartRig(flexpm.build(made))
    assert [line for line in rig.warnings if "the unit is m" in line] == [told]


@pytest.mark.parametrize(
    ("material", "model", "shape", "instead"),
    [
        ("augig-table7", "flexible", "box", "take augig3d-calibrated or"),
        ("augig3d-calibrated", "flexible", "rectangle", "take augig-table7 or"),
        ("augig3d-calibrated", "rigid", "box", "take augig3d-calibrated-rigid or"),
        ("augig3d-calibrated", "jcfpm", "cylinder", "take augig3d-calibrated-rigid or"),
        ("augig-table7", "rigid", "rectangle", "take augig-table2-bilinear or"),
        ("augig-table2-brittle", "flexible", "rectangle", "take augig-table7 or"),
        ("augig3d-calibrated-rigid", "cohfrict", "box", None),
        ("augig-table2-bilinear", "inner", "rectangle", None),
    ],
)
def test_a_material_of_another_dimension_or_model_is_told_once(material, model, shape, instead):
    chosen = materials.load(material)
    spec = RunSpec("uniaxial", spec_type(shape)(shape), described(chosen, model), model)
    told = doubts.of_inputs(spec.to_json())
    assert len(told) == (instead is not None)
    if instead:
        there, here = chosen.made_for, "2D" if shape == "rectangle" else "3D"
        assert f"in {there.dimension} for model {there.model}, the run is {here}" in told[0]
        assert instead in told[0]
    # a file that does not say what it was made for gives none, and the key is the same
    unknown = dataclasses.replace(chosen, made_for=None)
    plain = RunSpec("uniaxial", spec_type(shape)(shape), described(unknown, model), model)
    assert doubts.of_inputs(plain.to_json()) == []
    assert plain.key() == spec.key()
    assert RunSpec.from_json(spec.to_json()) == spec


def test_a_normal_stress_in_other_units_is_doubtful():
    material = described(materials.load("augig-table7", "flexible"), "flexible")
    spec = RunSpec("shear", SpecimenSpec("rectangle"), material, normal_stress=2.0)
    assert "normal_stress = 2, is unusual" in doubts.of_inputs(spec.to_json())[0]


@pytest.mark.parametrize(
    ("test", "cohesion", "rate", "told"),
    [
        # the rock has 30 MPa
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
    assert lines[2].startswith("largest_separation = 1.55e+03 mean diameters")


@pytest.mark.long
def test_a_loading_beyond_sense_is_said_on_the_screen_and_in_the_file(capsys, tmp_path):
    arguments = ["run", "tension", *TINY, "--rate", "1e4", "--loading", "constant"]
    assert cli.main([*arguments, "--out", str(tmp_path)]) == 3
    shown = [line for line in capsys.readouterr().out.splitlines() if line.startswith("warning")]
    result = json.loads((tmp_path / "result.json").read_text())
    assert (result["status"], result["peak_stress"]) == ("no_peak", None)
    assert shown == [f"warning: {line}" for line in result["warnings"]]
    assert any("load and reaction" in line for line in shown)
