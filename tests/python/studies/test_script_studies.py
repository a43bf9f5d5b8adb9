# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of scripts and functions: parameters in, a folder out, what fails is a row."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pandas
import pytest
from processes import captured
from refusals import refusal

import flexpm
from flexpm.cli import main as cli
from flexpm.studies import scripts, study

PACKAGES = str(Path(flexpm.__file__).parents[1])
SIZE = "H = 0.012\n"
BEAM = """
import sys, threading
import flexpm
from size import H

asked = flexpm.study.parameters(out="beam", seed=1, rate=4.0, way="good")
if asked["way"] == "hang":
    threading.Event().wait()
if asked["way"] == "exit":
    sys.exit(7)
if asked["way"] == "empty":
    sys.exit()
specimen = flexpm.Specimen.rectangle(3 * H, H, 0.01, seed=asked["seed"])
rig = flexpm.PartRig(flexpm.build(specimen, model="rigid"), out=asked["out"], report=False)
rollers = [rig.support((x * H, 0.0), pinned=x < 1) for x in (0.5, 2.5)]
rig.drive(rig.support((1.5 * H, H)), (0.0, -1.0), against=rollers)
if asked["way"] == "error":
    1 / 0
rig.strain_to("far" if asked["way"] == "flexpm" else 5e-7, rate=asked["rate"])
"""
FUNCTION = """
import flexpm

def squeezed(out, seed, strain=2e-5):
    specimen = flexpm.Specimen.rectangle(0.01, 0.014, 0.01, seed=seed)
    rig = flexpm.rig(flexpm.build(specimen, model="rigid"), out=out, report=False)
    rig.strain_to(strain, rate=8.0)

if __name__ == "__main__":
    asked = flexpm.study.of(squeezed, {"seed": [1, 2]}, limit=300.0)
    print(len(flexpm.study.run(asked, "many", workers=2)))
"""


def laid(folder: Path, grid: str, more: str = "") -> Path:
    """A study of the beam in a folder."""
    (folder / "size.py").write_text(SIZE)
    (folder / "beam.py").write_text(BEAM)
    file = folder / "beams.toml"
    file.write_text(f'[study]\nscript = "beam.py"\n{more}[grid]\n{grid}\n')
    return file


def rows_of(folder: Path) -> list[dict]:
    table = pandas.read_csv(folder / "table.csv", keep_default_na=False)
    return table.to_dict("records")


@pytest.mark.long
def test_a_script_is_run_with_its_parameters_and_seeds(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file = laid(tmp_path, "rate = [8.0]\nseed = [9]")
    many = ["study", str(file), "--seeds", "1,2", "--workers", "2", "--quiet"]
    assert cli.main(many) == 0
    rows = rows_of(tmp_path / "beams")
    assert [(row["rate"], row["seed"]) for row in rows] == [(8.0, 1), (8.0, 2)]
    assert {row["exit_code"] for row in rows} == {0}
    for row in rows:
        place = tmp_path / "beams" / "runs" / row["key"]
        found = flexpm.Result.read(place)
        assert (found.seed, found.inputs["repeatable"]) == (row["seed"], True)
        told = row["peak_load"]  # nothing where the load still rises
        assert found.peak_load == (None if told == "" else pytest.approx(float(told)))
        assert not list(place.glob("checkpoint*"))
    assert (tmp_path / "beams" / "report.html").is_file()
    # what is finished is not run again
    outcomes = {one: one.stat().st_mtime_ns for one in tmp_path.glob("beams/runs/*/outcome.json")}
    assert cli.main(many) == 0
    assert {one: one.stat().st_mtime_ns for one in outcomes} == outcomes


@pytest.mark.long
def test_what_fails_is_a_row_with_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    ways = ["exit", "empty", "error", "flexpm"]
    file = laid(tmp_path, f"way = {json.dumps(ways)}")
    assert cli.main(["study", str(file), "--workers", "2", "--quiet"]) == 3
    told = {row["way"]: (row["exit_code"], row["message"]) for row in rows_of(tmp_path / "beams")}
    assert told == {
        "exit": (7, "the script ended by exit code 7"),
        "empty": (
            3,
            "no result.json was left in the folder of the run; give out to flexpm.PartRig",
        ),
        "error": (1, "ZeroDivisionError: division by zero"),
        "flexpm": (
            2,
            "strain_to: strain = 'far', must be a number; write it without quotes and unit",
        ),
    }
    assert (tmp_path / "beams" / "report.html").is_file()
    errors = capsys.readouterr().err
    assert "Traceback" not in errors


def test_a_run_that_hangs_is_ended(tmp_path):
    laid(tmp_path, "")
    script = scripts.Script(tmp_path / "beam.py", limit=4.0)
    plan = study.Study("hangs", [scripts.make(script, {"way": "hang"}, script.checksum())])
    (row,) = study.run(plan, tmp_path / "out", workers=1).to_dict("records")
    assert row["exit_code"] == 124
    assert row["message"] == "limit = 4 s, is over; raise it in [study]"


def test_the_key_holds_the_script_and_what_it_imports_beside_itself(tmp_path):
    file = laid(tmp_path, "rate = [4.0]")
    keys = [study.read(file).jobs[0].key for _ in range(2)]
    (tmp_path / "unused.py").write_text("x = 1\n")
    keys.append(study.read(file).jobs[0].key)
    assert len({*keys}) == 1
    (tmp_path / "size.py").write_text("H = 0.013\n")
    keys.append(study.read(file).jobs[0].key)
    (tmp_path / "beam.py").write_text(BEAM + "\n# another one\n")
    keys.append(study.read(file).jobs[0].key)
    keys.append(study.read(laid(tmp_path, "rate = [5.0]")).jobs[0].key)
    assert len({*keys}) == 4
    assert keys[-1] not in keys[:-1]


@pytest.mark.long
def test_a_function_is_run_by_processes(tmp_path):
    (tmp_path / "own.py").write_text(FUNCTION)
    done = captured(
        ["/usr/bin/python3", "own.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": PACKAGES},
        timeout=600,
    )
    assert (done.returncode, done.stdout.strip()) == (0, "2"), done.stderr
    assert {row["exit_code"] for row in rows_of(tmp_path / "many")} == {0}
    bare = FUNCTION.replace('if __name__ == "__main__":', "if True:")
    (tmp_path / "own.py").write_text(bare)
    again = captured(
        ["/usr/bin/python3", "own.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": PACKAGES, scripts._WITHIN: "1"},
        timeout=600,
    )
    assert "put the call below if __name__" in again.stderr.splitlines()[-1]


def named(out, seed):
    """A function of this module."""


def test_functions_that_cannot_be_sent_are_refused_first():
    def within(out, seed):
        pass

    for function in (within, lambda out, seed: None, print, named.__call__, 3):
        refusal("cannot be sent to workers", study.of, function, {"seed": [1]})
    refusal("missing a required argument: 'seed'", study.of, named, {})
    refusal("unexpected keyword argument 'rate'", study.of, named, {"seed": [1], "rate": [1.0]})
    assert [job.inputs for job in study.of(named, {"seed": [1, 2]}).jobs] == [
        {"seed": 1},
        {"seed": 2},
    ]


@pytest.mark.parametrize(
    ("grid", "more", "told"),
    [
        ("out = [1]", "", "study key = 'out', must be the name of a parameter"),
        ("rate = [{a = 1}]", "", "study rate = {'a': 1}, must be a number"),
        ("rate = [1.0]", "limit = -1.0\n", "study [study] limit = -1.0 s, must be"),
    ],
)
def test_wrong_studies_are_refused(tmp_path, grid, more, told):
    refusal(told, study.read, laid(tmp_path, grid, more))


def test_scripts_that_are_none_are_refused(tmp_path):
    file = laid(tmp_path, "rate = [1.0]")
    (tmp_path / "beam.py").write_text("def (\n")
    refusal("is not a Python script", study.read, file)
    (tmp_path / "beam.py").unlink()
    refusal("cannot be read", study.read, file)
    file.write_text('[study]\nlimit = 3.0\n[common]\ntest = "tension"\n')
    refusal("must not be given without script", study.read, file)


def test_parameters_are_of_the_kind_of_their_defaults(monkeypatch):
    monkeypatch.setattr("sys.argv", ["own.py", "--seed", "3", "--rate", "2", "--long-way", "true"])
    found = flexpm.study.parameters(out="o", seed=1, rate=1.0, long_way=False)
    assert found == {"out": "o", "seed": 3, "rate": 2.0, "long_way": True}
    assert type(found["rate"]) is float
    refusal("unknown; known are out", flexpm.study.parameters, out="o")
    for wrong in (["--seed", "x"], ["--seed"], ["seed", "1"], ["--flag", "perhaps"]):
        monkeypatch.setattr("sys.argv", ["own.py", *wrong])
        refusal("", flexpm.study.parameters, seed=1, flag=True)
