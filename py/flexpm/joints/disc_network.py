# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture networks of 3D specimens: sets of discs and of parallel planes. SI units, degrees.

Centres of discs are a Poisson process (D70, D107) in the box around the specimen, enlarged by the
largest radius. Random numbers come from numpy's PCG64, with a separate stream for each set by its
name.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import stats

from ..arrays import FloatArray
from ..errors import InputError
from ..files import Table, load_toml
from ..require import (
    LENGTH,
    Bounds,
    quoted,
    require_known,
    require_number,
    require_table,
    require_whole,
)
from .disc_radii import RADII, Radii
from .laws import law_of, table_of
from .lines import check_name
from .network import SEED, generator_of
from .planes import (
    DIP,
    DIRECTION,
    FARTHEST,
    MOST_PLANES,
    JointPlane,
    Vector,
    disc,
    normal_of,
    plane,
)
from .poles import POLES, Poles

#: Intensities P32 [1/m].
_INTENSITY = Bounds(above=0.0, at_least=1e-6, at_most=1e9)
_NUMBER = Bounds(at_least=1, at_most=MOST_PLANES)
_COORDINATE = Bounds(at_least=-FARTHEST, at_most=FARTHEST)
#: Room around the box of a specimen, over its sizes: a prism reaches beyond its cylinder [-].
_BEYOND = 0.05


@dataclass(frozen=True)
class Box:
    """Box around a specimen.

    Attributes:
        low: Lower corner [m].
        high: Upper corner [m].
    """

    low: Vector
    high: Vector

    def larger(self, by: float) -> tuple[FloatArray, FloatArray]:
        """Corners of the box with room for prisms, larger on all sides by a length [m]."""
        low, high = np.array(self.low), np.array(self.high)
        room = _BEYOND * (high - low) + by
        return low - room, high + room


class PlaneSet(ABC):
    """Planes or discs of one joint."""

    @abstractmethod
    def expected(self, box: Box) -> float:
        """Mean number of planes."""

    @abstractmethod
    def draw(self, name: str, box: Box, generator: np.random.Generator) -> list[JointPlane]:
        """Generate the planes that may meet the specimen."""

    @abstractmethod
    def to_json(self) -> Table:
        """The table that makes the set."""


@dataclass(frozen=True)
class Discs(PlaneSet):
    """Discs with random places, radii and poles.

    Attributes:
        radius: Law of their radii.
        orientation: Law of their poles.
        intensity: P32, the area of discs over the volume that they lie in [1/m]; None: a number.
        number: Number of discs whose centres are in the box of the specimen; None: an intensity.
    """

    radius: Radii
    orientation: Poles
    intensity: float | None = None
    number: int | None = None

    def expected(self, box: Box) -> float:
        """Mean number of discs."""
        if self.intensity is None:
            assert self.number is not None
            return float(self.number)
        low, high = box.larger(self.radius.longest)
        return self.intensity * float(np.prod(high - low)) / (math.pi * self.radius.mean_square)

    def draw(self, name: str, box: Box, generator: np.random.Generator) -> list[JointPlane]:
        """Generate the discs that may meet the specimen."""
        if self.number is not None:
            count, (low, high) = self.number, (np.array(box.low), np.array(box.high))
        else:
            count = int(stats.poisson(self.expected(box)).rvs(random_state=generator))
            low, high = box.larger(self.radius.longest)
        centres = generator.uniform(low, high, (count, 3))
        radii = self.radius.draw(generator, count)
        poles = self.orientation.draw(generator, count)
        # half of the extent of a disc along each axis
        reach = radii[:, None] * np.sqrt(np.maximum(1.0 - poles * poles, 0.0))
        low, high = box.larger(0.0)
        meets = np.all((centres + reach >= low) & (centres - reach <= high), axis=1)
        rows = zip(centres[meets], poles[meets], radii[meets], strict=True)
        return [
            disc(name, _vector(centre), _vector(pole), float(radius))
            for centre, pole, radius in rows
        ]

    def to_json(self) -> Table:
        """The table that makes the set."""
        amount = {"intensity": self.intensity, "number": self.number}
        return {
            "kind": "discs",
            **{key: value for key, value in amount.items() if value is not None},
            "radius": table_of(self.radius, RADII),
            "orientation": table_of(self.orientation, POLES),
        }


@dataclass(frozen=True)
class Planes(PlaneSet):
    """Parallel planes at equal distances, for bedding.

    Attributes:
        dip: Dip [degree].
        dip_direction: Dip direction, clockwise from y [degree].
        spacing: Distance of neighbouring planes [m].
        origin: Point of one of the planes [m].
    """

    dip: float
    dip_direction: float
    spacing: float
    origin: Vector

    def _numbers(self, box: Box) -> tuple[int, int]:
        """Numbers of the first and the last plane that meet the box."""
        normal = np.array(normal_of(self.dip, self.dip_direction))
        low, high = np.array(box.low) - self.origin, np.array(box.high) - self.origin
        middle, half = 0.5 * (low + high) @ normal, 0.5 * (high - low) @ np.abs(normal)
        first, last = (middle - half) / self.spacing, (middle + half) / self.spacing
        if not max(abs(first), abs(last)) < 1e9:  # numbers lose their digits, or are too many
            return 0, 10**9
        return math.ceil(first), math.floor(last)

    def expected(self, box: Box) -> float:
        """Number of planes."""
        first, last = self._numbers(box)
        return float(last - first + 1)

    def draw(self, name: str, box: Box, generator: np.random.Generator) -> list[JointPlane]:
        """Return the planes that meet the box."""
        normal = normal_of(self.dip, self.dip_direction)
        first, last = self._numbers(box)
        places = [
            _vector(o + k * self.spacing * n for o, n in zip(self.origin, normal, strict=True))
            for k in range(first, last + 1)
        ]
        return [plane(name, place, self.dip, self.dip_direction) for place in places]

    def to_json(self) -> Table:
        """The table that makes the set."""
        return {
            "kind": "planes",
            "dip": self.dip,
            "dip_direction": self.dip_direction,
            "spacing": self.spacing,
            "origin": list(self.origin),
        }


@dataclass(frozen=True)
class DiscNetwork:
    """A fracture network of a 3D specimen.

    Attributes:
        seed: The same seed generates the same planes.
        sets: Sets by the name of their joint, cut in this order.
    """

    seed: int
    sets: dict[str, PlaneSet]

    @classmethod
    def read(cls, path: Path | str, seed: int | None = None) -> DiscNetwork:
        """Read a TOML file; a seed that is given replaces the seed of the file.

        Raises:
            InputError: if it cannot be read, or as for ``of``.
        """
        return cls.of(load_toml(Path(path), "network"), seed)

    @classmethod
    def of(cls, given: object, seed: int | None = None) -> DiscNetwork:
        """Check a network: a table as in a file, or an existing network.

        Raises:
            InputError: for a key that is unknown or missing, or a value out of range.
        """
        if isinstance(given, DiscNetwork):
            given = given.to_json()
        table = require_table("network", given)
        for key in table:
            require_known("network key", key, ("seed", "set"))
        sets = require_table("network set", table.get("set", {}))
        if not sets:
            raise InputError(
                "network set = {}, must have a table [set.NAME] for each joint; add one"
            )
        found: dict[str, PlaneSet] = {}
        for name, one in sets.items():
            check_name(name, "network set")
            found[name] = _set_of(f"network set {name}:", one)
        chosen = table.get("seed", 1) if seed is None else seed
        return cls(require_whole("network seed", chosen, SEED), found)

    def to_json(self) -> Table:
        """The table that ``of`` reads."""
        return {
            "seed": self.seed,
            "set": {name: one.to_json() for name, one in self.sets.items()},
        }

    def planes(self, box: Box) -> list[JointPlane]:
        """Generate the planes and discs of all sets that may meet a specimen.

        Raises:
            InputError: if more than 20 000 are expected, or none is generated.
        """
        expected = {name: one.expected(box) for name, one in self.sets.items()}
        if not sum(expected.values()) <= MOST_PLANES:
            name = max(expected, key=expected.__getitem__)
            raise InputError(
                f"network set {name}: planes expected = {expected[name]:.4g}, must be <= "
                f"{MOST_PLANES} in all sets; use a lower intensity, larger discs, a lower upper "
                "cut-off or a wider spacing"
            )
        found = [
            one
            for name, made in self.sets.items()
            for one in made.draw(name, box, generator_of(self.seed, name))
        ]
        if not found:
            raise InputError(
                f"network: planes in the specimen = 0 (seed {self.seed}), must be >= 1; use a "
                "higher intensity or another seed"
            )
        return found


def _set_of(where: str, given: object) -> PlaneSet:
    table = require_table(where.rstrip(":"), given)
    kind = table.pop("kind", None)
    if kind not in ("discs", "planes"):
        raise InputError(
            f"{where} kind = {quoted(kind)}, must be discs or planes for a 3D specimen; choose one "
            "of them"
        )
    keys: tuple[str, ...] = ("dip", "dip_direction", "spacing", "origin")
    needed = keys
    if kind == "discs":
        amount = [key for key in ("intensity", "number") if key in table]
        if len(amount) != 1:
            raise InputError(
                f"{where} intensity and number = {len(amount)} given, must be one of them; give "
                "the P32 or the number of discs"
            )
        keys = ("intensity", "number", "radius", "orientation")
        needed = ("radius", "orientation")
    for key in table:
        require_known(f"{where} key", key, keys)
    for key in needed:
        if key not in table:
            raise InputError(f"{where} {key} is missing; give {', '.join(needed)}")
    return _discs(where, table) if kind == "discs" else _planes(where, table)


def _discs(where: str, table: Table) -> Discs:
    intensity, number = None, None
    if "intensity" in table:
        intensity = require_number(f"{where} intensity", table["intensity"], _INTENSITY, "1/m")
    else:
        number = require_whole(f"{where} number", table["number"], _NUMBER)
    return Discs(
        law_of(f"{where} radius", table["radius"], RADII),
        law_of(f"{where} orientation", table["orientation"], POLES),
        intensity,
        number,
    )


def _planes(where: str, table: Table) -> Planes:
    origin = table["origin"]
    if not isinstance(origin, list | tuple) or len(origin) != 3:
        raise InputError(
            f"{where} origin = {quoted(origin)} m, must be three numbers x, y, z; correct it"
        )
    return Planes(
        require_number(f"{where} dip", table["dip"], DIP, "degree"),
        require_number(f"{where} dip_direction", table["dip_direction"], DIRECTION, "degree"),
        require_number(f"{where} spacing", table["spacing"], LENGTH, "m"),
        _vector(require_number(f"{where} origin", one, _COORDINATE, "m") for one in origin),
    )


def _vector(values: object) -> Vector:
    x, y, z = (float(one) for one in values)  # type: ignore[attr-defined]
    return x, y, z
