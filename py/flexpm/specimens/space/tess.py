# SPDX-License-Identifier: GPL-3.0-or-later
"""Tessellations of Neper in space, ``.tess``: cells with plane faces. Lengths in metres.

The format is that of Neper's documentation, "Tessellation File".
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..._flexpm import polyhedra
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...require import LENGTH, POSITIVE, quoted, require_number
from ..checks import require_short_edge
from ..files import tess as plane_tess
from ..files.neper_text import Words, tess_dimension
from ..kernel_input import call
from .frame import SolidFrame
from .own_cells import OwnCells
from .specimen import SolidSpecimen

_WHERE = "Specimen.from_tess_solid"
#: Most faces.
_MOST = 1_000_000
#: Share of the box's size up to which a coordinate is that of a side: digits of the files [-].
_ON_A_SIDE = 1e-9
#: Relative difference of volumes up to which cells are the Laguerre cells of seeds [-].
_ALIKE = 1e-7
#: Fewest facets of the kernel's cylinders, and what they may be off a regular prism [-].
_FEWEST_FACETS, _REGULAR = 16, 1e-6


@dataclass(frozen=True)
class SpaceTess:
    """A tessellation in space.

    Attributes:
        cells: The cells, in the file's unit and order.
        seeds: Rows x, y, z, weight in the file's unit; None if the file has none.
    """

    cells: OwnCells
    seeds: FloatArray | None = None

    def in_box(self, scale: float) -> tuple[OwnCells, dict[str, float], FloatArray | None]:
        """Cells in the box around them, which has a corner at the origin, its sizes, and seeds.

        Coordinates that are those of a side but for their digits become so.

        Raises:
            InputError: for a size that no specimen has [m].
        """
        low, high = (end(self.cells.vertices, axis=0) for end in (np.min, np.max))
        size = scale * (high - low)
        names = ("width", "depth", "height")
        _require_sizes(dict(zip(names, size.tolist(), strict=True)))
        near = _ON_A_SIDE * size.max()
        places = scale * (self.cells.vertices - low)
        places = np.where(np.abs(places) <= near, 0.0, places)
        places = np.where(np.abs(places - size) <= near, size, places)
        moved = replace(self.cells, vertices=places)
        sizes = dict(zip(names, size.tolist(), strict=True))
        if self.seeds is None:
            return moved, sizes, None
        seeds = np.column_stack((scale * (self.seeds[:, :3] - low), self.seeds[:, 3]))
        return moved, sizes, seeds

    def in_cylinder(self, scale: float) -> tuple[OwnCells, dict[str, float]] | None:
        """Cells in an upright cylinder about z from z = 0, and its sizes; None: they fill none.

        It is a regular prism, whose diameter is that of its area; its facets are turned to where
        the kernel has them.

        Raises:
            InputError: for a size that no specimen has [m].
        """
        angles, offsets = self.cells.mantle().T
        count = len(angles)
        if count < _FEWEST_FACETS:
            return None
        half = math.pi / count
        # offset of each facet: apothem, and the way of the axis along its normal
        rows = np.column_stack((np.ones(count), np.cos(angles), np.sin(angles)))
        found = np.linalg.lstsq(rows, offsets, rcond=None)[0]
        apothem, middle = float(found[0]), found[1:]
        off = np.abs(rows @ found - offsets).max() / apothem
        steps = np.diff(np.sort(angles), append=angles.min() + 2.0 * math.pi)
        if not max(off, np.abs(steps - 2.0 * half).max()) < _REGULAR:
            return None
        turn = half - float(angles[0])
        x, y = (self.cells.vertices[:, :2] - middle).T
        z = self.cells.vertices[:, 2] - self.cells.vertices[:, 2].min()
        cosine, sine = math.cos(turn), math.sin(turn)
        places = scale * np.column_stack((cosine * x - sine * y, sine * x + cosine * y, z))
        diameter = 2.0 * apothem * math.sqrt(count * math.tan(half) / math.pi)
        sizes = {"diameter": scale * diameter, "height": float(places[:, 2].max())}
        _require_sizes(sizes)
        return replace(self.cells, vertices=places), sizes


def _require_sizes(sizes: dict[str, float]) -> None:
    for name, size in sizes.items():
        require_number(f"{_WHERE}: {name}", size, LENGTH, "m")


def read(path: Path) -> SpaceTess:
    """Read a tessellation.

    Raises:
        InputError: for a file that cannot be read, is none in space, or is broken: with its line.
    """
    words = Words(path, "tess")
    dimension = tess_dimension(words)
    if dimension != 3:
        raise words.refused(
            f"dimension = {dimension}, must be 3; use Specimen.from_tess for 2D cells"
        )
    number, seeds = plane_tess.cells_and_seeds(words)
    vertices = plane_tess.vertex_rows(words)
    plane_tess.pass_edges(words, len(vertices))
    words.expect("**face")
    faces = words.whole("faces", 4, _MOST)
    rings = [plane_tess.face_ring(words, face, len(vertices)) for face in range(1, faces + 1)]
    words.expect("**polyhedron")
    words.whole("polyhedra", number, number)
    pairs = _pairs(words, number, faces)
    words.skip_to("***end")
    return SpaceTess(OwnCells.of_rings(vertices, pairs, rings), seeds)


def _pairs(words: Words, cells: int, faces: int) -> IntArray:
    """Cells of each face, the lower one first, -1: outside."""
    pairs = np.full((faces, 2), -1, dtype=np.int32)
    for cell in range(1, cells + 1):
        words.whole(f"polyhedron {cell}: number", cell, cell)
        if words.is_zero:
            raise words.refused(
                f"polyhedron {cell}: faces = 0, is an empty cell; leave out its seed"
            )
        for _ in range(words.whole(f"polyhedron {cell}: faces", 4, faces)):
            face = abs(words.whole(f"polyhedron {cell}: face", -faces, faces))
            first, second = pairs[face - 1]
            if face == 0 or second >= 0 or first == cell - 1:
                raise words.refused(
                    f"polyhedron {cell}: face = {face}, must belong to one or two polyhedra; "
                    "correct it"
                )
            pairs[face - 1, int(first >= 0)] = cell - 1
    lone = np.flatnonzero(pairs[:, 0] < 0)
    if len(lone):
        raise words.refused(f"face {lone[0] + 1}: polyhedra = 0, must be 1 or 2; remove it")
    return pairs


def specimen_of(path: Path, scale: float, short_edge: float) -> SolidSpecimen:
    """A solid of the cells of a tessellation, see `Specimen.from_tess_solid`."""
    require_short_edge(short_edge)
    given = read(path)
    scale = require_number(f"{_WHERE}: scale", scale, POSITIVE, "m")
    cylinder = given.in_cylinder(scale)
    cells, sizes, seeds = given.in_box(scale) if cylinder is None else (*cylinder, None)
    if seeds is not None:
        volumes, _ = cells.measured()
        mean = (0.75 / np.pi * float(volumes.mean())) ** (2.0 / 3.0) / scale**2
        for radii in plane_tess.radii_of(seeds[:, 3], mean):
            spheres = np.column_stack((seeds[:, :3], scale * radii))
            # seeds outside, hidden or in one place are of no such cells
            with contextlib.suppress(InputError, RuntimeError):
                solid = SolidFrame("box", tuple(sizes.values()), 1.0).solid()
                there = call(polyhedra, spheres, solid, 0.0, False).volumes
                if np.allclose(there, volumes, rtol=_ALIKE, atol=0.0):
                    return SolidSpecimen.of_spheres(spheres, {**sizes}, short_edge=short_edge)
    try:
        kind = "box" if cylinder is None else "cylinder"
        return SolidSpecimen.of_cells(cells, kind, sizes, short_edge)
    except InputError as error:  # of a cell or face, which count as in the file
        raise InputError(f"tess = {quoted(str(path))}: {error}") from None
