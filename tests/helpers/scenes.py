# SPDX-License-Identifier: GPL-3.0-or-later
"""Models in a scene of their own, and what must hold of their energies."""

from __future__ import annotations

from typing import Any

import pytest

import flexpm


def fresh(*arguments: Any, **options: Any) -> flexpm.Model:
    """Build a model, as `flexpm.build` does, in a scene that was emptied."""
    import yade

    yade.O.reset()
    return flexpm.build(*arguments, **options)


def require_balance(rig: Any, within: float) -> dict[str, float]:
    """Ask that energies sum to the work of the boundary, within a part of it [-]; return them."""
    energies = rig.built.solver.energies()
    given = energies["boundary_work"] + energies["initial_energy"]
    into = {"boundary_work", "initial_energy"}
    kept = sum(energy for name, energy in energies.items() if name not in into)
    assert kept == pytest.approx(given, rel=within)
    return energies
