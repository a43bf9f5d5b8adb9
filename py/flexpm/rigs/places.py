# SPDX-License-Identifier: GPL-3.0-or-later
"""Points, directions, regions and names of columns, as scripts give them. SI units.

Places of the plane are x and y, those of space x, y and z.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import InputError
from ..require import POSITIVE, quoted, require_number, require_text

#: x and y, and z of space.
Place = Sequence[float]
#: Axes of the plane, and of space.
PLANE, SPACE = "xy", "xyz"
#: Tells of places, by arrays of x, y and in space z [m], which of them a region has.
Where = Callable[..., BoolArray]
#: x, y and z, 0 in the plane, as YADE has vectors.
Vector = tuple[float, float, float]


def require_vector(label: str, value: object, unit: str = "m", axes: str = PLANE) -> Vector:
    """Return finite numbers along axes, with a zero behind those of the plane, or raise InputError.

    Args:
        label: Names the value in messages.
        value: What a script has given.
        unit: Its unit.
        axes: ``PLANE`` or ``SPACE``.
    """
    words = f"{', '.join(axes[:-1])} and {axes[-1]}"
    numbers = _several(f"{label} = {quoted(value)}, must be {words}", value, len(axes))
    x, y, *z = (
        require_number(f"{label}: {axis}", one, unit=unit)
        for axis, one in zip(axes, numbers, strict=True)
    )
    return x, y, (z[0] if z else 0.0)


def require_direction(label: str, value: object, axes: str = PLANE) -> Vector:
    """Return a direction as a unit vector, or raise InputError."""
    x, y, z = require_vector(f"{label}: direction", value, "", axes)
    size = math.hypot(x, y, z)
    require_number(f"{label}: length of its direction", size, POSITIVE)
    return x / size, y / size, z / size


def require_column(label: str, name: object, taken: Sequence[str]) -> str:
    """Return a name that a column may have beside others, or raise InputError."""
    text = require_text(label, name)
    if not (text and text.isprintable() and text == text.strip()):
        raise InputError(
            f"{label} = {quoted(name)}, must be a name of printable characters without blanks at "
            "its ends"
        )
    if text in taken:
        raise InputError(f"{label} = {quoted(name)}, must not be the name of another column")
    return text


def in_region(
    places: FloatArray,
    box: tuple[Place, Place] | None,
    ball: tuple[Place, float] | None,
    where: Where | None,
    axes: str = PLANE,
) -> BoolArray:
    """Which of the places, (n, 2) or (n, 3), lie in the one region that is given.

    Args:
        places: Those of nodes [m].
        box: Two opposite corners.
        ball: Centre and radius of a ball, or of a disc in the plane.
        where: Function of arrays of their components.
        axes: ``PLANE`` or ``SPACE``.
    """
    word, dimension = ("ball" if axes == SPACE else "disc"), len(axes)
    if sum(region is not None for region in (box, ball, where)) != 1:
        raise InputError(f"hold: region = none or several, must be one of box, {word} and where")
    if box is not None:
        ends = _several(f"hold: box = {quoted(box)}, must be two opposite corners", box)
        label = "hold: corner of the box"
        corners = np.array([require_vector(label, one, axes=axes)[:dimension] for one in ends])
        low, high = corners.min(axis=0), corners.max(axis=0)
        found: BoolArray = np.all((places >= low) & (places <= high), axis=1)
    elif ball is not None:
        both = _several(f"hold: {word} = {quoted(ball)}, must be a centre and a radius", ball)
        radius = require_number(f"hold: radius of the {word}", both[1], POSITIVE, "m")
        middle = require_vector(f"hold: centre of the {word}", both[0], axes=axes)[:dimension]
        found = np.linalg.norm(places - np.array(middle), axis=1) <= radius
    else:
        if not callable(where):
            words = f"{', '.join(axes[:-1])} and {axes[-1]}"
            raise InputError(f"hold: where = {quoted(where)}, must be a function of {words}")
        found = np.asarray(where(*places.T))
        if found.shape != places.shape[:1] or found.dtype != bool:
            raise InputError("hold: where = another array, must be one truth for each place")
    return found


def _several(refusal: str, value: object, count: int = 2) -> list[object]:
    """So many things of a list."""
    found: list[object]
    try:
        found = list(value)  # type: ignore[call-overload]
    except TypeError:
        found = []
    if len(found) != count or isinstance(value, str):
        raise InputError(refusal)
    return found
