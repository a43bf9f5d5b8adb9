# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrations that are written for a rock: targets, start, free keys, runs, and their command."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from refusals import refusal, refused_command

import flexpm
from flexpm import materials
from flexpm.cli import main as cli
from flexpm.dimensions import is_solid
from flexpm.errors import InputError
from flexpm.materials.material import Material
from flexpm.studies import calibration_problem
from flexpm.studies.pool import Pool
from flexpm.studies.proposals import aims, beginning, written
from flexpm.studies.scorecards import measures, runs
from flexpm.studies.scorecards import rock as rocks
from flexpm.studies.scorecards.exponents import Exponent, Exponents

#: Everything that may decide on a rock.
ALL = """
[rock]
name = "any"
source = "s"
[youngs_modulus]
value = 15e9
lower = 14.4e9
upper = 16.5e9
decides = true
[poissons_ratio]
value = 0.2
lower = 0.19
decides = true
[compressive_strength]
value = 60e6
lower = 54e6
upper = 72e6
decides = true
[indirect_tensile_strength]
value = 5e6
lower = 4.5e6
upper = 5.5e6
[crack_damage]
value = 0.75
lower = 0.6
upper = 0.9
decides = true
[cohesion_wide]
value = 11e6
upper = 12.1e6
decides = true
[friction_angle_wide]
value = 48.0
lower = 45.6
upper = 50.4
decides = true
[hoek_brown_m]
value = 15.0
lower = 12.0
decides = true
[fracture_toughness]
value = 1e6
lower = 0.8e6
decides = true
[peak_ratio_30]
value = 2.5
lower = 2.0
upper = 3.0
decides = true
[drop_30]
value = 0.2
lower = 0.1
decides = true
[class_two]
value = 1.0
lower = 0.8
decides = true
[compressive_indirect_ratio]
value = 12.0
lower = 10.0
decides = true
"""


def rock_of(folder: Path, text: str = ALL) -> Path:
    path = folder / "any.toml"
    path.write_text(text)
    return path


def test_measures_that_decide_are_targets_with_the_tolerance_of_their_bands(tmp_path):
    found = aims.of_rock(rocks.read(rock_of(tmp_path)))
    told = {one.target.name: (one.target.value, one.target.tolerance) for one in found.found}
    assert told == {
        "youngs_modulus": (15e9, 0.04),  # the nearer bound
        "poissons_ratio": (0.2, 0.05),
        "compressive_strength": (60e6, 0.1),
        "crack_damage": (0.75, 0.2),
        "scb_toughness": (1e6, 0.2),
        "cohesion": (11e6, 0.1),
        "friction_angle": (48.0, 0.05),
        "peak": (150e6, 0.2),  # 2.5 times the strength
        "drop": (0.1053, 0.05),  # met from its lower bound of 0.1 on
    }
    pressures = {one.target.name: one.target.pressure for one in found.found}
    assert (pressures["peak"], pressures["drop"], pressures["cohesion"]) == (18e6, 18e6, None)
    assert found.confinements == (0.0, 1.8e6, 6e6)
    assert [one.partition(" ")[0] for one in found.left_out] == [
        *("class_two", "compressive_indirect_ratio", "hoek_brown_m")
    ]


@pytest.mark.parametrize("rock", [*rocks.names(), "any"])
@pytest.mark.parametrize(
    ("model", "shape"),
    [("flexible", "rectangle"), ("rigid", "rectangle"), ("flexible", "box"), ("rigid", "cylinder")],
)
def test_the_file_is_a_calibration_that_starts_within_its_bounds(tmp_path, rock, model, shape):
    given = rock_of(tmp_path) if rock == "any" else rock
    made = written.write(given, tmp_path / "new.toml", model, shape)
    plan = calibration_problem.read(tmp_path / "new.toml")
    assert plan == made.plan and plan.is_solid == is_solid(shape)
    deciding = aims.of_rock(rocks.load(given, "")).found
    assert len(plan.targets) == len(deciding)
    for target, aim in zip(plan.targets, sorted(deciding, key=_place(plan)), strict=True):
        assert (target.value, target.tolerance) == (aim.target.value, aim.target.tolerance)
    start = materials.load(tmp_path / "new-start.toml")
    law = {**start.law(model), "weibull": start.weibull}
    assert all(low <= law[key] <= high for key, (low, high) in plan.free.items())
    # two keys of the compliance meet the elastic targets, and one more moves crack damage
    free_of_compliance = rock == "any" and model == "flexible"
    assert len(plan.tied) == (2 if free_of_compliance else 0)
    assert len(plan.free) <= len(plan.targets)
    for ratio in plan.ratios:
        assert ratio.bounds[0] < law[ratio.of] / law[ratio.to] < ratio.bounds[1]


def _place(plan):
    names = [target.name.partition("_at_")[0] for target in plan.targets]
    return lambda aim: names.index(aim.target.name)


def test_runs_are_counted_as_the_search_makes_them(tmp_path):
    """Six targets of Augig granite: uniaxial, biaxial and disc, and the elastic solution."""
    cost = written.write("augig", tmp_path / "new.toml", "rigid").cost
    sets = 2 * (1 + 10 + 4 * 4)  # two searches of four keys, each with its start
    assert cost.small == sets * 2 * 3  # two packings
    assert cost.full == 2 * (6 * 2 + 12)  # two sets, twelve discs
    # a fit of two keys on six packings, and a solve for each packing of a set
    assert cost.solves == 3 * 3 * 6 + sets * 2 + 2 * 6
    assert 350 < cost.grains[0] < 450 and 1500 < cost.grains[1] < 1750


# The start


@pytest.mark.parametrize(("k", "e"), [(1.3, 1.3), (0.6, 0.8)])
def test_a_similar_material_has_similar_stresses(tmp_path, k, e):
    """Strains are multiplied by k / e: where they stay, all figures of the stress do."""
    preset = materials.load("augig-calibrated")
    start = beginning.Start(
        beginning.Origin(preset, {}, None), beginning.similar(preset, "flexible", k, e), (k, e), {}
    )
    file = tmp_path / "similar.toml"
    file.write_text(written._material("similar", "flexible", start))
    specimen = flexpm.Specimen.rectangle(0.01, 0.02, 0.005, seed=3)
    both = [
        (
            flexpm.elastic(specimen, material),
            flexpm.run("tension", specimen, material, rate=6.0),
        )
        for material in (preset, materials.load(file))
    ]
    (solved, run), (solved_too, run_too) = both
    assert solved_too["youngs_modulus"] / solved["youngs_modulus"] == pytest.approx(e, rel=1e-9)
    assert solved_too["poissons_ratio"] == pytest.approx(solved["poissons_ratio"], rel=1e-9)
    near = 1e-3 if k == e else 0.02  # other strains, other large ones
    assert run_too.peak_stress / run.peak_stress == pytest.approx(k, rel=near)
    assert run_too.peak_strain / run.peak_strain == pytest.approx(k / e, rel=near)


#: Measures that follow power laws of three keys; all are those of a rock of 100 MPa.
LAWS = {
    "compressive_strength": {"cohesion": 0.6, "friction": 0.5, "tensile_strength": -0.1},
    "indirect_tensile_strength": {"cohesion": 0.4, "friction": 0.0, "tensile_strength": 0.6},
    "friction_angle_low": {"cohesion": -0.1, "friction": 0.3, "tensile_strength": 0.1},
}
MEASURED = {
    "youngs_modulus": 25e9,
    "compressive_strength": 100e6,
    "indirect_tensile_strength": 8e6,
    "friction_angle_low": 50.0,
}
ROCK = """
[rock]
source = "s"
[youngs_modulus]
value = 15e9
lower = 14e9
[compressive_strength]
value = 60e6
lower = 57e6
decides = true
[indirect_tensile_strength]
value = {0}
lower = {0}
upper = {1}
decides = true
[friction_angle_low]
value = 52.0
lower = 50.0
decides = true
"""
KEYS = ("cohesion", "friction", "tensile_strength")


def known(**changes):
    of = {
        name: {key: Exponent(value, 0.01) for key, value in law.items()}
        for name, law in LAWS.items()
    }
    content = {
        **{"tensile_strength": 6e6, "cohesion": 21e6, "friction": 0.4, "density": 2650.0},
        **{"tensile_fracture_energy": 15.0, "shear_fracture_energy": 5000.0, "weibull": 8.0},
        "elastic": {
            "flexible": {
                **{"normal_stiffness": 1.8e14, "shear_ratio": 0.28},
                **{"young": 27e9, "poisson": 0.23},
            }
        },
    }
    return Exponents(
        **{"model": "flexible", "dimension": "2D", "step": 0.15, "material": content},
        **{"measures": MEASURED, "of": of} | changes,
    )


def started(folder: Path, splitting: float, table: Exponents | None):
    rock = rocks.read(rock_of(folder, ROCK.format(splitting, 1.05 * splitting)))
    content = known().material
    source = beginning.Origin(Material.from_dict(content), MEASURED, table)
    return beginning.start(source, "flexible", rock, aims.of_rock(rock).found, KEYS)


def test_strengths_and_moduli_of_the_start_follow_from_the_rock(tmp_path):
    found = started(tmp_path, 4.8e6, None)
    content = known().material
    assert found.factors == pytest.approx((0.6, 0.6)) and found.steps == {}
    ratios = {key: found.values[key] / content[key] for key in content if key in found.values}
    expected = {
        **dict.fromkeys(("tensile_strength", "cohesion"), 0.6),
        **dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 0.6),
        **{"friction": 1.0, "weibull": 1.0},
    }
    assert ratios == pytest.approx(expected, rel=1e-3)
    elastic = content["elastic"]["flexible"]
    ratios = {key: found.values[key] / elastic[key] for key in elastic}
    expected = {"normal_stiffness": 0.6, "young": 0.6, "shear_ratio": 1.0, "poisson": 1.0}
    assert ratios == pytest.approx(expected, rel=1e-3)


def test_a_step_by_exponents_meets_the_targets_of_power_laws(tmp_path):
    found = started(tmp_path, 5.2e6, known())
    logs = {key: math.log(factor) for key, factor in found.steps.items()}
    targets = {
        "compressive_strength": 60e6,
        "indirect_tensile_strength": 5.2e6,
        "friction_angle_low": 52.0,
    }
    for name, target in targets.items():
        change = math.exp(sum(LAWS[name][key] * logs[key] for key in KEYS))
        similar = beginning.expected(name, MEASURED[name], found.factors)
        assert similar * change == pytest.approx(target, rel=0.01), name
        assert abs(change - 1.0) > 0.005 or name == "compressive_strength"
    # what is similar already stays
    stays = started(tmp_path, 4.8e6, known(measures={**MEASURED, "friction_angle_low": 52.0}))
    assert stays.steps == pytest.approx(dict.fromkeys(KEYS, 1.0), abs=1e-6)


def test_a_measure_without_some_exponent_takes_no_part_in_the_step(tmp_path):
    of = {name: dict(keys) for name, keys in known().of.items()}
    del of["friction_angle_low"]["cohesion"]
    found = started(tmp_path, 5.2e6, known(of=of)).steps
    logs = [LAWS["indirect_tensile_strength"][key] * math.log(found[key]) for key in KEYS]
    assert math.exp(sum(logs)) == pytest.approx(5.2 / 4.8, rel=0.01)  # that is met none the less
    whole = started(tmp_path, 5.2e6, known()).steps
    assert whole["friction"] > 1.05 * found["friction"]
    rock = aims.of_rock(rocks.read(rock_of(tmp_path, ROCK.format(5e6, 5.2e6)))).found
    assert beginning.without_exponents(known(of=of), rock, KEYS) == ["friction_angle_low"]
    # the elastic solution alone has no strengths
    of["youngs_modulus"] = {"young": Exponent(0.4)}
    assert beginning.without_exponents(known(of=of), rock, [*KEYS, "young"]) == [
        "friction_angle_low"
    ]


def test_an_exponent_within_its_scatter_takes_no_step(tmp_path):
    of = {name: dict(keys) for name, keys in known().of.items()}
    whole = started(tmp_path, 5.2e6, known(of=of)).steps
    of["friction_angle_low"] = {key: Exponent(-2.0, 1.5) for key in KEYS}
    found = started(tmp_path, 5.2e6, known(of=of)).steps
    assert abs(found["friction"] - 1.0) < 0.5 * abs(whole["friction"] - 1.0)


def test_drops_take_no_step_and_are_named(tmp_path):
    """They are measured over a fixed strain, so that similar materials have other drops."""
    text = ROCK.format(4.8e6, 5e6) + "[drop_30]\nvalue = 0.2\nlower = 0.2\ndecides = true\n"
    rock = rocks.read(rock_of(tmp_path, text))
    zero = dict.fromkeys(KEYS, Exponent(0.0))
    of = {"drop_30": {**zero, "friction": Exponent(-1.0)}}
    table = known(measures={**MEASURED, "drop_30": 0.15}, of=of)
    source = beginning.Origin(Material.from_dict(table.material), MEASURED, table)
    found = aims.of_rock(rock).found
    assert beginning.start(source, "flexible", rock, found, KEYS).steps.get("friction", 1.0) == 1.0
    assert "drop_30" in beginning.without_exponents(table, found, KEYS)


def test_rocks_whose_targets_free_no_key_are_refused_and_leave_no_file(tmp_path):
    text = '[rock]\nsource = "s"\n[compressive_strength]\nvalue = 100e6\nlower = 90e6\n'
    text += "[crack_initiation]\nvalue = 0.5\nlower = 0.4\ndecides = true\n"
    rock = rock_of(tmp_path, text)
    before = sorted(tmp_path.iterdir())
    with pytest.raises(InputError, match="free"):
        written.write(rock, tmp_path / "new.toml", "rigid")
    assert sorted(tmp_path.iterdir()) == before


def test_a_value_of_zero_is_no_target(tmp_path):
    text = ROCK.format(4.8e6, 5e6) + "[class_two]\nvalue = 0.0\nupper = 0.2\ndecides = true\n"
    found = aims.of_rock(rocks.read(rock_of(tmp_path, text)))
    assert "class_two (0 has no relative tolerance)" in found.left_out


# Materials that are drawn


#: Measures of drawn materials, and the runs that tell them.
DRAWN = (
    *("youngs_modulus", "poissons_ratio", "compressive_strength", "crack_initiation"),
    *("direct_tensile_strength", "indirect_tensile_strength"),
)
RUNS = (measures.SOLVED, measures.COMPRESSED, measures.PULLED, measures.SPLIT)


def measured(material: Path, folder: Path) -> dict[str, float]:
    """Measures of a material on a small packing of a scorecard."""
    plan = runs.plan(
        *(materials.load(material), str(material)),
        **{"model": "flexible", "shape": "rectangle", "seeds": [1], "size": "small"},
        rock=rocks.load("augig", ""),
    )
    wanted = [plan.jobs[1][name] for name in RUNS]
    with Pool(folder, workers=1) as pool:
        outcomes = pool.run(wanted)
    ended = {
        name: runs.ended(outcome, folder / job.folder)
        for name, outcome, job in zip(RUNS, outcomes, wanted, strict=True)
    }
    found = runs.values_of(ended, solid=False)
    return {name: found[name].number for name in DRAWN}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_drawn_materials_start_near_their_own_results(tmp_path, seed):
    """Strengths of 0.4 to 1.4, moduli of 0.6 to 1.3, each key within 20 % of the similar one."""
    drawn = np.random.default_rng(seed)
    source = beginning.origin("2D", "flexible")
    k, e = drawn.uniform(0.4, 1.4), drawn.uniform(0.6, 1.3)
    values = beginning.similar(source.material, "flexible", k, e)
    for key in ("tensile_strength", "cohesion", "friction", "tensile_fracture_energy"):
        values[key] *= drawn.uniform(0.8, 1.2)
    start = beginning.Start(source, values, (k, e), {})
    (tmp_path / "drawn.toml").write_text(written._material("drawn", "flexible", start))
    rock = measured(tmp_path / "drawn.toml", tmp_path / "drawn")
    text = "".join(
        f'[{name}]\nvalue = {value}\nlower = {0.9 * value}\nsource = "s"\ndecides = true\n'
        for name, value in rock.items()
    )
    made = written.write(rock_of(tmp_path, text), tmp_path / "new.toml")
    found = measured(made.files[1], tmp_path / "start")
    ratios = {name: found[name] / rock[name] for name in DRAWN}
    assert ratios == pytest.approx(dict.fromkeys(DRAWN, 1.0), abs=0.25), (k, e, made.start.steps)


# The command


def test_the_command_tells_targets_start_and_runs(tmp_path, capsys, monkeypatch):
    rock, out = rock_of(tmp_path), tmp_path / "mine.toml"
    monkeypatch.setattr(beginning.exponents, "load", lambda model, dimension: known())
    assert cli.main(["calibrate", "--new", str(rock), "--out", str(out)]) == 0
    said = capsys.readouterr().out
    for text in (
        "mine, flexible model, written for",
        "decide, but are no targets  class_two (no target of calibrations), ",
        "custom: strengths times 0.6, moduli times 0.6, energies times 0.6",
        "by exponents  cohesion times",
        "elastic solves",
        "targets that free no key  ",
        "mine-start.toml",
    ):
        assert text in said
    assert "no youngs_modulus" not in said
    rock_of(tmp_path, ALL[: ALL.index("[youngs_modulus]")] + ALL[ALL.index("[poissons_ratio]") :])
    assert cli.main(["calibrate", "--new", str(rock), "--out", str(tmp_path / "soft.toml")]) == 0
    said = capsys.readouterr().out
    assert "the rock file has no youngs_modulus" in said and "moduli times 1, " in said
    rock_of(tmp_path)
    # the friction angle of the table is far from that of the rock
    far = known(measures={**MEASURED, "friction_angle_wide": 40.0})
    far.of["friction_angle_wide"] = far.of["friction_angle_low"]
    monkeypatch.setattr(beginning.exponents, "load", lambda model, dimension: far)
    asked = ["calibrate", "--new", str(rock), "--out", str(tmp_path / "other.toml")]
    assert cli.main(asked) == 0
    said = capsys.readouterr().out
    assert "outside the range of the exponents, +-15 %: cohesion, friction" in said
    assert "without exponents  crack_damage, fracture_toughness, cohesion_wide, peak_" in said


def test_the_page_shows_what_the_command_says_of_the_sandstone(tmp_path, capsys, monkeypatch):
    root = Path(__file__).parents[3]
    (tmp_path / "sandstone.toml").write_bytes(
        (root / "scripts/tutorials/sandstone.toml").read_bytes()
    )
    monkeypatch.chdir(tmp_path)
    assert cli.main(["calibrate", "--new", "sandstone.toml", "--out", "my-rock.toml"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 8
    page = (root / "doc/start_with_your_rock.rst").read_text()
    assert "\n".join(f"    {line}" for line in said) in page


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--new", "augig"], "--out is missing"),
        (["--new", "augig", "--out", "there"], "must end in .toml"),
        (["--new", "augig", "--out", "there.toml"], "there.toml', exists"),
        (["--new", "augg", "--out", "new.toml"], "did you mean augig?"),
        (["--new", "augig", "--out", "new.toml", "file.toml"], "must not be given with --new"),
        (["--new", "augig", "--model", "inner", "--out", "new.toml"], "inner"),
        (["--new", "augig", "--out", "new.toml", "--workers", "2"], "--workers = 2, must not be"),
        (["there.toml", "--shape", "box"], "must be given with --new only"),
        ([], "Missing argument 'FILE'"),
    ],
)
def test_wrong_commands_are_refused(tmp_path, monkeypatch, capsys, words, says):
    monkeypatch.chdir(tmp_path)
    Path("there.toml").write_text("")
    refused_command(capsys, says, "calibrate", *words)
    assert [one.name for one in tmp_path.iterdir()] == ["there.toml"]


def test_a_rock_on_which_nothing_decides_is_refused(tmp_path):
    rock = rock_of(tmp_path, ALL.replace("decides = true\n", ""))
    says = refusal("no measure that decides", written.write, rock, tmp_path / "new.toml")
    assert "set decides = true" in says and not (tmp_path / "new.toml").exists()
