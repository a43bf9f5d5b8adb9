# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a run: where they are taken, what they hold, and that they change nothing."""

from __future__ import annotations

import json
import signal
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from killed_scripts import content, ended, killed, require_same, started
from PIL import Image
from refusals import refusal
from step_clock import step_clock
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import flexpm
from flexpm import files
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.report import film
from flexpm.results import measures
from flexpm.results.result import Result
from flexpm.results.vtu import cell_arrays, read_vtu
from flexpm.rigs import frames
from flexpm.runs.output import FILM_FRAMES, Output

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


@pytest.mark.long
def test_frames_do_not_change_a_run(specimen, filmed, tmp_path):
    flexpm.run("uniaxial", specimen, rate=4.0, out=tmp_path)
    for name in ("curve.csv", "cracks.csv"):
        assert (tmp_path / name).read_bytes() == (filmed / name).read_bytes()
    assert not (tmp_path / frames.FOLDER).exists()


@pytest.mark.long
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


def test_the_state_for_paraview_shows_arrays_and_frames_that_are_there(filmed):
    root = ElementTree.parse(filmed / frames.STATE).getroot()
    proxies = {one.get("id"): one for one in root.iter("Proxy") if one.get("type")}
    assert len(proxies) > 10
    named = {one.get("value") for one in root.iter("Proxy") if one.get("value")}
    assert named <= proxies.keys()
    assert {one.get("id") for one in root.iterfind(".//ProxyCollection/Item")} == proxies.keys()
    # a view that is in no tab is not shown
    (shown,) = root.iterfind(".//Layout/Item")
    assert proxies[shown.get("view")].get("type") == "RenderView"

    def values(name):
        found = root.iterfind(f".//Property[@name='{name}']")
        return [[value.get("value") for value in one] for one in found]

    assert values("FileName") == [[str(filmed / frames.COLLECTION)]]
    found = frames.read(filmed)
    assert values("TimestepValues") == [[str(one.step) for one in found]]
    assert values("ViewTime") == [[str(found[-1].step)]]
    state = read_vtu(filmed / found[-1].file)
    cells = cell_arrays(state)
    used = [one[-1] for one in values("ColorArrayName") + values("SelectInputScalars")]
    assert used == ["principal_stress_2", "crack_mode", "kind", "crack_mode"]
    assert set(used) <= cells.keys()
    # the colours hold the compression at the peak
    low, high = (float(values("RGBPoints")[0][index]) for index in (0, -4))
    assert (-1.5 * max(one.axial_stress for one in found)) < low < -1e7
    assert high == 0.0
    assert np.allclose([float(one) for one in values("CameraFocalPoint")[0]], (0.006, 0.012, 0.0))


def test_the_state_of_a_pulled_specimen_shows_tension(specimen, tmp_path):
    flexpm.run("tension", specimen, out=tmp_path, frames=2, max_strain=2e-5)
    text = (tmp_path / frames.STATE).read_text()
    assert "principal_stress_1" in text
    assert "principal_stress_2" not in text


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


@pytest.mark.skipif(not film.has_ffmpeg(), reason="needs ffmpeg")
def test_a_film_of_kind_mp4_has_the_frames(specimen, tmp_path):
    options = {"max_strain": 2e-4, "rate": 4.0}
    flexpm.run("tension", specimen, out=tmp_path, frames=3, film="mp4", **options)
    ask = "ffprobe -v error -count_frames -show_streams -of json".split()
    done = subprocess.run([*ask, tmp_path / "film.mp4"], check=True, capture_output=True)
    (stream,) = json.loads(done.stdout)["streams"]
    assert stream["codec_name"] == "h264"
    assert stream["pix_fmt"] == "yuv420p"  # what browsers and presentations play
    assert int(stream["nb_read_frames"]) == len(frames.read(tmp_path))
    assert min(stream["width"], stream["height"]) > 400


class _Interrupt:
    """Interrupts a run that has written some frames."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __call__(self, done: float, expected: float, text: str) -> None:
        table = self.folder / frames.TABLE
        if table.exists() and len(frames.read(self.folder)) > 3:
            raise KeyboardInterrupt


def test_a_run_that_is_taken_up_keeps_its_frames(specimen, tmp_path, monkeypatch):
    step_clock(monkeypatch.setattr, look=10)
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
    refusal(message, flexpm.run, "tension", specimen, out=tmp_path, **options)
    assert not list(tmp_path.iterdir())


def test_frames_of_a_complete_run_need_the_run_again(specimen, tmp_path):
    """They would be the last one alone."""
    short = {"max_strain": 2e-5, "out": tmp_path / "run"}
    flexpm.run("tension", specimen, **short)
    with pytest.raises(InputError, match="frames = 2, must be 0 in .*rerun .*run --frames 2"):
        flexpm.run("tension", specimen, frames=2, **short)
    assert not (tmp_path / "run" / frames.TABLE).exists()
    rerun = ["rerun", str(tmp_path / "run"), "--frames", "2", "--out", str(tmp_path / "again")]
    assert cli.main([*rerun, "--quiet"]) == 3  # a test without a peak
    before = frames.read(tmp_path / "again")
    assert len(before) > 1
    # a film of frames that are there needs no run
    assert cli.main([*rerun, "--quiet", "--film", "gif"]) == 3
    assert frames.read(tmp_path / "again") == before
    assert (tmp_path / "again" / "film.gif").exists()


def test_each_run_of_a_comparison_has_its_frames(tmp_path):
    size = ["--width", "0.012", "--height", "0.024", "--rate", "6", "--quiet"]
    command = ["compare", "uniaxial", *size, "--frames", "2", "--out", str(tmp_path)]
    assert cli.main(command) == 0
    for model in ("flexible", "rigid"):
        assert len(frames.read(tmp_path / model)) >= 4
        assert (tmp_path / model / frames.STATE).exists()


@pytest.mark.long
def test_each_run_of_several_packings_has_its_frames_also_afterwards(tmp_path):
    size = ["--width", "0.012", "--height", "0.024", "--max-strain", "2e-5", "--quiet"]
    command = ["run", "tension", *size, "--seeds", "1-2", "--out", str(tmp_path)]
    assert cli.main(command) == 3
    curves = [(tmp_path / f"seed-{seed}" / "curve.csv").read_bytes() for seed in (1, 2)]
    assert cli.main([*command, "--frames", "2"]) == 3
    for seed in (1, 2):
        assert len(frames.read(tmp_path / f"seed-{seed}")) > 1
        assert (tmp_path / f"seed-{seed}" / "curve.csv").read_bytes() == curves[seed - 1]
    before = (tmp_path / "seed-1" / frames.TABLE).stat().st_mtime_ns
    assert cli.main([*command, "--frames", "1"]) == 3  # fewer than there are: nothing to do
    assert (tmp_path / "seed-1" / frames.TABLE).stat().st_mtime_ns == before


def test_frames_need_a_folder(specimen):
    refusal("frames = 40, must be 0 without out", flexpm.run, "tension", specimen, film="gif")


def test_a_film_takes_frames_and_mp4_takes_ffmpeg(monkeypatch):
    assert Output(film="gif").frames == FILM_FRAMES
    monkeypatch.setattr(film, "has_ffmpeg", lambda: False)
    refusal("needs ffmpeg", Output, film="mp4")
    monkeypatch.setattr(film, "has_ffmpeg", lambda: True)
    assert Output(film="mp4", frames=3).frames == 3


def test_the_command_takes_frames(tmp_path):
    size = ["--width", "0.012", "--height", "0.024", "--max-strain", "1e-4", "--quiet"]
    command = ["run", "tension", *size, "--frames", "3", "--out", str(tmp_path)]
    assert cli.main(command) == 3
    assert len(frames.read(tmp_path)) >= 2
    assert cli.main([*command[:-1], str(tmp_path / "x"), "--frames", "-3"]) == 2


@pytest.mark.parametrize(
    "name", ["../victim.vtu", "/tmp/victim.vtu", "frames/../../victim.vtu", "frames/frame-٣.vtu"]
)
def test_a_table_that_names_other_files_is_refused(tmp_path, name):
    """A run removes files by the names that stand there."""
    folder = tmp_path / "run"
    (folder / frames.FOLDER).mkdir(parents=True)
    rows = [(step, 1e-6 * step, 0.0, "even", name) for step in range(41)]
    (folder / frames.TABLE).write_text(files.csv_text(frames.Frame._fields, rows))
    (tmp_path / "victim.vtu").touch()
    refusal("is no frame", frames.read, folder)
    refusal("is no frame", frames.FrameWriter, folder, 2, {}, resumed_at=99)
    assert (tmp_path / "victim.vtu").exists()


PULLED_BACK = """
import flexpm
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)

rig = flexpm.PartRig(flexpm.build(made, model="rigid"), frames=1, out="out")
top, floor = (rig.platen(side, bonded=True, friction=0.3) for side in (2, 0))
rig.drive(top, (0.0, -1.0), against=floor, area=1.2e-4, length=0.012)
rig.strain_to(-1e-5)
"""


def test_an_own_test_that_has_gone_back_is_taken_up_with_its_frames(tmp_path):
    """Its frames are those of an uninterrupted test, without the end of the first start."""
    further = PULLED_BACK + "rig.strain_to(-2e-5)\n"
    resumed, whole = tmp_path / "resumed", tmp_path / "whole"
    for folder, scripts in ((resumed, (PULLED_BACK, further)), (whole, (further,))):
        folder.mkdir()
        for script in scripts:
            assert ended(started(folder, script)) == (0, "")
    found = frames.read(resumed / "out")
    assert found == frames.read(whole / "out") and found[-1].axial_strain < -1.9e-5


CYCLED = """
import flexpm
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)

built = flexpm.build(made, model="rigid")
rig = flexpm.PartRig(built, out="out", frames=3, checkpoint_interval=INTERVAL)
floor, top = rig.platen(0, friction=0.5), rig.platen(2, friction=0.5)
rig.drive(top, (0.0, -1.0), against=floor)
rig.cycle(50.0, 2)
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""


@pytest.mark.long
def test_a_killed_own_test_has_the_frames_of_an_unbroken_one(tmp_path):
    (tmp_path / "whole").mkdir()
    assert ended(started(tmp_path / "whole", CYCLED)) == (0, "")
    whole = tmp_path / "whole" / "out"
    last = content(whole)["steps"]
    killed(tmp_path, CYCLED, [[(signal.SIGKILL, last // 3), (signal.SIGKILL, 2 * last // 3)]])
    folder = tmp_path / "0"
    require_same(folder, whole)
    assert frames.read(folder) == frames.read(whole)
    files = sorted(file.name for file in (folder / frames.FOLDER).iterdir())
    assert files == sorted(file.name for file in (whole / frames.FOLDER).iterdir())
    for name in files:
        pair = ((one / frames.FOLDER / name).read_bytes() for one in (folder, whole))
        assert len({*pair}) == 1, name


IN_PLANE = """
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)
rig = flexpm.PartRig(flexpm.build(made, model="rigid"), frames=3, out=OUT, report=False)
top, floor = (rig.platen(side, friction=0.5) for side in (2, 0))
rig.drive(top, (0.0, -1.0), against=floor)
rig.load(flexpm.Loading(rate=16.0, kind="waiting", max_strain=2e-4))
"""
IN_SPACE = """
made = flexpm.Specimen.box(0.012, 0.012, 0.012, diameters=(4e-3, 6e-3), seed=1)
rig = flexpm.SolidPartRig(flexpm.build(made, model="rigid"), frames=3, out=OUT, report=False)
top, floor = (rig.platen(side, friction=0.5) for side in (2, 0))
rig.drive(top, (0.0, 0.0, -1.0), against=floor)
rig.load(flexpm.Loading(rate=16.0, kind="waiting", max_strain=2e-4))
"""
#: Kills a script that has loaded its specimen, before it draws.
KILLED_AT_ITS_END = """
import os, signal
from flexpm.rigs.outcome import kept
kept.draw_pictures = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
"""


def in_function(test: str, *names: str) -> str:
    """A script whose tests are in a function, and have no rig any more when it ends."""
    lines = "".join(f"    {line}\n" for line in test.strip().splitlines())
    calls = "".join(f"yade.O.reset()\ntest({name!r})\n" for name in names)
    return f"import flexpm, yade\n\ndef test(OUT):\n{lines}\n{calls}"


@pytest.mark.long
@pytest.mark.parametrize("test", [IN_PLANE, IN_SPACE], ids=["plane", "space"])
def test_rigs_that_are_gone_at_the_end_of_their_script_leave_all_frames(tmp_path, test):
    """The last test, one before it, and one that was killed before its pictures were drawn."""
    plain = "import flexpm\n" + test.replace("OUT", "'whole'")
    assert ended(started(tmp_path, plain)) == (0, "")
    assert ended(started(tmp_path, in_function(test, "first", "last"))) == (0, "")
    script = in_function(test, "killed")
    assert ended(started(tmp_path, KILLED_AT_ITS_END + script))[0] == -signal.SIGKILL
    assert ended(started(tmp_path, script)) == (0, "")
    whole = frames.read(tmp_path / "whole")
    assert whole[-1].step == content(tmp_path / "whole")["steps"]
    for name in ("first", "last", "killed"):
        require_same(tmp_path / name, tmp_path / "whole")
        assert frames.read(tmp_path / name) == whole, name
        assert (tmp_path / name / frames.STATE).is_file()
        for one in whole:
            pair = ((tmp_path / folder / one.file).read_bytes() for folder in (name, "whole"))
            assert len({*pair}) == 1, one.file
