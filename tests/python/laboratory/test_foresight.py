# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a run will take: told once, of the loading, by steps that were timed."""

from __future__ import annotations

import pytest
from step_clock import step_clock

import flexpm
from flexpm.cli import main as cli
from flexpm.cli.terminal import duration
from flexpm.laboratory.carrying_out import carry_out
from flexpm.laboratory.plan import plan_run
from flexpm.runs.run_spec import RunSpec, described

FAST = {"rate": 8.0, "stop_ratio": 0.8}
SIZES = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01"]


@pytest.fixture(autouse=True)
def _looks_soon(monkeypatch):
    """A run of few steps is looked at often enough."""
    step_clock(monkeypatch.setattr, look=10)


@pytest.mark.parametrize(
    ("test", "model", "confinement"),
    [("tension", "flexible", 0.0), ("biaxial", "flexible", 4e6), ("biaxial", "jcfpm", 4e6)],
)
def test_the_steps_of_the_loading_are_told_once(test, model, confinement, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1)
    material = flexpm.materials.load(None, model)
    about = described(material, model)
    spec = RunSpec(test, specimen.spec, about, model, confinement=confinement, **FAST)
    told = []
    plan = plan_run(spec, specimen, material, tmp_path)
    result = carry_out(plan, foresee=lambda *numbers: told.append(numbers))
    ((steps, seconds),) = told
    assert 0.2 * result.steps < steps < 5.0 * result.steps
    assert seconds > 0.0
    # a complete run has nothing left to tell
    carry_out(plan_run(spec, specimen, material, tmp_path), foresee=told.append)
    assert len(told) == 1


def test_the_few_steps_of_an_elastic_start_are_not_told(monkeypatch):
    step_clock(monkeypatch.setattr, look=1)  # as slow steps have it
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.01, seed=1)
    material = flexpm.materials.load(None)
    spec = RunSpec("tension", specimen.spec, described(material, "flexible"), "flexible", **FAST)
    told = []
    result = carry_out(plan_run(spec, specimen, material), foresee=lambda *one: told.append(one[0]))
    (steps,) = told
    assert 0.2 * result.steps < steps < 5.0 * result.steps


@pytest.mark.parametrize(
    ("test", "most"),
    # a joint slides all its way at the fastest rate but for the look ahead of its slip (D58), which
    # takes up to as many steps again; cracks of beams take as long as they take
    [("shear", 2.2), ("bending", 4.0), ("scb", 4.0)],
)
@pytest.mark.parametrize("rate", [2.0, 8.0])
def test_steps_between_parts_are_told(test, most, rate):
    material, options = flexpm.materials.load("augig-table7", "rigid"), {"stop_ratio": 0.1}
    if test == "scb":
        specimen = flexpm.Specimen.half_disc(0.04, 0.01, seed=1)
    elif test == "bending":
        specimen = flexpm.Specimen.rectangle(0.09, 0.02, 0.01, seed=1)
    else:
        plane = {"normal_stiffness": 1e13, "shear_stiffness": 1e13, "friction": 0.5}
        material = material.with_set({f"joint.plane.{key}": one for key, one in plane.items()})
        whole = flexpm.Specimen.rectangle(0.04, 0.02, 0.01, seed=1)
        specimen = whole.with_joints({"plane": [[0.0, 0.01], [0.04, 0.01]]})
        options = {"max_displacement": 2e-6}
    about = described(material, "rigid")
    spec = RunSpec(test, specimen.spec, about, "rigid", rate=rate, **options)
    told = []
    result = carry_out(plan_run(spec, specimen, material), foresee=lambda *one: told.append(one[0]))
    (steps,) = told
    assert result.steps / most < steps < most * result.steps


def test_the_command_tells_unless_it_is_to_be_quiet(tmp_path, capsys):
    arguments = ["run", "tension", *SIZES, "--out", str(tmp_path)]
    assert cli.main(arguments) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.startswith("about ") and first.endswith(" left at the present pace")
    assert cli.main([*arguments[:-1], str(tmp_path / "quiet"), "--quiet"]) == 0
    assert "left at the present pace" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        *((0.123, "0.12 s"), (42.4, "42 s"), (89.0, "89 s"), (91.0, "1.5 min"), (3e3, "50 min")),
        *((7200.0, "2 h"), (1e5, "28 h"), (1e6, "12 days")),
    ],
)
def test_durations_are_read_in_their_unit(seconds, text):
    assert duration(seconds) == text
