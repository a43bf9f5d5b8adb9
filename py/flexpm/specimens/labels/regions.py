# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of labels, connected by edges of pixels or sides of voxels. Lengths in pixels.

Rows of an image are counted upwards: row 0 is the lowest row. A hole has the index -1.
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from ...arrays import BoolArray, IntArray
from ...errors import InputError

HOLE = -1
Values = TypeVar("Values", IntArray, BoolArray)
_WHERE = "Specimen.from_labels"
#: Holes below this share of a mean grain are filled [-]; smaller ones count as gaps of cells.
_LEAST_HOLE = 0.03


@dataclass(frozen=True)
class Regions:
    """Grains of an image.

    Attributes:
        image: Grain index of each pixel; `HOLE` for a pixel without a grain.
        labels: Label of each grain.
        counts: Numbers of regions and pixels that were reassigned, by reason.
    """

    image: IntArray
    labels: IntArray
    counts: dict[str, int]

    @property
    def number(self) -> int:
        """Number of grains."""
        return len(self.labels)


@dataclass(frozen=True)
class Cuts:
    """Edges across which pixels of equal value are not connected."""

    beside: BoolArray  #: with the one to the right, (rows, columns - 1)
    above: BoolArray  #: with the one above, (rows - 1, columns)

    @classmethod
    def none(cls, image: IntArray) -> Cuts:
        """Return no cuts."""
        rows, columns = image.shape
        return cls(
            np.zeros((rows, columns - 1), dtype=bool), np.zeros((rows - 1, columns), dtype=bool)
        )


def connected(image: IntArray, cuts: Cuts | None = None) -> IntArray:
    """Return the index of the connected region of equal values of each pixel, in reading order.

    Args:
        image: Values of the pixels of an image, or of the voxels of a volume.
        cuts: Edges of an image across which pixels are not connected although they are equal.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    index = np.arange(image.size, dtype=np.int32).reshape(image.shape)
    sides = [
        (one == other, at)
        for (one, other), at in zip(sides_along_axes(image), sides_along_axes(index), strict=True)
    ]
    if cuts is not None:
        for (met, _), cut in zip(sides, (cuts.above, cuts.beside), strict=True):
            met &= ~cut
    first, second = (np.concatenate([at[end][met] for met, at in sides]) for end in range(2))
    ones = np.ones(len(first), dtype=np.int8)
    graph = coo_array((ones, (first, second)), shape=(image.size, image.size))
    found: IntArray = connected_components(graph, directed=False)[1].reshape(image.shape)
    return found


def sides_along_axes(image: Values) -> list[tuple[Values, Values]]:
    """Return views of the values on both sides of each edge of pixels, axis by axis."""
    found: list[tuple[Values, Values]] = []
    for axis in range(image.ndim):
        rolled = np.moveaxis(image, axis, 0)
        found.append((np.moveaxis(rolled[:-1], 0, axis), np.moveaxis(rolled[1:], 0, axis)))
    return found


def shared_sides(regions: IntArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of regions that share sides, lower one first, and how many sides."""
    count = int(regions.max()) + 1
    keys = []
    for one, other in sides_along_axes(regions):
        met = one != other
        low, high = np.minimum(one[met], other[met]), np.maximum(one[met], other[met])
        keys.append(low.astype(np.int64) * count + high)
    found, numbers = np.unique(np.concatenate(keys), return_counts=True)
    return np.column_stack(np.divmod(found, count)), numbers


def find(
    labels: IntArray, holes: BoolArray, smallest: int, phases: Mapping[int, int] | None = None
) -> Regions:
    """Return the grains of an image of labels.

    Args:
        labels: Label of each pixel.
        holes: Whether a pixel belongs to a hole.
        smallest: Smallest number of pixels of a region; smaller regions are merged with a
            neighbour.
        phases: Phase of each label; None: each label is a separate phase.

    Raises:
        InputError: if all pixels are holes, or only one region remains.
    """
    marked = np.where(holes, labels.min() - 1, labels)
    regions = connected(marked)
    values = np.empty(regions.max() + 1, dtype=np.int64)
    values[regions] = marked
    is_hole = np.zeros(len(values), dtype=bool)
    is_hole[regions[holes]] = True
    kinds = values
    if phases is not None:  # those of holes are none of the minerals' numbers
        kinds = np.where(is_hole, -1, [phases.get(v, v) for v in values.tolist()])
    counts = {"regions": int(np.count_nonzero(~is_hole))}
    if not counts["regions"]:
        raise InputError("Specimen.from_labels: all labels are holes; choose another phase as hole")
    small = Merging(regions, is_hole, kinds)
    counts["small_regions"] = small.merge(smallest, holes=False)
    rock = int(np.count_nonzero(~holes))
    least = max(smallest, int(_LEAST_HOLE * rock / max(small.grains, 1)) + 1)
    counts["small_holes"] = small.merge(least, holes=True)
    image = np.where(is_hole[small.target], HOLE, small.target)[regions]
    if not (image >= 0).any():
        raise InputError(f"{_WHERE}: all labels are holes or small regions; decrease smallest")
    counts["loose_pixels"] = _drop_loose(image)
    counts["filled_pixels"] = _fill_touching(image)
    kept, numbers = np.unique(image[image >= 0], return_inverse=True)
    if len(kept) < 2:
        raise InputError(f"{_WHERE}: labels = 1 region, must be >= 2; give a larger image")
    image[image >= 0] = numbers
    return Regions(image, values[kept], counts)


class Merging:
    """Merging of regions of pixels or voxels with their neighbours, smallest regions first."""

    def __init__(self, regions: IntArray, is_hole: BoolArray, kinds: IntArray) -> None:
        self.target = np.arange(len(is_hole))  #: region that each one has gone to, once settled
        self._is_hole, self._kinds = is_hole.tolist(), kinds.tolist()
        self._sizes = np.bincount(regions.ravel()).tolist()
        self._lines: list[dict[int, int]] = [{} for _ in self._sizes]
        found, lengths = shared_sides(regions)
        for (a, b), length in zip(found.tolist(), lengths.tolist(), strict=True):
            self._lines[a][b] = self._lines[b][a] = length

    @property
    def grains(self) -> int:
        """Number of remaining regions that are not holes."""
        there = self.target == np.arange(len(self.target))
        return int(np.count_nonzero(there & ~np.array(self._is_hole)))

    def merge(self, smallest: int, *, holes: bool) -> int:
        """Merge holes, or other regions, with fewer pixels than `smallest`; return their number."""
        queue = [
            (size, region)
            for region, size in enumerate(self._sizes)
            if size < smallest and self._is_hole[region] is holes and self.target[region] == region
        ]
        heapq.heapify(queue)
        gone = 0
        while queue:
            size, region = heapq.heappop(queue)
            if self.target[region] != region or size != self._sizes[region]:
                continue
            if not self._lines[region]:
                break  # the whole image
            into = max(self._lines[region], key=lambda other: self._rank(region, other))
            self._join(region, into)
            gone += 1
            if self._sizes[into] < smallest and self._is_hole[into] is holes:
                heapq.heappush(queue, (self._sizes[into], into))
        self._settle()
        return gone

    def _rank(self, region: int, other: int) -> tuple[bool, bool, int, int]:
        """Rank a neighbour: grains before holes, then same phase, longest line, first index."""
        alike = self._kinds[region] == self._kinds[other]
        return (not self._is_hole[other], alike, self._lines[region][other], -other)

    def _join(self, region: int, into: int) -> None:
        self.target[region] = into
        self._sizes[into] += self._sizes[region]
        for other, length in self._lines[region].items():
            del self._lines[other][region]
            if other != into:
                whole = self._lines[into].get(other, 0) + length
                self._lines[into][other] = self._lines[other][into] = whole
        self._lines[region] = {}

    def _settle(self) -> None:
        while np.any(self.target != self.target[self.target]):
            self.target = self.target[self.target]


def _drop_loose(image: IntArray) -> int:
    """Replace grains that are not connected with the largest part of the rock by holes."""
    parts = connected((image >= 0).astype(np.int8))
    sizes = np.bincount(parts[image >= 0])
    loose = (image >= 0) & (parts != int(np.argmax(sizes)))
    image[loose] = HOLE
    return int(np.count_nonzero(loose))


def _fill_touching(image: IntArray) -> int:
    """Give a pixel to a grain wherever holes touch at a corner; return the number of pixels."""
    filled = 0
    while True:
        low_left, low_right = image[:-1, :-1] < 0, image[:-1, 1:] < 0
        top_left, top_right = image[1:, :-1] < 0, image[1:, 1:] < 0
        rising = low_left & top_right & ~low_right & ~top_left
        falling = low_right & top_left & ~low_left & ~top_right
        places = np.argwhere(rising | falling)
        if not len(places):
            return filled
        for y, x in places.tolist():
            ways = ((y, x, y, x + 1), (y, x + 1, y, x))
            for row, column, from_row, from_column in ways:
                if image[row, column] < 0 <= image[from_row, from_column]:
                    image[row, column] = image[from_row, from_column]
                    filled += 1
                    break
