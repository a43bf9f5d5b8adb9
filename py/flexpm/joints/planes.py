# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of 3D specimens: planes, discs and convex polygons. Lengths in metres, angles in degrees.

x points east, y north and z up. The dip direction is measured clockwise from y, as seen from above.
Nothing heavy is loaded.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from ..errors import InputError
from ..files import Table
from ..require import LENGTH, Bounds, quoted, require_known, require_number
from .lines import check_name

Vector = tuple[float, float, float]

#: Corners of the polygon that stands for a disc, with the area of the disc.
SIDES = 32
#: Most planes that cut a specimen.
MOST_PLANES = 20_000
#: Distance of the corners of a polygon from its plane, and of convexity, over its size [-].
_OFF = 1e-6
#: Dips [degree].
DIP = Bounds(at_least=0.0, at_most=90.0)
#: Dip directions [degree].
DIRECTION = Bounds(at_least=-360.0, at_most=360.0)
#: Largest distance of a point from the origin along an axis, and largest radius [m].
FARTHEST = 1e6
_KEYS = {
    "plane": ("point", "dip", "dip_direction"),
    "disc": ("centre", "dip", "dip_direction", "radius"),
}


@dataclass(frozen=True)
class JointPlane:
    """A plane of a joint, or a part of it.

    Attributes:
        name: Name of the joint.
        kind: ``plane``, ``disc`` or ``polygon``.
        normal: Upper unit normal [-].
        offset: Distance of the plane from the origin, along the normal [m].
        corners: Corners of a convex polygon in it [m]; a disc has the polygon of its area; a whole
            plane has none.
        radius: Radius of a disc [m].
    """

    name: str
    kind: str
    normal: Vector
    offset: float
    corners: tuple[Vector, ...] = ()
    radius: float | None = None

    def to_json(self) -> Table:
        """As plain values."""
        return {key: value for key, value in asdict(self).items() if value not in (None, ())}

    @classmethod
    def from_json(cls, values: Table) -> JointPlane:
        """From plain values."""
        x, y, z = values["normal"]
        corners = tuple((a, b, c) for a, b, c in values.get("corners", ()))
        return cls(**{**values, "normal": (x, y, z), "corners": corners})

    @property
    def dip(self) -> float:
        """Dip [degree]."""
        x, y, z = self.normal
        return math.degrees(math.atan2(math.hypot(x, y), z))

    @property
    def dip_direction(self) -> float:
        """Dip direction, 0 to 360; 0 for a horizontal plane [degree]."""
        return math.degrees(math.atan2(self.normal[0], self.normal[1])) % 360.0


@dataclass(frozen=True)
class PlanesCut:
    """Outcome of cutting the planes of a joint; areas are seen along the normals [m2].

    Attributes:
        planes: Number of requested planes, discs and polygons.
        outside: Number of planes outside the specimen.
        idle: Number of planes inside the specimen that cut nothing.
        within: Requested area inside the specimen.
        cut: Area of the contacts that they have made.
        taken: Area on contacts of earlier joints.
        bridged: Requested area within grains that bridge the plane.
        beyond: Area of cut grains beyond the edges of discs and polygons.
        detour: True area of contacts with corners off the planes, at grains that are not cut.
        deviation: Largest distance of contacts from their planes [m].
        crowding: Requested area over the volume of the specimen, P32, times the mean diameter of
            the grains [-].
        smallest_disc: Smallest diameter of a disc in the specimen, in mean diameters of the grains
            [-]; None without discs.

    ``taken``, ``bridged`` and ``beyond`` are those before short edges are collapsed.
    """

    planes: int
    outside: int
    idle: int
    within: float
    cut: float
    taken: float
    bridged: float
    beyond: float
    detour: float
    deviation: float
    crowding: float = 0.0
    smallest_disc: float | None = None

    def to_json(self) -> Table:
        """As plain values."""
        return asdict(self)


def normal_of(dip: float, dip_direction: float) -> Vector:
    """Return the upper unit normal of a plane with a dip and a dip direction [degree]."""
    down, around = math.radians(dip), math.radians(dip_direction)
    return math.sin(down) * math.sin(around), math.sin(down) * math.cos(around), math.cos(down)


def plane(name: str, point: Vector, dip: float, dip_direction: float) -> JointPlane:
    """A whole plane through a point [m]."""
    normal = normal_of(dip, dip_direction)
    return JointPlane(name, "plane", normal, _dot(normal, point))


def disc(name: str, centre: Vector, normal: Vector, radius: float) -> JointPlane:
    """A disc [m]: a polygon of its area."""
    x, y, z = normal
    level = math.hypot(x, y)
    # along the strike and up the dip
    strike: Vector = (-y / level, x / level, 0.0) if level > 0.0 else (1.0, 0.0, 0.0)
    up = _cross(normal, strike)
    reach = radius * math.sqrt(2.0 * math.pi / (SIDES * math.sin(2.0 * math.pi / SIDES)))
    corners = []
    for k in range(SIDES):
        angle = 2.0 * math.pi * k / SIDES
        a, b = reach * math.cos(angle), reach * math.sin(angle)
        corners.append(
            _vector(c + a * s + b * u for c, s, u in zip(centre, strike, up, strict=False))
        )
    return JointPlane(name, "disc", normal, _dot(normal, centre), tuple(corners), radius)


def polygon(where: str, name: str, corners: Sequence[Vector]) -> JointPlane:
    """A convex polygon [m].

    Raises:
        InputError: unless it has three corners or more, an area, and is plane and convex.
    """
    if len(corners) < 3:
        raise InputError(
            f"{where}: corners = {len(corners)}, must be three or more; give a polygon"
        )
    first = corners[0]
    arms = [_minus(corner, first) for corner in corners]
    size = max(math.hypot(*arm) for arm in arms)
    twice = _vector(
        math.fsum(_cross(a, b)[axis] for a, b in itertools.pairwise(arms[1:])) for axis in range(3)
    )
    area = 0.5 * math.hypot(*twice)
    if not 2.0 * area > _OFF * size * size:
        raise InputError(
            f"{where}: area = {area:.4g} m2, must be above 0; correct the corners, which lie on a "
            "line"
        )
    if twice[2] < 0.0:
        twice = _vector(-c for c in twice)
    normal = _vector(c / math.hypot(*twice) for c in twice)
    offset = math.fsum(_dot(normal, corner) for corner in corners) / len(corners)
    for number, corner in enumerate(corners):
        off = abs(_dot(normal, corner) - offset)
        if not off <= _OFF * size:
            raise InputError(
                f"{where}: distance of corner {number} from the plane of the others = {off:.4g} m, "
                f"must be <= {_OFF * size:.3g} m; correct it, or divide the polygon into triangles"
            )
    _require_convex(where, corners, normal, size)
    return JointPlane(name, "polygon", normal, offset, tuple(corners))


def checked(joints: object) -> list[JointPlane]:
    """Return the planes of joints by name; a joint may be one plane, disc or polygon, or a list.

    Args:
        joints: By its name a table with ``point``, ``dip`` and ``dip_direction`` (a whole plane),
            or ``centre``, ``dip``, ``dip_direction`` and ``radius`` (a disc); or the corners of a
            convex polygon, rows x, y, z; or a list of these.

    Raises:
        InputError: for a value that is none of these, and for a name that no joint may have.
    """
    if not isinstance(joints, Mapping) or not joints:
        raise InputError(
            f"joints = {quoted(joints)}, must be planes, discs or polygons by the name of their "
            "joint; give {name: polygon}"
        )
    found: list[JointPlane] = []
    for name, given in joints.items():
        check_name(name, "joint")
        shapes = _plain(given)
        if isinstance(shapes, Mapping | JointPlane) or _is_polygon(shapes):
            shapes = [shapes]
        if not isinstance(shapes, list) or not shapes:
            raise InputError(
                f"joint {name} = {quoted(given)}, must be a plane, a disc or a polygon of points "
                "x, y, z, or a list of these; give {point, dip, dip_direction}"
            )
        found += [_shape(name, number, one) for number, one in enumerate(shapes)]
    require_few(found)
    return found


def require_few(planes: Sequence[JointPlane]) -> None:
    """Reject too many planes."""
    if len(planes) > MOST_PLANES:
        raise InputError(
            f"joints: planes = {len(planes)}, must be <= {MOST_PLANES}; leave out or merge planes"
        )


def require_size(planes: Iterable[JointPlane], grain: float) -> None:
    """Reject discs that are smaller than a grain.

    Args:
        planes: Planes, discs and polygons.
        grain: Mean diameter of the grains [m].
    """
    numbers: dict[str, int] = {}
    for one in planes:
        number = numbers[one.name] = numbers.get(one.name, -1) + 1
        if one.radius is not None and 2.0 * one.radius < grain:
            raise InputError(
                f"joint {one.name}: radius of disc {number} = {one.radius:.4g} m, must be >= "
                f"{0.5 * grain:.4g} m, the radius of a mean grain; use larger discs or smaller "
                "grains"
            )


def names_of(planes: Iterable[JointPlane]) -> tuple[str, ...]:
    """Names of the joints in the order of their first planes."""
    return tuple(dict.fromkeys(one.name for one in planes))


def checksum(planes: Sequence[JointPlane], before: str | None = None) -> str:
    """Short hash of planes, and of those that a specimen has already."""
    text = json.dumps([before, [one.to_json() for one in planes]])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _shape(name: str, number: int, given: Any) -> JointPlane:
    where = f"joint {name}: plane {number}"
    if isinstance(given, JointPlane):
        return JointPlane(**{**vars(given), "name": name})
    if _is_polygon(given):
        return polygon(where, name, [_vector(corner) for corner in given])
    if not isinstance(given, Mapping):
        raise InputError(
            f"{where} = {quoted(given)}, must be a plane, a disc or a polygon of points x, y, z; "
            "give {point, dip, dip_direction}"
        )
    kind = "disc" if {"centre", "radius"} & given.keys() else "plane"
    for key in given:
        require_known(f"{where}: key", key, _KEYS[kind])
    for key in _KEYS[kind]:
        if key not in given:
            raise InputError(f"{where}: {key} is missing; give {', '.join(_KEYS[kind])}")
    dip = require_number(f"{where}: dip", given["dip"], DIP, "degree")
    direction = require_number(
        f"{where}: dip_direction", given["dip_direction"], DIRECTION, "degree"
    )
    label = "point" if kind == "plane" else "centre"
    at = given[label]
    if not _is_point(at):
        raise InputError(
            f"{where}: {label} = {quoted(at)} m, must be three numbers x, y, z of at most "
            f"{FARTHEST:g} m; correct it"
        )
    if kind == "plane":
        return plane(name, _vector(at), dip, direction)
    radius = require_number(f"{where}: radius", given["radius"], LENGTH, "m")
    return disc(name, _vector(at), normal_of(dip, direction), radius)


def _require_convex(where: str, corners: Sequence[Vector], normal: Vector, size: float) -> None:
    for k, (corner, before) in enumerate(zip(corners, [corners[-1], *corners[:-1]], strict=True)):
        edge = _minus(corner, before)
        if math.hypot(*edge) <= _OFF * size:
            continue
        out = _cross(edge, normal)
        out = _vector(c / math.hypot(*out) for c in out)
        sides = [_dot(out, _minus(other, before)) for other in corners]
        if min(max(sides), -min(sides)) > _OFF * size:
            raise InputError(
                f"{where}: corner {k} = {corner} m, must be one of a convex polygon; divide the "
                "polygon"
            )


def _plain(given: object) -> Any:
    """Arrays as lists."""
    if hasattr(given, "tolist"):
        return given.tolist()
    if isinstance(given, Mapping):
        return {key: _plain(one) for key, one in given.items()}
    if isinstance(given, Sequence) and not isinstance(given, str):
        return [_plain(one) for one in given]
    return given


def _is_polygon(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(map(_is_point, value))


def _is_point(value: Any) -> bool:
    numbers = isinstance(value, list | tuple) and len(value) == 3
    return numbers and all(
        isinstance(x, int | float) and not isinstance(x, bool) and abs(x) <= FARTHEST for x in value
    )


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
