# SPDX-License-Identifier: GPL-3.0-or-later
"""Label volumes of known power cells, for tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexpm._flexpm import Solid, WeightedCells, cells_of_voxels, weighted_cells


@dataclass(frozen=True, eq=False)
class DrawnVolume:
    """Labels of voxels, (z, y, x), and the cells that they are from."""

    labels: np.ndarray
    spacing: tuple[float, float, float]
    cells: WeightedCells

    @property
    def neighbours(self) -> np.ndarray:
        pairs = self.cells.faces[0]
        return np.unique(pairs[pairs[:, 1] >= 0], axis=0)


def power_volume(count, counts, seed, side=1e-3, relaxations=8):
    """Voxels of relaxed random cells of unequal weights; counts of voxels along x, y, z."""
    draw = np.random.default_rng(seed)
    sizes = side * np.array(counts)
    solid = Solid.box(*sizes)
    points, weights = draw.random((count, 3)) * sizes, np.zeros(count)
    for _ in range(relaxations):
        points = weighted_cells(points, weights, solid).centroids
    size = np.cbrt(np.prod(sizes) / count)
    weights = (draw.uniform(0.3, 0.6, count) * size) ** 2
    cells = weighted_cells(points, weights, solid)
    box = np.vstack((np.full(3, side), np.zeros(3)))
    labels = cells_of_voxels(points, weights, cells, counts, box).reshape(counts[::-1])
    return DrawnVolume(labels, (side, side, side), cells)


def unions(volume, seed, largest):
    """Labels of pairs of neighbouring cells: over the largest faces first, or any neighbours."""
    pairs, offsets, corners = volume.cells.faces
    between = np.flatnonzero(pairs[:, 1] >= 0)
    order = np.random.default_rng(seed).permutation(len(between))
    if largest:
        places = volume.cells.vertices
        areas = []
        for face in between:
            ring = places[corners[offsets[face] : offsets[face + 1]]]
            twice = np.cross(ring[1:-1] - ring[0], ring[2:] - ring[0]).sum(axis=0)
            areas.append(np.linalg.norm(twice))
        order = np.argsort(-np.array(areas), kind="stable")
    partner = {}
    for one, other in pairs[between[order]].tolist():
        if one not in partner and other not in partner:
            partner[one], partner[other] = one, one
    return np.array([partner.get(k, k) for k in range(len(volume.cells.volumes))])[volume.labels]


def bent_with_fragments(volume, fragments, seed, bend=1.5, size=(3, 2, 3)):
    """Labels with wavy boundaries, on which small grains of a size along z, y, x lie."""
    z, y, x = np.indices(volume.labels.shape)
    moved = [y + bend * np.sin(x / 3.0), x + bend * np.sin(z / 3.0)]
    rows, columns = (
        np.clip(np.rint(at).astype(int), 0, count - 1)
        for at, count in zip(moved, volume.labels.shape[1:], strict=True)
    )
    bent = volume.labels[z, rows, columns]
    met = np.zeros(bent.shape, dtype=bool)
    for axis in range(3):
        last = tuple(slice(-1 if axis == other else None) for other in range(3))
        met[last] |= np.diff(bent, axis=axis) != 0
    boundary, draw = np.argwhere(met), np.random.default_rng(seed)
    labels, first = bent.copy(), len(volume.cells.volumes)
    for label in range(first, first + fragments):
        corner = boundary[draw.integers(len(boundary))] - np.array(size) // 2
        ends = zip(np.maximum(corner, 0), size, strict=True)
        labels[tuple(slice(at, at + count) for at, count in ends)] = label
    return labels
