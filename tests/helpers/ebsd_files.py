# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of orientations as their formats have them, drawn."""

from __future__ import annotations

import math

import numpy as np

#: Numbers of Laue groups in .ctf files.
CTF = {
    name: number
    for number, name in enumerate("-1 2/m mmm 4/m 4/mmm -3 -3m 6/m 6/mmm m-3 m-3m".split(), start=1)
}
#: Symmetry in .ang files.
ANG = {
    **{"-1": 1, "2/m": 20, "mmm": 22, "4/m": 4, "4/mmm": 42, "-3": 3, "-3m": 32},
    **{"6/m": 6, "6/mmm": 62, "m-3": 23, "m-3m": 43},
}


def ctf_text(phase, angles, phases, steps=(1.0, 1.0), hexagonal=False):
    """A .ctf file: phase (rows, columns), 0 not indexed; angles (rows, columns, 3) [degree].

    Phases are pairs of name and Laue group; every second row of a hexagonal grid begins half a step
    later.
    """
    rows, columns = phase.shape
    head = ["Channel Text File", "Prj\tdrawn", "Author\t[Unknown]", "JobMode\tGrid"]
    head += [f"XCells\t{columns}", f"YCells\t{rows}"]
    head += [f"XStep\t{steps[0]}", f"YStep\t{steps[1]}", "AcqE1\t0", "AcqE2\t0", "AcqE3\t0"]
    head += ["Euler angles refer to Sample Coordinate system (CS0)!\tMag\t0\tCoverage\t100"]
    head += [f"Phases\t{len(phases)}"]
    head += [f"4.9;4.9;5.4\t90;90;120\t{name}\t{CTF[group]}\t0\t\t\t" for name, group in phases]
    head += ["Phase\tX\tY\tBands\tError\tEuler1\tEuler2\tEuler3\tMAD\tBC\tBS"]
    for row in range(rows):
        late = hexagonal and row % 2 == 1
        for column in range(columns - late):
            turn = "\t".join(f"{angle:.4f}" for angle in angles[row, column])
            x, y = (column + 0.5 * late) * steps[0], row * steps[1]
            head.append(f"{phase[row, column]}\t{x:.4f}\t{y:.4f}\t7\t0\t{turn}\t0.5\t99\t99")
    return "\n".join([*head, ""])


def ang_text(phase, angles, phases, steps=(1.0, 1.0), hexagonal=False):
    """A .ang file of the same."""
    rows, columns = phase.shape
    head = ["# TEM_PIXperUM 1.0", "# x-star 0.5", "#"]
    for number, (name, group) in enumerate(phases, 1):
        head += [f"# Phase {number}", f"# MaterialName  \t{name}", "# Formula  \tSiO2"]
        head += [f"# Symmetry              {ANG[group]}", "# NumberFamilies 0"]
    head += ["#", f"# GRID: {'HexGrid' if hexagonal else 'SqrGrid'}"]
    head += [f"# XSTEP: {steps[0]}", f"# YSTEP: {steps[1]}", f"# NCOLS_ODD: {columns}"]
    head += [f"# NCOLS_EVEN: {columns - hexagonal}", f"# NROWS: {rows}", "#"]
    for row in range(rows):
        late = hexagonal and row % 2 == 1
        for column in range(columns - late):
            there = phase[row, column] > 0
            turn = np.radians(angles[row, column]) if there else [4.0 * math.pi] * 3
            place = f"{(column + 0.5 * late) * steps[0]:.5f} {row * steps[1]:.5f}"
            numbers = " ".join(f"{angle:.5f}" for angle in turn)
            sure = 0.9 if there else -1.0
            head.append(f" {numbers} {place} 100.0 {sure:.3f} {max(phase[row, column], 0)} 1 0.5")
    return "\n".join([*head, ""])
