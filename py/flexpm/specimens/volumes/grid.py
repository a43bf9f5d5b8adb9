# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of voxels in a box: numbers, centroids, neighbours and boundaries. Lengths in metres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from ..label_volumes.label_volume import Labels
from ..labels.regions import shared_sides, sides_along_axes


@dataclass(frozen=True, eq=False)
class Grid:
    """Regions of voxels in a box from the origin.

    Attributes:
        regions: Region of each voxel, (z, y, x).
        spacing: Size of a voxel along x, y, z [m].
        count: Number of regions; each one has a voxel.
        grains: Number of grains: the first regions. The others are pieces of pores.
    """

    regions: Labels
    spacing: FloatArray
    count: int
    grains: int

    @property
    def counts(self) -> tuple[int, int, int]:
        """Number of voxels along x, y, z."""
        z, y, x = self.regions.shape
        return x, y, z

    @property
    def sizes(self) -> FloatArray:
        """Sizes of the box along x, y, z [m]."""
        found: FloatArray = np.array(self.counts) * self.spacing
        return found

    @property
    def voxel(self) -> float:
        """Volume of a voxel [m3]."""
        return float(np.prod(self.spacing))

    def voxels(self) -> IntArray:
        """Number of voxels of each region."""
        found: IntArray = np.bincount(self.regions.ravel(), minlength=self.count)
        return found

    def centroids(self) -> FloatArray:
        """Centroid of each region, (n, 3) [m]."""
        voxels = self.voxels()
        found = np.empty((self.count, 3))
        for axis, size in enumerate(self.spacing.tolist()):
            # sums of whole numbers: exact, in any order
            sums = np.zeros(self.count, dtype=np.int64)
            for k in range(self.counts[axis]):
                layer = np.take(self.regions, k, axis=2 - axis)
                sums += (2 * k + 1) * np.bincount(layer.ravel(), minlength=self.count)
            found[:, axis] = 0.5 * size * sums / voxels
        return found

    def metric(self, centroids: FloatArray) -> FloatArray:
        """Inverse of the mean second moment of the regions about their centroids, with det. 1."""
        sides = np.array(self.counts, dtype=float)
        # sums over all voxels of the box, less those of the centroids
        whole = np.prod(sides) * np.outer(sides, sides) / 4.0
        whole[np.diag_indices(3)] = np.prod(sides) * (4.0 * sides**2 - 1.0) / 12.0
        parts = self.voxels()[:, None, None] * centroids[:, :, None] * centroids[:, None, :]
        moment = whole * np.outer(self.spacing, self.spacing) - np.sum(parts, axis=0)
        moment += np.prod(sides) / 12.0 * np.diag(self.spacing**2)  # of the voxels themselves
        inverse = np.linalg.inv(moment)
        found: FloatArray = inverse / np.cbrt(np.linalg.det(inverse))
        return found

    def neighbours(self) -> IntArray:
        """Pairs of regions that share a side of a voxel, rows of two, the lower one first."""
        return shared_sides(self.regions)[0]

    def agrees(self, found: Labels) -> BoolArray:
        """Whether voxels are in the cell of their region; all pieces of pores are one region."""
        pores = (found >= self.grains) & (self.regions >= self.grains)
        agree: BoolArray = (found == self.regions) | pores
        return agree

    def sides(self) -> list[tuple[Labels, Labels]]:
        """Views of the regions on both sides of each side of voxels, along z, y and x."""
        return sides_along_axes(self.regions)

    def at_boundary(self) -> BoolArray:
        """Whether a voxel shares a side with a voxel of another region."""
        found: BoolArray = np.zeros(self.regions.shape, dtype=bool)
        for values, marks in zip(self.sides(), sides_along_axes(found), strict=True):
            met = values[0] != values[1]
            for mark in marks:
                np.logical_or(mark, met, out=mark)
        return found
