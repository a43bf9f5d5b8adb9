# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of one's own on all rigs: stages, directions, energies, and what a rig refuses."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import failure, refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.results.measures import energy_error
from flexpm.rigs import rig as rigs
from flexpm.rigs.grain_rig import NodeRig, PlateRig
from flexpm.rigs.rig import TestRig
from flexpm.rigs.sphere_rig import SphereRig

GRAINS = ("flexible", "rigid", "inner")
SPHERES = ("jcfpm", "cohfrict")


@pytest.fixture(scope="module")
def rectangle() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=3)


def rig_of(specimen: flexpm.Specimen, model: str, **options: bool) -> TestRig:
    return flexpm.rig(fresh(specimen, model=model), **options)


def moduli(rig: TestRig, top: float) -> list[float]:
    """Slopes of loading, unloading and reloading, apart from where the ends turn round [Pa]."""
    slopes = []
    for strain in (top, 0.3 * top, 1.2 * top):
        first = len(rig.record)
        rig.strain_to(strain)
        assert rig.strain == pytest.approx(strain, abs=0.01 * rig.reference_strain)
        axial, stress = (rig.record[name][first:] for name in ("axial_strain", "axial_stress"))
        assert (rig.strain, rig.stress) == (axial[-1], stress[-1])
        rows = (axial > 0.4 * top) & (axial < 0.9 * top)
        slopes.append(np.polyfit(axial[rows], stress[rows], 1)[0])
    return slopes


@pytest.mark.long
@pytest.mark.parametrize("model", [*GRAINS, *SPHERES])
def test_an_elastic_specimen_unloads_and_reloads_along_its_line(rectangle, model):
    rig = rig_of(rectangle, model)
    load, unload, reload = moduli(rig, 0.3 * rig.reference_strain)
    assert unload == pytest.approx(load, rel=0.01)
    assert reload == pytest.approx(unload, rel=0.005)
    if model in GRAINS:
        elastic = flexpm.elastic(rectangle, model=model)["youngs_modulus"]
        assert load == pytest.approx(elastic, rel=0.01)
        assert energy_error(rig.record, rig.initial_energy) < 1e-6


@pytest.mark.parametrize("model", ["flexible", "rigid", "jcfpm"])
def test_tension_counts_positive(rectangle, model):
    rig = rig_of(rectangle, model, tension=True)
    rig.strain_to(0.2 * rig.reference_strain)
    centres = rig.built.snapshot()
    moved = (centres.positions - centres.reference)[:, 1]
    upper = centres.reference[:, 1] > 0.016
    assert rig.stress > 0.0
    assert moved[upper].mean() > moved[~upper].mean()


@pytest.mark.parametrize(
    ("model", "kind"), [("flexible", NodeRig), ("rigid", PlateRig), ("jcfpm", SphereRig)]
)
def test_a_test_of_stages_is_the_test_of_that_name(rectangle, model, kind):
    rig = rig_of(rectangle, model)
    assert isinstance(rig, kind)
    rig.confine(3e6)
    kind = "constant" if model == "jcfpm" else "waiting"
    rig.load(flexpm.Loading(rate=8.0, kind=kind, max_strain=3e-4))
    expected = flexpm.run(
        "biaxial", rectangle, model=model, confinement=3e6, rate=8.0, max_strain=3e-4
    )
    assert expected.curve.own == ("volumetric_strain",)
    assert np.array_equal(rig.record.array, expected.curve.array[:, :-1], equal_nan=True)


def test_a_loading_goes_on_to_the_end_after_other_stages(rectangle):
    rig = rig_of(rectangle, "rigid")
    rig.strain_to(0.3 * rig.reference_strain)
    rig.strain_to(0.1 * rig.reference_strain)
    first = len(rig.record)
    rig.load(flexpm.Loading(kind="adaptive"))
    stress, factor = rig.record["axial_stress"], rig.record["velocity_factor"]
    assert stress[-1] < 0.5 * stress.max() <= stress[-2]
    assert set(factor[:first]) == {1.0}
    assert factor[first:].max() > 2.0
    expected = flexpm.run("uniaxial", rectangle, model="rigid")
    assert stress.max() == pytest.approx(expected.peak_stress, rel=0.05)


def test_discs_are_squeezed_between_plates():
    disc = flexpm.Specimen.disc(0.02, thickness=0.08, seed=3)
    for model in ("flexible", "jcfpm"):
        rig = rig_of(disc, model)
        assert rig.kind == "brazilian"
        rig.strain_to(0.2 * rig.reference_strain)
        assert rig.stress > 0.0


def test_a_strain_that_does_not_come_is_refused_in_one_line(rectangle, monkeypatch):
    monkeypatch.setattr(rigs, "_PATIENCE", 0)
    monkeypatch.setattr(rigs, "_LATEST_LOOK", 10)
    rig = rig_of(rectangle, "rigid")
    failure("strain_to: axial strain = .* must come to", rig.strain_to, 1e-4)


def test_only_boundary_nodes_are_preloaded(rectangle):
    with pytest.raises(flexpm.SimulationError, match="must be False for model rigid"):
        rig_of(rectangle, "rigid").load(flexpm.Loading(static=True))


def test_a_loading_that_cannot_be_is_refused(rectangle):
    refusal("kind = 'wating', must be one of constant, adaptive", flexpm.Loading, kind="wating")
    for name, value in (("rate", 0.0), ("max_strain", -1.0), ("stop_ratio", float("nan"))):
        refusal(f"Loading: {name} = ", flexpm.Loading, **{name: value})
    with pytest.raises(InputError, match="kind = waiting, must be adaptive or constant"):
        rig_of(rectangle, "jcfpm").load(flexpm.Loading(kind="waiting"))
