# SPDX-License-Identifier: GPL-3.0-or-later
"""State of each joint of a specimen: slip, opening and damage of its contact points. SI units."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..files import Table
from .solids.state import AnySnapshot

#: Keys of a joint, after the length or area of its contacts, with their meanings.
MEASURES = {
    "cracked": "Share of points without a bond, of points without strength from the start [-]",
    "damage": "Mean damage [-]",
    "slip": "Mean slip, without its direction [m]",
    "largest_slip": "Largest slip [m]",
    "opening": "Mean opening, negative if the faces press on each other [m]",
    "largest_opening": "Largest opening [m]",
}


def joint_states(snapshot: AnySnapshot) -> Table | None:
    """Return the state of each joint by its name, without joints that have no contacts.

    Shares and means are by the length of the contacts in 2D, and by their area in 3D.

    Args:
        snapshot: The state of the specimen.

    Returns:
        For each joint the ``length`` [m] or ``area`` [m2] of its contacts and the `MEASURES`; None
        for a specimen without joints.
    """
    if snapshot.contact_joint is None:
        return None
    names = snapshot.joint_names
    joint = snapshot.contact_joint[snapshot.point_contact]
    on = joint >= 0
    joint, sizes = joint[on], snapshot.point_sizes[on]
    damage, slip, opening = (
        values[on]
        for values in (snapshot.point_damage, snapshot.slip_sizes, snapshot.point_opening)
    )
    total = np.bincount(joint, sizes, len(names)).astype(float, copy=False)

    def mean(values: FloatArray) -> FloatArray:
        found = np.bincount(joint, sizes * values, len(names)).astype(float, copy=False)
        return np.divide(found, total, out=found, where=total > 0.0)

    def largest(values: FloatArray) -> FloatArray:
        found = np.full(len(names), -np.inf)
        np.maximum.at(found, joint, values)
        return found

    columns = {
        snapshot.contact_size_name: total,
        "cracked": mean((damage >= 1.0).astype(float)),
        "damage": mean(damage),
        "slip": mean(slip),
        "largest_slip": largest(slip),
        "opening": mean(opening),
        "largest_opening": largest(opening),
    }
    there = np.bincount(joint, minlength=len(names)) > 0
    return {
        name: {key: float(values[number]) for key, values in columns.items()}
        for number, name in enumerate(names)
        if there[number]
    }
