# SPDX-License-Identifier: GPL-3.0-or-later
"""Cracks: contact points that have lost their bond, and their table. SI units.

The table also names the points of bonds that a script has erased, which are no cracks.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from enum import IntEnum
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import csv_text, load_csv
from .heights import with_heights, without_heights
from .record import Curve
from .snapshot import numbers_within
from .solids.state import AnySnapshot


class CrackMode(IntEnum):
    """Way in which a point has lost its bond; its number stands in states and their files."""

    TENSILE = 1
    SHEAR = 2
    ERASED = 3  #: by a script, which is no crack

    @property
    def word(self) -> str:
        """Word for it in tables and pages."""
        return self.name.lower()


TENSILE, SHEAR, ERASED = CrackMode
#: Name of each mode of a crack.
MODES: dict[int, str] = {mode: mode.word for mode in (TENSILE, SHEAR)}
#: The same of all that the table has.
NAMES: dict[int, str] = {mode: mode.word for mode in CrackMode}


class Crack(NamedTuple):
    """One contact point that has lost its bond."""

    step: int
    strain: float  #: axial strain when it broke [-]
    x: float  #: position when it broke [m]
    y: float  #: [m]
    mode: int  #: TENSILE if the point was opening, else SHEAR; ERASED if a script erased it
    contact: int  #: number of the contact, as in each snapshot
    point: int  #: index of the point in its contact
    energy: float = math.nan  #: that damage took until then [J]; nan where that is not known
    pair: str = ""  #: minerals of both grains, with a slash between; empty if all are alike

    @property
    def z(self) -> None:
        """None: it has no height in the plane."""


class SolidCrack(NamedTuple):
    """The same in a solid."""

    step: int
    strain: float
    x: float
    y: float
    mode: int
    contact: int
    point: int
    energy: float
    pair: str
    z: float  #: height when it broke [m]


#: A crack in the plane or in space.
AnyCrack = Crack | SolidCrack


#: Columns of a table of cracks of grains that are alike, and of several minerals.
_COLUMNS, _WITH_PAIRS = Crack._fields[:-1], Crack._fields


def cracks_csv(cracks: Sequence[AnyCrack]) -> str:
    """Cracks as CSV text in the order given; numbers read back unchanged.

    The column ``pair`` is there if grains are of several minerals.
    """
    width = len(_COLUMNS) + any(one.pair for one in cracks)
    rows = (
        (
            *(int(one.step), *map(float, one[1:4])),
            *(NAMES[one.mode], one.contact, one.point, float(one.energy), one.pair),
        )[:width]
        for one in cracks
    )
    return csv_text(*with_heights(Crack._fields[:width], rows, [one.z for one in cracks]))


def read_cracks(path: Path) -> list[AnyCrack]:
    """Read the output of ``cracks_csv``; energies that an older flexpm did not write are nan.

    Raises:
        InputError: if the file cannot be read or holds no cracks.
    """
    read, lines = load_csv(path, "cracks")
    modes = {name: mode for mode, name in NAMES.items()}
    try:
        names, rows, heights = without_heights(read, lines)
        if tuple(names) not in (_WITH_PAIRS, _COLUMNS, _COLUMNS[:-1]):
            raise ValueError(f"columns {', '.join(names)}")
        found = [
            Crack(
                *(int(step), float(strain), float(x), float(y)),
                *(modes[mode], int(at), int(point)),
                float(others[0]) if others else math.nan,
                "".join(others[1:]),
            )
            for step, strain, x, y, mode, at, point, *others in rows
        ]
        return _at_heights(found, heights)
    except (ValueError, KeyError) as error:
        raise InputError(
            f"cracks = {str(path)!r}, is not a table of cracks: {error}; give cracks.csv of a run"
        ) from None


def count_by_pair(cracks: Sequence[AnyCrack]) -> dict[str, dict[str, int]] | None:
    """Cracked points of each pair of minerals by mode; None if all grains are alike."""
    found: dict[str, dict[str, int]] = {}
    for one in cracks:
        if one.pair and one.mode in MODES:
            counts = found.setdefault(one.pair, dict.fromkeys(MODES.values(), 0))
            counts[MODES[one.mode]] += 1
    return dict(sorted(found.items())) or None


def count_softened_by_pair(
    snapshot: AnySnapshot, cracks: Sequence[AnyCrack], minerals: Sequence[str]
) -> dict[str, int] | None:
    """Points of each pair of minerals that have begun to soften; None if all grains are alike.

    Cracked points are included. A point is softening if its damage lies between 0 and 1.

    Args:
        snapshot: The state.
        cracks: Cracks in this state.
        minerals: Names of the minerals, if grains differ.
    """
    softening = (snapshot.point_damage > 0.0) & (snapshot.point_damage < 1.0)
    rows = snapshot.point_contact[softening & (snapshot.crack_mode == 0)]
    pairs = _pairs(snapshot, minerals, len(snapshot.contact))
    found = Counter(pairs[row] for row in rows.tolist())
    found.update(one.pair for one in cracks if one.mode in MODES)
    return dict(sorted((pair, count) for pair, count in found.items() if pair)) or None


def cracks_from_snapshot(
    snapshot: AnySnapshot, curve: Curve, minerals: Sequence[str] = ()
) -> list[AnyCrack]:
    """Return the cracks of a snapshot in the order of their steps; strains are from `curve`.

    Cracks of erased bonds are included, and the erased points of these bonds.

    Args:
        snapshot: The state.
        curve: Record of its test.
        minerals: Their names, if grains differ.
    """
    numbers, rows, points, steps, modes, places, energies = _records(snapshot)
    pairs = _pairs(snapshot, minerals, len(numbers))
    cracked = np.flatnonzero(steps >= 0)
    order = cracked[np.lexsort((points[cracked], numbers[rows[cracked]], steps[cracked]))]
    rows, points, steps = rows[order], points[order], steps[order]
    strains = (
        np.interp(steps, curve["step"], curve["axial_strain"])
        if len(curve)
        else np.full(len(steps), np.nan)
    )
    places = places[order]
    heights = places[:, 2].tolist() if places.shape[1] > 2 else [None] * len(places)
    found = [
        Crack(*one)
        for one in zip(
            steps.tolist(),
            strains.tolist(),
            *places[:, :2].T.tolist(),
            modes[order].tolist(),
            numbers[rows].tolist(),
            points.tolist(),
            energies[order].tolist(),
            [pairs[row] for row in rows],
            strict=True,
        )
    ]
    return _at_heights(found, heights)


def _at_heights(found: list[Crack], heights: Sequence[float | None]) -> list[AnyCrack]:
    """Cracks of the plane, or of a solid if their heights are known."""
    return [
        one if height is None else SolidCrack(*one, height)
        for one, height in zip(found, heights, strict=True)
    ]


def _pairs(snapshot: AnySnapshot, minerals: Sequence[str], count: int) -> list[str]:
    """Names of both minerals of each bond with a record, in the order of ``_records``."""
    if not minerals or snapshot.grain_mineral is None:
        return [""] * count
    grains = snapshot.contact_grains
    if snapshot.erased_grains is not None:
        grains = np.concatenate([grains, snapshot.erased_grains])
    kinds = snapshot.grain_mineral[grains].tolist()
    return ["/".join(sorted(minerals[kind] for kind in pair)) for pair in kinds]


class _Records(NamedTuple):
    """Bonds with a record, and their points: row of the bond, number in it, and its crack."""

    numbers: IntArray
    rows: IntArray
    points: IntArray
    steps: IntArray
    modes: IntArray
    places: FloatArray
    energies: FloatArray


def _records(snapshot: AnySnapshot) -> _Records:
    """All bonds, those that exist before those that are erased."""
    exist = _Records(
        snapshot.contact,
        snapshot.point_contact,
        snapshot.point_number,
        snapshot.crack_step,
        snapshot.crack_mode,
        snapshot.crack_position,
        _energies(snapshot.crack_energy, snapshot.crack_step),
    )
    if (
        snapshot.erased_contact is None
        or snapshot.erased_point_bond is None
        or snapshot.erased_crack_step is None
        or snapshot.erased_crack_mode is None
        or snapshot.erased_crack_position is None
    ):
        return exist
    erased = _Records(
        snapshot.erased_contact,
        snapshot.erased_point_bond + len(snapshot.contact),
        numbers_within(snapshot.erased_point_bond),
        snapshot.erased_crack_step,
        snapshot.erased_crack_mode,
        snapshot.erased_crack_position,
        _energies(snapshot.erased_crack_energy, snapshot.erased_crack_step),
    )
    return _Records(*(np.concatenate(both) for both in zip(exist, erased, strict=True)))


def _energies(known: FloatArray | None, steps: IntArray) -> FloatArray:
    return np.full(steps.shape, np.nan) if known is None else known
