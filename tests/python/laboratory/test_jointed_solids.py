# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens with one joint bear what Jaeger's plane of weakness does. SI units."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scenes import fresh

import flexpm
from flexpm.cli import main as cli

SIDE, HEIGHT = 0.01, 0.02
FRICTION = 0.3
LAW = {
    "normal_stiffness": 1e13,
    "shear_stiffness": 5e12,
    "friction": FRICTION,
    "tensile_strength": 0.0,
}


def rock(**joint):
    """Rock with a joint ``f``, for any size of grains."""
    preset = flexpm.materials.load("augig3d-calibrated", solid=True)
    keys = {f"joint.f.{key}": value for key, value in {**LAW, **joint}.items()}
    return dataclasses.replace(preset, made_for=None).with_set(keys)


def column(dip, direction=90.0):
    """One grain that a joint cuts in two."""
    middle = (0.5 * SIDE, 0.5 * SIDE, 0.5 * HEIGHT)
    sizes = {"width": SIDE, "depth": SIDE, "height": HEIGHT}
    whole = flexpm.Specimen.from_spheres([(*middle, 0.5 * SIDE)], **sizes)
    return whole.with_joints({"f": {"point": middle, "dip": dip, "dip_direction": direction}})


def jaeger(dip, cohesion, confinement=0.0):
    """Axial stress above the confinement at which a plane slides [Pa]."""
    angle = math.radians(dip)
    divisor = (1.0 - FRICTION / math.tan(angle)) * math.sin(2.0 * angle)
    return 2.0 * (cohesion + FRICTION * confinement) / divisor


@pytest.mark.parametrize(("dip", "direction"), [(40.0, 90.0), (50.0, 0.0), (60.0, 90.0)])
def test_a_cohesive_joint_slides_at_jaegers_stress(dip, direction):
    found = flexpm.run(
        "uniaxial", specimen=column(dip, direction), material=rock(cohesion=2e6), rate=0.25
    )
    assert found.peak_stress == pytest.approx(jaeger(dip, 2e6), rel=0.01)


def test_a_joint_without_strength_slides_at_jaegers_stress():
    """T = mu N at small slip: a plateau of the axial stress."""
    pressed = {"confinement": 5e6, "rate": 0.25, "max_strain": 1e-3}
    found = flexpm.run("triaxial", column(50.0), rock(cohesion=0.0), **pressed)
    sliding = found.curve["axial_strain"] > 4e-4
    stress = found.curve["axial_stress"][sliding] - 5e6
    assert np.count_nonzero(sliding) > 10
    assert np.mean(stress) == pytest.approx(jaeger(50.0, 0.0, 5e6), rel=0.01)


@pytest.mark.parametrize(
    ("seed", "dip", "height"),
    [(1, 40.0, 0.016), (3, 50.0, 0.016), pytest.param(3, 60.0, 0.021, marks=pytest.mark.slow)],
)
def test_a_joint_of_a_packed_core_slides_at_jaegers_stress(seed, dip, height):
    """Corners of grains that the plane does not cut are moved into it: no teeth."""
    core = flexpm.Specimen.cylinder(0.008, height, seed=seed)
    cut = core.with_joints({"f": {"point": (0, 0, 0.5 * height), "dip": dip, "dip_direction": 90}})
    assert cut.joint_deviations() == {"f": 0.0}
    pressed = {"confinement": 5e6, "rate": 0.5, "max_strain": 6e-4}
    found = flexpm.run("triaxial", cut, rock(cohesion=0.0), **pressed)
    stress = found.curve["axial_stress"][found.curve["axial_strain"] > 4.5e-4] - 5e6
    assert np.mean(stress) == pytest.approx(jaeger(dip, 0.0, 5e6), rel=0.02)
    assert not any("deviates" in one for one in found.warnings)


def test_a_joint_is_as_stiff_as_its_law_says():
    """A level joint is a spring in series with the rock."""
    material = rock(cohesion=2e6)
    whole = flexpm.Specimen.box(0.008, 0.008, 0.016)
    cut = whole.with_joints({"f": {"point": (0, 0, 0.008), "dip": 0, "dip_direction": 0}})
    alone, both = (flexpm.elastic(one, material)["youngs_modulus"] for one in (whole, cut))
    expected = 1.0 / (1.0 / alone + 1.0 / (LAW["normal_stiffness"] * 0.016))
    assert both == pytest.approx(expected, rel=0.05)
    assert both < 0.9 * alone


def test_a_run_of_a_jointed_core_has_the_same_bits_on_two_threads():
    core = flexpm.Specimen.cylinder(0.008, 0.012)
    cut = core.with_joints({"f": {"point": (0, 0, 0.006), "dip": 50, "dip_direction": 20}})
    found = []
    for threads in (1, 2):
        model = fresh(cut, rock(cohesion=0.0), threads=threads)
        rig = flexpm.rig(model)
        rig.load(flexpm.Loading(kind="waiting", max_strain=1e-3, rate=16.0))
        found.append(model.snapshot())
    assert np.array_equal(found[0].positions, found[1].positions)
    assert found[0].point_traction.any()
    assert np.array_equal(found[0].point_traction, found[1].point_traction)


def test_a_specimen_with_minerals_that_a_run_cuts_is_run_again(tmp_path, capsys):
    """The inputs of the run name the minerals of the file, not those of the parts."""
    box = flexpm.Specimen.box(0.009, 0.009, 0.012)
    solid, joints, out = (tmp_path / name for name in ("solid.json", "f.csv", "out"))
    box.with_minerals([0] * len(box.spheres)).save(solid)
    joints.write_text("x,y,z,dip,dip_direction,name\n0.0045,0.0045,0.006,30,90,f\n")
    call = ["run", "uniaxial", "--specimen", str(solid), "--joints", str(joints), "--no-report"]
    call += ["--set", "joint.f.open=true", "--model", "rigid", "--max-strain", "1e-5", "--quiet"]
    assert cli.main([*call, "--rate", "16", "--out", str(out)]) in (0, 3)
    again = ["rerun", str(out), "--quiet", "--out", str(tmp_path / "again")]
    assert cli.main(again) in (0, 3)
    assert "the same as in" in capsys.readouterr().out


def test_a_specimen_with_joints_needs_their_laws():
    cut = column(50.0)
    with pytest.raises(flexpm.InputError, match=r"has no law; add a table \[joint.f\]"):
        flexpm.build(cut)
    with pytest.raises(flexpm.InputError, match="must be flexible or rigid for a specimen with"):
        flexpm.run("uniaxial", cut, rock(), model="jcfpm")
