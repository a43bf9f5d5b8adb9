# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of grains as specimens: volumes, centroids, phases, refusals."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from drawn_volumes import power_volume
from refusals import refusal

from flexpm import Specimen
from flexpm.cli import main as cli

SIZES = {"width": 0.02, "depth": 0.016, "height": 0.024}


def written(path, rows, names=("id", "x", "y", "z", "volume")):
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([names, *rows])
    return path


def grains(scale=1.0):
    """IDs, centroids and volumes of power cells that fill a box."""
    cells = power_volume(40, (20, 16, 24), seed=2).cells
    return [
        (f"g{k}", *(scale * cells.centroids[k]), scale**3 * volume)
        for k, volume in enumerate(cells.volumes.tolist())
    ]


def test_power_cells_come_back_from_their_volumes_and_centroids(tmp_path):
    volume = power_volume(40, (20, 16, 24), seed=2)
    path = written(tmp_path / "grains.csv", grains())
    solid = Specimen.from_grain_table(path, **SIZES, short_edge=0.0)
    assert solid.cells.volumes == pytest.approx(volume.cells.volumes, rel=1e-6)
    off = np.linalg.norm(solid.centres - volume.cells.centroids, axis=1)
    assert np.sqrt(np.mean(off**2)) < 0.01 * solid.mean_diameter
    found = {tuple(pair) for pair in solid.given.neighbours.tolist()}
    true = {tuple(pair) for pair in volume.neighbours.tolist()}
    assert 2 * len(found & true) / (len(found) + len(true)) > 0.97


@pytest.mark.parametrize("seed", range(4))
def test_tables_that_are_no_tessellation_get_the_nearest_steps(tmp_path, seed):
    """Centroids and volumes with noise: points would be hidden on the way."""
    draw = np.random.default_rng(seed)
    volumes = draw.lognormal(sigma=0.5, size=30)
    volumes *= 0.02**3 / volumes.sum()
    rows = [(k, *draw.uniform(0.001, 0.019, 3), one) for k, one in enumerate(volumes.tolist())]
    path = written(tmp_path / "grains.csv", rows)
    solid = Specimen.from_grain_table(path, width=0.02, depth=0.02, height=0.02)
    assert solid.given.measured()[0] == pytest.approx(volumes, rel=1e-6)


def test_small_differences_of_the_whole_volume_are_scaled_away(tmp_path):
    rows = [(*row[:4], 1.015 * row[4]) for row in grains()]
    solid = Specimen.from_grain_table(written(tmp_path / "grains.csv", rows), **SIZES)
    expected = np.array([row[4] for row in grains()])
    assert solid.given.measured()[0] == pytest.approx(expected, rel=1e-6)


def test_units_and_phases(tmp_path):
    rows = [(*row, "ab"[k % 2]) for k, row in enumerate(grains(1e3))]
    names = ("id", "x", "y", "z", "volume", "phase")
    path = written(tmp_path / "grains.csv", rows, names)
    solid = Specimen.from_grain_table(path, **SIZES, unit="mm")
    assert solid.minerals.tolist() == [0, 1] * 20 and solid.mineral_names == ("a", "b")


def test_command_makes_the_specimen(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "grains.csv", grains())
    sizes = [f"--{name}={size}" for name, size in SIZES.items()]
    arguments = ["grains.csv", *sizes, "--out", "made", "--quiet"]
    assert cli.main(["specimen", "table", *arguments]) == 0
    assert {path.name for path in (tmp_path / "made").iterdir()} == {
        *("specimen.json", "specimen.png", "specimen.vtu", "solid.json")
    }
    assert "grains" in capsys.readouterr().out


REFUSED = [
    (
        lambda rows: [(*rows[0][:4], -1.0), *rows[1:]],
        "line 2: volume = '-1.0', must be a number ab",
    ),
    (lambda rows: [("g1", *rows[0][1:]), *rows[1:]], "table id = 'g1', must be in one row"),
    (lambda rows: [("a", "x", 0, 0, 1e-9), *rows], "line 2: x = 'x', must be a number"),
    (lambda rows: rows[:-4], "must be the volume of the box, 7.68e-06 m3, within 2 %"),
    (lambda rows: [("g0", 0.03, *rows[0][2:]), *rows[1:]], "centroid of grain g0 = 0.03, "),
    (lambda rows: rows[:1], "must have 2 grains or more"),
    (lambda rows: [*rows, ("a", *rows[7][1:])], "has the centroid of another grain"),
]


@pytest.mark.parametrize(("change", "words"), REFUSED)
def test_tables_that_do_not_fit_are_refused(tmp_path, change, words):
    path = written(tmp_path / "grains.csv", change(grains()))
    refusal(words, Specimen.from_grain_table, path, **SIZES)


def test_pores_of_tables_are_refused(tmp_path):
    rows = [(*row, "hole" if k == 3 else "a") for k, row in enumerate(grains())]
    names = ("id", "x", "y", "z", "volume", "phase")
    path = written(tmp_path / "grains.csv", rows, names)
    refusal("table id = 'g3': phase = hole, must be", Specimen.from_grain_table, path, **SIZES)


def test_missing_columns_are_refused(tmp_path):
    path = written(tmp_path / "grains.csv", [(1, 2)], ("id", "x"))
    refusal("must have a column y; its columns are id, x", Specimen.from_grain_table, path, **SIZES)
