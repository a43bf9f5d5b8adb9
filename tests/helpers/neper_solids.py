# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of Neper in space, made by the documentation of its formats."""

from __future__ import annotations

import itertools
import math

import numpy as np
from neper_files import ring_lines


def tess_text(vertices, faces, cells, seeds=None, version="3.5", domain="cube"):
    """A ``.tess`` file: rows x, y, z; rings of vertices; signed faces of cells from 1; seeds."""
    lines = ["***tess", " **format", f"   {version}", " **general", "   3 standard"]
    lines += [" **cell", f"  {len(cells)}", "  *crysym", "   triclinic"]
    if seeds is not None:
        lines.append("  *seed")
        lines += [f"   {n} {' '.join(map(repr, row))}" for n, row in enumerate(seeds, 1)]
    lines += ["  *ori", "   rodrigues:active", *["  0.1 0.2 0.3"] * len(cells)]
    lines += [" **vertex", f" {len(vertices)}"]
    lines += [f"   {n} {x!r} {y!r} {z!r} 0" for n, (x, y, z) in enumerate(vertices, 1)]
    lines += ring_lines(faces)
    lines += [" **polyhedron", f" {len(cells)}"]
    lines += [f"   {n} {len(one)} {' '.join(map(str, one))}" for n, one in enumerate(cells, 1)]
    return "\n".join([*lines, " **domain", "  *general", f"   {domain}", "***end", ""])


def tess_of(solid, seeds=None, vertices=None, **options):
    """The cells of a solid as such a file, perhaps with vertices at other places."""
    found = solid.cells
    faces = [ring.tolist() for ring in np.split(found.face_vertices, found.face_offsets[1:-1])]
    cells = [[] for _ in range(found.cells)]
    for number, (first, second, _) in enumerate(found.faces.tolist(), 1):
        cells[first].append(number)
        if second >= 0:
            cells[second].append(-number)
    return tess_text(vertices or found.vertices.tolist(), faces, cells, seeds, **options)


def bricks(shape, shift=0.0):
    """Vertices, faces and cells of equal bricks in the unit cube."""
    nx, ny, nz = shape
    index = {}
    for place in itertools.product(range(nx + 1), range(ny + 1), range(nz + 1)):
        index[place] = len(index)
    vertices = [[i / nx, j / ny, k / nz] for i, j, k in index]
    faces, cells = [], [[] for _ in range(nx * ny * nz)]
    for axis in range(3):
        size = [nx, ny, nz]
        size[axis] += 1
        for at in itertools.product(*map(range, size)):
            one, two = (other for other in range(3) if other != axis)
            ring = []
            for step_one, step_two in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = list(at)
                corner[one] += step_one
                corner[two] += step_two
                ring.append(index[tuple(corner)])
            faces.append(ring)
            for back, sign in ((0, -1), (1, 1)):
                cell = list(at)
                cell[axis] -= back
                if 0 <= cell[axis] < shape[axis]:
                    number = (cell[0] * ny + cell[1]) * nz + cell[2]
                    cells[number].append(sign * len(faces))
    return vertices, faces, cells


def prism(facets, layers):
    """Vertices, faces and cells of an upright regular prism about z that is cut into layers."""
    turns = 2.0 * math.pi * np.arange(facets) / facets
    vertices = [
        [math.cos(turn), math.sin(turn), float(level)]
        for level in range(layers + 1)
        for turn in turns.tolist()
    ]
    faces = [[level * facets + k for k in range(facets)] for level in range(layers + 1)]
    cells = []
    for level in range(layers):
        sides = range(len(faces) + 1, len(faces) + facets + 1)
        cells.append([-(level + 1), level + 2, *sides])
        for k in range(facets):
            a, b = (level * facets + one for one in (k, (k + 1) % facets))
            faces.append([a, b, b + facets, a + facets])
    return vertices, faces, cells
