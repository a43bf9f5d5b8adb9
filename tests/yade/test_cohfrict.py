# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's CohFrict on flexpm's discs and bonds: all of them together, and the tests."""

import bonded_pair
import numpy as np
import pytest
import yade

from flexpm.errors import InputError
from flexpm.laboratory import protocols
from flexpm.models import grains as models
from flexpm.models import sphere_bonds as yade_bonds
from flexpm.rigs.fitting import rig as rig_of
from flexpm.runs.loading_rate import Loading
from flexpm.specimens.specimen import Specimen

MODEL = "cohfrict"


@pytest.fixture(scope="module")
def rectangle():
    return Specimen.rectangle(0.02, 0.04, 0.01, seed=2)


def test_discs_are_shrunk_until_none_overlap(rectangle):
    radii = yade_bonds.separate_radii(rectangle)
    apart = np.linalg.norm(rectangle.centres[:, None] - rectangle.centres[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    assert np.all(radii[:, None] + radii[None] <= apart * (1.0 + 1e-12))
    assert np.all(radii <= rectangle.radii)
    assert np.all(radii > 0.8 * rectangle.radii)
    room = np.minimum(rectangle.centres, [0.02, 0.04] - rectangle.centres).min(axis=1)
    assert np.all(radii <= room)


def test_masses_keep_an_undamped_assembly_calm(rectangle):
    models.build(rectangle, None, MODEL, damping=0.0)
    rng = np.random.default_rng(1)
    for body in yade.O.bodies:
        body.state.vel = (*rng.normal(size=2) * 1e-14, 0.0)
    start = yade.utils.kineticEnergy()
    for _ in range(3000):
        yade.O.step()
    assert yade.utils.kineticEnergy() < 2.0 * start


def test_unbroken_bonds_keep_the_balance_of_energy(rectangle):
    result = protocols.run("tension", rectangle, model=MODEL)
    assert bonded_pair.balance_before_cracks(result.curve) == pytest.approx(1.0, abs=0.01)
    assert result.tensile_cracks == sum(crack.mode == 1 for crack in result.cracks) > 0
    assert 0.0 < result.peak_stress < result.material["tensile_strength"]
    assert result.status == "ok"


def test_a_fast_test_says_that_it_is_not_quasistatic(rectangle):
    result = protocols.run("uniaxial", rectangle, model=MODEL, rate=40.0)
    assert result.status == "not_quasistatic"


def test_grains_carry_the_stresses_of_the_specimen(rectangle):
    built = models.build(rectangle, None, MODEL)
    rig = rig_of(built)
    rig.confine(4e6)
    rig.load(Loading(rate=4.0, max_strain=5e-4))
    record = rig.record
    state = built.snapshot()
    first = np.unique(state.triangle_grain, return_index=True)[1]
    stress, areas = state.triangle_stress[first], np.array(rectangle.tessellation.cell_areas)
    # grains on the rim lack the forces of plates and pressure
    x, y = rectangle.centres.T
    inner = (np.abs(x - 0.01) < 0.006) & (np.abs(y - 0.02) < 0.015)
    mean = np.average(stress[inner], axis=0, weights=areas[inner])
    assert mean[0] == pytest.approx(-4e6, rel=0.1)
    assert mean[1] == pytest.approx(-record["axial_stress"][-1], rel=0.05)
    assert abs(mean[2]) < 0.05 * abs(mean[1])
    moved = state.positions - state.reference
    top, bottom = (state.reference[:, 1] > 0.03), (state.reference[:, 1] < 0.01)
    assert moved[top, 1].mean() < moved[bottom, 1].mean()


def test_a_disc_on_the_outline_leaves_no_radius():
    corners = [[0.0, 0.0], [0.01, 0.0], [0.01, 0.01], [0.0, 0.01]]
    discs = [[1e-300, 0.005], [0.007, 0.005]]
    specimen = Specimen.from_discs(discs, [0.003, 0.003], corners, 0.01)
    with pytest.raises(InputError, match="cohfrict: grain 0: radius that leaves neither"):
        models.build(specimen, None, "cohfrict")
