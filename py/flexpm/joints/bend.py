# SPDX-License-Identifier: GPL-3.0-or-later
"""How far joints bend to the grains that they run between. SI units."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from .lines import Line


def largest_bend(lines: Sequence[Line], contacts: FloatArray) -> float:
    """Return the largest distance of contacts from their nearest lines [m].

    Args:
        lines: Lines of a joint, which are extended beyond their ends.
        contacts: Contacts of the joint, positions of both ends, (n, 2, 2) [m].
    """
    found = np.full(len(contacts), np.inf)
    for line in lines:
        found = np.minimum(found, _distances(line, contacts).max(axis=1))
    return float(np.max(found, initial=0.0))


def _distances(line: Line, places: FloatArray) -> FloatArray:
    """Distances of places, (n, m, 2), from a line that goes on beyond its ends."""
    found = np.full(places.shape[:2], np.inf)
    corners = np.array(line)
    last = len(corners) - 2
    for k, (start, end) in enumerate(itertools.pairwise(corners)):
        way = end - start
        share = (places - start) @ way / (way @ way)
        share = np.clip(share, -np.inf if k == 0 else 0.0, np.inf if k == last else 1.0)
        found = np.minimum(
            found, np.hypot(*np.moveaxis(places - start - share[..., None] * way, -1, 0))
        )
    return found
