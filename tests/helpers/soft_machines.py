# SPDX-License-Identifier: GPL-3.0-or-later
"""A bar whose middle softens, in a soft machine: what plane and space ask of it alike."""

from __future__ import annotations

from typing import Any

import pytest

import flexpm


def require_descent(rig: Any, top: Any, machine: float, strength: float, *, stable: bool) -> None:
    """Load a rig past its peak, let the crosshead stand, and ask what load and energies are then.

    Args:
        rig: With the part `top` in its machine.
        top: The driven part, along the last axis.
        machine: Stiffness of its spring [N/m].
        strength: Load that the bar bears [N].
        stable: Whether the load stays behind the peak; else the bar runs away.
    """
    rig.load(flexpm.Loading(rate=0.05, kind="constant", stop_ratio=0.9))
    # a crosshead that stands behind the peak: the load goes on falling, or stays
    rig.dwell(30.0, by="displacement")
    stands = rig.record["load"][-1]
    rig.dwell(30.0, by="displacement")
    record, load = rig.record, rig.record["load"]
    peak = int(load.argmax())
    assert load[peak] == pytest.approx(strength, rel=0.01)
    if stable:
        assert load[-1] == pytest.approx(stands, rel=1e-3)
        assert load[-1] > 0.2 * load[peak]
    else:
        assert abs(load[-1]) < 1e-3 * load[peak]
    # what the machine gives is the specimen's, beside the work of the crosshead
    given = record["machine_energy"][peak] - record["machine_energy"][-1]
    closed = 0.5 * (load[peak] ** 2 - load[-1] ** 2) / machine
    assert given == pytest.approx(closed, rel=0.01)
    pull = rig.built.solver.plates()[top.number]["force"][len(top.normal) - 1]
    assert top.machine_energy == pytest.approx(0.5 * pull**2 / machine, rel=1e-9)
