# SPDX-License-Identifier: GPL-3.0-or-later
"""Tessellations of Neper: 2D ``.tess`` files, and functions that 3D files share with them.

Lengths in the file's unit. Neper's documentation describes the format, "Tessellation File".
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...arrays import FloatArray, IntArray
from ...require import LENGTH, require_number
from ..outlines import area_of, box_of
from .neper_text import Words, tess_dimension

#: Most cells, and most vertices and edges of them.
MOST_CELLS, _MOST = 100_000, 1_000_000
#: Numbers that end a face: its equation, two states, a point.
_AFTER_EDGES = 9
#: Round-off of the files, of the size of the whole [-].
_ROUNDED = 1e-9


@dataclass(frozen=True)
class PlaneTess:
    """A 2D tessellation.

    Attributes:
        vertices: Rows x, y.
        cells: Vertices of each cell, in the order of their ring.
        centres: Seeds of the cells, rows x, y; None if the file has none.
        radii: Radii of discs about the seeds whose Laguerre cells these may be.
    """

    vertices: FloatArray
    cells: list[list[int]]
    centres: FloatArray | None = None
    radii: tuple[FloatArray, ...] = ()

    @property
    def polygons(self) -> list[FloatArray]:
        """Corners of each cell."""
        return [self.vertices[cell] for cell in self.cells]

    @property
    def areas(self) -> FloatArray:
        """Area of each cell."""
        here = np.concatenate(self.cells)
        after = np.concatenate([[*cell[1:], cell[0]] for cell in self.cells])
        starts = np.cumsum([0, *map(len, self.cells[:-1])])
        (x, y), (next_x, next_y) = self.vertices[here].T, self.vertices[after].T
        found: FloatArray = np.abs(0.5 * np.add.reduceat(x * next_y - next_x * y, starts))
        return found

    @property
    def neighbours(self) -> IntArray:
        """Cells that share an edge, rows of two, lower numbers first, in their order."""
        owners: dict[tuple[int, int], list[int]] = {}
        for number, cell in enumerate(self.cells):
            for edge in _edges(cell):
                owners.setdefault(edge, []).append(number)
        pairs = {tuple(sorted(one)) for one in owners.values() if len(one) == 2}
        return np.array(sorted(pairs), dtype=int).reshape(-1, 2)

    def scaled(self, scale: float) -> PlaneTess:
        """The same with other lengths.

        Raises:
            InputError: for a size that no specimen has [m].
        """
        require_number(
            "Specimen.from_tess: size",
            scale * float(np.ptp(self.vertices, axis=0).max()),
            LENGTH,
            "m",
        )
        centres = None if self.centres is None else scale * self.centres
        radii = tuple(scale * one for one in self.radii)
        return PlaneTess(scale * self.vertices, self.cells, centres, radii)

    def outline(self) -> FloatArray | None:
        """Return the corners of the outline, counter-clockwise; None if it is not one convex ring.

        Corners of a rectangle along x and y are made exact and begin at the lower left.
        """
        count: dict[tuple[int, int], int] = {}
        for cell in self.cells:
            for edge in _edges(cell):
                count[edge] = count.get(edge, 0) + 1
        after: dict[int, list[int]] = {}
        for (a, b), often in count.items():
            if often == 1:
                after.setdefault(a, []).append(b)
                after.setdefault(b, []).append(a)
        if not after or any(len(ends) != 2 for ends in after.values()):
            return None
        start = min(after)
        ring, here, before = [start], after[start][0], start
        while here != start:
            ring.append(here)
            one, other = after[here]
            here, before = other if one == before else one, here
        if len(ring) != len(after):
            return None
        corners = self.vertices[ring]
        if area_of(corners) < 0.0:
            corners = corners[::-1]
        way = np.roll(corners, -1, axis=0) - corners
        come = np.roll(way, 1, axis=0)
        turn = come[:, 0] * way[:, 1] - come[:, 1] * way[:, 0]
        least = _ROUNDED * float(np.ptp(corners, axis=0).max())
        straight = np.abs(turn) <= least * np.maximum(np.hypot(*come.T), np.hypot(*way.T))
        if (turn[~straight] < 0.0).any():
            return None
        return _boxed(np.ascontiguousarray(corners[~straight]), least)


def _boxed(corners: FloatArray, near: float) -> FloatArray:
    """Corners of the box around a ring, if these are its own; else the ring."""
    box = box_of(corners)
    if len(corners) != 4:
        return corners
    begin = int(np.argmin(np.abs(corners - box[0]).sum(axis=1)))
    return box if np.allclose(np.roll(corners, -begin, axis=0), box, 0.0, near) else corners


def _edges(cell: list[int]) -> list[tuple[int, int]]:
    return [(min(e), max(e)) for e in itertools.pairwise([*cell, cell[0]])]


def read(path: Path) -> PlaneTess:
    """Read a tessellation.

    Raises:
        InputError: for a file that cannot be read, is not 2D, or is broken: with its line.
    """
    words = Words(path, "tess")
    dimension = tess_dimension(words)
    if dimension != 2:
        raise words.refused(
            f"dimension = {dimension}, must be 2; use Specimen.from_tess_solid for 3D cells"
        )
    number, seeds = cells_and_seeds(words)
    rows = vertex_rows(words)
    axes, off = plane_of(rows)
    if not off <= _ROUNDED * float(np.ptp(rows, axis=0).max()):
        raise words.refused(
            f"vertices: deviate from a plane by {off:g}, must lie in one plane; cut a slice"
        )
    vertices = rows @ axes[:2].T
    pass_edges(words, len(vertices))
    words.expect("**face")
    words.whole("faces", number, number)
    cells = [face_ring(words, face, len(vertices)) for face in range(1, number + 1)]
    words.skip_to("***end")
    found = PlaneTess(vertices, cells)
    if seeds is None:
        return found
    mean = float(found.areas.mean()) / np.pi
    away = (seeds[:, :3] - rows.mean(axis=0)) @ axes[2]  # seeds of a slice are those in space
    radii = radii_of(seeds[:, 3], mean, away**2)
    return replace(found, centres=seeds[:, :3] @ axes[:2].T, radii=radii)


def plane_of(rows: FloatArray) -> tuple[FloatArray, float]:
    """Axes of the plane that places lie in, and of its normal, and how far they lie off it.

    Axes are those of the frame that are left without the one nearest to the normal: x and y, in
    their order, of a plane that is level; the more level one is turned into the plane, the other is
    across.

    Args:
        rows: Places x, y, z.

    Returns:
        Rows of unit vectors, and the largest distance.
    """
    normal = np.array([0.0, 0.0, 1.0])
    if np.ptp(rows[:, 2]) > 0.0:
        unit = rows / np.abs(rows).max()  # none overflows
        normal = np.linalg.svd(unit - unit.mean(axis=0), full_matrices=False)[2][2]
    least, most = np.argsort(np.abs(normal), kind="stable")[[0, 2]].tolist()
    along = np.eye(3)[least] - normal[least] * normal
    along /= np.linalg.norm(along)
    other = 3 - least - most
    across = np.cross(normal, along)
    across *= np.copysign(1.0, across[other])
    pair = (along, across) if least < other else (across, along)
    off = float(np.ptp(rows @ normal))
    return np.stack((*pair, normal)), off


def radii_of(
    weights: FloatArray, mean: float, away: FloatArray | float = 0.0
) -> tuple[FloatArray, ...]:
    """Return radii of discs or spheres at the seeds whose Laguerre cells may be the file's cells.

    Neper's weights are radii; other programs may store their squares. Cells do not change if the
    same number is added to all squares. This is done until the discs have the size of the cells.

    Args:
        weights: Weights of the seeds.
        mean: Square of the radius of a disc or sphere of the mean cell's size.
        away: Squares of the distances of the seeds from the plane of the cells.
    """
    found = []
    for squares in (weights * np.abs(weights) - away, weights - away):
        least = 0.05 * mean - float(squares.min())
        found.append(np.sqrt(squares + max(mean - float(squares.mean()), least)))
    return tuple(found[:1] if np.all(weights == weights[0]) else found)


def cells_and_seeds(words: Words) -> tuple[int, FloatArray | None]:
    """Number of cells, and rows x, y, z, weight of their seeds, if there are any."""
    words.skip_to("**cell")
    number = words.whole("cells", 2, MOST_CELLS)
    seeds = None
    while words.skip_to("*seed", "**vertex") == "*seed":
        seeds = np.empty((number, 4))
        for seed in range(1, number + 1):
            words.whole(f"seed {seed}: number", seed, seed)
            for column, key in enumerate(("x", "y", "z", "weight")):
                seeds[seed - 1, column] = words.number(f"seed {seed}: {key}")
    return number, seeds


def vertex_rows(words: Words) -> FloatArray:
    """Rows x, y, z of the vertices, whose mark is passed."""
    number = words.whole("vertices", 3, _MOST)
    rows = np.empty((number, 3))
    for vertex in range(1, number + 1):
        words.whole(f"vertex {vertex}: number", vertex, vertex)
        for column, key in enumerate("xyz"):
            rows[vertex - 1, column] = words.number(f"vertex {vertex}: {key}")
        words.number(f"vertex {vertex}: state")
    return rows


def pass_edges(words: Words, vertices: int) -> None:
    """Skip the edges, which the faces repeat."""
    words.expect("**edge")
    for edge in range(1, words.whole("edges", 3, _MOST) + 1):
        words.whole(f"edge {edge}: number", edge, edge)
        for _ in range(2):
            words.whole(f"edge {edge}: vertex", 1, vertices)
        words.number(f"edge {edge}: state")


def face_ring(words: Words, face: int, vertices: int) -> list[int]:
    """Vertices of a face, from 0."""
    words.whole(f"face {face}: number", face, face)
    if words.is_zero:
        raise words.refused(f"face {face}: vertices = 0, is an empty cell; leave out its seed")
    corners = words.whole(f"face {face}: vertices", 3, vertices)
    ring = [words.whole(f"face {face}: vertex", 1, vertices) - 1 for _ in range(corners)]
    if len({*ring}) < corners:
        raise words.refused(f"face {face}: a vertex is given twice; correct it")
    words.whole(f"face {face}: edges", corners, corners)
    for _ in range(corners):
        words.whole(f"face {face}: edge", -_MOST, _MOST)
    for _ in range(_AFTER_EDGES):
        words.number(f"face {face}: equation, state or point")
    return ring
