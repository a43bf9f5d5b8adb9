# SPDX-License-Identifier: GPL-3.0-or-later
"""Servo of a loading: what it follows, the same bits again, and what is refused."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh
from step_clock import step_clock

import flexpm
from flexpm.cli.main import main
from flexpm.errors import InputError
from flexpm.results import measures
from flexpm.rigs.part_rig import PartRig
from flexpm.runs.checkpoint import Checkpoint
from flexpm.runs.loading_rate import Loading
from flexpm.runs.run_spec import RunSpec, described
from flexpm.studies import study

LENGTH, HEIGHT = 0.06, 0.012
STRONG = {"tensile_strength": 1e9, "cohesion": 1e9, "tensile_fracture_energy": 1e6}
#: A line across the bar, longer than snaps back: 2 E G / sigma_t^2 is 40 mm.
WEAK = {
    **{"normal_stiffness": 1.8e13, "shear_stiffness": 1.8e13, "tensile_strength": 10e6},
    **{"cohesion": 1e9, "friction": 0.5},
    **{"tensile_fracture_energy": 80.0, "shear_fracture_energy": 1e6},
}


@pytest.fixture(scope="module")
def bar() -> flexpm.Specimen:
    whole = flexpm.Specimen.rectangle(LENGTH, HEIGHT, thickness=0.01, seed=2)
    return whole.with_joints({"weak": [(LENGTH / 2, 0.0), (LENGTH / 2, HEIGHT)]})


def pulled(bar: flexpm.Specimen, model: str = "rigid", threads: int = 1) -> PartRig:
    """The bar between grips and rollers, with gauges."""
    rock = flexpm.materials.load(None, model).with_set(STRONG | {"shear_fracture_energy": 1e6})
    rock = rock.with_set({f"joint.weak.{key}": value for key, value in WEAK.items()}, model)
    rig = PartRig(fresh(bar, rock, model=model, threads=threads))
    left, right = (rig.platen(side, bonded=True, friction=1e6) for side in (3, 1))
    for side in (0, 2):
        rig.platen(side, bonded=True)
    middle, apart = LENGTH / 2, bar.mean_diameter
    rig.gauge("opening", (middle - apart, HEIGHT / 2), (middle + apart, HEIGHT / 2))
    rig.gauge("closing", (middle + apart, HEIGHT / 2), (middle - apart, HEIGHT / 2), along=(1, 0))
    rig.displacement_of("way", right, (1.0, 0.0))
    area = HEIGHT * 0.01
    rig.drive([right], (1.0, 0.0), against=[left], area=area, length=LENGTH, strength=10e6)
    return rig


@pytest.fixture(scope="module")
def opened(bar) -> flexpm.results.record.Curve:
    rig = pulled(bar)
    rig.load(Loading(kind="waiting", control="opening", stop_ratio=0.1))
    assert measures.energy_error(rig.record, rig.initial_energy) < 1e-3
    assert rig.warnings == []
    return rig.record


def test_ends_go_back_while_the_opening_grows(opened):
    way, opening, load = opened["displacement"], opened["opening"], opened["load"]
    peak = int(np.argmax(load))
    assert way[-1] < 0.8 * way[peak]
    assert load[-1] <= 0.1 * load[peak]
    off = np.abs(opening / opened["set_point"] - 1.0)
    assert np.mean(off < 0.02) > 0.95
    assert np.all(np.diff(opened["set_point"]) > 0.0)
    # the line has taken what its law says: G (1 - sigma / sigma_t)
    taken = opened["damage_energy"][-1] / (80.0 * HEIGHT * 0.01)
    assert taken == pytest.approx(1.0 - opened["axial_stress"][-1] / 10e6, rel=0.02)


def test_without_control_the_bar_breaks_at_once(bar, opened):
    rig = pulled(bar)
    rig.load(Loading(kind="waiting", stop_ratio=0.1))
    assert np.all(np.diff(rig.record["displacement"]) >= 0.0)
    assert len(rig.record) < 0.5 * len(opened)
    assert "set_point" not in rig.record.columns


@pytest.mark.parametrize("control", ["way", "load"])
def test_an_elastic_bar_is_loaded_as_without_control(bar, control):
    rig = pulled(bar)
    rig.load(Loading(kind="waiting", control=control, max_strain=2e-4))
    record = rig.record
    row = np.searchsorted(record["axial_strain"], 1.5e-4)
    assert record["set_point"][row] == pytest.approx(record[control][row], rel=0.02)
    speeds = np.diff(record["displacement"][2:row])
    assert speeds.min() > 0.9 * speeds.max()


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_other_threads_and_a_saved_scene_give_the_same_bits(bar, tmp_path, model):
    loading = Loading(kind="waiting", control="opening", max_strain=1e-3)
    records = []
    for threads in (1, 2):
        rig = pulled(bar, model, threads)
        rig.start(loading)
        for step in range(3000):
            if threads == 2 and step == 1700:  # while the ends go back
                yade.O.save(str(tmp_path / "scene.bin"), quiet=True)
                yade.O.load(str(tmp_path / "scene.bin"), quiet=True)
                rig.built.rebind()
                rig = PartRig(rig.built)
            yade.O.step()
        records.append(rig.record.array)
    assert np.array_equal(*records, equal_nan=True)


def test_a_loading_without_control_goes_on_from_one_with_it(bar):
    rig = pulled(bar)
    rig.load(Loading(kind="waiting", control="opening", max_strain=1e-4))
    rows = len(rig.record)
    rig.strain_to(5e-5)
    assert np.all(np.isfinite(rig.record["set_point"][:rows]))
    assert np.all(np.isnan(rig.record["set_point"][rows:]))
    assert rig.strain == pytest.approx(5e-5, rel=0.02)


def test_what_cannot_be_followed_is_refused_in_one_line(bar):
    rig = pulled(bar)
    for control, message in (
        ("nothing", "Loading: control = 'nothing', must be one of load, opening, closing, way"),
        ("displacement", "Loading: control = 'displacement', must be one of"),
        ("closing", "control = closing, must be a measure that increases along the loading"),
    ):
        assert refusal("", rig.load, Loading(kind="waiting", control=control)).startswith(message)
    rig = pulled(bar)
    rig.load(Loading(kind="waiting", control="way", max_strain=1e-5))
    with pytest.raises(InputError, match="must be as in the first loading of the record, way"):
        rig.load(Loading(kind="waiting", control="opening"))
    with pytest.raises(InputError, match="static = True, must be False under control of way"):
        Loading(static=True, control="way")


def test_models_that_damp_all_motions_have_no_servo():
    disc = flexpm.Specimen.disc(0.012, thickness=0.01, seed=1)
    rig = flexpm.rig(fresh(disc, model="rigid"))
    with pytest.raises(InputError, match="control = 'lateral_strain', must be left out here"):
        rig.load(Loading(kind="waiting", control="lateral_strain"))
    rectangle = flexpm.Specimen.rectangle(0.01, 0.02, thickness=0.01, seed=1)
    rig = flexpm.rig(fresh(rectangle, model="cohfrict"))
    with pytest.raises(InputError, match="control, must be left out for model cohfrict"):
        rig.load(Loading(control="lateral_strain"))


@pytest.fixture(scope="module", params=["flexible", "rigid"])
def compressed(request, tmp_path_factory) -> tuple[flexpm.Result, Path]:
    """A brittle specimen under control of its lateral strain."""
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=1)
    folder = tmp_path_factory.mktemp(request.param)
    ask = {"model": request.param, "control": "lateral", "out": folder, "report": False}
    return flexpm.run("uniaxial", specimen, "augig-table2-brittle", **ask), folder


def test_brittle_grains_show_a_branch_of_class_two(compressed):
    result, folder = compressed
    curve = result.curve
    strain, lateral = curve["axial_strain"], curve["lateral_strain"]
    assert result.status == "ok"
    assert result.energy_error < 1e-3
    assert strain[-1] < 0.7 * result.peak_strain
    assert result.softening_slope > 0.0
    assert np.mean(np.abs(lateral / curve["set_point"] - 1.0) < 0.02) > 0.95
    again = flexpm.Result.read(folder)
    assert again.curve.own == ("set_point", "volumetric_strain")
    assert again.inputs["control"] == "lateral"


def test_a_controlled_test_that_was_interrupted_has_the_same_bits(
    compressed, tmp_path, monkeypatch
):
    whole, _ = compressed
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=1)
    ask = {"model": whole.model, "control": "lateral", "out": tmp_path, "report": False}
    peak = int(np.argmax(whole.curve["axial_stress"]))
    end = 0.5 * (whole.curve["step"][peak] + whole.steps)
    save = Checkpoint.save

    def interrupt(self):
        save(self)
        raise KeyboardInterrupt

    step_clock(monkeypatch.setattr, look=10)
    monkeypatch.setattr(Checkpoint, "save", interrupt)
    monkeypatch.setattr(Checkpoint, "due", property(lambda self: yade.O.iter > end))
    with pytest.raises(KeyboardInterrupt):
        flexpm.run("uniaxial", specimen, "augig-table2-brittle", **ask)
    monkeypatch.undo()
    resumed = flexpm.run("uniaxial", specimen, "augig-table2-brittle", **ask, threads=2)
    assert end < resumed.resumed_at < whole.steps
    assert np.array_equal(resumed.curve.array, whole.curve.array, equal_nan=True)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_notched_beam_bends_as_its_notch_opens(model):
    beam = flexpm.Specimen.rectangle(0.056, 0.012, thickness=0.01, seed=1)
    ask = {"model": model, "span": 0.048, "notch": 0.0048, "rate": 2.0}
    result = flexpm.run("bending", beam, **ask, control="cmod")
    curve = result.curve
    assert result.status == "ok"
    assert result.energy_error < 1e-3
    assert np.mean(np.abs(curve["cmod"] / curve["set_point"] - 1.0) < 0.02) > 0.95
    assert curve["displacement"].argmax() < len(curve) - 1 or model == "rigid"
    # all that the load has given has gone somewhere
    names = ("damage", "friction", "damping", "elastic", "kinetic")
    taken = sum(curve[f"{name}_energy"][-1] for name in names)
    ligament = 0.01 * (0.012 - result.notch_depth)
    assert result.fracture_energy == pytest.approx(taken / ligament, rel=0.01)
    usual = flexpm.run("bending", beam, **ask)
    assert result.peak_load == pytest.approx(usual.peak_load, rel=0.01)
    assert curve["damping_energy"][-1] < usual.curve["damping_energy"][-1]


def spec_of(**options: object) -> RunSpec:
    specimen = flexpm.Specimen.rectangle(0.01, 0.02, thickness=0.08, seed=1)
    model = str(options.get("model", "flexible"))
    material = described(flexpm.materials.load(None, model), model)
    return RunSpec("uniaxial", specimen.spec, material, **options)


def test_control_of_the_ends_is_the_default_and_changes_no_key():
    assert spec_of(control="axial") == spec_of()
    assert spec_of(control="axial").key() == spec_of().key() != spec_of(control="lateral").key()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"control": "cmod"}, "run: control = 'cmod'"),
        ({"control": "displacement"}, "run: control = 'displacement'"),
        ({"control": "lateral", "model": "inner"}, "run: control = lateral, must be axial for"),
        ({"control": "lateral", "dynamic": True}, "run: control = lateral, must be axial for"),
        ({"control": "lateral", "start": "static"}, "run: start = static, must be rest with"),
    ],
)
def test_control_that_cannot_be_is_refused_in_one_line(options, message):
    assert refusal("", spec_of, **options).startswith(message)
    with pytest.raises(InputError, match="control = lateral, must not be given for tension"):
        dataclasses.replace(spec_of(), test="tension", start="", control="lateral")


def test_commands_and_studies_take_the_control(tmp_path, capsys):
    size = ["--width", "0.01", "--height", "0.02", "--no-report", "--control", "lateral"]
    both = ["--models", "flexible,rigid", "--out", str(tmp_path / "both")]
    assert main(["compare", "uniaxial", *size, *both]) == 0
    capsys.readouterr()
    assert main(["run", "tension", *size, "--out", str(tmp_path / "out")]) == 2
    assert "control = lateral, must not be given for tension" in capsys.readouterr().err
    file = tmp_path / "study.toml"
    file.write_text(
        "[common]\nwidth = 0.01\nheight = 0.02\n"
        '[grid]\ntest = ["uniaxial", "tension"]\ncontrol = ["axial", "lateral"]\n'
    )
    found = study.read(file).jobs
    # tension has no use for it
    assert sorted((job.spec.test, job.spec.control or "") for job in found) == [
        ("tension", ""),
        ("uniaxial", ""),
        ("uniaxial", "lateral"),
    ]
