# SPDX-License-Identifier: GPL-3.0-or-later
"""A borehole under a pressure that grows while the other one stays, beside Kirsch's solution."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import flexpm  # isort: skip  (first: it makes YADE importable)

from scenes import fresh

from flexpm.results.snapshot import Snapshot
from flexpm.rigs.parts import Part

#: Ten grains across the hole, which is a tenth of the side.
SIDE, RADIUS, AROUND, RINGS = 0.04, 0.002, 32, 13
THICKNESS = 0.01
CONFINING, GREATEST = 5e6, 15e6
SECTORS = np.radians(np.arange(0.0, 360.0, 15.0))
REACH = 1.15  # radii


def cells() -> list[np.ndarray]:
    """Rings of cells around the hole, staggered like bricks, that grow towards the square."""
    half, count = 0.5 * SIDE, 2 * AROUND
    angles = np.arange(count) * np.pi / AROUND
    ends = np.column_stack([np.cos(angles), np.sin(angles)])
    square = half / np.abs(ends).max(axis=1)

    def corner(ring: int, number: int) -> np.ndarray:
        number %= count
        reach = RADIUS * (square[number] / RADIUS) ** (ring / RINGS)
        place = half + reach * ends[number]
        return np.round(place, 12) if ring == RINGS else place

    return [
        np.array(
            [corner(ring + 1, first + n) for n in range(3)]
            + [corner(ring, first + n) for n in (2, 1, 0)]
        )
        for ring in range(RINGS)
        for first in range(ring % 2, count, 2)
    ]


def radius() -> float:
    """Radius of a circle with the hole's area [m]."""
    part = np.pi / AROUND
    return RADIUS * np.sqrt(np.sin(part) / part)


def by_sector(angle: np.ndarray, values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Weighted means in sectors of 15 degrees, the first one around the x axis."""
    width = SECTORS[1]
    number = np.floor(angle / width + 0.5).astype(int) % len(SECTORS)
    sums = [np.bincount(number, one, len(SECTORS)) for one in (values * weights, weights)]
    return sums[0] / sums[1]


def measured(state: Snapshot) -> np.ndarray:
    """Mean hoop stress of the grains in each sector, compression positive [Pa]."""
    distance, angle = np.meshgrid(
        np.linspace(0.99, REACH, 80), np.radians(np.arange(0.0, 360.0, 0.25)) + 1e-3
    )
    distance, angle = distance.ravel(), angle.ravel()
    middle = np.full(2, 0.5 * SIDE)
    ways = np.column_stack([np.cos(angle), np.sin(angle)])
    found = state.stress_at(middle + radius() * distance[:, None] * ways)
    assert 0 < found.missing < 0.1 * len(found)  # between the circle and the corners of the hole
    there = np.isfinite(found.xx)
    hoop = -found.polar(middle).hoop
    return by_sector(angle[there], hoop[there], distance[there])


def kirsch(across: float, along: float) -> np.ndarray:
    """Its means over the same sectors, for pressures along x and along y [Pa]."""
    distance, angle = np.meshgrid(
        np.linspace(1.0, REACH, 400, endpoint=False) + 0.5 * (REACH - 1.0) / 400,
        np.linspace(0.0, 2.0 * np.pi, 4800, endpoint=False) + np.pi / 4800,
    )
    hoop = 0.5 * (across + along) * (1.0 + distance**-2)
    hoop -= 0.5 * (across - along) * (1.0 + 3.0 * distance**-4) * np.cos(2.0 * angle)
    return by_sector(angle.ravel(), hoop.ravel(), distance.ravel())


def hard_rock() -> flexpm.Material:
    """Rock whose contacts are stiff, so that the grains are one body, and do not break."""
    rock = dataclasses.replace(flexpm.materials.load("augig-table7"), made_for=None)
    stiff = 100.0 * rock.law("flexible")["normal_stiffness"]
    return rock.with_set(
        normal_stiffness=stiff,
        **dict.fromkeys(("tensile_strength", "cohesion"), 1e10),
        **dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e8),
    )


def made_rig(
    specimen: flexpm.Specimen | None = None, *, pulls: bool = False
) -> tuple[flexpm.PartRig, list[Part]]:
    """The plate with its hole between four smooth platens; the first and the last may pull."""
    specimen = specimen or flexpm.Specimen.from_polygons(cells(), THICKNESS, holes=True)
    rig = flexpm.PartRig(fresh(specimen, hard_rock()))
    return rig, [rig.platen(side, bonded=pulls and side in (0, 3)) for side in range(4)]


@pytest.mark.long
def test_the_static_solution_has_the_hoop_stress_of_kirsch_at_any_two_pressures():
    """Within 3 % of the largest, at lateral pressures from none to the axial one."""
    rig, (_, right, top, _) = made_rig(pulls=True)
    for share in (1.0, 0.5, 1.0 / 3.0, 0.0):
        state = rig.elastic({top: GREATEST, right: share * GREATEST})
        wanted = kirsch(share * GREATEST, GREATEST)
        np.testing.assert_allclose(measured(state), wanted, rtol=0.0, atol=0.03 * wanted.max())


@pytest.mark.slow
@pytest.mark.parametrize("share", [1.0, 0.5, 1.0 / 3.0, 0.0])
def test_by_loading_it_is_that_of_kirsch_at_any_two_pressures(share):
    """Within 3 % of the largest: both pressures rise to the lateral one, then the axial one."""
    rig, (floor, right, top, _) = made_rig(pulls=True)
    lateral = share * GREATEST
    rig.press({top: lateral, right: lateral} if share > 0.0 else {right: 0.0})
    axial = lateral
    if share < 1.0:
        rig.drive(top, (0.0, -1.0), against=floor, area=SIDE * THICKNESS, length=SIDE)
        rig.stress_to(GREATEST)
        axial = rig.record["axial_stress"][-1]
        assert rig.warnings == []
    wanted = kirsch(lateral, axial)
    found = measured(rig.built.snapshot())
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=0.03 * wanted.max())


@pytest.mark.long
def test_the_hoop_stress_around_a_borehole_is_that_of_kirsch():
    """Within 3 % of the largest, as one pressure grows and the other one stays."""
    rig, (floor, right, top, _) = made_rig()
    for part in (top, right):
        rig.press(part, CONFINING)
    area = SIDE * THICKNESS
    rig.drive(top, (0.0, -1.0), against=floor, area=area, length=SIDE, strength=GREATEST)
    rig.stress_to(GREATEST)
    stress = rig.record["axial_stress"]
    assert len(stress) > 50
    assert stress[0] < 1.1 * CONFINING
    assert stress[-1] == pytest.approx(GREATEST, rel=0.005)
    across = -right.force[0] / area
    assert abs(across / CONFINING - 1.0) < 0.02
    wanted = kirsch(CONFINING, stress[-1])
    found = measured(rig.built.snapshot())
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=0.03 * wanted.max())
    assert rig.warnings == []


def filled() -> flexpm.Specimen:
    """The plate with wedges in its hole, whose rim is the line of an excavation."""
    half, count = 0.5 * SIDE, 2 * AROUND
    angles = np.arange(count + 1) * np.pi / AROUND
    rim = half + RADIUS * np.column_stack([np.cos(angles), np.sin(angles)])
    rim[-1] = rim[0]
    wedges = [np.vstack([rim[k : k + 9], [[half, half]]]) for k in range(0, count, 8)]
    specimen = flexpm.Specimen.from_polygons([*cells(), *wedges], THICKNESS)
    return specimen.with_excavations({"hole": rim})


@pytest.mark.slow
def test_an_excavated_borehole_has_the_hoop_stress_of_one_made_before_and_of_kirsch():
    """Within 3 % of the largest, at two pressures; its wall is that of the hole."""
    specimen = filled()
    assert specimen.excavation("hole").raggedness < 1e-9 * RADIUS
    rig, (_, right, top, _) = made_rig(specimen)
    rig.press({top: GREATEST, right: CONFINING})
    rig.excavate("hole")
    found = measured(rig.built.snapshot())
    before, (_, right, top, _) = made_rig()
    there = measured(before.elastic({top: GREATEST, right: CONFINING}))
    np.testing.assert_allclose(found, there, rtol=0.0, atol=0.01 * there.max())
    wanted = kirsch(CONFINING, GREATEST)
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=0.03 * wanted.max())


def sectors(state: Snapshot, middle: float) -> np.ndarray:
    """Mean hoop stress in each sector from a ragged wall on, compression positive [Pa]."""
    distance, angle = np.meshgrid(
        np.linspace(0.9, REACH, 80), np.radians(np.arange(0.0, 360.0, 0.25)) + 1e-3
    )
    distance, angle = distance.ravel(), angle.ravel()
    ways = np.column_stack([np.cos(angle), np.sin(angle)])
    found = state.stress_at(middle + RADIUS * distance[:, None] * ways)
    there = np.isfinite(found.xx)
    hoop = -found.polar((middle, middle)).hoop
    return by_sector(angle[there], hoop[there], distance[there])


@pytest.mark.long
def test_a_circle_sawn_into_a_packing_has_the_hoop_stress_of_a_sawn_hole():
    """Ten grains across, one pressure: within 3 % of the largest, 1.6 % here."""
    side, grain = 0.02, 0.4e-3
    sizes = (0.9 * grain, 1.1 * grain)
    rock = flexpm.Specimen.rectangle(side, side, THICKNESS, diameters=sizes, seed=1)
    circle = rock.with_excavations({"hole": ((0.5 * side, 0.5 * side), RADIUS)})
    assert circle.excavation("hole").raggedness < 0.05 * grain
    angles = np.arange(80) * np.pi / 40
    rim = 0.5 * side + RADIUS * np.column_stack([np.cos(angles), np.sin(angles)])
    box = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
    sawn = flexpm.Specimen.polygon(box, THICKNESS, holes=[rim], diameters=sizes, seed=1)
    found = []
    for specimen in (circle, sawn):
        rig, (_, right, top, _) = made_rig(specimen)
        if specimen is circle:
            rig.excavate("hole")
        found.append(sectors(rig.elastic(dict.fromkeys((top, right), 10e6)), 0.5 * side))
    np.testing.assert_allclose(*found, rtol=0.0, atol=0.03 * found[1].max())
