# SPDX-License-Identifier: GPL-3.0-or-later
"""The rig that fits a specimen."""

from __future__ import annotations

from ..errors import InputError
from ..models.grains import Model
from ..models.spheres import SphereModel
from ..runs.runner import Runner
from .grain_rig import NodeRig, PlateRig
from .rig import TestRig
from .sphere_rig import SphereRig


def rig(
    built: Model | SphereModel, *, tension: bool = False, runner: Runner | None = None
) -> TestRig:
    """Put a built specimen into a rig, to write a test with.

    Args:
        built: A rectangle, which is compressed or pulled between its bottom and top, or a disc,
            which is compressed between two plates.
        tension: Pull instead of press; a rectangle only.
        runner: Steps, shows progress and saves checkpoints; None for one that only steps.

    Returns:
        A rig of boundary nodes for deformable grains between their ends, of plates for rigid grains
        and for discs, of plates or grips for YADE's bonded spheres.

    Raises:
        InputError: for a specimen of another outline.
    """
    if built.specimen.kind not in ("rectangle", "disc"):
        raise InputError(
            f"rig: specimen = {built.specimen.kind}, must be a rectangle or a disc; flexpm.PartRig "
            "holds any other"
        )
    if isinstance(built, SphereModel):
        return SphereRig(built, tension=tension, runner=runner)
    kind = NodeRig if built.name == "flexible" and built.specimen.kind == "rectangle" else PlateRig
    return kind(built, tension=tension, runner=runner)
