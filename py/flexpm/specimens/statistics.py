# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the cells and meshes of a specimen. SI units, angles in degrees."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from .._flexpm import GrainMeshes, Tessellation
from ..arrays import FloatArray
from ..joints.cuts import Cut
from ..renamed import NETWORKS, Renamed

#: Shares of the edges that are shorter than the lengths given [-].
_SHARES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)


def of_cells(cells: Tessellation) -> dict[str, float | int | dict[str, float]]:
    """Count and measure grains, contacts and edges: areas [m^2], lengths [m]."""
    contacts = len(cells.shared_edges)
    lengths = _edge_lengths(cells)
    return {
        "grains": cells.cells,
        "contacts": contacts,
        "uncollapsed_contacts": cells.uncollapsed_shared_edges,
        "boundary_edges": len(cells.boundary_edges),
        "cell_vertices": len(cells.cell_vertices),
        "cell_area": math.fsum(cells.cell_areas),
        "smallest_cell_area": float(cells.cell_areas.min()),
        "edge_length": {f"{p:.2f}": float(np.quantile(lengths, p)) for p in _SHARES},
        "coordination": 2.0 * contacts / cells.cells,
    }


def of_meshes(refined: GrainMeshes, fan: GrainMeshes) -> dict[str, float | int]:
    """Count nodes, triangles and exceptions of both meshes; smallest angles [degree]."""
    return {
        "refined_nodes": len(refined.nodes),
        "refined_triangles": len(refined.triangles),
        "fan_nodes": len(fan.nodes),
        "fan_triangles": len(fan.triangles),
        "refined_smallest_angle": math.degrees(refined.smallest_angle.min()),
        "fan_smallest_angle": math.degrees(fan.smallest_angle.min()),
        "flipped_meshes": int((1 - refined.standard).sum() - refined.fallback.sum()),
        "fan_fallbacks": int(refined.fallback.sum()),
        "moved_centres": int(refined.moved_centre.sum()),
    }


def of_networks(
    asked: Sequence[tuple[str, float]],
    ends: Mapping[str, FloatArray],
    cuts: Mapping[str, Cut],
    area: float,
) -> dict[str, dict[str, float]]:
    """P21 of each set of traces [1/m], as it was requested, generated and cut.

    Args:
        asked: Name and P21 of each set [1/m].
        ends: Ends (n, 2, 2) of the contacts of each joint [m].
        cuts: Outcome of the lines of each joint.
        area: Area of the specimen [m2].
    """
    found: dict[str, dict[str, float]] = {}
    for name, intensity in asked:
        lengths = [0.0, 0.0]  # of a set without a trace
        if name in ends:
            cut, way = cuts[name], ends[name][:, 1] - ends[name][:, 0]
            lengths = [cut.length - cut.outside, float(np.sum(np.hypot(way[:, 0], way[:, 1])))]
        generated, made = (length / area for length in lengths)
        values = {"target": intensity, "generated": generated, "cut": made}
        found[name] = Renamed(values, NETWORKS)
    return found


def _edge_lengths(cells: Tessellation) -> FloatArray:
    """Lengths of contacts, or of the rim if there is one grain only [m]."""
    edges = cells.shared_edges[:, 2:4]
    ends = cells.vertices[edges if len(edges) else cells.boundary_edges[:, 1:3]]
    lengths: FloatArray = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return lengths
