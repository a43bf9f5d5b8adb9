# SPDX-License-Identifier: GPL-3.0-or-later
"""Mineral of each grain by a table, or by a second image or volume with the phase of each point."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...arrays import AnyArray, IntArray
from ...errors import InputError
from ...files import csv_rows, read_text
from ...require import quoted, require_name
from . import picture
from .majority import majority
from .picture import HOLE_NAME, Picture

SUFFIX = ".csv"
COLUMNS = ("id", "mineral")
#: Different phases of an image or a volume.
_MOST_PHASES = 100
#: Labels of volumes are whole numbers.
_WHOLE = Picture(np.zeros((0, 0), dtype=int))
#: Names of the minerals, and the index of each label's mineral; None for a hole.
Minerals = tuple[list[str], dict[int, int | None]]


def of_image(path: Path, image: Picture, phases: Path | None = None) -> Minerals:
    """Return the mineral of each label of an image.

    Args:
        path: A table, see `read`, or a second image of the same size. A grain has the phase that
            most of its pixels have in the second image.
        image: The image of grains.
        phases: TOML file with the mineral of each label or colour of the second image; None:
            minerals are called ``phase 1`` and so on, by the labels.

    Raises:
        InputError: for a file that cannot be read, an image of another size, or a label without a
            mineral.
    """
    ids, grains = np.unique(image.labels, return_inverse=True)
    if path.suffix.lower() == SUFFIX:
        if phases is not None:
            raise InputError(
                f"phases = {quoted(str(phases))}, must not be given with a table of minerals: the "
                "table has their names; leave one out"
            )
        return read(path, ids, image)
    second = picture.read(path)
    if second.labels.shape != image.labels.shape:
        raise InputError(
            f"minerals = {quoted(str(path))} of {_size(second.labels)}, must have "
            f"{_size(image.labels)} as the image of grains; give an image of the same section"
        )
    kinds, numbers = np.unique(second.labels, return_inverse=True)
    named = {one: f"phase {second.name_of(one)}" for one in kinds.tolist()}
    if phases is not None:
        named = picture.read_phases(phases, second)
    elif second.has_voids:
        named[0] = HOLE_NAME
    names, found = by_majority(str(path), ids, grains, kinds, numbers, named)
    return names, found | ({0: None} if image.has_voids else {})


def read(path: Path, ids: IntArray, image: Picture | None = None) -> Minerals:
    """Read a table of grains: CSV with the columns ``id`` and ``mineral``, and perhaps others.

    Args:
        path: The table. The order of the minerals is the order in which they appear.
        ids: Labels of the grains; each must have a row, and rows of other labels are not used.
        image: The image of the grains, if its labels may be colours.

    Raises:
        InputError: for a file that cannot be read, a broken row, and a label without a row.
    """
    name = f"minerals = {quoted(str(path))}"
    found: dict[int, str] = {}
    for line, key, mineral in _rows(name, path):
        where = f"{name}, line {line}"
        label = picture.label_of(f"{where}: id", key, image or _WHOLE)
        if found.setdefault(label, mineral) != mineral:
            raise InputError(
                f"{where}: id {key} = {quoted(mineral)}, was {quoted(found[label])} before, must "
                "have one mineral; remove a row"
            )
        require_name(f"{where}: mineral of id {key}", mineral)
    missing = [one for one in ids.tolist() if one not in found]
    if missing:
        shown = str(missing[0]) if image is None else image.name_of(missing[0])
        others = f"; so are {len(missing) - 1} others" if len(missing) > 1 else ""
        raise InputError(f"{name}: id {shown} of a grain is missing{others}; add a row for it")
    there = {*ids.tolist()}
    used = {label: mineral for label, mineral in found.items() if label in there}
    return _numbered(used)


def by_majority(
    source: str,
    ids: IntArray,
    grains: AnyArray,
    kinds: IntArray,
    numbers: AnyArray,
    named: Mapping[int, str],
) -> Minerals:
    """Return the mineral that most pixels or voxels of each label have.

    Of two minerals with equally many, the label has the one whose phase has the lower number.

    Args:
        source: The file of the phases, for messages.
        ids: Labels of the grains.
        grains: Index in `ids` of each pixel's or voxel's label.
        kinds: Numbers of the phases.
        numbers: Index in `kinds` of each pixel's or voxel's phase.
        named: Mineral, or ``hole``, of each phase.

    Raises:
        InputError: for too many phases.
    """
    if len(kinds) > _MOST_PHASES:
        raise InputError(
            f"minerals = {quoted(source)}: phases = {len(kinds)} different ones, must be <= "
            f"{_MOST_PHASES}; give an image or volume of phases"
        )
    names = list(dict.fromkeys(named[one] for one in kinds.tolist()))
    mineral_of = np.array([names.index(named[one]) for one in kinds.tolist()], dtype=np.uint8)
    most = majority(grains, mineral_of[numbers], len(ids), len(names))
    order = [name for name in dict.fromkeys(named.values()) if name in names]
    chosen = {label: names[kind] for label, kind in zip(ids.tolist(), most.tolist(), strict=True)}
    return _numbered(chosen, order)


def _numbered(named: Mapping[int, str], order: list[str] | None = None) -> Minerals:
    """Return names and indices; without an order the names are in that of the labels."""
    names = list(dict.fromkeys(named.values() if order is None else order))
    names = [name for name in names if name != HOLE_NAME and name in {*named.values()}]
    index = {name: number for number, name in enumerate(names)}
    return names, {label: index.get(name) for label, name in named.items()}


def _rows(name: str, path: Path) -> list[tuple[int, str, str]]:
    """Return line, label and mineral of each row."""
    try:
        rows = csv_rows(read_text(path))
        header = next(rows, (0, []))[1]
        if any(header.count(column) != 1 for column in COLUMNS):
            raise InputError(
                f"{name}: columns = {quoted(','.join(header))}, must have {' and '.join(COLUMNS)}, "
                "each once, in the first row; add a header"
            )
        at = [header.index(column) for column in COLUMNS]
        found = []
        for line, row in rows:
            if len(row) <= max(at):
                raise InputError(
                    f"{name}, line {line}: cells = {len(row)}, must be {len(header)}; complete it"
                )
            found.append((line, row[at[0]], row[at[1]]))
    except OSError as error:
        raise InputError(f"{name}, cannot be read ({error.strerror}); give a CSV file") from None
    except InputError:  # a ValueError, too
        raise
    except (ValueError, csv.Error) as error:
        raise InputError(f"{name}, is not a CSV file: {error}; correct the file") from None
    return found


def _size(labels: IntArray) -> str:
    return f"{labels.shape[1]} x {labels.shape[0]} pixels"
