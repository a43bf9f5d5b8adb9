# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of several minerals: composites in closed form, draws by area, mixed contacts."""

import dataclasses
import math

import numpy as np
import pytest
import yade
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from step_clock import step_clock

import flexpm
from flexpm.materials import mixing as minerals
from flexpm.materials.interface import FACTOR_KEYS, Interface
from flexpm.materials.material import Material, load
from flexpm.rigs.part_rig import PartRig
from flexpm.specimens import mineral_map

SIZE = 2e-3  # of square grains [m]
COLUMNS, ROWS = 4, 6
SOFT, HARD = 20e9, 80e9  # [Pa]
K_SOFT, K_HARD = 5e13, 2e14  # [Pa/m]
BASE = {
    "tensile_strength": 8.5e6,
    "cohesion": 30e6,
    "friction": 0.4,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 800.0,
    "elastic": {
        # no Poisson's ratio to speak of: series and parallel are then exact
        "flexible": {
            "young": SOFT,
            "poisson": 1e-12,
            "normal_stiffness": K_SOFT,
            "shear_ratio": 0.3,
        },
        "rigid": {"normal_stiffness": K_SOFT, "shear_ratio": 0.3},
    },
}
HARDER = {
    "flexible": {"young": HARD, "normal_stiffness": K_HARD},
    "rigid": {"normal_stiffness": K_HARD},
}


def rock(**changes):
    """Half of the area soft, half of it hard."""
    kinds = [
        {"name": "soft", "fraction": 0.5},
        {"name": "hard", "fraction": 0.5, "elastic": HARDER, **changes},
    ]
    return Material.from_dict({**BASE, "mineral": kinds}, "rock")


def grid(columns=COLUMNS, rows=ROWS):
    """Square grains of equal discs."""
    x, y = (SIZE * (np.arange(n) + 0.5) for n in (columns, rows))
    centres = np.array([(a, b) for b in y for a in x])
    width, height = columns * SIZE, rows * SIZE
    outline = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    radii = np.full(len(centres), 0.5 * SIZE)
    return flexpm.Specimen.from_discs(centres, radii, outline, 0.01, short_edge=0.0)


def modulus(specimen, model):
    return flexpm.elastic(specimen, rock(), model)["youngs_modulus"]


def test_layers_across_the_load_have_the_modulus_of_all_parts_in_series():
    """Reuss: compliances of grains and contacts add up; a mixed contact is two halves in series."""
    specimen = grid().with_minerals(np.repeat(np.arange(ROWS) % 2, COLUMNS))
    grains = 0.5 * ROWS * SIZE * (1.0 / SOFT + 1.0 / HARD)
    mixed = 0.5 * (1.0 / K_SOFT + 1.0 / K_HARD)
    expected = ROWS * SIZE / (grains + (ROWS - 1) * mixed)
    assert modulus(specimen, "flexible") == pytest.approx(expected, rel=1e-6)
    # strains of rigid grains are those of their centres: a contact for each grain
    assert modulus(specimen, "rigid") == pytest.approx(SIZE / mixed, rel=1e-6)


def test_columns_along_the_load_have_the_mean_modulus():
    """Voigt: columns of one mineral carry side by side."""
    specimen = grid().with_minerals(np.tile(np.arange(COLUMNS) % 2, ROWS))
    height = ROWS * SIZE
    columns = [
        height / (height / young + (ROWS - 1) / stiffness)
        for young, stiffness in ((SOFT, K_SOFT), (HARD, K_HARD))
    ]
    # not so with rigid grains: the compliance of their plates loads the columns unevenly
    assert modulus(specimen, "flexible") == pytest.approx(np.mean(columns), rel=1e-6)


def test_equal_minerals_are_the_homogeneous_rock_to_the_same_bits():
    specimen = flexpm.Specimen.rectangle(0.016, 0.03, 0.01, seed=2)
    for model in ("flexible", "rigid"):
        # whose shear ratio a series of two equal halves would not give back to the bit
        changes = ["normal_stiffness=4.9e13", "shear_ratio=0.29"]
        plain = load("augig-table7").with_set(changes, model)
        kinds = [{"name": name, "fraction": 1.0 / 3.0} for name in ("a", "b", "c")]
        equal = dataclasses.replace(plain, minerals=kinds)
        one, several = (
            flexpm.run("uniaxial", specimen, rock, model, rate=2.0, stop_ratio=0.8)
            for rock in (plain, equal)
        )
        assert one.tensile_cracks > 0
        assert np.array_equal(one.curve.array, several.curve.array, equal_nan=True)
        assert np.array_equal(one.snapshot.positions, several.snapshot.positions)
        assert set(several.snapshot.grain_mineral) == {0, 1, 2}


@given(
    weights=st.lists(st.floats(0.05, 1.0), min_size=1, max_size=5),
    grains=st.integers(1, 400),
    seed=st.integers(0, 2**64 - 1),
)
def test_fractions_are_met_to_half_a_grain_at_each_end(weights, grains, seed):
    areas = np.random.default_rng(grains).uniform(1.0, 4.0, grains)
    fractions = np.array(weights) / sum(weights)
    found = mineral_map.assign(fractions, areas, seed)
    shares = np.bincount(found, weights=areas, minlength=len(weights))
    ends = np.cumsum(shares) - np.cumsum(fractions) * areas.sum()
    assert np.all(np.abs(ends) <= 0.5 * areas.max() + 1e-9)
    assert np.array_equal(found, mineral_map.assign(fractions, areas, seed))


def test_minerals_are_drawn_by_the_seed_and_lie_scattered():
    specimen = grid(40, 40)
    areas = specimen.tessellation.cell_areas
    one, other = (mineral_map.assign([0.5, 0.5], areas, seed) for seed in (1, 2))
    assert not np.array_equal(one, other)
    # half of the neighbours drawn independently are alike; five standard deviations
    pairs = np.asarray(specimen.tessellation.shared_edges)[:, :2]
    alike = np.mean(one[pairs[:, 0]] == one[pairs[:, 1]])
    assert abs(alike - 0.5) < 5.0 * 0.5 / math.sqrt(len(pairs))


def test_a_contact_of_two_minerals_is_in_series_and_as_strong_as_the_weaker():
    mixed = rock(cohesion=50e6, friction=0.2, tensile_fracture_energy=30.0)
    names = [pair.name for pair in minerals.pair_materials(mixed, "flexible")]
    assert names == ["soft-soft", "soft-hard", "hard-soft", "hard-hard"]
    laws = [pair.law("flexible") for pair in minerals.pair_materials(mixed, "flexible")]
    law = laws[1]
    assert law["normal_stiffness"] == pytest.approx(2.0 / (1.0 / K_SOFT + 1.0 / K_HARD))
    assert law["shear_ratio"] == pytest.approx(0.3)
    assert (law["cohesion"], law["friction"], law["tensile_strength"]) == (30e6, 0.2, 8.5e6)
    assert (law["tensile_fracture_energy"], law["shear_fracture_energy"]) == (20.0, 800.0)
    contact = [key for key in law if key not in ("young", "poisson")]
    assert [laws[2][key] for key in contact] == [law[key] for key in contact]
    brittle = minerals.pair_materials(rock(softening="brittle"), "flexible")[1].law("flexible")
    elastic = 8.5e6**2 / (2.0 * brittle["normal_stiffness"])
    assert brittle["tensile_fracture_energy"] == pytest.approx(elastic)


def test_the_solver_has_the_law_of_each_pair_and_grains_their_material():
    """Steps agree with the solve: the pull of one step on each bond names its stiffness."""
    kinds = np.random.default_rng(1).integers(0, 2, COLUMNS * ROWS)
    model = flexpm.build(grid().with_minerals(kinds), rock(density=3000.0))
    scene = yade.O
    stretch = 1e-9  # [m] a step, by the whole column: within the elastic branch
    for body, (_, y) in zip(model.solver.bodyIds, model.specimen.centres, strict=True):
        grain = scene.bodies[body]
        grain.shape.held[:] = 1
        grain.shape.velocities[:] = (0.0, stretch * round(y / SIZE - 0.5))
        kind = "hard" if kinds[grain.shape.grain] else "soft"
        assert (grain.material.label, grain.material.density) == (
            kind,
            3000.0 if kind == "hard" else 2650.0,
        )
    model.run(1)
    seen = set()
    for bond in scene.interactions:
        pair = {int(kinds[i]) for i in (bond.id1, bond.id2)}
        opening, traction = bond.phys.opening[1], bond.phys.traction[1]
        if abs(opening) < 0.5 * stretch:
            continue  # side by side
        expected = {(0,): K_SOFT, (1,): K_HARD}.get(
            tuple(pair), 2.0 / (1.0 / K_SOFT + 1.0 / K_HARD)
        )
        assert traction[0] / opening == pytest.approx(expected, rel=1e-9)
        seen.add(tuple(sorted(pair)))
    assert seen == {(0,), (1,), (0, 1)}


def test_values_of_the_rock_and_of_a_mineral_can_be_set():
    sets = ["cohesion=40e6", "hard.cohesion=60e6", "hard.young=90e9", "soft.friction=0.1"]
    soft, hard = minerals.mineral_materials(rock().with_set(sets))
    assert (soft.cohesion, soft.friction, soft.elastic["flexible"].young) == (40e6, 0.1, SOFT)
    assert (hard.cohesion, hard.friction, hard.elastic["flexible"].young) == (60e6, 0.4, 90e9)
    assert hard.elastic["rigid"].normal_stiffness == K_HARD
    for text, message in (
        ("hrad.cohesion=1", "did you mean hard"),
        ("hard.cohesoin=1", "did you mean cohesion"),
        ("hard.plane=strain", "hard key = 'plane'"),
        ("hard.cohesion=much", "set hard.cohesion = 'much' Pa, must be a number"),
    ):
        refusal(message, rock().with_set, [text])
    refusal(
        "the material has no minerals",
        lambda: Material.from_dict(BASE).with_set(["hard.cohesion=1e6"]),
    )


def changed(**changes):
    data = {**BASE, "mineral": [{"name": "a", "fraction": 0.4}, {"name": "b", "fraction": 0.6}]}
    data["mineral"][1] |= changes
    return data


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (changed(fraction=0.5), "fractions = 0.9 in all, must sum to 1"),
        (changed(fraction=-0.6), r"\[\[mineral\]\] 2 fraction = -0.6, must be > 0"),
        (changed(fraction="half"), "fraction = 'half', must be a number"),
        (changed(name="a"), "'a', is given twice"),
        (changed(cohesoin=1e6), "cohesoin.*did you mean cohesion"),
        (changed(plane="strain"), "mineral b key = 'plane'"),
        (changed(cohesion=-1.0), "mineral b: material cohesion = -1.0 Pa"),
        (changed(elastic={"flexibel": {}}), "did you mean flexible"),
        (changed(elastic={"flexible": {"yuong": 1e9}}), "did you mean young"),
        (changed(elastic={"flexible": 3}), "must be a table"),
        (changed(tensile_fracture_energy=0.1), "fracture_energy = 0.1 N/m"),
        ({**BASE, "mineral": {"name": "a"}}, "must be tables"),
        ({**BASE, "mineral": [3]}, "must be a table"),
        ({**BASE, "mineral": [{"fraction": 1.0}]}, "name is missing"),
    ],
)
def test_wrong_minerals_are_refused_in_one_line(data, message):
    refusal(message, lambda: minerals.description(Material.from_dict(data), "flexible"))


@pytest.mark.parametrize("model", ["inner", "inner-un"])
def test_inner_particles_refuse_minerals(model):
    sets = {"inner": {"normal_stiffness": K_SOFT, "shear_ratio": 0.3}}
    whole = Material.from_dict({**BASE, "elastic": sets, "mineral": [{"name": "a", "fraction": 1}]})
    for call in (flexpm.build, lambda *given: flexpm.run("uniaxial", *given)):
        refusal(
            "one type of grain; use one of the models flexible, rigid", call, grid(), whole, model
        )


@pytest.mark.parametrize("given", [[0], [0.0] * 24, [-1] * 24, [0, 1] * 13])
def test_wrong_minerals_of_grains_are_refused(given):
    refusal("must be 24 indices", lambda: grid().with_minerals(given))


def test_a_mineral_that_the_rock_does_not_have():
    refusal("minerals = 2, must be below", flexpm.build, grid().with_minerals([2] * 24), rock())
    with pytest.raises(flexpm.InputError, match="minerals = 1, must be below"):
        flexpm.build(grid().with_minerals([0, 1] * 12), Material.from_dict(BASE))
    # a material without minerals is the mineral of grains that all have the first one
    flexpm.build(grid().with_minerals([0] * 24), Material.from_dict(BASE))


@pytest.mark.long
def test_an_interrupted_run_goes_on_with_its_minerals_to_the_same_bits(tmp_path, monkeypatch):
    step_clock(monkeypatch.setattr, look=10)
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
    job = {"test": "tension", "specimen": specimen, "material": rock(), "rate": 0.1}

    def interrupt(done, expected, text):
        if done > 100:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flexpm.run(**job, out=tmp_path / "cut", progress=interrupt)
    resumed = flexpm.run(**job, out=tmp_path / "cut")
    whole = flexpm.run(**job, out=tmp_path / "whole")
    assert 0 < resumed.resumed_at < resumed.steps == whole.steps
    for name in ("curve.csv", "final.vtu", "cracks.csv"):
        cut = (tmp_path / "cut" / name).read_bytes()
        assert cut == (tmp_path / "whole" / name).read_bytes()
    areas = [kind["area_fraction"] for kind in whole.material["minerals"]]
    assert areas == pytest.approx([0.5, 0.5], abs=2.0 / len(specimen.discs))
    swapped = specimen.with_minerals(1 - whole.snapshot.grain_mineral)
    with pytest.raises(flexpm.InputError, match="minerals = None there"):
        flexpm.run(**{**job, "specimen": swapped}, out=tmp_path / "cut")


@pytest.mark.long
def test_stepping_meets_the_elastic_solve_of_a_mixture():
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, 0.01, seed=3)
    stiff = rock(tensile_strength=9e6)
    # rigid grains are stepped between plates, whose compliance the solve does not have
    for model, tolerance in (("flexible", 0.01), ("rigid", 0.03)):
        result = flexpm.run("uniaxial", specimen, stiff, model, rate=2.0, max_strain=2e-3)
        solved = flexpm.elastic(specimen, stiff, model)["youngs_modulus"]
        alike = flexpm.elastic(specimen, Material.from_dict(BASE), model)["youngs_modulus"]
        assert result.youngs_modulus == pytest.approx(solved, rel=tolerance)
        assert solved > 1.2 * alike


PAIR = ("soft", "hard")
WEAK = {"tensile_strength": 2e6, "cohesion": 5e6, "friction": 0.2, "tensile_fracture_energy": 10.0}


def with_pair(**values):
    return dataclasses.replace(
        rock(), interfaces=[Interface(PAIR, values.pop("values", {}), values.pop("factors", {}))]
    )


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_two_layers_part_at_the_strength_and_with_the_energy_of_their_pair(model):
    specimen = grid(2, 4).with_minerals([0] * 4 + [1] * 4)
    material = with_pair(values=WEAK)
    slow = {"loading": "constant", "start": "rest", "rate": 0.02, "stop_ratio": 1e-9}
    slow["max_strain"] = 6e-3  # the pair is open by 1e-5 m at 2.5e-3, of centres of grains at 5e-3
    result = flexpm.run("tension", specimen, material, model, **slow)
    assert result.peak_stress == pytest.approx(2e6, rel=1e-3)
    area = 2 * SIZE * specimen.thickness
    if model == "flexible":  # a test of rigid grains ends as they swing back, just before
        assert result.cracks_by_pair == {"hard/soft": {"tensile": 6, "shear": 0}}
        assert {crack.pair for crack in result.cracks} == {"hard/soft"}
    error = {"flexible": 1e-3, "rigid": 5e-3}[model]
    assert result.curve["damage_energy"][-1] == pytest.approx(10.0 * area, rel=error)


def test_two_blocks_slide_at_the_strength_and_with_the_energy_of_their_pair():
    """Pressed together and driven past each other; blocks so stiff that their contact alone gives.

    The slip is small enough for its normal, along the line of the centres, to stay as it is.
    """
    elastic = {"flexible": {**BASE["elastic"]["flexible"], "young": 1e3 * SOFT}}
    stiff = {"flexible": {"young": 1e3 * HARD, "normal_stiffness": K_HARD}}
    kinds = [{"name": "soft", "fraction": 0.5}]
    kinds.append({"name": "hard", "fraction": 0.5, "elastic": stiff})
    pair = {"pair": list(PAIR), **WEAK, "shear_fracture_energy": 8.0}
    material = {**BASE, "elastic": elastic, "mineral": kinds, "interface": [pair]}
    specimen = grid(2, 1).with_minerals([0, 1])
    rig = PartRig(flexpm.build(specimen, Material.from_dict(material), model="flexible"))
    left = rig.hold(where=lambda x, _: x < 0.99 * SIZE)
    right = rig.hold(where=lambda x, _: x > 1.01 * SIZE)
    area, steps = SIZE * specimen.thickness, 2000
    right.move((-3e6 * 0.5 * (1.0 / K_SOFT + 1.0 / K_HARD) / steps, 0.0))
    rig.built.run(steps)
    right.move((0.0, 0.0))
    rig.built.run(500)
    pressure = -right.force[0] / area
    assert pressure == pytest.approx(3e6, rel=0.005)  # blocks give a little
    rig.drive([right], (0.0, 1.0), against=[left])
    rig.strain_to(4e-6, rate=10.0)
    record = rig.record
    assert record["load"].max() / area == pytest.approx(5e6 + 0.2 * pressure, rel=1e-3)
    assert record["damage_energy"][-1] / area == pytest.approx(8.0, rel=1e-3)
    assert (record["tensile_cracks"][-1], record["shear_cracks"][-1]) == (0, 3)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_pair_that_is_a_thousand_times_as_strong_never_cracks(model, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=3)
    strong = ("tensile_strength", "cohesion", "tensile_fracture_energy", "shear_fracture_energy")
    factors = {key: 1e3 if "strength" in key or key == "cohesion" else 1e6 for key in strong}
    # the others have broken by then; at far more than that stresses come to these strengths, too
    ends = {"max_strain": 0.02, "out": tmp_path, "report": False}
    result = flexpm.run("uniaxial", specimen, with_pair(factors=factors), model, **ends)
    counts = result.cracks_by_pair
    assert counts and "hard/soft" not in counts
    for mode in ("tensile", "shear"):
        number = sum(pair[mode] for pair in counts.values())
        assert number == getattr(result, f"{mode}_cracks")
    assert (tmp_path / "cracks.csv").read_text().splitlines()[0].endswith(",energy,pair")
    assert flexpm.Result.read(tmp_path).cracks == result.cracks


def test_factors_of_one_leave_all_bits():
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=3)
    curves = [
        flexpm.run("tension", specimen, material).curve.csv()
        for material in (rock(), with_pair(factors=dict.fromkeys(FACTOR_KEYS, 1.0)))
    ]
    assert curves[0] == curves[1]
