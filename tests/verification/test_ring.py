# SPDX-License-Identifier: GPL-3.0-or-later
"""A thick ring under a fluid inside and outside against Lame's stresses."""

from __future__ import annotations

import numpy as np
import pytest

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

INNER, OUTER = 0.02, 0.04
#: Grains over the wall, and corners of each circle.
ACROSS, CORNERS = 6, 72


def lame(radius: np.ndarray, inside: float, outside: float) -> np.ndarray:
    """Radial and hoop stress, tension positive [Pa]."""
    square = OUTER**2 - INNER**2
    even = (inside * INNER**2 - outside * OUTER**2) / square
    uneven = (inside - outside) * INNER**2 * OUTER**2 / square / radius**2
    return np.column_stack([even - uneven, even + uneven])


def polar(state: flexpm.Snapshot) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Radius, radial and hoop stress, and area of each triangle."""
    corners = state.reference[state.triangles]
    x, y = corners.mean(axis=1).T
    radius = np.hypot(x, y)
    c, s = x / radius, y / radius
    xx, yy, xy = state.triangle_stress.T
    radial = xx * c**2 + yy * s**2 + 2.0 * xy * c * s
    hoop = xx * s**2 + yy * c**2 - 2.0 * xy * c * s
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return radius, np.column_stack([radial, hoop]), one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]


def misfit(state: flexpm.Snapshot, inside: float, outside: float) -> float:
    """Largest error of the means in rings one grain wide, over the largest stress [-]."""
    radius, stress, area = polar(state)
    wanted = lame(radius, inside, outside)
    rings = np.floor((radius - INNER) / (OUTER - INNER) * ACROSS).astype(int)
    errors = [
        np.average((stress - wanted)[rings == ring], axis=0, weights=area[rings == ring])
        for ring in range(ACROSS)
    ]
    return float(
        np.abs(errors).max() / np.abs(lame(np.array([INNER, OUTER]), inside, outside)).max()
    )


@pytest.mark.long
def test_a_thick_ring_under_a_fluid_has_the_stresses_of_lame():
    yade.O.reset()
    angles = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    size = (OUTER - INNER) / ACROSS
    sizes = (0.9 * size, 1.1 * size)
    ring = flexpm.Specimen.polygon(
        OUTER * circle, 0.01, holes=[INNER * circle], diameters=sizes, seed=1
    )
    rock = flexpm.materials.load("augig-table7")
    stiff = {"normal_stiffness": 100.0 * rock.law("flexible")["normal_stiffness"]}
    strong = {"tensile_strength": 1e10, "cohesion": 1e10, "softening": "brittle"}
    rig = flexpm.PartRig(flexpm.build(ring, rock.with_set({**stiff, **strong}), mesh="fan"))
    rig.fluid(10e6, hole=0)
    assert misfit(rig.built.snapshot(), 10e6, 0.0) < 0.01
    rig.fluid(20e6, side=range(CORNERS))
    assert misfit(rig.built.snapshot(), 10e6, 20e6) < 0.01
    energies = rig.built.solver.energies()
    kept = sum(energies[f"{name}_energy"] for name in ("kinetic", "elastic", "damping"))
    assert energies["boundary_work"] == pytest.approx(kept, rel=1e-6)
