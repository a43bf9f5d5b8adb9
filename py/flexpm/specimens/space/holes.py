# SPDX-License-Identifier: GPL-3.0-or-later
"""Holes of 3D specimens: cylinders along any axis, and boxes (D108). Lengths in metres.

Nothing heavy is loaded.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...errors import InputError
from ...files import Table
from ...joints.planes import FARTHEST, JointPlane, Vector
from ...require import LENGTH, Bounds, quoted, require_known, require_number, require_whole

#: Fewest facets of a cylinder by default, as of a cylindrical specimen (D63).
_FACETS = 16
#: Facets that a user may choose.
_GIVEN_FACETS = Bounds(at_least=6, at_most=360)
_KEYS = {
    "cylinder": ("point", "axis", "diameter", "length", "facets"),
    "box": ("low", "high"),
}
_OPTIONAL = ("length", "facets")
#: Extent of a hole through the specimen beyond its farthest corner, in sizes of the specimen [-].
_BEYOND = 0.1

Corners = tuple[Vector, Vector]


@dataclass(frozen=True)
class HoleCut:
    """Outcome of cutting a hole.

    Attributes:
        facets: Number of facets of the polyhedron.
        volume: Volume of the polyhedron inside the specimen [m3]; without the volume that earlier
            holes have removed.
        wall_area: Area of the wall [m2].
        deviation: Largest distance of a corner of the wall from the polyhedron [m]; 0: the wall is
            flat.
    """

    facets: int
    volume: float
    wall_area: float
    deviation: float

    def to_json(self) -> Table:
        """As plain values."""
        return dict(vars(self))


def checked(holes: object, grain: float, before: Sequence[Table] = ()) -> list[Table]:
    """Return holes as plain tables, whose numbers of facets are set.

    Args:
        holes: Tables of cylinders and boxes, see ``SolidSpecimen.with_holes``.
        grain: Mean diameter of the grains [m].
        before: Holes of the specimen.

    Raises:
        InputError: for a value that is no hole, a hole that is smaller than a grain, and a hole
            that is given twice.
    """
    if isinstance(holes, Mapping | str) or not isinstance(holes, Sequence) or not len(holes):
        raise InputError(
            f"holes = {quoted(holes)}, must be a list of one or more holes; give [{{point, axis, "
            "diameter}}]"
        )
    found: list[Table] = []
    for number, given in enumerate(holes, len(before)):
        hole = _hole(f"hole {number}", given, grain)
        if hole in (*before, *found):
            raise InputError(
                f"hole {number} = {quoted(given)}, is hole {[*before, *found].index(hole)} again; "
                "leave it out"
            )
        found.append(hole)
    return found


def is_hole(value: object) -> bool:
    """Whether a value of a file is a hole."""
    try:
        return value == _hole("hole", value, 0.0)
    except InputError:
        return False


def facets_of(hole: Table, corners: Corners) -> list[JointPlane]:
    """Return the facets of a hole, whose normals point into the rock.

    Args:
        hole: A checked hole.
        corners: Lower and upper corner of the box around the specimen [m].
    """
    if "low" in hole:
        low, high = hole["low"], hole["high"]
        base = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
        lower: list[Vector] = [(x, y, float(low[2])) for x, y in base]
        upper: list[Vector] = [(x, y, float(high[2])) for x, y in base]
        return _prism(lower, upper)
    axis = _vector(hole["axis"])
    point, first, last = _vector(hole["point"]), 0.0, hole.get("length", 0.0)
    if "length" not in hole:
        every = itertools.product(*zip(*corners, strict=True))
        along = [_dot(axis, _minus(_vector(corner), point)) for corner in every]
        more = _BEYOND * math.dist(*corners)
        first, last = min(along) - more, max(along) + more
    u, v = _across(axis)
    half = math.pi / hole["facets"]
    # the polygon has the area of the circle
    radius = 0.5 * hole["diameter"] * math.sqrt(half / (math.sin(half) * math.cos(half)))
    ends: list[list[Vector]] = [[], []]
    for k in range(hole["facets"]):
        a, b = radius * math.cos(2.0 * k * half), radius * math.sin(2.0 * k * half)
        for end, at in zip(ends, (first, last), strict=True):
            x, y, z = (
                p + at * n + a * s + b * t for p, n, s, t in zip(point, axis, u, v, strict=True)
            )
            end.append((x, y, z))
    return _prism(*ends)


def _prism(lower: list[Vector], upper: list[Vector]) -> list[JointPlane]:
    """Facets of a prism; `lower` goes counter-clockwise as seen from `upper`."""
    rings = [lower[::-1], upper]
    for k, corner in enumerate(lower):
        after = (k + 1) % len(lower)
        rings.append([corner, lower[after], upper[after], upper[k]])
    found = []
    for ring in rings:
        middle = _vector(math.fsum(one) / len(ring) for one in zip(*ring, strict=True))
        normal = _unit(_cross(_minus(ring[1], ring[0]), _minus(ring[2], ring[1])))
        found.append(JointPlane("hole", "polygon", normal, _dot(normal, middle), tuple(ring)))
    return found


def _hole(where: str, given: Any, grain: float) -> Table:
    if not isinstance(given, Mapping):
        raise InputError(
            f"{where} = {quoted(given)}, must be a table; give {{point, axis, diameter}} of a "
            "cylinder or {low, high} of a box"
        )
    kind = "box" if {"low", "high"} & given.keys() else "cylinder"
    for key in given:
        require_known(f"{where}: key", key, _KEYS[kind])
    for key in _KEYS[kind]:
        if key not in given and key not in _OPTIONAL:
            raise InputError(f"{where}: {key} is missing; give {', '.join(_KEYS[kind])}")
    if kind == "box":
        low, high = (_numbers(f"{where}: {key}", given[key], "m") for key in ("low", "high"))
        for axis, size in zip("xyz", _minus(high, low), strict=True):
            _require_size(f"{where}: size along {axis}", size, grain)
        return {"low": [*low], "high": [*high]}
    point = _numbers(f"{where}: point", given["point"], "m")
    axis_given = _numbers(f"{where}: axis", given["axis"], "")
    if not math.hypot(*axis_given) > 0.0:
        raise InputError(f"{where}: axis = {axis_given}, must not be zero; give a direction")
    diameter = require_number(f"{where}: diameter", given["diameter"], LENGTH, "m")
    _require_size(f"{where}: diameter", diameter, grain)
    found: Table = {"point": [*point], "axis": [*_unit(axis_given)], "diameter": diameter}
    if given.get("length") is not None:
        length = require_number(f"{where}: length", given["length"], LENGTH, "m")
        _require_size(f"{where}: length", length, grain)
        found["length"] = length
    facets = given.get("facets")
    if facets is None:
        facets = max(_FACETS, round(math.pi * diameter / grain)) if grain else _FACETS
        facets = min(facets, 360)
    return found | {"facets": require_whole(f"{where}: facets", facets, _GIVEN_FACETS)}


def _require_size(label: str, size: float, grain: float) -> None:
    if not size >= max(grain, LENGTH.at_least or 0.0):
        raise InputError(
            f"{label} = {size:.4g} m, must be >= {grain:.4g} m, the mean diameter of the grains; "
            "enlarge the hole or use smaller grains"
        )


def _numbers(label: str, given: Any, unit: str) -> Vector:
    values = given.tolist() if hasattr(given, "tolist") else given
    if not isinstance(values, Sequence) or isinstance(values, str) or len(values) != 3:
        raise InputError(f"{label} = {quoted(given)}, must be three numbers x, y, z; correct it")
    bounds = Bounds(at_least=-FARTHEST, at_most=FARTHEST)
    return _vector(require_number(label, one, bounds, unit) for one in values)


def _across(axis: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors across an axis, right-handed with it."""
    sizes = [abs(c) for c in axis]
    least = sizes.index(min(sizes))
    start = _vector(1.0 if k == least else 0.0 for k in range(3))
    along = _dot(start, axis)
    u = _unit(_vector(s - along * c for s, c in zip(start, axis, strict=True)))
    return u, _cross(axis, u)


def _unit(a: Vector) -> Vector:
    size = math.hypot(*a)
    if abs(size - 1.0) < 1e-14:  # a direction that was made of length 1 stays as it is
        return a
    return _vector(c / size for c in a)


def _vector(values: Any) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
