# SPDX-License-Identifier: GPL-3.0-or-later
"""Acoustic emission: points that crack close in time and space are one event. SI units.

Deviation D41 defines an event. Deviation D42: its magnitude, from the energy that damage
took, by Gutenberg and Richter: log10 E = 1.5 M + 4.8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph
from scipy.spatial import cKDTree

from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import csv_text, load_csv
from .cracks import MODES, SHEAR, TENSILE, AnyCrack
from .heights import with_heights, without_heights

#: Speed at which a fracture runs over that of a compressional wave [-].
_RUPTURE_SPEED = 0.5
#: Places further off, of what a diverged run has flung away, have no squares [m].
_FAR = 1e100
#: Magnitudes are counted in bins of this width [-].
BIN = 0.1
#: Fewest events from the magnitude of completeness on that give a b value.
FEWEST = 50
#: Bins by which the fit begins later, to see whether it stays where it is.
_LATER = 3
#: It does within this multiple of the error of its move, as 19 of 20 exponentials do.
_MOVES = 2.0
#: ... or within this part of b: some events are missing from the most frequent magnitude on.
_BENDS = 0.1


class EventRule(NamedTuple):
    """Limits within which two cracked points belong to one event; both must hold."""

    distance: float  #: between their places [m]
    steps: float  #: between their times


class Event(NamedTuple):
    """Points that have cracked together."""

    step: int  #: of its first crack
    strain: float  #: axial strain then [-]
    x: float  #: centre, weighted by energy [m]
    y: float  #: [m]
    points: int  #: that have cracked
    mode: int  #: TENSILE or SHEAR: that which took more energy
    energy: float  #: that damage took [J]
    magnitude: float  #: nan without energy [-]

    @property
    def z(self) -> None:
        """None: it has no height in the plane."""


class SolidEvent(NamedTuple):
    """The same in a solid."""

    step: int
    strain: float
    x: float
    y: float
    points: int
    mode: int
    energy: float
    magnitude: float
    z: float  #: height of the centre [m]


#: An event in the plane or in space.
AnyEvent = Event | SolidEvent


class Fit(NamedTuple):
    """A line through the numbers of events over their magnitude."""

    least: float  #: magnitude from which on they are counted [-]
    number: int  #: of events from there on
    b_value: float  #: decades of number for one of magnitude [-]
    b_error: float  #: standard error [-]


class Frequencies(NamedTuple):
    """How many events there are of each magnitude; None without enough events, or a line."""

    completeness: float | None  #: magnitude from which on they are counted: the most frequent [-]
    b_value: float | None  #: decades of number for one of magnitude [-]
    b_error: float | None  #: standard error [-]


def event_rule(mean_diameter: float, height: float, crossing_steps: float) -> EventRule:
    """Limits of an event: one mean grain, and the time that a fracture needs to cross it.

    Args:
        mean_diameter: Mean diameter of the grains [m].
        height: Height of the specimen [m].
        crossing_steps: Steps in which a wave crosses the height.
    """
    steps = mean_diameter / height * crossing_steps / _RUPTURE_SPEED
    return EventRule(mean_diameter, steps)


def find_events(cracks: Sequence[AnyCrack], rule: EventRule) -> list[AnyEvent]:
    """Return the events of cracked points, in the order of their first cracks.

    A point belongs to an event if it has cracked close to any point of the event. Points that
    scripts have erased do not count as cracked.
    """
    kept = [one for one in cracks if one.mode in MODES and math.isfinite(one.x + one.y)]
    if not kept:
        return []
    table = np.array([one[:8] for one in kept], dtype=float)  # all but the names of minerals
    steps, strains, modes, energies = table[:, 0], table[:, 1], table[:, 4], table[:, 7]
    places = table[:, 2:4]
    if heights := [one.z for one in kept if one.z is not None]:
        places = np.column_stack((places, heights))
    near = np.clip(places, -_FAR, _FAR)
    pairs = cKDTree(near).query_pairs(rule.distance, output_type="ndarray")
    apart = np.abs(steps[pairs[:, 0]] - steps[pairs[:, 1]])
    pairs = pairs[apart <= rule.steps]
    graph = sparse.coo_matrix(
        (np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(kept), len(kept))
    )
    count, labels = csgraph.connected_components(graph, directed=False)
    first = np.full(count, len(kept))
    np.minimum.at(first, labels, np.arange(len(kept)))
    points = np.bincount(labels)
    energy = np.bincount(labels, energies).astype(float, copy=False)
    by_shear = np.bincount(labels, np.where(modes == SHEAR, energies, 0.0))
    weights = np.where(energy[labels] > 0.0, energies, 1.0)
    centres = [
        np.bincount(labels, weights * values) / np.bincount(labels, weights) for values in places.T
    ]
    order = np.argsort(first)
    found = [
        Event(int(steps[first[k]]), float(strains[first[k]]), x, y, n, mode, taken, magnitude)
        for k, x, y, n, mode, taken, magnitude in zip(
            order.tolist(),
            *(values[order].tolist() for values in (*centres[:2], points)),
            np.where(by_shear > 0.5 * energy, SHEAR, TENSILE)[order].tolist(),
            energy[order].tolist(),
            magnitudes_of(energy[order]).tolist(),
            strict=True,
        )
    ]
    known = centres[2][order].tolist() if len(centres) > 2 else [None] * count
    return _with_heights(found, known)


def _with_heights(found: list[Event], heights: Sequence[float | None]) -> list[AnyEvent]:
    """Events of the plane, or of a solid if their heights are known."""
    return [
        one if height is None else SolidEvent(*one, height)
        for one, height in zip(found, heights, strict=True)
    ]


def magnitudes_of(energies: FloatArray) -> FloatArray:
    """Magnitudes [-] of energies [J]; nan where there is none."""
    known = np.where(energies > 0.0, energies, np.nan)
    found: FloatArray = (np.log10(known) - 4.8) / 1.5
    return found


def frequencies(magnitudes: FloatArray) -> Frequencies:
    """Magnitude of completeness and b value of events.

    Completeness by maximum curvature: the bin with most events. No b value for numbers that follow
    no line: b from 0.3 above it differs by more than twice the error of that difference and 10 %.
    """
    bins = binned(magnitudes)
    if len(bins) == 0:
        return Frequencies(None, None, None)
    found = fits(magnitudes)
    if not found or found[0].number < FEWEST or not _is_line(found):
        return Frequencies(BIN * _most_frequent(bins), None, None)
    return Frequencies(found[0].least, found[0].b_value, found[0].b_error)


def fits(magnitudes: FloatArray) -> list[Fit]:
    """Lines from the magnitude of completeness on, and from 0.3 above it, where there are any.

    By maximum likelihood for magnitudes in bins (Bender 1983), which is Aki's with Utsu's
    correction for narrow bins; their error by Shi and Bolt (1982).
    """
    bins, found = binned(magnitudes), []
    for later in (0, _LATER) if len(bins) else ():
        least = _most_frequent(bins) + later
        above = BIN * (bins[bins >= least] - least)
        number, mean = len(above), float(above.mean()) if len(above) else 0.0
        if number < 2 or mean == 0.0:
            break
        b = math.log10(1.0 + BIN / mean) / BIN
        variance = float(np.sum((above - mean) ** 2)) / (number * (number - 1))
        found.append(Fit(BIN * least, number, b, math.log(10.0) * b * b * math.sqrt(variance)))
    return found


def _most_frequent(bins: IntArray) -> int:
    return int(bins.min()) + int(np.argmax(np.bincount(bins - bins.min())))


def _is_line(found: Sequence[Fit]) -> bool:
    """Return whether the second fit, to a part of the events, agrees with the first fit."""
    if len(found) < 2:
        return True
    first, later = found
    variance = max(later.b_error**2 - first.b_error**2, 0.0)
    allowed = max(_MOVES * math.sqrt(variance), _BENDS * first.b_value)
    return abs(later.b_value - first.b_value) <= allowed


def binned(magnitudes: FloatArray) -> IntArray:
    """Bin of each magnitude that is known, as a multiple of `BIN`."""
    known = magnitudes[np.isfinite(magnitudes)]
    found: IntArray = np.rint(known / BIN).astype(int)
    return found


def events_csv(events: Sequence[AnyEvent]) -> str:
    """Events as CSV text in the order given; numbers read back unchanged."""
    rows = ((*one[:5], MODES[one.mode], *one[6:8]) for one in events)
    return csv_text(*with_heights(Event._fields, rows, [one.z for one in events]))


def read_events(path: Path) -> list[AnyEvent]:
    """Read the output of ``events_csv``.

    Raises:
        InputError: if the file cannot be read or holds no events.
    """
    read, lines = load_csv(path, "events")
    modes = {name: mode for mode, name in MODES.items()}
    try:
        names, rows, heights = without_heights(read, lines)
        if tuple(names) != Event._fields:
            raise ValueError(f"columns {', '.join(names)}")
        found = [
            Event(
                *(int(step), float(strain), float(x), float(y)),
                *(int(points), modes[mode], float(energy), float(magnitude)),
            )
            for step, strain, x, y, points, mode, energy, magnitude in rows
        ]
        return _with_heights(found, heights)
    except (ValueError, KeyError) as error:
        raise InputError(
            f"events = {str(path)!r}, is not a table of events: {error}; give events.csv of a run"
        ) from None
