# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines of any shape: polygons with holes, and which are rectangles. Lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .._flexpm import PolygonOutline
from ..arrays import FloatArray
from ..errors import InputError
from ..require import quoted
from .kernel_input import Circle, call, ring


def polygon_outline(
    where: str, corners: npt.ArrayLike, holes: Sequence[npt.ArrayLike] = ()
) -> PolygonOutline:
    """Check a polygon and its holes, each in any sense.

    The four corners of a rectangle along x and y start at the lower left corner, so that its sides
    have the indices of a packed rectangle.

    Raises:
        InputError: for a ring that crosses itself or another ring, or is not a ring.
    """
    outer = ring(f"{where}: corners", corners)
    box = box_of(outer)
    for given in (outer, outer[::-1]) if len(outer) == 4 else ():
        if any(np.array_equal(np.roll(given, first, axis=0), box) for first in range(4)):
            outer = box
    if isinstance(holes, str) or not isinstance(holes, Sequence | np.ndarray):
        raise InputError(
            f"{where}: holes = {quoted(holes)}, must be a list of polygons; put one polygon in "
            "brackets, too"
        )
    inner = [ring(f"{where}: hole {number}", hole) for number, hole in enumerate(holes)]
    return call(PolygonOutline, outer, inner)


def box_of(corners: FloatArray) -> FloatArray:
    """Return the corners of the box around points, counter-clockwise from the lower left [m]."""
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])


def half_disc_corners(diameter: float, grain: float) -> FloatArray:
    """Corners of the upper half of a disc that lies on its diameter, from the lower left one [m].

    The arc has a chord for each grain along it, one of them on top.

    Args:
        diameter: Diameter of the disc [m].
        grain: Mean diameter of the grains [m].
    """
    radius = 0.5 * diameter
    chords = 2 * round(0.25 * math.pi * diameter / grain) + 1
    angles = [math.pi * k / chords for k in range(chords + 1)]
    # numpy has cosines of its own on some processors: packings would differ between machines
    arc = radius * np.array([(1.0 + math.cos(angle), math.sin(angle)) for angle in angles])
    arc[-1] = 0.0  # its sine is not quite 0
    return np.vstack((arc[-1:], arc[:-1]))


def kind_of(outline: FloatArray | Circle) -> tuple[str, dict[str, float]]:
    """Shape and sizes; a rectangle starts at its lower left corner, with sides along x and y."""
    if isinstance(outline, Circle):
        return "disc", {"diameter": 2.0 * outline.radius}
    box = box_of(outline)
    if outline.shape == (4, 2) and np.array_equal(outline, box):
        width, height = box[2] - box[0]
        return "rectangle", {"width": float(width), "height": float(height)}
    return "polygon", {}


def area_of(ring: FloatArray) -> float:
    """Area within corners, (n, 2) [m]; above zero if they go round counter-clockwise [m2]."""
    x, y = (ring - ring[0]).T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
