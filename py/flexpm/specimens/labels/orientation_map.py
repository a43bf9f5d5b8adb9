# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of crystal orientations: phases, orientations and places of measured points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
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
class Grid:
    """Where the points of a map lie.

    Attributes:
        raster: Point of each pixel, the first row on top; -1 where there is none.
        sides: Width and height of a pixel [m].
        steps: What is to be told of the steps; empty where they are those of the file's head.
    """

    raster: IntArray
    sides: tuple[float, float]
    steps: str = ""


@dataclass(frozen=True)
class OrientationMap:
    """Measured points on a grid.

    Attributes:
        phases: What phases there are.
        phase: Index of the phase of each point, -1 where none was found.
        orientations: Quaternions, (n, 4).
        grid: Where they lie, with a point for each pixel.
        missing: How many of the points, the last ones, were not measured.
    """

    phases: list[Phase]
    phase: IntArray
    orientations: FloatArray
    grid: Grid
    missing: int = 0

    @property
    def raster(self) -> IntArray:
        """Point of each pixel, the first row on top."""
        return self.grid.raster

    @classmethod
    def of(
        cls, phases: list[Phase], phase: IntArray, orientations: FloatArray, grid: Grid
    ) -> OrientationMap:
        """A map that gets a point without a phase wherever none was measured."""
        gaps = grid.raster < 0
        missing = int(np.count_nonzero(gaps))
        whole = grid.raster.copy()
        whole[gaps] = len(phase) + np.arange(missing)
        none = np.tile([0.0, 0.0, 0.0, 1.0], (missing, 1))
        return cls(
            phases,
            np.append(phase, np.full(missing, -1)),
            np.vstack((orientations, none)),
            replace(grid, raster=whole),
            missing,
        )


def is_hexagonal(x: FloatArray, step: float) -> bool:
    """Whether some rows of points begin half a step aside, x in micrometres, the step in metres."""
    along = (x - x.min(initial=np.inf)) / (1e6 * step)
    return bool(np.any(np.abs(along % 1.0 - 0.5) < ON_GRID))


def _steps_of(x: FloatArray, y: FloatArray) -> tuple[float, float] | None:
    """Steps along x and y that points themselves have, in their unit; None if there are none."""
    along = np.diff(x)[np.diff(y) == 0.0]
    along = np.abs(along[along != 0.0])
    ways = (np.unique(x), np.unique(y))
    if not len(along) or min(map(len, ways)) < 2:
        return None
    # each second row of a hexagonal grid lies half a step aside
    rough = float(np.median(along))
    if is_hexagonal(x, 1e-6 * rough):
        rough *= 0.5
    steps = []
    for way, near in zip(ways, (rough, float(np.median(np.diff(ways[1])))), strict=True):
        number = np.rint(np.diff(way) / near).sum()
        if not 1 <= number <= MOST_PIXELS:
            return None
        steps.append(float(np.ptp(way)) / number)
    return (2.0 * steps[0] if rough < np.median(along) else steps[0]), steps[1]


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

    def _places(
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

    def grid(
        self, x: FloatArray, y: FloatArray, steps: tuple[float, float] | None, hexagonal: bool
    ) -> Grid:
        """Where points lie, by the steps of the head or, if these do not fit, by their own.

        Args:
            x: To the right [um].
            y: Downwards [um].
            steps: Between columns and between rows, by the head [m]; None: it does not say.
            hexagonal: Whether each second row begins half a step aside, by the head.

        Raises:
            InputError: for points that are on no grid, or twice at one place.
        """
        try:
            if steps is None:
                raise self.refused("steps are missing, must be in the head; complete it")
            return self._raster(x, y, steps, hexagonal)
        except InputError as error:
            own = _steps_of(x, y)
            if own is None or not 1e-3 <= min(own) <= max(own) <= 1e6:
                raise
            metres = (1e-6 * own[0], 1e-6 * own[1])
            try:
                found = self._raster(x, y, metres, is_hexagonal(x, metres[0]))
            except InputError:
                raise error from None
        head = " x ".join(f"{1e6 * step:g}" for step in steps or ())
        other = f"not {head} um as in the head" if head else "none in the head"
        return replace(found, steps=f"{own[0]:g} x {own[1]:g} um by the points, {other}")

    def _raster(
        self, x: FloatArray, y: FloatArray, steps: tuple[float, float], hexagonal: bool
    ) -> Grid:
        """Where points lie.

        A point of a hexagonal grid has two pixels beside each other, so that each second row lies
        half a step aside, and has its six neighbours. What is left at both ends goes to the last
        point.
        """
        if not hexagonal:
            columns, rows = self._places(x, y, steps, np.zeros(2))
            raster = np.full((rows.max() + 1, columns.max() + 1), -1)
            raster[rows, columns] = np.arange(len(x))
            return Grid(raster, steps)
        near = np.abs(y - y.min()) < 0.5e6 * steps[1]
        late = near.any() and x[near].min() - x.min() > 0.25e6 * steps[0]
        shift = np.array([0.5, 0.0]) if late else np.array([0.0, 0.5])
        columns, rows = self._places(x, y, steps, shift)
        places = 2 * columns + (rows % 2 == (0 if late else 1))
        raster = np.full((rows.max() + 1, places.max() + 2), -1)
        for beside in (0, 1):
            raster[rows, places + beside] = np.arange(len(x))
        for end, inner in ((0, 1), (-1, -2)):
            raster[:, end] = np.where(raster[:, end] < 0, raster[:, inner], raster[:, end])
        return Grid(raster, (0.5 * steps[0], steps[1]))
