# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that test solids: they leave a folder that is repeated, or are refused in one line."""

from __future__ import annotations

import json

import pytest
from refusals import refused_command

from flexpm.cli import main as cli


@pytest.mark.parametrize(
    ("asked", "code", "inputs", "words"),
    [
        (
            "bending --length 0.03 --height 0.008 --depth 0.008 --max-strain 3e-4 --rate 4",
            (0, 3),
            {"kind": "box", "span": 8.0 / 9.0 * 0.03},
            ["--shape box"],
        ),
        (
            "brazilian --diameter 0.014 --depth 0.008 --max-strain 1e-3",
            (0, 3),
            {"kind": "solid-disc"},
            ["--shape solid-disc"],
        ),
        (
            "scb --diameter 0.024 --depth 0.008 --max-strain 3e-4 --rate 4",
            (0, 3),
            {"kind": "solid-half-disc", "span": 0.6 * 0.024, "notch": 0.25 * 0.024},
            ["--shape solid-half-disc", "half a disc of 24 x 8 mm"],
        ),
        (
            "shear --width 0.016 --height 0.012 --depth 0.009 --model rigid --rate 4 "
            "--max-displacement 5e-6",
            (0, 3),
            {"kind": "box", "normal_stress": 1e6},
            ["--shape box", "shear stress"],
        ),
        (
            "uniaxial --shape box --width 0.009 --depth 0.009 --height 0.014 --max-strain 4e-4 "
            "--rate 4",
            (0, 3),
            {"kind": "box"},
            ["--shape box"],
        ),
        (
            "sonic --shape box --width 0.0066 --depth 0.0066 --height 0.16 --model rigid "
            "--diameters 2.8e-3,3.2e-3 --sides free",
            (0,),
            {"kind": "box", "sides": "free"},
            ["--sides free"],
        ),
    ],
)
@pytest.mark.long
def test_a_solid_is_tested_and_its_folder_repeats(
    asked, code, inputs, words, tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["run", *asked.split(), "--quiet", "--out", "one"]) in code
    found = json.loads((tmp_path / "one/result.json").read_text())
    told = {"kind": found["inputs"]["specimen"]["kind"], **found["inputs"]}
    assert {name: told[name] for name in inputs} == pytest.approx(inputs)
    page = (tmp_path / "one/report.html").read_text()
    assert all(word in page for word in words)
    said = capsys.readouterr().out
    if found["inputs"]["test"] == "sonic":
        assert found["vp"] > 2000.0 and "speed of the pressure wave" in said
    assert cli.main(["rerun", "one", "--quiet", "--out", "again", "--no-report"]) in code
    assert "the same as in" in capsys.readouterr().out


REFUSED = {
    "bending --depth 0.02": [
        ("--thickness 0.01", "thickness = 0.01 m, must not be"),
        ("--diameter 0.1", "diameter = 0.1 m, must not be given for"),
        ("--confinement 1e6", "confinement = 1000000.0 Pa, must"),
        ("--model jcfpm", "must be one of flexible, rigid"),
        ("--span 0.2", "span = 0.2 m, must be"),
        ("--span 0.001", "span = 0.001 m, must be > 0.003: both supports"),
        ("--notch 0.04", "notch = 0.04 m, must be"),
        ("--notch 0.01 --span 0.04", "2.5 times the height"),
        ("--joints no.geojson", "must be left out for a box: maps of joints are"),
    ],
    "brazilian --depth 0.02": [
        ("--thickness 0.01", "thickness = 0.01 m, must not be"),
        ("--height 0.1", "height = 0.1 m, must not be given for a"),
        ("--confinement 1e6", "confinement = 1000000.0 Pa, must be 0"),
        ("--model inner", "must be one of flexible, rigid"),
    ],
    "scb --depth 0.02": [
        ("--thickness 0.01", "thickness = 0.01 m, must not be"),
        ("--model jcfpm", "must be one of flexible, rigid"),
        ("--span 0.06", "span = 0.06 m, must be"),
    ],
    "shear --depth 0.02": [
        ("--thickness 0.01", "thickness = 0.01 m, must not be"),
        ("--model jcfpm", "must be one of flexible, rigid"),
        ("--joints no.geojson", "must be left out for a box: maps of joints are"),
        ("--normal-stress -1", "normal-stress = -1 Pa, must be > 0"),
    ],
    "punch --width 0.03 --height 0.02 --depth 0.008": [
        ("--thickness 0.01", "thickness = 0.01 m, must not be"),
        ("--model cohfrict", "must be one of flexible, rigid"),
        ("--notch 0.019", "notch = 0.019 m, must be"),
        (
            "--height 0.013",
            "default notch = 0.0026 m, must be < 0.0005: a bridge between two notches has at least "
            "4 mean grains of 0.003 m along it; take smaller grains or a larger specimen",
        ),
        ("--height 0.009", "height = 0.009 m, must be > 0.012 m: a bridge between two notches has"),
        ("--width 0.02 --notch 0.003", "default distance = 0.008 m, must be > 0.009: pairs of"),
        ("--notch 0.0001 --distance 0.011", "ends within the first grains"),
    ],
    "": [
        ("bending --shape cylinder", "must be a rectangle for bending, or a box"),
        ("brazilian --shape cylinder", "must be a disc for brazilian, or a solid-disc"),
        ("scb --shape box", "must be a half-disc for scb, or a solid-half-disc"),
        ("shear --shape cylinder", "must be a rectangle for shear, or a box"),
    ],
}


@pytest.mark.parametrize(
    ("asked", "told"),
    [(f"{test} {more}", told) for test, rows in REFUSED.items() for more, told in rows],
)
def test_what_does_not_fit_a_solid_is_refused(asked, told, tmp_path, capsys):
    refused_command(capsys, told, "run", *asked.split(), "--out", tmp_path / "none")
    # a notch that meets no grain is found as the specimen is cut
    assert not (tmp_path / "none").exists() or "ends within" in told
