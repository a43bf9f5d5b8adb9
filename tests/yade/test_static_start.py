# SPDX-License-Identifier: GPL-3.0-or-later
"""A test that starts at the elastic solution: the same measures in fewer steps; what it refuses."""

import numpy as np
import pytest

import flexpm
from flexpm.errors import InputError
from flexpm.materials.material import load
from flexpm.specimens.specimen import Specimen


@pytest.fixture(scope="module")
def specimen():
    return Specimen.rectangle(0.016, 0.032, 0.08, seed=2)


@pytest.fixture(scope="module")
def results(specimen):
    return {start: flexpm.run("tension", specimen, start=start) for start in ("rest", "static")}


def test_strength_does_not_depend_on_the_start(results):
    # one small specimen: the last decimals of a cascade of cracks differ, by less than halving the
    # rate moves it
    assert results["static"].peak_stress == pytest.approx(results["rest"].peak_stress, rel=0.02)
    assert results["static"].tensile_cracks > 0


def test_the_elastic_branch_is_recorded_and_is_that_of_the_solve(specimen, results):
    found = flexpm.elastic(specimen)
    assert results["static"].youngs_modulus == pytest.approx(found["youngs_modulus"], rel=5e-3)
    assert results["static"].poissons_ratio == pytest.approx(found["poissons_ratio"], rel=5e-3)


@pytest.mark.parametrize("start", ["static", "rest"])
def test_points_soften_from_the_elastic_limit_of_the_solve_on(results, start):
    limit = results["static"].curve["axial_stress"][19] / 0.9  # 20 steps lead to 0.9 of it
    result = results[start]
    first = int(np.argmax(result.curve["damage_energy"] > 0.0))
    onset = result.softening_onset * result.peak_stress
    assert onset == pytest.approx(result.curve["axial_stress"][first], rel=1e-12)
    assert 0.995 * result.curve["axial_stress"][first - 1] < limit < 1.005 * onset
    assert onset < 1.04 * limit


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_points_that_cannot_soften_dissipate_nothing_at_all(specimen, model):
    strengths = ["softening=brittle", "tensile_strength=1e9", "cohesion=1e10"]
    material = load("augig-table7", model).with_set(strengths, model)
    options = {"rate": 0.02, "max_strain": 1e-3, "loading": "constant"}
    result = flexpm.run("uniaxial", specimen, material, model, **options)
    assert len(result.curve) > 20 and result.softening_onset is None
    assert not result.curve["damage_energy"].any()


def test_steps_are_saved_and_the_books_close(results):
    assert results["static"].steps < 0.97 * results["rest"].steps
    assert results["static"].energy_error < 1e-3


def test_static_is_the_default_of_tension_only(specimen, results):
    assert flexpm.run("tension", specimen).steps == results["static"].steps
    begun = flexpm.run("uniaxial", specimen, max_strain=1e-6).curve
    assert begun["step"][0] > 1  # no recorded steps of a way along the elastic solution


def test_a_run_ends_at_the_largest_strain_also_on_the_way_to_the_elastic_limit(specimen):
    result = flexpm.run("tension", specimen, max_strain=2e-5)
    assert result.steps <= 20
    assert result.curve["axial_strain"][-1] == pytest.approx(2e-5, rel=0.5)


@pytest.mark.parametrize(
    ("test", "options"),
    [("biaxial", {}), ("uniaxial", {"model": "rigid"}), ("tension", {"model": "jcfpm"})],
)
def test_what_has_no_elastic_start_is_refused(specimen, test, options):
    with pytest.raises(InputError, match="start = static, must be rest"):
        flexpm.run(test, specimen, start="static", **options)


def test_an_unknown_start_is_refused(specimen):
    with pytest.raises(InputError, match="start = 'dynamic', must be one of rest, static"):
        flexpm.run("uniaxial", specimen, start="dynamic")
