# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed lines along which a specimen is excavated later, and which cells lie within. SI units.

Deviation D77.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from numbers import Real

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import InputError
from ..require import POSITIVE, quoted, require_number
from .bend import largest_bend
from .lines import EXCAVATION, Line, checked

#: Chords of a circle for each mean diameter along it, and fewest of all.
_CHORDS, _FEWEST = 4.0, 24
#: Part of an edge that is round-off [-].
_ROUND_OFF = 1e-9


@dataclass(frozen=True, eq=False)
class Excavation:
    """Content of a closed line that is cut into the cells.

    Attributes:
        name: Name of the line.
        line: Its corners, the first one again at the end [m].
        cells: Numbers of the cells within.
        area: Area of these cells [m2].
        asked_area: Area within the line [m2].
        raggedness: Largest distance of the wall from the line [m].
    """

    name: str
    line: Line = field(repr=False)
    cells: IntArray = field(repr=False)
    area: float
    asked_area: float
    raggedness: float

    def contains(self, points: FloatArray) -> BoolArray:
        """Whether points, (n, 2) [m], lie within the line."""
        return _within(np.array(self.line[:-1]), points)


def ring_of(name: str, given: object, grain: float) -> FloatArray:
    """Corners of a polygon, rows x, y, or of a circle, its centre and radius [m].

    Args:
        name: Name of the excavation.
        given: The polygon, or ``((x, y), radius)``.
        grain: Mean diameter of the grains [m]; a circle has four chords for each along it.

    Raises:
        InputError: for other input.
    """
    if isinstance(given, Sequence) and len(given) == 2 and isinstance(given[1], Real):
        centre, radius = given
        radius = require_number(f"excavation {name}: radius", radius, POSITIVE, "m")
        if np.shape(centre) != (2,):
            raise InputError(
                f"excavation {name}: centre = {quoted(centre)}, must be x and y; give them in m"
            )
        x, y = (require_number(f"excavation {name}: centre", one, unit="m") for one in centre)
        chords = max(math.ceil(_CHORDS * 2.0 * math.pi * radius / grain), _FEWEST)
        angles = [2.0 * math.pi * k / chords for k in range(chords)]
        return np.array([(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles])
    try:
        (line,) = checked({EXCAVATION + name: given}, excavations=True)[EXCAVATION + name]
    except (InputError, ValueError, TypeError):
        raise InputError(
            f"excavation {quoted(name)} = {quoted(given)}, must be a polygon, rows x, y, or a "
            "circle, ((x, y), radius), under a name without spaces; correct it"
        ) from None
    corners = np.array(line[:-1] if line[0] == line[-1] else line)
    if len(corners) < 3:
        raise InputError(
            f"excavation {name}: corners = {len(corners)}, must be at least 3; give a polygon or "
            "((x, y), radius)"
        )
    return corners


def line_from_edge(name: str, ring: FloatArray, edges: FloatArray) -> Line:
    """The closed line from a place where it meets an edge of a cell.

    A line that began within a cell would end there, too, and leave it whole.

    Args:
        name: Name of the excavation.
        ring: Corners [m].
        edges: Edges between cells, (n, 2, 2) [m].

    Raises:
        InputError: if it meets none.
    """
    starts, ways = edges[:, 0], edges[:, 1] - edges[:, 0]
    for margin in (0.1, -_ROUND_OFF):  # in the middle of an edge, else at its end
        for number, corner in enumerate(ring):
            way = ring[(number + 1) % len(ring)] - corner
            across = way[0] * ways[:, 1] - way[1] * ways[:, 0]
            apart = starts - corner
            with np.errstate(divide="ignore", invalid="ignore"):
                along = (apart[:, 0] * ways[:, 1] - apart[:, 1] * ways[:, 0]) / across
                share = (apart[:, 0] * way[1] - apart[:, 1] * way[0]) / across
            meets = np.flatnonzero(
                (along >= 0.0) & (along < 1.0) & (np.abs(share - 0.5) <= 0.5 - margin)
            )
            if len(meets):
                place = corner + along[meets[0]] * way
                turned = np.roll(ring, -number - 1, axis=0)
                return [(float(x), float(y)) for x, y in (place, *turned, place)]
    raise InputError(
        f"excavation {name}: edges of cells that its line meets = 0, must be at least 1; make it "
        "larger, or the grains smaller"
    )


def excavation_of(
    name: str, line: Line, cells: Sequence[FloatArray], pairs: IntArray, edges: FloatArray
) -> Excavation:
    """Return the cells whose middle is within a line.

    Args:
        name: Name of the excavation.
        line: Closed line that was cut [m].
        cells: Corners of each cell [m].
        pairs: Cells on both sides of each edge between cells, (n, 2).
        edges: Places of both ends of these edges, (n, 2, 2) [m].
    """
    ring = np.array(line[:-1])
    measured = [_middle(corners) for corners in cells]
    inside = _within(ring, np.array([middle for _, middle in measured]))
    areas = np.array([area for area, _ in measured])
    wall = edges[inside[pairs[:, 0]] != inside[pairs[:, 1]]]
    return Excavation(
        name=name,
        line=line,
        cells=np.flatnonzero(inside).astype(np.int32),
        area=float(areas[inside].sum()),
        asked_area=abs(_middle(ring)[0]),
        raggedness=max(largest_bend([line], wall), _distance(ring, wall)),
    )


def _distance(points: FloatArray, segments: FloatArray) -> float:
    """Largest distance of points, (n, 2), from the nearest of segments, (m, 2, 2) [m]."""
    starts, ways = segments[:, 0], segments[:, 1] - segments[:, 0]
    apart = points[:, None] - starts
    share = np.einsum("nmc,mc->nm", apart, ways) / np.einsum("mc,mc->m", ways, ways)
    apart -= np.clip(share, 0.0, 1.0)[..., None] * ways
    return float(np.hypot(*np.moveaxis(apart, -1, 0)).min(axis=1, initial=np.inf).max())


def _middle(corners: FloatArray) -> tuple[float, FloatArray]:
    """Area within a polygon, above 0 if it goes round counter-clockwise, and its centroid."""
    places = corners - corners[0]
    following = np.roll(places, -1, axis=0)
    twice = places[:, 0] * following[:, 1] - places[:, 1] * following[:, 0]
    area = 0.5 * float(twice.sum())
    return area, corners[0] + twice @ (places + following) / (6.0 * area)


def _within(ring: FloatArray, points: FloatArray) -> BoolArray:
    """Whether points lie within a polygon: a ray along x from them crosses it an odd time."""
    odd = np.zeros(len(points), dtype=bool)
    for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
        if crosses.any():
            odd ^= crosses & (points[:, 0] < x0 + (x1 - x0) * (points[:, 1] - y0) / (y1 - y0))
    return odd
