# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrations to what a function measures: closed forms, an own test, and what is refused."""

from __future__ import annotations

import json
import math

import pytest
from refusals import refusal

import flexpm
from flexpm.errors import SimulationError

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
    refusal(told, flexpm.calibrate, measure, free, targets, tmp_path / "out", **options)


@pytest.mark.parametrize("how", ["fails", "nan", "none", "half"])
def test_a_calibration_without_a_measure_ends_with_page_and_verdict(tmp_path, how):
    def measure(material: flexpm.Material) -> dict[str, float | None]:
        if how == "fails":
            raise SimulationError("it fell apart")
        found = dict(law(material))
        if how == "half" and material.cohesion < 2e7:
            return {**found, "pull": None}
        return {**found, "pull": math.nan if how == "nan" else None}

    out, targets = tmp_path / "out", {"pull": 1e6, "crush": 5e7}
    found = flexpm.calibrate(measure, FREE, targets, out, evaluations=8)
    assert found.met["pull"] is False
    assert found.best.mean("pull") is None
    why = "the function failed (it fell apart)" if how == "fails" else "the function gave none"
    assert found.verdict.advice[0] == f"pull: not measured, {why}; change its test"
    verdict = json.loads((out / "verdict.json").read_text())
    assert [one["name"] for one in verdict["measures"]] == ["pull", "crush"]
    assert verdict["measures"][0]["mean"] is None
    assert (verdict["measures"][1]["mean"] is None) == (how == "fails")
    page = (out / "report.html").read_text()
    assert "not measured" in page and "change its test" in page
    assert {"out.toml", "calibration.png", "history.csv"} <= {one.name for one in out.iterdir()}


def test_keys_that_do_not_go_together_do_not_end_a_calibration(tmp_path):
    """A fracture energy below the elastic one is refused by the material, not by the search."""
    free = {"tensile_strength": (2e6, 60e6), "tensile_fracture_energy": (0.05, 20.0)}
    wanted = {"pull": 1e7, "more": 1.0}

    def measure(material: flexpm.Material) -> dict[str, float]:
        return {**law(material), "more": material.tensile_fracture_energy}

    found = flexpm.calibrate(measure, free, wanted, tmp_path / "out", evaluations=30)
    lost = [one.lost["pull"] for one in found.history if one.lost]
    assert lost and all(text.startswith("rejected: material tensile_fracture") for text in lost)
    assert (tmp_path / "out" / "report.html").is_file()


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
