# SPDX-License-Identifier: GPL-3.0-or-later
"""Several models on one packing: the same numbers as single runs, tables, pictures, refusals."""

import csv
import json

import numpy as np
import pytest
from matplotlib.image import imread
from refusals import refusal

import flexpm
from flexpm.cli import main as cli
from flexpm.materials.references import reference_of
from flexpm.models.options import MODELS, SPHERE_MODELS
from flexpm.studies import comparison

CONFINEMENTS = (0.0, 1e6, 3e6)
SMALL = ["--width", "0.016", "--height", "0.032", "--thickness", "0.01", "--quiet"]


@pytest.fixture(scope="module")
def specimen():
    return flexpm.Specimen.rectangle(0.016, 0.032, 0.01, seed=3)


@pytest.fixture(scope="module")
def envelope(specimen, tmp_path_factory):
    """Two models under three confinements, driven fast, and the folder."""
    folder = tmp_path_factory.mktemp("compare")
    options = {"confinements": CONFINEMENTS, "rate": 6.0, "out": folder}
    return flexpm.compare("biaxial", specimen, ("flexible", "rigid"), **options), folder, options


def rows_of(path):
    return list(csv.DictReader(path.read_text().splitlines()))


@pytest.mark.long
def test_each_run_is_the_single_run_to_the_same_bits(specimen, envelope):
    case = envelope[0].cases[1]
    assert (case.model, case.confinement) == ("flexible", 1e6)
    alone = flexpm.run("biaxial", specimen, confinement=1e6, rate=6.0)
    assert np.array_equal(alone.curve.array, case.result.curve.array, equal_nan=True)
    written = json.loads((case.folder / "result.json").read_text())
    assert written["peak_stress"] == alone.peak_stress


@pytest.mark.long
def test_tables_and_pictures_of_a_comparison(envelope):
    found, folder, _ = envelope
    rows = rows_of(folder / "compare.csv")
    assert [row["model"] for row in rows] == ["flexible"] * 3 + ["rigid"] * 3
    assert [float(row["confinement"]) for row in rows] == list(CONFINEMENTS) * 2
    for row, case in zip(rows, found.cases, strict=True):
        assert float(row["first_tensile_crack_stress"]) == case.result.first_tensile_crack_stress
        assert int(row["tensile_cracks"]) == case.result.tensile_cracks
        assert row["material"] == case.material.name
    assert {case.material.name for case in found.cases} == {"augig-table7"}
    said = comparison.table(found.cases).splitlines()[-1]
    assert "material of all: augig-table7" in said
    assert "differ" not in comparison.table(found.cases[:3])
    for name in ("compare.png", "cracks.png", "envelope.png"):
        assert imread(folder / name).shape[0] > 300


@pytest.mark.long
def test_the_envelope_is_the_fit_through_the_peaks(envelope):
    found, folder, _ = envelope
    one = found.envelopes[0]
    peaks = [case.result.peak_stress for case in found.cases[:3]]
    assert (one.confinements, one.peaks) == (list(CONFINEMENTS), peaks)
    slope, strength = np.polyfit(CONFINEMENTS, peaks, 1)
    assert one.mohr_coulomb.slope == pytest.approx(slope)
    assert one.mohr_coulomb.uniaxial_strength == pytest.approx(strength)
    assert one.mohr_coulomb.friction_angle > 20.0
    row = rows_of(folder / "envelope.csv")[0]
    assert float(row["cohesion"]) == one.mohr_coulomb.cohesion
    assert float(row["m_i"]) == one.hoek_brown.m_i


@pytest.mark.long
def test_a_second_start_runs_nothing_again(specimen, envelope):
    found, _, options = envelope  # of which the tables are those of this start from now on
    again = flexpm.compare("biaxial", specimen, ("rigid",), **options)
    for old, new in zip(found.results[3:], again.results, strict=True):
        assert new.resumed_at >= old.steps
        assert np.array_equal(old.curve.array, new.curve.array, equal_nan=True)


@pytest.mark.long
def test_the_command_compares_all_kinds_of_models(capsys, tmp_path):
    """Stopped early, no run finds a strength: exit code 3, and everything is written."""
    folder = tmp_path / "out"
    arguments = ["--models", "flexible,rigid,jcfpm,cohfrict", "--max-strain", "3e-4"]
    code = cli.main(
        ["compare", "uniaxial", *SMALL, *arguments, "--rate", "2", "--out", str(folder)]
    )
    output, errors = capsys.readouterr()
    assert code == 3
    assert errors.count("\n") == 1
    assert "flexible, rigid, jcfpm, cohfrict, gave no strength" in errors
    rows = rows_of(folder / "compare.csv")
    assert [row["status"] for row in rows] == ["no_peak"] * 4
    for row in rows:
        assert (row["grains"], row["contacts"]) == (rows[0]["grains"], rows[0]["contacts"])
        assert (folder / row["model"] / "result.json").exists()
        assert row["model"] in output


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"models": ("flexible", "nosuch")}, "model = 'nosuch', unknown"),
        ({"models": ()}, "models = .*, must be one or more, each once"),
        ({"models": ("rigid", "rigid")}, "each once"),
        ({"models": ("rigid", "jcfpm"), "points": 1}, "points of model jcfpm = 1"),
        ({"confinements": (0.0, 1e6)}, "confinement = 1000000.0 Pa, must be 0 for uniaxial"),
        ({"material": "augig-tabel7"}, "did you mean augig-table7"),
        ({"rate": -1.0}, "rate = -1.0"),
    ],
)
def test_what_one_run_cannot_do_is_refused_before_any_runs(specimen, tmp_path, options, message):
    refusal(message, flexpm.compare, "uniaxial", specimen, out=tmp_path, **options)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


def test_a_brazilian_test_wants_a_disc(specimen):
    refusal("rectangle, must be a disc for brazilian", flexpm.compare, "brazilian", specimen)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("uniaxal", "did you mean uniaxial"),
        ("uniaxial --models flexible,rgid", "did you mean rigid"),
        ("uniaxial --models rigid,rigid", "must name rigid once"),
        ("uniaxial --confinements 0,1e6", "confinements = 1e+06 Pa, must be 0 for uniaxial"),
        ("biaxial --confinements 0,-1", "confinements = -1 Pa, must be >= 0"),
        ("brazilian --width 0.1", "must not be given for a disc"),
        ("uniaxial --set yuong=1", "did you mean young"),
    ],
)
def test_wrong_comparisons_are_one_line_and_exit_code_2(capsys, tmp_path, arguments, message):
    assert cli.main(["compare", *arguments.split(), "--out", str(tmp_path)]) == 2
    output, errors = capsys.readouterr()
    assert (output, errors.count("\n")) == ("", 1)
    assert message in errors


def test_all_models_have_one_material_unless_told_otherwise():
    for solid, models, name in (
        (False, MODELS, "augig-table7"),
        (True, ("flexible", "rigid", *SPHERE_MODELS), "augig3d-calibrated"),
    ):
        found = comparison._materials(models, None, solid)
        assert {material.name for material in found.values()} == {name}
        for model, material in found.items():
            material.law(model)  # it has a set for each
    some = comparison._materials(("flexible", "rigid"), {"rigid": "augig-table2-bilinear"}, False)
    assert [one.name for one in some.values()] == ["augig-table7", "augig-table2-bilinear"]


@pytest.mark.parametrize("packing", [[], ["--seeds", "1"]])
def test_the_command_gives_all_models_one_material_and_names_it(capsys, tmp_path, packing):
    arguments = ["compare", "tension", *SMALL, "--models", "flexible,jcfpm", *packing]
    assert cli.main([*arguments, "--max-strain", "2e-5", "--out", str(tmp_path)]) == 3
    said = capsys.readouterr().out
    files = list(tmp_path.rglob("result.json"))
    assert len(files) == 2
    for file in files:
        assert json.loads(file.read_text())["material"]["name"] == "augig-table7"
    assert "augig-table7" in said
    shown = [line for line in said.splitlines() if not line.startswith("warning: ")]
    assert "augig-table2" not in "".join(shown)
    # the default of a comparison was calibrated for one of the models
    told = [line for line in said.splitlines() if "the run is 2D with model jcfpm" in line]
    assert len(told) == 1


def test_materials_by_model_and_the_rock_they_stand_for(specimen):
    made = {"flexible": "augig-table2-brittle", "rigid": "augig-table7"}
    found = comparison._materials(tuple(made), made, False)
    assert {model: material.name for model, material in found.items()} == made
    assert reference_of("augig-table7").cohesion == 21e6
    assert reference_of("two-minerals") is None
