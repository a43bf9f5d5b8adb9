# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture networks: sets of traces with random positions, lengths and angles. SI units, degrees.

Centres are a Poisson process (D70). Traces are generated in a window that is larger than the
specimen by the longest trace, so that the density at its edge is the same as in an infinite rock,
and clipped to it. Random numbers come from numpy's PCG64, with a separate stream for each set by
its name.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import stats

from ..arrays import FloatArray
from ..errors import InputError
from ..files import Table, load_toml
from ..require import Bounds, require_known, require_number, require_table, require_whole
from .laws import law_of, table_of
from .lines import Lines, check_name
from .trace_angles import ANGLES, Angles
from .trace_lengths import LENGTHS, Lengths
from .window import Window

#: Most traces that may be expected in the larger window.
MOST_TRACES = 20_000
#: Keeps the draw of networks apart from other draws with the same seed.
_STREAM = 70
#: Seeds of networks.
SEED = Bounds(at_least=0, at_most=2**64 - 1)
#: Intensities P21 [1/m].
_INTENSITY = Bounds(above=0.0, at_least=1e-6, at_most=1e9)
_KEYS = ("intensity", "length", "orientation")


@dataclass(frozen=True)
class TraceSet:
    """Traces of one joint.

    Attributes:
        intensity: P21, the length of traces over the area that they lie in [1/m].
        length: Law of their lengths.
        orientation: Law of their angles.
    """

    intensity: float
    length: Lengths
    orientation: Angles

    def expected(self, window: Window) -> float:
        """Return the mean number of traces in the window enlarged by the longest trace."""
        density = self.intensity / self.length.expected
        return density * window.larger_area(self.length.longest)

    def draw(self, window: Window, generator: np.random.Generator) -> FloatArray:
        """Generate traces, ends (n, 2, 2) [m], before they are clipped."""
        count = int(stats.poisson(self.expected(window)).rvs(random_state=generator))
        places = window.places(generator, count, self.length.longest)
        halves = 0.5 * self.length.draw(generator, count)
        angles = np.radians(self.orientation.draw(generator, count))
        way = halves[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
        return np.stack((places - way, places + way), axis=1)


@dataclass(frozen=True)
class Network:
    """A fracture network.

    Attributes:
        seed: The same seed generates the same traces.
        sets: Sets of traces by the name of their joint, cut in this order.
    """

    seed: int
    sets: dict[str, TraceSet]

    @classmethod
    def read(cls, path: Path | str, seed: int | None = None) -> Network:
        """Read a TOML file; a seed that is given replaces the seed of the file.

        Raises:
            InputError: if it cannot be read, or as for ``of``.
        """
        return cls.of(load_toml(Path(path), "network"), seed)

    @classmethod
    def of(cls, given: object, seed: int | None = None) -> Network:
        """Check a network: a table as in a file, or an existing network.

        Args:
            given: ``seed`` (default: 1), and under ``set`` for each joint its ``intensity``
                and tables ``length`` and ``orientation``.
            seed: Replaces the seed of the table.

        Raises:
            InputError: for a key that is unknown or missing, or a value out of range.
        """
        table = given.to_json() if isinstance(given, Network) else require_table("network", given)
        for key in table:
            require_known("network key", key, ("seed", "set"))
        chosen = table.get("seed", 1) if seed is None else seed
        sets = require_table("network set", table.get("set", {}))
        if not sets:
            raise InputError(
                "network set = {}, must have a table [set.NAME] for each joint; add one"
            )
        found = {}
        for name, one in sets.items():
            check_name(name, "network set")
            found[name] = _set_of(f"network set {name}:", one)
        return cls(require_whole("network seed", chosen, SEED), found)

    def to_json(self) -> Table:
        """The table that ``of`` reads."""
        sets = {
            name: {
                "intensity": one.intensity,
                "length": table_of(one.length, LENGTHS),
                "orientation": table_of(one.orientation, ANGLES),
            }
            for name, one in self.sets.items()
        }
        return {"seed": self.seed, "set": sets}

    def with_seed(self, seed: int) -> Network:
        """Return the same network with another seed."""
        return dataclasses.replace(self, seed=require_whole("network seed", seed, SEED))

    def traces(self, window: Window) -> dict[str, FloatArray]:
        """Generate the traces of each set, ends (n, 2, 2) [m], before they are clipped.

        Raises:
            InputError: if more than 20 000 are expected.
        """
        expected = {name: one.expected(window) for name, one in self.sets.items()}
        if not sum(expected.values()) <= MOST_TRACES:
            name = max(expected, key=expected.__getitem__)
            one = self.sets[name]
            raise InputError(
                f"network set {name}: traces expected = {expected[name]:.4g} in a window larger by "
                f"{one.length.longest:.4g} m, must be <= {MOST_TRACES} in all sets; use a lower "
                "intensity, longer traces or a lower upper cut-off"
            )
        return {
            name: one.draw(window, generator_of(self.seed, name)) for name, one in self.sets.items()
        }

    def lines(self, window: Window) -> Lines:
        """Generate the traces and clip them; a set without a trace in the window has no lines.

        Raises:
            InputError: if more than 20 000 traces are expected, or no trace remains.
        """
        found: Lines = {}
        for name, ends in self.traces(window).items():
            clipped = window.clipped(ends).tolist()
            if clipped:
                found[name] = [[(x, y) for x, y in line] for line in clipped]
        if not found:
            raise InputError(
                f"network: traces in the specimen = 0 (seed {self.seed}), must be >= 1; use a "
                "higher intensity or another seed"
            )
        return found


def generator_of(seed: int, name: str) -> np.random.Generator:
    """Random numbers of a set, which do not depend on the other sets."""
    words = [_STREAM, seed, *name.encode()]
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(words)))


def _set_of(where: str, given: object) -> TraceSet:
    table = require_table(where.rstrip(":"), given)
    for key in table:
        require_known(f"{where} key", key, _KEYS)
    for key in _KEYS:
        if key not in table:
            raise InputError(f"{where} {key} is missing; give {', '.join(_KEYS)}")
    return TraceSet(
        require_number(f"{where} intensity", table["intensity"], _INTENSITY, "1/m"),
        law_of(f"{where} length", table["length"], LENGTHS),
        law_of(f"{where} orientation", table["orientation"], ANGLES),
    )
