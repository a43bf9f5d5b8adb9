# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that were killed or interrupted go on from their checkpoint to the same bits."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import struct
import subprocess
from pathlib import Path

import hypothesis
import pytest
import self_signals
import yade
from hypothesis import HealthCheck, assume, given
from hypothesis import strategies as st
from processes import captured
from refusals import refusal

import flexpm
from flexpm import _plugin
from flexpm._flexpm import saved_state
from flexpm.cli import main as cli
from flexpm.errors import BusyError
from flexpm.files import FolderLock
from flexpm.models.options import SPHERE_MODELS
from flexpm.runs import checkpoint
from flexpm.runs.checkpoint import Checkpoint
from flexpm.runs.run_spec import RunSpec
from flexpm.specimens.spec import SpecimenSpec

PYTHON = "/usr/bin/python3"
HELPERS = Path(__file__).parents[1] / "helpers"
SIZE = {"width": 0.012, "height": 0.024, "thickness": 0.01, "seed": 1}
DISC = {"diameter": 0.016, "thickness": 0.01, "seed": 1}
TESTS = {
    "uniaxial": {},
    "tension": {},
    "biaxial": {"confinement": 5e6},
    "brazilian": {},
}
SPEC = RunSpec("uniaxial", SpecimenSpec(), {})
#: Stages of flexpm's own models in which a test is killed, one after the other.
STAGES = {"biaxial": (1, 2)}
#: A run that ends soon, before its peak.
STOPPED = {"rate": 8.0, "max_strain": 1e-5}
#: Writes a file into a folder that it has locked, and comes to no end.
HOLD = """
import sys
from pathlib import Path
from flexpm.files import FolderLock, whole_file
lock = FolderLock(Path(sys.argv[1]))
with whole_file(Path(sys.argv[1]) / "curve.csv"):
    print("locked", flush=True)
    sys.stdin.read()
"""
#: Saves each twentieth step, and kills itself after it has saved a stage.
SCRIPT = """
import json, sys, flexpm
from self_signals import after_save
from step_clock import STEP, step_clock
step_clock(setattr, look=10)
job = json.loads(sys.argv[1])
after_save(lambda position: position.stage >= job["stage"])
make = flexpm.Specimen.disc if job["test"] == "brazilian" else flexpm.Specimen.rectangle
specimen = make(**job["size"])
settings = dict(job["settings"], model=job["model"], out="out", checkpoint_interval=10 * STEP)
flexpm.run(job["test"], specimen, **settings)
"""


@pytest.fixture(scope="module")
def small() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(**SIZE)


def environment_of(package_parent: Path) -> dict[str, str]:
    """Surroundings of a process, with the helpers of tests."""
    paths = f"{package_parent}{os.pathsep}{HELPERS}"
    return dict(os.environ, PYTHONPATH=paths, OMP_NUM_THREADS="1")


def saved_in(folder: Path) -> dict:
    return json.loads((folder / "checkpoint.json").read_text())


def kill_after(stage: int, test: str, model: str, package_parent: Path, folder: Path) -> dict:
    """Checkpoint of a process that kills itself once it has written a new one of `stage`."""
    size, settings = DISC if test == "brazilian" else SIZE, TESTS[test]
    job = {"size": size, "test": test, "model": model, "settings": settings, "stage": stage}
    command = [PYTHON, "-c", SCRIPT, json.dumps(job)]
    done = captured(command, cwd=folder, env=environment_of(package_parent))
    assert done.returncode == -signal.SIGKILL, done.stderr
    return saved_in(folder / "out")


def kill_and_resume(test: str, model: str, package_parent: Path, folder: Path) -> None:
    stages = (1,) if model in SPHERE_MODELS else STAGES.get(test, (1,))
    for stage in stages:
        left = kill_after(stage, test, model, package_parent, folder)
        assert left["stage"] == stage
        assert (folder / "out" / left["scene"]).exists()
        assert not (folder / "out" / "result.json").exists()
    made = (
        flexpm.Specimen.disc(**DISC) if test == "brazilian" else flexpm.Specimen.rectangle(**SIZE)
    )
    settings = TESTS[test]
    resumed = flexpm.run(test, made, model=model, out=folder / "out", **settings)
    assert resumed.resumed_at == int(re.findall(r"[0-9]+", left["scene"])[0]) < resumed.steps
    flexpm.run(test, made, model=model, out=folder / "whole", **settings)
    for name in ("curve.csv", "cracks.csv", "final.vtu"):
        assert (folder / "out" / name).read_bytes() == (folder / "whole" / name).read_bytes()
    names = {file.name for file in (folder / "out").iterdir()}
    assert len([name for name in names if "checkpoint" in name]) == 2, names


@pytest.mark.long
@pytest.mark.parametrize(
    ("model", "test"),
    [
        *(("flexible", test) for test in TESTS),
        ("rigid", "biaxial"),
        pytest.param("rigid", "brazilian", marks=pytest.mark.slow),
        ("inner", "tension"),
        ("jcfpm", "uniaxial"),
        pytest.param("jcfpm", "brazilian", marks=pytest.mark.slow),
        pytest.param("cohfrict", "biaxial", marks=pytest.mark.slow),
        ("cohfrict", "tension"),
    ],
)
def test_a_killed_run_ends_with_the_same_bits(package_parent, tmp_path, model, test):
    kill_and_resume(test, model, package_parent, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("test", TESTS)
@pytest.mark.parametrize("model", ["rigid", "inner", "inner-un", *SPHERE_MODELS])
def test_every_killed_run_ends_with_the_same_bits(package_parent, tmp_path, model, test):
    kill_and_resume(test, model, package_parent, tmp_path)


@pytest.mark.long
def test_a_complete_run_is_not_repeated(small, tmp_path):
    first = flexpm.run("tension", small, rate=4.0, out=tmp_path)
    assert first.resumed_at is None
    record = (tmp_path / "curve.csv").read_bytes()
    (tmp_path / "curve.csv").unlink()
    again = flexpm.run("tension", small, rate=4.0, threads=2, out=tmp_path)
    assert again.resumed_at >= again.steps
    assert (tmp_path / "curve.csv").read_bytes() == record
    # the time of a step comes from the run that did the steps
    assert again.as_dict() == first.as_dict()
    assert again.cracks == first.cracks


@pytest.mark.long
@pytest.mark.parametrize("model", SPHERE_MODELS)
def test_a_complete_run_of_spheres_shows_the_same_final_state_again(small, tmp_path, model):
    flexpm.run("tension", small, model=model, out=tmp_path)
    final = (tmp_path / "final.vtu").read_bytes()
    flexpm.run("tension", small, model=model, out=tmp_path)
    assert (tmp_path / "final.vtu").read_bytes() == final


@pytest.mark.long
def test_a_folder_with_a_checkpoint_of_other_inputs_is_refused(small, tmp_path):
    flexpm.run("tension", small, rate=4.0, out=tmp_path)
    others = (
        ({"rate": 2.0}, "rate = 4.0 there, 2.0 here"),
        ({"rate": 4.0, "mesh": "fan"}, "mesh = refined there, fan here"),
        (
            {"rate": 4.0, "material": "augig-table2-brittle"},
            "material tensile_strength = 8500000.0 there, 13700000.0",
        ),
    )
    for settings, message in others:
        with pytest.raises(flexpm.InputError, match="has a checkpoint of another run") as caught:
            flexpm.run("tension", small, out=tmp_path, **settings)
        assert message in str(caught.value)
        assert "\n" not in str(caught.value)
    other = flexpm.Specimen.rectangle(**{**SIZE, "seed": 2})
    refusal("seed = 1 there, 2 here", flexpm.run, "tension", other, rate=4.0, out=tmp_path)


def test_a_checkpoint_of_another_version_is_refused(small, tmp_path, monkeypatch):
    flexpm.run("tension", small, rate=8.0, max_strain=1e-5, out=tmp_path)
    monkeypatch.setattr(checkpoint, "__version__", "17.0")
    with pytest.raises(flexpm.InputError, match=r"flexpm = \S+ there, 17.0 here") as caught:
        flexpm.run("tension", small, rate=8.0, max_strain=1e-5, out=tmp_path)
    assert "written by another build of flexpm" in str(caught.value)


@pytest.mark.long
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupted_command_saves_a_checkpoint(package_parent, tmp_path, number, code):
    size = ["--width", "0.016", "--height", "0.032", "--thickness", "0.01"]
    words = ["run", "uniaxial", *size, "--out", "out"]
    command = self_signals.command(*words, at_steps=[(300, number)])
    done = captured(command, cwd=tmp_path, env=environment_of(package_parent))
    assert (done.returncode, done.stderr.count("\n")) == (code, 1), done.stderr
    left = saved_in(tmp_path / "out")
    assert (left["stage"], left["scene"]) == (1, "checkpoint-300.bin")
    assert (tmp_path / "out" / left["scene"]).exists()


@pytest.mark.parametrize("text", ["", "{", "[]", '{"scene": "x"}', "null"])
def test_a_file_that_is_no_checkpoint_is_refused_in_one_line(tmp_path, text):
    (tmp_path / "checkpoint.json").write_text(text)
    refusal(r"must be a checkpoint of flexpm", Checkpoint, tmp_path, SPEC)


@pytest.fixture(scope="module")
def stopped(small, tmp_path_factory) -> Path:
    """A folder with the checkpoint of a run that has ended."""
    folder = tmp_path_factory.mktemp("stopped")
    flexpm.run("tension", small, **STOPPED, out=folder)
    return folder


@pytest.fixture
def copied(stopped, tmp_path) -> Path:
    return Path(
        shutil.copytree(stopped, tmp_path / "copy", ignore=shutil.ignore_patterns(".flexpm*"))
    )


def refused(small: flexpm.Specimen, folder: Path) -> str:
    """The one line in which a run into a folder is refused."""
    with pytest.raises(flexpm.InputError) as caught:
        flexpm.run("tension", small, **STOPPED, out=folder)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_checkpoint_is_good_for_a_run_at_any_time(small, copied):
    assert flexpm.run("tension", small, **STOPPED, out=copied).resumed_at > 0
    assert flexpm.run("tension", small, **STOPPED, out=copied).resumed_at > 0


@given(place=st.floats(0.0, 1.0, exclude_max=True), bit=st.integers(0, 7))
@hypothesis.settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_a_flipped_bit_of_either_file_is_refused_in_one_line(small, stopped, place, bit):
    for name in ("checkpoint.json", saved_in(stopped)["scene"]):
        file = stopped / name
        whole = file.read_bytes()
        number = int(place * len(whole))
        try:
            file.write_bytes(
                whole[:number] + bytes([whole[number] ^ 1 << bit]) + whole[number + 1 :]
            )
            assert "checkpoint" in refused(small, stopped)
        finally:
            file.write_bytes(whole)


@given(part=st.floats(0.0, 1.0, exclude_max=True))
@hypothesis.settings(
    max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_a_scene_that_was_cut_is_refused_in_one_line(small, stopped, part):
    file = stopped / saved_in(stopped)["scene"]
    whole = file.read_bytes()
    try:
        file.write_bytes(whole[: int(part * len(whole))])
        assert "is damaged" in refused(small, stopped)
    finally:
        file.write_bytes(whole)


ANY_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=4,
)


@given(
    name=st.sampled_from(("scene", "stage", "stage_start", "step_time", "inputs", "sha256")),
    value=ANY_JSON | st.sampled_from(["/etc/passwd", "../checkpoint-1.bin", -1, 99, 2.0, True]),
)
@hypothesis.settings(
    max_examples=100,
    deadline=None,  # a busy machine takes longer
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
def test_any_value_in_a_checkpoint_is_refused_in_one_line(small, stopped, name, value):
    file = stopped / "checkpoint.json"
    whole = file.read_text()
    content = json.loads(whole)
    assume(content[name] != value)
    try:
        file.write_text(json.dumps(content | {name: value}))
        assert "checkpoint" in refused(small, stopped)
    finally:
        file.write_text(whole)


def test_a_scene_with_an_engine_that_could_run_any_code_is_refused(small, copied):
    about = saved_in(copied)
    wrapper = yade.wrapper
    yade.O.load(str(copied / about["scene"]))
    yade.O.engines = [*yade.O.engines, wrapper.PyRunner(command="1/0", iterPeriod=1)]
    yade.O.save(str(copied / about["scene"]), quiet=True)
    del about["sha256"]
    about["sha256"] = checkpoint._checksum(about, copied / about["scene"])
    (copied / "checkpoint.json").write_text(json.dumps(about))
    assert "has an engine PyRunner" in refused(small, copied)


def write_as_another_build(folder: Path, scene: bytes, **entries: object) -> None:
    """Leave a checkpoint as another build would: whole, with its own checksum."""
    about = saved_in(folder) | entries
    file = folder / about["scene"]
    file.write_bytes(scene)
    plain = {key: value for key, value in about.items() if key != "sha256" and value is not None}
    about = plain | {"sha256": checkpoint._checksum(plain, file)}
    (folder / "checkpoint.json").write_text(json.dumps(about))


@pytest.mark.parametrize(
    ("entries", "told"),
    [
        ({"state": 1}, r"state = 1 there, \d+ here"),
        ({"state": None}, r"state = None there, \d+ here"),
        ({"results": 99}, r"results = 99 there, \d+ here"),
        ({"yade": "2018.02b"}, r"yade = 2018.02b there, \S+ here"),
        ({"stage_likely": None, "results": 99}, r"results = 99 there, \d+ here"),
    ],
)
def test_a_checkpoint_of_another_build_is_said_to_be_one(small, copied, entries, told):
    write_as_another_build(copied, (copied / saved_in(copied)["scene"]).read_bytes(), **entries)
    line = refused(small, copied)
    assert re.search(rf"written by another build of flexpm \({told}\); choose", line), line
    assert line.endswith("or remove the file to start again")


def test_a_checkpoint_is_one_of_this_build(small, copied):
    """What the others are changed from is taken."""
    write_as_another_build(copied, (copied / saved_in(copied)["scene"]).read_bytes())
    assert flexpm.run("tension", small, **STOPPED, out=copied).resumed_at > 0


def with_another_class(scene: bytes) -> bytes:
    """The scene with an engine that is none here."""
    return scene.replace(b"GrainSolver", b"GrainSolved", 1)


def of_another_state(scene: bytes) -> bytes:
    """The scene with another number at the first class of flexpm that it holds.

    What follows is never read: as other members it would ask for any amount of memory.
    """
    number = struct.pack("<I", saved_state)
    names = [name.encode() for name in _plugin.load() if name.encode() in scene]
    place = scene.index(number, min(map(scene.index, names)))
    return scene[:place] + struct.pack("<I", saved_state - 1) + scene[place + 4 : place + 100]


@pytest.mark.parametrize("change", [with_another_class, of_another_state])
def test_a_scene_that_only_another_build_reads_is_refused_in_one_line(small, copied, change):
    scene = (copied / saved_in(copied)["scene"]).read_bytes()
    assert change(scene) != scene
    write_as_another_build(copied, change(scene))
    assert "written by another build of flexpm (" in refused(small, copied)
    assert not yade.O.engines and not len(yade.O.bodies)


@pytest.mark.long
def test_a_run_of_a_study_starts_again_from_such_a_scene(tmp_path, capsys):
    size = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01", "--quiet"]
    command = ["run", "tension", *size, "--rate", "8", "--max-strain", "1e-5"]
    command += ["--no-report", "--out", str(tmp_path)]
    assert cli.main(command) == 3  # no peak
    scene = (tmp_path / saved_in(tmp_path)["scene"]).read_bytes()
    write_as_another_build(tmp_path, with_another_class(scene))
    assert cli.main(command) == 2
    assert capsys.readouterr().err.count("\n") == 2  # a line of each
    assert cli.main([*command, "--discard-checkpoint"]) == 3
    assert "starts again: run: " in capsys.readouterr().out


def test_a_full_disk_is_named_and_leaves_the_earlier_checkpoint(small, copied, monkeypatch):
    class Full:
        iter = 7

        def save(self, name: str, quiet: bool) -> None:
            Path(name).write_bytes(b"half")
            raise RuntimeError("output stream error")

    before = {file.name: file.read_bytes() for file in copied.iterdir()}
    spec = flexpm.run("tension", small, **STOPPED, out=copied.parent / "other").inputs
    kept = Checkpoint(copied, RunSpec.from_json(spec))
    monkeypatch.setattr(checkpoint.yade, "O", Full())
    with pytest.raises(OSError, match=r"cannot be written .* MB left, make room"):
        kept.save()
    monkeypatch.undo()
    del kept
    assert {file.name: file.read_bytes() for file in copied.iterdir()} == before


def test_a_folder_takes_one_process_and_a_dead_one_leaves_it_free(package_parent, tmp_path):
    holder = subprocess.Popen(
        [PYTHON, "-c", HOLD, str(tmp_path)],
        env=dict(os.environ, PYTHONPATH=str(package_parent), FLEXPM_DEFER="1"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert holder.stdout.readline() == "locked\n"
    (tmp_path / "curve.csv").write_text("whole")
    with pytest.raises(BusyError, match="in use by another process") as caught:
        FolderLock(tmp_path)
    assert "\n" not in str(caught.value)
    assert len([name for name in tmp_path.iterdir() if name.name.startswith(".flexpm-")]) == 1
    holder.kill()
    holder.wait()
    holder.stdin.close()
    holder.stdout.close()
    lock = FolderLock(tmp_path)
    assert FolderLock(tmp_path) is lock  # once more in this process
    assert sorted(file.name for file in tmp_path.iterdir()) == [".flexpm.lock", "curve.csv"]
    del lock
    assert [file.name for file in tmp_path.iterdir()] == ["curve.csv"]


@pytest.mark.parametrize("interval", [0.0, -1.0, float("nan")])
def test_an_interval_that_is_not_positive_is_refused(tmp_path, interval):
    refusal("checkpoint_interval", Checkpoint, tmp_path, SPEC, interval)
