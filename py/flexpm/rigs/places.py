# SPDX-License-Identifier: GPL-3.0-or-later
"""Check points, directions, regions, jaws and column names of scripts. SI units.

Positions in 2D are x and y, in 3D x, y and z.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import InputError
from ..require import POSITIVE, Bounds, quoted, require_name, require_number

#: x and y, and z of space.
Place = Sequence[float]
#: Axes of the plane, and of space.
PLANE, SPACE = "xy", "xyz"
#: Tells of places, by arrays of x, y and in space z [m], which of them a region has.
Where = Callable[..., BoolArray]
#: x, y and z, 0 in the plane, as YADE has vectors.
Vector = tuple[float, float, float]
#: Largest angle of a jaw, an edge further round does not face it, and the limits [rad].
_WIDEST = 2.0 * math.pi / 3.0
_ANGLE = Bounds(above=0.0, at_most=_WIDEST)
#: A jaw's place is off the rim by at most this part of the radius; radii that differ by less than
#: the other part are one [-].
_OFF_RIM, _SAME = 0.05, 1e-9
#: Points of an arc that is drawn.
_POINTS = 25


def require_vector(label: str, value: object, unit: str = "m", axes: str = PLANE) -> Vector:
    """Return finite components along axes as x, y and z; in 2D, z is 0.

    Args:
        label: Name of the value in messages.
        value: Value that a script has passed.
        unit: Unit of the value.
        axes: ``PLANE`` or ``SPACE``.

    Raises:
        InputError: for another number of components, or a component that is not finite.
    """
    words = f"{', '.join(axes[:-1])} and {axes[-1]}"
    numbers = _several(f"{label} = {quoted(value)}, must be {words}", value, len(axes))
    x, y, *z = (
        require_number(f"{label}: {axis}", one, unit=unit)
        for axis, one in zip(axes, numbers, strict=True)
    )
    return x, y, (z[0] if z else 0.0)


def require_direction(label: str, value: object, axes: str = PLANE) -> Vector:
    """Return a direction as a unit vector, or raise InputError for a vector of length 0."""
    x, y, z = require_vector(f"{label}: direction", value, "", axes)
    size = math.hypot(x, y, z)
    require_number(f"{label}: length of its direction", size, POSITIVE)
    return x / size, y / size, z / size


def require_column(label: str, name: object, taken: Sequence[str]) -> str:
    """Return the name of a new column, or raise InputError for a name that is taken."""
    text = require_name(label, name)
    if text in taken:
        raise InputError(
            f"{label} = {quoted(name)}, must not be the name of another column; choose another name"
        )
    return text


def in_region(
    places: FloatArray,
    box: tuple[Place, Place] | None,
    ball: tuple[Place, float] | None,
    where: Where | None,
    axes: str = PLANE,
) -> BoolArray:
    """Return for each position whether it is in the region, (n,).

    Args:
        places: Positions of nodes, (n, 2) or (n, 3) [m].
        box: Two opposite corners [m].
        ball: Centre and radius of a ball, in 2D of a disc [m].
        where: Function of the arrays of components [m] that returns n bools.
        axes: ``PLANE`` or ``SPACE``.

    Raises:
        InputError: unless exactly one region is given, with values in range.
    """
    word, dimension = ("ball" if axes == SPACE else "disc"), len(axes)
    if sum(region is not None for region in (box, ball, where)) != 1:
        raise InputError(f"hold: give exactly one of box, {word} and where")
    if box is not None:
        ends = _several(f"hold: box = {quoted(box)}, must be two opposite corners; give both", box)
        label = "hold: corner of the box"
        corners = np.array([require_vector(label, one, axes=axes)[:dimension] for one in ends])
        low, high = corners.min(axis=0), corners.max(axis=0)
        found: BoolArray = np.all((places >= low) & (places <= high), axis=1)
    elif ball is not None:
        both = _several(
            f"hold: {word} = {quoted(ball)}, must be a centre and a radius; give both", ball
        )
        radius = require_number(f"hold: radius of the {word}", both[1], POSITIVE, "m")
        middle = require_vector(f"hold: centre of the {word}", both[0], axes=axes)[:dimension]
        found = np.linalg.norm(places - np.array(middle), axis=1) <= radius
    else:
        if not callable(where):
            words = f"{', '.join(axes[:-1])} and {axes[-1]}"
            raise InputError(
                f"hold: where = {quoted(where)}, must be a function of {words}; pass e.g. a lambda"
            )
        found = np.asarray(where(*places.T))
        if found.shape != places.shape[:1] or found.dtype != bool:
            raise InputError(
                f"hold: where() must return one bool per position, got {found.dtype} of shape "
                f"{found.shape} for {len(places)}"
            )
    return found


def _several(refusal: str, value: object, count: int = 2) -> list[object]:
    """Return `count` items of a list, or raise InputError with the text `refusal`."""
    found: list[object]
    try:
        found = list(value)  # type: ignore[call-overload]
    except TypeError:
        found = []
    if len(found) != count or isinstance(value, str):
        raise InputError(refusal)
    return found


@dataclass(frozen=True)
class Jaw:
    """An arc around the rim of a disc."""

    towards: tuple[float, float]  #: way from the disc's centre to its middle [m]
    radius: float  #: [m]
    angle: float  #: part of the disc before it [rad]

    @classmethod
    def of(
        cls, at: Place, centre: tuple[float, float], rim: float, radius: object, angle: object
    ) -> Jaw:
        """Return a jaw from the arguments of a rig.

        Args:
            at: Position of the jaw, in the plane across the disc's axis [m].
            centre: Centre of the disc [m].
            rim: Radius of the disc [m].
            radius: Radius of the jaw, at least the radius of the disc [m].
            angle: Angle of the disc that the jaw can cover [rad]; None: the largest angle, which is
                not available for the radius of the disc.

        Raises:
            InputError: for a position off the rim, or a radius or an angle out of range.
        """
        way = (at[0] - centre[0], at[1] - centre[1])
        long = float(np.hypot(*way))
        off = abs(long - rim)
        if off > _OFF_RIM * rim:
            raise InputError(
                f"jaw: position = ({at[0]:g}, {at[1]:g}) m, must be on the rim, is {off:.3g} m "
                "off; move it onto the rim"
            )
        radius = require_number("jaw: radius", radius, POSITIVE, "m")
        if radius < rim * (1.0 - _SAME):
            raise InputError(
                f"jaw: radius = {radius:g} m, must be >= {rim:g} m, the radius of the disc; give a "
                "larger radius"
            )
        if angle is None and radius <= rim * (1.0 + _SAME):
            raise InputError(
                "jaw: angle = None, must be given if the jaw has the radius of the disc; give an "
                "angle [rad]"
            )
        before = _WIDEST if angle is None else require_number("jaw: angle", angle, _ANGLE, "rad")
        there = rim / long
        return cls((way[0] * there, way[1] * there), max(radius, rim), before)

    def trace(self, rim: float) -> list[list[float]]:
        """Return the arc, (n, 2) [m], around a disc of radius `rim` [m] with its centre at 0."""
        out = np.array(self.towards) / rim
        at = rim * np.sin(0.5 * self.angle) * np.linspace(-1.0, 1.0, _POINTS)
        rise = self.radius - np.sqrt(self.radius**2 - at**2)
        along = np.array([-out[1], out[0]])
        arc = np.array(self.towards) + at[:, None] * along - rise[:, None] * out
        line: list[list[float]] = arc.tolist()
        return line
