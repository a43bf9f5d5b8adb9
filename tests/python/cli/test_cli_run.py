# SPDX-License-Identifier: GPL-3.0-or-later
"""The command on small specimens, from start to finish: what it prints, writes and returns."""

import csv
import json

import numpy as np
import pytest
from matplotlib.image import imread
from sample_snapshot import read_vtu

import flexpm
from flexpm.cli import main as cli
from flexpm.results import measures
from flexpm.results.record import COLUMNS, Curve
from flexpm.rigs import frames
from flexpm.studies import jobs

SMALL = ["--width", "0.016", "--height", "0.032", "--thickness", "0.01", "--quiet"]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A small uniaxial test: exit code and folder."""
    folder = tmp_path_factory.mktemp("run") / "out"
    return cli.main(["run", "uniaxial", *SMALL, "--out", str(folder)]), folder


@pytest.mark.long
def test_a_run_writes_all_its_files(finished):
    code, folder = finished
    assert code == 0
    names = {file.name for file in folder.iterdir()}
    assert names >= {
        "result.json",
        "curve.csv",
        "curve.png",
        "specimen.vtu",
        "final.vtu",
        "cracks.csv",
        "cracks.png",
    }
    assert not [name for name in names if name.startswith(".")]
    assert imread(folder / "curve.png").shape[0] > 300


@pytest.mark.long
def test_the_files_of_a_run_agree(finished):
    folder = finished[1]
    result = json.loads((folder / "result.json").read_text())
    with (folder / "curve.csv").open() as file:
        names, *rows = csv.reader(file)
    assert names == [*COLUMNS, "volumetric_strain"]
    record = Curve.from_columns(names, np.array(rows, dtype=float), names[-1:])
    assert result["youngs_modulus"] == measures.youngs_modulus(record)
    assert result["poissons_ratio"] == measures.poissons_ratio(record)
    assert result["peak_stress"] == record["axial_stress"].max()
    with (folder / "cracks.csv").open() as file:
        cracks = list(csv.DictReader(file))
    modes = [crack["mode"] for crack in cracks]
    assert modes.count("tensile") == result["tensile_cracks"]
    assert modes.count("shear") == result["shear_cracks"]
    _, points, cells = read_vtu(folder / "final.vtu")
    contacts = cells["kind"] == 1
    touched = np.count_nonzero(contacts) - result["contacts"]  # discs that met later
    assert touched >= 0
    assert np.count_nonzero(~contacts) == result["triangles"]
    assert len(points["displacement"]) == result["nodes"] + 2 * np.count_nonzero(contacts)
    assert cells["cracked_points"][contacts].sum() == len(cracks)


@pytest.mark.long
def test_a_run_that_passes_no_peak_is_exit_code_3_with_its_files(capsys, tmp_path):
    folder = tmp_path / "out"
    arguments = ["run", "uniaxial", *SMALL, "--max-strain", "1e-3", "--out", str(folder)]
    assert cli.main(arguments) == 3
    errors = capsys.readouterr().err
    assert errors.startswith("flexpm: ")
    assert errors.count("\n") == 1
    result = json.loads((folder / "result.json").read_text())
    assert (result["status"], result["peak_stress"]) == ("no_peak", None)
    assert result["youngs_modulus"] == pytest.approx(24.4e9, rel=0.05)


def test_python_the_command_and_a_study_describe_a_run_alike(tmp_path):
    arguments = ["tension", *SMALL, "--max-strain", "1e-5", "--out", str(tmp_path)]
    assert cli.main(["run", *arguments]) == 3
    specimen = flexpm.Specimen.rectangle(0.016, 0.032, 0.01)
    expected = flexpm.run("tension", specimen, max_strain=1e-5).inputs
    sizes = {"width": 0.016, "height": 0.032, "thickness": 0.01}
    job = jobs.make({"test": "tension", "max_strain": 1e-5, **sizes}, tmp_path)
    assert job.spec.to_json() == expected
    for name in ("result.json", "checkpoint.json"):
        assert json.loads((tmp_path / name).read_text())["inputs"] == expected
    assert (expected["start"], expected["specimen"]["seed"]) == ("static", 1)


def test_the_elastic_solve_names_its_inputs(tmp_path):
    assert cli.main(["elastic", *SMALL, "--points", "2", "--out", str(tmp_path)]) == 0
    found = json.loads((tmp_path / "result.json").read_text())
    sizes = {"width": 0.016, "height": 0.032, "thickness": 0.01}
    job = jobs.make({"test": "elastic", "points": 2, **sizes}, tmp_path)
    assert found["inputs"] == job.spec.to_json()
    assert found["material"] == found["inputs"]["material"]


def test_elastic_prints_the_constants(capsys):
    assert cli.main(["elastic", *SMALL]) == 0
    output = capsys.readouterr().out
    assert "Young's modulus" in output
    assert "GPa" in output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["elastic", "--model", "inner", "--set", "poisson=0.48"], "poisson = 0.48, cannot be met"),
        (["elastic", "--model", "jcfpm"], "model = 'jcfpm', must be one of flexible"),
    ],
)
def test_what_a_model_cannot_do_is_refused_in_one_line(capsys, tmp_path, arguments, message):
    out = ["--out", str(tmp_path)] if arguments[0] == "run" else []
    assert cli.main([*arguments, *SMALL, *out]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.count("\n") == 1
    assert message in errors


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("test", ["uniaxial", "tension", "biaxial", "brazilian"])
def test_a_run_with_all_defaults_warns_of_nothing(capsys, tmp_path, test, model):
    size = "--diameter 0.02" if test == "brazilian" else "--width 0.02 --height 0.04"
    options = [*size.split(), "--model", model, "--quiet", "--out", str(tmp_path)]
    assert cli.main(["run", test, *options]) == 0
    said = capsys.readouterr()
    found = json.loads((tmp_path / "result.json").read_text())
    # contacts of rigid grains are as strong as the rock and soften from a tenth of its peak on
    early = model == "rigid" and test in ("uniaxial", "biaxial")
    told = ["poissons_ratio"] if early else []
    assert [line.split(" ")[0] for line in found["warnings"]] == told
    assert (said.out + said.err).count("warning") == len(told)


@pytest.mark.long
def test_a_complete_run_says_which_frames_it_has(tmp_path, capsys):
    """Another number of frames changes nothing, so the command says how many there are."""
    command = ["run", "tension", *SMALL, "--out", str(tmp_path), "--frames"]
    assert cli.main([*command, "3"]) == 0
    number = len(frames.read(tmp_path))
    told = f"frames                  {number} in {tmp_path / frames.COLLECTION}"
    assert told in capsys.readouterr().out
    assert cli.main([*command, "40"]) == 0
    out = capsys.readouterr().out
    assert told in out and "was complete" in out
