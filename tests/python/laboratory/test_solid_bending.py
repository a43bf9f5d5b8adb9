# SPDX-License-Identifier: GPL-3.0-or-later
"""Bending of solid beams: whole tests, notches, same bits, folders, what is refused."""

import dataclasses

import numpy as np
import pytest

import flexpm
from flexpm import Specimen
from flexpm.kinds import toughness
from flexpm.materials.material import default_name
from flexpm.materials.mineral import Mineral
from flexpm.specimens.mineral_map import minerals_of
from flexpm.specimens.space.notch import notched

#: Some hundred grains.
LENGTH, DEPTH, HEIGHT = 0.036, 0.008, 0.008
SPAN, NOTCH = 4.0 * HEIGHT, 0.003


@pytest.fixture(scope="module")
def beam():
    return Specimen.box(LENGTH, DEPTH, HEIGHT, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_beam_breaks_in_the_middle(beam, model):
    result = flexpm.run("bending", beam, default_name(model), model, rate=4.0)
    assert result.energy_error < 0.02
    curve = result.curve
    area = 2.0 * DEPTH * HEIGHT**2 / (3.0 * SPAN)
    assert curve["load"] == pytest.approx(area * curve["axial_stress"])
    assert curve["displacement"] == pytest.approx(SPAN**2 / (6.0 * HEIGHT) * curve["axial_strain"])
    assert result.peak_load == pytest.approx(area * result.peak_stress)
    assert 3e6 < result.peak_stress < 60e6
    assert result.tensile_cracks > result.shear_cracks
    assert result.fracture_energy > 0.0
    assert (result.notch_depth, result.fracture_toughness) == (0.0, None)
    assert (result.youngs_modulus, result.poissons_ratio) == (None, None)
    assert curve["cmod"][-1] > curve["cmod"][0]
    assert curve["axial_stress"][-1] <= 0.1 * result.peak_stress
    # both rollers and the head bear along lines: nothing of the load is lost
    loaded = curve["load"] > 0.2 * result.peak_load
    assert sorted(curve["end_mismatch"][loaded])[int(0.5 * loaded.sum())] < 0.1


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_crack_runs_up_from_the_notch(beam, model):
    result = flexpm.run("bending", beam, default_name(model), model, rate=16.0, notch=NOTCH)
    depth = result.notch_depth
    assert depth == pytest.approx(NOTCH, abs=0.35 * beam.mean_diameter)
    sizes = {"span": SPAN, "height": HEIGHT, "thickness": DEPTH, "notch": depth}
    told = toughness.bending_toughness(result.peak_load, **sizes)
    assert result.fracture_toughness == pytest.approx(told)
    area = 2.0 * DEPTH * (HEIGHT - depth) ** 2 / (3.0 * SPAN)
    assert result.peak_load == pytest.approx(area * result.peak_stress)
    places = np.array([(one.x, one.z) for one in result.cracks])
    assert np.abs(places[:, 0] - 0.5 * LENGTH).max() < 0.2 * LENGTH
    assert places[:, 1].max() > 0.6 * HEIGHT
    assert result.fracture_energy > 0.0
    assert result.curve["cmod"][-1] > 10.0 * result.curve["cmod"][1]


def test_pieces_of_a_grain_are_of_its_mineral_and_its_size_counts_once(beam):
    cut = notched(beam, [(0.5 * LENGTH, NOTCH, False)])
    assert cut.cells.cells > beam.cells.cells
    assert cut.cells.contacts != beam.cells.contacts
    assert cut.cells.volumes.sum() == pytest.approx(beam.cells.volumes.sum(), rel=1e-12)
    assert cut.mean_diameter == beam.mean_diameter
    assert len(cut.spheres) == cut.cells.cells
    whole = np.flatnonzero(np.bincount(cut.parents)[cut.parents] == 1)
    assert np.array_equal(cut.spheres[whole], beam.spheres[cut.parents[whole]])
    rock = flexpm.materials.load("augig-table7")
    halves = tuple(Mineral(name, 0.5, {}) for name in ("light", "dark"))
    mixed = dataclasses.replace(rock, minerals=halves)
    assert np.array_equal(minerals_of(cut, mixed), minerals_of(beam, mixed)[cut.parents])
    given = beam.with_minerals([k % 2 for k in range(len(beam.spheres))])
    assert np.array_equal(
        notched(given, [(0.5 * LENGTH, NOTCH, False)]).minerals, given.minerals[cut.parents]
    )
