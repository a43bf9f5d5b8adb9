# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens that joints cut: their size, a joint, and what must hold of the pieces."""

import math
from itertools import pairwise

import numpy as np
import pytest

from flexpm.report.maps import cell_polygons

WIDTH, HEIGHT = 0.02, 0.04
DIP = [(0.0, 0.01), (0.02, 0.03)]
LAW = "joint.weak.normal_stiffness=1e14 joint.weak.shear_stiffness=3e13 joint.weak.friction=0.5"


def joint_edges(specimen, number=0):
    """Ends (n, 2, 2) [m] of the contacts of a joint."""
    cells = specimen.tessellation
    return cells.vertices[cells.shared_edges[specimen.edge_joints == number][:, 2:]]


def off(places, line):
    """Distances of places from a straight line [m]."""
    (x0, y0), (x1, y1) = line
    across = (x1 - x0) * (places[..., 1] - y0) - (y1 - y0) * (places[..., 0] - x0)
    return np.abs(across) / math.hypot(x1 - x0, y1 - y0)


def require_pieces(specimen, uncut):
    """No sliver, no sharp cut, all edges seen, the whole area."""
    cells = specimen.tessellation
    assert math.fsum(cells.cell_areas) == pytest.approx(WIDTH * HEIGHT, rel=1e-12)
    mean = WIDTH * HEIGHT / len(uncut.discs)
    assert cells.cell_areas.min() >= 0.02 * mean
    smallest = math.pi
    for polygon, (x, y, _) in zip(cell_polygons(cells), specimen.discs, strict=True):
        out = np.roll(polygon, -1, axis=0) - polygon
        back = np.roll(out, 1, axis=0)
        turn = np.arctan2(back[:, 0] * out[:, 1] - back[:, 1] * out[:, 0], (back * out).sum(axis=1))
        smallest = min(smallest, math.pi - turn.max())
        assert turn.sum() == pytest.approx(2.0 * math.pi)
        seen = polygon - (x, y)
        after = np.roll(seen, -1, axis=0)
        assert (seen[:, 0] * after[:, 1] - seen[:, 1] * after[:, 0]).min() > 0.0
    assert smallest >= math.radians(5.0)


def require_lengths(specimen):
    """What is cut and what is not is what was asked for, and what is cut has contacts."""
    for number, (name, found) in enumerate(specimen.joint_cuts.items()):
        lines = specimen.joints[name]
        asked = math.fsum(math.dist(a, b) for line in lines for a, b in pairwise(line))
        assert found.length == pytest.approx(asked, rel=1e-12)
        parts = found.cut, found.taken, found.outside
        assert min(parts) >= 0.0
        assert math.fsum(parts) <= (1.0 + 1e-9) * asked
        assert found.lines == len(lines)
        assert 0 <= found.idle <= found.lines
        contacts = specimen.joint_lines()[specimen.spec.joint_names.index(name)]
        assert (len(contacts) > 0) == (found.idle < found.lines), number
        assert (found.on is not None) == (found.taken > 0.0)
