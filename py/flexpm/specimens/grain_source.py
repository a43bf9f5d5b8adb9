# SPDX-License-Identifier: GPL-3.0-or-later
"""File from which the grains of a specimen were read, and figures of the reading. SI units.

No heavy library is imported here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from ..errors import InputError
from ..files import Table
from ..require import quoted
from .files.rules import Rule, is_count, is_positive, is_text, list_of

Made = TypeVar("Made")

#: Entries of a source: name of the file, number of grains found in it, size of a voxel along x, y,
#: z [m], sides of a pixel [m], ratio of the voxels that are in the cell of their grain [-].
_RULES: dict[str, Rule] = {
    "file": is_text,
    "grains": is_count,
    "voxel_size": list_of(is_positive, 3, 3),
    "pixel_size": list_of(is_positive, 1, 2),
    "agreement": lambda value: is_positive(value) or value == 0.0,
}


def require_source(where: str, source: object) -> Table | None:
    """Return the source of a specimen: a table of a file and figures, or None.

    Raises:
        InputError: for an unknown entry, or a value of another type.
    """
    if source is None:
        return None
    found = dict(source) if isinstance(source, Mapping) else {}
    known = {"file"} <= found.keys() <= _RULES.keys()
    if not known or not all(_RULES[key](one) for key, one in found.items()):
        raise InputError(
            f"{where}: source = {quoted(source)}, must be a table of {', '.join(_RULES)}; save the "
            "specimen again"
        )
    return found


def traced(made: Made, file: str, **figures: float | Sequence[float]) -> Made:
    """Return a specimen, or a filling of one, whose spec has a source.

    Args:
        made: The specimen, a dataclass with a ``spec``.
        file: Name of the file without its folder.
        figures: Other entries of the source.
    """
    of: Any = made
    traced_one: Made = replace(of, spec=replace(of.spec, source={"file": file, **figures}))
    return traced_one
