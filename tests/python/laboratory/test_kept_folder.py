# SPDX-License-Identifier: GPL-3.0-or-later
"""Own tests with a folder: killed and taken up to the same bits, repeated, refused, broken off."""

from __future__ import annotations

import json
import shutil
import signal
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import result_schema_file
import yade
from killed_scripts import content, drawn, ended, killed, require_same, started
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import BusyError
from flexpm.rigs.outcome import kept
from flexpm.rigs.outcome.calls import Again, plain, recording

#: A beam that is pressed sideways, loaded, unloaded, and broken; its folder is "out".
SCRIPT = """
import sys, flexpm
h = 0.012
made = flexpm.Specimen.rectangle(3.0 * h, h, 0.01, seed=1)

rig = flexpm.PartRig(flexpm.build(made, model="rigid"), out="out", checkpoint_interval=INTERVAL)
left = rig.hold(where=lambda x, y: x < 0.3 * h)
right = rig.platen(1)
rig.press(right, 1e5)
roller = rig.support((2.0 * h, 0.0))
head = rig.support((1.2 * h, h))
rig.drive(head, (0.0, -1.0), against=[left, roller])
rig.gauge("sag", (1.2 * h, 0.0), (1.2 * h, h))
for strain in (4e-7, 1e-7):
    rig.strain_to(strain, rate=RATE)
try:
    rig.strain_to(1e-6, rate=-1.0)
except flexpm.InputError:
    rig.strain_to(6e-7, rate=RATE)
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""

#: Asks its process to end five steps later.
SIGNALLED = """
import yade
from self_signals import at_steps
at_steps([(yade.O.iter + 5, 15)])
"""


def done_here(folder: Path, monkeypatch: pytest.MonkeyPatch, script: str = SCRIPT) -> None:
    """Do the script in this process, with the same packing again."""
    monkeypatch.chdir(folder)
    yade.O.reset()
    text = script.replace("INTERVAL", "30.0").replace("RATE", "4.0")
    try:
        exec(text, {})
    finally:
        kept.close_open()


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of the script that nobody has killed."""
    folder = tmp_path_factory.mktemp("whole")
    assert ended(started(folder, SCRIPT)) == (0, "")
    return folder / "out"


@pytest.mark.long
def test_a_killed_script_goes_on_to_the_same_bits(whole, tmp_path):
    last = content(whole)["steps"]
    moments = [
        drawn(1, [signal.SIGTERM, signal.SIGKILL], 690),
        drawn(2, [signal.SIGKILL] * 3, last),
    ]
    ends = killed(tmp_path, SCRIPT, moments)
    assert ends == [[signal.SIGTERM, signal.SIGKILL, 0], [*[signal.SIGKILL] * 3, 0]]
    for number in range(len(moments)):
        require_same(tmp_path / str(number), whole)


@pytest.mark.slow
def test_kills_over_all_stages(whole, tmp_path):
    last, both = content(whole)["steps"], [signal.SIGTERM, signal.SIGKILL, signal.SIGKILL]
    moments = [drawn(seed, both, last) for seed in range(10, 44)]
    for number, ends in enumerate(killed(tmp_path, SCRIPT, moments)):
        assert ends[-1] == 0, ends
        require_same(tmp_path / str(number), whole)


def test_a_terminated_script_leaves_what_it_has_reached(tmp_path):
    script = SCRIPT.replace("rig.load(", f"{SIGNALLED}rig.load(")
    assert ended(started(tmp_path, script))[0] == -signal.SIGTERM
    found = content(tmp_path / "out")
    assert found["status"] == "unfinished"
    assert any(
        line.startswith("unfinished: load was interrupted at step") for line in found["warnings"]
    )
    assert found["steps"] > found["inputs"]["stages"][-1]["first_step"]
    assert cli.main(["report", str(tmp_path / "out")]) == 0


def test_a_finished_script_does_no_step_and_a_longer_one_goes_on(whole, tmp_path, monkeypatch):
    shorter, load, _ = SCRIPT.partition("rig.load(")
    assert load
    done_here(tmp_path, monkeypatch, shorter)
    stages = content(tmp_path / "out")["inputs"]["stages"]
    done_here(tmp_path, monkeypatch, shorter)
    assert content(tmp_path / "out")["inputs"]["stages"] == stages
    done_here(tmp_path, monkeypatch)
    require_same(tmp_path / "out", whole)
    done_here(tmp_path, monkeypatch, shorter)  # less than is there leaves it as it is
    require_same(tmp_path / "out", whole)


def test_it_is_made_again_to_the_same_bits(whole, tmp_path, capsys):
    inputs = content(whole)["inputs"]
    assert inputs["repeatable"]
    hold = next(one for one in inputs["calls"] if one["call"] == "hold")
    assert hold["with"]["where"] == {"nodes": inputs["parts"][-1]["nodes"]}
    refused = [one for one in inputs["calls"] if "raised" in one]
    assert [one["raised"][0] for one in refused] == ["InputError"]
    assert "flexpm rerun" in (whole / "report.html").read_text()
    again = tmp_path / "again"
    assert cli.main(["rerun", str(whole), "--out", str(again), "--no-report"]) == 0
    assert "the same as in" in capsys.readouterr().out
    require_same(again, whole)
    assert not (again / "report.html").exists()
    (whole / "report.html").rename(tmp_path / "before.html")
    assert cli.main(["report", str(whole)]) == 0
    assert (whole / "report.html").read_bytes() == (tmp_path / "before.html").read_bytes()


def test_the_result_is_valid(whole):
    found = json.loads((whole / "result.json").read_text())
    assert list(result_schema_file.validator().iter_errors(found)) == []


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("1e5)", "2e5)", "call 4 = press(part={'part': ['plate', 0]}, pressure=100000.0) there"),
        ("(4e-7, 1e-7)", "(4e-7, 2e-7)", "strain_to(strain=1e-07, rate=4.0) there"),
        ("(2.0 * h, 0.0)", "(2.1 * h, 0.0)", "call 5 = support(position=[0.024, 0.0]) there"),
        ("seed=1", "seed=2", "has a checkpoint of another run (seed = 1 there, 2 here)"),
        ("x < 0.3", "x < 0.4", "hold: the call places another part"),
    ],
)
def test_a_script_that_asks_for_something_else(whole, tmp_path, monkeypatch, old, new, told):
    shutil.copytree(whole, tmp_path / "out")
    before = {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()}
    refusal(told, done_here, tmp_path, monkeypatch, SCRIPT.replace(old, new))
    files = {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()}
    assert {name: files[name] for name in before} == before


def test_another_run_is_refused_both_ways(whole, tmp_path):
    small = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    flexpm.run("tension", small, model="rigid", max_strain=2e-5, out=tmp_path / "run", report=False)
    built = fresh(small, model="rigid")
    refusal("another run", flexpm.rig, built, out=tmp_path / "run")
    refusal("another run", flexpm.run, "tension", small, model="rigid", out=whole)
    refusal("must be 0 without out", flexpm.rig, built, frames=3)
    with pytest.raises(TypeError, match="outt"):
        flexpm.rig(built, outt="folder")
    yade.O.step()
    refusal("step of the scene = 1, must be 0", flexpm.rig, built, out=tmp_path / "new")


@pytest.mark.long
def test_two_processes_do_not_share_a_folder(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "out")
    waits = SCRIPT.replace("left =", "print('has it', flush=True); sys.stdin.read()\nleft =")
    first = started(tmp_path, waits)
    try:
        assert first.stdout.readline() == "has it\n"
        code, line = ended(started(tmp_path, SCRIPT))
        assert code == 1
        assert "is in use by another process of flexpm" in line
        assert BusyError.__name__ in line
    finally:
        first.kill()
        first.communicate()


@pytest.mark.long
def test_what_was_reached_stays_when_the_script_breaks(whole, tmp_path):
    broken = SCRIPT.replace(
        "    rig.strain_to(strain", "    1 / (strain > 2e-7)\n    rig.strain_to(strain"
    )
    assert ended(started(tmp_path, broken)) == (1, "ZeroDivisionError: division by zero")
    found = content(tmp_path / "out")
    assert found["status"] == "unfinished"
    assert any("the script ended by ZeroDivisionError" in line for line in found["warnings"])
    assert [one["stage"] for one in found["inputs"]["stages"]] == ["confine", "strain_to"]
    assert len(flexpm.Result.read(tmp_path / "out").curve) > 0
    assert "Start the same script again" in (tmp_path / "out" / "report.html").read_text()
    (tmp_path / "script.py").unlink()
    assert ended(started(tmp_path, SCRIPT)) == (0, "")  # mended, it goes on
    require_same(tmp_path / "out", whole)


def beam(folder: Path, **leaves: object):
    """A beam of rigid grains on two rollers, in this process."""
    made = flexpm.Specimen.rectangle(0.036, 0.012, 0.01, seed=1)
    rig = flexpm.PartRig(fresh(made, model="rigid"), out=folder, **leaves)
    rollers = [rig.support((x, 0.0), pinned=x < 0.01) for x in (0.004, 0.032)]
    rig.drive(rig.support((0.018, 0.012)), (0.0, -1.0), against=rollers)
    return rig


def test_a_full_disk_leaves_what_was_reached(tmp_path, monkeypatch):
    rig = beam(tmp_path)
    rig.strain_to(3e-7, rate=4.0)
    before = content(tmp_path)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device", str(tmp_path))

    monkeypatch.setattr(kept, "write_numbers", full)
    with pytest.raises(OSError, match="No space left"):
        rig.strain_to(6e-7, rate=4.0)
    monkeypatch.undo()
    assert content(tmp_path) == before
    rig.strain_to(9e-7, rate=4.0)
    assert len(content(tmp_path)["inputs"]["stages"]) == 3


def by_hand(rig):
    rig.built.run(10)


def damped(rig):
    rig.built.damping = 0.3


def watched(rig):
    rig.watch = lambda one: None


def moved(rig):
    rig.hold(box=((0.0, 0.004), (0.003, 0.008))).move((0.0, 1e-12))


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (by_hand, "the scene was changed between strain_to and strain_to"),
        (damped, "the scene was changed between strain_to and strain_to"),
        (moved, "the scene was changed between hold and strain_to"),
        (watched, "watch was set for strain_to"),
    ],
)
def test_what_no_call_has_asked_for_cannot_be_made_again(change, why, tmp_path, capsys):
    rig = beam(tmp_path / "own", report=False)
    rig.strain_to(3e-7, rate=4.0)
    assert content(tmp_path / "own")["inputs"]["repeatable"]
    change(rig)
    rig.strain_to(6e-7, rate=4.0)
    inputs = content(tmp_path / "own")["inputs"]
    assert (inputs["repeatable"], inputs["reason"]) == (False, why)
    assert cli.main(["rerun", str(tmp_path / "own"), "--out", str(tmp_path / "again")]) == 2
    line = capsys.readouterr().err.strip()
    assert line.count("\n") == 0
    assert why in line
    assert line.endswith("start its script again")


def test_steps_by_hand_at_the_end_cannot_be_made_again_either(tmp_path):
    rig = beam(tmp_path, report=False)
    rig.strain_to(3e-7, rate=4.0)
    rig.finish()
    assert content(tmp_path)["inputs"]["repeatable"]
    by_hand(rig)
    rig.finish()
    inputs = content(tmp_path)["inputs"]
    assert not inputs["repeatable"]
    assert inputs["reason"] == "steps were made by hand after strain_to"


@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm"])
def test_ends_leave_a_folder_too(model, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.01, 0.014, 0.01, seed=1)
    records = []
    for out in (None, tmp_path):
        rig = flexpm.rig(fresh(specimen, model=model), out=out, checkpoint_interval=1e-3)
        rig.confine(1e6)
        rig.strain_to(5e-5, rate=8.0)
        records.append(rig.record.array)
    rig.finish()
    assert np.array_equal(*records, equal_nan=True)  # keeping a folder changes no bit
    inputs = content(tmp_path)["inputs"]
    assert [one["call"] for one in inputs["calls"]] == ["rig", "confine", "strain_to"]
    assert inputs["repeatable"] == (model != "jcfpm")
    assert (tmp_path / "report.html").is_file()


def test_frames_are_taken_on_the_way(tmp_path):
    rig = beam(tmp_path, frames=3, film="gif", report=False)
    rig.load(flexpm.Loading(rate=4.0, kind="waiting"))
    rig.finish()
    assert (tmp_path / "film.gif").stat().st_size > 0
    assert len(list((tmp_path / "frames").glob("*.vtu"))) >= 3
    assert "frame" in (tmp_path / "frames.pvd").read_text()


def test_a_second_rig_ends_the_first_one(tmp_path):
    beam(tmp_path / "one").strain_to(3e-7, rate=4.0)
    beam(tmp_path / "two").strain_to(3e-7, rate=4.0)
    assert (tmp_path / "one" / "report.html").is_file()
    kept.close_open()
    require_same(tmp_path / "one", tmp_path / "two")


@recording
class Cycled(flexpm.PartRig):
    """A rig with a stage of its own."""

    def cycle(self, strains, load=None, times=1):
        """Go to strains, again and again."""
        for _ in range(times):
            for strain in strains:
                self.strain_to(strain, rate=load.rate)


def test_a_stage_that_is_added_is_recorded_and_made_again(tmp_path):
    made, folders = flexpm.Specimen.rectangle(0.036, 0.012, 0.01, seed=1), []
    for name in ("one", "two"):
        built = fresh(made, model="rigid")
        rig = Cycled(built, out=tmp_path / name, report=False)
        if folders:
            places = partial(built.solver.nodePlaces, bonded=True)
            again = Again(rig, lambda of=places: of()[0])
            for call in content(folders[0])["inputs"]["calls"][1:]:
                again.make(call)
        else:
            ends = [rig.hold(where=lambda x, y: x < 0.004), rig.platen(1, bonded=True)]
            rig.drive(ends[1], (1.0, 0.0), against=ends[0])
            rig.cycle(np.array([2e-7, 1e-7]), flexpm.Loading(rate=4.0), times=2)
        folders.append(tmp_path / name)
    kept.close_open()
    calls = content(folders[0])["inputs"]["calls"]
    assert [call["call"] for call in calls] == ["PartRig", "hold", "platen", "drive", "cycle"]
    assert calls[-1]["with"]["strains"] == [2e-7, 1e-7]
    assert len(content(folders[0])["inputs"]["stages"]) == 4
    require_same(*folders)


def test_arguments_are_plain_values():
    given = {"a": np.float64(0.5), "b": (1, np.int32(2)), "c": np.array([1.0, 2.0]), "d": {3: "x"}}
    assert {name: plain(value) for name, value in given.items()} == {
        "a": 0.5,
        "b": [1, 2],
        "c": [1.0, 2.0],
        "d": {"pairs": [[3, "x"]]},
    }
    assert plain(flexpm.Loading(rate=2.0))["loading"]["rate"] == 2.0
    assert set(plain(len)) == {"unknown"}
