# SPDX-License-Identifier: GPL-3.0-or-later
"""Components of plane stresses, and their means. SI units, tension positive."""

from __future__ import annotations

import numpy as np

from ...arrays import FloatArray, IntArray

#: Rows that are weighted at a time: those of a large solid together take gigabytes.
_AT_ONCE = 20_000


def principal_stresses(stress: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Larger and smaller principal stress of the plane [Pa] from xx, yy, xy, shape (M, 3)."""
    xx, yy, xy = np.asarray(stress, dtype=float).T
    middle, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    return middle + radius, middle - radius


def turned_stresses(stress: FloatArray, angle: FloatArray) -> FloatArray:
    """Stresses xx, yy, xy in axes that are turned counter-clockwise by angles, (M, 3) [Pa].

    Args:
        stress: xx, yy, xy, (M, 3) [Pa].
        angle: Angle of each row, (M,) [rad].
    """
    xx, yy, xy = np.asarray(stress, dtype=float).T
    middle, half = 0.5 * (xx + yy), 0.5 * (xx - yy)
    along = half * np.cos(2.0 * angle) + xy * np.sin(2.0 * angle)
    shear = xy * np.cos(2.0 * angle) - half * np.sin(2.0 * angle)
    return np.column_stack([middle + along, middle - along, shear])


def means_by(values: FloatArray, weights: FloatArray, owners: IntArray, count: int) -> FloatArray:
    """Return the weighted mean of the rows of each owner, (count, K); nan without a row.

    Args:
        values: Rows, (M, K).
        weights: Weight of each row, (M,).
        owners: Numbers of those that each row belongs to, (M, J).
        count: Number of owners.
    """
    total = np.zeros((count, values.shape[1] + 1))
    for column in owners.T:
        for begin in range(0, len(values), _AT_ONCE):
            part = slice(begin, begin + _AT_ONCE)
            weight = weights[part]
            weighted = np.column_stack([values[part] * weight[:, None], weight])
            np.add.at(total, column[part], weighted)
    with np.errstate(invalid="ignore", divide="ignore"):
        found: FloatArray = total[:, :-1] / total[:, -1:]
    return found
