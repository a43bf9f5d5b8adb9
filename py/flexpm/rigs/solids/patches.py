# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches of the surface of a 3D specimen that plates cover. SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import FloatArray
from ...errors import InputError
from ...require import POSITIVE, Bounds, quoted, require_number, require_whole
from ...specimens.space.specimen import SolidSpecimen
from ..places import SPACE, Vector, require_vector
from ..stages.pressures import sides_of

BOTTOM, RIGHT, TOP, LEFT, FRONT, BACK = range(6)
#: Into the specimen from each side of the box around it.
INWARDS = {
    BOTTOM: (0.0, 0.0, 1.0),
    RIGHT: (-1.0, 0.0, 0.0),
    TOP: (0.0, 0.0, -1.0),
    LEFT: (1.0, 0.0, 0.0),
    FRONT: (0.0, 1.0, 0.0),
    BACK: (0.0, -1.0, 0.0),
}
#: Sides that are flat, by the shape.
FLAT = {
    "box": (BOTTOM, RIGHT, TOP, LEFT, FRONT, BACK),
    "cylinder": (BOTTOM, TOP),
    "solid-disc": (FRONT, BACK),
    "solid-half-disc": (BOTTOM, FRONT, BACK),
}
#: Side that is round: the mantle has the number of the right side.
_MANTLE = RIGHT
#: Number of the wall of the first hole among the sides of the kernel.
_HOLE = 7
#: Axis across the section that maps draw.
_DEPTH = 1
#: Cosine from which on normals are along each other, and part of a patch that is an edge [-].
_SAME, _EDGE = 1.0 - 1e-6, 1e-6
#: What of a side is off its plane, at most, in mean diameters of the grains [-].
_OFF = 0.5


@dataclass(frozen=True)
class Patch:
    """Part of the surface that is in a box and faces a normal."""

    normal: Vector  #: into the specimen, a unit vector
    low: Vector  #: corners of the box [m]
    high: Vector
    trace: list[list[float]]  #: line along x and z, none if it faces y; for maps [m]

    def overlaps(self, other: Patch) -> bool:
        """Whether both patches face the same side and share more than an edge."""
        if np.dot(self.normal, other.normal) < _SAME:
            return False
        low, high = np.maximum(self.low, other.low), np.minimum(self.high, other.high)
        least = np.minimum(np.subtract(self.high, self.low), np.subtract(other.high, other.low))
        return bool(np.all(high - low > _EDGE * least))


def box_around(specimen: SolidSpecimen) -> tuple[FloatArray, FloatArray]:
    """Return the corners of the box around a 3D specimen [m]."""
    sizes = specimen.dimensions
    if specimen.kind == "box":
        return np.zeros(3), np.array([sizes["width"], sizes["depth"], sizes["height"]])
    half = 0.5 * sizes["diameter"]
    if specimen.kind == "cylinder":
        return np.array([-half, -half, 0.0]), np.array([half, half, sizes["height"]])
    bottom = 0.0 if specimen.kind == "solid-half-disc" else -half
    return np.array([-half, 0.0, bottom]), np.array([half, sizes["depth"], half])


def side_patch(specimen: SolidSpecimen, side: int) -> Patch:
    """Return the patch of an entire flat side.

    Raises:
        InputError: for a side that is not flat or does not exist.
    """
    flat = FLAT[specimen.kind]
    if side not in flat:
        raise InputError(
            f"platen: side = {side}, must be one of {', '.join(map(str, flat))}, the flat sides of "
            f"a {specimen.kind}; use support() elsewhere"
        )
    low, high = box_around(specimen)
    place = 0.5 * (low + high)
    normal = np.array(INWARDS[side])
    across = int(np.argmax(np.abs(normal)))
    place[across] = (low if normal[across] > 0.0 else high)[across]
    edges = high - low
    edges[across] = 0.0
    return patch_around(specimen, place, edges, normal)


def sides_under(specimen: SolidSpecimen, side: object, hole: object) -> list[int]:
    """Return the sides of a 3D specimen in a call of ``fluid``, also a lateral surface.

    Raises:
        InputError: for a side or hole that does not exist.
    """
    if (side is None) == (hole is None):
        raise InputError("fluid: give exactly one of side and hole")
    if hole is not None:
        there = len(specimen.holes)
        if not there:
            raise InputError(f"fluid: hole = {quoted(hole)}, the specimen has none; give a side")
        bounds = Bounds(at_least=0, at_most=there - 1)
        return [_HOLE + require_whole("fluid: hole", hole, bounds)]
    sides, flat = sides_of(side), sorted({*FLAT[specimen.kind], _MANTLE})
    if strange := [one for one in sides if one not in flat]:
        raise InputError(
            f"fluid: side = {strange[0]}, must be one of {', '.join(map(str, flat))}, the sides "
            f"of a {specimen.kind}; choose one of them"
        )
    return sides


def patch_around(
    specimen: SolidSpecimen, place: Vector | FloatArray, edges: FloatArray, normal: FloatArray
) -> Patch:
    """Return the patch in a box around a position.

    Along the normal the box extends to at least half a mean diameter from the position. A box that
    reaches the end of the specimen is extended beyond it, independent of round-off.

    Args:
        specimen: The 3D specimen.
        place: x, y and z of the middle of the box [m].
        edges: Lengths of the box along x, y and z [m].
        normal: Direction into the specimen.
    """
    off = _OFF * specimen.mean_diameter
    least, most = box_around(specimen)
    low, high = place - 0.5 * edges, place + 0.5 * edges
    across = int(np.argmax(np.abs(normal)))
    low[across], high[across] = (
        min(low[across], place[across] - off),
        max(high[across], place[across] + off),
    )
    line = np.clip([low, high], least, most)
    line[:, across] = place[across]
    hair = 1e-9 * (most - least)
    low = np.where(low <= least + hair, low - off, low)
    high = np.where(high >= most - hair, high + off, high)
    trace = [] if across == _DEPTH else line[:, [0, 2]].tolist()
    return Patch(_vector(normal / np.linalg.norm(normal)), _vector(low), _vector(high), trace)


def edges_of(length: object) -> FloatArray:
    """Return the edges of a box, (3,) [m], from a number or from three numbers.

    Raises:
        InputError: for another value, or a number that is not above 0.
    """
    if isinstance(length, list | tuple | np.ndarray):
        edges = require_vector("support: length", length, axes=SPACE)
        return np.array([require_number("support: length", one, POSITIVE, "m") for one in edges])
    return np.full(3, require_number("support: length", length, POSITIVE, "m"))


def inwards_at(specimen: SolidSpecimen, place: Vector) -> FloatArray:
    """Return the unit normal into the specimen of the flat side on which a position is.

    Raises:
        InputError: for a position that is not on a flat side.
    """
    low, high = box_around(specimen)
    off = {}
    for side in FLAT[specimen.kind]:
        normal = np.array(INWARDS[side])
        across = int(np.argmax(np.abs(normal)))
        at = (low if normal[across] > 0.0 else high)[across]
        off[side] = abs(place[across] - at)
    nearest = min(off, key=lambda side: off[side])
    if off[nearest] > _OFF * specimen.mean_diameter:
        raise InputError(
            f"support: position = {place}, is {off[nearest]:.3g} m off the nearest flat side, must "
            "be on one; or give the normal"
        )
    return np.array(INWARDS[nearest])


def _vector(values: FloatArray) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
