# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of crystal orientations: phases, orientations and places of measured points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import read_text
from ...require import quoted
from .given import MOST_PIXELS

#: Steps from point to point differ by less [-].
ON_GRID = 0.1


@dataclass(frozen=True)
class Phase:
    """A phase of a map."""

    name: str
    rotations: FloatArray  #: of its Laue group, (k, 4)


@dataclass(frozen=True)
class OrientationMap:
    """Measured points on a grid.

    Attributes:
        phases: What phases there are.
        phase: Index of the phase of each point, -1 where none was found.
        orientations: Quaternions, (n, 4).
        raster: Point of each pixel, the first row on top.
        sides: Width and height of a pixel [m].
        missing: How many of the points, the last ones, were not measured.
    """

    phases: list[Phase]
    phase: IntArray
    orientations: FloatArray
    raster: IntArray
    sides: tuple[float, float]
    missing: int = 0

    @classmethod
    def of(
        cls,
        phases: list[Phase],
        phase: IntArray,
        orientations: FloatArray,
        raster: IntArray,
        sides: tuple[float, float],
    ) -> OrientationMap:
        """A map whose raster is -1 where no point was measured: there it gets one without phase."""
        gaps = raster < 0
        missing = int(np.count_nonzero(gaps))
        whole = raster.copy()
        whole[gaps] = len(phase) + np.arange(missing)
        none = np.tile([0.0, 0.0, 0.0, 1.0], (missing, 1))
        return cls(
            phases,
            np.append(phase, np.full(missing, -1)),
            np.vstack((orientations, none)),
            whole,
            sides,
            missing,
        )


class MapText:
    """Text of a map: its lines, and a table of numbers from one of them on.

    Args:
        path: The file, at most 64 MB.

    Raises:
        InputError: if it cannot be read.
    """

    def __init__(self, path: Path) -> None:
        self._name = f"ebsd = {quoted(str(path))}"
        try:
            self.lines = read_text(path).splitlines()
        except OSError as error:
            raise InputError(
                f"{self._name}, cannot be read ({error.strerror}); give a .ctf or .ang file"
            ) from None
        except ValueError as error:
            raise InputError(f"{self._name}, is no text of a map: {error}") from None

    def refused(self, why: str, line: int | None = None) -> InputError:
        """The error of a line, counted from 0."""
        place = "" if line is None else f", line {line + 1}"
        return InputError(f"{self._name}{place}: {why}")

    def number(self, what: str, text: str, line: int) -> float:
        """A finite number of a line; a decimal comma is one, too."""
        try:
            value = float(text.replace(",", "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise self.refused(f"{what} = {quoted(text)}, must be a number; correct it", line)
        return value

    def step(self, what: str, text: str, line: int) -> float:
        """A step of the grid in micrometres, as metres."""
        value = self.number(what, text, line)
        if not 1e-3 <= value <= 1e6:
            raise self.refused(f"{what} = {text} um, must be 0.001 to 1e6; correct it", line)
        return 1e-6 * value

    def table(self, first: int, columns: Sequence[int]) -> FloatArray:
        """Columns of numbers from a line on, (rows, columns)."""
        least, rows = max(columns) + 1, []
        for line, text in enumerate(self.lines[first:], first):
            if not text.strip():
                continue
            cells = text.replace(",", ".").split()
            if len(cells) < least:
                raise self.refused(f"columns = {len(cells)}, must be >= {least}; complete it", line)
            try:
                rows.append([float(cells[column]) for column in columns])
            except ValueError:
                for column in columns:
                    self.number(f"column {column + 1}", cells[column], line)
            if len(rows) > MOST_PIXELS:
                raise self.refused(f"points = more than {MOST_PIXELS}, must be less; cut the map")
        found = np.array(rows, dtype=float).reshape(-1, len(columns))
        if not np.isfinite(found).all():
            row = int(np.argwhere(~np.isfinite(found))[0, 0])
            raise self.refused(f"point {row + 1}: a number is not finite; correct it")
        return found

    def places(
        self, x: FloatArray, y: FloatArray, steps: tuple[float, float], shift: FloatArray
    ) -> tuple[IntArray, IntArray]:
        """Columns and rows of points.

        Args:
            x: To the right [um].
            y: Downwards [um].
            steps: Between columns and between rows [m].
            shift: What a row begins with, of a step, for even and odd rows [-].
        """
        if len(x) < 4:
            raise self.refused(f"points = {len(x)}, must be >= 4; give a whole map")
        most = 2.0 * MOST_PIXELS  # beyond it no grid is filled; larger numbers are not whole ones
        down = np.minimum((y - y.min()) / (1e6 * steps[1]), most)
        rows = np.rint(down).astype(int)
        along = np.minimum((x - x.min()) / (1e6 * steps[0]), most) - shift[rows % 2]
        columns = np.rint(along).astype(int)
        wrong = (np.abs(down - rows) > ON_GRID) | (np.abs(along - columns) > ON_GRID)
        wrong |= (columns < 0) | (columns > MOST_PIXELS) | (rows > MOST_PIXELS)
        if wrong.any():
            point = int(np.flatnonzero(wrong)[0])
            raise self.refused(
                f"point {point + 1}: x, y = {x[point]:g}, {y[point]:g} um, must be on the grid of "
                f"steps {1e6 * steps[0]:g} and {1e6 * steps[1]:g} um; correct the steps"
            )
        size = (int(rows.max()) + 1, int(columns.max()) + 1)
        if size[0] * size[1] > min(MOST_PIXELS, 4 * len(x) + 1000):
            raise self.refused(
                f"grid = {size[1]} x {size[0]} for {len(x)} points, must be filled by them; "
                "correct the steps"
            )
        taken = np.unique(rows * size[1] + columns, return_index=True)[1]
        if len(taken) < len(x):
            point = int(np.setdiff1d(np.arange(len(x)), taken)[0])
            raise self.refused(
                f"point {point + 1}: x, y = {x[point]:g}, {y[point]:g} um, must not be there "
                "twice; correct the steps"
            )
        return columns, rows

    def raster(
        self, x: FloatArray, y: FloatArray, steps: tuple[float, float], hexagonal: bool
    ) -> tuple[IntArray, tuple[float, float]]:
        """Point of each pixel, -1 where there is none, and the sides of a pixel [m].

        A point of a hexagonal grid has two pixels beside each other, so that each second row lies
        half a step aside, and has its six neighbours. What is left at both ends goes to the last
        point.
        """
        if not hexagonal:
            columns, rows = self.places(x, y, steps, np.zeros(2))
            raster = np.full((rows.max() + 1, columns.max() + 1), -1)
            raster[rows, columns] = np.arange(len(x))
            return raster, steps
        near = np.abs(y - y.min()) < 0.5e6 * steps[1]
        late = near.any() and x[near].min() - x.min() > 0.25e6 * steps[0]
        shift = np.array([0.5, 0.0]) if late else np.array([0.0, 0.5])
        columns, rows = self.places(x, y, steps, shift)
        places = 2 * columns + (rows % 2 == (0 if late else 1))
        raster = np.full((rows.max() + 1, places.max() + 2), -1)
        for beside in (0, 1):
            raster[rows, places + beside] = np.arange(len(x))
        for end, inner in ((0, 1), (-1, -2)):
            raster[:, end] = np.where(raster[:, end] < 0, raster[:, inner], raster[:, end])
        return raster, (0.5 * steps[0], steps[1])
