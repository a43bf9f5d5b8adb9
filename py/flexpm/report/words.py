# SPDX-License-Identifier: GPL-3.0-or-later
"""What each test calls its stress, its strain and its measures, in tables and pictures.

Nothing heavy is loaded here: the command writes tables.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..dimensions import is_solid
from ..kinds.registry import OWN, kind_of
from ..kinds.words import Drawn, Shown, Words, strain, stress

if TYPE_CHECKING:
    from ..files import Table
    from ..results.result import Result

__all__ = ["Drawn", "Shown", "Words", "turns_by", "words_of_result", "words_of_test"]


def words_of_test(test: str) -> Words:
    """Words of a test, by its name."""
    return kind_of(test).words


def turns_by(drive: Table, *, solid: bool) -> bool:
    """Whether a drive turns its parts: its load is a moment then, its way an angle.

    In the plane z is the axis of a turn, in space a direction like others.
    """
    return bool(drive.get("turns", False) if solid else drive["direction"][2] != 0.0)


def words_of_result(result: Result) -> Words:
    """Words of a test that has a result: those of a script's own follow from what it drove."""
    if result.test != OWN.name or result.inputs is None:
        return words_of_test(result.test)
    drive = result.inputs.get("drive")
    if not drive:  # between two ends, or before it is loaded
        return Words()
    turns = turns_by(drive, solid=is_solid(result.inputs["specimen"]["kind"]))
    way = ("angle", 1e3, "mrad") if turns else ("displacement", 1e6, "µm")
    load = ("moment", 1.0, "N m") if turns else ("load", 1.0, "N")
    # a size of 1 was not given: the strain is the way then, the stress the load
    return Words(
        Drawn("axial_strain", *way) if drive["length"] == 1.0 else strain("strain"),
        Drawn("axial_stress", *load) if drive["area"] == 1.0 else stress("stress"),
    )
