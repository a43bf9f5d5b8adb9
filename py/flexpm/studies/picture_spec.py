# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables ``[[picture]]`` of a study file, checked before the first run."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from functools import partial

from ..errors import InputError
from ..files import Table
from ..renamed import ATTRIBUTES, present
from ..require import (
    require_file_name,
    require_known,
    require_list,
    require_table,
    require_text,
)
from ..results.result import Result
from .jobs import NOT_MEASURES

KEYS = ("file", "x", "y", "by", "where", "title")
#: Ends of the names of pictures.
SUFFIXES = (".png", ".pdf", ".svg")
#: Columns of a table beside the inputs: what runs may give.
_MEASURES = ("key", "exit_code", "message", *(field.name for field in dataclasses.fields(Result)))
_HIDDEN = (*NOT_MEASURES, "inputs", "curve", "cracks", "snapshot", "resumed_at")


def checked(entries: Table, inputs: Iterable[str]) -> Table:
    """Return a table ``[[picture]]``, or raise InputError for an unknown key or column.

    Args:
        entries: The table.
        inputs: Names of the inputs of the runs.
    """
    for key in entries:
        require_known("study [[picture]] key", key, KEYS)
    for key in ("x", "y"):
        if key not in entries:
            raise InputError(f"study [[picture]] {key} is missing; give the name of a column")
    by = require_list("study [[picture]] by", entries.get("by", []))
    where = require_table("study [[picture]] where", entries.get("where", {}))
    known = [*dict.fromkeys([*inputs, *(name for name in _MEASURES if name not in _HIDDEN)])]
    new = partial(present, names=ATTRIBUTES["Result"], there=known)
    by, where = [*map(new, by)], {new(name): one for name, one in where.items()}
    entries = {**entries, "x": new(entries["x"]), "y": new(entries["y"])}
    entries |= {key: one for key, one in (("by", by), ("where", where)) if key in entries}
    for column in (entries["x"], entries["y"], *by, *where):
        require_known("study [[picture]] column", column, known)
    if "file" in entries:
        require_file_name("study [[picture]] file", entries["file"], SUFFIXES)
    require_text("study [[picture]] title", entries.get("title", ""))
    return entries
