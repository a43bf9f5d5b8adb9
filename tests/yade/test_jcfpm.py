# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's JCFpm on flexpm's discs and bonds: all of them together, and the tests."""

import json

import bonded_pair
import numpy as np
import pytest
import yade
from refusals import refusal

from flexpm.cli import main as cli
from flexpm.laboratory import protocols
from flexpm.models import grains as models
from flexpm.results.measures import peak_row
from flexpm.specimens.specimen import Specimen

MODEL = "jcfpm"


@pytest.fixture(scope="module")
def rectangle():
    return Specimen.rectangle(0.02, 0.04, 0.01, seed=2)


def test_bonds_are_those_of_the_cells_and_nothing_else_pulls(rectangle):
    built = models.build(rectangle, None, MODEL)
    yade.O.step()
    pairs = {(i.id1, i.id2) for i in yade.O.interactions if i.phys.isCohesive}
    assert pairs == {(int(a), int(b)) for a, b, *_ in rectangle.tessellation.shared_edges}
    strengths = [bond.FnMax for bond in built.cracks.contacts]
    law = built.material.law(MODEL)
    assert np.array(strengths) == pytest.approx(law["tensile_strength"] * built.bonds.areas)
    assert max(np.linalg.norm(yade.O.forces.f(k)) for k in built.ids) == 0.0


def test_unbroken_bonds_keep_the_balance_of_energy(rectangle):
    result = protocols.run("uniaxial", rectangle, model=MODEL, rate=4.0)
    assert bonded_pair.balance_before_cracks(result.curve) == pytest.approx(1.0, abs=0.02)
    assert result.youngs_modulus == pytest.approx(25e9, rel=0.1)  # Table 1's rigid set is for 25.8


def test_the_record_agrees_with_the_law_and_the_cracks(rectangle):
    result = protocols.run("tension", rectangle, model=MODEL)
    law = yade.O.engines[2].lawDispatcher.functors[0]
    assert (result.tensile_cracks, result.shear_cracks) == (law.nbTensCracks, law.nbShearCracks)
    modes = [crack.mode for crack in result.cracks]
    assert (modes.count(1), modes.count(2)) == (result.tensile_cracks, result.shear_cracks)
    assert result.energy_error is None
    broken = [crack.contact for crack in result.cracks]
    assert len(set(broken)) == len(broken)
    # a tension test cannot carry more than its bonds do
    assert 0.0 < result.peak_stress < result.material["tensile_strength"]


def test_the_pressure_stays_until_the_peak(rectangle):
    pressure = 4e6
    result = protocols.run("biaxial", rectangle, model=MODEL, confinement=pressure, rate=4.0)
    record = result.curve
    peak = peak_row(record)
    assert record["confinement"][: peak + 1] == pytest.approx(pressure, rel=0.01)
    line = np.polyfit(record["axial_strain"][1:10], record["axial_stress"][1:10], 1)
    assert line[1] == pytest.approx(pressure, rel=0.03)  # where the axial stage started
    alone = protocols.run("uniaxial", rectangle, model=MODEL, rate=4.0)
    assert result.peak_stress > alone.peak_stress + pressure


def test_a_disc_splits_along_its_loaded_diameter():
    disc = Specimen.disc(0.03, 0.01, seed=2)
    result = protocols.run("brazilian", disc, model=MODEL, rate=2.0)
    places = np.array([(crack.x, crack.y) for crack in result.cracks])
    spread = places.std(axis=0)
    assert spread[1] > 1.4 * spread[0]  # 1 if cracks were everywhere
    assert result.youngs_modulus is None


def test_the_same_run_gives_the_same_bits(rectangle):
    runs = [protocols.run("tension", rectangle, model=MODEL).curve.array for _ in range(2)]
    assert np.array_equal(*runs, equal_nan=True)


@pytest.mark.parametrize(
    ("options", "word"),
    [({"points": 1}, "points"), ({"mesh": "fan"}, "mesh"), ({"damping": 1.0}, "damping")],
)
def test_what_the_model_does_not_have_is_refused(rectangle, options, word):
    refusal(word, models.build, rectangle, None, MODEL, **options)


@pytest.mark.parametrize("model", ["jcfpm", "cohfrict"])
@pytest.mark.parametrize("solid", [False, True])
def test_a_single_grain_has_no_bond_to_take_a_stiffness_from(solid, model):
    side = 0.01
    if solid:
        rows = [[0.5 * side] * 3 + [0.003]]
        one = Specimen.from_spheres(rows, width=side, depth=side, height=side)
    else:
        corners = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
        one = Specimen.from_discs([[0.5 * side] * 2], [0.003], corners, 0.01)
    refusal(f"bonds = none among 1 grains, {model} takes", models.build, one, None, model)


def test_tests_refuse_the_wrong_shape(rectangle):
    refusal("disc", protocols.run, "brazilian", rectangle, model=MODEL)
    refusal("confinement", protocols.run, "uniaxial", rectangle, model=MODEL, confinement=1e6)


def test_the_command_writes_the_files_of_a_run(tmp_path):
    options = ["--width", "0.016", "--height", "0.032", "--thickness", "0.01", "--quiet"]
    assert cli.main(["run", "tension", "--model", MODEL, *options, "--out", str(tmp_path)]) == 0
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["model"] == MODEL
    assert result["nodes"] is None
    assert result["energy_error"] is None
    assert result["material"]["name"] == "augig-table2-bilinear"
    names = {file.name for file in tmp_path.iterdir()}
    assert names >= {"curve.csv", "cracks.csv", "specimen.vtu", "final.vtu", "curve.png"}
