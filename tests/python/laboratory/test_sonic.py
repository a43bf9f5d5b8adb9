# SPDX-License-Identifier: GPL-3.0-or-later
"""Pulses through specimens of 2D and 3D: speeds, energy, ends, and what is refused."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.report import tables
from flexpm.results import waves
from flexpm.results.record import COLUMNS, Curve
from flexpm.runs.run_spec import RunSpec, described
from flexpm.specimens.spec import SpecimenSpec

HEIGHT = 0.04


@pytest.fixture(scope="module")
def slab() -> flexpm.Specimen:
    """Slab of 27 grains over its width and 53 over its height."""
    return flexpm.Specimen.rectangle(0.02, HEIGHT, 0.01, diameters=(5e-4, 1e-3), seed=1)


def continuum(slab: flexpm.Specimen, model: str, wave: str) -> float:
    """Speed by the elastic constants of the same packing [m/s]."""
    found = flexpm.elastic(slab, model=model)
    density = flexpm.materials.load(None, model).law(model)["density"]
    modulus = waves.modulus(wave, found["youngs_modulus"], found["poissons_ratio"])
    return float(np.sqrt(modulus / density))


@pytest.mark.parametrize("wave", ["p", "s"])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_pulse_has_the_speed_of_the_continuum(slab, model, wave):
    result = flexpm.run("sonic", slab, model=model, wave=wave)
    speeds = {"p": result.vp, "s": result.vs}
    # a packing of rigid grains is a little less stiff in shear than its E and nu say, or stiffer
    scatter = 0.015 if (model, wave) == ("rigid", "s") else 0.01
    assert speeds.pop(wave) == pytest.approx(continuum(slab, model, wave), rel=scatter)
    assert [*speeds.values()] == [None]
    (warning,) = result.warnings
    assert warning.startswith("mean diameter of the grains = 0.00075 m")  # finer than calibrated
    assert (result.status, result.failed) == ("ok", False)
    assert result.peak_stress is None and result.youngs_modulus is None
    assert result.tensile_cracks == result.shear_cracks == 0
    # nothing is lost, and nothing pushes
    curve = result.curve
    assert result.energy_error < 1e-6
    assert np.all(curve["boundary_work"] == 0.0) and np.all(curve["damping_energy"] == 0.0)
    assert curve.own == ("near_displacement", "far_displacement", "time")
    # both sections move by the same way: the area of the pulse's velocity over the time
    near, far = curve["near_displacement"][-1], curve["far_displacement"][-1]
    assert far == pytest.approx(near, rel=0.02)
    assert near == pytest.approx(0.5 * 0.4 * HEIGHT * 1e-7, rel=0.05)
    assert np.max(curve["axial_strain"]) == pytest.approx(near / (0.5 * HEIGHT), rel=0.03)


def test_the_centre_of_a_pulse_is_its_mean_time():
    time = np.linspace(0.0, 1.0, 2001)[1:]
    for middle in (0.3, 0.6):
        velocity = np.exp(-(((time - middle) / 0.05) ** 2))
        displacement = np.cumsum(velocity) * time[0]
        assert waves.centre(time, displacement) == pytest.approx(middle, abs=1e-3)


def record_of(last: float) -> Curve:
    """Sections 0.1 m apart, which a step passes at 0.3 and 0.5 s; the upper one goes on at last."""
    curve = Curve((*waves.DISPLACEMENTS, waves.TIME))
    for row, time in enumerate(np.linspace(0.0, 1.0, 501)[1:]):
        near, far = (0.5 * (1.0 + np.tanh((time - at) / 0.05)) for at in (0.3, 0.5))
        values = dict.fromkeys(COLUMNS, 0.0) | {"step": row, "time": time}
        curve.append(**values, near_displacement=near, far_displacement=far + last * time**9)
    return curve


def test_a_pulse_that_has_not_passed_has_no_speed(slab):
    assert waves.speed(record_of(0.0), 0.1) == pytest.approx(0.5, rel=1e-3)
    assert waves.speed(record_of(0.3), 0.1) is None
    assert waves.speed(Curve((*waves.DISPLACEMENTS, waves.TIME)), 0.1) is None
    # an open joint across the middle: no shear comes through
    cut = slab.with_joints({"cut": [[0.0, 0.5 * HEIGHT], [0.02, 0.5 * HEIGHT]]})
    material = flexpm.materials.load("augig-table2-bilinear").with_set({"joint.cut.open": True})
    result = flexpm.run("sonic", cut, material, model="rigid", wave="s")
    assert result.vs is None and result.status == "ok"
    assert any("scattered the pulse" in line for line in result.warnings)


def spec_of(specimen: SpecimenSpec, **options: object) -> RunSpec:
    material = flexpm.materials.load(None)
    return RunSpec("sonic", specimen, described(material, "flexible"), **options)


def test_sonic_has_real_masses_and_a_pulse_of_twenty_grains():
    spec = spec_of(SpecimenSpec())
    assert (spec.wave, spec.dynamic, spec.loading, spec.start) == ("p", True, "constant", "rest")
    assert RunSpec.from_json(spec.to_json()) == spec
    assert spec_of(SpecimenSpec(), wave="s").key() != spec.key()
    for specimen, options, message in (
        (SpecimenSpec(height=0.149), {}, "run: wavelength = 19.9 mean diameters of the grains"),
        (SpecimenSpec(), {"wave": "x"}, "run: wave = 'x'"),
        (SpecimenSpec(), {"rate": 2.0}, "run: rate = 2.0, must not be given for sonic"),
        (SpecimenSpec(), {"max_strain": 1.0}, "run: max_strain = 1.0"),
        (SpecimenSpec(), {"gravity": 9.81}, "run: gravity = 9.81"),
        (SpecimenSpec(), {"model": "inner"}, "run: model of sonic = 'inner'"),
        (SpecimenSpec(), {"confinement": 1e6}, "run: confinement = 1000000.0 Pa"),
    ):
        assert refusal("", spec_of, specimen, **options).startswith(message)
    with pytest.raises(InputError, match="wave = p, must not be given for uniaxial"):
        dataclasses.replace(spec, test="uniaxial", wave="p")


def test_a_given_specimen_of_too_few_grains_is_refused():
    packed = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    given = flexpm.Specimen.from_discs(packed.centres, packed.radii, packed.outline, 0.01)
    refusal("wavelength = .* must be >= 20", flexpm.run, "sonic", given)


ARGUMENTS = ["--width", "0.008", "--height", "0.04", "--diameters", "5e-4,1e-3", "--quiet"]


def test_the_command_tells_the_speed_and_draws_the_pulse(tmp_path, capsys):
    out = tmp_path / "run"
    asked = ["run", "sonic", "--wave", "s", "--model", "rigid", *ARGUMENTS, "--out", str(out)]
    assert cli.main(asked) == 0
    said = capsys.readouterr().out
    found = json.loads((out / "result.json").read_text())
    assert f"speed of the shear wave  {found['vs']:#.5g}".rstrip(".") + " m/s" in said
    assert found["peak_stress"] is None and found["inputs"]["wave"] == "s"
    assert {"curve.png", "report.html", "final.vtu"} <= {one.name for one in out.iterdir()}
    page = (out / "report.html").read_text()
    assert "time [\\u00b5s]" in page or "time [µs]" in page
    assert "--wave s" in page
    assert cli.main(["run", "sonic", *ARGUMENTS, "--frames", "3", "--out", str(tmp_path)]) == 2
    assert "frames = 3, must be 0 for sonic" in capsys.readouterr().err


@pytest.mark.long
def test_comparisons_and_packings_show_speeds(tmp_path, capsys):
    out = tmp_path / "models"
    assert cli.main(["compare", "sonic", *ARGUMENTS, "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "v_p [m/s]" in said and "E [GPa]" not in said
    assert (out / "compare.png").is_file()
    several = ["run", "sonic", "--model", "rigid", "--seeds", "1,2", *ARGUMENTS]
    assert cli.main([*several, "--out", str(tmp_path / "seeds")]) == 0
    assert "standard deviation" in capsys.readouterr().out
    means = (tmp_path / "seeds" / "means.csv").read_text().splitlines()
    assert "vp,vp_deviation,vp_error" in means[0]


def test_the_table_of_a_result_has_the_speed_alone(slab):
    text = tables.result_table(flexpm.run("sonic", slab, model="rigid"))
    assert "speed of the pressure wave" in text
    assert "Young's modulus" not in text and "peak" not in text


#: Some two grains across and 53 high, 260 in all.
SIZES = {"width": 0.0066, "depth": 0.0066, "height": 0.16}
GRAINS = (2.8e-3, 3.2e-3)


@pytest.fixture(scope="module")
def bar():
    return Specimen.box(**SIZES, diameters=GRAINS, seed=1)


def ratio_of(result, found, material, wave, *, free=False):
    """Speed of a result over that of a continuum."""
    young, poisson = found
    modulus = young if free else waves.solid_modulus(wave, young, poisson)
    density = material.law(result.model)["density"]
    return {"p": result.vp, "s": result.vs}[wave] / float(np.sqrt(modulus / density))


@pytest.mark.parametrize(
    ("model", "wave", "free", "off"),
    [
        # two grains across: nu of a third of the bar is off by 2 %
        ("rigid", "p", False, 0.05),
        ("rigid", "s", False, 0.04),
        ("rigid", "p", True, 0.02),
        pytest.param("flexible", "p", False, 0.01, marks=pytest.mark.long),
        pytest.param("flexible", "p", True, 0.01, marks=pytest.mark.long),
        pytest.param("flexible", "s", False, 0.01, marks=pytest.mark.slow),
    ],
)
def test_a_pulse_has_the_speed_of_the_continuum_in_3d(bar, model, wave, free, off):
    # a shear wave is scattered by two grains across
    made = bar if wave == "p" else Specimen.box(0.0095, 0.0095, 0.16, diameters=GRAINS, seed=1)
    solved = flexpm.elastic(made, model=model)
    asked = {"sides": "free"} if free else {}
    result = flexpm.run("sonic", made, model=model, wave=wave, report=False, **asked)
    rock = flexpm.materials.load(None, model, solid=True)
    found = solved["youngs_modulus"], solved["poissons_ratio"]
    assert ratio_of(result, found, rock, wave, free=free) == pytest.approx(1.0, abs=off)
    assert (result.status, result.failed, result.warnings) == ("ok", False, [])
    assert result.peak_stress is None and result.youngs_modulus is None
    assert result.energy_error < 1e-9
    curve = result.curve
    assert np.all(curve["boundary_work"] == 0.0) and np.all(curve["damping_energy"] == 0.0)
    # both sections move by the same way: the area of the pulse's velocity over the time
    near, far = curve["near_displacement"][-1], curve["far_displacement"][-1]
    assert far == pytest.approx(near, rel=0.05)
    assert near == pytest.approx(0.5 * 0.4 * SIZES["height"] * 1e-7, rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(("wave", "free", "off"), [("p", 0, 0.01), ("s", 0, 0.01), ("p", 1, 0.02)])
def test_contacts_that_are_stiff_leave_the_speeds_of_the_elements(wave, free, off):
    rock = flexpm.materials.load("augig-table7")
    law = rock.law("flexible")
    stiff = rock.with_set({"normal_stiffness": 100.0 * law["normal_stiffness"]})
    box = Specimen.box(0.008, 0.008, 0.16, seed=1)
    asked = {"sides": "free"} if free else {}
    result = flexpm.run("sonic", box, stiff, wave=wave, report=False, **asked)
    ratio = ratio_of(result, (law["young"], law["poisson"]), rock, wave, free=bool(free))
    assert ratio == pytest.approx(1.0, abs=off)


@pytest.mark.parametrize("wave", ["p", "s"])
def test_a_pulse_goes_through_a_cylinder_of_rigid_grains(wave):
    core = Specimen.cylinder(0.0095, 0.16, diameters=GRAINS, seed=1)
    solved = flexpm.elastic(core, model="rigid")
    result = flexpm.run("sonic", core, model="rigid", wave=wave, report=False)
    found = solved["youngs_modulus"], solved["poissons_ratio"]
    rock = flexpm.materials.load(None, "rigid", solid=True)
    assert ratio_of(result, found, rock, wave) == pytest.approx(1.0, abs=0.05)
    assert result.energy_error < 1e-9


def test_what_no_pulse_has_is_refused(bar):
    with pytest.raises(InputError, match="sides = free, must be held for wave = s"):
        flexpm.run("sonic", bar, wave="s", sides="free")
    refusal("run: sides = 'loose'", flexpm.run, "sonic", bar, sides="loose")
    refusal("must be False for jcfpm grains in a box", flexpm.run, "sonic", bar, model="jcfpm")
    refusal("wavelength = .* must be >= 20", flexpm.run, "sonic", Specimen.box(0.009, 0.009, 0.014))
    built = fresh(bar, dynamic=True)
    built.run(3)
    with pytest.raises(ValueError, match=r"resetEnergyBalance: steps = 3, must be 0"):
        built.solver.resetEnergyBalance()
