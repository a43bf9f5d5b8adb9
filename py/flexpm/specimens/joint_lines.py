# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints: from arrays, or from a CSV file. Lengths in metres. Nothing heavy is loaded."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text
from ..require import quoted

#: Columns of a file of joints.
COLUMNS = ("x1", "y1", "x2", "y2", "name")
Line = list[tuple[float, float]]
#: Lines of each joint, by its name.
Lines = dict[str, list[Line]]


def read(path: Path) -> Lines:
    """Read the segments of a CSV file; those of one name that follow each other are one line.

    Raises:
        InputError: if it cannot be read, or a row is no segment.
    """
    name = f"joints = {str(path)!r}"
    try:
        text = read_text(path)
        rows = list(csv.DictReader(io.StringIO(text, newline=""), skipinitialspace=True))
        columns = rows[0].keys() if rows else ()
    except OSError as error:
        raise InputError(f"{name}, cannot be read ({error.strerror}); give a CSV file") from None
    except (ValueError, csv.Error) as error:  # also of a name that can be none
        raise InputError(f"{name}, is no CSV file: {error}") from None
    if set(columns) != {*COLUMNS}:
        raise InputError(f"{name}, must have rows and the columns {','.join(COLUMNS)}; correct it")
    found: Lines = {}
    for number, row in enumerate(rows, 2):
        where = f"{name}, line {number}"
        start, end = _ends(where, row)
        label = (row["name"] or "").strip()
        lines = found.setdefault(label, [])
        if lines and lines[-1][-1] == start:
            lines[-1].append(end)
        else:
            lines.append([start, end])
    return checked(found)


def checked(joints: object) -> Lines:
    """Lines of joints by name; a joint may be one line, rows x, y, or a list of lines.

    Raises:
        InputError: for what is no line.
    """
    if not isinstance(joints, Mapping) or not joints:
        raise InputError(f"joints = {quoted(joints)}, must be lines by the name of their joint")
    found: Lines = {}
    for name, given in joints.items():
        if not isinstance(name, str) or not name or set(name) & set(". =,\"'"):
            raise InputError(
                f"joint = {quoted(name)}, must be a name without spaces, dots, commas, quotes and "
                "equals signs"
            )
        lines = _plain(given)
        if _is_line(lines):
            lines = [lines]
        if not isinstance(lines, list) or not lines or not all(map(_is_line, lines)):
            raise InputError(
                f"joint {name} = {quoted(given)}, must be a line of two points x, y or more, or a "
                "list of lines"
            )
        found[name] = [[(float(x), float(y)) for x, y in line] for line in lines]
    return found


def checksum(lines: Lines, before: str | None = None) -> str:
    """Short hash of lines, and of those that a specimen has already."""
    text = json.dumps([before, sorted(lines.items())])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _ends(where: str, row: Mapping[str | Any, str | Any]) -> Line:
    values = []
    for key in COLUMNS[:4]:
        try:
            value = float(row[key])
        except (TypeError, ValueError):
            value = math.nan
        if not math.isfinite(value):
            raise InputError(f"{where}: {key} = {quoted(row[key])} m, must be a number; correct it")
        values.append(value)
    start, end = (values[0], values[1]), (values[2], values[3])
    if start == end:
        raise InputError(f"{where}: x2, y2 = {end} m, must not be the start; remove the line")
    return [start, end]


def _plain(given: object) -> Any:
    """Arrays as lists."""
    if hasattr(given, "tolist"):
        return given.tolist()
    if isinstance(given, Sequence) and not isinstance(given, str):
        return [_plain(one) for one in given]
    return given


def _is_line(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= 2 and all(map(_is_point, value))


def _is_point(value: Any) -> bool:
    numbers = isinstance(value, list) and len(value) == 2
    return numbers and all(isinstance(x, int | float) and math.isfinite(x) for x in value)
