#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw images of labels, and measure what becomes of them; rows that are there are kept.

Start it from a checkout that scripts/setup has built, best by ``scripts/night images``:

    FLEXPM_SOURCES=COMMIT PYTHONPATH=build/python /usr/bin/python3 tests/helpers/drawn_images.py

writes 100 rows of images of 512 x 512 pixels (noise: 128) to night-out/images.csv. Rows of
that commit are not measured again. Areas as parts of themselves, lengths in pixels.
"""

from __future__ import annotations

import csv
import os
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree

from flexpm.specimens.labels.given import divide
from flexpm.specimens.specimen import Specimen

TABLE = Path(__file__).resolve().parents[2] / "night-out" / "images.csv"
PIXEL, THICKNESS = 5e-5, 0.01
KINDS = ("grains", "islands", "patches", "checkerboard", "noise", "single pixels")
IMAGES, SIZE = 100, 512
#: Size from which the limit of `grain_area` holds [pixels].
LARGE = 100


class Figures(NamedTuple):
    """What becomes of an image."""

    grains: int  #: that the image has after merging
    cells: int
    raster_area: float  #: largest error of a grain's area before smoothing
    grain_area: float  #: after it, of grains of `LARGE` pixels or more
    phase_area: float  #: after it, of phases
    whole_area: float
    away: float  #: farthest corner of a boundary from that of the pixels
    missing: int  #: pairs that share three edges of pixels or more and do not meet
    added: int  #: pairs that meet and share no edge of pixels


#: What each may be at most; those of counts are exact.
LIMITS = {
    **{"raster_area": 1e-12, "grain_area": 0.02, "phase_area": 0.005, "whole_area": 1e-9},
    **{"away": 1.0 + 1e-3, "missing": 0, "added": 0},
}


def voronoi(size, grains, seed):
    """Cells of random points."""
    y, x = np.mgrid[:size, :size] + 0.5
    places = np.random.default_rng(seed).random((grains, 2)) * size
    nearest = cKDTree(places).query(np.column_stack((x.ravel(), y.ravel())))[1]
    return nearest.reshape(size, size)


def circles(size, labels, count, seed):
    """Discs drawn over an image, some of them over others."""
    draw = np.random.default_rng(seed)
    y, x = np.mgrid[:size, :size] + 0.5
    for number in range(count):
        (a, b), radius = draw.random(2) * size, draw.uniform(1.0, 8.0)
        labels[(x - a) ** 2 + (y - b) ** 2 < radius**2] = 1000 + number
    return labels


def drawn(seed, most=128, whole=False):
    """Images of six kinds: grains, islands, patches, checkerboards, noise and single pixels."""
    draw = np.random.default_rng(seed)
    size, kind = int(draw.integers(24, most)), seed % 6
    if whole:  # noise has as many grains as pixels, and takes minutes beyond 128
        size = min(size, 128) if kind == 4 else most
    if kind == 0:
        return voronoi(size, int(draw.integers(3, 60)), seed)
    if kind == 1:
        return circles(size, voronoi(size, 12, seed), 10, seed)
    if kind == 2:
        field = gaussian_filter(draw.random((size, size)), draw.uniform(1.0, 4.0))
        return np.digitize(field, np.quantile(field, [0.3, 0.6]))
    if kind == 3:
        side = int(draw.integers(2, 9))
        y, x = np.mgrid[:size, :size] // side
        return (x + y) % 2
    if kind == 4:
        return draw.integers(0, 3, (size // 2, size))
    labels = voronoi(size, 25, seed)
    labels[draw.random((size, size)) < 0.02] = 77
    return labels


def smallest_of(seed):
    """Least pixels of a region, by seed."""
    return (1, 4, 9)[seed % 3]


def area_of(polygon):
    """Area within corners, counter-clockwise; of a small grain far from 0 as exact as of others."""
    x, y = (polygon - polygon[0]).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def neighbours(grains, pairs, least):
    """Pairs of grains that meet at least so often."""
    met = np.sort(grains[pairs], axis=1)
    met = met[met[:, 0] != met[:, 1]]
    found, counts = np.unique(met, axis=0, return_counts=True)
    return set(map(tuple, found[counts >= least].tolist()))


def raster_edges(polygons):
    """Edges of pixels between pieces: pieces on both sides, and both ends [pixels]."""
    sides = {}
    for piece, polygon in enumerate(polygons):
        corners = list(map(tuple, np.round(polygon / PIXEL).astype(int).tolist()))
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            sides[start, end] = piece
    both = [(one, sides[e, s], s, e) for (s, e), one in sides.items() if (e, s) in sides]
    pairs = np.array([row[:2] for row in both])
    return pairs, np.array([row[2:] for row in both], dtype=float)


def away_from(points, edges):
    """Farthest of points from the nearest of edges of unit length."""
    nearest = cKDTree(edges.mean(axis=1)).query(points, k=min(8, len(edges)))[1]
    start, along = edges[nearest, 0], edges[nearest, 1] - edges[nearest, 0]
    to = points[:, None] - start
    share = np.clip(np.sum(to * along, axis=2), 0.0, 1.0)
    return float(np.hypot(*np.moveaxis(to - share[..., None] * along, 2, 0)).min(axis=1).max())


def figures_of(labels, **options):
    """Measure what becomes of an image."""
    specimen = Specimen.from_labels(labels, PIXEL, THICKNESS, **options)
    found, stairs = (divide(labels, PIXEL, **options, smoothed=one) for one in (True, False))
    cells, grains = specimen.tessellation, specimen.grains
    assert len(cells.cell_areas) >= len(found.polygons)
    areas, asked = np.bincount(grains, cells.cell_areas), found.pixels * PIXEL**2
    before = np.bincount(stairs.grains, [area_of(one) for one in stairs.polygons])
    off = np.abs(areas / asked - 1.0)[found.pixels >= LARGE]
    kinds = np.unique(found.labels, return_inverse=True)[1]
    phases = np.bincount(kinds, areas) / np.bincount(kinds, asked) - 1.0
    pairs, edges = raster_edges(stairs.polygons)
    rim = np.not_equal(*stairs.grains[pairs].T)
    ends = cells.shared_edges[:, 2:][np.not_equal(*grains[cells.shared_edges[:, :2]].T)]
    corners = cells.vertices[np.unique(ends)] / PIXEL
    met = neighbours(grains, cells.shared_edges[:, :2], 1)
    return Figures(
        len(areas),
        cells.cells,
        float(np.abs(before / asked - 1.0).max()),
        float(off.max(initial=0.0)),
        float(np.abs(phases).max()),
        float(abs(areas.sum() / asked.sum() - 1.0)),
        away_from(corners, edges[rim]),
        # each edge of a pixel is there from both sides
        len(neighbours(stairs.grains, pairs, 6) - met),
        len(met - neighbours(stairs.grains, pairs, 2)),
    )


def main(commit):
    """Measure what is not there yet for a commit, row by row; returns what is beyond its limit."""
    head = ("seed", "kind", "side", "smallest", "commit", *Figures._fields)
    rows = {}
    if TABLE.exists():
        with TABLE.open(encoding="utf-8", newline="") as file:
            rows = {int(row["seed"]): row for row in csv.DictReader(file)}
            rows = {seed: row for seed, row in rows.items() if row["commit"] == commit}
    for seed in [one for one in range(IMAGES) if one not in rows]:
        labels = drawn(seed, SIZE, whole=True)
        figures = figures_of(labels, smallest=smallest_of(seed))
        texts = [f"{one:.3g}" if isinstance(one, float) else str(one) for one in figures]
        first = (str(seed), KINDS[seed % 6], str(labels.shape[1]), str(smallest_of(seed)), commit)
        rows[seed] = dict(zip(head, (*first, *texts), strict=True))
        print(*rows[seed].values(), flush=True)
        TABLE.parent.mkdir(exist_ok=True)
        temporary = TABLE.with_suffix(".tmp")
        with temporary.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, head, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows[one] for one in sorted(rows))
        temporary.replace(TABLE)
    return [
        f"image {seed}: {name} = {row[name]}"
        for seed, row in sorted(rows.items())
        for name, most in LIMITS.items()
        if not float(row[name]) <= most
    ]


if __name__ == "__main__":
    sys.exit("; ".join(main(os.environ["FLEXPM_SOURCES"])) or 0)
