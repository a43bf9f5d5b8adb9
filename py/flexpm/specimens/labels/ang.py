# SPDX-License-Identifier: GPL-3.0-or-later
"""Read maps of orientations from ``.ang`` files of TSL and EDAX, on square and hexagonal grids."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from . import laue
from .orientation_map import Head, MapText, OrientationMap, Phase

#: Laue groups by the symmetry in these files, and the direction of a twofold axis.
_GROUPS = {
    **{"1": ("-1", ""), "2": ("2/m", "z"), "20": ("2/m", "y"), "200": ("2/m", "x")},
    **{"22": ("mmm", ""), "4": ("4/m", ""), "42": ("4/mmm", ""), "3": ("-3", "")},
    **{"32": ("-3m", "x"), "6": ("6/m", ""), "62": ("6/mmm", ""), "23": ("m-3", "")},
    "43": ("m-3m", ""),
}
#: Other programs write the names of the rotations, or of the Laue groups, in full.
_FULL = {"222": "22", "422": "42", "622": "62", "432": "43", "121": "20", "2/m": "20", "-3m": "32"}
_GROUPS |= {name: _GROUPS[short] for name, short in _FULL.items()}
_GROUPS |= {name: (name, "") for name in laue.NAMES if name not in _GROUPS}
#: Columns: phi1, Phi, phi2, x, y, image quality, confidence, phase.
_COLUMNS = (0, 1, 2, 3, 4, 6, 7)
#: Points in the first row, in the second one, and rows.
_COUNTS = ("NCOLS_ODD", "NCOLS_EVEN", "NROWS")
#: Angles of points that were not indexed are 4 pi.
_NO_ANGLE = 4.0 * math.pi - 1e-3


def read(path: Path) -> OrientationMap:
    """Read a map, in a crystal frame with x along a and y along b*.

    Points with a negative confidence, or with angles of 4 pi, are not indexed.

    Args:
        path: The file.

    Returns:
        The map.

    Raises:
        InputError: for a file that is not an ``.ang`` file, or a broken line, with its number.
    """
    text = MapText(path)
    head: dict[str, tuple[str, int]] = {}
    phases: dict[int, Phase] = {}
    name, number, first = "", -1, 0
    for first, row in enumerate(text.lines):  # the line after the head
        if not row.startswith("#"):
            break
        key, value, *_ = [*row[1:].replace(":", " ").split(maxsplit=1), "", ""]
        value = value.strip()
        if key == "Phase":
            number, name = int(text.number("Phase", value, first)), f"phase {value}"
        elif key == "MaterialName" and value:
            name = value
        elif key == "Symmetry":
            group = _GROUPS.get(value)
            if group is None:
                known = ", ".join(_GROUPS)
                raise text.refused(
                    f"Symmetry = {value}, must be one of {known}; correct the head", first
                )
            if number in phases or number < 0:  # files without lines of numbers count from 1
                number = len(phases) + 1
            phases[number] = Phase(name, laue.rotations(*group))
        elif key in ("GRID", "XSTEP", "YSTEP", *_COUNTS):
            head.setdefault(key, (value.rstrip("#"), first))
    if not phases:
        raise text.refused("Symmetry is missing for a phase; complete the head")
    if "GRID" not in head:
        raise text.refused("GRID is missing in the head; complete it")
    kind, line = head["GRID"]
    if kind not in ("SqrGrid", "HexGrid"):
        raise text.refused(f"GRID = {kind}, must be SqrGrid or HexGrid; correct the head", line)
    # heads of other programs may leave the steps to the points
    both = "XSTEP" in head and "YSTEP" in head
    steps = (
        (text.step("XSTEP", *head["XSTEP"]), text.step("YSTEP", *head["YSTEP"])) if both else None
    )
    odd, even, rows = (text.count(key, *head[key]) if key in head else 0 for key in _COUNTS)
    columns = max(odd, even)
    values = text.table(first, _COLUMNS)
    indexed = (values[:, 5] >= 0.0) & (np.abs(values[:, :3]) < _NO_ANGLE).all(axis=1)
    phase = _indices(text, values[:, 6], indexed, list(phases))
    shape = (columns, rows) if columns and rows else None
    grid = text.grid(
        values[:, 3],
        values[:, 4],
        Head(steps, kind == "HexGrid", shape, "NCOLS_ODD or NCOLS_EVEN x NROWS"),
    )
    turned = laue.orientations(np.where(indexed[:, None], values[:, :3], 0.0), degrees=False)
    return OrientationMap.of(list(phases.values()), phase, turned, grid)


def _indices(text: MapText, phase: FloatArray, indexed: BoolArray, numbers: list[int]) -> IntArray:
    """Return the phase index of each point, (n,); a file with one phase may number it 0."""
    found = np.full(len(phase), -1)
    for index, number in enumerate(numbers):
        found[phase == number] = index
    if len(numbers) == 1:
        found[phase == 0] = 0
    wrong = np.flatnonzero((found < 0) & indexed)
    if len(wrong):
        raise text.refused(
            f"point {wrong[0] + 1}: phase = {phase[wrong[0]]:g}, must be one of "
            f"{', '.join(map(str, numbers))}, as in the head; correct one of them"
        )
    return np.where(indexed, found, -1)
