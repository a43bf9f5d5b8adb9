# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragments: grains that are still connected after a test, and their areas. SI units.

Two grains are connected if a contact between them has a point that is not fully damaged; contacts
that are only touched, and points that have cracked, do not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from ..arrays import BoolArray, FloatArray, IntArray
from ..files import csv_text


@dataclass(frozen=True)
class Fragments:
    """Fragments, the largest first; ties in the order of their first grain."""

    labels: IntArray  #: fragment of each grain, -1 of a grain that is gone
    grains: IntArray  #: number of grains of each fragment
    areas: FloatArray  #: area of each fragment, undeformed [m2]; of a solid its volume [m3]

    def __len__(self) -> int:
        return len(self.areas)

    def csv(self, size: str = "area") -> str:
        """One line for each fragment: number, grains, area [m2], or volume [m3] of a solid's."""
        rows = zip(range(len(self)), self.grains.tolist(), self.areas.tolist(), strict=True)
        return csv_text(("fragment", "grains", size), rows)


def connected(pairs: IntArray, bonded: BoolArray, areas: FloatArray) -> Fragments:
    """Find the fragments: groups of connected grains.

    Args:
        pairs: The two grains of each contact, (C, 2).
        bonded: Whether each contact holds its grains together, (C,).
        areas: Area of each grain, 0 for an erased grain [m2].
    """
    pairs, areas = np.asarray(pairs).reshape(-1, 2), np.asarray(areas, dtype=float)
    held = pairs[np.asarray(bonded, dtype=bool)]
    count = len(areas)
    if not np.any(areas > 0.0):
        return Fragments(np.full(count, -1), np.zeros(0, dtype=int), np.zeros(0))
    graph = sparse.coo_matrix((np.ones(len(held)), (held[:, 0], held[:, 1])), shape=(count, count))
    found, labels = csgraph.connected_components(graph, directed=False)
    total = np.bincount(labels, weights=areas, minlength=found)
    first = np.full(found, count)
    np.minimum.at(first, labels, np.arange(count))
    order = np.lexsort((first, -total))
    order = order[total[order] > 0.0]
    rank = np.full(found, -1)
    rank[order] = np.arange(len(order))
    grains = np.bincount(labels, minlength=found)
    return Fragments(rank[labels], grains[order], total[order])
