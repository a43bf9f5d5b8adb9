# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a solid's cells as bonds of YADE's spheres take them: areas, middles, moments. SI units.

A face is projected along its mean normal, as the grains' own contacts are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray, IntArray
from ..specimens.space.specimen import SolidSpecimen


class Faces(NamedTuple):
    """Geometry of the faces for their bonds."""

    grains: IntArray  #: (n, 2)
    middles: FloatArray  #: centroids, (n, 3) [m]
    areas: FloatArray  #: (n,) [m2]
    moments: FloatArray  #: polar second moments about the centroids, (n,) [m4]


def shared_faces(specimen: SolidSpecimen) -> Faces:
    """Faces between two cells, in their order."""
    cells = specimen.cells
    _, middles, areas, moments = _measures(specimen, 0, cells.contacts)
    return Faces(np.array(cells.faces[: cells.contacts, :2], dtype=int), middles, areas, moments)


def outer_faces(specimen: SolidSpecimen) -> tuple[IntArray, IntArray, FloatArray]:
    """Grain and side of each face on the outside, and its area vector outwards, (n, 3) [m2]."""
    cells = specimen.cells
    faces = np.array(cells.faces[cells.contacts :], dtype=int)
    vectors, _, _, _ = _measures(specimen, cells.contacts, len(cells.faces))
    return faces[:, 0], np.array(specimen.outline().sides, dtype=int)[faces[:, 2]], vectors


def outer_reach(specimen: SolidSpecimen) -> tuple[FloatArray, FloatArray]:
    """Lowest and highest coordinates of each face on the outside, (n, 3) each [m]."""
    cells = specimen.cells
    offsets = np.array(cells.face_offsets[cells.contacts :], dtype=int)
    corners = np.array(cells.face_vertices[offsets[0] :], dtype=int)
    places, starts = np.array(cells.vertices)[corners], offsets[:-1] - offsets[0]
    return np.minimum.reduceat(places, starts), np.maximum.reduceat(places, starts)


def _measures(
    specimen: SolidSpecimen, first: int, last: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Area vectors, centroids, areas and polar moments of faces from `first` to before `last`."""
    cells = specimen.cells
    offsets = np.array(cells.face_offsets[first : last + 1], dtype=int)
    sizes = np.diff(offsets)
    places = np.array(cells.vertices)[np.array(cells.face_vertices, dtype=int)]
    # triangles from the first corner of each face
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    within = np.arange(len(face)) - np.repeat(np.cumsum(sizes - 2) - (sizes - 2), sizes - 2)
    corner = offsets[face] + 1 + within
    origin = places[offsets[:-1]]
    a, b = places[corner] - origin[face], places[corner + 1] - origin[face]
    crossed = 0.5 * np.cross(a, b)
    vectors = _sums(crossed, face, len(sizes))
    areas = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    normals = vectors / areas[:, None]
    parts = np.einsum("ij,ij->i", crossed, normals[face])
    ways = _sums(parts[:, None] * (a + b) / 3.0, face, len(sizes)) / areas[:, None]
    corners = [_projected(one - ways[face], normals[face]) for one in (np.zeros_like(a), a, b)]
    square = sum(
        np.einsum("ij,ij->i", corners[i], corners[k]) for i in range(3) for k in range(i, 3)
    )
    moments = _sums((parts * square / 6.0)[:, None], face, len(sizes))[:, 0]
    return vectors, origin + ways, areas, moments


def _projected(vectors: FloatArray, normals: FloatArray) -> FloatArray:
    """Vectors without their parts along normals."""
    along = np.einsum("ij,ij->i", vectors, normals)
    found: FloatArray = vectors - along[:, None] * normals
    return found


def _sums(values: FloatArray, owners: IntArray, count: int) -> FloatArray:
    """Sums of rows by their owners, in their order."""
    found = np.zeros((count, values.shape[1]))
    np.add.at(found, owners, values)
    return found
