# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading of YADE's bonded spheres: plates, grips and lateral pressure, paper Sec. 4. SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import cast

import numpy as np
import yade

from ..arrays import FloatArray
from ..models.sphere_bonds import in_order, tributary_sizes
from ..models.spheres import SphereModel
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import Specimen
from .rig import BOTTOM, TOP


class Ends:
    """Bodies that grip the ends of a specimen: a plate each, or the outermost layers of spheres."""

    def __init__(self, built: SphereModel, bottom: Sequence[int], top: Sequence[int]) -> None:
        """Take the bodies of both ends."""
        self._built, self._bottom, self._top = built, bottom, top

    def move(self, velocity: float) -> None:
        """Set the velocity of the upper end, positive if it extends [m/s, or m per step]."""
        for bodies, speed in ((self._bottom, 0.0), (self._top, velocity)):
            for body in bodies:
                _set_speed(self._built, body, speed)

    def forces(self) -> tuple[float, float]:
        """Forces along the axis that the lower and the upper end exert on the specimen [N]."""
        bottom, top = (
            -in_order(yade.O.forces.f(body)[self._built.axis] for body in bodies)
            for bodies in (self._bottom, self._top)
        )
        return bottom, top

    def travel(self) -> float:
        """Displacement of the upper end, positive away from the lower end [m]."""
        return self._built.state_of(self._top[0]).displ()[self._built.axis]


def _set_speed(built: SphereModel, body: int, speed: float) -> None:
    """Set the velocity of a body along the axis; across it keeps its own."""
    state = built.state_of(body)
    vel = state.vel
    state.vel = (vel[0], speed, 0.0) if built.axis == 1 else (vel[0], vel[1], speed)


def section(specimen: SolidSpecimen) -> float:
    """Return the cross-sectional area of a 3D specimen [m2]."""
    return specimen.outline().volume / specimen.dimensions["height"]


def plates_of(built: SphereModel) -> Ends:
    """Return the two frictionless horizontal plates; the lower plate does not move."""
    bottom, top = built.plates
    return Ends(built, [bottom], [top])


def grips_of(built: SphereModel) -> Ends:
    """The outermost layers of spheres at both ends."""
    bottom, top = (
        [built.ids[grain] for grain in tributary_sizes(built.specimen, side)]
        for side in (BOTTOM, TOP)
    )
    return Ends(built, bottom, top)


def close_grips(built: SphereModel) -> None:
    """Hold the outermost layers of spheres axially; they stay free to move sideways."""
    for side in (BOTTOM, TOP):
        for grain in tributary_sizes(built.specimen, side):
            state = built.state_of(built.ids[grain])
            state.blockedDOFs = "yzXY" if built.axis == 1 else "z"
            state.isDamped = False  # else YADE counts a part of the grips' work as damped
    hold_middle(built)


def squeeze_ends(built: SphereModel, pressure: float | None) -> None:
    """Put plates on bottom and top; they take over the pressure [Pa] of a rectangle, if any."""
    faces = built.specimen.heights
    for side, face, sense in ((BOTTOM, faces[0], -1), (TOP, faces[1], 1)):
        lengths = tributary_sizes(built.specimen, side)
        ways = [built.state_of(built.ids[grain]).displ()[built.axis] for grain in lengths]
        moved = np.mean(ways)
        built.touch(built.add_plate(float(face + moved), sense), lengths)
    if pressure is None:
        hold_middle(built)
        return
    yade.O.step()
    Pressure(built, (BOTTOM, TOP)).update(0.0)
    for plate in built.plates:
        built.press(plate, pressure)


def squeeze_disc(built: SphereModel) -> None:
    """Lay plates against a disc.

    Deviation D28: the spheres that touch first cannot move sideways, else the disc would roll.
    """
    radii = built.kind.radii(built.specimen)
    heights = built.specimen.centres[:, 1]  # a disc is of the plane
    built.add_plate(float(np.min(heights - radii)), -1)
    built.add_plate(float(np.max(heights + radii)), 1)
    for grain in (np.argmin(heights - radii), np.argmax(heights + radii)):
        _hold_sideways(built, int(grain))


def strain_evenly(built: SphereModel, velocity: float) -> None:
    """Give the spheres the velocities of a uniform axial strain rate, so that no wave starts.

    With real masses waves carry the motion of the ends into the specimen.

    Args:
        built: A rectangle or a 3D specimen.
        velocity: Velocity of the upper end, positive away from the lower end [m/s, or m per step].
    """
    bottom, top = built.specimen.heights
    for body, y in zip(built.ids, built.specimen.centres[:, built.axis].tolist(), strict=True):
        _set_speed(built, body, velocity * (y - bottom) / (top - bottom))


class Pressure:
    """Pressure on sides of a rectangle; the load on each grain rotates with its part of the side.

    YADE's permanent forces apply it; :meth:`update` adapts them to the deformation.
    """

    def __init__(self, built: SphereModel, sides: Sequence[int]) -> None:
        """Find the outer edges of the grains on the sides."""
        self._built = built
        cells = cast(Specimen, built.specimen).tessellation  # solids are under none
        edges = np.array(cells.boundary_edges, dtype=int)
        self._edges = edges[np.isin(edges[:, 3], sides)]
        ends = np.array(cells.vertices)[self._edges[:, 1:3]]
        along = ends[:, 1] - ends[:, 0]
        # the outline runs counter-clockwise, so that inwards is to the left of its edges
        self._inward = np.column_stack((-along[:, 1], along[:, 0])) * built.specimen.thickness
        self._arms = ends.mean(axis=1) - built.specimen.centres[self._edges[:, 0]]

    def update(self, pressure: float) -> None:
        """Apply a pressure [Pa] to the sides where they are now."""
        total: dict[int, FloatArray] = {}
        for grain, inward, arm in zip(
            self._edges[:, 0].tolist(), self._inward, self._arms, strict=True
        ):
            axis, angle = self._built.state_of(self._built.ids[grain]).ori.toAxisAngle()
            turn = math.copysign(1.0, axis[2]) * angle
            force, lever = pressure * _turned(inward, turn), _turned(arm, turn)
            moment = lever[0] * force[1] - lever[1] * force[0]
            total[grain] = total.get(grain, np.zeros(3)) + np.array((*force, moment))
        for grain, (x, y, moment) in total.items():
            self._built.load(self._built.ids[grain], float(x), float(y), float(moment))

    def lateral_stress(self, height: float) -> float:
        """Mean of the horizontal forces on left and right over the height's area [Pa]."""
        pushes = [
            abs(yade.O.forces.permF(self._built.ids[grain])[0])
            for grain in np.unique(self._edges[:, 0]).tolist()
        ]
        return 0.5 * in_order(pushes) / (height * self._built.specimen.thickness)


def hold_middle(built: SphereModel) -> None:
    """Fix the lateral position of the grain of the lower end that is nearest to its middle."""
    grains = list(tributary_sizes(built.specimen, BOTTOM))
    across = built.specimen.centres.T[: built.axis]
    away = np.hypot.reduce([np.abs(one[grains] - one.mean()) for one in across])
    _hold_sideways(built, grains[int(np.argmin(away))])


def _hold_sideways(built: SphereModel, grain: int) -> None:
    state = built.state_of(built.ids[grain])
    state.blockedDOFs = "xy"[: built.axis] + str(state.blockedDOFs)


def _turned(vector: FloatArray, angle: float) -> FloatArray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])
