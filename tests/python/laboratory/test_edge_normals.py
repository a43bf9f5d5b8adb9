# SPDX-License-Identifier: GPL-3.0-or-later
"""Given cells whose centres lie beside their boundary: strengths and friction are the boundary's.

Closed forms of deviation D104: strength times area, and Coulomb's angle.
"""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np
import pytest
import yade
from scenes import fresh

import flexpm

SIDE, THICKNESS = 2e-3, 0.01
GRAVITY = 9.81


def two_cells(offset: float) -> flexpm.Specimen:
    """A square on a block that reaches further to the right: their boundary is level [m]."""
    a, far = SIDE, 2.0 * SIDE + offset
    lower = [(-a, -a), (far, -a), (far, 0.0), (a, 0.0), (0.0, 0.0), (-a, 0.0)]
    upper = [(0.0, 0.0), (a, 0.0), (a, a), (0.0, a)]
    return flexpm.Specimen.from_polygons([lower, upper], THICKNESS)


@pytest.mark.parametrize("offset", [0.0, 2.0, 4.0, 8.0])
def test_a_level_boundary_has_its_strength_wherever_the_centres_lie(offset):
    """Flexible cells whose ends are held; tests of the kernel have rigid ones, and shear."""
    rock = flexpm.materials.load("augig-table7", "flexible")
    rig = flexpm.PartRig(fresh(two_cells(offset * SIDE), rock))
    base = rig.hold(where=lambda _, y: y < -0.999 * SIDE)
    head = rig.hold(where=lambda _, y: y > 0.999 * SIDE)
    rig.drive(head, (0.0, 1.0), against=base)
    rig.load(flexpm.Loading(kind="waiting", rate=0.1, stop_ratio=0.9))
    strength = rock.tensile_strength * SIDE * THICKNESS
    assert rig.record["load"].max() == pytest.approx(strength, rel=0.01)


def bricks(offset: float) -> flexpm.Specimen:
    """A wall of square bricks in running bond, every second row moved by a part of a brick."""
    polygons = []
    for row in range(6):
        ends = SIDE * np.arange(5.0)
        if row % 2:
            ends[1:-1] -= offset * SIDE
            if offset:
                ends = np.insert(ends, -1, 4.0 * SIDE - offset * SIDE)
        low, high = row * SIDE, (row + 1) * SIDE
        for left, right in itertools.pairwise(ends):
            polygons.append([(left, low), (right, low), (right, high), (left, high)])
    return flexpm.Specimen.from_polygons(polygons, THICKNESS)


def test_a_wall_of_bricks_has_the_tensile_strength_of_its_bed_joints():
    """Whatever the offset of its rows; loaded slowly, since at the default rate waves add 3 %."""
    rock = flexpm.materials.load("augig-table7", "flexible")
    peaks = [
        flexpm.run("tension", bricks(offset), rock, rate=0.25).peak_stress
        for offset in (0.0, 0.25, 0.5)
    ]
    assert peaks == pytest.approx([rock.tensile_strength] * 3, rel=0.01)
    assert max(peaks) < 1.005 * min(peaks)


def slope(dip: float) -> flexpm.Specimen:
    """An irregular block on a base whose upper edge dips to the left [rad]."""
    # held rigid grains may turn about their centres: two more hold the base
    base = [[(-1.0, -1.0), (4.0, -1.0), (4.0, 0.0), (-1.0, 0.0)]]
    base += [[(x, -2.0), (x + 2.5, -2.0), (x + 2.5, -1.0), (x, -1.0)] for x in (-1.0, 1.5)]
    block = [(0.0, 0.0), (1.2, 0.0), (1.9, 0.7), (1.1, 1.1), (0.1, 0.6)]
    turn = np.array([[math.cos(dip), math.sin(dip)], [-math.sin(dip), math.cos(dip)]])
    polygons = [5e-3 * np.array(corners) @ turn for corners in (*base, block)]
    return flexpm.Specimen.from_polygons(polygons, THICKNESS).with_minerals([0, 0, 0, 1])


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("beyond", [-0.3, 0.3])
def test_a_block_rests_below_the_friction_angle_of_its_edge_and_slides_above_it(model, beyond):
    """Bonded by a strength that its weight breaks; `beyond` in degrees."""
    yade.O.reset()
    friction = 0.4
    angle = math.atan(friction)
    dip = angle + math.radians(beyond)
    rock = dataclasses.replace(
        flexpm.materials.load(None, model),
        minerals=[{"name": "base", "fraction": 0.5}, {"name": "block", "fraction": 0.5}],
    )
    values = {"cohesion": 1.0, "tensile_strength": 1.0, "friction": friction}
    values |= {"normal_stiffness": 1e12, "softening": "brittle"}
    rock = rock.with_set({f"interface.base/block.{key}": one for key, one in values.items()}, model)
    built = flexpm.build(slope(dip), rock, model, mesh="fan", dynamic=True, gravity=GRAVITY)
    up = np.array([-math.sin(dip), math.cos(dip)])
    rig = flexpm.PartRig(built)
    below = 1e-6 if model == "flexible" else 0.0
    rig.hold(where=lambda x, y: x * up[0] + y * up[1] < -below)
    block = yade.O.bodies[built.solver.bodyIds[3]].state
    rig.settle(moving=beyond > 0.0, transits=20 if beyond > 0.0 else 100)
    built.run(1)

    def along(vector):
        return -vector[0] * math.cos(dip) - vector[1] * math.sin(dip)

    start, speed = along(block.pos), along(block.vel)
    steps = math.ceil(1e-3 / yade.O.dt)
    built.run(steps)
    time = steps * yade.O.dt
    way = along(block.pos) - start
    if beyond < 0.0:
        assert abs(way) < 1e-9
    else:
        gain = GRAVITY * math.sin(dip - angle) / math.cos(angle)
        assert way - speed * time == pytest.approx(0.5 * gain * time**2, rel=0.1)
