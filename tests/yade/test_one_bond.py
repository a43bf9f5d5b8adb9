# SPDX-License-Identifier: GPL-3.0-or-later
"""One bond of YADE's sphere models against the edge of flexpm's cells that it stands for."""

import bonded_pair
import pytest

from flexpm.models.options import SPHERE_MODELS

GAP, TOUCH, OVERLAP = 0.9, 1.0, 1.05  # overlapping discs are shrunk until they touch
#: How far a torn pair may be flung: in JCFpm a contact that is found anew is as stiff as the mean
#: bond, twice the disc's own radius over it.
FLUNG = {"cohfrict": 1.0, "jcfpm": 2.0}


def test_all_models_are_here():
    assert set(FLUNG) == set(SPHERE_MODELS)


@pytest.mark.parametrize("radius_share", [GAP, TOUCH, OVERLAP])
@pytest.mark.parametrize("model", FLUNG)
def test_a_bond_has_the_stiffness_of_its_edge(model, radius_share):
    assert bonded_pair.stiffnesses(model, radius_share) == pytest.approx(1.0, rel=1e-4)


@pytest.mark.parametrize("radius_share", [GAP, TOUCH, OVERLAP])
def test_a_bond_of_cohfrict_resists_bending_as_its_edge_does(radius_share):
    assert bonded_pair.bending(radius_share) == pytest.approx(1.0, rel=1e-4)


@pytest.mark.parametrize("radius_share", [GAP, TOUCH, OVERLAP])
@pytest.mark.parametrize("model", FLUNG)
def test_a_bond_breaks_at_the_tensile_strength_of_its_edge(model, radius_share):
    largest, promised, rest = bonded_pair.pull_until_broken(model, radius_share)
    assert (1.0 - 2e-3) * promised < largest <= (1.0 + 1e-9) * promised  # one step is 1.5e-3
    assert rest == 0.0


@pytest.mark.parametrize("pressure", [0.0, 20e6, 80e6])
@pytest.mark.parametrize("model", FLUNG)
def test_a_bond_breaks_at_cohesion_and_friction_of_its_edge(model, pressure):
    largest, promised, rest, friction = bonded_pair.shear_until_broken(model, pressure)
    assert largest == pytest.approx(promised, rel=2e-3)
    assert rest == pytest.approx(friction, rel=1e-3, abs=1e-6 * promised)


@pytest.mark.parametrize("radius_share", [TOUCH, OVERLAP])
@pytest.mark.parametrize("model", FLUNG)
def test_a_torn_pair_is_not_flung_apart(model, radius_share):
    largest, bound = bonded_pair.close_again(model, radius_share)
    assert largest <= FLUNG[model] * bound
