# SPDX-License-Identifier: GPL-3.0-or-later
"""Strengths of contacts that scatter by the material's modulus, in 2D and 3D."""

from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
import pytest
from refusals import refusal, refused_command
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.materials.material import Material, load
from flexpm.materials.mixing import description, from_description, value_of
from flexpm.models import assembly, solids
from flexpm.rigs import grain_rig
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.space.any_spec import spec_type
from flexpm.specimens.strength_map import contacts_of, factors_of, on_joints

EDGE = 1e-3  # of the grains of a row [m]
DIMENSIONS = pytest.mark.parametrize("solid", [False, True], ids=["2D", "3D"])
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def rock(solid=False, model="flexible", **values):
    name = "augig3d-calibrated" if solid else "augig-calibrated"
    return load(name + ("-rigid" if model == "rigid" else "")).with_set(values, model)


def row(grains, *, solid):
    """Cubes or squares one above the other; 3D grains from spheres, without a seed."""
    heights = EDGE * (np.arange(grains) + 0.5)
    middle = np.full(grains, 0.5 * EDGE)
    if solid:
        spheres = np.column_stack((middle, middle, heights, middle))
        return Specimen.from_spheres(spheres, width=EDGE, depth=EDGE, height=grains * EDGE)
    outline = EDGE * np.array([(0.0, 0.0), (1.0, 0.0), (1.0, grains), (0.0, grains)])
    return Specimen.from_discs(np.column_stack((middle, heights)), middle, outline, EDGE)


def packing(*, solid, seed=1):
    if solid:
        return Specimen.box(0.01, 0.01, 0.02, seed=seed)
    return Specimen.rectangle(0.012, 0.024, 0.01, seed=seed)


@pytest.mark.parametrize(
    ("solid", "model"), [(False, "flexible"), (True, "flexible"), (True, "rigid")]
)
def test_a_row_breaks_at_its_weakest_contact(solid, model):
    specimen = row(13, solid=solid)
    # small grains soften over lengths in proportion
    scattered = rock(solid, model, weibull=3.0).at_grain_size(EDGE)
    factors = factors_of(specimen, scattered)
    result = flexpm.run(
        *("tension", specimen, scattered, model),
        rate=0.2,
        loading="constant",
        start="rest",
        stop_ratio=0.9,
    )
    assert result.peak_stress == pytest.approx(factors.min() * scattered.tensile_strength, rel=5e-3)
    state = result.snapshot
    assert {*state.point_contact[state.point_damage > 0.0]} == {factors.argmin()}


@DIMENSIONS
def test_factors_have_the_mean_1_and_weibulls_variance(solid):
    """The probability of failure at F is 1 - exp(-(F / scale)^m), and the mean is 1."""
    specimen = Specimen.box(0.016, 0.016, 0.032) if solid else Specimen.rectangle(0.04, 0.08, 0.01)
    count, modulus = contacts_of(specimen), 3.0
    found = factors_of(specimen, rock(solid, weibull=modulus))
    assert found.shape == (count,)
    deviation = math.sqrt(math.gamma(1.0 + 2.0 / 3.0) / math.gamma(1.0 + 1.0 / 3.0) ** 2 - 1.0)
    assert found.mean() == pytest.approx(1.0, abs=4.0 * deviation / math.sqrt(count))
    assert found.std() == pytest.approx(deviation, rel=0.1)
    scale = 1.0 / math.gamma(1.0 + 1.0 / modulus)
    least = np.mean(found < 0.5)
    expected = 1.0 - math.exp(-((0.5 / scale) ** modulus))
    assert least == pytest.approx(expected, abs=4.0 * math.sqrt(expected / count))


@DIMENSIONS
def test_equal_packings_have_equal_factors(solid):
    scattered = rock(solid, weibull=3.0)
    one, again = packing(solid=solid), packing(solid=solid)
    stiff = scattered.with_set(tensile_strength=2e6)
    found = factors_of(one, scattered)
    np.testing.assert_array_equal(found, factors_of(again, stiff))
    other = factors_of(packing(solid=solid, seed=2), scattered)
    least = min(len(found), len(other))
    assert not np.array_equal(found[:least], other[:least])
    assert factors_of(one, rock(solid)) is None


def test_factors_multiply_those_of_the_specimen():
    plain = packing(solid=False, seed=7)
    drawn = plain.with_weibull_strengths(3.0, seed=7)
    scattered = rock(weibull=3.0)
    own = factors_of(plain, scattered)
    # the same seed and modulus draw other factors
    assert abs(np.corrcoef(own, drawn.strengths)[0, 1]) < 4.0 / math.sqrt(len(own))
    np.testing.assert_array_equal(factors_of(drawn, scattered), own * drawn.strengths)
    np.testing.assert_array_equal(factors_of(drawn, rock()), drawn.strengths)


def test_contacts_on_joints_have_no_scatter():
    whole = packing(solid=False)
    cut = whole.with_joints({"saw": [(-0.01, 0.008), (0.02, 0.02)]})
    joint = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5}
    values = {f"joint.saw.{key}": value for key, value in joint.items()}
    scattered = rock(weibull=3.0).with_set(values)
    found = factors_of(cut, scattered)
    assert on_joints(cut).sum() == len(cut.lines_of("saw")) > 3
    assert np.all(found[on_joints(cut)] == 1.0)
    assert np.all(found[~on_joints(cut)] != 1.0)
    # a factor of the specimen acts there, as without the key
    weaker = cut.with_strengths(np.full(contacts_of(cut), 0.5))
    np.testing.assert_array_equal(factors_of(weaker, scattered), 0.5 * found)


def pulled(specimen, material, model, rate):
    """A specimen that has been pulled until points soften."""
    rig = flexpm.rig(fresh(specimen, material, model), tension=True)
    rig.strain_to(3e-4, rate=rate)
    return rig


@MODELS
@DIMENSIONS
def test_a_factor_of_all_contacts_is_another_material(solid, model, monkeypatch):
    """Strengths times f and energies times f^2, by the factor and by the material."""
    specimen, usual, factor = packing(solid=solid), rock(solid, model), 0.8
    strengths = ("tensile_strength", "cohesion")
    energies = ("tensile_fracture_energy", "shear_fracture_energy")
    weaker = usual.with_set(
        {key: factor * getattr(usual, key) for key in strengths}
        | {key: factor**2 * getattr(usual, key) for key in energies},
        model,
    )
    # the rate is in proportion to the strength of the material
    rigs = [pulled(specimen, weaker, model, rate=4.0)]
    by_material = rigs[0].built.solver.energies()["damage_energy"], rigs[0].stress
    factors = np.full(contacts_of(specimen), factor)
    for module in (assembly, solids):
        monkeypatch.setattr(module, "factors_of", lambda *_: factors)
    rig = pulled(specimen, usual, model, rate=4.0 * factor)
    by_factor = rig.built.solver.energies()["damage_energy"], rig.stress
    assert by_material[0] > 0.0
    assert by_factor == pytest.approx(by_material, rel=1e-6)


def test_factors_of_the_material_act_as_those_of_the_specimen():
    """The same motion gives the same bits."""
    from yade import wrapper

    specimen, scattered = packing(solid=False), rock(weibull=3.0)
    given = specimen.with_strengths(factors_of(specimen, scattered))
    damages = []
    for one, material in ((specimen, scattered), (given, rock())):
        built = fresh(one, material)
        built.add_engines(before=(wrapper.EndDisplacementController(velocity=2e-9),))
        built.run(2000)
        damages.append(built.snapshot().point_damage)
    assert damages[0].max() > 0.0
    np.testing.assert_array_equal(*damages)


@MODELS
@DIMENSIONS
def test_the_rate_follows_the_weakest_contacts(solid, model):
    """Contacts on 1 % of the area do not exceed it; without scatter nothing changes."""
    specimen = packing(solid=solid)
    plain = flexpm.rig(fresh(specimen, rock(solid, model), model), tension=True).scales()
    assert plain.lowest_strength == plain.strength == rock(solid, model).tensile_strength
    scattered = rock(solid, model, weibull=3.0)
    found = flexpm.rig(fresh(specimen, scattered, model), tension=True).scales()
    assert dataclasses.replace(found, lowest_strength=plain.strength) == plain
    factors = np.sort(factors_of(specimen, scattered))
    least = found.lowest_strength / plain.strength
    assert factors[0] <= least <= factors[len(factors) // 10]
    assert least in factors * plain.strength / plain.strength


def test_the_weakest_contacts_are_found_once_a_rig(monkeypatch):
    found, find = [], grain_rig.scattered_strength

    def counted(built, *, pulled):
        found.append(find(built, pulled=pulled))
        return found[-1]

    monkeypatch.setattr(grain_rig, "scattered_strength", counted)
    rig = flexpm.rig(fresh(packing(solid=False), rock(False, weibull=3.0)))
    scales = {rig.scales().lowest_strength for _ in range(3)}
    rig.stress_to(5e6)
    rig.stress_to(1e6)
    assert len(found) == 1 and scales == {found[0]}


def test_the_rate_follows_the_weakest_contacts_of_minerals():
    specimen = packing(solid=False)
    minerals = [
        {"name": "hard", "fraction": 0.5},
        {"name": "soft", "fraction": 0.5, "tensile_strength": 2e6, "tensile_fracture_energy": 2.0},
    ]
    usual = load("augig-calibrated")
    plain = dataclasses.replace(usual, minerals=minerals)
    scattered = plain.with_set(weibull=5.0)
    one, two = (
        flexpm.rig(fresh(specimen, material), tension=True).scales()
        for material in (plain, scattered)
    )
    assert one.lowest_strength == 2e6
    assert 0.2 * 2e6 < two.lowest_strength < 2e6
    assert two.strength == one.strength


def test_none_removes_the_key():
    scattered = rock(weibull=3.0)
    assert description(scattered.with_set(["weibull=none"])) == description(rock())
    refusal("set cohesion = 'none' Pa, must be a number", scattered.with_set, ["cohesion=none"])


@DIMENSIONS
def test_the_key_is_an_input_and_absent_without_it(solid):
    plain, scattered = rock(solid), rock(solid, weibull=3.0)
    assert "weibull" not in description(plain)
    assert description(scattered)["weibull"] == 3.0
    assert from_description({"name": "rock", **description(scattered)}, "flexible").weibull == 3.0
    assert value_of(scattered, "weibull", "flexible") == 3.0
    shape = "box" if solid else "rectangle"
    runs = [
        RunSpec("tension", spec_type(shape)(shape), described(one, "flexible"))
        for one in (plain, scattered)
    ]
    assert runs[0].key() != runs[1].key()
    again = RunSpec.from_json(json.loads(json.dumps(runs[1].to_json())))
    assert again == runs[1]
    assert again.key() == runs[1].key()
    assert "weibull" not in json.dumps(runs[0].to_json())


def test_no_scatter_at_all_is_allowed_as_an_assignment():
    scattered = Material.from_dict(
        {
            **{"tensile_strength": 8.5e6, "cohesion": 30e6, "friction": 0.5},
            **{"softening": "brittle", "weibull": 4},
            "elastic": {"rigid": {"normal_stiffness": 2e13, "shear_ratio": 0.3}},
        }
    )
    assert scattered.weibull == 4.0
    assert scattered.with_set("weibull=6", "rigid").weibull == 6.0
    assert scattered.with_set({"weibull": None}, "rigid").weibull is None


@pytest.mark.parametrize(
    ("value", "rule"), [(0.5, "must be >= 1"), (1e7, "must be <= 1e"), ("wide", "must be a number")]
)
def test_moduli_that_cannot_be(value, rule):
    refusal(f"material weibull = .*{value}.*, {rule}", rock().with_set, {"weibull": value})


@pytest.mark.parametrize("model", ["inner", "jcfpm", "cohfrict"])
def test_other_models_refuse_the_key(model):
    scattered = load("augig-calibrated").with_set(weibull=3.0)
    words = f"material weibull = 3, must not be given for model {model}; leave it out"
    refusal(words, description, scattered, model)
    refusal(words, flexpm.build, packing(solid=False), scattered, model)


def test_minerals_and_interfaces_have_no_modulus(capsys):
    base = load("augig-calibrated")
    minerals = [{"name": "a", "fraction": 0.5}, {"name": "b", "fraction": 0.5}]
    mixed = dataclasses.replace(base, minerals=minerals)
    refusal("key = 'weibull', unknown", mixed.with_set, {"a.weibull": 3.0})
    refusal("key = 'weibull', unknown", mixed.with_set, {"interface.a/b.weibull": 3.0})
    refused_command(
        *(capsys, "material weibull = 0.2, must be >= 1"),
        *("elastic", "--width", 0.012, "--height", 0.024, "--set", "weibull=0.2"),
    )
