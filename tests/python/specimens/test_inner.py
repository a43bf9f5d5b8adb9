# SPDX-License-Identifier: GPL-3.0-or-later
"""Inner-particle models: fitted stiffness, elastic inside, all tests to their end."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm import materials
from flexpm.errors import InputError
from flexpm.models import grains as models
from flexpm.report import maps
from flexpm.results.snapshot import Snapshot
from flexpm.specimens import inner_particles as inner

MODELS = ("inner", "inner-un")
PRESET = "augig-table2-bilinear"


@pytest.fixture(scope="module")
def rectangle() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(width=0.012, height=0.024, thickness=0.08, seed=2)


@pytest.fixture(scope="module")
def disc() -> flexpm.Specimen:
    return flexpm.Specimen.disc(diameter=0.016, thickness=0.08, seed=2)


def test_particles_and_contacts_are_about_those_of_the_paper(rectangle: flexpm.Specimen) -> None:
    cells = inner.cells(rectangle)
    grains = len(rectangle.discs)
    assert len(cells.discs) == pytest.approx(26 * grains, rel=0.03)
    outer = np.asarray(cells.outer)
    edges = len(rectangle.tessellation.shared_edges)
    assert 4.0 < outer.sum() / edges < 7.0  # 23977 / 4627 in the paper
    assert np.asarray(cells.grain).max() == grains - 1


@pytest.mark.parametrize("model", MODELS)
def test_the_stiffness_is_fitted_to_the_rock(rectangle: flexpm.Specimen, model: str) -> None:
    found = models.elastic(rectangle, PRESET, model)
    assert found["youngs_modulus"] == pytest.approx(25.8e9, rel=1e-3)
    assert found["poissons_ratio"] == pytest.approx(0.23, abs=1.1e-3)
    assert found["grains"] == len(rectangle.discs)
    assert found["particles"] > 20 * found["grains"]
    assert found["inner_contacts"] > found["contacts"] > len(rectangle.tessellation.shared_edges)


@pytest.mark.long
@pytest.mark.parametrize("model", MODELS)
def test_stepping_agrees_with_the_elastic_solve(rectangle: flexpm.Specimen, model: str) -> None:
    changes = ["tensile_strength=1e9", "cohesion=1e9", "softening=brittle"]
    strong = materials.load(PRESET).with_set(changes, model)
    # the rate refers to the strain of the strength, which the test does not come near
    result = flexpm.run("uniaxial", rectangle, strong, model, rate=0.04, max_strain=1e-3)
    assert result.tensile_cracks == result.shear_cracks == 0
    assert result.youngs_modulus == pytest.approx(25.8e9, rel=0.01)
    assert result.poissons_ratio == pytest.approx(0.23, abs=0.01)


def test_the_fit_follows_its_closed_form() -> None:
    # E = 400 (1 + eta) K, nu = 0.5 - eta: the root and the scale are known
    def solve(material: materials.Material) -> tuple[float, float]:
        chosen = material.elastic["inner"]
        eta = chosen.shear_ratio
        return 400e-6 * (1.0 + eta) * chosen.normal_stiffness, 0.5 - eta

    fitted = inner.fitted(materials.load(PRESET), solve)
    assert fitted.elastic["inner"].shear_ratio == pytest.approx(0.27, abs=1e-3)
    modulus, ratio = solve(fitted)
    assert modulus == pytest.approx(25.8e9, rel=1e-12)
    assert ratio == pytest.approx(0.23, abs=1e-3)


def test_a_fit_that_fails_names_the_range() -> None:
    with pytest.raises(InputError, match="poisson = 0.23, cannot be met"):
        inner.fitted(materials.load(PRESET), lambda material: (1e9, 0.4))


def test_a_given_stiffness_is_not_fitted() -> None:
    given = materials.load(PRESET).with_set(["normal_stiffness=5e13"], "inner")
    assert inner.fitted(given, lambda material: pytest.fail("solved")) is given
    law = given.law("inner")
    assert (law["normal_stiffness"], law["young"]) == (5e13, None)
    assert given.law("flexible")["young"] == 25.8e9
    half = dataclasses.replace(given.elastic["inner"], young=25.8e9)
    with pytest.raises(InputError, match="poisson is missing"):
        inner.fitted(dataclasses.replace(given, elastic={"inner": half}), lambda material: None)


def test_a_material_without_an_inner_set_is_refused(rectangle: flexpm.Specimen) -> None:
    material = materials.load(PRESET)
    rigid = dataclasses.replace(material, elastic={"rigid": material.elastic["rigid"]})
    refusal(r"add a table \[elastic.inner\]", models.elastic, rectangle, rigid, "inner")


def test_a_particle_turns_and_tells_its_grain(rectangle: flexpm.Specimen) -> None:
    built = fresh(rectangle, PRESET, "inner")
    grain = np.asarray(inner.cells(rectangle).grain)
    bodies = [yade.O.bodies[number] for number in built.solver.bodyIds]
    assert [body.shape.parentGrain for body in bodies] == grain.tolist()
    assert all(body.shape.rigid for body in bodies)
    bodies[5].shape.setMotion((1e-7, 0.0, 0.0), 1e-3)
    built.run(1)
    state = bodies[5].state
    assert 2.0 * np.arctan2(state.ori[2], state.ori[3]) == pytest.approx(1e-3, rel=1e-6)
    assert state.displ()[0] == pytest.approx(1e-7, rel=1e-6)


@pytest.mark.long
@pytest.mark.parametrize(
    ("model", "test"),
    [
        ("inner-un", "uniaxial"),
        ("inner", "tension"),
        pytest.param("inner", "uniaxial", marks=pytest.mark.slow),
        pytest.param("inner-un", "tension", marks=pytest.mark.slow),
        pytest.param("inner", "biaxial", marks=pytest.mark.slow),
        pytest.param("inner-un", "biaxial", marks=pytest.mark.slow),
    ],
)
def test_a_test_runs_to_its_end(
    rectangle: flexpm.Specimen, tmp_path, model: str, test: str
) -> None:
    confinement = 4e6 if test == "biaxial" else 0.0
    result = flexpm.run(test, rectangle, model=model, confinement=confinement, rate=4.0)
    if (model, test) in (("inner-un", "uniaxial"), ("inner", "tension"), ("inner-un", "tension")):
        assert result.status in ("ok", "not_quasistatic")
    else:  # particles that interlock may bear more and more up to the last strain
        assert result.status in ("ok", "not_quasistatic", "no_peak")
    assert result.curve["axial_stress"].max() > (3e6 if test == "tension" else 50e6)
    assert result.energy_error < 0.01
    assert result.grains == len(rectangle.discs)
    assert result.material["normal_stiffness"] != 4.9e13  # fitted
    only_between_grains_break(result, tmp_path)


def only_between_grains_break(result: flexpm.Result, folder) -> None:
    solver = next(e for e in yade.O.engines if type(e).__name__ == "GrainSolver")
    snapshot = Snapshot(**solver.snapshot())
    broken = sorted({crack.contact for crack in result.cracks})
    assert broken
    grains = snapshot.contact_grains[np.isin(snapshot.contact, broken)]
    assert np.all(grains[:, 0] != grains[:, 1])
    within = snapshot.contact_grains[:, 0] == snapshot.contact_grains[:, 1]
    assert np.all(snapshot.point_damage[within[snapshot.point_contact]] == 0.0)
    maps.crack_picture(folder / "cracks.png", snapshot)


@pytest.mark.long
@pytest.mark.parametrize("model", ["inner", pytest.param("inner-un", marks=pytest.mark.slow)])
def test_brazilian_disc(disc: flexpm.Specimen, model: str) -> None:
    result = flexpm.run("brazilian", disc, model=model, rate=4.0)
    assert 2e6 < result.peak_stress < 60e6
    assert result.tensile_cracks > 0
    assert result.energy_error < 0.01
