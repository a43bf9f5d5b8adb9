# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression across a cohesionless joint, confined or not: the single plane of weakness."""

import math

import numpy as np
import pytest

import flexpm

CONFINEMENT, FRICTION = 4e6, 0.5  # [Pa], [-]
WEAK = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": FRICTION}
WEAK |= {"cohesion": 0.0, "tensile_strength": 0.0}


def strength(dip, confinement=CONFINEMENT):
    """Axial stress at which a joint slides that dips by an angle [degrees] to the horizontal [Pa].

    Jaeger, Cook and Zimmerman, Fundamentals of Rock Mechanics, 4th ed., 2007, Sec. 4.8.
    """
    angle = math.radians(dip)
    divisor = (1.0 - FRICTION / math.tan(angle)) * math.sin(2.0 * angle)
    return confinement * (1.0 + 2.0 * FRICTION / divisor)


def cut(specimen, dip):
    """A rectangle with a joint through its middle, from side to side."""
    width, height = specimen.dimensions["width"], specimen.dimensions["height"]
    middle = np.array([0.5 * width, 0.5 * height])
    half = 0.5 * width * np.array([1.0, math.tan(math.radians(dip))])
    return specimen.with_joints({"weak": [[middle - half, middle + half]]})


def material(model="flexible"):
    preset = "augig-table7" if model == "flexible" else "augig-table2-bilinear"
    keys = [f"joint.weak.{key}={value}" for key, value in WEAK.items()]
    return flexpm.materials.load(preset).with_set(keys, model)


def sliding_stress(specimen, dip, rate, model="flexible", confinement=CONFINEMENT, **options):
    """Axial stress once the joint has begun to slide, over that of the theory [-]."""
    result = flexpm.run(
        "biaxial",
        cut(specimen, dip),
        material(model),
        model=model,
        confinement=confinement,
        rate=rate,
        **{"max_strain": 2.5e-10 * confinement, **options},
    )
    assert len(result.cracks) == 0
    return result.curve["axial_stress"][-1] / strength(dip, confinement)


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_joint_slides_at_the_stress_of_the_plane_of_weakness(seed):
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, 0.02, seed=seed)
    assert sliding_stress(specimen, 45.0, 0.4) == pytest.approx(1.0, abs=0.01)


@pytest.mark.long
@pytest.mark.parametrize(("dip", "seed"), [(35.0, 1), (45.0, 1), (50.0, 1), (60.0, 1)])
def test_the_stress_is_that_of_each_dip(dip, seed):
    """At 60 degrees grains have given way to the joint, which would interlock if it bent (D35)."""
    specimen = flexpm.Specimen.rectangle(0.03, 0.06, 0.02, seed=seed)
    assert sliding_stress(specimen, dip, 0.25) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    ("dip", "seed", "confinement"),
    [
        pytest.param(dip, seed, confinement, marks=pytest.mark.long if often else pytest.mark.slow)
        for dip, seed, confinement, often in (
            (35.0, 1, 2e6, True),
            (40.0, 2, 2e6, False),
            (50.0, 1, 2e6, False),
            (55.0, 1, 2e6, False),
            (60.0, 2, 2e6, True),
            (40.0, 2, 4e6, False),
            (55.0, 1, 4e6, False),
        )
    ],
)
def test_the_stress_grows_with_the_confinement(dip, seed, confinement):
    specimen = flexpm.Specimen.rectangle(0.03, 0.06, 0.02, seed=seed)
    found = sliding_stress(specimen, dip, 0.25, confinement=confinement)
    assert found == pytest.approx(1.0, abs=0.01)


@pytest.mark.long
def test_without_confinement_the_blocks_slide_off():
    """Then nothing holds them; as the load begins they bear 2 % of what the rock does."""
    whole = flexpm.Specimen.rectangle(0.02, 0.04, 0.02, seed=1)
    result = flexpm.run("uniaxial", cut(whole, 45.0), material(), rate=0.4, max_strain=5e-4)
    assert len(result.cracks) == 0
    stress = result.curve["axial_stress"]
    assert stress.max() < 3e6
    assert abs(stress[-1]) < 1e4


@pytest.mark.slow
def test_rigid_grains_slide_at_the_stress_of_the_plane_of_weakness():
    """In a wide specimen: the plate that lies across the joint presses on one block alone."""
    specimen = flexpm.Specimen.rectangle(0.08, 0.16, 0.02, seed=1)
    found = sliding_stress(specimen, 45.0, 0.25, "rigid", max_strain=0.0015)
    assert found == pytest.approx(1.0, abs=0.05)


@pytest.mark.long
@pytest.mark.parametrize("dip", [10.0, 20.0])
def test_a_joint_that_dips_less_than_its_friction_angle_weakens_within_the_scatter(dip):
    peaks = []
    for seed in (1, 2, 3):
        specimen = flexpm.Specimen.rectangle(0.02, 0.04, 0.02, seed=seed)
        peaks.append(
            [
                flexpm.run(
                    "biaxial", one, material(), confinement=CONFINEMENT, stop_ratio=0.9
                ).peak_stress
                for one in (specimen, cut(specimen, dip))
            ]
        )
    whole, jointed = np.mean(peaks, axis=0)
    scatter = np.std(peaks, axis=0, ddof=1)[0]
    assert abs(jointed - whole) < scatter
