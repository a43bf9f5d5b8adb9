# SPDX-License-Identifier: GPL-3.0-or-later
"""Common parts of all rigs of 3D grains. SI units."""

from __future__ import annotations

from yade import wrapper

from ...results import doubts
from ..grain_rig import GrainRig


class SolidGrains(GrainRig):
    """Base of a rig of polyhedral grains."""

    @property
    def warnings(self) -> list[str]:
        """Reasons why the record is questionable: `GrainRig.warnings`, overlaps without a force."""
        return super().warnings + doubts.of_clearance(self._solid.overlaps()["clearance"])

    @property
    def contact_width(self) -> float | None:
        """None: plates touch sides."""
        return None

    @property
    def _solid(self) -> wrapper.GrainSolver:
        return self.built.solver
