# SPDX-License-Identifier: GPL-3.0-or-later
"""Minerals and laws of their pairs on YADE's own bonded models, by the mixing of the others."""

import dataclasses
import math

import numpy as np
import pytest
import yade

import flexpm
from flexpm.materials import mixing
from flexpm.materials.interface import FACTOR_KEYS, Interface
from flexpm.materials.material import Material

MODELS = ["jcfpm", "cohfrict"]
SIZE, THICKNESS = 2e-3, 0.01  # of square grains [m]
BASE = {
    "tensile_strength": 8.5e6,
    "cohesion": 30e6,
    "friction": 0.4,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 800.0,
    "elastic": {"rigid": {"normal_stiffness": 5e13, "shear_ratio": 0.3}},
    "mineral": [
        {"name": "quartz", "fraction": 0.5},
        {
            "name": "mica",
            "fraction": 0.5,
            "friction": 0.3,
            "density": 3000.0,
            "elastic": {"rigid": {"normal_stiffness": 2e14}},
        },
    ],
}
WEAK = {"tensile_strength": 2e6, "cohesion": 5e6, "friction": 0.2}


def rock(*interfaces):
    return Material.from_dict({**BASE, "interface": list(interfaces)}, "rock")


def grid(columns, rows):
    """Square grains of equal discs."""
    x, y = (SIZE * (np.arange(n) + 0.5) for n in (columns, rows))
    centres = np.array([(a, b) for b in y for a in x])
    width, height = columns * SIZE, rows * SIZE
    outline = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    radii = np.full(len(centres), 0.5 * SIZE)
    return flexpm.Specimen.from_discs(centres, radii, outline, THICKNESS, short_edge=0.0)


@pytest.mark.parametrize("model", MODELS)
def test_each_bond_has_the_law_of_its_pair(model):
    kinds = np.random.default_rng(1).integers(0, 2, 24)
    material = rock({"pair": ["mica", "quartz"], **WEAK, "factor": {"normal_stiffness": 0.5}})
    built = flexpm.build(grid(4, 6).with_minerals(kinds), material, model)
    laws = [pair.law(model) for pair in mixing.pair_materials(material, model)]
    seen = set()
    for bond in yade.O.interactions:
        grains = [built.ids.index(bond.id1), built.ids.index(bond.id2)]
        first, second = (int(kinds[grain]) for grain in grains)
        law, area, phys = laws[2 * first + second], SIZE * THICKNESS, bond.phys
        names = {
            "jcfpm": ("FnMax", "FsMax", "tanFrictionAngle"),
            "cohfrict": ("normalAdhesion", "shearAdhesion", "tangensOfFrictionAngle"),
        }[model]
        found = (phys.kn, phys.ks, *(getattr(phys, name) for name in names))
        normal = law["normal_stiffness"] * area
        strengths = law["tensile_strength"] * area, law["cohesion"] * area
        expected = (normal, law["shear_ratio"] * normal, *strengths, law["friction"])
        assert found == pytest.approx(expected, rel=1e-9)
        seen.add((min(first, second), max(first, second)))
    assert seen == {(0, 0), (0, 1), (1, 1)}
    frictions = [math.tan(yade.O.bodies[body].material.frictionAngle) for body in built.ids]
    assert frictions == pytest.approx(np.array([0.4, 0.3])[kinds])
    described = built.describe_material()
    assert described["interfaces"][0]["cohesion"] == 5e6
    shares = [kind["area_fraction"] for kind in described["minerals"]]
    assert shares == pytest.approx([1.0 - kinds.mean(), kinds.mean()])
    assert np.array_equal(built.snapshot().grain_mineral, kinds)


@pytest.mark.parametrize("model", MODELS)
def test_masses_of_a_dynamic_model_are_those_of_the_minerals(model):
    kinds = [0] * 4 + [1] * 4
    built = flexpm.build(grid(2, 4).with_minerals(kinds), rock(), model, dynamic=True)
    volume = SIZE**2 * THICKNESS
    masses = [state.mass for state in built.states()]
    expected = volume * np.where(kinds, 3000.0, 2650.0)
    assert masses == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_two_layers_part_at_the_strength_of_their_pair(model):
    specimen = grid(2, 4).with_minerals([0] * 4 + [1] * 4)
    material = rock({"pair": ["quartz", "mica"], **WEAK})
    result = flexpm.run("tension", specimen, material, model, rate=0.05)
    stress = result.curve["axial_stress"]
    row = float(np.diff(stress[: stress.argmax() + 1]).max())  # bonds break between two rows
    assert 2e6 - 1.1 * row <= result.peak_stress <= 2e6 * (1.0 + 1e-3) and row < 8e4
    assert result.cracks_by_pair == {"mica/quartz": {"tensile": 2, "shear": 0}}
    whole = flexpm.run("tension", specimen, rock(), model, rate=0.05)
    assert whole.peak_stress > 3.0 * result.peak_stress


@pytest.mark.long
@pytest.mark.parametrize("model", ["jcfpm", pytest.param("cohfrict", marks=pytest.mark.slow)])
def test_a_pair_that_is_a_thousand_times_as_strong_never_cracks(model, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, THICKNESS, seed=3)
    factors = {"tensile_strength": 1e3, "cohesion": 1e3}
    factors |= {"tensile_fracture_energy": 1e6, "shear_fracture_energy": 1e6}
    material = rock({"pair": ["quartz", "mica"], "factor": factors})
    # the others have broken by then; at far more than that stresses come to these strengths, too
    result = flexpm.run(
        "uniaxial", specimen, material, model, max_strain=0.02, out=tmp_path, report=False
    )
    counts = result.cracks_by_pair
    assert counts and "mica/quartz" not in counts
    for mode in ("tensile", "shear"):
        number = sum(pair[mode] for pair in counts.values())
        assert number == getattr(result, f"{mode}_cracks")
    assert flexpm.Result.read(tmp_path).cracks_by_pair == counts


@pytest.mark.parametrize("model", MODELS)
def test_factors_of_one_and_a_rock_of_one_mineral_leave_all_bits(model):
    specimen = flexpm.Specimen.rectangle(0.012, 0.016, THICKNESS, seed=3)
    ones = Interface(("mica", "quartz"), factors=dict.fromkeys(FACTOR_KEYS, 1.0))
    alike = {key: value for key, value in BASE.items() if key != "mineral"}
    single = alike | {"mineral": [{"name": "quartz", "fraction": 1.0}]}
    twins = [{"name": name, "fraction": 0.5} for name in ("quartz", "mica")]
    for one, other in (
        (rock(), dataclasses.replace(rock(), interfaces=(ones,))),
        (Material.from_dict(alike), Material.from_dict(single)),
        (Material.from_dict(alike), Material.from_dict(alike | {"mineral": twins})),
    ):
        curves = [
            flexpm.run("tension", specimen, material, model, rate=2.0).curve.csv()
            for material in (one, other)
        ]
        assert curves[0] == curves[1]
