# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens of bonded grains: discs, their Laguerre cells, and figures of them, paper Sec. 3.1."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._plugin import load_kernel
from ..errors import InputError
from ..progress import Progress
from . import packing
from .checks import (
    SHORT_EDGE,
    disc_rows,
    require_diameters,
    require_number,
    require_positive,
    require_seed,
    require_short_edge,
    rows,
)

_FEWEST_DISCS = 8


@dataclass(frozen=True)
class Circle:
    """Circular outline.

    Attributes:
        x: Centre [m].
        y: Centre [m].
        radius: Radius [m].
    """

    x: float
    y: float
    radius: float


@dataclass(frozen=True, eq=False)
class Specimen:
    """Bonded grains that fill an outline. Make it by ``rectangle``, ``disc`` or ``from_discs``.

    Attributes:
        discs: Rows x, y, radius [m], one per grain.
        outline: Corners, counter-clockwise, (n, 2) [m], or a circle.
        thickness: Out of plane [m].
        tessellation: Cells of the grains; cell i belongs to disc i.
        kind: ``rectangle``, ``disc`` or ``polygon``.
        dimensions: ``width`` and ``height``, or ``diameter`` [m]; empty for a polygon.
        seed: Seed of a generated packing, else None.
        short_edge: Edges of cells below this share of the mean diameter were collapsed [-].
        removed_discs: Generated discs that had no cell and were left out.
        minerals: Index of each grain's mineral in its material; None: drawn by area fractions.
    """

    discs: np.ndarray
    outline: np.ndarray | Circle
    thickness: float
    tessellation: Any
    kind: str
    dimensions: dict[str, float]
    seed: int | None
    short_edge: float
    removed_discs: int = 0
    minerals: np.ndarray | None = None

    @classmethod
    def rectangle(
        cls,
        width: float,
        height: float,
        thickness: float,
        diameters: tuple[float, float] = (2e-3, 4e-3),
        porosity: float = 0.10,
        seed: int = 1,
        *,
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> Specimen:
        """Pack a rectangle with its lower left corner at the origin; y is the axial direction.

        Args:
            width: Along x [m].
            height: Along y [m].
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        require_positive("Specimen.rectangle", width=width, height=height)
        frame = packing.Frame(width=width, height=height)
        corners = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
        return _generate(
            cls, frame, corners, thickness, diameters, porosity, seed, short_edge, progress
        )

    @classmethod
    def disc(
        cls,
        diameter: float,
        thickness: float,
        diameters: tuple[float, float] = (2e-3, 4e-3),
        porosity: float = 0.10,
        seed: int = 1,
        *,
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> Specimen:
        """Pack a disc about the origin; its rim is one chord per boundary grain.

        Args:
            diameter: Of the specimen [m].
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        require_positive("Specimen.disc", diameter=diameter)
        frame = packing.Frame(radius=0.5 * diameter)
        outline = Circle(0.0, 0.0, 0.5 * diameter)
        return _generate(
            cls, frame, outline, thickness, diameters, porosity, seed, short_edge, progress
        )

    @classmethod
    def from_discs(
        cls,
        centres: Sequence[Sequence[float]] | np.ndarray,
        radii: Sequence[float] | np.ndarray,
        outline: Sequence[Sequence[float]] | np.ndarray | Circle,
        thickness: float,
        *,
        short_edge: float = SHORT_EDGE,
    ) -> Specimen:
        """Make a specimen of given discs; every disc must have a cell.

        Args:
            centres: Rows x, y [m], inside the outline.
            radii: One per centre [m].
            outline: Corners of a convex polygon, counter-clockwise [m], or a circle.
            thickness: Out of plane [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-]; 0: none.

        Returns:
            The specimen, grains in the order of the discs.

        Raises:
            InputError: for a value out of range, a disc outside the outline or hidden by others.
        """
        require_positive("Specimen.from_discs", thickness=thickness)
        discs = disc_rows(centres, radii)
        if not isinstance(outline, Circle):
            outline = rows("Specimen.from_discs: outline", outline)
        return _tessellated(cls, discs, outline, thickness, seed=None, short_edge=short_edge)

    def with_minerals(self, minerals: Sequence[int] | np.ndarray) -> Specimen:
        """Return the same grains, each of a given mineral.

        Args:
            minerals: For each grain an index into the minerals of the material.

        Raises:
            InputError: if it is not one index for each grain.
        """
        given = np.asarray(minerals)
        if given.shape != (len(self.discs),) or given.dtype.kind not in "iu" or given.min() < 0:
            raise InputError(
                f"Specimen.with_minerals: minerals = {given.dtype} array of shape {given.shape}, "
                f"must be {len(self.discs)} indices from 0, one for each grain"
            )
        given = given.astype(np.int32)
        given.setflags(write=False)
        return dataclasses.replace(self, minerals=given)

    @property
    def centres(self) -> np.ndarray:
        """Centres of the discs, (n, 2) [m]."""
        return self.discs[:, :2]

    @property
    def radii(self) -> np.ndarray:
        """Radii of the discs [m]."""
        return self.discs[:, 2]

    @property
    def mean_diameter(self) -> float:
        """Mean diameter of the discs [m]."""
        return 2.0 * float(np.mean(self.discs[:, 2]))

    def meshes(self, mesh: str = "refined") -> Any:
        """Mesh the grains.

        Args:
            mesh: ``refined`` or ``fan``.

        Returns:
            The kernel's meshes: nodes, triangles and their offsets per grain as arrays.

        Raises:
            InputError: for an unknown mesh.
        """
        centres, radii = _columns(self.discs)
        return _call(load_kernel().grain_meshes, self.tessellation, centres, radii, mesh)

    def statistics(self) -> dict[str, float | int | dict[str, float]]:
        """Count and measure grains, contacts, cells and meshes.

        Returns:
            Counts, areas [m^2], lengths [m], angles [degree]; see the keys.
        """
        cells = self.tessellation
        refined, fan = self.meshes("refined"), self.meshes("fan")
        contacts = len(cells.shared_edges)
        lengths = self._edge_lengths()
        shares = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)
        return {
            "grains": cells.cells,
            "contacts": contacts,
            "uncollapsed_contacts": cells.uncollapsed_shared_edges,
            "removed_discs": self.removed_discs,
            "boundary_edges": len(cells.boundary_edges),
            "cell_vertices": len(cells.cell_vertices),
            "refined_nodes": len(refined.nodes),
            "refined_triangles": len(refined.triangles),
            "fan_nodes": len(fan.nodes),
            "fan_triangles": len(fan.triangles),
            "refined_smallest_angle": math.degrees(refined.smallest_angle.min()),
            "fan_smallest_angle": math.degrees(fan.smallest_angle.min()),
            "flipped_meshes": int((1 - refined.standard).sum() - refined.fallback.sum()),
            "fan_fallbacks": int(refined.fallback.sum()),
            "moved_centres": int(refined.moved_centre.sum()),
            "cell_area": math.fsum(cells.cell_areas),
            "smallest_cell_area": float(cells.cell_areas.min()),
            "edge_length": {f"{p:.2f}": float(np.quantile(lengths, p)) for p in shares},
            "coordination": 2.0 * contacts / cells.cells,
            "mean_diameter": self.mean_diameter,
        }

    def _edge_lengths(self) -> np.ndarray:
        """Lengths of contacts, or of the rim if there is one grain only [m]."""
        cells = self.tessellation
        edges = cells.shared_edges[:, 2:4]
        ends = cells.vertices[edges if len(edges) else cells.boundary_edges[:, 1:3]]
        return np.hypot(*(ends[:, 1] - ends[:, 0]).T)


def _generate(
    cls: type[Specimen],
    frame: packing.Frame,
    outline: np.ndarray | Circle,
    thickness: float,
    diameters: tuple[float, float],
    porosity: float,
    seed: int,
    short_edge: float,
    progress: Progress | None,
) -> Specimen:
    where = "Specimen.disc" if isinstance(outline, Circle) else "Specimen.rectangle"
    require_positive(where, thickness=thickness)
    smallest, largest = require_diameters(where, diameters, frame)
    require_seed(where, seed)
    seed = int(seed)  # numpy's integers do not convert
    require_number(where, porosity=porosity)
    require_short_edge(short_edge)
    area = math.pi * frame.radius**2 if frame.radius else frame.width * frame.height
    kernel = load_kernel()
    count = _call(kernel.disc_count, area, smallest, largest, float(porosity))
    if count < _FEWEST_DISCS:
        raise InputError(
            f"{where}: discs = {count}, must be >= {_FEWEST_DISCS} to fill the specimen; "
            "choose smaller diameters"
        )
    radii = _call(kernel.disc_radii, count, smallest, largest, seed)
    mean = 0.5 * (smallest + largest)
    centres, radii = _call(packing.pack, frame, radii, mean, seed, progress)
    discs = np.column_stack((centres, radii))
    return _tessellated(cls, discs, outline, thickness, seed=seed, short_edge=short_edge)


def _tessellated(
    cls: type[Specimen],
    discs: np.ndarray,
    outline: np.ndarray | Circle,
    thickness: float,
    *,
    seed: int | None,
    short_edge: float,
) -> Specimen:
    """Tessellate; drop hidden discs of a generated packing (those with a seed)."""
    require_short_edge(short_edge)
    kernel = load_kernel()
    if isinstance(outline, Circle):
        shape = _call(kernel.Outline.circle, outline.x, outline.y, outline.radius)
        kind, dimensions = "disc", {"diameter": 2.0 * outline.radius}
    else:
        shape = _call(kernel.Outline.polygon, outline)
        kind, dimensions = _kind_of(outline)
    given, generated = len(discs), seed is not None
    while True:
        length = short_edge * 2.0 * float(np.mean(discs[:, 2])) if len(discs) else 0.0
        cells = _call(kernel.tessellate, *_columns(discs), shape, length, generated)
        if len(cells.hidden_discs) == 0:
            break
        discs = np.delete(discs, cells.hidden_discs, axis=0)
    discs.setflags(write=False)
    return cls(
        discs=discs,
        outline=outline,
        thickness=float(thickness),
        tessellation=cells,
        kind=kind,
        dimensions=dimensions,
        seed=seed,
        short_edge=short_edge,
        removed_discs=given - len(discs),
    )


def _kind_of(corners: np.ndarray) -> tuple[str, dict[str, float]]:
    """A rectangle starts at its lower left corner and has sides along x and y."""
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    box = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    if corners.shape == (4, 2) and np.array_equal(corners, box):
        return "rectangle", {"width": float(x1 - x0), "height": float(y1 - y0)}
    return "polygon", {}


def _call(function: Any, *arguments: Any) -> Any:
    """Call the kernel; its complaint about a value becomes an InputError."""
    try:
        return function(*arguments)
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(error)) from None


def _columns(discs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.ascontiguousarray(discs[:, :2]), np.ascontiguousarray(discs[:, 2])
