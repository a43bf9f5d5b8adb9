# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints: from arrays, or from a CSV file. Lengths in metres. Nothing heavy is loaded."""

from __future__ import annotations

import csv
import hashlib
import itertools
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import csv_rows, read_text
from ..require import quoted

#: Columns of a file of joints.
COLUMNS = ("x1", "y1", "x2", "y2", "name")
#: How the names of closed lines begin that are excavated in a test, and rock until then (D77).
EXCAVATION = "excavation:"
_NOT_IN_NAMES = set(". =,\"'")
Point = tuple[float, float]
Line = list[Point]
#: Lines of each joint, by its name.
Lines = dict[str, list[Line]]


def read(path: Path) -> Lines:
    """Read the segments of a CSV file; consecutive segments with the same name form a line.

    A row without length repeats a point of its line, which counts once.

    Raises:
        InputError: if it cannot be read, or a row is not a segment.
    """
    name = f"joints = {str(path)!r}"
    found: Lines = {}
    first_rows: dict[str, list[int]] = {}
    for number, row in _rows(name, path):
        label = row[4]
        where = f"{name}, line {number}, joint {quoted(label)}"
        if len(row) > len(COLUMNS):
            raise InputError(
                f"{where}: cells = {len(row)}, must be {len(COLUMNS)}, one for each column; remove "
                "the others"
            )
        check_name(label, f"{where}: name")
        start, end = _ends(where, row)
        lines = found.setdefault(label, [])
        if lines and lines[-1][-1] == start:
            lines[-1].append(end)
        else:
            lines.append([start, end])
            first_rows.setdefault(label, []).append(number)
    for label, lines in found.items():
        for line, number in zip(lines, first_rows[label], strict=True):
            if all(point == line[0] for point in line):
                raise InputError(
                    f"{name}, line {number}, joint {quoted(label)}: x2, y2 = {line[0]} m, must not "
                    "be the start; remove the line"
                )
    return checked(found)


def _rows(name: str, path: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield line numbers and cells of rows, in the order of ``COLUMNS``, then surplus cells."""
    try:
        rows = csv_rows(read_text(path))
        columns = _filled(next(rows, (0, []))[1])
        if sorted(columns) != sorted(COLUMNS):
            raise InputError(
                f"{name}: columns = {quoted(','.join(columns))}, must have rows and the columns "
                f"{','.join(COLUMNS)}, each once; correct it"
            )
        places = [columns.index(column) for column in COLUMNS]
        begun = False
        for number, row in rows:
            begun = True
            row = _filled(row)
            cells = [row[place] if place < len(row) else "" for place in places]
            yield number, cells + row[len(COLUMNS) :]
        if not begun:
            raise InputError(
                f"{name}, must have rows and the columns {','.join(COLUMNS)}; correct it"
            )
    except OSError as error:
        raise InputError(f"{name}, cannot be read ({error.strerror}); give a CSV file") from None
    except InputError:
        raise
    except (ValueError, csv.Error) as error:  # also of a name that can be none
        raise InputError(f"{name}, is not a CSV file: {error}; correct the file") from None


def _filled(row: list[str]) -> list[str]:
    """Return the cells of a row up to the last cell with content: spreadsheets add empty cells."""
    return row[: max((at for at, cell in enumerate(row, 1) if cell), default=0)]


def checked(joints: object, *, excavations: bool = False) -> Lines:
    """Return lines of joints by name; a joint may be one line, rows x, y, or a list of lines.

    Args:
        joints: The lines.
        excavations: Whether there may be lines of excavations among them.

    Raises:
        InputError: for a value that is not a line, and for a name that no joint may have.
    """
    if not isinstance(joints, Mapping) or not joints:
        raise InputError(
            f"joints = {quoted(joints)}, must be lines by the name of their joint; give "
            f"{{name: [(x, y), ...]}}"
        )
    found: Lines = {}
    for name, given in joints.items():
        is_excavation = excavations and isinstance(name, str) and name.startswith(EXCAVATION)
        check_name(name[len(EXCAVATION) :] if is_excavation else name, "joint")
        lines = _plain(given)
        if _is_line(lines):
            lines = [lines]
        if not isinstance(lines, list) or not lines or not all(map(_is_line, lines)):
            raise InputError(
                f"joint {name} = {quoted(given)}, must be a line of two or more points x, y, or a "
                "list of lines; give [(x, y), (x, y)]"
            )
        found[name] = [_without_repeats(name, line) for line in lines]
    return found


def check_name(name: object, where: str) -> None:
    """Reject a name that is not a printable word, and a name that is reserved for excavations."""
    if not isinstance(name, str) or not name.isprintable() or not name or set(name) & _NOT_IN_NAMES:
        raise InputError(
            f"{where} = {quoted(name)}, must be a name without spaces, dots, commas, quotes, "
            "equals signs and unprintable characters; rename it"
        )
    if name.startswith(EXCAVATION):
        raise InputError(
            f"{where} = {quoted(name)}, must not begin with {EXCAVATION}, the mark of lines along "
            "which a test excavates; give it another name, or use Specimen.with_excavations"
        )


def _without_repeats(name: str, line: Sequence[Sequence[float]]) -> Line:
    """Return a line in which consecutive equal points count once."""
    points = [(float(x), float(y)) for x, y in line]
    found = points[:1] + [b for a, b in itertools.pairwise(points) if a != b]
    if len(found) < 2:
        raise InputError(
            f"joint {name}: point = {found[0]} m, is the start and end of a line without "
            "length; remove the line"
        )
    return found


def checksum(lines: Lines, before: str | None = None) -> str:
    """Short hash of lines, and of those that a specimen has already."""
    text = json.dumps([before, sorted(lines.items())])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _ends(where: str, row: Sequence[str]) -> Line:
    values = []
    for key, cell in zip(COLUMNS[:4], row, strict=False):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise InputError(f"{where}: {key} = {quoted(cell)} m, must be a number; correct it")
        values.append(value)
    return [(values[0], values[1]), (values[2], values[3])]


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
