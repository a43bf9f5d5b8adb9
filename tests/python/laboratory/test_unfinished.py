# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a run that was stopped: its tables, its page, and who takes it for finished."""

from __future__ import annotations

import csv
import json
import shutil

import numpy as np
import pytest
from refusals import refusal
from step_clock import STEP, step_clock

import flexpm
from flexpm.cli import main as cli
from flexpm.laboratory import carrying_out
from flexpm.models.options import SPHERE_MODELS
from flexpm.studies import jobs, pages

FLAT = {"width": 0.012, "height": 0.024, "thickness": 0.01, "seed": 1}
BOX = {"width": 0.01, "depth": 0.01, "height": 0.02, "seed": 1}
BEAM = {"width": 0.03, "depth": 0.008, "height": 0.008, "seed": 1}
#: Tests of ends, parts and discs, in 2D and 3D: shape, sizes, options, and step of the stop.
CASES = {
    "tension": ("rectangle", FLAT, {"rate": 2.0}, 100),
    "biaxial": ("rectangle", FLAT, {"confinement": 4e6, "model": "rigid", "rate": 4.0}, 700),
    "bending": ("box", BEAM, {"model": "rigid", "rate": 8.0, "stop_ratio": 0.8}, 60),
    "uniaxial": ("box", BOX, {"model": "rigid", "rate": 4.0}, 100),
}
TABLES = ("curve.csv", "cracks.csv", "events.csv", "fragments.csv")


class StopError(Exception):
    """The run is stopped here."""


def rows_of(file):
    with file.open(newline="") as table:
        return [*csv.DictReader(table)]


@pytest.fixture(params=CASES)
def stopped(request, tmp_path, monkeypatch):
    """Name, specimen, options and folder of a run that nobody has ended."""
    shape, sizes, options, last = CASES[request.param]
    specimen = getattr(flexpm.Specimen, shape)(**sizes)
    step_clock(monkeypatch.setattr, look=10)

    def stop(done, expected, text):
        if done > last:
            raise StopError

    with pytest.raises(StopError):  # as a kill, it leaves what was written before
        flexpm.run(
            *(request.param, specimen),
            **{**options, "out": tmp_path, "progress": stop, "checkpoint_interval": 40 * STEP},
        )
    assert (tmp_path / "checkpoint.json").exists() and (tmp_path / "unfinished.json").exists()
    return request.param, specimen, options, tmp_path


def test_a_stopped_run_has_the_first_rows_of_the_whole_one(stopped, tmp_path_factory):
    test, specimen, options, folder = stopped
    assert not (folder / "result.json").exists()
    so_far = json.loads((folder / "unfinished.json").read_text())
    assert so_far["status"] == "unfinished" and so_far["test"] == test
    early, cracks = rows_of(folder / "curve.csv"), rows_of(folder / "cracks.csv")
    assert so_far["steps"] == int(float(early[-1]["step"]))
    refusal(r"result\.json", flexpm.Result.read, folder)

    assert cli.main(["report", str(folder)]) == 0
    page = (folder / "report.html").read_text()
    assert "unfinished" in page and "resumes from its checkpoint" in page
    assert "flexpm rerun result.json" not in page

    again = flexpm.run(test, specimen, out=folder, report=False, **options)
    assert again.resumed_at > 0
    assert not (folder / "unfinished.json").exists() and not (folder / "report.html").exists()
    whole = tmp_path_factory.mktemp("whole")
    flexpm.run(test, specimen, out=whole, report=False, **options)
    for name in TABLES:
        assert (folder / name).read_bytes() == (whole / name).read_bytes(), name
    ended = rows_of(whole / "curve.csv")
    assert early == ended[: len(early)] and len(early) < len(ended)
    assert len(cracks) <= len(rows_of(whole / "cracks.csv"))


@pytest.mark.long
@pytest.mark.parametrize("model", SPHERE_MODELS)
def test_tables_that_are_written_under_way_change_no_result(model, tmp_path, monkeypatch):
    """Cracks of spheres have the step at which they are found: tables must not find them."""
    step_clock(monkeypatch.setattr, look=10)
    written, write = [], carrying_out.write_so_far
    monkeypatch.setattr(carrying_out, "write_so_far", lambda *given: written.append(write(*given)))
    specimen, often = flexpm.Specimen.rectangle(**FLAT), {"checkpoint_interval": 50 * STEP}
    for name, options in (("often", often), ("never", {})):
        out = tmp_path / name
        flexpm.run("uniaxial", specimen, model=model, out=out, report=False, **options)
        assert (len(written) > 5) == (name == "often")
        written.clear()
    for name in (*TABLES[:2], "fragments.csv", "final.vtu"):
        often, never = ((tmp_path / kind / name).read_bytes() for kind in ("often", "never"))
        assert often == never, name


def test_a_finished_folder_keeps_its_files_while_it_is_made_again(tmp_path, monkeypatch):
    specimen, options = flexpm.Specimen.rectangle(**FLAT), {"model": "rigid", "rate": 4.0}
    flexpm.run("tension", specimen, out=tmp_path, **options)
    before = (tmp_path / "curve.csv").read_bytes()
    for file in tmp_path.glob("checkpoint*"):
        file.unlink()
    step_clock(monkeypatch.setattr, look=10)

    def stop(done, expected, text):
        if done > 100:
            raise StopError

    with pytest.raises(StopError):
        flexpm.run(
            "tension", specimen, out=tmp_path, progress=stop, checkpoint_interval=STEP, **options
        )
    assert (tmp_path / "checkpoint.json").exists()  # tables were due, too
    assert (tmp_path / "curve.csv").read_bytes() == before
    assert not (tmp_path / "unfinished.json").exists()


def test_a_study_takes_no_unfinished_folder_for_a_result(tmp_path):
    specimen, place = flexpm.Specimen.rectangle(**FLAT), tmp_path / "flexible"
    result = flexpm.run("tension", specimen, out=place, rate=4.0, report=False)
    assert [*pages._results(tmp_path, ["flexible"])] == ["flexible"]
    shutil.move(place / "result.json", place / "unfinished.json")
    assert pages._results(tmp_path, ["flexible"]) == {}
    assert jobs._measures(place / "result.json") == {}
    read = flexpm.Result.read(place, "unfinished.json")
    assert np.array_equal(read.curve["step"], result.curve["step"])
