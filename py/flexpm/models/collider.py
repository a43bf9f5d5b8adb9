# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's collider, which finds bodies that may touch. Lengths in metres."""

from __future__ import annotations

from collections.abc import Sequence

from yade import wrapper

#: Bodies may move this share of the mean diameter before the collider looks again [-].
_SWEEP = 0.05


def collider(
    bounds: Sequence[wrapper.Functor], mean_diameter: float
) -> wrapper.InsertionSortCollider:
    """Make a collider.

    Args:
        bounds: Functors that bound the shapes.
        mean_diameter: Mean diameter of the grains or discs [m].
    """
    return wrapper.InsertionSortCollider(list(bounds), verletDist=_SWEEP * mean_diameter)
