# SPDX-License-Identifier: GPL-3.0-or-later
"""A script's own test again, from the calls that its result.json holds. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Unpack

import yade

from ..errors import InputError
from ..files import Table
from ..materials.material import Material
from ..models.grains import Model, build
from ..require import quoted
from ..results.result import Result
from ..rigs.fitting import rig as rig_of
from ..rigs.outcome.calls import Again
from ..rigs.outcome.kept import Leaves
from ..rigs.part_rig import PartRig
from ..rigs.rig import TestRig
from ..rigs.solids.part_rig import SolidPartRig
from ..runs.run_inputs import RunInputs
from ..specimens.files import given


def repeat(
    file: Path,
    test: tuple[RunInputs, Material, Sequence[Table]],
    *,
    threads: int = 1,
    **leaves: Unpack[Leaves],
) -> Result:
    """Make a test again by its calls, to the same bits.

    A folder with a part of the same test is gone on from.

    Args:
        file: Its result.json, in a folder with the file of grains that are not packed.
        test: Its inputs and its calls, see ``asked.read_own``.
        threads: Threads of a step.
        leaves: Written files, with ``out``, as for ``flexpm.rig``.

    Raises:
        InputError: for calls that this version does not know, or a folder of something else.
    """
    inputs, material, calls = test
    specimen = given.load(inputs.specimen, file.parent)
    yade.O.reset()
    built = build(
        specimen,
        material,
        inputs.model,
        points=inputs.points,
        mesh=inputs.mesh,
        threads=threads,
        damping=inputs.damping,
        dynamic=inputs.dynamic,
        gravity=inputs.gravity,
    )
    assert isinstance(built, Model)  # others say that they cannot be repeated
    try:
        rig = _rig(built, calls[0], leaves)
        again = Again(rig, lambda: built.solver.nodePlaces(bonded=True)[0])
        for call in calls[1:]:
            again.make(call)
    except (LookupError, TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        about = " ".join(str(error).split())[:80]
        raise InputError(
            f"result = {str(file)!r}, has calls that no test has ({about}); give a result.json of "
            "flexpm"
        ) from error
    rig.finish()
    return Result.read(str(leaves["out"]))


def _rig(built: Model, made: Table, leaves: Leaves) -> TestRig:
    """The rig that a test began with."""
    kind, given = made["call"], made["with"]
    if kind in ("PartRig", "SolidPartRig"):
        parts = SolidPartRig if kind == "SolidPartRig" else PartRig
        return parts(built, kind=given["kind"], **leaves)
    if kind == "rig":
        return rig_of(built, tension=given["pull"], **leaves)
    raise InputError(
        f"rerun: rig = {quoted(kind)}, must be PartRig, SolidPartRig or rig; use the version of "
        "flexpm that wrote the result"
    )
