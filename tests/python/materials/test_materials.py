# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials: values of the paper's tables, brittle energies in closed form, and refused input."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

from flexpm import materials
from flexpm.errors import InputError
from flexpm.materials.keys import ELASTIC_SET, UNITS, is_used
from flexpm.materials.material import Material

NUMBERS = [key for key, unit in UNITS.items() if unit is not None]


def test_table_1_is_complete_in_every_preset_of_the_paper():
    names = [name for name in materials.preset_names() if "calibrated" not in name]
    assert len(names) == 6
    for name in names:
        material = materials.load(name)
        quartz = name.endswith("-quartz")
        flexible = material.law("flexible")
        assert flexible["young"] == (51.6e9 if quartz else 25.8e9)
        assert flexible["normal_stiffness"] == (2.06e13 if quartz else 18.00e13)
        assert (flexible["poisson"], flexible["shear_ratio"]) == (0.23, 0.28)
        rigid, inner = material.law("rigid"), material.law("inner")
        assert (rigid["normal_stiffness"], rigid["shear_ratio"]) == (1.08e13, 0.28)
        assert (inner["normal_stiffness"], inner["shear_ratio"]) == (4.90e13, 0.30)


@pytest.mark.parametrize(
    ("name", "strengths"),
    [
        ("augig-table7", (8.5e6, 29.75e6, 0.40, 20.0, 800.0)),
        ("augig-table2-bilinear", (11.5e6, 33.25e6, 0.5, 66.1, 2078.6)),
    ],
)
def test_strengths_are_those_of_the_paper(name, strengths):
    for suffix in ("", "-quartz"):
        material = materials.load(name + suffix)
        assert material.name == name + suffix
        assert (material.tensile_strength, material.cohesion, material.friction) == strengths[:3]
        energies = (material.tensile_fracture_energy, material.shear_fracture_energy)
        assert energies == strengths[3:]


@pytest.mark.parametrize("model", ELASTIC_SET)
def test_brittle_energies_are_the_elastic_energies_of_the_models_set(model):
    law = materials.load("augig-table2-brittle").law(model)
    stiffness, ratio = law["normal_stiffness"], law["shear_ratio"]
    assert law["tensile_fracture_energy"] == pytest.approx(13.70e6**2 / (2 * stiffness))
    assert law["shear_fracture_energy"] == pytest.approx(48.80e6**2 / (2 * ratio * stiffness))


@pytest.mark.parametrize("solid", [False, True])
@pytest.mark.parametrize("model", ELASTIC_SET)
def test_the_default_was_calibrated_for_the_dimension_and_the_kind_of_grains(model, solid):
    if solid and model.startswith("inner"):
        pytest.skip("inner particles are 2D only")
    flexible = model == "flexible"
    names = {
        False: ("augig-table7", "augig-table2-bilinear"),
        True: ("augig3d-calibrated", "augig3d-calibrated-rigid"),
    }[solid]
    found = materials.load(None, model, solid=solid)
    assert found.name == names[0 if flexible else 1]
    assert found.made_for.suits(model, solid=solid)
    assert not found.made_for.suits(model, solid=not solid)
    assert not found.made_for.suits("rigid" if flexible else "flexible", solid=solid)


def test_all_presets_know_the_grains_of_their_calibration():
    for name in materials.preset_names():
        made_for = materials.load(name).made_for
        assert made_for.dimension == ("3D" if name.startswith("augig3d") else "2D")
        # Table 2 was fitted for rigid grains; all packings had diameters of 2 to 4 mm
        rigid = "table2" in name or name.endswith("rigid")
        assert made_for.model == ("rigid" if rigid else "flexible")
        assert made_for.mean_diameter == pytest.approx(3e-3)


@pytest.mark.parametrize(
    ("made_for", "message"),
    [
        ({"dimension": "2D"}, "made_for model is missing"),
        ({"model": "rigid"}, "made_for dimension is missing"),
        ({"dimension": "4D", "model": "rigid"}, "made_for dimension = '4D', unknown"),
        ({"dimension": "2D", "model": "rigit"}, r"model = 'rigit', unknown \(did you mean rigid"),
        ({"dimension": "2D", "model": "rigid", "mean": 1}, "made_for key = 'mean', unknown"),
        (
            {"dimension": "2D", "model": "rigid", "mean_diameter": 0},
            "mean_diameter = 0 m, must be > 0",
        ),
        ("2D", "made_for = '2D', must be a table"),
    ],
)
def test_made_for_is_checked(made_for, message):
    plain = {"tensile_strength": 8e6, "cohesion": 3e7, "friction": 0.4, "softening": "brittle"}
    elastic = {"rigid": {"normal_stiffness": 1e13, "shear_ratio": 0.3}}
    refusal(message, Material.from_dict, {**plain, "elastic": elastic, "made_for": made_for})


def test_set_acts_on_the_set_of_the_chosen_model_only():
    material = materials.load("augig-table7")
    changed = material.with_set(["normal_stiffness=2e13", "cohesion=25e6"], "rigid")
    assert changed.law("rigid")["normal_stiffness"] == 2e13
    assert changed.law("flexible")["normal_stiffness"] == 18e13
    assert changed.law("flexible")["cohesion"] == 25e6
    assert material.law("rigid")["normal_stiffness"] == 1.08e13


def test_set_brittle_replaces_the_energies_of_the_material():
    law = materials.load("augig-table7").with_set(["softening=brittle"]).law("flexible")
    assert law["tensile_fracture_energy"] == pytest.approx(8.5e6**2 / (2 * 18e13))
    with pytest.raises(InputError, match="brittle softening fixes it"):
        materials.load("augig-table7").with_set(["softening=brittle", "tensile_fracture_energy=5"])


def test_energy_at_the_elastic_energy_is_allowed_and_below_it_is_not():
    material = materials.load("augig-table7")
    smallest = 8.5e6**2 / (2 * 18e13)
    allowed = material.with_set([f"tensile_fracture_energy={smallest * (1 - 1e-13)!r}"])
    assert allowed.law("flexible")["tensile_fracture_energy"] == smallest * (1 - 1e-13)
    with pytest.raises(InputError, match=r"smallest allowed value is 0\.200694") as caught:
        material.with_set([f"tensile_fracture_energy={smallest * (1 - 1e-11)!r}"])
    stated = float(str(caught.value).split(" is ")[-1].split()[0])
    assert stated == pytest.approx(smallest, rel=1e-15)


@given(
    strength=st.floats(1e3, 1e9),
    cohesion=st.floats(1e3, 1e9),
    stiffness=st.floats(1e9, 1e16),
    ratio=st.floats(0.01, 2.0),
)
def test_stated_smallest_energy_is_accepted(strength, cohesion, stiffness, ratio):
    data = {
        "tensile_strength": strength,
        "cohesion": cohesion,
        "friction": 0.4,
        "softening": "brittle",
        "elastic": {"rigid": {"normal_stiffness": stiffness, "shear_ratio": ratio}},
    }
    tensile, shear = Material.from_dict(data).elastic_energies("rigid")
    data |= {
        "softening": "bilinear",
        "tensile_fracture_energy": tensile,
        "shear_fracture_energy": shear,
    }
    law = Material.from_dict(data).law("rigid")
    assert (law["tensile_fracture_energy"], law["shear_fracture_energy"]) == (tensile, shear)


@pytest.mark.parametrize("key", NUMBERS)
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1.0])
def test_numbers_out_of_range_are_refused_with_key_and_value_in_one_line(key, value):
    with pytest.raises(InputError, match=re.escape(f"{key} = {value}")) as caught:
        materials.load("augig-table7").with_set([f"{key}={value}"])
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", [key for key in NUMBERS if key != "friction"])
def test_zero_is_refused_except_for_friction(key):
    refusal(key, lambda: materials.load("augig-table7").with_set([f"{key}=0"]))
    assert materials.load("augig-table7").with_set(["friction=0"]).friction == 0.0


@pytest.mark.parametrize("value", ["0.5", "0.7"])
def test_poisson_must_stay_below_one_half(value):
    refusal(
        r"must be < 0\.5", lambda: materials.load("augig-table7").with_set([f"poisson={value}"])
    )


@pytest.mark.parametrize(
    ("assignment", "message"),
    [
        ("yuong=1e9", "did you mean young"),
        ("young", "must read KEY=VALUE"),
        ("young=", "must read KEY=VALUE"),
        ("young=soft", "must be a number"),
        ("plane=stres", "did you mean stress"),
        ("softening=linear", "known are bilinear, brittle"),
    ],
)
def test_bad_assignments(assignment, message):
    refusal(message, lambda: materials.load("augig-table7").with_set([assignment]))


def test_unknown_preset_names_the_nearest_and_all_known():
    with pytest.raises(InputError, match="did you mean augig-table7") as caught:
        materials.load("augig-tabel7")
    assert all(name in str(caught.value) for name in materials.preset_names())


def test_files_round_trip_and_bad_files_are_refused(tmp_path):
    file = tmp_path / "basalt.toml"
    file.write_text(
        "tensile_strength = 9e6\ncohesion = 3e7\nfriction = 0.6\n"
        "tensile_fracture_energy = 30\nshear_fracture_energy = 900\n"
        "[elastic.flexible]\nyoung = 60e9\npoisson = 0.25\n"
        "normal_stiffness = 2e14\nshear_ratio = 0.3\n"
    )
    material = materials.load(file)
    assert material.name == "basalt"
    assert material == materials.load(str(file))
    assert material.law("flexible")["young"] == 60e9
    refusal(r"no elastic set for model rigid.*\[elastic.rigid\]", material.law, "rigid")
    file.write_text("tensile_strength = = 3")
    refusal("not a valid TOML file", materials.load, file)
    refusal("cannot be read", materials.load, tmp_path / "missing.toml")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tensile_strength": True}, "must be a number"),
        ({"tensile_strength": "8e6"}, "must be a number"),
        ({"density": 10**400}, "must be finite"),
        ({"tensile_strenght": 1e6}, "did you mean tensile_strength"),
        ({"elastic": {}}, "has no set"),
        ({"elastic": 3}, "must be a table"),
        ({"elastic": {"rigid": 3}}, "must be a table"),
        ({"elastic": {"stiff": {"normal_stiffness": 1, "shear_ratio": 1}}}, "unknown"),
        ({"elastic": {"rigid": {"normal_stiffness": 1e13}}}, "shear_ratio is missing"),
        ({"elastic": {"rigid": {"normal_stifness": 1e13}}}, "did you mean normal_stiffness"),
        ({"elastic": {"rigid": {"normal_stiffness": -1, "shear_ratio": 1}}}, "must be > 0"),
    ],
)
def test_wrong_dictionaries(change, message):
    data = {
        "tensile_strength": 8e6,
        "cohesion": 3e7,
        "friction": 0.4,
        "softening": "brittle",
        "elastic": {"rigid": {"normal_stiffness": 1e13, "shear_ratio": 0.3}},
    }
    assert materials.load(data).law("rigid")["softening"] == "brittle"
    refusal(message, materials.load, data | change)


def test_all_missing_keys_are_named_at_once():
    with pytest.raises(InputError) as caught:
        materials.load({"tensile_strength": 8e6, "elastic": {"rigid": {"shear_ratio": 0.3}}})
    assert str(caught.value) == (
        "material cohesion, friction, tensile_fracture_energy, shear_fracture_energy, "
        "[elastic.rigid] normal_stiffness are missing; give them in [Pa], [-], [N/m], [N/m], [Pa/m]"
    )


@pytest.mark.parametrize("key", ["young", "poisson"])
def test_the_flexible_model_needs_its_triangles(key):
    elastic = {"young": 1e9, "poisson": 0.2, "normal_stiffness": 1e13, "shear_ratio": 0.3}
    del elastic[key]
    material = materials.load(
        {
            "tensile_strength": 8e6,
            "cohesion": 3e7,
            "friction": 0.4,
            "softening": "brittle",
            "elastic": {"flexible": elastic},
        }
    )
    refusal(f"{key} is missing", material.law, "flexible")


VALUES = {
    "young": 6e10,
    "poisson": 0.2,
    "plane": "strain",
    "softening": "brittle",
    "tensile_fracture_energy": 1e-3,  # below the elastic energy
    "shear_fracture_energy": 1e-3,
    "cohesion": 3.1e7,
}


@pytest.mark.parametrize("model", ["rigid", "inner", "inner-un", "jcfpm", "cohfrict"])
@pytest.mark.parametrize("key", VALUES)
def test_a_key_that_a_model_does_not_use_neither_refuses_nor_changes_it(model, key):
    rock = materials.load("augig-table7")
    if is_used(key, model):
        if VALUES[key] == 1e-3:
            with pytest.raises(InputError, match="must not be below the elastic energy"):
                rock.with_set({key: VALUES[key]}, model)
        else:
            assert rock.with_set({key: VALUES[key]}, model).law(model) != rock.law(model)
        return
    for name in (key, f"quartz.{key}"):
        with pytest.warns(UserWarning, match=f"set {name} has no effect, model {model} does not"):
            assert rock.with_set({name: VALUES[key]}, model) == rock


WEAK = {
    "tensile_strength": 8e6,
    "cohesion": 3e7,
    "friction": 0.4,
    "tensile_fracture_energy": 1e-3,
    "elastic": {"rigid": {"normal_stiffness": 1e13, "shear_ratio": 0.3}},
}


@pytest.mark.parametrize("model", ["jcfpm", "cohfrict"])
def test_strengths_of_yades_spheres_are_not_bounded_by_fracture_energies(model):
    strengths = ["tensile_strength=8e6", "cohesion=160e6", "friction=0.176"]
    rock = materials.load("augig-table2-bilinear")
    refusal("shear_fracture_energy", rock.with_set, strengths, "rigid")
    law = rock.with_set(strengths, model).law(model)
    assert (law["tensile_strength"], law["cohesion"], law["friction"]) == (8e6, 160e6, 0.176)
    # nor is a material refused whose file has such energies
    assert Material.from_dict({**WEAK, "shear_fracture_energy": 1e-3}).law(model)["cohesion"] == 3e7
