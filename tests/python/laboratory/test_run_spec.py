# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs of a run: they read back from JSON, and their key follows what the run computes."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

import flexpm
from flexpm import materials
from flexpm.dimensions import is_solid
from flexpm.errors import InputError
from flexpm.kinds.registry import kind_of
from flexpm.materials.keys import ELASTIC_SET, ENERGY_KEYS
from flexpm.materials.mixing import is_brittle
from flexpm.models.options import GRAIN_MODELS, MESHES, MODELS, POINTS, SPHERE_MODELS
from flexpm.models.sphere_laws import LAWS
from flexpm.results.measures import PEAK_DROP
from flexpm.runs import run_spec
from flexpm.runs.input_names import UNUSED, models_of, shape_of
from flexpm.runs.loading_rate import LARGEST_STOP_RATIO, LOADINGS
from flexpm.runs.run_spec import (
    ELASTIC,
    TESTS,
    RunSpec,
    described,
    split,
)
from flexpm.specimens.space.any_spec import SIZES
from flexpm.specimens.space.spec import SolidSpec
from flexpm.specimens.spec import SpecimenSpec

POSITIVE = st.floats(1e-6, 1e6)
CHECKSUMS = st.text("0123456789abcdef", min_size=16, max_size=16)


@st.composite
def specimens(draw, kind: str) -> SpecimenSpec:
    """Packed or given discs in an outline of a kind."""
    values = {name: draw(st.floats(0.01, 1.0)) for name in SIZES[kind]}
    values["thickness"] = draw(POSITIVE)
    values["short_edge"] = draw(st.floats(0.0, 0.4))
    if draw(st.booleans()):
        absent = dict.fromkeys(("diameters", "porosity", "seed"))
        values |= absent | {"discs": draw(CHECKSUMS), "outline": draw(CHECKSUMS)}
    else:
        smallest = draw(st.floats(1e-4, 2e-3))
        values["diameters"] = (smallest, smallest * draw(st.floats(1.0, 2.0)))
        values["porosity"] = draw(st.floats(0.0, 0.9))
        values["seed"] = draw(st.integers(0, 2**64 - 1))
    values["minerals"] = draw(st.none() | CHECKSUMS)
    return SpecimenSpec(kind, **values)


@st.composite
def solids(draw, kind: str) -> SolidSpec:
    """Packed or given spheres in a solid of a kind."""
    values = {name: draw(st.floats(0.01, 0.03)) for name in SIZES[kind]}  # memory bears its grains
    smallest = draw(st.floats(1e-3, 2e-3))
    values["diameters"] = (smallest, smallest * draw(st.floats(1.0, 2.0)))
    values["porosity"] = draw(st.floats(0.0, 0.9))
    values["seed"] = draw(st.integers(0, 2**64 - 1))
    return SolidSpec(kind, **values)


@st.composite
def specs(draw) -> RunSpec:
    """Any run that can be asked for."""
    test = draw(st.sampled_from((*TESTS, ELASTIC)))
    model = draw(st.sampled_from(models_of(test)))
    grains = model in GRAIN_MODELS
    loaded = test != "sonic"
    unused = UNUSED[test]
    takes_real = grains or not is_solid(shape_of(test))  # spheres of a solid have none
    dynamic = not loaded or (takes_real and "dynamic" not in unused and draw(st.booleans()))
    cohesion = draw(st.floats(1e7, 3e7))
    material = materials.load(None, model).with_set([f"cohesion={cohesion!r}"], model)
    starts = ["", "rest"]
    if model == "flexible" and test in ("uniaxial", "tension") and not dynamic:
        starts.append("static")
    adapts = grains and not dynamic and test != ELASTIC
    waits = adapts and not model.startswith("inner") and not is_brittle(described(material, model))
    loadings = [name for name in LOADINGS if waits or name != "waiting"] if adapts else ["constant"]
    shape = shape_of(test)
    solid = is_solid(shape)
    if solid:
        shape = draw(st.sampled_from(kind_of(test).solids))
    specimen = draw(solids(shape) if solid else specimens(shape))
    if test == "sonic":  # of 50 grains at least
        specimen = dataclasses.replace(specimen, height=draw(st.floats(0.2, 1.0)))
    own = {}
    if test == "punch":  # of ten grains at least
        specimen = dataclasses.replace(specimen, width=0.2, height=draw(st.floats(0.1, 1.0)))
        own = {"distance": draw(st.none() | st.floats(0.04, 0.16))}
    if shape == "box":
        own = {"second_confinement": draw(st.none() | st.floats(0.0, 1e9))}
    spheres = st.none() | st.floats(1.0, 2.0) if model in SPHERE_MODELS else st.none()
    return RunSpec(
        test,
        specimen,
        described(material, model),
        model,
        points=draw(st.sampled_from(POINTS)) if grains and not solid else 3,
        mesh=draw(st.sampled_from(MESHES)) if grains and not solid else "refined",
        confinement=draw(st.floats(0.0, 1e9)) if kind_of(test).confined else 0.0,
        rate=1.0 if "rate" in unused else draw(POSITIVE),
        max_strain=None if "max_strain" in unused else draw(st.none() | POSITIVE),
        stop_ratio=0.5 if "stop_ratio" in unused else draw(st.floats(0.01, LARGEST_STOP_RATIO)),
        dynamic=dynamic,
        gravity=draw(st.floats(0.0, 100.0)) if grains and dynamic and loaded else 0.0,
        start=draw(st.sampled_from(starts)),
        loading=draw(st.sampled_from(["", *loadings])),
        interaction_range=draw(spheres),
        own=own,
        damping=None if "damping" in unused else draw(st.none() | st.floats(0.0, 0.99)),
    )


PLAIN = {"name": "rock", "cohesion": 3e7}


def plain(test: str = "uniaxial", **changes: Any) -> RunSpec:
    kind = "disc" if test == "brazilian" else "rectangle"
    return RunSpec(test, SpecimenSpec(kind), PLAIN, **changes)


@given(specs())
def test_inputs_read_back_from_json_unchanged(spec):
    read = RunSpec.from_json(json.loads(json.dumps(spec.to_json())))
    assert read == spec
    assert (read.key(), read.to_json()) == (spec.key(), spec.to_json())


@dataclasses.dataclass(frozen=True)
class LaterSpecimen(SpecimenSpec):
    """Inputs of a later version, which has learnt to heat."""

    temperature: float = 20.0


@dataclasses.dataclass(frozen=True)
class LaterSolid(SolidSpec):
    """The same of a solid."""

    temperature: float = 20.0


@dataclasses.dataclass(frozen=True)
class LaterSpec(RunSpec):
    """Inputs of a later version, which has learnt to wet."""

    humidity: float = 0.3
    path: str | None = None


@given(specs())
def test_a_new_option_leaves_all_keys_as_they_are(spec):
    def fields(of: Any) -> dict[str, Any]:
        return {field.name: getattr(of, field.name) for field in dataclasses.fields(of)}

    later_type = LaterSolid if isinstance(spec.specimen, SolidSpec) else LaterSpecimen
    specimen = later_type(**fields(spec.specimen))
    later = LaterSpec(**fields(spec) | {"specimen": specimen})
    assert later.key() == spec.key()
    assert dataclasses.replace(later, humidity=0.4).key() != spec.key()
    warm = dataclasses.replace(specimen, temperature=80.0)
    assert dataclasses.replace(later, specimen=warm).key() != spec.key()
    # inputs that an earlier version has written have the new fields' defaults
    assert LaterSpec.from_json(spec.to_json()).key() == spec.key()


def test_a_new_property_of_materials_leaves_keys_as_they_are():
    spec = plain()
    later = dict(spec.material) | {"density": materials.Material.density, "dilation": None}
    assert dataclasses.replace(spec, material=later).key() == spec.key()
    heavier = dict(spec.material) | {"density": 2700.0}
    assert dataclasses.replace(spec, material=heavier).key() != spec.key()


def test_a_release_leaves_keys_as_they_are(monkeypatch):
    before = plain().key()
    monkeypatch.setattr(flexpm._version, "__version__", "17.0.0")
    assert plain().key() == before


def test_other_results_or_another_schema_change_keys(monkeypatch):
    spec = plain()
    before = spec.key()
    other = (spec.test, "rigid")
    monkeypatch.setitem(kind_of(other[0]).results, other[1], run_spec.results_number(*other) + 1)
    assert spec.key() == before
    monkeypatch.setitem(spec.kind.results, spec.model, spec.results + 1)
    assert spec.key() != before
    assert spec.older_keys()[-1] == before
    monkeypatch.undo()
    assert spec.key() == before
    monkeypatch.setattr(run_spec, "SCHEMA", run_spec.SCHEMA + 1)
    assert spec.key() != before


PACKED = SpecimenSpec()
GIVEN = {"diameters": None, "porosity": None, "seed": None, "discs": "0" * 16, "outline": "1" * 16}
#: Specimens with cells that were given, sawn or cut.
OTHERS = {
    "given cells": SpecimenSpec(**GIVEN, cells="2" * 16),
    "sawn": SpecimenSpec(outline="1" * 16),
    "cut": SpecimenSpec(joints="3" * 16, joint_names=("excavation:hole",)),
}


@pytest.mark.parametrize("specimen", [PACKED, SpecimenSpec(**GIVEN), *OTHERS.values()])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_results_of_cells_that_are_no_whole_laguerre_cells_are_others(specimen, model):
    """Keys of packings stay."""
    spec = RunSpec("tension", specimen, PLAIN, model)
    others = specimen in OTHERS.values()
    number = kind_of("tension").results[model]
    assert spec.results == number + others
    assert (spec.key(number) in spec.older_keys()) == others
    assert (spec.key() == spec.key(number)) != others


def test_results_of_inner_particles_are_the_same():
    number = kind_of("tension").results["inner"]
    for specimen in (PACKED, OTHERS["given cells"], OTHERS["sawn"]):
        assert RunSpec("tension", specimen, PLAIN, "inner").results == number


def test_results_of_tests_that_cut_notches_are_others():
    beam = SpecimenSpec(width=0.2, height=0.04)
    for test, shape in (("punch", SpecimenSpec()), ("bending", beam)):
        found = [RunSpec(test, shape, PLAIN, **split({"notch": one})) for one in (0.0, 0.01)]
        number = kind_of(test).results["flexible"]
        assert [one.results for one in found] == [number, number + 1]
    sawn = RunSpec("scb", SpecimenSpec("half-disc"), PLAIN)
    assert sawn.results == kind_of("scb").results["flexible"] + 1


def test_results_with_real_masses_are_others():
    assert plain(dynamic=True).results == plain().results + 1
    sawn = RunSpec("uniaxial", OTHERS["sawn"], PLAIN, dynamic=True)
    assert sawn.results == plain().results + 2
    assert plain("sonic").results == kind_of("sonic").results["flexible"]


def test_each_input_changes_the_key_but_a_name_does_not():
    changed = [
        plain("tension"),
        plain(model="rigid"),
        plain(points=2),
        plain(mesh="fan"),
        plain("biaxial"),
        plain("biaxial", confinement=1e6),
        plain(rate=2.0),
        plain(max_strain=0.01),
        plain(stop_ratio=0.8),
        plain(dynamic=True),
        plain(dynamic=True, gravity=9.81),
        plain(start="static"),
        plain(loading="constant"),
        *(
            dataclasses.replace(plain(), specimen=SpecimenSpec(**changes))
            for changes in (
                {"width": 0.04},
                {"height": 0.08},
                {"thickness": 0.04},
                {"diameters": (2e-3, 3e-3)},
                {"porosity": 0.2},
                {"seed": 2},
                {"short_edge": 0.0},
                {"minerals": "0123456789abcdef"},
            )
        ),
        dataclasses.replace(plain(), material={"name": "rock", "cohesion": 2e7}),
    ]
    keys = {spec.key() for spec in [plain(), *changed]}
    assert len(keys) == 1 + len(changed)
    renamed = dataclasses.replace(plain(), material={"name": "stone", "cohesion": 3e7})
    assert renamed.key() == plain().key()


def test_start_and_loading_follow_from_test_and_model():
    assert (plain("tension").start, plain("tension", dynamic=True).start) == ("static", "rest")
    assert (plain("uniaxial").start, plain("tension", model="rigid").start) == ("rest", "rest")
    loadings = {"flexible": "waiting", "rigid": "waiting", "inner": "adaptive", "jcfpm": "constant"}
    assert {model: plain(model=model).loading for model in loadings} == loadings
    assert plain("tension", start="static").key() == plain("tension").key()


def spec_of(material: str | materials.Material, model: str, **options: Any) -> RunSpec:
    law = described(materials.load(material, model), model)
    return RunSpec("tension", SpecimenSpec(), law, model, **options)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_loading_waits_for_cracks_brittle_or_not_unless_told_otherwise(model):
    for material in ("augig-table2-brittle", "augig-table2-bilinear"):
        waiting = spec_of(material, model)
        assert waiting.loading == waiting.to_json()["loading"] == "waiting"
        assert spec_of(material, model, loading="adaptive").loading == "adaptive"
        assert spec_of(material, model, dynamic=True).loading == "constant"


def test_inner_particles_are_loaded_adaptively_unless_contacts_are_brittle():
    assert spec_of("augig-table2-brittle", "inner").loading == "constant"
    assert spec_of("augig-table2-bilinear", "inner").loading == "adaptive"


@pytest.mark.parametrize("key", ["tensile_fracture_energy", "shear_fracture_energy"])
def test_an_energy_at_the_elastic_energy_is_brittle_whatever_it_is_called(key):
    rock = materials.load("augig-table2-bilinear")
    elastic = dict(zip(ENERGY_KEYS, rock.elastic_energies(), strict=True))[key]
    assert is_brittle(described(rock.with_set({key: elastic}), "flexible"))
    assert not is_brittle(described(rock.with_set({key: 1.01 * elastic}), "flexible"))


def test_one_brittle_mineral_makes_a_rock_brittle():
    kinds = [
        {"name": "quartz", "fraction": 0.5, "softening": "brittle"},
        {"name": "feldspar", "fraction": 0.5},
    ]
    rock = dataclasses.replace(materials.load("augig-table2-bilinear"), minerals=kinds)
    assert is_brittle(described(rock, "rigid"))


def test_the_key_of_a_run_is_that_of_its_loading_and_those_of_earlier_defaults_are_older():
    brittle = {
        loading: spec_of("augig-table2-brittle", "rigid", loading=loading)
        for loading in ("", "waiting", "constant", "adaptive")
    }
    assert brittle[""].key() == brittle["waiting"].key()
    older = brittle[""].older_keys()
    assert {brittle[name].key(1) for name in ("waiting", "constant", "adaptive")} <= {*older}
    assert brittle[""].key() not in older
    numbers = range(1, brittle[""].results)
    assert brittle["constant"].older_keys() == [brittle["constant"].key(n) for n in numbers]
    soft = {
        loading: spec_of("augig-table2-bilinear", "rigid", loading=loading)
        for loading in ("", "constant", "adaptive")
    }
    assert soft["adaptive"].key(1) in soft[""].older_keys()
    assert soft["constant"].key(1) not in soft[""].older_keys()
    inner = spec_of("augig-table2-brittle", "inner")
    adaptive = spec_of("augig-table2-brittle", "inner", loading="adaptive")
    assert inner.older_keys() == [
        *(adaptive.key(number) for number in range(1, inner.results + 1)),
        *(inner.key(number) for number in range(1, inner.results)),
    ]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"test": "torsion"}, "test = 'torsion', must be one of uniaxial, "),
        ({"model": "soft"}, "model = 'soft', must be one of"),
        ({"test": ELASTIC, "model": "jcfpm"}, "model = 'jcfpm', must be one of flexible"),
        ({"points": 4}, "points = 4, must be one of 1, 2, 3"),
        ({"model": "jcfpm", "mesh": "fan"}, "mesh of model jcfpm = 'fan'"),
        ({"rate": 0.0}, "rate = 0.0, must be > 0"),
        ({"rate": "fast"}, "rate = 'fast', must be a number"),
        ({"max_strain": float("nan")}, "max_strain = nan, must be finite"),
        ({"stop_ratio": 0.95}, "stop_ratio = 0.95, must be <= 0.9"),
        ({"confinement": -1.0}, "confinement = -1.0 Pa, must be >= 0"),
        ({"confinement": 1e6}, "must be 0 for uniaxial; use biaxial"),
        ({"gravity": 9.81}, "must be 0 with scaled masses; use dynamic"),
        ({"start": "moving"}, "start = 'moving', must be one of rest, static"),
        ({"start": "static", "model": "rigid"}, "start = static, must be rest"),
        ({"loading": "fast"}, "loading = 'fast', must be one of constant, adaptive, waiting"),
        ({"loading": "adaptive", "dynamic": True}, "must be constant for model flexible with real"),
        ({"test": "shear", "max_strain": 1e-9}, "max_strain = 1e-09, must not be given for shear"),
        ({"test": "shear", "stop_ratio": 0.3}, "stop_ratio = 0.3, must not be given for shear"),
        ({"test": ELASTIC, "rate": 2.0}, "rate = 2.0, must not be given for elastic"),
        ({"test": ELASTIC, "dynamic": True}, "dynamic = True, must not be given for elastic"),
        ({"span": 0.1}, "span = 0.1 m, must not be given for uniaxial"),
        ({"wave": "p"}, "wave = p, must not be given for uniaxial"),
    ],
)
def test_inputs_out_of_range_are_refused_in_one_line(changes, message):
    changes = dict(changes)
    refusal(message, plain, changes.pop("test", "uniaxial"), **changes)


def test_a_test_wants_its_shape():
    with pytest.raises(InputError, match="specimen = disc, must be a rectangle for uniaxial"):
        RunSpec("uniaxial", SpecimenSpec("disc"), {})
    refusal(r"width = 0.1 m, must not be given for a disc", SpecimenSpec, "disc", width=0.1)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({}, "inputs test is missing"),
        ({"test": "uniaxial", "specimen": {}, "material": {}, "pace": "slow"}, "inputs = 'pace'"),
        ({"test": "uniaxial", "specimen": {"with": 1}, "material": {}}, "did you mean width"),
        ({"test": "uniaxial", "specimen": 3, "material": {}}, "must be a table; give result.json"),
    ],
)
def test_json_that_is_no_run_is_refused_in_one_line(content, message):
    refusal(message, RunSpec.from_json, content)


def test_names_of_the_models_are_those_of_their_laws_and_elastic_sets():
    assert tuple(LAWS) == SPHERE_MODELS
    assert set(MODELS) == set(ELASTIC_SET)


def test_the_stress_may_fall_as_far_as_a_peak_needs():
    assert LARGEST_STOP_RATIO == 1.0 - PEAK_DROP


@pytest.mark.parametrize("test", TESTS)
def test_each_test_has_sizes_of_its_solids_that_it_takes(test):
    for shape in kind_of(test).solids:
        asked = RunSpec.packed(test, {"shape": shape})
        assert asked.kind == shape
        material = described(materials.load(None, "rigid"), "rigid")
        RunSpec(test, asked, material, "rigid")
        assert asked.volume < 1.3 * SolidSpec(shape).volume
    if not is_solid(kind_of(test).shape):
        usual = RunSpec.packed(test, {}).sizes
        assert usual | kind_of(test).sizes == usual
