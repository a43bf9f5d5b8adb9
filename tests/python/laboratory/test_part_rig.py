# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs of parts, and bending: forces, works, beams, gauges, and what is refused."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.kinds import toughness
from flexpm.laboratory.part_tests import notch_depth, prepared
from flexpm.report import tables
from flexpm.rigs.part_rig import PartRig
from flexpm.rigs.parts import Part
from flexpm.runs.run_spec import TESTS, RunSpec, described

HEIGHT = 0.012
SPAN = 0.048
STRONG = flexpm.materials.load("augig-table7").with_set(
    tensile_strength=1e9,
    cohesion=1e9,
    tensile_fracture_energy=1e6,
    shear_fracture_energy=1e6,
)


@pytest.fixture(scope="module")
def beam() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(0.056, HEIGHT, thickness=0.01, seed=1)


def bent(beam: flexpm.Specimen, model: str) -> tuple[PartRig, list[Part]]:
    """A beam of unbreakable contacts on two rollers and below a pin."""
    rig = PartRig(fresh(beam, STRONG, model=model))
    middle = 0.5 * beam.dimensions["width"]
    rollers = [rig.support((middle + side * SPAN / 2, 0.0)) for side in (-1, 1)]
    head = rig.support((middle, HEIGHT), pinned=True)
    rig.gauge("under", (middle - 0.003, 0.0), (middle + 0.003, 0.0), strain=True)
    rig.displacement_of("down", head, (0.0, -2.0))
    rig.drive([head], (0.0, -1.0), against=rollers)
    return rig, [*rollers, head]


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_an_elastic_beam_bends_as_timoshenko_says(beam, model):
    rig, parts = bent(beam, model)
    rig.strain_to(2e-6, rate=5e-4)
    record = rig.record
    load, way = record["load"][-1], record["displacement"][-1]
    # stiffness: in equilibrium that of the elastic solution
    assert load / way == pytest.approx(rig.scales().modulus, rel=0.02)
    young, poisson = (
        flexpm.elastic(beam, STRONG, model=model)[name]
        for name in ("youngs_modulus", "poissons_ratio")
    )
    area, inertia = 0.01 * HEIGHT, 0.01 * HEIGHT**3 / 12.0
    shear = 5.0 / 6.0 * area * young / (2.0 + 2.0 * poisson)
    contacts = 1.5 / (STRONG.law(model)["normal_stiffness"] * parts[2].width * 0.01)
    bending = SPAN**3 / (48.0 * young * inertia) + SPAN / (4.0 * shear)
    # four grains over the height, and supports of half a grain
    assert way / load == pytest.approx(bending + contacts, rel=0.25)
    # strain of the lower fibre: below the load a little less than M / (W E)
    fibre = load * SPAN / 4.0 / (0.01 * HEIGHT**2 / 6.0) / young
    assert 0.6 * fibre < record["under"][-1] < 1.1 * fibre
    assert np.array_equal(record["down"], record["displacement"])


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_forces_of_parts_balance_and_their_work_is_the_energy(beam, model):
    rig, parts = bent(beam, model)
    rig.strain_to(2e-6, rate=5e-4)
    record = rig.record
    x, y = np.sum([part.force for part in parts], axis=0)
    load = record["load"][-1]
    assert abs(x) < 0.02 * load
    assert abs(y) < 0.02 * load
    assert parts[2].force[1] == pytest.approx(-load, rel=0.02)
    assert parts[2].work == pytest.approx(0.5 * load * record["displacement"][-1], rel=0.02)
    work = sum(part.work for part in parts)
    kept = sum(record[f"{name}_energy"][-1] for name in ("elastic", "kinetic", "damping"))
    assert work == pytest.approx(kept, rel=0.02)
    assert parts[2].displacement[1] == pytest.approx(-record["displacement"][-1], rel=0.02)
    assert parts[0].position[1] == pytest.approx(0.0, abs=1e-9)
    assert rig.warnings == []


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_energies_of_each_row_are_the_boundary_work_and_that_is_the_work_of_the_parts(beam, model):
    """At four times the rate the elastic start was missing: 9 to 19 % of the work."""
    rig = PartRig(fresh(beam, model=model))
    middle = 0.5 * beam.dimensions["width"]
    parts = [rig.support((middle + side * SPAN / 2, 0.0)) for side in (-1, 1)]
    parts.append(rig.support((middle, HEIGHT), pinned=True))
    rig.drive(parts[2], (0.0, -1.0), against=parts[:2])
    rig.load(flexpm.Loading(kind="waiting", rate=4.0))
    record = rig.record
    kinds = ("kinetic", "elastic", "damage", "friction", "damping", "drag", "potential")
    energies = np.sum([record[f"{kind}_energy"] for kind in kinds], axis=0)
    work = record["boundary_work"]
    assert energies == pytest.approx(work, rel=0.0, abs=1e-3 * work[-1])
    assert rig.initial_energy == 0.0
    assert (
        work[0] > 0.0
    )  # the elastic start, small since a loading of one's own begins slowly (D58)
    done = sum(part.work for part in parts)
    assert done == pytest.approx(work[-1], rel=2e-3)
    assert rig.motion_energy == pytest.approx(work[-1] - done, rel=1e-9)


def test_a_loading_finds_its_own_rate_and_ends_after_the_peak(beam):
    rig = PartRig(fresh(beam, model="rigid"))
    middle = 0.5 * beam.dimensions["width"]
    rollers = [rig.support((middle + side * SPAN / 2, 0.0)) for side in (-1, 1)]
    head = rig.support((middle, HEIGHT), pinned=True)
    rig.drive([head], (0.0, -1.0), against=rollers)
    rig.load(flexpm.Loading(kind="waiting"))
    load = rig.record["load"]
    assert load[-1] <= 0.5 * load.max()
    assert rig.warnings == []
    # nominal bending strength of about one to three tensile strengths
    stress = 1.5 * load.max() * SPAN / (0.01 * HEIGHT**2)
    assert 1.0 < stress / rig.built.material.law("rigid")["tensile_strength"] < 4.0


def test_yade_plots_the_columns_by_their_names(beam):
    from yade import plot

    rig, _ = bent(beam, "rigid")
    rig.strain_to(2e-6, rate=5e-4)
    rig.to_yade_plot()
    assert plot.data["under"] == rig.record["under"].tolist()
    assert set(rig.record.columns) <= set(plot.data)
    assert len(plot.data["load"]) == len(rig.record) > 1
    plot.reset()


def test_what_a_rig_cannot_do_is_refused_in_one_line(beam):
    rig, _ = bent(beam, "rigid")
    for wrong, message in (
        (lambda: rig.support((0.02, 0.006)), "support: edges at a support = 0"),
        (lambda: rig.support((0.03, 0.0), -1.0), "support: length = -1.0 m"),
        (lambda: rig.platen(7), "platen: side = 7"),
        (lambda: rig.gauge("load", (0, 0), (0.01, 0)), "gauge = 'load'"),
        (lambda: rig.gauge("under", (0, 0), (0.01, 0)), "gauge = 'under'"),
        (lambda: rig.gauge("here", (0, 0), (0, 0)), "gauge here: length of a gauge = 0"),
        (lambda: rig.drive([], (0.0, 0.0)), "drive: length of its direction = 0"),
    ):
        refusal(message, wrong)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_pressed_part_is_driven_on_while_the_other_one_presses(model):
    """A square under one pressure from all sides, then more from above: its modulus."""
    side, pressure = 0.02, 5e6
    square = flexpm.Specimen.rectangle(side, side, thickness=0.01, seed=1)
    rig = PartRig(fresh(square, STRONG, model=model))
    floor, right, top, left = (rig.platen(number) for number in range(4))
    for part in (top, right):
        rig.press(part, pressure)
    rig.press(top, pressure)  # once more: the same pressure, not twice of it
    area = side * 0.01
    assert top.force[1] == pytest.approx(-pressure * area, rel=0.03)
    rig.drive(top, (0.0, -1.0), against=floor, area=area, length=side, strength=4.0 * pressure)
    rig.stress_to(4.0 * pressure)
    record = rig.record
    stress, strain = record["axial_stress"], record["axial_strain"]
    assert stress[0] == pytest.approx(pressure, rel=0.1)
    assert stress[-1] == pytest.approx(4.0 * pressure, rel=5e-3)
    assert abs(strain[0]) < 0.1 * strain[-1]
    assert right.force[0] == pytest.approx(-pressure * area, rel=0.02)
    assert left.force[0] == pytest.approx(pressure * area, rel=0.03)
    # the lateral pressure stays: the slope is Young's modulus, a little less by the contacts
    young = flexpm.elastic(square, STRONG, model=model)["youngs_modulus"]
    slope = (stress[-1] - stress[0]) / (strain[-1] - strain[0])
    assert 0.8 * young < slope < 1.05 * young
    refusal("press: part = platen at .*, is driven, must not be", rig.press, top, pressure)
    rig.stress_to(2.0 * pressure)  # and back
    assert rig.stress == pytest.approx(2.0 * pressure, rel=5e-3)


def spec_of(beam: flexpm.Specimen, model: str, **options: float) -> RunSpec:
    material = flexpm.materials.load(None, model)
    return RunSpec("bending", beam.spec, described(material, model), model, **options)


@pytest.fixture(scope="module", params=["flexible", "rigid"])
def broken(request, beam, tmp_path_factory) -> tuple[flexpm.Result, Path]:
    """A notched beam broken through."""
    folder = tmp_path_factory.mktemp(request.param)
    options = {"model": request.param, "span": SPAN, "notch": 0.4 * HEIGHT, "rate": 2.0}
    return flexpm.run("bending", beam, **options, out=folder, report=False), folder


def test_bending_measures_toughness_and_fracture_energy(broken, beam):
    result, folder = broken
    assert result.status == "ok"
    curve = result.curve
    assert curve.own == ("load", "displacement", "cmod")
    assert result.peak_load == curve["load"].max()
    nominal = 1.5 * result.peak_load * SPAN / (0.01 * (HEIGHT - result.notch_depth) ** 2)
    assert result.peak_stress == pytest.approx(nominal, rel=1e-9)
    assert result.fracture_toughness == pytest.approx(
        toughness.bending_toughness(
            result.peak_load, span=SPAN, height=HEIGHT, thickness=0.01, notch=result.notch_depth
        )
    )
    # the beam's own work ends as energy; what it gives beyond damage is small
    ligament = 0.01 * (HEIGHT - result.notch_depth)
    work = curve["boundary_work"][-1] / ligament
    assert result.fracture_energy == pytest.approx(work, rel=0.15)
    dissipated = (curve["damage_energy"][-1] + curve["friction_energy"][-1]) / ligament
    assert dissipated < result.fracture_energy
    assert curve["cmod"][-1] > 2.0 * curve["cmod"][int(np.argmax(curve["load"]))] > 0.0
    assert result.energy_error < 1e-3
    assert result.youngs_modulus is None and result.poissons_ratio is None
    assert json.loads((folder / "result.json").read_text())["inputs"]["notch"] == 0.4 * HEIGHT
    text = tables.result_table(result)
    assert f"fracture toughness          {result.fracture_toughness / 1e6:.4g}" in text
    again = flexpm.Result.read(folder)
    assert again.curve.own == curve.own
    assert np.array_equal(again.curve.array, curve.array, equal_nan=True)


def test_the_notch_is_as_deep_as_it_was_cut(beam):
    spec = spec_of(beam, "flexible", span=SPAN, notch=0.4 * HEIGHT)
    cut, material = prepared(spec, beam, flexpm.materials.load("augig-table7"))
    assert notch_depth(cut) == pytest.approx(0.4 * HEIGHT, abs=0.5 * beam.mean_diameter)
    assert [law["open"] for law in material.joint_laws("flexible")] == [True]
    assert notch_depth(beam) == 0.0


LAW = {"normal_stiffness": 1.8e14, "shear_stiffness": 5e13, "friction": 0.5}


@pytest.mark.parametrize(
    ("line", "law", "notch", "message"),
    [
        ([(0.03, 0.003), (0.036, 0.006)], {**LAW, "cohesion": 2.9e7}, None, "strength = 2.9e"),
        ([(0.03, 0.003), (0.036, 0.006)], LAW, None, "begins .* m above the bottom"),
        ([(0.036, 0.0), (0.036, 0.006)], {"open": True}, None, "is .* m away from the middle"),
        ([(0.03, 0.012), (0.03, 0.006)], {"open": True}, None, "begins .* m above the bottom"),
        (
            [(0.03, 0.0), (0.03, 0.005)],
            {"open": True},
            0.004,
            "is given in addition to the notch of 0.004 m",
        ),
    ],
)
def test_a_joint_named_notch_that_is_none_is_refused(beam, line, law, notch, message):
    """Its depth and the toughness were those of whatever bore the name."""
    rock = flexpm.materials.load("augig-table7")
    rock = rock.with_set({f"joint.notch.{key}": value for key, value in law.items()}, "flexible")
    cut = beam.with_joints({"notch": line})
    with pytest.raises(InputError, match=f"joint notch: {message}") as refused:
        flexpm.run("bending", cut, rock, span=SPAN, notch=notch)
    assert "give it another name" in str(refused.value)
    # elsewhere it is a name like any other
    assert flexpm.build(cut, rock).counts()["contacts"] > 0


def test_an_open_joint_from_the_bottom_in_the_middle_is_a_notch(beam):
    rock = flexpm.materials.load("augig-table7").with_set({"joint.notch.open": True}, "flexible")
    middle = 0.5 * beam.dimensions["width"]
    cut = beam.with_joints({"notch": [(middle, -0.001), (middle, 0.4 * HEIGHT)]})
    spec = dataclasses.replace(
        spec_of(beam, "flexible", span=SPAN),
        specimen=cut.spec,
        material=described(rock, "flexible"),
    )
    same, _ = prepared(spec, cut, rock)
    assert same is cut
    assert notch_depth(cut) == pytest.approx(0.4 * HEIGHT, abs=0.5 * beam.mean_diameter)


def test_handbook_functions_agree():
    """Guinea's function against Srawley's for span 4 and Brown and Srawley's for span 8."""
    for ratio in np.arange(0.2, 0.61, 0.1):
        srawley = (1.99 - ratio * (1 - ratio) * (2.15 - 3.93 * ratio + 2.7 * ratio**2)) * (
            np.sqrt(ratio) / ((1 + 2 * ratio) * (1 - ratio) ** 1.5)
        )
        assert toughness.bending_function(ratio, 4.0) == pytest.approx(srawley, rel=0.003)
        powers = ratio ** np.arange(5)
        brown = np.sqrt(np.pi * ratio) * (powers @ [1.106, -1.552, 7.71, -13.53, 14.23])
        assert toughness.bending_function(ratio, 8.0) == pytest.approx(brown, rel=0.008)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"span": 0.06}, "run: span = 0.06 m, must be < 0.056"),
        ({"span": 1e-3}, "run: span = 0.001 m, must be > 0.003: both supports are more"),
        ({"notch": HEIGHT}, "run: notch = 0.012 m"),
        ({"span": 0.02, "notch": 0.004}, "run: span = 0.02 m, must be >= 0.03 m for a notched"),
        ({"confinement": 1e6}, "run: confinement = 1000000.0 Pa, must be 0 for bending"),
    ],
)
def test_beams_out_of_range_are_refused_in_one_line(beam, options, message):
    assert refusal("", spec_of, beam, "flexible", **options).startswith(message)


def test_bending_is_for_flexible_and_rigid_grains_and_has_its_own_options(beam):
    refusal("model of bending = 'inner'", spec_of, beam, "inner")
    with pytest.raises(InputError, match="span = 0.01 m, must not be given for uniaxial"):
        dataclasses.replace(spec_of(beam, "rigid"), test="uniaxial", span=0.01)
    spec = RunSpec.from_options("bending", {"length": 0.2}, flexpm.materials.load(None))
    assert (spec.specimen.width, spec.specimen.height) == (0.2, 0.04)
    assert (spec.span, spec.notch, spec.stop_ratio) == (0.16, 0.0, 0.1)
    wide = RunSpec.from_options("bending", {"width": 0.3}, flexpm.materials.load(None))
    assert wide.specimen.width == 0.3
    assert RunSpec.from_json(spec_of(beam, "rigid", span=SPAN).to_json()).span == SPAN
    assert "bending" in TESTS


def test_a_rig_of_parts_refuses_a_model_or_a_test_without_a_rate(beam):
    yade.O.reset()
    with pytest.raises(InputError, match="test of model inner = 'own', must be one of"):
        PartRig(flexpm.build(beam, model="inner"))
    yade.O.reset()
    with pytest.raises(InputError, match="test of model rigid = 'pull', must be one of"):
        PartRig(flexpm.build(beam, model="rigid"), kind="pull")


@pytest.mark.parametrize(
    ("test", "sizes", "notch", "across"),
    [
        ("bending", (0.06, 0.012), None, 4.0),
        ("bending", (0.1, 0.02), None, 6.7),
        ("bending", (0.1, 0.02), 0.006, 4.9),
        ("uniaxial", (0.012, 0.024), None, 4.0),
        ("uniaxial", (0.02, 0.04), None, 6.7),
        ("sonic", (0.012, 0.16), None, None),
    ],
)
def test_few_grains_across_are_said(test, sizes, notch, across):
    """The strength of a beam of four grains rested on one contact, without a word."""
    specimen = flexpm.Specimen.rectangle(*sizes, 0.01)
    options = {} if test == "sonic" else {"max_strain": 1e-5, "rate": 4.0}
    result = flexpm.run(test, specimen, notch=notch, **options)
    assert result.grains_across == (None if across is None else pytest.approx(across, abs=0.3))
    told = [line for line in result.warnings if line.startswith("grains_across = ")]
    assert bool(told) == (across is not None and across < 6.0)
