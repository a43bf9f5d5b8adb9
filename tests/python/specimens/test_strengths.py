# SPDX-License-Identifier: GPL-3.0-or-later
"""Strengths of each contact: factors given or drawn by Weibull's distribution."""

import math

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.materials.material import load
from flexpm.specimens.specimen import Specimen


@pytest.fixture(scope="module")
def specimen():
    return Specimen.rectangle(0.012, 0.024, 0.01)


def contacts(specimen):
    return len(specimen.tessellation.shared_edges)


def test_a_factor_of_all_contacts_is_another_material(specimen):
    """Strengths times f and energies times f^2, by the factor and by the material."""
    rock, factor = load(), 0.8
    weaker = rock.with_set(
        tensile_strength=factor * rock.tensile_strength,
        cohesion=factor * rock.cohesion,
        tensile_fracture_energy=factor**2 * rock.tensile_fracture_energy,
        shear_fracture_energy=factor**2 * rock.shear_fracture_energy,
    )
    scaled = specimen.with_strengths(np.full(contacts(specimen), factor))
    energies = []
    for one, material in ((scaled, rock), (specimen, weaker)):
        built = _pulled(one, material)
        energies.append(built.solver.energies()["damage_energy"])
        assert energies[-1] > 0.0
    assert energies[0] == pytest.approx(energies[1], rel=1e-9)


def _pulled(specimen, material):
    """A specimen whose top is driven until points have softened."""
    from yade import wrapper

    built = fresh(specimen, material)
    built.add_engines(before=(wrapper.EndDisplacementController(velocity=2e-9),))
    built.run(3000)
    return built


def test_the_weakest_contact_softens_first(specimen):
    cells = specimen.tessellation
    ends = cells.vertices[cells.shared_edges[:, 2:]]
    way = np.abs(ends[:, 1] - ends[:, 0])
    across = int(np.argmax(way[:, 0] - 10.0 * way[:, 1]))  # across the pull
    factors = np.ones(len(ends))
    factors[across] = 0.05
    built = _pulled(specimen.with_strengths(factors), load())
    snapshot = built.snapshot()
    assert snapshot.point_contact[snapshot.point_damage.argmax()] == across


def test_weibulls_factors():
    large = Specimen.rectangle(0.04, 0.08, 0.01)
    drawn = large.with_weibull_strengths(4.0, seed=3)
    again = large.with_weibull_strengths(4.0, seed=3)
    np.testing.assert_array_equal(drawn.strengths, again.strengths)
    assert drawn.spec == again.spec
    assert drawn.spec != large.with_weibull_strengths(4.0, seed=4).spec
    count = contacts(large)
    assert drawn.strengths.mean() == pytest.approx(1.0, abs=4.0 * 0.28 / math.sqrt(count))
    # moments of Weibull's distribution with m = 4
    variance = math.gamma(1.5) / math.gamma(1.25) ** 2 - 1.0
    assert drawn.strengths.std() == pytest.approx(math.sqrt(variance), rel=0.1)


def test_strengths_are_saved(specimen, tmp_path):
    drawn = specimen.with_weibull_strengths(5.0)
    drawn.save(tmp_path / "drawn.json")
    again = Specimen.load(tmp_path / "drawn.json")
    np.testing.assert_array_equal(again.strengths, drawn.strengths)
    assert again.spec == drawn.spec


@pytest.mark.parametrize("factors", [[1.0], "x", [0.0], [math.nan], None])
def test_factors_that_cannot_be(specimen, factors):
    if isinstance(factors, list) and factors != [1.0]:
        factors = factors * contacts(specimen)
    refusal("must be .* numbers > 0; give one per contact", specimen.with_strengths, factors)


def test_other_refusals(specimen):
    drawn = specimen.with_weibull_strengths(5.0)
    refusal("modulus = 0.5, must be >= 1", specimen.with_weibull_strengths, 0.5)
    with pytest.raises(InputError, match="cut first, then give strengths"):
        drawn.with_joints({"a": [(0.0, 0.01), (0.012, 0.01)]})
    for model in ("inner", "jcfpm"):
        with pytest.raises(InputError, match=f"model = {model}, must be .* strengths of contacts"):
            flexpm.build(drawn, model=model)
