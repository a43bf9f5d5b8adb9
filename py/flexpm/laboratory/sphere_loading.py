# SPDX-License-Identifier: GPL-3.0-or-later
"""What loads YADE's bonded spheres: plates, grips and lateral pressure, paper Sec. 4. SI units.

Forces are those on the spheres; tension and extension are positive.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import yade

from ..models.sphere_bonds import tributary_lengths
from ..models.spheres import SphereModel

BOTTOM, RIGHT, TOP, LEFT = range(4)


@dataclass(frozen=True)
class Pulls:
    """What pulls at both ends of a specimen [N]."""

    bottom: float
    top: float

    @property
    def mean(self) -> float:
        """Of both ends [N]."""
        return 0.5 * (self.bottom + self.top)

    @property
    def mismatch(self) -> float:
        """Difference of both over the larger [-], 0 without a pull."""
        larger = max(abs(self.bottom), abs(self.top))
        return abs(self.bottom - self.top) / larger if larger > 0.0 else 0.0


class Plates:
    """The two frictionless horizontal plates; the lower one stands still."""

    def __init__(self, built: SphereModel) -> None:
        self.bottom, self.top = built.plates

    @classmethod
    def lay(cls, built: SphereModel, bottom: float, top: float) -> Plates:
        """Put plates with their faces at two heights [m]."""
        built.add_plate(bottom, -1)
        built.add_plate(top, 1)
        return cls(built)

    def move(self, velocity: float) -> None:
        """Move the upper plate, positive away from the lower [m/s, or m per step]."""
        yade.O.bodies[self.top].state.vel = (0.0, velocity, 0.0)

    def pulls(self) -> Pulls:
        """What the specimen is pulled by."""
        return Pulls(yade.O.forces.f(self.bottom)[1], -yade.O.forces.f(self.top)[1])

    def travel(self) -> float:
        """Of the upper plate, positive away from the lower [m]."""
        return yade.O.bodies[self.top].state.displ()[1]


class Grips:
    """The outermost layers of spheres at both ends, held axially and free to move sideways."""

    def __init__(self, built: SphereModel) -> None:
        self.bottom, self.top = (
            [built.ids[grain] for grain in tributary_lengths(built.specimen, side)]
            for side in (BOTTOM, TOP)
        )

    def close(self) -> None:
        """Hold the spheres axially."""
        for body in {*self.bottom, *self.top}:
            state = yade.O.bodies[body].state
            state.blockedDOFs = "yzXY"
            state.isDamped = False  # else YADE books a part of the grips' work as damped

    def move(self, velocity: float) -> None:
        """Move the upper layer, positive away from the lower [m/s, or m per step]."""
        for bodies, speed in ((self.bottom, 0.0), (self.top, velocity)):
            for body in bodies:
                state = yade.O.bodies[body].state
                state.vel = (state.vel[0], speed, 0.0)

    def pulls(self) -> Pulls:
        """What the specimen is pulled by."""
        low, high = (
            sum(yade.O.forces.f(body)[1] for body in side) for side in (self.bottom, self.top)
        )
        return Pulls(low, -high)

    def travel(self) -> float:
        """Of the upper layer, positive away from the lower [m]."""
        return yade.O.bodies[self.top[0]].state.displ()[1]


class Pressure:
    """Pressure on sides of a rectangle, following the grains: each turns its part of the side.

    YADE's permanent forces carry it; :meth:`update` lets them follow the deformation.
    """

    def __init__(self, built: SphereModel, sides: tuple[int, ...]) -> None:
        self._built = built
        cells = built.specimen.tessellation
        edges = np.array(cells.boundary_edges, dtype=int)
        self._edges = edges[np.isin(edges[:, 3], sides)]
        ends = np.array(cells.vertices)[self._edges[:, 1:3]]
        along = ends[:, 1] - ends[:, 0]
        # the outline runs counter-clockwise, so that inwards is to the left of its edges
        self._inward = np.column_stack((-along[:, 1], along[:, 0])) * built.specimen.thickness
        self._arms = ends.mean(axis=1) - built.specimen.centres[self._edges[:, 0]]

    def update(self, pressure: float) -> None:
        """Apply a pressure [Pa] to the sides where they are now."""
        total: dict[int, np.ndarray] = {}
        for grain, inward, arm in zip(
            self._edges[:, 0].tolist(), self._inward, self._arms, strict=True
        ):
            turn = self._place(grain)[2]
            force, lever = pressure * _turned(inward, turn), _turned(arm, turn)
            moment = lever[0] * force[1] - lever[1] * force[0]
            load = np.array((*force, moment))
            total[grain] = total[grain] + load if grain in total else load
        for grain, (x, y, moment) in total.items():
            self._built.load(self._built.ids[grain], float(x), float(y), float(moment))

    def remove(self) -> None:
        """Take the pressure away."""
        self.update(0.0)

    def lateral_stress(self, height: float) -> float:
        """Mean of the horizontal forces on left and right over the height's area [Pa]."""
        pushes = [
            abs(yade.O.forces.permF(self._built.ids[grain])[0])
            for grain in np.unique(self._edges[:, 0]).tolist()
        ]
        return 0.5 * sum(pushes) / (height * self._built.specimen.thickness)

    def _place(self, grain: int) -> tuple[float, float, float]:
        state = yade.O.bodies[self._built.ids[grain]].state
        axis, angle = state.ori.toAxisAngle()
        return state.pos[0], state.pos[1], math.copysign(1.0, axis[2]) * angle


def hold_sideways(built: SphereModel, grain: int) -> None:
    """Keep the place of a grain sideways."""
    state = yade.O.bodies[built.ids[grain]].state
    state.blockedDOFs = "x" + str(state.blockedDOFs)


def middle_of_bottom(built: SphereModel) -> int:
    """The grain of a rectangle's lower end that is nearest to its middle."""
    grains = list(tributary_lengths(built.specimen, BOTTOM))
    away = np.abs(built.specimen.centres[grains, 0] - built.specimen.centres[:, 0].mean())
    return grains[int(np.argmin(away))]


def start_evenly(built: SphereModel, velocity: float, low: float, height: float) -> None:
    """Give the spheres the velocities of a uniform axial strain rate, so that no wave runs."""
    for body, y in zip(built.ids, built.specimen.centres[:, 1].tolist(), strict=True):
        state = yade.O.bodies[body].state
        state.vel = (state.vel[0], velocity * (y - low) / height, 0.0)


def _turned(vector: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])
