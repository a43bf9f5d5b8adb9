# SPDX-License-Identifier: GPL-3.0-or-later
"""Read maps of orientations from Channel Text Files, ``.ctf``, on square and hexagonal grids."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import laue
from .orientation_map import Head, MapText, OrientationMap, Phase

#: Laue groups by their number in these files, from 1.
_GROUPS = ("-1", "2/m", "mmm", "4/m", "4/mmm", "-3", "-3m", "6/m", "6/mmm", "m-3", "m-3m")
_COLUMNS = ("Phase", "X", "Y", "Euler1", "Euler2", "Euler3")
_MOST_PHASES = 100
_NO_STACKS = "stacks of maps are not read; export one slice"


def read(path: Path) -> OrientationMap:
    """Read a map, in a crystal frame with x along a* and y along b.

    Args:
        path: The file.

    Returns:
        The map.

    Raises:
        InputError: for a file that is not a ``.ctf`` file, or a broken line, with its number.
    """
    text = MapText(path)
    lines = text.lines
    if not lines or not lines[0].startswith("Channel Text File"):
        raise text.refused("must begin with Channel Text File; give a .ctf file", 0)
    found: dict[str, tuple[str, int]] = {}
    for line, row in enumerate(lines):
        cells = row.split("\t")
        if len(cells) > 1:
            found.setdefault(cells[0].strip(), (cells[1].strip(), line))
        if cells[0].strip() == "Phases":
            break
    if found.get("JobMode", ("",))[0] == "Interactive":
        raise text.refused(
            "JobMode = Interactive, must be Grid: its points do not form a grid; give a map",
            found["JobMode"][1],
        )
    for key in ("XStep", "YStep", "Phases"):
        if key not in found:
            raise text.refused(f"{key} is missing in the head; complete it")
    steps = (text.step("XStep", *found["XStep"]), text.step("YStep", *found["YStep"]))
    wide, high, deep = (
        text.count(key, *found[key]) if key in found else 0
        for key in ("XCells", "YCells", "ZCells")
    )
    if deep > 1:
        raise text.refused(f"ZCells = {deep}, must be 1: {_NO_STACKS}", found["ZCells"][1])
    count, first = found["Phases"]
    number = int(text.number("Phases", count, first))
    if not 1 <= number <= _MOST_PHASES:
        raise text.refused(f"Phases = {number}, must be 1 to {_MOST_PHASES}; correct it", first)
    phases = [_phase(text, line) for line in range(first + 1, first + 1 + number)]
    head = first + 1 + number
    names = lines[head].split() if head < len(lines) else []
    missing = [name for name in _COLUMNS if name not in names]
    if missing:
        raise text.refused(f"columns {', '.join(missing)} are missing; export them", head)
    given = [*_COLUMNS, *(["Z"] if "Z" in names else [])]
    values = text.table(head + 1, [names.index(name) for name in given])
    phase, x, y = values[:, :3].T
    layers = len(np.unique(values[:, len(_COLUMNS) :]))
    if layers > 1:
        raise text.refused(f"Z = {layers} layers, must be 1: {_NO_STACKS}", head)
    if len(phase) and not (np.isin(phase, np.arange(number + 1))).all():
        wrong = int(np.flatnonzero(~np.isin(phase, np.arange(number + 1)))[0])
        raise text.refused(
            f"point {wrong + 1}: Phase = {phase[wrong]:g}, must be 0 to {number}; correct it"
        )
    shape = (wide, high) if wide and high else None
    grid = text.grid(x, y, Head(steps, None, shape, "XCells x YCells"))
    turned = laue.orientations(values[:, 3:6], degrees=True)
    return OrientationMap.of(phases, phase.astype(int) - 1, turned, grid)


def _phase(text: MapText, line: int) -> Phase:
    """Return the phase of a line: lattice, angles, name and Laue group index, separated by tabs."""
    cells = text.lines[line].split("\t") if line < len(text.lines) else []
    if len(cells) < 4 or not cells[2].strip():
        raise text.refused("phase: must be lattice, angles, name and Laue group; complete it", line)
    number = text.number("Laue group", cells[3], line)
    if number not in range(1, len(_GROUPS) + 1):
        raise text.refused(
            f"Laue group = {number:g}, must be 1 to {len(_GROUPS)}; correct it", line
        )
    return Phase(cells[2].strip(), laue.rotations(_GROUPS[int(number) - 1], "y"))
