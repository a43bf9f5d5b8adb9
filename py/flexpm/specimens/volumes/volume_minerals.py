# SPDX-License-Identifier: GPL-3.0-or-later
"""Minerals and pores of a label volume, from files of phases or minerals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...files import Table, load_toml
from ...require import quoted, require_name
from ..label_volumes.label_volume import LabelVolume, sized
from ..label_volumes.reading import read
from ..labels import mineral_table
from ..labels.picture import HOLE_NAME, indices
from .regions import Kinds

#: What the voxels of a volume are: grains, or phases whose connected regions are grains.
LABELS = ("grains", "phases")
_WHOLE = re.compile(r"-?[0-9]{1,18}")


def kinds_of_file(path: Path, volume: LabelVolume, labels: str) -> Kinds:
    """Read the mineral, or ``hole``, of each phase of a volume.

    Args:
        path: A TOML file with lines such as ``1 = "quartz"`` and ``0 = "hole"``. The keys are
            phases of the volume: its labels if `labels` is ``phases``, or if the file of the volume
            has no phases of grains. A file with holes only makes all other labels rock.
        volume: The volume.
        labels: One of `LABELS`.

    Raises:
        InputError: for a key that is no whole number, or a phase without a key.
    """
    found = _names(path)
    ids = volume.ids.tolist()
    phases = ids if labels == "phases" or volume.phases is None else volume.phases.tolist()
    voids = {0} if volume.has_voids and 0 not in found else set()
    if set(found.values()) == {HOLE_NAME}:
        pores = {one for one, phase in zip(ids, phases, strict=True) if phase in found}
        return Kinds(pores=frozenset(pores | voids))
    needed = (phase for one, phase in zip(ids, phases, strict=True) if one not in voids)
    _require_all(path, needed, found)
    names, of_phase = indices(found)
    by_label = {
        one: of_phase[phase] for one, phase in zip(ids, phases, strict=True) if one not in voids
    }
    rock = {label: mineral for label, mineral in by_label.items() if mineral is not None}
    return Kinds(rock, frozenset({*by_label} - {*rock} | voids), tuple(names))


def kinds_of_phases(volume: LabelVolume) -> Kinds:
    """Make each label of a volume of phases a mineral with the name of the label."""
    voids = frozenset({0} if volume.has_voids else ())
    ids = [one for one in volume.ids.tolist() if one not in voids]
    if len(ids) < 2:
        return Kinds(pores=voids)
    numbers = {label: number for number, label in enumerate(ids)}
    return Kinds(numbers, voids, tuple(f"phase {label}" for label in ids))


def kinds_of_minerals(
    path: Path, volume: LabelVolume, reading: Table, phases: Path | None = None
) -> Kinds:
    """Read the mineral of each grain of a volume.

    Args:
        path: A CSV table, see ``mineral_table.read``, or a second volume with as many voxels. A
            grain has the phase that most of its voxels have in the second volume.
        volume: The volume of grains.
        reading: Arguments of ``reading.read`` for a second volume.
        phases: File of the phases of the second volume, see `kinds_of_file`; None: minerals are
            called ``phase 1`` and so on.

    Raises:
        InputError: for a file that cannot be read, a volume of another size, or a grain without a
            mineral.
    """
    voids = frozenset({0} if volume.has_voids else ())
    grains = np.array([one for one in volume.ids.tolist() if one not in voids])
    if path.suffix.lower() == mineral_table.SUFFIX:
        if phases is not None:
            raise InputError(
                f"phases = {quoted(str(phases))}, must not be given with a table of minerals: the "
                "table has their names; leave one out"
            )
        names, found = mineral_table.read(path, grains)
    else:
        second = read(path, **reading)
        if second.counts != volume.counts:
            raise InputError(
                f"minerals = {quoted(str(path))} of {sized(second.counts)}, must have "
                f"{sized(volume.counts)} as the volume of grains; give a volume of the same rock"
            )
        named = {one: f"phase {one}" for one in second.ids.tolist()}
        if second.has_voids:
            named[0] = HOLE_NAME
        if phases is not None:
            named = _names(phases)
            _require_all(phases, second.ids.tolist(), named)
        names, found = mineral_table.by_majority(
            str(path), volume.ids, volume.labels, second.ids, second.labels, named
        )
    rock = {label: one for label, one in found.items() if one is not None and label not in voids}
    return Kinds(rock, frozenset({*found} - {*rock} | voids), tuple(names))


def _names(path: Path) -> dict[int, str]:
    """Return the mineral or ``hole`` of each key of a file of phases."""
    found: dict[int, str] = {}
    for key, name in load_toml(path, "phases").items():
        if not _WHOLE.fullmatch(key):
            raise InputError(f"phases key = {quoted(key)}, must be a whole number; correct it")
        found[int(key)] = require_name(f"phases {quoted(key)}", name)
    if not found:
        raise InputError(f"phases = {quoted(str(path))}, is empty; give phase = mineral")
    return found


def _require_all(path: Path, phases: Iterable[int], found: Mapping[int, str]) -> None:
    missing = sorted({*phases} - {*found})
    if missing:
        others = f"; so are {len(missing) - 1} others" if len(missing) > 1 else ""
        raise InputError(
            f"volume phase = {missing[0]}, is missing in {path}{others}; name it there"
        )
