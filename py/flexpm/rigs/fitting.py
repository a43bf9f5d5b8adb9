# SPDX-License-Identifier: GPL-3.0-or-later
"""Selection of the rig that fits a specimen."""

from __future__ import annotations

from typing import Unpack

from ..dimensions import is_solid
from ..errors import InputError
from ..kinds.registry import KINDS
from ..kinds.test_kind import Rig
from ..models.grains import Model
from ..models.spheres import SphereModel
from ..runs.runner import Runner
from .outcome.calls import recording
from .outcome.kept import KeptTest, Leaves
from .rig import TestRig
from .solids.disc_rig import SolidDiscRig
from .solids.end_rig import EndRig
from .sphere_rig import SphereRig
from .statics.end_state import NodeEnds, PlateEnds

#: Shapes of the plane, then of space, that some test holds between ends or two plates.
_HELD = tuple(
    dict.fromkeys(
        shape
        for of in (lambda kind: (kind.shape,), lambda kind: kind.solids)
        for kind in KINDS.values()
        if kind.rig is Rig.ENDS
        for shape in of(kind)
    )
)
#: Rigs that note what a script calls, for its folder.
_RIGS = [recording(kind) for kind in (NodeEnds, PlateEnds, EndRig, SolidDiscRig, SphereRig)]


def rig(
    built: Model | SphereModel,
    *,
    tension: bool = False,
    runner: Runner | None = None,
    **leaves: Unpack[Leaves],
) -> TestRig:
    """Put a built specimen into the rig of a standard test, to write a custom test.

    Args:
        built: A rectangle, which is compressed or pulled between its bottom and top; a disc, which
            is compressed between two plates; or a 3D specimen, between its ends along z.
        tension: Pull instead of press; not for a disc.
        runner: Object that steps, shows progress and saves checkpoints; None: it only steps.
        leaves: Output of the test, by these names:

            - ``out``: folder of the files, which grow during the run. If the same script is started
              again with the same calls, it resumes from there and reaches the same bits. None, the
              default, writes no files; the script then always starts from the beginning.
            - ``frames``, ``film``: intermediate states and a film of them, as for ``flexpm.run``.
            - ``report``: also write report.html at the end. Default: True.
            - ``checkpoint_interval``: wall time between two checkpoints [s], > 0.

    Returns:
        The rig. It drives boundary nodes of deformable grains, plates of rigid grains and of discs,
        and plates or grips of YADE's bonded spheres.

    Raises:
        InputError: for a specimen of another outline, or a folder with other content.
        BusyError: if another process uses the folder.

    Example:
        >>> rig = flexpm.rig(flexpm.build(specimen))
        >>> rig.strain_to(2e-4, rate=6.0)
        >>> print(f"{rig.stress / 1e6:.1f} MPa at a strain of {rig.strain:.1e}")
        5.2 MPa at a strain of 2.1e-04
    """
    if built.specimen.kind not in _HELD:
        other = (
            "choose one of them"
            if is_solid(built.specimen.kind)
            else "use flexpm.PartRig for other shapes"
        )
        raise InputError(
            f"rig: specimen = {built.specimen.kind}, must be one of {', '.join(_HELD)}; {other}"
        )
    kept = KeptTest.of(built, "rig", leaves, pull=tension)
    made = _fitting(built, tension, runner if kept is None else kept.runner)
    if kept is not None:
        kept.attach(made)
    return made


def _fitting(built: Model | SphereModel, tension: bool, runner: Runner | None) -> TestRig:
    if isinstance(built, SphereModel):
        if built.specimen.kind == "solid-disc":
            raise InputError(
                f"rig: model = {built.name}, must be flexible or rigid for a solid-disc; build one "
                "of these"
            )
        return SphereRig(built, tension=tension, runner=runner)
    if is_solid(built.specimen.kind):
        kind = SolidDiscRig if built.specimen.kind == "solid-disc" else EndRig
        return kind(built, tension=tension, runner=runner)
    if built.name == "flexible" and built.specimen.kind == "rectangle":
        return NodeEnds(built, tension=tension, runner=runner)
    return PlateEnds(built, tension=tension, runner=runner)
