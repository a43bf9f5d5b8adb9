# SPDX-License-Identifier: GPL-3.0-or-later
"""Polyhedral cells that were given, not made from spheres (D97). Lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..._flexpm import Polyhedra, Solid, WeightedCells, own_polyhedra
from ...arrays import FloatArray, IntArray
from ...files import Table
from ...joints.planes import JointPlane
from ..files.rules import refuse
from ..kernel_input import call, checksum
from .cuts import kernel_holes, kernel_planes
from .frame import SolidFrame
from .spec import SolidSpec

#: Kinds of specimens that given cells can fill.
KINDS = ("box", "cylinder", "solid-disc")
#: Faces smaller than this share of the mean one have normals of few digits [-].
_SMALL = 1e-4
#: Angle between facets of a mantle above it [rad].
_TURN = 1e-4


@dataclass(frozen=True, eq=False)
class OwnCells:
    """Cells as the faces they share.

    Attributes:
        vertices: Rows x, y, z [m].
        pairs: Rows of the cells of each face, the lower one first, -1: outside.
        offsets: Face i has the corners from ``offsets[i]`` to before ``offsets[i + 1]``.
        corners: Vertices, face after face, counter-clockwise as seen from outside the first cell.
        pore_spheres: Rows x, y, z, radius [m] of the last cells, which are pores: as `spheres`.
            Pores are taken out, and their walls are free.
    """

    vertices: FloatArray
    pairs: IntArray
    offsets: IntArray
    corners: IntArray
    pore_spheres: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))

    @classmethod
    def of_rings(cls, vertices: FloatArray, pairs: IntArray, rings: list[list[int]]) -> OwnCells:
        """The same of faces whose corners go round in any sense."""
        offsets = np.cumsum([0, *map(len, rings)], dtype=np.int32)
        corners = np.fromiter((v for ring in rings for v in ring), np.int32, int(offsets[-1]))
        given = cls(vertices, pairs, offsets, corners)
        starts = offsets[:-1]
        inside = given._middles()[pairs[:, 0]]
        away = vertices[corners[starts]] - inside
        turned = np.einsum("ij,ij->i", given.areas(), away) < 0.0
        sizes = np.diff(offsets)
        face = np.repeat(np.arange(len(rings)), sizes)
        at = np.arange(len(corners))
        mirrored = starts[face] + offsets[1:][face] - 1 - at
        corners = corners[np.where(turned[face], mirrored, at)]
        return cls(vertices, pairs, offsets, corners)

    @classmethod
    def of_weighted(cls, cells: WeightedCells) -> OwnCells:
        """Return power cells as given cells."""
        return cls(cells.vertices, *cells.faces)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return int(self.pairs.max()) + 1

    @property
    def neighbours(self) -> IntArray:
        """Cells that share a face, rows of two, lower numbers first, in their order."""
        found: IntArray = np.unique(self.pairs[self.pairs[:, 1] >= 0], axis=0)
        return found

    def measured(self) -> tuple[FloatArray, FloatArray]:
        """Volume [m3] and centroid [m] of each cell."""
        inside = self._middles()
        volumes, moments = np.zeros(self.cells), np.zeros((self.cells, 3))
        faces, first, here, after = self._triangles()
        for side, sign in ((0, 1.0), (1, -1.0)):
            cell = self.pairs[faces, side]
            kept = cell >= 0
            cell = cell[kept]
            a, b, c = (self.vertices[v[kept]] - inside[cell] for v in (first, here, after))
            volume = sign / 6.0 * np.einsum("ij,ij->i", a, np.cross(b, c))
            volumes += np.bincount(cell, volume, self.cells)
            for axis in range(3):
                moment = 0.25 * volume * (a + b + c)[:, axis]
                moments[:, axis] += np.bincount(cell, moment, self.cells)
        with np.errstate(divide="ignore", invalid="ignore"):  # the kernel refuses such cells
            return volumes, inside + moments / volumes[:, None]

    @property
    def grains(self) -> int:
        """Number of cells that are no pores: the first ones."""
        return self.cells - len(self.pore_spheres)

    def with_pores(self, number: int) -> OwnCells:
        """Return the same cells, of which the last ones are pores."""
        return replace(self, pore_spheres=self.spheres()[self.cells - number :])

    def spheres(self) -> FloatArray:
        """Rows x, y, z, radius [m]: centroid of each cell, and the ball of its volume."""
        volumes, centroids = self.measured()
        return np.column_stack((centroids, np.cbrt(0.75 / np.pi * volumes)))

    def polyhedra(
        self, spheres: FloatArray, spec: SolidSpec, planes: Sequence[JointPlane] = ()
    ) -> Polyhedra:
        """The kernel's cells, short edges collapsed, without pores.

        Args:
            spheres: Rows of the grains, see `spheres`.
            spec: Shape, sizes and limit of edges, which refers to the mean diameter of the grains.
            planes: Planes of joints that cut the cells before short edges are collapsed, as the
                holes of the spec do.

        Raises:
            InputError: for cells that are not closed, plane and convex, or do not fill the box or
                cylinder; names cell and face, counted from 1.
        """
        short = spec.short_edge * 2.0 * float(np.mean(spheres[:, 3]))
        faces = (self.pairs, self.offsets, self.corners)
        every = np.vstack((spheres, self.pore_spheres))
        pores = np.arange(self.grains, self.cells, dtype=np.int32)
        cut = kernel_planes(planes), kernel_holes(spec)
        outline = self.outline(spec)
        return call(own_polyhedra, self.vertices, faces, every, outline, short, pores, *cut)

    def outline(self, spec: SolidSpec) -> Solid:
        """Return the outline of the cells; its lateral surface has the facets of the cells."""
        grain = 1.0
        if spec.diameter is not None:
            axis = 2 if spec.kind == "cylinder" else 1
            grain = math.pi * spec.diameter / max(1, len(self.mantle(axis)))
        return SolidFrame.of(spec, grain).solid()

    def mantle(self, axis: int = 2) -> FloatArray:
        """Facets of outer faces along an axis: rows of their angle about it [rad] and offset [m].

        Args:
            axis: 2: z, of a cylinder; 1: y, of a disc.
        """
        outer = np.flatnonzero(self.pairs[:, 1] < 0)
        turned = [*range(axis + 1, 3), *range(axis + 1)]  # the axis comes last
        vertices = self.vertices[:, turned]
        areas = self.areas()[outer][:, turned]
        sizes = np.linalg.norm(areas, axis=1)
        kept = (np.abs(areas[:, 2]) < _TURN * sizes) & (sizes > _SMALL * sizes.mean())
        outer, areas = outer[kept], areas[kept]
        angles = np.arctan2(areas[:, 1], areas[:, 0])
        order = np.argsort(angles)
        first = np.diff(angles[order], prepend=angles[order[-1:]] - 2.0 * math.pi) > _TURN
        facet = np.empty(len(order), dtype=int)
        facet[order] = (np.cumsum(first) - 1) % max(1, int(first.sum()))
        x, y = (np.bincount(facet, one) for one in areas[:, :2].T)
        angle_of = np.arctan2(y, x)
        at = vertices[self.corners[self.offsets[outer]]]
        offsets = at[:, 0] * np.cos(angle_of[facet]) + at[:, 1] * np.sin(angle_of[facet])
        return np.column_stack((angle_of, np.bincount(facet, offsets) / np.bincount(facet)))

    def checksum(self) -> str:
        """Short hash of all of it."""
        faces = (self.pairs.ravel(), self.offsets, self.corners)
        parts = (self.vertices.ravel(), *faces, self.pore_spheres.ravel())
        return checksum(np.concatenate([np.asarray(part, dtype=float) for part in parts]))

    def fields(self) -> Table:
        """As lists, for a file."""
        rings = np.split(self.corners, self.offsets[1:-1])
        both = zip(self.pairs.tolist(), rings, strict=True)
        faces = [[*pair, *ring.tolist()] for pair, ring in both]
        found = {"vertices": self.vertices.tolist(), "faces": faces}
        pores = self.pore_spheres.tolist()
        return found | ({"pore_spheres": pores} if pores else {})

    @classmethod
    def of_file(cls, content: Table) -> OwnCells | None:
        """Return the cells of a file; None if its cells follow from spheres.

        Raises:
            InputError: for cells that are not those the file says it was made from.
        """
        spec, vertices, faces = content["spec"], content.get("vertices"), content.get("faces")
        if (vertices is None, faces is None) != (spec.cells is None, spec.cells is None):
            raise refuse(f"spec cells = {spec.cells}, with vertices or faces missing or too many")
        if vertices is None or faces is None:
            return None
        offsets = np.cumsum([0, *(len(face) - 2 for face in faces)], dtype=np.int32)
        corners = np.array([v for face in faces for v in face[2:]], dtype=np.int32)
        pairs = np.array([face[:2] for face in faces], dtype=np.int32)
        pores = np.array(content.get("pore_spheres", ()), dtype=float).reshape(-1, 4)
        found = cls(np.array(vertices, dtype=float), pairs, offsets, corners, pores)
        if found.checksum() != spec.cells:
            raise refuse(f"cells do not fit the checksum {spec.cells}")
        return found

    def _triangles(self) -> tuple[IntArray, IntArray, IntArray, IntArray]:
        """Face, and three vertices, of the triangles that each face's first corner has."""
        at = np.arange(len(self.corners))
        face = np.repeat(np.arange(len(self.pairs)), np.diff(self.offsets))
        starts, last = self.offsets[:-1][face], self.offsets[1:][face] - 1
        kept = (at > starts) & (at < last)
        at, face = at[kept], face[kept]
        corners = self.corners
        return face, corners[starts[kept]], corners[at], corners[at + 1]

    def areas(self) -> FloatArray:
        """Area vector of each face, out of its first cell [m2]."""
        face, first, here, after = self._triangles()
        origin = self.vertices[first]
        crossed = np.cross(self.vertices[here] - origin, self.vertices[after] - origin)
        columns = [np.bincount(face, 0.5 * one, len(self.pairs)) for one in crossed.T]
        return np.column_stack(columns)

    def _middles(self) -> FloatArray:
        """A point within each cell, if it is convex: the mean of the corners of its faces."""
        sums, counts = np.zeros((self.cells, 3)), np.zeros(self.cells)
        face = np.repeat(np.arange(len(self.pairs)), np.diff(self.offsets))
        for side in range(2):
            cell = self.pairs[face, side]
            kept = cell >= 0
            cell, places = cell[kept], self.vertices[self.corners[kept]]
            counts += np.bincount(cell, minlength=self.cells)
            for axis in range(3):
                sums[:, axis] += np.bincount(cell, places[:, axis], self.cells)
        middles: FloatArray = sums / np.maximum(counts, 1.0)[:, None]
        return middles
