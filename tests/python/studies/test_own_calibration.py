# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrations to what a function measures: closed forms, an own test, and what is refused."""

from __future__ import annotations

import pytest

import flexpm
from flexpm.errors import InputError, SimulationError

FREE = {"cohesion": (5e6, 90e6), "tensile_strength": (2e6, 30e6)}


def law(material: flexpm.Material) -> dict[str, float]:
    """Two measures that follow two keys by known powers, and one that nothing asks for."""
    values = material.law("flexible")
    cohesion, tension = values["cohesion"], values["tensile_strength"]
    return {"crush": 3.0 * cohesion**0.8 * tension**0.2, "pull": 0.5 * tension, "more": 1.0}


def test_a_known_material_is_found_and_written_with_its_verdict_and_page(tmp_path):
    truth = flexpm.materials.load("augig-table7").with_set(
        ["cohesion=31e6", "tensile_strength=9e6"]
    )
    wanted = {name: law(truth)[name] for name in ("crush", "pull")}
    calls = []

    def measure(material: flexpm.Material) -> dict[str, float]:
        calls.append(material)
        return law(material)

    out = tmp_path / "mine"
    found = flexpm.calibrate(measure, FREE, wanted, out, material="augig-table7")
    assert found.met == {"crush": True, "pull": True}
    assert found.best.values["tensile_strength"] == pytest.approx(9e6, rel=0.02)
    assert found.best.values["cohesion"] == pytest.approx(31e6, rel=0.03)
    assert found.verdict.missed == []
    assert found.verdict.open_keys == []
    assert len(calls) <= 40
    files = {"mine.toml", "calibration.png", "history.csv", "verdict.json", "report.html"}
    assert files <= {file.name for file in out.iterdir()}
    written = flexpm.materials.load(str(out / "mine.toml")).law("flexible")
    assert written["cohesion"] == pytest.approx(found.best.values["cohesion"], rel=1e-3)
    text = (out / "mine.toml").read_text()
    assert "by a function of a script" in text and "# pull: " in text


def test_a_target_out_of_reach_is_missed_with_what_to_try(tmp_path):
    found = flexpm.calibrate(law, FREE, {"pull": {"value": 3e7, "tolerance": 0.01}}, tmp_path / "a")
    assert found.met == {"pull": False}
    assert any("at its upper bound" in line for line in found.verdict.advice)
    assert found.verdict.open_keys == ["cohesion"]


@pytest.mark.parametrize(
    ("measure", "free", "targets", "options", "told"),
    [
        (3, FREE, {"pull": 1e6}, {}, "measure = 3, must be a function"),
        (law, {}, {"pull": 1e6}, {}, "free = {}, must be a table"),
        (law, FREE, {}, {}, "targets = {}, must be a table"),
        (law, {"cohesoin": (1.0, 2.0)}, {"pull": 1e6}, {}, "did you mean cohesion"),
        (law, {"cohesion": (9e7, 5e6)}, {"pull": 1e6}, {}, "the smaller first"),
        (law, FREE, {"pul": 1e6}, {}, "did you mean pull"),
        (law, FREE, {"pull": -1.0}, {}, "must be > 0"),
        (law, FREE, {"pull": 1e6}, {"model": "flexibel"}, "did you mean flexible"),
        (law, FREE, {"pull": 1e6}, {"evaluations": 0}, "must be >= 1"),
        (lambda _: 3.0, FREE, {"pull": 1e6}, {}, "must be a table of numbers"),
        (lambda _: {"pull": "x"}, FREE, {"pull": 1e6}, {}, "pull = 'x', must be a number"),
    ],
)
def test_bad_calls_end_in_one_line(tmp_path, measure, free, targets, options, told):
    with pytest.raises(InputError, match=told) as refused:
        flexpm.calibrate(measure, free, targets, tmp_path / "out", **options)
    assert "\n" not in str(refused.value)


def test_no_measures_at_all_end_in_one_line(tmp_path):
    def nothing(material: flexpm.Material) -> dict[str, float]:
        raise SimulationError("it fell apart")

    with pytest.raises(SimulationError, match="no verified set gave all measures"):
        flexpm.calibrate(nothing, FREE, {"pull": 1e6}, tmp_path / "out", evaluations=3)


@pytest.mark.long
def test_an_own_test_is_calibrated(tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)

    def measures(material: flexpm.Material) -> dict[str, float]:
        result = flexpm.run("uniaxial", specimen, material, rate=4.0)
        return {"strength": result.peak_stress}

    start = measures(flexpm.materials.load("augig-table7"))["strength"]
    wanted = {"strength": {"value": 0.7 * start, "tolerance": 0.03}}
    free = {"cohesion": (5e6, 90e6), "tensile_strength": (2e6, 30e6)}
    options = {"material": "augig-table7", "evaluations": 15}
    found = flexpm.calibrate(measures, free, wanted, tmp_path / "out", **options)
    assert found.met == {"strength": True}
