# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of 3D grains that press on each other without a common face. SI units."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ...arrays import FloatArray, IntArray
from ...files import Table


@dataclass(frozen=True, eq=False)
class PressingPairs:
    """Arrays of Q pairs that transmit a force; doc/contact describes their law."""

    grains: IntArray  #: (Q, 2)
    position: FloatArray  #: at which the force acts, (Q, 3) [m]
    force: FloatArray  #: on the second grain, friction included, (Q, 3) [N]
    normal_force: FloatArray  #: positive in compression, (Q,) [N]
    area: FloatArray  #: under pressure, (Q,) [m2]
    depth: FloatArray  #: largest depth of the overlap beyond the clearance, (Q,) [m]
    clearance: FloatArray  #: depth of the overlap that yields no force, (Q,) [m]
    friction_energy: FloatArray  #: dissipated by friction since the pair formed, (Q,) [J]

    @classmethod
    def of(cls, found: Table) -> PressingPairs:
        """Return the pairs that press, of the arrays of all pairs by ``GrainSolver.pairs``."""
        pressing = found["normal_force"] > 0.0
        return cls(**{one.name: found[one.name][pressing] for one in fields(cls)})

    @classmethod
    def none(cls) -> PressingPairs:
        """Return no pair."""
        rows, vectors = np.zeros(0), np.zeros((0, 3))
        return cls(np.zeros((0, 2), dtype=np.int32), vectors, vectors, rows, rows, rows, rows, rows)

    def __len__(self) -> int:
        return len(self.grains)
