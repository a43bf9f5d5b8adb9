# SPDX-License-Identifier: GPL-3.0-or-later
"""What all rigs of solid grains have in common. SI units."""

from __future__ import annotations

from yade import wrapper

from ...results import doubts
from ..grain_rig import GrainRig


class SolidGrains(GrainRig):
    """Base of a rig of polyhedral grains."""

    @property
    def warnings(self) -> list[str]:
        """What makes the record doubtful, see `GrainRig.warnings`; grains that lie on others."""
        return super().warnings + doubts.of_overlap(self._solid.overlaps()["of_diameter"])

    @property
    def contact_width(self) -> float | None:
        """None: plates touch sides."""
        return None

    @property
    def _solid(self) -> wrapper.GrainSolver:
        return self.built.solver
