# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of stress, strain and measures of each test, in tables and plots.

Only light modules are loaded, since the command writes tables.
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
    """Return the words of a test with a name."""
    return kind_of(test).words


def turns_by(drive: Table, *, solid: bool) -> bool:
    """Return whether the parts of a drive rotate: load is then a moment, displacement an angle.

    In 2D a rotation has the direction z; in 3D z is a direction like others, and the drive has a
    flag.
    """
    return bool(drive.get("turns", False) if solid else drive["direction"][2] != 0.0)


def words_of_result(result: Result) -> Words:
    """Return the words of a result's test; for a custom test they follow from its drive."""
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
