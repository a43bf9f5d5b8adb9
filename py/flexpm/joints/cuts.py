# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints that cut, and lines that can cut nothing. Lengths in metres. No heavy imports."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass

from ..errors import InputError
from ..files import Table
from .lines import Lines, Point

#: Most segments in a specimen.
MOST_SEGMENTS = 20_000
#: Sizes of the specimen within which a point may lie: beyond, round-off shows in its place.
_FARTHEST = 1e6
#: Share of a length that is round-off.
_NOTHING = 1e-9


@dataclass(frozen=True)
class Cut:
    """Outcome of cutting the lines of a joint.

    Attributes:
        lines: Number of requested lines.
        idle: Number of lines that cut nothing.
        length: Length of all requested lines [m].
        cut: Length along which they have made contacts of the joint [m].
        taken: Length along contacts of an earlier joint [m].
        outside: Length outside of the specimen [m]. The remaining length ends within grains.
        on: The joint that has most of `taken`; None: nothing was taken.

    Up to a tenth of a grain of the cut length at the outline may count as remaining length.
    """

    lines: int
    idle: int
    length: float
    cut: float
    taken: float
    outside: float
    on: str | None = None

    @property
    def missing(self) -> float:
        """Length inside the specimen that is not cut [m]."""
        return max(self.length - self.outside - self.cut, 0.0)

    @property
    def reason(self) -> str:
        """Why not more of it is cut, by the largest part."""
        within = self.length - self.cut - self.taken - self.outside
        if self.taken > 0.0 and self.taken >= within:
            return f"lies on joint {self.on}, which was cut first"
        if within > _NOTHING * self.length:
            return "ends within grains"
        return "lies outside the specimen"

    def and_(self, more: Cut | None) -> Cut:
        """The same joint with more lines."""
        if more is None:
            return self
        sums = {key: getattr(self, key) + getattr(more, key) for key in _SUMS}
        return Cut(**sums, on=self.on if self.taken >= more.taken else more.on)

    def to_json(self) -> Table:
        """As plain values, with the reason."""
        return {**asdict(self), "reason": self.reason}

    @classmethod
    def from_json(cls, values: Table) -> Cut:
        """From plain values."""
        return cls(**{key: value for key, value in values.items() if key != "reason"})


_SUMS = ("lines", "idle", "length", "cut", "taken", "outside")


def require_within(lines: Lines, low: Point, high: Point) -> None:
    """Reject lines that cannot be cut: far from a specimen's box, or too many of them within it.

    Raises:
        InputError: for a point farther away than 1e6 sizes, or more than 20 000 segments.
    """
    size = math.hypot(high[0] - low[0], high[1] - low[1])
    inside = 0
    for name, given in lines.items():
        for number, line in enumerate(given):
            for x, y in line:
                if not math.hypot(x - low[0], y - low[1]) <= _FARTHEST * size:
                    raise InputError(
                        f"joint {name}: line {number} from {line[0]} m: point = ({x:.12g}, "
                        f"{y:.12g}) m, must lie within 1e6 sizes of the specimen; move it there"
                    )
            inside += sum(_meets(a, b, low, high) for a, b in itertools.pairwise(line))
    if inside > MOST_SEGMENTS:
        raise InputError(
            f"joints: segments in the specimen = {inside}, must be <= {MOST_SEGMENTS}; leave out "
            "or merge segments"
        )


def require_any(cuts: Mapping[str, Cut], lines: Lines, low: Point, high: Point) -> None:
    """Reject a set of lines of which no line cuts anything.

    Args:
        cuts: Outcome of the cuts.
        lines: The lines, by joint.
        low: Lower left corner of the specimen's box [m].
        high: Upper right corner [m].
    """
    if any(one.cut > 0.0 for one in cuts.values()):
        return
    places = [point for given in lines.values() for line in given for point in line]
    x, y = zip(*places, strict=True)
    first, one = next(iter(cuts.items()))
    raise InputError(
        f"joints: lines that cut a cell = 0 of {sum(one.lines for one in cuts.values())}, must be "
        f">= 1 (joint {first} {one.reason}); the lines extend from {_place((min(x), min(y)))} to "
        f"{_place((max(x), max(y)))}, the specimen from {_place(low)} to {_place(high)}: move or "
        "lengthen them"
    )


def _place(point: Point) -> str:
    return f"({point[0]:.6g}, {point[1]:.6g}) m"


def _meets(a: Point, b: Point, low: Point, high: Point) -> bool:
    """Whether the box of a segment meets another box."""
    return all(
        max(a[axis], b[axis]) >= low[axis] and min(a[axis], b[axis]) <= high[axis]
        for axis in (0, 1)
    )
