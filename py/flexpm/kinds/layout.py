# SPDX-License-Identifier: GPL-3.0-or-later
"""Layout of a specimen between parts, as plain data from which a rig adds the parts. SI units."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from .option import Value

if TYPE_CHECKING:
    from ..arrays import FloatArray

#: x and y.
Place = tuple[float, float]
#: Segments by their ends [m].
Lines = list[list[list[float]]]
#: Sides of a rectangle.
BOTTOM, RIGHT, TOP, LEFT = range(4)


@dataclass(frozen=True)
class Frame:
    """Input of a layout: box around the specimen, its sizes, and the options of the run."""

    left: float  #: [m]
    bottom: float
    right: float
    top: float
    thickness: float  #: [m]
    grain: float  #: mean diameter of the grains [m]
    values: Mapping[str, Value]  #: of the options, by name
    notch: FloatArray  #: ends (n, 2, 2) of the contacts that the notches have cut [m]
    tensile_strength: float  #: mean of the minerals [Pa]
    #: Least c + mu sigma_n of the rock and of the joints [Pa] at a normal stress [Pa].
    shear_strength: Callable[[float], float]

    @property
    def width(self) -> float:
        """Width of the box [m]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Height of the box [m]."""
        return self.top - self.bottom

    @property
    def middle(self) -> float:
        """Coordinate of the middle of the box along x [m]."""
        return 0.5 * (self.left + self.right)

    @property
    def notch_depth(self) -> float:
        """Depth of the notch as cut, from the bottom [m]; 0 without a notch. Deviation D35."""
        highest = float(self.notch[..., 1].max()) if len(self.notch) else self.bottom
        return max(highest, self.bottom) - self.bottom

    def number(self, name: str) -> float:
        """Return the value of a numeric option that has been determined."""
        value = self.values[name]
        assert isinstance(value, float | int), name
        return float(value)


@dataclass(frozen=True)
class Plate:
    """A plate on the outline: around a position, or along an entire side."""

    place: Place = (0.0, 0.0)  #: [m]
    normal: Place = (0.0, 0.0)  #: into the specimen
    length: float | None = None  #: along the outline [m]; None for that of a roller
    side: int | None = None  #: of the rectangle, for one along a whole side
    pinned: bool = False  #: it does not slide along the outline while it presses
    bonded: bool = False  #: it pulls, too


@dataclass(frozen=True)
class Opening:
    """Relative displacement of two points, a column of the record."""

    first: Place  #: [m]
    second: Place  #: [m]
    along: Place | None = None  #: direction; None: from the first to the second


@dataclass(frozen=True)
class Layout:
    """Parts in the order in which they are added, and the columns of the record from them."""

    plates: Mapping[str, Plate]
    driven: tuple[str, ...]
    direction: Place  #: of the driven ones
    against: tuple[str, ...]  #: they hold the specimen against the load
    area: float  #: load over the record's stress [m2]
    length: float  #: displacement over the record's strain [m]
    strength: float  #: that the specimen will bear, roughly [Pa]
    pressed: str = ""  #: the plate that a pressure acts on before the loading
    openings: Mapping[str, Opening] = field(default_factory=dict)
    ways: Mapping[str, tuple[str, Place]] = field(default_factory=dict)  #: of a plate, along
    also: Mapping[str, str] = field(default_factory=dict)  #: second names of columns
