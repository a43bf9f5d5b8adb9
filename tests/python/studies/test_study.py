# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: what a file asks for, each run once, tables that do not depend on how they were made."""

from __future__ import annotations

import itertools
import json
import os
import shutil
import signal
import subprocess
from pathlib import Path

import pandas
import pytest
import self_signals
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.image import imread
from processes import captured, is_free, wait_for
from refusals import refusal

import flexpm
from flexpm import materials
from flexpm.cli import inputs, main
from flexpm.errors import InputError
from flexpm.joints import lines as joint_lines
from flexpm.kinds.registry import kind_of
from flexpm.runs import input_names, run_spec
from flexpm.studies import figures, jobs, pool, study, tables

ROOT = Path(__file__).resolve().parents[3]
SMALL = "width = 0.01\nheight = 0.02\nthickness = 0.01\n"
ELASTIC = f'[common]\ntest = "elastic"\n{SMALL}[grid]\nseed = [1, 2, 3, 4]\n'


def file_of(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text)
    return path


def command(package_parent: Path, *arguments: object) -> list[str]:
    return ["env", f"PYTHONPATH={package_parent}", "/usr/bin/python3", "-P", "-m", "flexpm"] + [
        str(argument) for argument in arguments
    ]


@settings(deadline=None, max_examples=25)
@given(
    st.dictionaries(
        st.sampled_from(["seed", "rate", "max_strain"]),
        st.lists(st.integers(1, 9), min_size=1, max_size=3, unique=True),
        min_size=1,
    )
)
def test_a_grid_is_all_combinations_in_order(grid):
    content = {"common": {"test": "uniaxial"}, "grid": grid}
    made = [jobs.make(inputs, Path()) for inputs in study.combinations(content)]
    found = [tuple(job.inputs[key] for key in grid) for job in made]
    assert found == list(itertools.product(*grid.values()))
    assert len({job.key for job in made}) == len(made)


def test_cases_change_the_common_options(tmp_path):
    path = file_of(
        tmp_path,
        "[common]\nset.cohesion = 3e7\ndiameter = 0.02\n[grid]\nseed = [1, 2]\n"
        '[[case]]\ntest = "biaxial"\nconfinement = 4e6\n[[case]]\ntest = "brazilian"\nseed = 7\n',
    )
    found = study.read(path).jobs
    assert [job.inputs["test"] for job in found] == ["biaxial", "biaxial", "brazilian"]
    assert found[0].inputs == {
        "test": "biaxial", "set.cohesion": 3e7, "seed": 1, "confinement": 4e6
    }  # fmt: skip
    assert found[2].inputs["diameter"] == 0.02 and found[2].inputs["seed"] == 7


def test_keys_follow_what_is_computed(tmp_path):
    def key(**inputs):
        return jobs.make({"test": "uniaxial", **inputs}, tmp_path).key

    assert key() == key(seed=1) == key(width=0.08) == key(material="augig-table7")
    assert key(diameter=0.1) == key()  # a rectangle has none
    assert len({key(), key(seed=2), key(**{"set.cohesion": 3e7}), key(model="rigid")}) == 4
    (tmp_path / "rock.toml").write_text(
        (ROOT / "py/flexpm/materials/presets/augig-table7.toml").read_text()
    )
    before = key(material="rock.toml")
    text = (tmp_path / "rock.toml").read_text().replace("0.40", "0.41")
    (tmp_path / "rock.toml").write_text(text)
    assert key(material="rock.toml") != before


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[commom]\n", "did you mean common?"),
        ('[common]\ntest = "uniaxal"\n', "did you mean uniaxial?"),
        ("[common]\nseed = 1\n", "test is missing"),
        ('[common]\ntest = "uniaxial"\nsed = 1\n', "did you mean seed?"),
        ('[common]\ntest = "uniaxial"\nset.cohesoin = 1\n', "did you mean set.cohesion?"),
        ('[common]\ntest = "uniaxial"\n[grid]\nset.cohesion = [-1.0]\n', "must be > 0"),
        ('[common]\ntest = "uniaxial"\nout = "x"\n', "out"),
        ('[common]\ntest = "uniaxial"\n[grid]\nseed = 1\n', "must be a list"),
        ('[common]\ntest = "uniaxial"\nset = 3\n', "must be a table"),
        ("common = [\n", "is not a valid TOML"),
        ('[common]\ntest = "uniaxial"\nspecimen = 3\n', "specimen = 3, must be a text"),
        ('[common]\ntest = "uniaxial"\nspecimen = "none.json"\n', "cannot be read"),
        ('[common]\ntest = "uniaxial"\nspecimen = "a"\nwidth = 1.0\n', "leave out one of them"),
        ('[common]\ntest = "uniaxial"\njoints = "none.csv"\n', "cannot be read"),
        ('[common]\ntest = "uniaxial"\nset.joint.a.frction = 1\n', "did you mean friction?"),
    ],
)
def test_wrong_files_are_refused_before_anything_runs(tmp_path, text, says):
    assert says in refusal("^[^\n]*$", study.read, file_of(tmp_path, text))


@pytest.mark.long
def test_a_killed_study_repeats_nothing_and_ends_with_the_same_table(tmp_path, package_parent):
    path = file_of(tmp_path, ELASTIC)
    whole = study.run(study.read(path), tmp_path / "whole", workers=2)
    assert list(whole["seed"]) == [1, 2, 3, 4] and set(whole["exit_code"]) == {0}
    assert whole["youngs_modulus"].nunique() == 4

    cut = tmp_path / "cut"
    words = ("study", path, "--out", cut, "--workers", 1, "--quiet")
    environment = os.environ | {"PYTHONPATH": str(package_parent)}
    killed = captured(self_signals.command(*words, after_runs=2), env=environment)
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    finished = {file: file.stat().st_mtime_ns for file in cut.glob("runs/*/outcome.json")}
    assert len(finished) == 2
    wait_for(lambda: all(is_free(folder) for folder in cut.glob("runs/*")))
    done = captured(command(package_parent, *words))
    assert done.returncode == 0, done.stderr
    assert all(file.stat().st_mtime_ns == at for file, at in finished.items())
    assert (cut / "table.csv").read_bytes() == (tmp_path / "whole/table.csv").read_bytes()


@pytest.mark.long
def test_a_failed_run_is_a_row_and_stops_no_other(tmp_path, package_parent):
    text = ELASTIC.replace("[1, 2, 3, 4]", "[1]") + "[[case]]\n[[case]]\nporosity = 0.95\n"
    path = file_of(tmp_path, text)
    arguments = command(package_parent, "study", path, "--out", tmp_path / "out")
    done = captured(arguments)
    assert done.returncode == 3 and len(done.stderr.splitlines()) == 1
    rows = pandas.read_csv(tmp_path / "out/table.csv")
    assert list(rows["exit_code"]) == [0, 2]
    assert "must" in rows["message"][1] and rows["youngs_modulus"].notna().tolist() == [True, False]


def test_the_outcome_of_an_interrupted_run_is_not_kept(tmp_path):
    job = jobs.make({"test": "uniaxial"}, tmp_path)
    for code, kept in ((0, True), (2, True), (3, True), (1, False), (143, False), (-9, False)):
        folder = tmp_path / str(code)
        folder.mkdir()
        (folder / "checkpoint-7.bin").write_bytes(b"scene")
        said = f"warning\nflexpm: status = no_peak; see {folder}\n"
        done = subprocess.CompletedProcess([], code, "", said)
        # a path would tell tables of the same runs apart
        assert jobs.conclude(job, folder, done)["message"] == f"status = no_peak; see {job.key}"
        assert (jobs.known(folder) is not None) == kept
        assert (folder / "checkpoint-7.bin").exists() == (not kept)
    assert jobs.conclude(job, tmp_path, OSError("lost"))["exit_code"] is None
    (tmp_path / "0" / "outcome.json").write_text('{"cut')
    assert jobs.known(tmp_path / "0") is None


@pytest.mark.parametrize(
    ("code", "stderr", "says"),
    [
        (-9, "", "ended by signal 9"),
        (-6, "terminate called\n", "ended by signal 6"),
        (1, "Traceback ...\nImportError: no yade\n\n", "ImportError: no yade"),
        (134, "", "ended with exit code 134"),
        (0, "a foreign line\n", ""),
    ],
)
def test_a_failed_run_always_has_a_message(tmp_path, code, stderr, says):
    job = jobs.make({"test": "uniaxial"}, tmp_path)
    done = subprocess.CompletedProcess([], code, "", stderr)
    assert jobs.conclude(job, tmp_path, done)["message"] == says


LISTENING = """
import psutil, subprocess
from pathlib import Path
from flexpm.studies import jobs, pool

def look(*_, **__):
    sockets = psutil.Process().connections("inet")
    listening = {one.laddr.ip for one in sockets if one.status == psutil.CONN_LISTEN}
    return subprocess.CompletedProcess([], 3, "", f"flexpm: {sorted(listening)}")

pool.subprocess.run = look
with pool.Pool(Path("."), workers=2) as runs:
    print(runs.run([jobs.make({"test": "uniaxial"}, Path("."))])[0]["message"])
"""


def test_runs_of_this_machine_are_reached_from_this_machine_alone(tmp_path, package_parent):
    """In a process of its own: threads of Dask would stay in that of the other tests."""
    done = captured(
        ["/usr/bin/python3", "-P", "-c", LISTENING],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(package_parent)},
    )
    assert done.stdout == "['127.0.0.1']\n", done.stderr  # Dask's pages


def test_results_of_an_older_number_are_named_once_and_run_again(tmp_path, monkeypatch, caplog):
    wanted = [jobs.make({"test": "uniaxial", "seed": seed}, tmp_path) for seed in (1, 2, 3)]
    for job in wanted[:2]:
        jobs.conclude(job, tmp_path / job.key, subprocess.CompletedProcess([], 0, "", ""))
    ran = []

    def lost(self, waiting):
        ran.append(waiting)
        return [(job, OSError("lost")) for job in waiting]

    monkeypatch.setattr(pool.Pool, "_ended", lost)
    kept = pool.Pool(tmp_path)
    kept.run(wanted)
    assert ran.pop() == wanted[2:] and caplog.messages == []
    number = run_spec.results_number("uniaxial", "flexible")
    monkeypatch.setitem(kind_of("uniaxial").results, "flexible", number + 1)
    for _ in range(2):
        kept.run(wanted)
        assert ran.pop() == wanted
    assert len(caplog.messages) == 1
    assert "2 finished runs are of an older results number and are run again" in caplog.messages[0]


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"exit_code": 9}', "[" * 5000, "null"])
def test_an_outcome_that_is_none_is_not_taken_for_one(tmp_path, text):
    (tmp_path / "outcome.json").write_text(text)
    assert jobs.known(tmp_path) is None


@pytest.mark.long
def test_a_checkpoint_of_no_use_is_not_taken_for_a_failed_run(package_parent, tmp_path):
    """Neither a damaged one nor one of another version: the run starts again."""
    sizes = {"width": 0.012, "height": 0.024, "thickness": 0.01}
    job = jobs.make({"test": "tension", "max_strain": 1e-5, "rate": 8, **sizes}, tmp_path)

    def run() -> subprocess.CompletedProcess[str]:
        return captured(job.command(tmp_path / "run", package_parent))

    first = run()
    assert first.returncode == 3, first.stderr
    file = tmp_path / "run" / "checkpoint.json"
    for damage in (
        lambda text: text.replace('"flexpm": "', '"flexpm": "17.'),
        lambda text: text[:-30],
        lambda text: text.replace('"stage": 2', '"stage": 1'),
    ):
        assert damage(file.read_text()) != file.read_text()
        file.write_text(damage(file.read_text()))
        again = run()
        assert (again.returncode, "starts again" in again.stdout) == (3, True), again.stderr
        assert jobs.conclude(job, tmp_path / "other", again)["exit_code"] == 3


def test_a_job_asks_for_what_its_inputs_are(tmp_path):
    """The command reads the arguments of a job back to the same run."""
    asked = {"test": "biaxial", "model": "rigid", "confinement": 2e6, "set.cohesion": 3e7 + 0.1}
    asked |= {"diameters": [1e-3, 2e-3], "dynamic": True, "gravity": 9.81, "points": 2, "rate": 2}
    job = jobs.make(asked, tmp_path)
    assert job.arguments[:2] == ("run", "biaxial")
    context = main.command.commands["run"].make_context("run", list(job.arguments[1:]))
    with context:
        source = inputs.source("biaxial", context.params)
        material = inputs.material(context.params, source.plain.kind)
        assert inputs.run_spec("biaxial", context.params, material, source) == job.spec
    names = {option.name for option in main.command.commands["run"].params}
    inert = {"test", "assignments", "out", "quiet", "threads", "discard_checkpoint"}
    inert |= {"seeds", "workers", "report", "specimen_file", "joints_file", "frames", "film"}
    inert |= {"network_file", "network_seed", "joint_name", "joint_origin", "joint"}
    assert names - inert == {*input_names.OPTIONS, "material"}


def test_frames_are_no_inputs_and_need_the_run_again(tmp_path):
    plain = jobs.make({"test": "tension"}, tmp_path)
    shown = jobs.make({"test": "tension", "frames": 5, "film": "gif"}, tmp_path)
    assert (shown.key, shown.inputs) == (plain.key, plain.inputs)
    command = shown.command(tmp_path, tmp_path)
    assert command[command.index("--frames") + 1] == "5"
    assert command[command.index("--film") + 1] == "gif"
    assert "--frames" not in plain.command(tmp_path, tmp_path)
    done = subprocess.CompletedProcess([], 0, "", "")
    jobs.conclude(plain, tmp_path / plain.folder, done)
    assert jobs.finished(plain, tmp_path) is not None
    assert jobs.finished(shown, tmp_path) is None
    jobs.conclude(shown, tmp_path / shown.folder, done)
    assert jobs.finished(shown, tmp_path) is not None
    assert jobs.finished(plain, tmp_path) is not None
    assert "--frames" not in jobs.make({"test": "elastic", "frames": 5}, tmp_path).command(
        tmp_path, tmp_path
    )
    for wrong in ({"frames": -1}, {"frames": "many"}, {"film": 3}):
        refusal("frames|film", jobs.make, {"test": "tension", **wrong}, tmp_path)


def test_a_study_takes_joints_and_a_saved_specimen(tmp_path, package_parent):
    """Both by paths from the study file's folder; laws of joints can be varied."""
    lines = tmp_path / "cracks.csv"
    lines.write_text("x1,y1,x2,y2,name\n-0.001,0.005,0.011,0.015,weak\n")
    law = "set.joint.weak.normal_stiffness = 1e13\nset.joint.weak.shear_stiffness = 5e12\n"
    law += "set.joint.weak.friction = 0.5\n"
    laws = ["normal_stiffness=1e13", "shear_stiffness=5e12", "friction=0.5"]
    sizes = SMALL.replace("\n", " ").replace(" = ", "=").split()
    size = {name: float(value) for name, value in (one.split("=") for one in sizes)}
    cut = flexpm.Specimen.rectangle(**size, seed=3).with_joints(joint_lines.read(lines))
    cut.save(tmp_path / "cut.json")
    rock = materials.load().with_set([*(f"joint.weak.{one}" for one in laws), "young=30e9"])
    expected = flexpm.elastic(cut, rock)["youngs_modulus"]
    grid = "[grid]\nset.young = [30e9, 40e9]\n"
    packed = f'[[case]]\njoints = "cracks.csv"\nseed = 2\n{SMALL}'
    packed += packed.replace("seed = 2", "seed = 3")  # that of the file: one run
    read = '[[case]]\nspecimen = "cut.json"\n'
    path = file_of(tmp_path, f'[common]\ntest = "elastic"\n{law}{grid}{packed}{read}')
    done = captured(command(package_parent, "study", path, "--out", tmp_path / "out", "--quiet"))
    assert done.returncode == 0, done.stderr
    rows = pandas.read_csv(tmp_path / "out" / "table.csv", float_precision="round_trip")
    found = rows["youngs_modulus"].tolist()
    assert len(found) == 4
    assert found[2] == expected < found[3]
    assert found[0] != expected


def made_up(folder: Path, **inputs) -> tuple[jobs.Job, dict]:
    job = jobs.make(inputs, folder)
    peak = 1e6 * (1 + inputs["seed"]) + inputs["set.cohesion"]
    return job, {"exit_code": 0, "message": "", "result": {"peak_stress": peak, "status": "ok"}}


def test_pictures_show_means_over_packings(tmp_path):
    pairs = [
        made_up(tmp_path, test="uniaxial", model=model, seed=seed, **{"set.cohesion": cohesion})
        for model, seed, cohesion in itertools.product(("rigid", "inner"), (1, 2), (1e7, 2e7))
    ]
    made = [job for job, _ in pairs]
    rows = tables.table(made, [outcome for _, outcome in pairs])
    assert list(rows["peak_stress"][:2]) == [1.2e7, 2.2e7]
    pictures = figures.draw(study.Study("means", made), rows, tmp_path)
    assert imread(pictures[0]).shape[0] > 300
    asked = [{"x": "seed", "y": "peak_stress", "by": ["model"], "file": "x.png"}]
    assert figures.draw(study.Study("s", made, asked), rows, tmp_path) == [tmp_path / "x.png"]
    with pytest.raises(InputError, match="did you mean peak_stress"):
        figures.draw(study.Study("s", made, [{"x": "seed", "y": "peak_stres"}]), rows, tmp_path)


def test_lines_are_told_apart_by_text_and_numbers_together(tmp_path, monkeypatch):
    lines = []
    monkeypatch.setattr(
        Axes, "errorbar", lambda *a, **given: lines.append((given["label"], a[1:3]))
    )
    monkeypatch.setattr(Axes, "legend", lambda *a, **given: None)
    rows = pandas.DataFrame(
        {"model": model, "set.friction": friction, "x": x, "y": x + friction}
        for model, friction, x in itertools.product(("a", "b"), (0.2, 0.5), (1.0, 2.0))
    )
    asked = [{"x": "x", "y": "y", "by": ["model", "set.friction"]}]
    figures.draw(study.Study("s", [], asked), rows, tmp_path)
    names = [label for label, _ in lines]
    assert names == [f"{m}, friction {f}" for m in ("a", "b") for f in (0.2, 0.5)]
    assert [list(drawn[1]) for _, drawn in lines] == 2 * [[1.2, 2.2], [1.5, 2.5]]


@pytest.mark.long
def test_yade_batch_does_the_runs_of_the_study(tmp_path, package_parent):
    sources = ROOT / "scripts/studies"
    asked = study.read(sources / "cohesion.toml").jobs
    lines = (sources / "cohesion.table").read_text().splitlines()
    columns = [line.split() for line in lines if not line.startswith("#")]
    table = {(row[1].strip("'"), float(row[2]), int(row[3])) for row in columns[1:]}
    keys = ("model", "set.cohesion", "seed")
    assert table == {tuple(job.inputs[key] for key in keys) for job in asked}

    shutil.copy(sources / "cohesion_batch.py", tmp_path)
    # one job of the table, on a smaller specimen
    script = (tmp_path / "cohesion_batch.py").read_text().replace("0.02, 0.04", "0.01, 0.02")
    (tmp_path / "cohesion_batch.py").write_text(script)
    (tmp_path / "table").write_text("\n".join([lines[1], "1 'rigid' 3e7 2"]) + "\n")
    batch = ["yade-batch", "-j1", "--job-threads=1", "table", "cohesion_batch.py"]
    environment = dict(os.environ, PYTHONPATH=str(package_parent))
    environment.pop("DISPLAY", None)
    done = captured(batch, cwd=tmp_path, env=environment)
    # the program's own exit code is 0 even if a job failed
    assert done.returncode == 0 and "FAILED" not in done.stdout, done.stdout
    found = json.loads((tmp_path / "batch-rigid-3e+07-2/result.json").read_text())
    inputs = {**asked[-1].inputs, "width": 0.01, "height": 0.02, "set.cohesion": 3e7, "seed": 2}
    rows = study.run(study.Study("same", [jobs.make(inputs, tmp_path)]), tmp_path / "study")
    assert rows["peak_stress"][0] == found["peak_stress"]


@pytest.mark.parametrize(
    "path", sorted(ROOT.glob("scripts/paper/*.toml")), ids=lambda path: path.stem
)
def test_the_papers_study_files_are_valid(path):
    assert len(study.read(path).jobs) > 10
    assert (path.with_suffix(".py")).exists()


def test_keys_of_other_models_are_left_out_and_those_of_none_refused(tmp_path):
    both = '[common]\ntest = "uniaxial"\nset.young = 6e10\n[grid]\nmodel = ["flexible", "rigid"]\n'
    made = study.read(file_of(tmp_path, both)).jobs
    assert [job.inputs.get("set.young") for job in made] == [6e10, None]
    with pytest.raises(InputError, match=r"study set.young, is used by no model of the study"):
        study.read(file_of(tmp_path, both.replace('"flexible", ', "")))
