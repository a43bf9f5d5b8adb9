# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's spheres bonded beyond their neighbours (D61): which pairs, how strong, what is refused."""

from __future__ import annotations

import json

import numpy as np
import pytest

import flexpm  # isort: skip  (first: it makes YADE importable)
from matplotlib.path import Path as Outline
from refusals import refusal, refused_command
from scenes import fresh

from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.models.options import MODELS, SPHERE_MODELS
from flexpm.models.sphere_bonds import Bonds, Laws, bonds_of
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.specimen import Specimen
from flexpm.studies import jobs, study

SMALL = ["--width", "0.012", "--height", "0.016"]
LAW = flexpm.materials.load("augig-table7").law("rigid")


@pytest.fixture(scope="module")
def rectangle() -> Specimen:
    return Specimen.rectangle(0.02, 0.03, 0.01, seed=2)


def laws_of(specimen: Specimen) -> Laws:
    return Laws(np.zeros(len(specimen.discs), dtype=int), [LAW], [LAW])


def farther(specimen: Specimen, reach: float) -> tuple[Bonds, int]:
    """All bonds, and the number of those between neighbours, which come first."""
    return bonds_of(specimen, laws_of(specimen), reach), len(specimen.tessellation.shared_edges)


@pytest.mark.parametrize("reach", [1.0, 1.5, 2.0])
def test_each_pair_within_the_range_is_bonded_once(rectangle, reach):
    bonds, neighbours = farther(rectangle, reach)
    plain = bonds_of(rectangle, laws_of(rectangle))
    for name in ("grains", "ends", "areas", "normal_stiffness", "shear_strength"):
        assert np.array_equal(getattr(bonds, name)[:neighbours], getattr(plain, name)), name
    centres, radii = rectangle.centres, rectangle.radii
    first, second = np.triu_indices(len(radii), 1)
    apart = np.hypot(*(centres[second] - centres[first]).T)
    near = apart < reach * (radii[first] + radii[second])
    wanted = set(zip(first[near].tolist(), second[near].tolist(), strict=True))
    wanted |= {(min(pair), max(pair)) for pair in plain.grains.tolist()}
    found = [(min(pair), max(pair)) for pair in bonds.grains.tolist()]
    assert len(found) == len(set(found))
    assert set(found) == wanted  # a rectangle is convex: nothing stands between


def test_a_farther_bond_has_an_edge_as_long_as_the_smaller_disc_across_its_middle(rectangle):
    bonds, neighbours = farther(rectangle, 2.0)
    pairs, ends = bonds.grains[neighbours:], bonds.ends[neighbours:]
    centres, radii = rectangle.centres[pairs], rectangle.radii[pairs]
    smaller = radii.min(axis=1)
    assert bonds.areas[neighbours:] == pytest.approx(2.0 * smaller * rectangle.thickness)
    along, edge = centres[:, 1] - centres[:, 0], ends[:, 1] - ends[:, 0]
    assert np.abs(np.sum(along * edge, axis=1)).max() < 1e-18
    gaps = [np.hypot(*(ends.mean(axis=1) - centres[:, k]).T) - radii[:, k] for k in (0, 1)]
    assert gaps[0] == pytest.approx(gaps[1], abs=1e-15)  # in the middle between both discs


def test_no_bond_crosses_a_hole_or_a_bay():
    bay = [[0.01, 0.02], [0.014, 0.02], [0.014, 0.012], [0.016, 0.012], [0.016, 0.02]]
    hole = [[0.02, 0.005], [0.022, 0.005], [0.022, 0.012], [0.02, 0.012]]
    corners = [[0.0, 0.0], [0.03, 0.0], [0.03, 0.02], *bay[::-1], [0.0, 0.02]]
    specimen = Specimen.polygon(corners, 0.01, seed=4, holes=[hole])
    bonds, neighbours = farther(specimen, 2.0)
    ends = specimen.centres[bonds.grains[neighbours:]]
    inside = [Outline(corners).contains_points(ends[:, k]) for k in (0, 1)]
    ends = ends[inside[0] & inside[1]]  # of sawn grains the disc's centre may lie outside
    assert len(ends) > 50
    shares = np.linspace(0.0, 1.0, 101)[None, :, None]
    points = ((1.0 - shares) * ends[:, None, 0] + shares * ends[:, None, 1]).reshape(-1, 2)
    assert not Outline(hole).contains_points(points, radius=-1e-6).any()
    assert Outline(corners).contains_points(points, radius=1e-6).all()


@pytest.mark.parametrize("model", SPHERE_MODELS)
def test_farther_bonds_are_at_rest_at_first_and_bear_as_their_areas_say(rectangle, model):
    built = fresh(rectangle, "augig-table7", model, interaction_range=2.0)
    bonds, neighbours = farther(rectangle, 2.0)
    assert built.counts()["contacts"] == len(bonds) > neighbours
    built.run(3)
    assert built.elastic_energy() == 0.0
    stiffness = [one.phys.kn for one in built.cracks.interactions]
    assert stiffness == pytest.approx(LAW["normal_stiffness"] * bonds.areas)


def test_a_range_that_adds_no_pair_gives_the_same_bits_and_one_that_does_is_stiffer(rectangle):
    options = {"rate": 8.0, "max_strain": 1e-3}
    runs = [
        flexpm.run("uniaxial", rectangle, "augig-table7", "jcfpm", interaction_range=one, **options)
        for one in (None, 1.0, 2.0)
    ]
    assert runs[0].curve.array.tobytes() == runs[1].curve.array.tobytes()
    assert runs[2].youngs_modulus > 1.5 * runs[0].youngs_modulus


@pytest.mark.parametrize("model", [one for one in MODELS if one not in SPHERE_MODELS])
def test_other_models_refuse_a_range(rectangle, model):
    material = described(flexpm.materials.load("augig-table7"), model)
    with pytest.raises(InputError, match="interaction_range = 1.5, must not be given for model"):
        RunSpec("uniaxial", rectangle.spec, material, model, interaction_range=1.5)
    with pytest.raises(InputError, match="interaction_range = 1.5, must not be given for model"):
        flexpm.build(rectangle, "augig-table7", model, interaction_range=1.5)


@pytest.mark.parametrize("value", [0.99, 2.01, float("nan"), "far"])
def test_a_range_out_of_1_to_2_is_refused(rectangle, value):
    with pytest.raises(InputError, match="interaction_range = "):
        flexpm.build(rectangle, "augig-table7", "jcfpm", interaction_range=value)


def test_a_comparison_says_that_pairs_differ_and_gives_the_range_to_spheres_alone(capsys, tmp_path):
    compare = ["compare", "uniaxial", *SMALL, "--max-strain", "1e-5", "--rate", "50", "--quiet"]
    compare += ["--no-report", "--interaction-range", "1.8", "--out", str(tmp_path)]
    cli.main([*compare, "--models", "rigid,jcfpm"])
    told = capsys.readouterr().out
    assert "jcfpm also bonds pairs within 1.8 (R1 + R2), more pairs than" in told
    given = {
        model: json.loads((tmp_path / model / "result.json").read_text())["inputs"]
        for model in ("rigid", "jcfpm")
    }
    assert (given["rigid"]["interaction_range"], given["jcfpm"]["interaction_range"]) == (None, 1.8)
    refused_command(capsys, "it is for YADE's spheres", *compare, "--models", "rigid,flexible")


def test_studies_give_the_range_to_spheres_and_refuse_it_without_any(tmp_path):
    made = [
        jobs.make({"test": "uniaxial", "model": model, "interaction_range": 1.5}, tmp_path)
        for model in ("rigid", "jcfpm")
    ]
    assert [job.spec.interaction_range for job in made] == [None, 1.5]
    file = tmp_path / "one.toml"
    file.write_text('[common]\ntest = "uniaxial"\nmodel = "rigid"\ninteraction_range = 1.5\n')
    refusal("interaction_range, is used by no model of the study", study.read, file)
