# SPDX-License-Identifier: GPL-3.0-or-later
"""Pulses through solids: their speeds, energy, same bits, restart, and what is refused."""

import json

import numpy as np
import pytest
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.results import waves

import yade  # isort: skip  (flexpm tells Python where YADE is)

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
def test_a_pulse_has_the_speed_of_the_continuum(bar, model, wave, free, off):
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


def test_threads_and_a_stop_change_no_bit(bar, tmp_path, monkeypatch):
    asked = {"model": "rigid", "wave": "s", "report": False}
    whole = flexpm.run("sonic", bar, **asked)
    assert same(flexpm.run("sonic", bar, threads=2, **asked), whole)
    assert same(taken_up(monkeypatch, tmp_path, 60, "sonic", bar, **asked), whole)


@pytest.mark.long
def test_threads_and_a_stop_change_no_bit_of_deformable_grains(bar, tmp_path, monkeypatch):
    asked = {"wave": "p", "report": False}
    whole = flexpm.run("sonic", bar, **asked)
    assert same(flexpm.run("sonic", bar, threads=2, **asked), whole)
    assert same(taken_up(monkeypatch, tmp_path, 300, "sonic", bar, **asked), whole)


def test_the_command_tells_the_speed_and_repeats_the_run(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sizes = [f"--{name}={value}" for name, value in SIZES.items()]
    asked = ["run", "sonic", "--shape", "box", *sizes, "--diameters", "2.8e-3,3.2e-3"]
    asked += ["--model", "rigid", "--sides", "free"]
    assert cli.main([*asked, "--quiet", "--out", "bar"]) == 0
    found = json.loads((tmp_path / "bar" / "result.json").read_text())
    assert "speed of the pressure wave" in capsys.readouterr().out
    assert found["vp"] > 2000.0 and found["inputs"]["sides"] == "free"
    assert "--sides free" in (tmp_path / "bar" / "report.html").read_text()
    assert cli.main(["rerun", "bar", "--quiet", "--out", "again", "--no-report"]) == 0
    assert "the same as in" in capsys.readouterr().out


def test_what_no_pulse_has_is_refused(bar):
    with pytest.raises(InputError, match="sides = free, must be held for wave = s"):
        flexpm.run("sonic", bar, wave="s", sides="free")
    with pytest.raises(InputError, match="run: sides = 'loose'"):
        flexpm.run("sonic", bar, sides="loose")
    with pytest.raises(InputError, match="run: model of sonic = 'jcfpm'"):
        flexpm.run("sonic", bar, model="jcfpm")
    with pytest.raises(InputError, match="wavelength = .* must be >= 20"):
        flexpm.run("sonic", Specimen.box(0.009, 0.009, 0.014))
    yade.O.reset()
    built = flexpm.build(bar, dynamic=True)
    with pytest.raises(InputError, match="rig: dynamic = True, must be False for a solid"):
        flexpm.rig(built)
    built.run(3)
    with pytest.raises(ValueError, match=r"resetEnergyBalance: steps = 3, must be 0"):
        built.solver.resetEnergyBalance()
    yade.O.reset()
    with pytest.raises(InputError, match="gravity = 3, refined, 9.8, must be left out for a solid"):
        flexpm.build(bar, dynamic=True, gravity=9.8)
