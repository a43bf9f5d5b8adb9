# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of pairs of minerals: what is taken, what is refused, and in which order it counts."""

import copy
import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from scenes import fresh
from yade import wrapper

import flexpm
from flexpm.errors import InputError
from flexpm.materials import mixing
from flexpm.materials.interface import FACTOR_KEYS
from flexpm.materials.material import Material
from flexpm.materials.mineral import Mineral
from flexpm.report import maps
from flexpm.results import doubts
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.specimen import Specimen
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
PAIR = ["quartz", "biotite"]
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
    changed |= {"shear_fracture_energy": 200.0, "tensile_fracture_energy": 80.0}
    assert law(weak, "quartz", "quartz") == law(plain, "quartz", "quartz") | changed
    assert law(weak, "biotite", "biotite") == law(plain, "biotite", "biotite")


STRENGTHS = {"tensile_strength": "tensile_fracture_energy", "cohesion": "shear_fracture_energy"}


@given(st.sampled_from([*STRENGTHS]), st.floats(1e-4, 1e4), st.sampled_from(["flexible", "rigid"]))
def test_a_factor_of_a_strength_takes_its_square_of_the_energy(key, factor, model):
    """The softening length 2 G / strength changes by the factor, and brittleness stays."""
    plain = law(rock(), "quartz", "biotite", model)
    weak = law(rock({"pair": PAIR, "factor": {key: factor}}), "quartz", "biotite", model)
    energy = STRENGTHS[key]
    length = [2.0 * one[energy] / one[key] for one in (plain, weak)]
    assert length[1] == pytest.approx(factor * length[0], rel=1e-12)
    brittleness = [one[key] ** 2 / one[energy] for one in (plain, weak)]
    assert brittleness[1] == pytest.approx(brittleness[0], rel=1e-12)
    other = {name: value for name, value in plain.items() if name not in (key, energy)}
    assert other.items() <= weak.items()


@pytest.mark.parametrize("key", [*STRENGTHS])
def test_an_energy_that_is_given_does_not_follow_the_strength(key):
    energy = STRENGTHS[key]
    kept = rock({"pair": PAIR, "factor": {key: 0.3, energy: 1.0}})
    given_ = rock({"pair": PAIR, energy: 700.0, "factor": {key: 0.3}})
    plain = law(rock(), "quartz", "biotite")
    assert law(kept, "quartz", "biotite") == plain | {key: 0.3 * plain[key]}
    assert law(given_, "quartz", "biotite") == plain | {key: 0.3 * plain[key], energy: 700.0}
    absolute = rock({"pair": PAIR, key: 0.3 * plain[key]})
    assert law(absolute, "quartz", "biotite") == law(kept, "quartz", "biotite")


def test_a_factor_of_a_strength_leaves_brittle_contacts_brittle():
    pair = {"pair": ["quartz", "k-feldspar"], "factor": {"cohesion": 0.5, "tensile_strength": 2.0}}
    found = law(rock(pair), "quartz", "k-feldspar")
    assert found["shear_fracture_energy"] == pytest.approx(15e6**2 / (2 * 0.28 * 1.8e14))
    brittle = rock({"pair": PAIR, "softening": "brittle", "factor": {"cohesion": 0.5}})
    assert law(brittle, "quartz", "biotite")["softening"] == "brittle"


def softening_warnings(material):
    return doubts.of_softening(described(material, "flexible"))


@pytest.mark.parametrize("key", [*STRENGTHS])
def test_an_absolute_strength_that_makes_softening_long_is_told(key):
    """Lengths 2 G / strength against those of the mixing rule, 4.7 um and 64 um."""
    usual = law(rock(), "quartz", "biotite")
    length = 2.0 * usual[STRENGTHS[key]] / usual[key]
    assert softening_warnings(rock({"pair": PAIR, key: 0.51 * usual[key]})) == []
    (line,) = softening_warnings(rock({"pair": PAIR, key: 0.4 * usual[key]}))
    assert line.startswith(f"interface biotite/quartz: softening length 2 G / {key} = ")
    assert f" = {2.5e6 * length:.3g} um, is" in line
    assert "is 2.5 times the usual length (limit 2)" in line and STRENGTHS[key] in line
    # factors lower the energy, too, and an energy that is given is meant
    assert softening_warnings(rock({"pair": PAIR, "factor": {key: 0.1}})) == []
    both = {key: 0.1 * usual[key], STRENGTHS[key]: 0.9 * usual[STRENGTHS[key]]}
    assert softening_warnings(rock({"pair": PAIR, **both})) == []


def test_a_mineral_with_a_lower_strength_than_its_rock_is_told():
    kinds = [*ROCK["mineral"][:1], {"name": "mica", "fraction": 0.5, "tensile_strength": 2e6}]
    (line,) = softening_warnings(Material.from_dict(copy.deepcopy(ROCK) | {"mineral": kinds}))
    length = "softening length 2 G / tensile_strength = 20 um, is 4.25 times"
    assert line.startswith(f"mineral mica: {length}")


def test_the_key_of_a_run_holds_the_energies_in_effect():
    """A finished run with other energies is no run of this material."""
    found = []
    for factors in ({}, {"shear_fracture_energy": 1.0}, {"shear_fracture_energy": 0.25}):
        material = rock({"pair": PAIR, "factor": {"cohesion": 0.5, **factors}})
        spec = RunSpec.from_options("uniaxial", {}, material)
        found.append(spec.key())
    assert found[0] == found[2] != found[1]


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
        ([{"pair": ["quartz", "biotite"]}, {"pair": ["biotite", "quartz"]}], "is given twice"),
        ([{"pair": ["quartz", "biotite"], "cohesio": 1e6}], "cohesio.*did you mean.*cohesion"),
        ([{"pair": ["quartz", "biotite"], "young": 1e9}], "young"),
        ([{"pair": ["quartz", "biotite"], "cohesion": -1.0}], "interface quartz/biotite cohesion"),
        (
            [{"pair": ["quartz", "biotite"], "cohesion": 1e6, "factor": {"cohesion": 0.5}}],
            "must not be given with factor",
        ),
        ([{"pair": ["quartz", "biotite"], "factor": {"cohesion": 0.0}}], "factor.cohesion = 0"),
        ([{"pair": ["quartz", "biotite"], "factor": {"softening": 2.0}}], "factor.softening"),
        ([{"pair": ["quartz", "biotite"], "factor": 0.5}], "factor"),
        ("quartz", "must be tables"),
    ],
)
def test_wrong_interfaces_are_refused_in_one_line(interfaces, words):
    refusal(words, Material.from_dict, {**copy.deepcopy(ROCK), "interface": interfaces})


@pytest.mark.parametrize(
    ("interface", "words"),
    [
        (
            {"factor": {"cohesion": 20.0, "shear_fracture_energy": 1.0}},
            "shear_fracture_energy.*must not be below",
        ),
        ({"tensile_strength": 90e6}, "tensile_fracture_energy.*must not be below"),
    ],
)
def test_the_whole_law_of_a_pair_is_checked(interface, words):
    wrong = rock({"pair": ["quartz", "biotite"], **interface})
    refusal(f"contact quartz-biotite: .*{words}", described, wrong, "flexible")


def test_a_factor_of_an_energy_that_brittle_softening_fixes_is_refused():
    wrong = rock({"pair": ["quartz", "k-feldspar"], "factor": {"tensile_fracture_energy": 2.0}})
    refusal("nothing to multiply, as the softening is brittle", described, wrong, "flexible")


def test_interfaces_without_minerals_are_refused():
    plain = {key: value for key, value in ROCK.items() if key != "mineral"}
    with pytest.raises(InputError, match="the material has no minerals"):
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
        refusal(r"mica|young", rock().with_set, {label: 1e6})
    refusal("must be a number", lambda: rock().with_set(["interface.quartz/biotite.cohesion=much"]))


def named(*names):
    minerals = [{"name": name, "fraction": 1.0 / len(names)} for name in names]
    return Material.from_dict({**copy.deepcopy(ROCK), "mineral": minerals}, "rock")


def test_a_key_that_names_two_pairs_is_refused():
    rock = named("a", "b/c", "a/b", "c")
    with pytest.raises(InputError, match="'a/b/c' is a with b/c or a/b with c; give the pair"):
        rock.with_set({"interface.a/b/c.cohesion": 1e6})
    found = rock.with_set({"interface.c/b/c.cohesion": 20e6, "interface.a/b/a/b.cohesion": 21e6})
    assert [one.pair for one in found.interfaces] == [("b/c", "c"), ("a/b", "a/b")]
    alone = named("a", "b/c").with_set({"interface.a/b/c.cohesion": 20e6})
    assert [one.pair for one in alone.interfaces] == [("a", "b/c")]


@pytest.mark.parametrize("name", ["", " ", "\t", "quartz ", " quartz", "qu\nartz", "qu\x1bartz"])
def test_a_mineral_has_a_name_that_can_be_read_and_typed(name):
    refusal("must be a name of printable characters without blanks", named, name, "feldspar")
    refusal("must be a name of printable characters without blanks", Mineral, name, 1.0, {})


def test_a_study_takes_keys_of_pairs(tmp_path):
    file = tmp_path / "rock.toml"
    minerals = "".join(
        f"[[mineral]]\nname = '{name}'\nfraction = 0.5\n" for name in ("quartz", "k-mica")
    )
    flat = "\n".join(
        f"{key} = {value}" for key, value in ROCK.items() if not isinstance(value, (dict, list))
    )
    sets = "\n".join(
        f"[elastic.{name}]\n" + "\n".join(f"{key} = {value}" for key, value in own.items())
        for name, own in ROCK["elastic"].items()
    )
    file.write_text(f"{flat}\n{sets}\n{minerals}")
    for first, second in (("k-mica", "quartz"), ("quartz", "k-mica")):
        key = f"set.interface.{first}/{second}.tensile-strength"
        job = jobs.make({"test": "tension", "material": "rock.toml", key: 8e6}, tmp_path)
        assert job.spec.material["interfaces"][0]["tensile_strength"] == 8e6


@given(
    st.dictionaries(
        st.sampled_from(FACTOR_KEYS),
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


def test_the_present_value_of_a_key_is_what_a_calibration_starts_from():
    weak = rock({"pair": ["quartz", "biotite"], "cohesion": 20e6, "factor": {"friction": 0.5}})
    value = {
        key: mixing.value_of(weak, f"interface.{key}", "flexible")
        for key in (
            "biotite/quartz.cohesion",
            "quartz/biotite.factor.friction",
            "quartz/biotite.factor.tensile_strength",
            "biotite/quartz.factor.shear_fracture_energy",
            "quartz/quartz.cohesion",
        )
    }
    assert [*value.values()] == [20e6, 0.5, 1.0, 1.0, 30e6]
    assert mixing.value_of(weak, "cohesion", "flexible") == 30e6
    implied = weak.with_set({"interface.biotite/quartz.factor.cohesion": 0.5})
    label = "interface.biotite/quartz.factor.shear_fracture_energy"
    assert mixing.value_of(implied, label, "flexible") == 0.25
    refusal(r"mica", mixing.value_of, weak, "interface.quartz/mica.cohesion", "flexible")


def test_strengths_of_contacts_multiply_last():
    """Factors of the contacts change a pair's strengths and energies as they change a rock's."""
    specimen = Specimen.rectangle(0.012, 0.016, 0.01, seed=3)
    specimen = specimen.with_minerals([number % 3 for number in range(len(specimen.discs))])
    pair = {"pair": ["quartz", "biotite"], "cohesion": 20e6, "tensile_strength": 6e6}
    factor = 0.5
    kept = ("tensile_fracture_energy", "shear_fracture_energy", "tensile_strength", "cohesion")
    powers = {key: 2 if "energy" in key else 1 for key in kept}
    halved = copy.deepcopy(ROCK) | {key: ROCK[key] * factor ** powers[key] for key in kept}
    halved["mineral"][1]["cohesion"] *= factor
    energies = {key: halved[key] for key in kept[:2]}
    halved["interface"] = [{**pair, **energies, "cohesion": 10e6, "tensile_strength": 3e6}]
    contacts = len(specimen.tessellation.shared_edges)
    weakened = specimen.with_strengths([factor] * contacts)
    damage = [
        pulled(one, material).solver.energies()["damage_energy"]
        for one, material in (
            (weakened, rock(pair)),
            (specimen, Material.from_dict(halved)),
            (weakened, rock()),
        )
    ]
    assert damage[0] > 0.0 and damage[0] == pytest.approx(damage[1], rel=1e-9)
    assert damage[0] != pytest.approx(damage[2], rel=1e-3)


def test_joints_keep_their_own_law():
    """The one contact of two pieces of a grain is the joint's, whatever its pair has."""
    whole = Specimen.from_polygons([[(0, 0), (0.01, 0), (0.01, 0.01), (0, 0.01)]], 0.01)
    cut = whole.with_minerals([0]).with_joints({"weak": [(-0.001, 0.005), (0.011, 0.005)]})
    joint = {f"joint.weak.{key}": value for key, value in JOINT.items()}
    weak = {"pair": ["quartz", "quartz"], "cohesion": 1e6, "tensile_strength": 1e5}
    tractions = []
    for own in ((), [weak]):
        built = pulled(cut, rock(*own).with_set(joint), steps=1500)
        tractions.append(built.snapshot().point_traction)
        assert built.solver.energies()["damage_energy"] > 0.0
    assert np.array_equal(*tractions)


JOINT = {
    "normal_stiffness": 1e14,
    "shear_stiffness": 3e13,
    "friction": 0.3,
    "cohesion": 2e6,
    "tensile_strength": 1e6,
    "tensile_fracture_energy": 5.0,
    "shear_fracture_energy": 50.0,
}


def pulled(specimen, material, steps=3000):
    """A specimen whose top is driven until points have softened."""
    built = fresh(specimen, material)
    built.add_engines(before=(wrapper.EndDisplacementController(velocity=2e-9),))
    built.run(steps)
    return built


def test_a_picture_has_a_legend_of_the_cracks_of_each_pair(tmp_path, monkeypatch):
    specimen = Specimen.rectangle(0.012, 0.016, 0.01, seed=3)
    shown = []
    save = maps.save
    monkeypatch.setattr(
        maps, "save", lambda figure, path: (shown.append(figure), save(figure, path))
    )
    result = flexpm.run("tension", specimen, rock(), rate=2.0, out=tmp_path, report=False)
    texts = [text.get_text() for text in shown[0].axes[0].get_legend().get_texts()]
    assert result.cracks_by_pair
    for pair, counts in result.cracks_by_pair.items():
        assert f"{pair}: {counts['tensile']} tensile, {counts['shear']} shear" in texts
        assert sum(counts.values()) <= result.softened_by_pair[pair]
    damaged = result.snapshot.point_damage > 0.0
    assert sum(result.softened_by_pair.values()) == np.count_nonzero(damaged)
    assert flexpm.Result.read(tmp_path).softened_by_pair == result.softened_by_pair
    assert {"quartz", "biotite", "k-feldspar"} <= set(texts)


@pytest.mark.parametrize("name", ["joint.fault", "interface.a/b"])
def test_minerals_are_not_called_as_keys_of_joints_and_interfaces(name):
    """Else ``--set joint.fault.friction=1`` made a joint in place of a change of the mineral."""
    kinds = [{"name": name, "fraction": 1.0}]
    with pytest.raises(InputError, match=rf"mineral = '{name}', must not begin with joint. or"):
        Material.from_dict({**ROCK, "mineral": kinds})
