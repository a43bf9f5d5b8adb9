# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows in which traces of joints are drawn and clipped. Lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray

#: Share of the window's size below which what is left of a trace is round-off [-].
_NOTHING = 1e-9


@dataclass(frozen=True)
class Window:
    """A box, or the circle in it.

    Attributes:
        low: Lower left corner [m].
        high: Upper right corner [m].
        round: Whether it is the circle that touches the box's sides.
    """

    low: tuple[float, float]
    high: tuple[float, float]
    round: bool = False

    @classmethod
    def circle(cls, x: float, y: float, radius: float) -> Window:
        """A circle [m]."""
        return cls((x - radius, y - radius), (x + radius, y + radius), round=True)

    @classmethod
    def about(cls, corners: Sequence[Sequence[float]] | FloatArray) -> Window:
        """The box about points, rows x, y [m]."""
        (x0, y0), (x1, y1) = np.min(corners, axis=0), np.max(corners, axis=0)
        return cls((float(x0), float(y0)), (float(x1), float(y1)))

    @property
    def area(self) -> float:
        """Area [m2]."""
        box = math.prod(self._sides)
        return 0.25 * math.pi * box if self.round else box

    def larger_area(self, length: float) -> float:
        """Area of the box, wider and higher by a length [m2]."""
        return math.prod(side + length for side in self._sides)

    def places(self, generator: np.random.Generator, count: int, length: float) -> FloatArray:
        """Draw places (count, 2) [m], uniform in the box, wider and higher by a length [m]."""
        half = 0.5 * length
        low, high = np.subtract(self.low, half), np.add(self.high, half)
        found: FloatArray = generator.uniform(low, high, (count, 2))
        return found

    def clipped(self, ends: FloatArray) -> FloatArray:
        """Return the parts of segments within the window.

        Args:
            ends: Both ends of each, (n, 2, 2) [m].

        Returns:
            Ends of the remaining parts, in the order of the segments.
        """
        start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
        first, last = (self._in_circle if self.round else self._in_box)(start, way)
        first, last = np.maximum(first, 0.0), np.minimum(last, 1.0)
        least = _NOTHING * math.hypot(*self._sides)
        left = (last - first) * np.hypot(way[:, 0], way[:, 1]) > least
        kept: FloatArray = ends[left].copy()
        for end, share, whole in ((0, first, 0.0), (1, last, 1.0)):
            cut = share[left] != whole
            places = start[left][cut] + share[left][cut, None] * way[left][cut]
            kept[cut, end] = np.clip(places, self.low, self.high)
        return kept

    @property
    def _sides(self) -> tuple[float, float]:
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    def _in_box(self, start: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Shares of the way at which lines enter the box and leave it; none: they leave before."""
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.stack(((self.low - start) / way, (self.high - start) / way))
        beside = (start < self.low) | (start > self.high)
        never = np.where(beside, np.inf, -np.inf)  # of lines along a side, which go on for ever
        first = np.where(way == 0.0, never, ends.min(axis=0)).max(axis=1)
        last = np.where(way == 0.0, -never, ends.max(axis=0)).min(axis=1)
        return first, last

    def _in_circle(self, start: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same of the circle."""
        radius = 0.5 * self._sides[0]
        off = start - np.add(self.low, radius)
        square = np.sum(way * way, axis=1)
        middle = -np.sum(off * way, axis=1) / square
        near = off + middle[:, None] * way
        room = (radius * radius - np.sum(near * near, axis=1)) / square
        half = np.sqrt(np.maximum(room, 0.0))
        return middle - half, middle + half
