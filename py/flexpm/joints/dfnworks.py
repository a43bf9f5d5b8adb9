# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of dfnWorks (``polygons.dat``) as joints of 3D specimens. Nothing heavy is loaded."""

from __future__ import annotations

import math
import re
from pathlib import Path

from ..errors import InputError
from ..files import read_text
from ..require import quoted
from .lines import check_name
from .planes import FARTHEST, JointPlane, Vector, polygon, require_few

#: Ending of the files.
SUFFIX = ".dat"
_HEAD = "nPolygons:"
_CORNER = re.compile(r"\{([^{}]*)\}")


def read(path: Path, joint: str | None, middle: Vector) -> list[JointPlane]:
    """Read the polygons of a file that dfnWorks has written.

    Args:
        path: The file: ``nPolygons: N``, and N lines of the number of corners and the corners
            ``{x, y, z}`` [m]. The middle of the domain of dfnWorks is the origin.
        joint: Name of the joint that all polygons get.
        middle: Point of the specimen at this origin [m].

    Raises:
        InputError: without a name; if the file cannot be read, or a line is no convex polygon.
    """
    label = f"joints = {str(path)!r}"
    if joint is None:
        raise InputError(
            f"joint = None, must be the name of the joint of {label}; add --joint NAME"
        )
    check_name(joint, "joint")
    try:
        lines = read_text(path).splitlines()
    except OSError as error:
        raise InputError(
            f"{label}, cannot be read ({error.strerror}); give polygons.dat of dfnWorks"
        ) from None
    except ValueError as error:
        raise InputError(f"{label}, is not a text file: {error}; correct the file") from None
    filled = [(number, line) for number, line in enumerate(lines, 1) if line.strip()]
    head = filled[0][1].strip() if filled else ""
    if head != f"{_HEAD} {len(filled) - 1}" or len(filled) < 2:
        raise InputError(
            f"{label}: first line = {quoted(head)}, must be {quoted(f'{_HEAD} N')} before N "
            f"polygons, of which the file has {max(len(filled) - 1, 0)}; correct the file"
        )
    found = [
        _polygon(f"{label}, line {number}", joint, line, middle) for number, line in filled[1:]
    ]
    require_few(found)
    return found


def _polygon(where: str, joint: str, line: str, middle: Vector) -> JointPlane:
    corners = [_corner(where, text, middle) for text in _CORNER.findall(line)]
    count = _CORNER.sub("", line).strip()
    if count != str(len(corners)):
        raise InputError(
            f"{where}: number of corners = {quoted(count)}, must be {len(corners)}, those in the "
            "line; correct the line"
        )
    return polygon(where, joint, corners)


def _corner(where: str, text: str, middle: Vector) -> Vector:
    try:
        x, y, z = (float(word) for word in text.split(","))
    except ValueError:
        x = y = z = math.nan
    if not all(abs(value) <= FARTHEST for value in (x, y, z)):
        raise InputError(
            f"{where}: corner = {quoted(text)}, must be three numbers of at most {FARTHEST:g} m; "
            "correct the line"
        )
    return x + middle[0], y + middle[1], z + middle[2]
