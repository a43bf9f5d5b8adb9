# SPDX-License-Identifier: GPL-3.0-or-later
"""Crystal symmetry: rotations of the Laue groups, and misorientations. Quaternions x, y, z, w.

The axis c is along z. The groups have names such as -1 and 2/m.
"""

from __future__ import annotations

import math

import numpy as np

from ...arrays import FloatArray

#: Rotations of each group by scipy's names; axes of 2/m and -3m are told apart below.
_GROUPS = {
    **{"-1": "C1", "2/m": "C2", "mmm": "D2", "4/m": "C4", "4/mmm": "D4"},
    **{"-3": "C3", "-3m": "D3", "6/m": "C6", "6/mmm": "D6", "m-3": "T", "m-3m": "O"},
}
NAMES = tuple(_GROUPS)


def rotations(name: str, axis: str = "y") -> FloatArray:
    """Return the rotations of a Laue group as quaternions, (n, 4).

    Args:
        name: One of ``NAMES``.
        axis: Direction of a twofold axis: x, y or z for 2/m; x or y for -3m.
    """
    from scipy.spatial.transform import Rotation

    group = Rotation.create_group(_GROUPS[name])
    if name == "-3m" and axis == "y":  # scipy has one along x
        turn = Rotation.from_rotvec([0.0, 0.0, 0.5 * math.pi])
        group = turn * group * turn.inv()
    if name == "2/m":
        group = Rotation.create_group("C2", axis=axis.upper())
    found: FloatArray = group.as_quat()
    return found


def orientations(angles: FloatArray, *, degrees: bool) -> FloatArray:
    """Return orientations as quaternions, (n, 4), from Bunge's Euler angles.

    Args:
        angles: phi1, Phi and phi2, (n, 3) [degree, or rad].
        degrees: Whether the unit is degree.
    """
    from scipy.spatial.transform import Rotation

    found: FloatArray = Rotation.from_euler("ZXZ", angles, degrees=degrees).as_quat()
    return found


def misorientations(one: FloatArray, other: FloatArray, group: FloatArray) -> FloatArray:
    """Return the smallest angles between orientations of one phase, (n,) [degree].

    The minimum is over all rotations that are equivalent by the symmetry of the phase.

    Args:
        one: Orientations, (n, 4).
        other: Orientations, (n, 4).
        group: Rotations of the phase's group, (k, 4).
    """
    (a, d), (b, e) = ((q[:, :3], q[:, 3:]) for q in (one, other))
    between = np.hstack((d * b - e * a - np.cross(a, b), np.sum(one * other, axis=1)[:, None]))
    cosine = np.abs(between @ group.T).max(axis=1)
    found: FloatArray = np.degrees(2.0 * np.arccos(np.minimum(cosine, 1.0)))
    return found
