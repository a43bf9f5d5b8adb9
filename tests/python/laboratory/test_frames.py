# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a run: where they are taken, what they hold, and that they change nothing."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.laboratory import frames, runner
from flexpm.laboratory.output import FILM_FRAMES, Output
from flexpm.report import film
from flexpm.results import measures
from flexpm.results.result import Result
from flexpm.results.vtu import read_vtu

WANTED = 6


@pytest.fixture(scope="module")
def specimen():
    return flexpm.Specimen.rectangle(0.012, 0.024, 0.01)


@pytest.fixture(scope="module")
def filmed(specimen, tmp_path_factory) -> Path:
    """Folder of a run with frames and a film."""
    folder = tmp_path_factory.mktemp("frames")
    flexpm.run("uniaxial", specimen, rate=4.0, out=folder, frames=WANTED, film="gif")
    return folder


def test_frames_do_not_change_a_run(specimen, filmed, tmp_path):
    flexpm.run("uniaxial", specimen, rate=4.0, out=tmp_path)
    for name in ("curve.csv", "cracks.csv"):
        assert (tmp_path / name).read_bytes() == (filmed / name).read_bytes()
    assert not (tmp_path / frames.FOLDER).exists()


@pytest.mark.parametrize("model", ["rigid", "inner", "jcfpm"])
def test_frames_change_no_run_of_other_models(specimen, tmp_path, model):
    options = {"model": model, "max_strain": 5e-4, "rate": 4.0}
    plain = flexpm.run("tension", specimen, out=tmp_path / "plain", **options)
    watched = flexpm.run("tension", specimen, out=tmp_path / "seen", frames=4, **options)
    assert np.array_equal(watched.curve.array, plain.curve.array, equal_nan=True)
    assert len(frames.read(tmp_path / "seen")) > 2


def test_frames_lie_at_even_strains_and_around_the_peak(filmed):
    found = frames.read(filmed)
    record = Result.read(filmed).curve
    assert [one.step for one in found] == sorted({one.step for one in found})
    for one in found:
        row = int(np.flatnonzero(record["step"] <= max(one.step, record["step"][0]))[-1])
        assert one.axial_strain in (record["axial_strain"][row], 0.0)
    *even, last = (one for one in found if one.kind == "even")
    assert WANTED <= len(even) <= 2 * WANTED
    ways = np.diff([one.axial_strain for one in even])
    assert np.ptp(ways) < 0.2 * np.mean(ways)  # to a row of the record
    assert last.step == record["step"][-1]
    peak = record["axial_stress"][measures.peak_row(record)]
    stresses = [one.axial_stress / peak for one in found if one.kind == "peak"]
    assert max(stresses) == pytest.approx(1.0, abs=0.0101)
    assert any(0.7 < share < 0.955 for share in stresses)


def test_frames_that_are_too_close_are_thinned(specimen, tmp_path):
    """A test that strains ten times as far as its reference has not ten times the frames."""
    options = {"max_strain": 0.012, "stop_ratio": 0.01, "rate": 8.0}
    flexpm.run("uniaxial", specimen, out=tmp_path, frames=2, **options)
    found = frames.read(tmp_path)
    even = [one for one in found if one.kind == "even"][:-1]
    assert 2 <= len(even) <= 4
    files = sorted(f"{frames.FOLDER}/{file.name}" for file in (tmp_path / "frames").iterdir())
    assert files == [one.file for one in found]


def test_the_list_for_paraview_names_the_frames(filmed):
    root = ElementTree.parse(filmed / frames.COLLECTION).getroot()
    sets = root.findall("Collection/DataSet")
    found = frames.read(filmed)
    assert [one.get("file") for one in sets] == [one.file for one in found]
    assert [float(one.get("timestep")) for one in sets] == [one.step for one in found]
    assert all((filmed / one.get("file")).is_file() for one in sets)


def test_a_frame_says_what_it_is_of_and_in_which_units(filmed):
    one = frames.read(filmed)[3]
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(filmed / one.file))
    reader.Update()
    field = reader.GetOutput().GetFieldData()
    texts = {"test": "uniaxial", "model": "flexible", "material": "augig-table7", "kind": one.kind}
    for name, text in texts.items():
        assert field.GetAbstractArray(name).GetValue(0) == text
    numbers = {"seed": 1, "step": one.step, "axial_strain": one.axial_strain}
    for name, number in numbers.items():
        assert field.GetArray(name).GetTuple1(0) == number
    for name, unit in {"grain_stress": "Pa", "opening": "m", "damage": "-"}.items():
        array = reader.GetOutput().GetCellData().GetArray(name)
        assert array.GetInformation().Get(array.UNITS_LABEL()) == unit


def test_a_frame_is_read_back_as_a_state(filmed):
    found = frames.read(filmed)
    first, last = (read_vtu(filmed / found[n].file) for n in (0, -1))
    result = Result.read(filmed)
    assert np.count_nonzero(last.crack_step >= 0) == len(result.cracks)
    assert len(last.fragments) == result.fragments
    assert np.all(first.crack_mode == 0)
    assert np.allclose(first.reference, last.reference, atol=1e-12)


def test_a_film_has_the_frames(filmed):
    with Image.open(filmed / "film.gif") as shown:
        assert 2 < shown.n_frames <= len(frames.read(filmed))
        shown.seek(shown.n_frames - 1)
        assert len(shown.convert("RGB").getcolors(2**20)) > 20


class _Interrupt:
    """Interrupts a run that has written some frames."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __call__(self, done: float, expected: float, text: str) -> None:
        table = self.folder / frames.TABLE
        if table.exists() and len(frames.read(self.folder)) > 3:
            raise KeyboardInterrupt


def test_a_run_that_is_taken_up_keeps_its_frames(specimen, tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "_LOOK_UP", 1e-4)  # on a busy machine, too
    options = {"out": tmp_path, "frames": 500, "rate": 0.01, "loading": "constant"}
    options["max_strain"] = 2e-4
    with pytest.raises(KeyboardInterrupt):
        flexpm.run("uniaxial", specimen, progress=_Interrupt(tmp_path), **options)
    before = frames.read(tmp_path)
    assert len(before) > 1
    resumed = flexpm.run("uniaxial", specimen, **options)
    assert 0 < resumed.resumed_at < resumed.steps
    after = frames.read(tmp_path)
    assert after[: len(before)] == before
    assert len(after) > len(before)


def test_frames_of_another_run_are_removed(specimen, tmp_path):
    (tmp_path / frames.FOLDER).mkdir()
    old = tmp_path / frames.FOLDER / "frame-0000000007.vtu"
    other = tmp_path / frames.FOLDER / "notes.txt"
    for file in (old, other):
        file.write_text("mine")
    flexpm.run("tension", specimen, out=tmp_path, frames=1, max_strain=2e-5)
    assert not old.exists()
    assert other.exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"frames": -1}, "frames = -1, must be >= 0"),
        ({"frames": 1001}, "frames = 1001, must be .*1000"),
        ({"frames": 1.5}, "must be a whole number"),
        ({"film": "avi"}, "film"),
    ],
)
def test_what_cannot_be_filmed_is_refused(specimen, tmp_path, options, message):
    with pytest.raises(InputError, match=message):
        flexpm.run("tension", specimen, out=tmp_path, **options)
    assert not list(tmp_path.iterdir())


def test_frames_need_a_folder(specimen):
    with pytest.raises(InputError, match="frames = 40, must be 0 without out"):
        flexpm.run("tension", specimen, film="gif")


def test_a_film_takes_frames_and_mp4_takes_ffmpeg(monkeypatch):
    assert Output(film="gif").frames == FILM_FRAMES
    monkeypatch.setattr(film, "has_ffmpeg", lambda: False)
    with pytest.raises(InputError, match="needs ffmpeg"):
        Output(film="mp4")
    monkeypatch.setattr(film, "has_ffmpeg", lambda: True)
    assert Output(film="mp4", frames=3).frames == 3


def test_the_command_takes_frames(tmp_path):
    size = ["--width", "0.012", "--height", "0.024", "--max-strain", "1e-4", "--quiet"]
    command = ["run", "tension", *size, "--frames", "3", "--out", str(tmp_path)]
    assert cli.main(command) == 3
    assert len(frames.read(tmp_path)) >= 2
    assert cli.main([*command[:-1], str(tmp_path / "x"), "--frames", "-3"]) == 2
    assert cli.main([*command[:-1], str(tmp_path / "x"), "--seeds", "1,2"]) == 2
