# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that are too fast are loaded again at half the rate, from the start of their loading."""

from __future__ import annotations

import json
import os
import signal
from dataclasses import replace

import numpy as np
import pytest
from killed_scripts import HELPERS
from processes import captured
from refusals import refusal

import flexpm
from flexpm.cli.main import main as cli
from flexpm.laboratory import halving
from flexpm.results.result import Result
from flexpm.rigs.rig import TestRig as Rig
from flexpm.runs.asked import command, differences
from flexpm.runs.run_spec import RunSpec
from flexpm.specimens.spec import SpecimenSpec
from flexpm.studies import jobs

SIZE = {"width": 0.012, "height": 0.024, "thickness": 0.01}
#: Fast enough to be loaded again twice: peaks of 4, 2 and 1 are 180.65, 178.65 and 178.05 MPa.
FAST = {"model": "rigid", "rate": 4.0, "halvings": 5}
CONFINED = {"model": "rigid", "rate": 8.0, "halvings": 2, "confinement": 2e6}
SPEC = RunSpec("uniaxial", SpecimenSpec(), {}, halvings=5)
#: Kills itself after it has saved a slower loading for the first time.
KILLED = """
import sys, flexpm
from self_signals import after_save
from step_clock import STEP, step_clock
step_clock(setattr, look=10)
after_save(lambda position: position.tried)
specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
kept = dict(out=sys.argv[1], checkpoint_interval=90 * STEP)
options = dict(rate=2.0, halvings=2, confinement=2e6)
flexpm.run("biaxial", specimen, model="rigid", **options, **kept)
"""


@pytest.fixture(scope="module")
def small():
    return flexpm.Specimen.rectangle(**SIZE)


def loading(status, peak, rate=1.0):
    return {"rate": rate, "status": status, "peak_stress": peak, "steps": 1000, "seconds": 2.0}


def same_record(one, other):
    columns = one.curve.columns
    return all(np.array_equal(one.curve[c], other.curve[c], equal_nan=True) for c in columns)


@pytest.mark.parametrize(
    ("found", "over", "status"),
    [
        ([("ok", 100.0)], True, "ok"),
        ([("not_quasistatic", 103.0)], False, None),
        ([("not_quasistatic", 103.0), ("ok", 102.0)], True, "ok"),
        ([("not_quasistatic", 103.0), ("ok", 100.0)], False, None),
        ([("not_quasistatic", 103.0), ("ok", 101.5), ("ok", 101.0)], True, "ok"),
        # both peaks agree, but the limits of a single loading stand
        ([("not_quasistatic", 100.1), ("not_quasistatic", 100.0)], False, None),
        ([("not_quasistatic", 100.0)] * 6, True, "not_quasistatic"),
        ([("not_quasistatic", 130.0 - 5.0 * n) for n in range(5)] + [("ok", 100.0)], True, None),
        ([("no_peak", None)], True, "no_peak"),
        ([("not_quasistatic", 100.0), ("no_peak", None)], True, "no_peak"),
        ([("not_quasistatic", 100.0), ("diverged", 1.0)], True, "diverged"),
        ([("not_quasistatic", None), ("ok", None)], True, "ok"),
        ([("not_quasistatic", None), ("ok", 100.0)], False, None),
    ],
)
def test_a_test_is_loaded_again_until_it_is_slow_enough(found, over, status):
    loadings = [loading(*one, rate=0.5**number) for number, one in enumerate(found)]
    assert halving.is_over(SPEC, loadings) is over
    if over:
        result = Result("", "", "uniaxial", "rigid", {}, 1, 1, 1, 1, 1, status=found[-1][0])
        halving.conclude(result, loadings)
        assert result.status == status or (status is None and result.status == "not_quasistatic")
        assert (result.final_rate, result.rates) == (0.5 ** (len(found) - 1), loadings)


def test_the_cost_of_the_next_loading_is_told():
    """Steps rise as 2^p, p by the kind of loading, and seconds with them."""
    last = loading("not_quasistatic", 120e6, rate=2.0)
    waiting, constant = replace(SPEC, loading="waiting"), replace(SPEC, loading="constant")
    assert halving.foreseen(waiting, last) == (1414, pytest.approx(2.0 * 2.0**0.5))
    assert halving.foreseen(constant, last) == (2000, 4.0)
    assert halving.told(constant, [last]) == (
        "rate 2: not_quasistatic, peak 120 MPa, 1000 steps; again at rate 1, about 2000 steps and "
        "4 s, halving 1 of at most 5"
    )


def test_auto_is_a_rate_of_one_that_is_halved_five_times():
    auto = RunSpec.from_options("uniaxial", {"rate": "auto"}, flexpm.materials.load(None))
    assert (auto.rate, auto.halvings) == (1.0, 5)
    plain = replace(auto, halvings=None)
    assert plain.key() == RunSpec.from_options("uniaxial", {}, flexpm.materials.load(None)).key()
    assert len({plain.key(), auto.key(), replace(auto, halvings=3).key()}) == 3
    assert RunSpec.from_json(auto.to_json()) == auto
    assert command(auto) == "flexpm run uniaxial --halvings 5"
    job = jobs.make({"test": "uniaxial", "rate": "auto", "halvings": 3}, None)
    assert (job.spec.rate, job.spec.halvings) == (1.0, 3)
    assert job.arguments[4:6] == ("--rate", "auto")
    # a study leaves out what a test has no use for
    assert jobs.make({"test": "sonic", "rate": "auto"}, None).spec.halvings is None


@pytest.mark.parametrize(
    ("test", "options", "message"),
    [
        ("sonic", {"rate": "auto"}, "rate = auto, must not be given for sonic"),
        ("sonic", {"halvings": 2}, "rate = auto, must not be given for sonic"),
        ("uniaxial", {"rate": "fast"}, "rate = 'fast'"),
        ("uniaxial", {"halvings": 0}, "halvings = 0, must be >= 1"),
        ("uniaxial", {"halvings": 21}, "halvings = 21, must be <= 20"),
        ("uniaxial", {"halvings": 2.5}, "halvings = 2.5, must be a whole number"),
        ("uniaxial", {"rate": 1e-12, "halvings": 1}, "rate after all halvings = 5e-13"),
    ],
)
def test_wrong_rates_are_refused(small, test, options, message):
    refusal(message, flexpm.run, test, small, **options)


def test_each_loading_has_the_bits_of_a_run_at_its_rate(small):
    result = flexpm.run("uniaxial", small, **FAST)
    assert [one["rate"] for one in result.rates] == [4.0, 2.0, 1.0]
    assert [one["status"] for one in result.rates] == ["not_quasistatic", "ok", "ok"]
    assert (result.status, result.final_rate) == ("ok", 1.0)
    for one in result.rates:
        alone = flexpm.run("uniaxial", small, model="rigid", rate=one["rate"])
        assert (alone.peak_stress, alone.status) == (one["peak_stress"], one["status"])
        assert alone.steps == one["steps"]
    assert same_record(result, alone)
    assert result.inputs["rate"] == 4.0


def test_a_test_that_is_slow_enough_at_once_is_done_once(small):
    result = flexpm.run("tension", small, rate="auto")
    assert (result.status, len(result.rates), result.final_rate) == ("ok", 1, 1.0)
    alone = flexpm.run("tension", small)
    assert same_record(result, alone)
    assert (alone.rates, alone.final_rate) == (None, None)


@pytest.mark.parametrize("model", ["rigid", "jcfpm"])
@pytest.mark.parametrize("folder", [True, False])
def test_a_confinement_is_not_repeated_where_scenes_go_on(
    small, tmp_path, monkeypatch, model, folder
):
    begun = []
    before = Rig._begin_confinement
    monkeypatch.setattr(
        Rig, "_begin_confinement", lambda *given: begun.append(given) or before(*given)
    )
    options = {**CONFINED, "model": model, "halvings": 1, "out": tmp_path if folder else None}
    result = flexpm.run("biaxial", small, **options)
    assert len(result.rates) == 2
    assert len(begun) == (1 if model == "rigid" else 2)
    assert not (tmp_path / "checkpoint.start.bin").exists()
    alone = flexpm.run("biaxial", small, model=model, rate=result.final_rate, confinement=2e6)
    assert same_record(result, alone)
    settled = 0 if model == "jcfpm" else result.steps - result.rates[-1]["steps"]
    assert (settled > 0) is (model == "rigid")


def test_a_test_at_the_bound_keeps_both_answers(small):
    result = flexpm.run("uniaxial", small, model="rigid", rate=16.0, halvings=1)
    assert result.status == "not_quasistatic"
    peaks = [one["peak_stress"] for one in result.rates]
    assert peaks[0] != peaks[1] == result.peak_stress
    line = next(line for line in result.warnings if "halvings" in line)
    both = f"{1e-6 * peaks[0]:.4g} MPa and {1e-6 * peaks[1]:.4g} MPa"
    assert line.startswith(f"rate = 8 after 1 halvings, the last peaks are {both}")
    assert any("(--rate, now 8)" in line for line in result.warnings)


@pytest.mark.parametrize(("before", "lost"), [(1, ""), (1, "gone"), (2, ""), (2, "damaged")])
def test_an_interrupted_run_goes_on_to_the_same_bits(small, tmp_path, before, lost):
    whole = flexpm.run("biaxial", small, **CONFINED)
    assert len(whole.rates) == 3
    options = {**CONFINED, "out": tmp_path, "report": False}
    announced = []

    def stop(_, __, text):
        announced.extend([text] if text.startswith("rate") else [])
        if len(announced) == before:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flexpm.run("biaxial", small, **options, progress=stop)
    start = tmp_path / "checkpoint.start.bin"
    assert len(start.read_bytes()) > 10_000
    if lost == "gone":
        start.unlink()
    elif lost == "damaged":
        start.write_bytes(b"nothing")
    again = flexpm.run("biaxial", small, **options)
    assert again.resumed_at is not None
    assert differences(whole.as_dict(), again.as_dict()) == []
    assert same_record(whole, again)
    # a complete one gives its result again, without a step
    once_more = flexpm.run("biaxial", small, **options)
    assert once_more.resumed_at == again.steps
    assert differences(again.as_dict(), once_more.as_dict()) == []


@pytest.mark.long
def test_a_run_killed_in_a_slower_loading_goes_on_to_the_same_bits(small, tmp_path, package_parent):
    paths = f"{package_parent}{os.pathsep}{HELPERS}"
    environment = dict(os.environ, PYTHONPATH=paths, OMP_NUM_THREADS="1")
    words, out = ["/usr/bin/python3", "-c", KILLED, str(tmp_path / "out")], tmp_path / "out"
    scenes = []
    for _ in range(3):
        done = captured(words, env=environment)
        assert done.returncode == -signal.SIGKILL, done.stderr
        scenes.append(json.loads((out / "checkpoint.json").read_text())["scene"])
    assert len({*scenes}) == 3  # each start has taken up what the one before has saved
    options = {"model": "rigid", "rate": 2.0, "halvings": 2, "confinement": 2e6}
    found = flexpm.run("biaxial", small, **options, out=out)
    assert scenes[-1] == f"checkpoint-{found.resumed_at}.bin"
    whole = flexpm.run("biaxial", small, **options)
    assert same_record(whole, found)
    assert differences(whole.as_dict(), found.as_dict()) == []


def test_a_folder_with_another_bound_is_refused(small, tmp_path):
    options = {"model": "rigid", "rate": 4.0, "max_strain": 1e-5, "out": tmp_path}
    flexpm.run("uniaxial", small, **options)
    refusal(r"halvings = None there, 5 here", flexpm.run, "uniaxial", small, **options, halvings=5)


def test_frames_are_those_of_the_last_loading(small, tmp_path):
    flexpm.run("uniaxial", small, **FAST, out=tmp_path, frames=4, report=False)
    alone = tmp_path / "alone"
    flexpm.run("uniaxial", small, model="rigid", rate=1.0, out=alone, frames=4, report=False)
    assert (tmp_path / "frames.csv").read_text() == (alone / "frames.csv").read_text()


def test_the_command_tells_the_next_cost_and_repeats_itself(tmp_path, capsys):
    size = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01", "--model", "rigid"]
    words = ["run", "uniaxial", *size, "--rate", "4", "--halvings", "3"]
    assert cli([*words, "--out", str(tmp_path / "one")]) == 0
    out = capsys.readouterr().out
    assert "again at rate 2, about" in out
    assert "rates                       4, 2, 1; last peaks 178.6, 178.1 MPa" in out
    page = (tmp_path / "one" / "report.html").read_text(encoding="utf-8")
    assert "Loadings" in page
    assert "-1.1 %" in page
    given = str(tmp_path / "one" / "result.json")
    assert cli(["rerun", given, "--out", str(tmp_path / "two"), "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "the same as in" in out
    assert "again at rate" not in out
    assert cli(["run", "sonic", "--rate", "auto", "--out", str(tmp_path / "three")]) == 2
    assert "rate = auto, must not be given for sonic" in capsys.readouterr().err


def test_a_comparison_halves_the_rate_of_each_of_its_runs(small):
    found = flexpm.compare("tension", small, ("flexible", "rigid"), rate=2.0, halvings=2)
    assert [case.result.status for case in found.cases] == ["ok", "ok"]
    assert found.cases[0].result.final_rate == 1.0
