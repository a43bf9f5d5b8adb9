# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV files of joints of 3D specimens: polygons, discs or whole planes. Nothing heavy is loaded."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from ..errors import InputError
from ..files import csv_rows, read_text
from ..require import LENGTH, quoted, require_number
from .lines import check_name
from .planes import (
    DIP,
    DIRECTION,
    FARTHEST,
    JointPlane,
    Vector,
    disc,
    normal_of,
    plane,
    polygon,
    require_few,
)

#: Columns of discs; whole planes have no radius.
DISC = ("x", "y", "z", "dip", "dip_direction", "radius", "name")
PLANE = tuple(column for column in DISC if column != "radius")
_FORMS = (
    f"name,x0,y0,z0,x1,y1,z1,... for polygons, {','.join(DISC)} for discs, {','.join(PLANE)} for "
    "whole planes"
)


def read(path: Path) -> list[JointPlane]:
    """Read the polygons, discs or planes of a CSV file, one in each row.

    Raises:
        InputError: if it cannot be read, or a row is no polygon, disc or plane.
    """
    label = f"joints = {str(path)!r}"
    try:
        rows = list(csv_rows(read_text(path)))
    except OSError as error:
        raise InputError(f"{label}, cannot be read ({error.strerror}); give a CSV file") from None
    except (ValueError, csv.Error) as error:
        raise InputError(f"{label}, is not a CSV file: {error}; correct the file") from None
    columns = _filled(rows[0][1]) if rows else []
    if len(rows) < 2 or not _is_head(columns):
        raise InputError(
            f"{label}: columns = {quoted(','.join(columns))}, must have rows and the columns "
            f"{_FORMS}; correct it"
        )
    found = [_row(label, number, columns, _filled(cells)) for number, cells in rows[1:]]
    require_few(found)
    return found


def _is_head(columns: list[str]) -> bool:
    if sorted(columns) in (sorted(DISC), sorted(PLANE)):
        return True
    corners, odd = divmod(len(columns) - 1, 3)
    names = [f"{axis}{corner}" for corner in range(corners) for axis in "xyz"]
    return odd == 0 and corners >= 3 and columns == ["name", *names]


def _row(label: str, number: int, columns: list[str], cells: list[str]) -> JointPlane:
    is_polygon = columns[0] == "name" and columns[1] == "x0"
    at = columns.index("name")
    name = cells[at] if at < len(cells) else ""
    where = f"{label}, line {number}, joint {quoted(name)}"
    check_name(name, f"{where}: name")
    if len(cells) > len(columns) or (len(cells) != len(columns) and not is_polygon):
        raise InputError(
            f"{where}: cells = {len(cells)}, must be {len(columns)}, one for each column; correct "
            "the row"
        )
    values = {
        column: _number(where, column, cell)
        for column, cell in zip(columns, cells, strict=False)
        if column != "name"
    }
    if is_polygon:
        corners, odd = divmod(len(values), 3)
        if odd:
            raise InputError(
                f"{where}: numbers = {len(values)}, must be three for each corner; correct the row"
            )
        numbers = list(values.values())
        places: list[Vector] = [
            (numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]) for k in range(corners)
        ]
        return polygon(where, name, places)
    centre = (values["x"], values["y"], values["z"])
    dip = require_number(f"{where}: dip", values["dip"], DIP, "degree")
    direction = require_number(
        f"{where}: dip_direction", values["dip_direction"], DIRECTION, "degree"
    )
    if "radius" not in values:
        return plane(name, centre, dip, direction)
    radius = require_number(f"{where}: radius", values["radius"], LENGTH, "m")
    return disc(name, centre, normal_of(dip, direction), radius)


def _number(where: str, column: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not abs(value) <= FARTHEST:
        raise InputError(
            f"{where}: {column} = {quoted(cell)}, must be a number of at most {FARTHEST:g}; "
            "correct it"
        )
    return value


def _filled(row: list[str]) -> list[str]:
    """Return the cells of a row up to the last cell with content: spreadsheets add empty cells."""
    return row[: max((at for at, cell in enumerate(row, 1) if cell), default=0)]
