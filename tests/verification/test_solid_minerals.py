# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of several minerals: composites in closed form, laws of pairs, files, every model."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.materials.interface import FACTOR_KEYS, Interface
from flexpm.materials.material import Material
from flexpm.results.result import Result
from flexpm.results.vtu import read_state

#: A rock of two minerals.
ROCK = Path(__file__).parents[2] / "scripts" / "tutorials" / "two_minerals.toml"
SIZE = 1e-3  # of cubic grains [m]
SOFT, HARD = 30e9, 90e9  # [Pa]
MODELS = ["flexible", "rigid", "jcfpm", "cohfrict"]
BASE = {
    "tensile_strength": 8.5e6,
    "cohesion": 30e6,
    "friction": 0.4,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 800.0,
    "elastic": {
        "flexible": {"young": SOFT, "poisson": 0.2, "normal_stiffness": 1e14, "shear_ratio": 0.3},
        "rigid": {"normal_stiffness": 5e13, "shear_ratio": 0.3},
    },
    "mineral": [
        {"name": "soft", "fraction": 0.5},
        {"name": "hard", "fraction": 0.5, "elastic": {"flexible": {"young": HARD}}},
    ],
}
#: At which layers part slowly.
RATES = dict(zip(MODELS, (0.15, 0.15, 0.1, 0.1), strict=True))
#: Strengths that nothing comes to, and the energies that they need.
STRONG = {"tensile_strength": 1e3, "cohesion": 1e3}
STRONG |= {"tensile_fracture_energy": 1e6, "shear_fracture_energy": 1e6}


def rock(*interfaces):
    return Material.from_dict({**BASE, "interface": list(interfaces)}, "rock")


def stiff():
    """Contacts that add nothing, grains that do not widen."""
    elastic = {"young": SOFT, "poisson": 1e-9, "normal_stiffness": 1e18, "shear_ratio": 0.3}
    return Material.from_dict({**BASE, "elastic": {"flexible": elastic}}, "stiff")


def cubes(across, up):
    """Cubic grains in rows, and the centres."""
    x, z = (SIZE * (np.arange(n) + 0.5) for n in (across, up))
    centres = np.array([(a, b, c) for c in z for b in x for a in x])
    rows = np.column_stack((centres, np.full(len(centres), 0.5 * SIZE)))
    sizes = {"width": across * SIZE, "depth": across * SIZE, "height": up * SIZE}
    return Specimen.from_spheres(rows, **sizes), centres


@pytest.fixture(scope="module")
def packed():
    return Specimen.box(0.008, 0.008, 0.012, seed=3)


def test_layers_have_the_moduli_in_series_and_in_parallel():
    box, centres = cubes(4, 4)
    layer = (centres / SIZE).astype(int) % 2
    across = flexpm.elastic(box.with_minerals(layer[:, 2]), stiff())["youngs_modulus"]
    assert across == pytest.approx(2.0 / (1.0 / SOFT + 1.0 / HARD), rel=1e-3)
    along = flexpm.elastic(box.with_minerals(layer[:, 0]), stiff())["youngs_modulus"]
    assert along == pytest.approx(0.5 * (SOFT + HARD), rel=1e-3)


def test_fractions_are_of_the_volume_and_draws_are_those_of_the_seed(packed):
    built = fresh(packed, rock())
    shares = [kind["volume_fraction"] for kind in built.describe_material()["minerals"]]
    assert sum(shares) == pytest.approx(1.0)
    largest = max(packed.cells.volumes) / sum(packed.cells.volumes)
    assert shares[0] == pytest.approx(0.5, abs=0.5 * largest)
    drawn = built.snapshot().grain_mineral
    assert np.array_equal(drawn, fresh(packed, rock(), "rigid").snapshot().grain_mineral)
    assert 0 < drawn.sum() < len(drawn)


@pytest.mark.parametrize("model", MODELS)
def test_two_layers_part_at_the_strength_of_their_pair(model):
    box, centres = cubes(2, 4)
    box = box.with_minerals((centres[:, 2] > 2.0 * SIZE).astype(int))
    weak = {"tensile_strength": 2e6, "cohesion": 5e6, "tensile_fracture_energy": 0.2}
    material = rock({"pair": ["soft", "hard"], **weak})
    result = flexpm.run("tension", box, material, model, rate=RATES[model], stop_ratio=1e-3)
    stress = result.curve["axial_stress"]
    row = float(np.diff(stress[: stress.argmax() + 1]).max())  # bonds break between two rows
    assert 2e6 - 1.1 * row <= result.peak_stress <= 2.1e6  # of grains a wave runs on
    assert row < 1e5
    assert list(result.cracks_by_pair) == ["hard/soft"]


@pytest.mark.parametrize("model", MODELS)
def test_factors_of_one_and_equal_minerals_leave_all_bits(model):
    mixed, _ = cubes(2, 4)
    ones = dict.fromkeys(FACTOR_KEYS, 1.0)
    same = Interface(("hard", "soft"), factors=ones)
    alike = {key: value for key, value in BASE.items() if key != "mineral"}
    twins = [{"name": name, "fraction": 0.5} for name in ("soft", "hard")]
    for one, other in (
        (rock(), dataclasses.replace(rock(), interfaces=(same,))),
        (Material.from_dict(alike), Material.from_dict(alike | {"mineral": twins})),
    ):
        texts = [
            flexpm.run("tension", mixed, material, model, rate=8.0, max_strain=3e-4).curve.csv()
            for material in (one, other)
        ]
        assert texts[0] == texts[1]


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "jcfpm"])
def test_a_pair_that_is_a_thousand_times_as_strong_never_cracks(packed, model, tmp_path):
    material = rock({"pair": ["soft", "hard"], "factor": STRONG})
    # the others have broken by then; at far more than that stresses come to these strengths, too
    ends = {"rate": 8.0, "max_strain": 0.02}
    result = flexpm.run("tension", packed, material, model, **ends, out=tmp_path, report=False)
    counts = result.cracks_by_pair
    assert counts and "hard/soft" not in counts
    for mode in ("tensile", "shear"):
        assert sum(pair[mode] for pair in counts.values()) == getattr(result, f"{mode}_cracks")
    assert Result.read(tmp_path).cracks_by_pair == counts
    assert "pair" in (tmp_path / "cracks.csv").read_text().partition("\n")[0]
    state = read_state(tmp_path / "final.vtu")
    assert np.array_equal(state.grain_mineral, result.snapshot.grain_mineral)
    assert np.array_equal(state.section.grain_mineral, state.grain_mineral)


def test_given_minerals_are_saved_and_wrong_ones_refused(packed, tmp_path):
    kinds = np.arange(packed.cells.cells) % 2
    marked = packed.with_minerals(kinds)
    assert not marked.spec.is_packed and packed.spec.is_packed
    marked.save(tmp_path / "solid.json")
    again = Specimen.load_solid(tmp_path / "solid.json")
    assert np.array_equal(again.minerals, kinds)
    assert again.spec == marked.spec
    for wrong in ([0], -kinds, kinds + 0.5):
        refusal("with_minerals: minerals = ", packed.with_minerals, wrong)
    yade.O.reset()
    with pytest.raises(InputError, match="minerals = 2, must be below the number of minerals"):
        flexpm.build(packed.with_minerals(kinds + 1), rock())
    with pytest.raises(InputError, match="minerals = 1, must be below the number of minerals"):
        flexpm.elastic(marked, "augig-table7")


@pytest.mark.long
def test_the_command_repeats_a_rock_of_minerals(packed, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    packed.with_minerals(np.arange(packed.cells.cells) % 2).save(tmp_path / "solid.json")
    material = str(ROCK)
    asked = ["uniaxial", "--specimen", "solid.json", "--material", material, "--model", "jcfpm"]
    asked += ["--max-strain", "2e-4", "--rate", "8", "--quiet", "--no-report"]
    assert cli.main(["run", *asked, "--out", "one"]) in (0, 3)
    capsys.readouterr()
    assert cli.main(["rerun", "one", "--quiet", "--out", "again", "--no-report"]) in (0, 3)
    assert "the same as in" in capsys.readouterr().out
