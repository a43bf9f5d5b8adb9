# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of Neper, made by the documentation of its formats."""

from __future__ import annotations

import itertools


def ring_lines(rings):
    """Lines of the edges and the faces of a file, from rings of vertices."""
    edges, rows = {}, []
    for ring in rings:
        around = []
        for a, b in itertools.pairwise([*ring, ring[0]]):
            known = (min(a, b), max(a, b))
            number = edges.setdefault(known, len(edges) + 1)
            around.append(number if (a, b) == known else -number)
        rows.append(around)
    lines = [" **edge", f" {len(edges)}"]
    lines += [f"   {n} {a + 1} {b + 1} 0" for (a, b), n in edges.items()]
    lines += [" **face", f" {len(rings)}"]
    for number, (ring, around) in enumerate(zip(rings, rows, strict=True), 1):
        lines.append(f"   {number} {len(ring)} {' '.join(str(one + 1) for one in ring)}")
        lines.append(f"     {len(around)} {' '.join(map(str, around))}")
        lines += ["    0.0 0.0 0.0 1.0", "     0 -1 0.0 0.0 0.0"]
    return lines


def level(x, y, away):
    """Place in space of one of the plane z = 0, and so far off it."""
    return x, y, away


def tess_text(vertices, cells, seeds=None, version="3.5", place=level):
    """A ``.tess`` file of cells in a plane.

    Rows x, y; rings of vertices; rows x, y, weight and perhaps how far a seed is off the plane;
    where that is in space.
    """
    lines = ["***tess", " **format", f"   {version}", " **general", "   2 standard"]
    lines += [" **cell", f"  {len(cells)}", "  *crysym", "   triclinic"]
    if seeds is not None:
        lines.append("  *seed")
        for number, (x, y, weight, *away) in enumerate(seeds, 1):
            at = " ".join(map(repr, place(x, y, *(away or [0.0]))))
            lines.append(f"   {number} {at} {weight!r}")
    lines += ["  *ori", "   rodrigues:active", *["  0.1 0.2 0.3"] * len(cells)]
    lines += [" **vertex", f" {len(vertices)}"]
    for number, (x, y) in enumerate(vertices, 1):
        lines.append(f"   {number} {' '.join(map(repr, place(x, y, 0.0)))} 0")
    lines += ring_lines(cells)
    return "\n".join([*lines, " **domain", "  *general", "   square", "***end", ""])


def tess_of(specimen, seeds=None, **options):
    """The cells of a specimen as such a file."""
    cells = specimen.tessellation
    starts = cells.cell_offsets.tolist()
    rings = [cells.cell_vertices[a:b].tolist() for a, b in itertools.pairwise(starts)]
    return tess_text(cells.vertices.tolist(), rings, seeds, **options)


def tesr_bytes(labels, kind, form):
    """A ``.tesr`` file of labels in a binary format."""
    head, _, end = tesr_text(labels).partition("   ascii\n")
    data = labels[::-1].astype(form).tobytes()
    after = end[end.index("***end") :].encode()
    return head.encode() + f"   {kind}\n".encode() + data + b"\n" + after


def tesr_text(labels, pixel=0.01):
    """A ``.tesr`` file of labels, the first row on top."""
    rows = [" ".join(map(str, row)) for row in labels[::-1].tolist()]
    head = ["***tesr", " **format", "   2.2", " **general", "   2"]
    head += [f"   {labels.shape[1]} {labels.shape[0]}", f"   {pixel} {pixel}"]
    return "\n".join([*head, " **data", "   ascii", *rows, "***end", ""])
