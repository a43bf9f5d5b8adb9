# SPDX-License-Identifier: GPL-3.0-or-later
"""Punch-through shear of solid boxes: notches from both sides, whole tests, same bits."""

import numpy as np
import pytest
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.materials.material import default_name
from flexpm.specimens.space.notch import notched

#: Two hundred grains.
WIDTH, DEPTH, HEIGHT = 0.03, 0.008, 0.02
NOTCH, DISTANCE = 0.003, 0.0115


@pytest.fixture(scope="module")
def block():
    return Specimen.box(WIDTH, DEPTH, HEIGHT, seed=1)


def test_notches_come_from_below_and_from_above(block):
    places = [0.5 * (WIDTH + side * DISTANCE) for side in (-1.0, 1.0)]
    asked = [
        (x, HEIGHT - NOTCH if above else NOTCH, above) for x in places for above in (False, True)
    ]
    cut = notched(block, asked)
    assert cut.cells.volumes.sum() == pytest.approx(block.cells.volumes.sum(), rel=1e-12)
    assert cut.depths() == pytest.approx([NOTCH] * 4, abs=0.4 * block.mean_diameter)
    lines = cut.lines()
    assert lines[:, 0, 1].tolist() == [0.0, HEIGHT, 0.0, HEIGHT]
    assert np.abs(lines[:, 1, 1] - lines[:, 0, 1]) == pytest.approx(cut.depths())
    assert (lines[:, :, 0] == np.repeat(places, 2)[:, None]).all()


@pytest.mark.long
@pytest.mark.parametrize(("model", "pressure"), [("flexible", 0.0), ("rigid", 10e6)])
def test_both_bridges_bear_the_load(block, model, pressure):
    asked = {"notch": NOTCH, "distance": DISTANCE, "max_displacement": 1e-4}
    result = flexpm.run(
        "punch", block, default_name(model), model, rate=4.0, confinement=pressure, **asked
    )
    assert result.energy_error < 0.01
    assert result.notch_depth == pytest.approx(NOTCH, abs=0.4 * block.mean_diameter)
    area = 2.0 * DEPTH * (HEIGHT - 2.0 * result.notch_depth)
    curve = result.curve
    assert curve["load"] == pytest.approx(area * curve["axial_stress"])
    assert np.array_equal(curve["shear_stress"], curve["axial_stress"])
    assert result.peak_load == pytest.approx(area * curve["axial_stress"].max())
    assert 5e6 < curve["axial_stress"].max() < 120e6
    rising = slice(1, int(np.argmax(curve["axial_stress"])))
    assert np.median(curve["end_mismatch"][rising]) < 0.05


@pytest.mark.long
def test_a_pressure_of_the_walls_bears_more(block):
    asked = {"notch": NOTCH, "distance": DISTANCE, "max_displacement": 2e-4, "rate": 4.0}
    low, high = (
        flexpm.run(
            "punch", block, default_name("rigid"), "rigid", confinement=pressure, **asked
        ).peak_load
        for pressure in (1e6, 12e6)
    )
    assert high > 1.5 * low


@pytest.mark.long
@pytest.mark.parametrize(("model", "pressure"), [("flexible", 0.0), ("rigid", 5e6)])
def test_threads_and_a_stop_change_no_bit(block, model, pressure, tmp_path, monkeypatch):
    asked = {"model": model, "max_displacement": 1e-5, "rate": 4.0, "notch": NOTCH}
    asked |= {"confinement": pressure, "distance": DISTANCE}
    whole = flexpm.run("punch", block, threads=2, **asked)
    assert same(taken_up(monkeypatch, tmp_path, 60, "punch", block, **asked), whole)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (["--depth", "0.008", "--thickness", "0.01"], "thickness = 0.01 m, must not be"),
        (["--depth", "0.008", "--model", "cohfrict"], "must be one of flexible, rigid"),
        (["--depth", "0.008", "--notch", "0.019"], "notch = 0.019 m, must be"),
        (
            ["--depth", "0.008", "--height", "0.013"],
            "default notch = 0.0026 m, must be < 0.0005: a bridge between two notches has at least "
            "4 mean grains of 0.003 m along it; take smaller grains or a larger specimen",
        ),
        (
            ["--depth", "0.008", "--height", "0.009"],
            "height = 0.009 m, must be > 0.012 m: a bridge between two notches has at least 4 mean",
        ),
        (
            ["--depth", "0.008", "--width", "0.02", "--notch", "0.003"],
            "default distance = 0.008 m, must be > 0.009: pairs of notches lie at least 3",
        ),
        (
            ["--depth", "0.008", "--notch", "0.0001", "--distance", "0.011"],
            "ends within the first grains",
        ),
    ],
)
def test_what_does_not_fit_is_refused(asked, told, tmp_path, capsys):
    sizes = ["--width", "0.03", "--height", "0.02"]
    assert cli.main(["run", "punch", *sizes, *asked, "--out", str(tmp_path / "none")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert told in error
