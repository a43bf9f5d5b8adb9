# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials for grains of another size: by similarity, and what a run says of them."""

from __future__ import annotations

import dataclasses
import functools
import operator

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.materials.grain_size import modulus_ratio
from flexpm.materials.material import load
from flexpm.results import doubts
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.space.any_spec import spec_type

DIMENSIONS = pytest.mark.parametrize("solid", [False, True], ids=["2D", "3D"])
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def preset(solid, model):
    name = "augig3d-calibrated" if solid else "augig-calibrated"
    return load(name + ("-rigid" if model == "rigid" else ""))


def specimen(scale, *, solid):
    """The same grains in a specimen whose lengths are all multiplied by a scale."""
    if solid:
        small = Specimen.box(0.01, 0.01, 0.02, seed=3)
        sizes = {name: scale * size for name, size in small.dimensions.items()}
        return Specimen.from_spheres(scale * small.spheres, **sizes)
    small = Specimen.rectangle(0.012, 0.024, 0.01, seed=3)
    return Specimen.from_discs(
        scale * small.centres, scale * small.radii, scale * small.outline, scale * small.thickness
    )


@MODELS
@DIMENSIONS
def test_similar_specimens_have_equal_elastic_constants(solid, model):
    rock = preset(solid, model)
    one = flexpm.elastic(specimen(1.0, solid=solid), rock, model)
    large = flexpm.elastic(specimen(2.0, solid=solid), rock.at_grain_size(6e-3), model)
    for name in ("youngs_modulus", "poissons_ratio"):
        assert large[name] == pytest.approx(one[name], rel=1e-9)


@MODELS
@DIMENSIONS
def test_similar_specimens_have_equal_stresses(solid, model):
    """A power of two scales almost all numbers to the same digits; in 3D rounding grows as points
    soften.
    """
    rock = preset(solid, model)
    one, large = (
        flexpm.run(
            *("tension", specimen(scale, solid=solid), material, model),
            rate=8.0,
            loading="constant",
        )
        for scale, material in ((1.0, rock), (2.0, rock.at_grain_size(6e-3)))
    )
    assert one.tensile_cracks > 0
    assert large.peak_stress == pytest.approx(one.peak_stress, rel=1e-4 if solid else 1e-9)
    rows = 20 if solid else len(one.curve)
    for name in ("axial_stress", "axial_strain"):
        np.testing.assert_allclose(large.curve[name][:rows], one.curve[name][:rows], rtol=1e-9)
    if not solid:
        assert large.steps == one.steps
        assert large.tensile_cracks == one.tensile_cracks


def test_values_of_contacts_change_and_others_stay():
    two = {
        "name": "b",
        "fraction": 0.5,
        "tensile_fracture_energy": 20.0,
        "elastic": {"flexible": {"normal_stiffness": 9e13}},
    }
    rock = dataclasses.replace(
        load("augig-calibrated"),
        minerals=[{"name": "a", "fraction": 0.5}, two],
        interfaces=[{"pair": ["a", "b"], "normal_stiffness": 4e13, "factor": {"cohesion": 0.5}}],
    ).with_set({"weibull": 5.0})
    fine = rock.at_grain_size(1.5e-3)
    assert fine.made_for == dataclasses.replace(rock.made_for, mean_diameter=1.5e-3)
    for name, chosen in fine.elastic.items():
        before = rock.elastic[name]
        assert chosen == dataclasses.replace(before, normal_stiffness=2.0 * before.normal_stiffness)
    assert fine.tensile_fracture_energy == 0.5 * rock.tensile_fracture_energy
    assert fine.shear_fracture_energy == 0.5 * rock.shear_fracture_energy
    assert fine.minerals[1].changes == {
        "tensile_fracture_energy": 10.0,
        "elastic": {"flexible": {"normal_stiffness": 1.8e14}},
    }
    assert fine.minerals[0] == rock.minerals[0]
    assert fine.interfaces[0].values == {"normal_stiffness": 8e13}
    assert fine.interfaces[0].factors == rock.interfaces[0].factors
    same = ("name", "tensile_strength", "cohesion", "friction", "density", "weibull", "softening")
    assert all(getattr(fine, key) == getattr(rock, key) for key in same)
    assert fine.at_grain_size(3e-3) == rock
    assert rock.at_grain_size(3e-3) == rock


def test_joints_stay_and_brittle_energies_follow():
    joint = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5}
    rock = load("augig-table2-brittle").with_set(
        {f"joint.saw.{key}": value for key, value in joint.items()}, "rigid"
    )
    coarse = rock.at_grain_size(6e-3)
    assert coarse.joints == rock.joints
    assert coarse.tensile_fracture_energy is None
    law, before = coarse.law("rigid"), rock.law("rigid")
    assert law["tensile_fracture_energy"] == 2.0 * before["tensile_fracture_energy"]


@pytest.mark.parametrize("diameter", [0.0, -1e-3, float("nan"), "3 mm"])
def test_diameters_that_cannot_be(diameter):
    refusal(
        "Material.at_grain_size: mean_diameter = ", load("augig-table7").at_grain_size, diameter
    )


def test_a_material_without_a_diameter_is_refused():
    rock = load("augig-table7")
    unknown = dataclasses.replace(rock.made_for, mean_diameter=None)
    for made_for in (None, unknown):
        plain = dataclasses.replace(rock, made_for=made_for)
        refusal("has no mean grain diameter .* give made_for = ", plain.at_grain_size, 2e-3)


@functools.cache
def modulus(scale, *, solid, model):
    """Young's modulus of a wide specimen with grains of another size, by the elastic solution."""
    diameters = (2e-3 * scale, 4e-3 * scale)
    wide = (
        Specimen.box(*(scale * size for size in (0.02, 0.02, 0.04)), diameters=diameters)
        if solid
        else Specimen.rectangle(0.04 * scale, 0.08 * scale, 0.01, diameters=diameters)
    )
    return flexpm.elastic(wide, preset(solid, model), model)["youngs_modulus"]


@pytest.mark.parametrize("scale", [0.5, 2.0, 4.0])
@MODELS
@DIMENSIONS
def test_the_formula_of_the_modulus_is_good(solid, model, scale):
    """The ratio of moduli by the formula and by solutions differs by less than 0.5 %."""
    law = described(preset(solid, model), model)
    found = modulus_ratio(law, model, scale * 3e-3, 3e-3, solid=solid)
    solved = (modulus(one, solid=solid, model=model) for one in (scale, 1.0))
    assert found == pytest.approx(operator.truediv(*solved), rel=5e-3)
    if model == "rigid":
        assert found == pytest.approx(scale, rel=1e-12)


def test_fitted_inner_particles_keep_the_modulus():
    law = described(load("augig-calibrated"), "inner")
    assert modulus_ratio(law, "inner", 6e-3, 3e-3, solid=False) == 1.0
    law.pop("young")
    assert modulus_ratio(law, "inner", 6e-3, 3e-3, solid=False) == pytest.approx(2.0)


def told(diameters, material, model="flexible", shape="rectangle"):
    spec = spec_type(shape)(shape, diameters=diameters)
    run = RunSpec("uniaxial", spec, described(material, model), model)
    return [line for line in doubts.of_inputs(run.to_json()) if "mean diameter" in line]


@pytest.mark.parametrize(("solid", "shape"), [(False, "rectangle"), (True, "box")])
def test_a_run_warns_of_grains_of_another_size(solid, shape):
    rock = preset(solid, "flexible")
    (line,) = told((1e-3, 2e-3), rock, shape=shape)
    assert line.startswith("mean diameter of the grains = 0.0015 m, is 0.5 times the 0.003 m of ")
    assert "(limit 1.3): Young's modulus is about 0.9" in line
    assert "take Material.at_grain_size(0.0015) or calibrate for these grains" in line
    # up to a factor of 1.3 nothing is said
    assert told((3.9e-3, 3.9e-3), rock, shape=shape) == []
    assert len(told((3.95e-3, 3.95e-3), rock, shape=shape)) == 1
    assert told((2.35e-3, 2.35e-3), rock, shape=shape) == []
    assert len(told((2.25e-3, 2.25e-3), rock, shape=shape)) == 1
    # nor of a material for these grains, or for unknown ones
    assert told((1e-3, 2e-3), rock.at_grain_size(1.5e-3), shape=shape) == []
    assert told((1e-3, 2e-3), dataclasses.replace(rock, made_for=None), shape=shape) == []


def test_rigid_grains_change_the_modulus_in_proportion():
    (line,) = told((4e-3, 8e-3), preset(False, "rigid"), "rigid")
    assert "Young's modulus is about 2 times as large" in line


def test_pieces_of_grains_beside_joints_are_no_smaller_grains():
    """The grains are given: for a packing, the warning takes the diameters of its discs."""
    lines = {f"a{k}": [(-1e-3, 1e-3 * k), (0.013, 1e-3 * k + 5e-4)] for k in range(1, 24)}
    cut = specimen(1.0, solid=False).with_joints(lines)
    assert cut.mean_diameter < 3e-3 / doubts.LARGEST_SIZE_RATIO
    law = {"normal_stiffness": 1e13, "shear_stiffness": 1e13, "friction": 0.5}
    joints = dict.fromkeys(lines, law)
    rock = dataclasses.replace(preset(False, "flexible"), joints=joints)
    assert not any("mean diameter" in line for line in flexpm.PartRig(fresh(cut, rock)).warnings)


def test_lengths_in_millimetres_are_told_once(tmp_path, capsys):
    large = specimen(1024.0, solid=False)
    rig = flexpm.PartRig(fresh(large, preset(False, "flexible")))
    assert any("unusual" in line for line in rig.warnings)
    assert not any("mean diameter" in line for line in rig.warnings)
    large.save(tmp_path / "large.json")
    assert cli.main(["elastic", "--specimen", str(tmp_path / "large.json"), "--quiet"]) == 0
    told = capsys.readouterr()
    assert "unusual" in told.out + told.err and "mean diameter of the grains" not in told.out


def test_given_grains_are_told_by_rigs_and_commands(tmp_path, capsys):
    rock, fine = preset(False, "flexible"), specimen(0.5, solid=False)
    rig = flexpm.PartRig(fresh(fine, rock))
    assert sum("mean diameter of the grains" in line for line in rig.warnings) == 1
    fitting = flexpm.PartRig(fresh(fine, rock.at_grain_size(1.5e-3)))
    assert not any("mean diameter of the grains" in line for line in fitting.warnings)
    fine.save(tmp_path / "fine.json")
    command = ["elastic", "--specimen", str(tmp_path / "fine.json"), "--quiet"]
    assert cli.main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sum("warning: mean diameter of the grains" in line for line in lines) == 1
