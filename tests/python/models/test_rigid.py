# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigid grains and plates through Python: every test to its end, elastic constants, energy."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.models import grains as models
from flexpm.runs.loading_rate import Loading

SIZE = 4e-3
STIFFNESS = 1.08e13


@pytest.fixture(scope="module")
def rectangle() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(width=0.02, height=0.04, thickness=0.08, seed=3)


@pytest.fixture(scope="module")
def disc() -> flexpm.Specimen:
    return flexpm.Specimen.disc(diameter=0.03, thickness=0.08, seed=3)


def squares(nx: int, ny: int) -> flexpm.Specimen:
    centres = [((i + 0.5) * SIZE, (j + 0.5) * SIZE) for j in range(ny) for i in range(nx)]
    corners = [(0, 0), (nx * SIZE, 0), (nx * SIZE, ny * SIZE), (0, ny * SIZE)]
    return flexpm.Specimen.from_discs(centres, [0.5 * SIZE] * len(centres), corners, 0.08)


def energy_is_kept(result: flexpm.Result) -> bool:
    return result.energy_error is not None and result.energy_error < 0.01


def test_a_grid_of_squares_has_the_modulus_of_its_contacts() -> None:
    found = models.elastic(squares(4, 8), "augig-table2-bilinear", "rigid")
    assert found["youngs_modulus"] == pytest.approx(STIFFNESS * SIZE, rel=1e-9)
    assert found["poissons_ratio"] == pytest.approx(0.0, abs=1e-9)
    assert found["triangles"] == 0


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_elastic_solve_takes_the_default_material_of_its_model(
    rectangle: flexpm.Specimen, model: str
) -> None:
    default = flexpm.materials.load(None, model)
    assert models.elastic(rectangle, model=model) == models.elastic(rectangle, default, model)


def test_uniaxial_compression(rectangle: flexpm.Specimen) -> None:
    elastic = models.elastic(rectangle, "augig-table2-bilinear", "rigid")
    result = flexpm.run("uniaxial", rectangle, model="rigid")
    assert result.status == "ok"
    # the first weak points are damaged below a quarter of the peak
    assert result.youngs_modulus == pytest.approx(elastic["youngs_modulus"], rel=0.03)
    assert result.poissons_ratio == pytest.approx(elastic["poissons_ratio"], abs=0.03)
    assert 60e6 < result.peak_stress < 300e6
    assert result.tensile_cracks + result.shear_cracks > 20
    assert energy_is_kept(result)


def test_tension_pulls_through_bonded_plates(rectangle: flexpm.Specimen) -> None:
    result = flexpm.run("tension", rectangle, model="rigid")
    strength = 11.5e6  # of the contacts: no section is stronger
    assert 0.4 * strength < result.peak_stress < 1.05 * strength
    assert result.tensile_cracks > result.shear_cracks
    assert energy_is_kept(result)


def test_biaxial_membrane_keeps_its_pressure(rectangle: flexpm.Specimen) -> None:
    pressure = 4e6
    result = flexpm.run("biaxial", rectangle, model="rigid", confinement=pressure)
    stress = result.curve["axial_stress"]
    peak = int(np.argmax(stress))
    assert result.curve["confinement"][: peak + 1] == pytest.approx(pressure, rel=0.01)
    # the record begins a hundred steps into the axial stage
    modulus = result.youngs_modulus
    start = stress[1] - modulus * result.curve["axial_strain"][1]
    assert start == pytest.approx(pressure, rel=0.6)
    assert stress[0] > pressure
    assert result.peak_stress > 60e6
    assert energy_is_kept(result)
    kinds = [type(engine).__name__ for engine in yade.O.engines]
    assert kinds.count("PlateController") == kinds.count("PressureController") == 1


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_brazilian_disc_splits(disc: flexpm.Specimen, model: str) -> None:
    result = flexpm.run("brazilian", disc, model=model)
    assert 3e6 < result.peak_stress < 40e6
    assert result.tensile_cracks > 0
    assert energy_is_kept(result)
    assert result.youngs_modulus is None
    assert 0.0 < result.contact_width < 0.015
    lower, upper = next(
        engine.plates() for engine in yade.O.engines if type(engine).__name__ == "GrainSolver"
    )
    force = math.pi * 0.03 * 0.08 / 2 * result.curve["axial_stress"][-1]
    assert lower["force"][1] == pytest.approx(force, rel=0.2)
    assert upper["force"][1] == pytest.approx(-force, rel=0.2)


def test_a_disc_whose_bonds_soften_far_is_loaded_past_its_peak() -> None:
    """Its strength follows the fracture energy; the strain of its bonds' strength is a tenth."""
    disc = flexpm.Specimen.disc(diameter=0.02, thickness=0.08, seed=1)
    ductile = flexpm.materials.load(None, "rigid").with_set(["tensile_strength=4e6"], "rigid")
    result = flexpm.run("brazilian", disc, model="rigid", material=ductile, stop_ratio=0.8)
    assert result.status != "no_peak"
    assert result.peak_stress > 12e6


def test_a_disc_is_needed_for_the_brazilian_test(rectangle: flexpm.Specimen) -> None:
    refusal("must be a disc", flexpm.run, "brazilian", rectangle, model="rigid")


def test_rigid_grains_continue_after_loading(tmp_path, rectangle: flexpm.Specimen) -> None:
    built = fresh(rectangle, model="rigid")
    flexpm.rig(built).start(Loading(rate=10.0))
    built.run(150)
    file = str(tmp_path / "scene.yade.gz")
    yade.O.save(file, quiet=True)
    built.run(100)
    straight = built.snapshot().positions
    yade.O.load(file, quiet=True)
    built.rebind()
    built.run(100)
    assert np.array_equal(built.snapshot().positions, straight)
