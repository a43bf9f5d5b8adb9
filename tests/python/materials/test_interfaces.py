# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of pairs of minerals: what is taken, what is refused, and in which order it counts."""

import copy
import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from flexpm.errors import InputError
from flexpm.materials import mixing
from flexpm.materials.interface import KEYS
from flexpm.materials.material import Material
from flexpm.runs.run_spec import described
from flexpm.studies import jobs

ROCK = {
    "tensile_strength": 8.5e6,
    "cohesion": 30e6,
    "friction": 0.4,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 800.0,
    "elastic": {
        "flexible": {
            "young": 50e9,
            "poisson": 0.2,
            "normal_stiffness": 1.8e14,
            "shear_ratio": 0.28,
        },
        "rigid": {"normal_stiffness": 5e13, "shear_ratio": 0.3},
    },
    "mineral": [
        {"name": "quartz", "fraction": 0.5},
        {"name": "biotite", "fraction": 0.3, "cohesion": 25e6},
        {"name": "k-feldspar", "fraction": 0.2, "softening": "brittle"},
    ],
}
PAIRS = {"quartz": 0, "biotite": 1, "k-feldspar": 2}


def rock(*interfaces):
    return Material.from_dict({**copy.deepcopy(ROCK), "interface": list(interfaces)}, "rock")


def law(material, first, second, model="flexible"):
    row = PAIRS[first] * len(PAIRS) + PAIRS[second]
    return mixing.pair_materials(material, model)[row].law(model)


def test_a_value_counts_before_the_minerals_and_a_factor_multiplies_what_mixing_gives():
    weak = rock(
        {"pair": ["quartz", "biotite"], "cohesion": 20e6, "factor": {"normal_stiffness": 0.5}},
        {"pair": ["quartz", "quartz"], "factor": {"cohesion": 0.5, "tensile_strength": 2.0}},
    )
    plain = rock()
    for first, second in (("quartz", "biotite"), ("biotite", "quartz")):
        changed = {"cohesion": 20e6, "normal_stiffness": 0.9e14}
        assert law(weak, first, second) == law(plain, first, second) | changed
    assert law(weak, "biotite", "quartz", "rigid")["normal_stiffness"] == 2.5e13
    changed = {"cohesion": 15e6, "tensile_strength": 17e6}
    assert law(weak, "quartz", "quartz") == law(plain, "quartz", "quartz") | changed
    assert law(weak, "biotite", "biotite") == law(plain, "biotite", "biotite")


def test_softening_of_a_pair_is_its_own():
    tough = rock(
        {
            "pair": ["k-feldspar", "quartz"],
            "softening": "bilinear",
            "tensile_fracture_energy": 30.0,
            "shear_fracture_energy": 900.0,
        }
    )
    assert law(rock(), "quartz", "k-feldspar")["softening"] == "brittle"
    assert law(tough, "quartz", "k-feldspar")["tensile_fracture_energy"] == 30.0
    brittle = rock({"pair": ["quartz", "quartz"], "softening": "brittle"})
    tensile, _ = (8.5e6**2 / (2 * 1.8e14), 0.0)
    assert law(brittle, "quartz", "quartz")["tensile_fracture_energy"] == pytest.approx(tensile)
    kinds = {**ROCK, "mineral": ROCK["mineral"][:1] + [{"name": "biotite", "fraction": 0.5}]}
    kinds["interface"] = [{"pair": ["quartz", "quartz"], "softening": "brittle"}]
    assert mixing.is_brittle(described(Material.from_dict(kinds), "flexible"))


@pytest.mark.parametrize(
    ("interfaces", "words"),
    [
        ([{"cohesion": 1e6}], r"\[\[interface\]\] 1 pair is missing"),
        ([{"pair": ["quartz"]}], "must be the names of two minerals"),
        ([{"pair": ["quartz", 3]}], "must be the names of two minerals"),
        ([{"pair": ["quartz", "biotit"]}], "biotit.*did you mean.*biotite"),
        ([{"pair": ["quartz", "biotite"]}, {"pair": ["biotite", "quartz"]}], "is there twice"),
        ([{"pair": ["quartz", "biotite"], "cohesio": 1e6}], "cohesio.*did you mean.*cohesion"),
        ([{"pair": ["quartz", "biotite"], "young": 1e9}], "young"),
        ([{"pair": ["quartz", "biotite"], "cohesion": -1.0}], "interface quartz/biotite cohesion"),
        (
            [{"pair": ["quartz", "biotite"], "cohesion": 1e6, "factor": {"cohesion": 0.5}}],
            "must not be given beside",
        ),
        ([{"pair": ["quartz", "biotite"], "factor": {"cohesion": 0.0}}], "factor.cohesion = 0"),
        ([{"pair": ["quartz", "biotite"], "factor": {"softening": 2.0}}], "factor.softening"),
        ([{"pair": ["quartz", "biotite"], "factor": 0.5}], "factor"),
        ("quartz", "must be tables"),
    ],
)
def test_wrong_interfaces_are_refused_in_one_line(interfaces, words):
    with pytest.raises(InputError, match=words) as error:
        Material.from_dict({**copy.deepcopy(ROCK), "interface": interfaces})
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("interface", "words"),
    [
        ({"factor": {"cohesion": 20.0}}, "shear_fracture_energy.*must not be below"),
        ({"tensile_strength": 90e6}, "tensile_fracture_energy.*must not be below"),
    ],
)
def test_the_whole_law_of_a_pair_is_checked(interface, words):
    wrong = rock({"pair": ["quartz", "biotite"], **interface})
    with pytest.raises(InputError, match=f"contact quartz-biotite: .*{words}"):
        described(wrong, "flexible")


def test_a_factor_of_an_energy_that_brittle_softening_fixes_is_refused():
    wrong = rock({"pair": ["quartz", "k-feldspar"], "factor": {"tensile_fracture_energy": 2.0}})
    with pytest.raises(InputError, match="nothing to multiply, as the softening is brittle"):
        described(wrong, "flexible")


def test_interfaces_without_minerals_are_refused():
    plain = {key: value for key, value in ROCK.items() if key != "mineral"}
    with pytest.raises(InputError, match="needs a material with"):
        Material.from_dict({**plain, "interface": [{"pair": ["a", "b"], "cohesion": 1e6}]})


def test_options_change_pairs_in_any_order_and_studies_take_them():
    set_by = rock().with_set(
        ["interface.quartz/k-feldspar.cohesion=20e6", "interface.biotite/quartz.factor.friction=2"]
    )
    assert law(set_by, "k-feldspar", "quartz")["cohesion"] == 20e6
    assert law(set_by, "quartz", "biotite")["friction"] == 0.8
    again = set_by.with_set({"interface.k-feldspar/quartz.factor.cohesion": 0.5})
    assert law(again, "k-feldspar", "quartz")["cohesion"] == 15e6
    for label in ("interface.quartz/mica.cohesion", "interface.quartz/biotite.young"):
        with pytest.raises(InputError, match=r"mica|young"):
            rock().with_set({label: 1e6})
    with pytest.raises(InputError, match="must be a number"):
        rock().with_set(["interface.quartz/biotite.cohesion=much"])


def test_a_study_takes_keys_of_pairs(tmp_path):
    file = tmp_path / "rock.toml"
    minerals = "".join(
        f"[[mineral]]\nname = '{name}'\nfraction = 0.5\n" for name in ("quartz", "mica")
    )
    flat = "\n".join(
        f"{key} = {value}" for key, value in ROCK.items() if not isinstance(value, (dict, list))
    )
    sets = "\n".join(
        f"[elastic.{name}]\n" + "\n".join(f"{key} = {value}" for key, value in own.items())
        for name, own in ROCK["elastic"].items()
    )
    file.write_text(f"{flat}\n{sets}\n{minerals}")
    key = "set.interface.mica/quartz.cohesion"
    job = jobs.make({"test": "tension", "material": "rock.toml", key: 21e6}, tmp_path)
    assert job.spec.material["interfaces"][0]["cohesion"] == 21e6


@given(
    st.dictionaries(
        st.sampled_from([key for key in KEYS if key != "softening"]),
        st.floats(0.9, 1.1),
        max_size=4,
    ),
    st.sampled_from(["flexible", "rigid"]),
)
def test_a_description_gives_the_same_laws_back(factors, model):
    energies = {"tensile_fracture_energy": 2.0, "shear_fracture_energy": 2.0}
    one = rock({"pair": ["biotite", "quartz"], "factor": {**energies, **factors}})
    found = described(one, model)
    again = mixing.from_description(found, model)
    assert described(again, model) == found
    laws = [[pair.law(model) for pair in mixing.pair_materials(of, model)] for of in (one, again)]
    assert laws[0] == laws[1]


def test_a_rock_without_pairs_has_the_description_of_before():
    assert "interfaces" not in described(rock(), "flexible")
    assert described(rock(), "flexible") == described(
        dataclasses.replace(rock({"pair": ["quartz", "biotite"]}), interfaces=()), "flexible"
    )
