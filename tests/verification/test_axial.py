# SPDX-License-Identifier: GPL-3.0-or-later
"""Axial tests of small specimens: elastic solve, bounds of the law, balance of energies."""

import numpy as np
import pytest

import flexpm
from flexpm.errors import InputError
from flexpm.materials.keys import ENERGY_KEYS
from flexpm.results import measures
from flexpm.runs import loading_rate as rates
from flexpm.runs.loading_rate import Loading, Scales, schedule

WIDTH, HEIGHT = 0.02, 0.04  # [m]
STRENGTH = 8.5e6  # of a contact point in tension, Table 7 [Pa]


@pytest.fixture(scope="module")
def specimen():
    return flexpm.Specimen.rectangle(WIDTH, HEIGHT, thickness=0.08, seed=3)


@pytest.fixture(scope="module")
def results(specimen):
    """Run each axial test once, early enough past the peak."""
    return {
        "uniaxial": flexpm.run("uniaxial", specimen),
        "tension": flexpm.run("tension", specimen),
        "biaxial": flexpm.run("biaxial", specimen, confinement=4e6),
    }


@pytest.mark.long
@pytest.mark.parametrize("test", ["uniaxial", "tension", "biaxial"])
def test_slopes_are_those_of_the_elastic_solve(specimen, results, test):
    elastic = flexpm.elastic(specimen)
    result = results[test]
    assert result.youngs_modulus == pytest.approx(elastic["youngs_modulus"], rel=0.01)
    assert result.poissons_ratio == pytest.approx(elastic["poissons_ratio"], abs=0.01)


@pytest.mark.long
@pytest.mark.parametrize("test", ["uniaxial", "tension", "biaxial"])
def test_runs_are_quasistatic_and_their_energies_balance(results, test):
    result = results[test]
    assert result.status == "ok"
    assert result.energy_error < 0.01
    assert result.tensile_cracks + result.shear_cracks == len(result.cracks) > 0


@pytest.mark.long
def test_direct_tension_lies_below_the_contacts_strength_and_is_brittle(results):
    result = results["tension"]
    assert 0.5 * STRENGTH < result.peak_stress < 1.2 * STRENGTH
    assert result.tensile_cracks > result.shear_cracks


@pytest.mark.long
def test_confinement_is_held_and_strengthens(results):
    confined = results["biaxial"]
    assert np.all(np.abs(confined.curve["confinement"] / 4e6 - 1.0) < 0.01)
    assert confined.peak_stress > results["uniaxial"].peak_stress + 4e6


@pytest.mark.long
def test_a_specimen_has_one_slope_before_its_peak(results):
    """The secant at 3/4 of the peak is still within 3 % of the slope at its start."""
    record = results["uniaxial"].curve
    stress, strain = record["axial_stress"], record["axial_strain"]
    row = int(np.argmax(stress >= 0.75 * results["uniaxial"].peak_stress))
    assert stress[row] / strain[row] == pytest.approx(results["uniaxial"].youngs_modulus, rel=0.03)


@pytest.mark.long
@pytest.mark.parametrize(("model", "saved"), [("flexible", 0.3), ("rigid", 0.1)])
def test_adaptive_loading_gives_the_measures_of_constant_loading(specimen, model, saved):
    constant, adaptive = (
        flexpm.run("uniaxial", specimen, model=model, loading=loading)
        for loading in ("constant", "adaptive")
    )
    # the last cracks before a peak are chaotic: adapting must not alter it by more than halving the
    # rate does
    assert adaptive.peak_stress == pytest.approx(constant.peak_stress, rel=0.02)
    assert adaptive.youngs_modulus == pytest.approx(constant.youngs_modulus, rel=5e-3)
    assert adaptive.poissons_ratio == pytest.approx(constant.poissons_ratio, abs=5e-3)
    assert (adaptive.status, constant.status) == ("ok", "ok")
    assert adaptive.energy_error < 1e-4
    assert adaptive.steps < (1.0 - saved) * constant.steps
    factor = adaptive.curve["velocity_factor"]
    assert factor[0] == pytest.approx(rates.fastest_factor("uniaxial", model))
    assert factor[int(np.argmax(adaptive.curve["axial_stress"]))] == pytest.approx(1.0, abs=0.5)
    assert set(constant.curve["velocity_factor"]) == {1.0}


@pytest.mark.parametrize(
    ("test", "model"),
    [("tension", "flexible"), pytest.param("uniaxial", "rigid", marks=pytest.mark.long)],
)
def test_waiting_loading_gives_the_strength_of_a_slow_one_in_fewer_steps(test, model):
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, 0.08, seed=2)
    slow = flexpm.run(test, specimen, model=model, loading="constant", rate=0.25)
    waiting = flexpm.run(test, specimen, model=model, loading="waiting")
    assert waiting.peak_stress == pytest.approx(slow.peak_stress, rel=0.02)
    assert waiting.youngs_modulus == pytest.approx(slow.youngs_modulus, rel=1e-2)
    assert waiting.poissons_ratio == pytest.approx(slow.poissons_ratio, abs=5e-3)
    assert waiting.energy_error < 0.01
    assert waiting.steps < 0.3 * slow.steps
    assert (slow.status, waiting.status) == ("ok", "ok")
    factor = waiting.curve["velocity_factor"]
    fastest = rates.rates_of(test, model).waiting_constant / rates.rates_of(test, model).constant
    assert factor[0] == pytest.approx(fastest)
    assert 0.01 * fastest <= np.min(factor) < 0.2 * fastest


@pytest.mark.parametrize(
    ("options", "rule"),
    [
        ({"model": "inner"}, "must be adaptive or constant for model inner"),
        ({"model": "jcfpm"}, "must be constant for model jcfpm"),
    ],
)
def test_waiting_loading_is_refused_where_no_damage_tells_of_cracks(specimen, options, rule):
    with pytest.raises(InputError, match=f"loading = waiting, {rule}"):
        flexpm.run("tension", specimen, loading="waiting", **options)


@pytest.mark.long
def test_brittle_tension_has_the_strength_of_a_slow_rate():
    """The adaptive rate gives 7.47 MPa here; a much slower constant one gives 8.90."""
    specimen = flexpm.Specimen.rectangle(0.04, 0.08, 0.08, seed=5)
    result = flexpm.run("tension", specimen, "augig-table2-brittle")
    assert result.inputs["loading"] == "waiting"
    assert result.peak_stress == pytest.approx(8.90e6, rel=0.016)
    warnings = [one for one in result.warnings if "calibrated" not in one]  # for rigid grains
    assert (result.status, warnings) == ("ok", [])


@pytest.mark.parametrize("stiffness", [1.0, 100.0])
@pytest.mark.parametrize(
    ("test", "model"),
    [
        ("uniaxial", "flexible"),
        ("tension", "flexible"),
        ("biaxial", "flexible"),
        ("uniaxial", "rigid"),
        ("tension", "rigid"),
    ],
)
def test_elastic_constants_of_a_run_are_those_of_the_solve(test, model, stiffness):
    """Fast loading of unbreakable contacts, however stiff: damping does not act on the loading.

    Strains stay small, since stretched triangles are stiffer or softer by three times the strain
    itself, that of the confinement among them.
    """
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, 0.08, seed=1)
    rock = flexpm.materials.load(None, model)
    stiff = rock.with_set(
        {"normal_stiffness": stiffness * rock.elastic[model].normal_stiffness}, model
    )
    material = stiff.with_set(
        {
            **{"tensile_strength": 1e3 * rock.tensile_strength, "cohesion": 1e3 * rock.cohesion},
            **{key: 1e7 * getattr(rock, key) for key in ENERGY_KEYS},
        }
    )
    result = flexpm.run(
        test,
        specimen,
        material,
        model=model,
        confinement=4e6 if test == "biaxial" else 0.0,
        start="rest" if model == "flexible" and test == "tension" else None,
        rate=2e-4,
        max_strain=5e-4 / (1.0 if model == "flexible" else stiffness),
    )
    exact = flexpm.elastic(specimen, stiff, model)
    strain, stress = result.curve["axial_strain"], measures.differential_stress(result.curve)
    young = np.polyfit(strain, stress, 1)[0]
    poisson = np.polyfit(strain, result.curve["lateral_strain"], 1)[0]
    assert young == pytest.approx(exact["youngs_modulus"], rel=2e-3)
    assert poisson == pytest.approx(exact["poissons_ratio"], abs=1e-3)


def test_adaptive_loading_keeps_to_the_fastest_rate_at_any_factor():
    k = rates.rates_of("uniaxial", "flexible").constant
    for factor in (0.1, 1.0, 2.0, 1e3):
        fastest = rates.fastest_factor("uniaxial", "flexible", factor)
        assert fastest >= 1.0
        assert fastest * factor * k <= max(rates.FASTEST_CONSTANT, factor * k) * (1.0 + 1e-12)
    assert rates.fastest_factor("uniaxial", "flexible", 0.1) == pytest.approx(
        rates.fastest_factor("uniaxial", "flexible")
    )


@pytest.mark.parametrize("options", [{"model": "jcfpm"}, {"dynamic": True}])
def test_adaptive_loading_is_refused_where_time_is_real_or_the_model_yades(specimen, options):
    with pytest.raises(InputError, match="loading = adaptive, must be constant"):
        flexpm.run("uniaxial", specimen, loading="adaptive", **options)


def test_an_unknown_loading_is_refused(specimen):
    with pytest.raises(
        InputError, match="loading = 'fast', must be one of constant, adaptive, waiting"
    ):
        flexpm.run("uniaxial", specimen, loading="fast")


def test_the_rate_scales_with_its_factor_and_the_wave():
    scales = Scales(crossing_steps=500.0, modulus=2e10, strength=1e8, height=0.1, width=0.05)
    one, two = (schedule("uniaxial", "flexible", Loading(rate), scales) for rate in (1.0, 2.0))
    k = rates.rates_of("uniaxial", "flexible").constant
    assert one.velocity == pytest.approx(k * (1e8 / 2e10) * 0.1 / 500.0)
    assert two.velocity == pytest.approx(2.0 * one.velocity)
