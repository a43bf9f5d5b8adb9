# SPDX-License-Identifier: GPL-3.0-or-later
"""Phase of each grain by its pixels or voxels."""

from __future__ import annotations

import numpy as np

from ...arrays import AnyArray, IntArray

#: Pixels that are counted at a time.
_BLOCK = 2**22


def majority(grains: AnyArray, phases: AnyArray, number: int, kinds: int) -> IntArray:
    """Return the phase that most elements of each grain have; of equally many the lowest one.

    Args:
        grains: Grain of each pixel or voxel, 0 to `number` - 1.
        phases: Phase of each pixel or voxel, 0 to `kinds` - 1.
        number: Number of grains.
        kinds: Number of phases.
    """
    grains, phases = grains.reshape(-1), phases.reshape(-1)
    counts: IntArray = np.zeros(number * kinds, dtype=np.int64)
    for start in range(0, len(grains), _BLOCK):
        part = slice(start, start + _BLOCK)
        pairs = grains[part].astype(np.int64) * kinds + phases[part]
        counts += np.bincount(pairs, minlength=number * kinds)
    most: IntArray = np.argmax(counts.reshape(number, kinds), axis=1)
    return most
