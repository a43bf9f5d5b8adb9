# SPDX-License-Identifier: GPL-3.0-or-later
"""A test on several packings: the runs are single runs, means leave out what failed."""

import csv
import json
import statistics

import click
import pandas
import pytest
from matplotlib.image import imread
from refusals import refusal, refused_command

from flexpm.cli import main as cli
from flexpm.cli.parameters import Seeds
from flexpm.report.words import words_of_test
from flexpm.studies import packings

SMALL = ["--width", "0.01", "--height", "0.02", "--thickness", "0.01", "--rate", "4", "--quiet"]
#: Up to this strain the packing of seed 1 passes no peak, that of seed 2 does.
SHORT = [*SMALL, "--max-strain", "6e-3", "--stop-ratio", "0.8"]


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """Two packings, of which one passes no peak: exit code and folder."""
    folder = tmp_path_factory.mktemp("packings") / "out"
    return cli.main(["run", "uniaxial", *SHORT, "--seeds", "1-2", "--out", str(folder)]), folder


def rows_of(path):
    return list(csv.DictReader(path.read_text().splitlines()))


def result_of(folder):
    return json.loads((folder / "result.json").read_text())


@pytest.mark.parametrize(
    ("text", "seeds"),
    [
        ("1-5", (1, 2, 3, 4, 5)),
        ("7", (7,)),
        ("1,3,7-9", (1, 3, 7, 8, 9)),
        ("9, 2 ,0-1", (9, 2, 0, 1)),
    ],
)
def test_seeds_are_numbers_and_ranges_in_the_order_given(text, seeds):
    assert Seeds().convert(text, None, None) == seeds


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "must be whole numbers and ranges"),
        ("1-", "must be whole numbers"),
        ("-3", "must be whole numbers"),
        ("1,,2", "must be whole numbers"),
        ("1.5", "must be whole numbers"),
        ("5-1", "must have increasing ranges; write 1-5"),
        ("1-3,2", "must name 2 once"),
        ("1-1001", "must be <= 1000 seeds, not 1001"),
        ("0-999999999,7", "must be <= 1000 seeds"),
    ],
)
def test_wrong_seeds_are_refused(text, message):
    refusal(message, lambda: Seeds().convert(text, click.Option(["--seeds"]), None))


def test_means_leave_out_failed_and_lost_runs():
    rows = pandas.DataFrame(
        {
            "test": "biaxial",
            "model": ["flexible"] * 4 + ["rigid"],
            "confinement": [1e6] * 5,
            "exit_code": [0, 0, 3, None, 0],
            "peak_stress": [1.0, 4.0, 100.0, 100.0, 7.0],
            **dict.fromkeys(set(words_of_test("uniaxial").measures) - {"peak_stress"}, 2.0),
        }
    ).convert_dtypes()
    flexible, rigid = packings.means(rows).to_dict("records")
    assert (flexible["runs"], flexible["failed"], flexible["peak_stress"]) == (4, 2, 2.5)
    assert flexible["peak_stress_deviation"] == pytest.approx(statistics.stdev([1.0, 4.0]))
    assert flexible["peak_stress_error"] == pytest.approx(1.5)
    assert rigid["peak_stress"] == 7.0
    assert pandas.isna(rigid["peak_stress_deviation"]) and pandas.isna(rigid["peak_stress_error"])


def test_a_run_that_failed_is_named_and_in_no_mean(short, capsys):
    code, folder = short
    assert code == 3
    assert next(iter(rows_of(folder / "table.csv")))["status"] == "no_peak"
    (row,) = rows_of(folder / "means.csv")
    good = result_of(folder / "seed-2")
    assert (row["runs"], row["failed"]) == ("2", "1")
    for name in words_of_test("uniaxial").measures:
        assert float(row[name]) == good[name]
    assert imread(folder / "curves.png").shape[0] > 300
    # the second start only reads what is there, and says the same
    before = {file: file.stat().st_mtime_ns for file in folder.glob("seed-*/*")}
    assert cli.main(["run", "uniaxial", *SHORT, "--seeds", "1-2", "--out", str(folder)]) == 3
    assert before == {file: file.stat().st_mtime_ns for file in folder.glob("seed-*/*")}
    said = capsys.readouterr()
    assert said.err.startswith(
        "flexpm: runs = seed-1, 1 of 2 failed and are not part of the means; status = no_peak"
    )
    assert said.err.count("\n") == 1
    lines = [line.split() for line in said.out.splitlines()]
    assert ["seed", "1"] in [line[:2] for line in lines] and lines[2][-1] == "no_peak"
    assert [line[-4:] for line in lines if line[0] == "mean"] == [["1", "of", "2", "runs"]]


def test_each_run_is_the_single_run(short, tmp_path):
    alone = ["run", "uniaxial", *SHORT, "--seed", "2", "--out", str(tmp_path)]
    assert cli.main(alone) == 0
    for name in ("curve.csv", "cracks.csv"):
        assert (tmp_path / name).read_text() == (short[1] / "seed-2" / name).read_text()
    assert result_of(tmp_path)["inputs"] == result_of(short[1] / "seed-2")["inputs"]


def test_a_folder_with_runs_of_other_inputs_is_refused(short, tmp_path, capsys):
    other = ["run", "uniaxial", *SMALL, "--max-strain", "1e-4"]
    assert cli.main([*other, "--seeds", "2-3", "--out", str(short[1])]) == 2
    assert "seed-2, has a run with other inputs; choose another folder" in capsys.readouterr().err
    # a single run that has left its checkpoint
    assert cli.main([*other, "--seed", "5", "--out", str(tmp_path / "seed-5")]) == 3
    faster = [*other, "--rate", "9", "--seeds", "5", "--out", str(tmp_path)]
    capsys.readouterr()
    refused_command(capsys, "seed-5, has a run with other inputs", *faster)
    assert cli.main([*faster, "--discard-checkpoint"]) == 3
    assert result_of(tmp_path / "seed-5")["inputs"]["rate"] == 9.0


@pytest.mark.long
def test_models_and_confinements_on_several_packings(tmp_path, capsys):
    arguments = ["compare", "biaxial", *SMALL, "--stop-ratio", "0.8", "--set", "cohesion=2e7"]
    some = ["--models", "rigid", "--confinements", "1e6,3e6", "--seeds", "1,3"]
    assert cli.main([*arguments, *some, "--workers", "2", "--out", str(tmp_path)]) == 0
    folders = [f"rigid/{pressure}MPa/seed-{seed}" for pressure in (1, 3) for seed in (1, 3)]
    rows = rows_of(tmp_path / "table.csv")
    assert [row["folder"] for row in rows] == folders
    results = [result_of(tmp_path / folder) for folder in folders]
    assert [float(row["peak_stress"]) for row in rows] == [one["peak_stress"] for one in results]
    assert {one["material"]["cohesion"] for one in results} == {2e7}
    found = rows_of(tmp_path / "means.csv")
    assert [float(row["confinement"]) for row in found] == [1e6, 3e6]
    for row, pair in zip(found, (results[:2], results[2:]), strict=True):
        peaks = [one["peak_stress"] for one in pair]
        assert float(row["peak_stress"]) == pytest.approx(statistics.mean(peaks))
        assert float(row["peak_stress_deviation"]) == pytest.approx(statistics.stdev(peaks))
    assert int(rows_of(tmp_path / "envelope.csv")[0]["tests"]) == 4
    said = capsys.readouterr().out
    assert "rigid 3 MPa standard deviation" in said and "criterion" in said
    assert imread(tmp_path / "curves.png").shape[0] > 300


def test_what_no_packing_can_do_is_wrong_input(tmp_path, capsys):
    sizes = ["--width", "0.001", "--height", "0.002", "--quiet"]
    assert cli.main(["run", "uniaxial", *sizes, "--seeds", "1-2", "--out", str(tmp_path)]) == 2
    errors = capsys.readouterr().err
    assert "choose smaller discs" in errors and errors.count("\n") == 1
