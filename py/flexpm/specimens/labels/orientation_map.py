# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of crystal orientations: phases, orientations and positions of measured points."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...files import read_text
from ...require import quoted
from .given import MOST_PIXELS

#: Steps from point to point differ by less [-].
ON_GRID = 0.1

#: A grid of which points fill less may be that of a map before it was thinned [-].
_FILLED = 0.5


@dataclass(frozen=True)
class Phase:
    """A phase of a map."""

    name: str
    rotations: FloatArray  #: of its Laue group, (k, 4)


@dataclass(frozen=True)
class Grid:
    """Positions of the points of a map.

    Attributes:
        raster: Point of each pixel, the first row at the top; an index from the number of points on
            stands for a point that was not measured.
        sides: Width and height of a pixel [m].
        shape: Number of columns, of the longest row, and of rows.
        missing: Number of points that were not measured.
        unlike_head: Differences from the file's head, by name: ``steps``, ``grid``, ``cells``.
    """

    raster: IntArray
    sides: tuple[float, float]
    shape: tuple[int, int]
    missing: int
    unlike_head: dict[str, str] = field(default_factory=dict)

    @property
    def filled(self) -> float:
        """Share of the points that were measured [-]."""
        return 1.0 - self.missing / (int(self.raster.max()) + 1)


@dataclass(frozen=True)
class Head:
    """Description of the grid in the head of a file.

    Attributes:
        steps: Steps between columns and between rows [m]; None: not given.
        hexagonal: Whether each second row begins half a step aside; None: not given.
        shape: Number of columns, of the longest row, and of rows; None: not given.
        keys: Names of both numbers in the file, for messages.
    """

    steps: tuple[float, float] | None
    hexagonal: bool | None
    shape: tuple[int, int] | None
    keys: str


@dataclass(frozen=True)
class OrientationMap:
    """Measured points on a grid.

    Attributes:
        phases: The phases.
        phase: Index of the phase of each point, -1 without a phase.
        orientations: Quaternions, (n, 4).
        grid: Positions of the points, with a point for each pixel.
        missing: Number of points at the end that were not measured.
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
        """Return a map with an additional point without a phase at each unmeasured position."""
        none = np.tile([0.0, 0.0, 0.0, 1.0], (grid.missing, 1))
        return cls(
            phases,
            np.append(phase, np.full(grid.missing, -1)),
            np.vstack((orientations, none)),
            grid,
            grid.missing,
        )


def is_hexagonal(x: FloatArray, step: float) -> bool:
    """Return whether some rows of points begin half a step aside.

    Args:
        x: Coordinates of points [um].
        step: Step between columns [m].
    """
    along = (x - x.min(initial=np.inf)) / (1e6 * step)
    return bool(np.any(np.abs(along % 1.0 - 0.5) < ON_GRID))


def _steps_of(x: FloatArray, y: FloatArray) -> tuple[float, float] | None:
    """Return the steps along x and y between the points, in their unit; None without steps."""
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


def _unlike(steps: tuple[float, float], hexagonal: bool, head: Head) -> dict[str, str]:
    """Return the differences between a grid and the head: its type, or its steps [m]."""
    found = {}
    kinds = {True: "hexagonal", False: "square"}
    same = head.steps is not None and np.allclose(steps, head.steps, rtol=1e-3, atol=0.0)
    if head.hexagonal is not None and hexagonal is not head.hexagonal:
        told = kinds[head.hexagonal]
        found["grid"] = f"{kinds[hexagonal]} by the points, not {told} as in the head"
    if not same:
        own, given = (
            " x ".join(f"{1e6 * step:g}" for step in one or ()) for one in (steps, head.steps)
        )
        other = f"not {given} um as in the head" if given else "none in the head"
        found["steps"] = f"{own} um by the points, {other}"
    return found


class MapText:
    """Text of a map: its lines, and a table of numbers that begins at one of the lines.

    Args:
        path: The file, at most 64 MB.

    Raises:
        InputError: for a file that cannot be read.
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
            raise InputError(
                f"{self._name}, is not a text file of a map: {error}; give a .ctf or .ang file"
            ) from None

    def refused(self, why: str, line: int | None = None) -> InputError:
        """Return the error of a line; lines are counted from 0."""
        place = "" if line is None else f", line {line + 1}"
        return InputError(f"{self._name}{place}: {why}")

    def number(self, what: str, text: str, line: int) -> float:
        """Return a finite number of a line; a decimal comma is also accepted."""
        try:
            value = float(text.replace(",", "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise self.refused(f"{what} = {quoted(text)}, must be a number; correct it", line)
        return value

    def count(self, what: str, text: str, line: int) -> int:
        """Return a number of columns, rows or layers; 0 if the head does not state it."""
        value = self.number(what, text, line)
        if not 0 <= value <= MOST_PIXELS or value != int(value):
            raise self.refused(
                f"{what} = {quoted(text)}, must be a whole number up to {MOST_PIXELS}; correct it",
                line,
            )
        return int(value)

    def step(self, what: str, text: str, line: int) -> float:
        """Return a step of the grid, read in micrometres, in metres."""
        value = self.number(what, text, line)
        if not 1e-3 <= value <= 1e6:
            raise self.refused(f"{what} = {text} um, must be 0.001 to 1e6; correct it", line)
        return 1e-6 * value

    def table(self, first: int, columns: Sequence[int]) -> FloatArray:
        """Return columns of numbers from a line on, (rows, columns)."""
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
        """Return the columns and rows of points.

        Args:
            x: Coordinate to the right [um].
            y: Coordinate downwards [um].
            steps: Steps between columns and between rows [m].
            shift: Offset of the first point of even and odd rows, as a fraction of a step [-].
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
                f"point {point + 1}: x, y = {x[point]:g}, {y[point]:g} um, is given twice; correct "
                "the steps"
            )
        return columns, rows

    def grid(self, x: FloatArray, y: FloatArray, head: Head) -> Grid:
        """Return the grid of the points: steps of the head or, if these do not fit, of the points.

        Args:
            x: Coordinate to the right [um].
            y: Coordinate downwards [um].
            head: Description of the grid in the head.

        Raises:
            InputError: for points that are not on a grid, two points at one position, or fewer
                columns or rows than in the head.
        """
        steps, reason = (
            head.steps,
            self.refused("steps are missing, must be in the head; complete it"),
        )
        found = None
        if steps is not None:
            told = head.hexagonal
            try:
                found = self._raster(
                    x, y, steps, is_hexagonal(x, steps[0]) if told is None else told
                )
            except InputError as error:
                reason = error
        if found is None or found.filled < _FILLED:  # each second point of a thinned map is on it
            own = _steps_of(x, y)
            if own is not None and 1e-3 <= min(own) <= max(own) <= 1e6:
                metres = (1e-6 * own[0], 1e-6 * own[1])
                hexagonal = is_hexagonal(x, metres[0])
                with contextlib.suppress(InputError):
                    other = self._raster(x, y, metres, hexagonal)
                    if found is None or other.filled > found.filled:
                        found = replace(other, unlike_head=_unlike(metres, hexagonal, head))
                        steps = metres
        if found is None or steps is None:
            raise reason
        return self._counted(found, steps, head)

    def _counted(self, found: Grid, steps: tuple[float, float], head: Head) -> Grid:
        """Compare the numbers of columns and rows with the head.

        A map that was thinned has fewer of both and still has the same extent.
        """
        if head.shape is None or head.shape == found.shape:
            return found
        shown, asked = (" x ".join(map(str, shape)) for shape in (found.shape, head.shape))
        thinned = head.steps is not None and all(
            abs(count * step - asked_count * asked_step) < (1.0 - ON_GRID) * step
            for count, step, asked_count, asked_step in zip(
                found.shape, steps, head.shape, head.steps, strict=True
            )
        )
        if not thinned:
            raise self.refused(
                f"{head.keys} = {asked} points, the file has {shown}; export the whole map, or "
                "correct the head if the map was cut out of a larger one"
            )
        told = f"{shown} by the points, not {asked} as in the head"
        return replace(found, unlike_head=found.unlike_head | {"cells": told})

    def _raster(
        self, x: FloatArray, y: FloatArray, steps: tuple[float, float], hexagonal: bool
    ) -> Grid:
        """Return the grid with the point of each pixel.

        A point of a hexagonal grid has two neighbouring pixels, so that each second row begins half
        a step aside and each point has its six neighbours. Remaining pixels at both ends of a row
        belong to the last point of the row.
        """
        shift = np.zeros(2)
        if hexagonal:
            near = np.abs(y - y.min()) < 0.5e6 * steps[1]
            late = near.any() and x[near].min() - x.min() > 0.25e6 * steps[0]
            shift = np.array([0.5, 0.0]) if late else np.array([0.0, 0.5])
        columns, rows = self._places(x, y, steps, shift)
        raster = np.full((rows.max() + 1, columns.max() + 1), -1)
        raster[rows, columns] = np.arange(len(x))
        # rows that begin half a step later may have a point less
        there = np.ones(raster.shape, dtype=bool)
        for odd in (0, 1) if hexagonal else ():
            there[odd::2, -1] = columns[rows % 2 == odd].max(initial=0) == columns.max()
        gaps = (raster < 0) & there
        raster[gaps] = len(x) + np.arange(np.count_nonzero(gaps))
        shape, missing = (raster.shape[1], raster.shape[0]), int(np.count_nonzero(gaps))
        if not hexagonal:
            return Grid(raster, steps, shape, missing)
        pixels = np.full((shape[1], 2 * shape[0] + 1), -1)
        for odd in (0, 1):
            first = int(2.0 * shift[odd])
            pixels[odd::2, first : first + 2 * shape[0]] = np.repeat(raster[odd::2], 2, axis=1)
        pixels = pixels[:, (pixels >= 0).any(axis=0)]
        for end, step in ((0, 1), (-1, -1)):
            inner = end + step
            pixels[:, end] = np.where(pixels[:, end] < 0, pixels[:, inner], pixels[:, end])
        return Grid(pixels, (0.5 * steps[0], steps[1]), shape, missing)
