# SPDX-License-Identifier: GPL-3.0-or-later
"""Minerals and pores of a label volume, from files of phases or minerals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...files import Table, load_toml
from ...require import Bounds, quoted, require_name, require_whole
from ..label_volumes.label_volume import LabelVolume, sized
from ..label_volumes.reading import read
from ..labels import mineral_table
from ..labels.picture import HOLE_NAME, indices
from .regions import Kinds

#: Meaning of the labels: grains, or phases whose connected regions are grains.
LABELS = ("grains", "phases")
#: Names that are not meant as a mineral.
_HOLES = ("hole", "pore", "pores", "void", "air")
_WHOLE = re.compile(r"-?[0-9]{1,18}")


def kinds_of(
    volume: LabelVolume, minerals: Mapping[int, int | None] | None, labels: str = "grains"
) -> Kinds:
    """Return the minerals and pores among the labels of a volume.

    Args:
        volume: The volume.
        minerals: As for ``Specimen.from_label_volume``.
        labels: One of `LABELS`: labels of phases are minerals by default.

    Raises:
        InputError: for a label without a mineral, an index that is none, or a pore that is no label
            of the volume.
    """
    ids = volume.ids.tolist()
    known = {*ids}
    voids = {0} if volume.has_voids else set()
    given = {} if minerals is None else minerals
    if not isinstance(given, Mapping):
        raise InputError(
            f"minerals = {quoted(given)}, must be an index or None by label, or a file; give "
            "{label: index}"
        )
    for label, mineral in given.items():
        if mineral is None and label not in known:
            raise InputError(
                f"pore = label {quoted(label)}, must be a label of the volume; correct it"
            )
        if mineral is not None:
            where = f"Specimen.from_label_volume: minerals[{label}]"
            require_whole(where, mineral, Bounds(at_least=0, at_most=99))
    pores = frozenset(voids | {label for label, one in given.items() if one is None})
    rock = [one for one in ids if one not in pores]
    if not pores.issuperset(given):
        missing = [label for label in rock if label not in given]
        if missing:
            others = f" and of {len(missing) - 1} others" if len(missing) > 1 else ""
            raise InputError(
                f"Specimen.from_label_volume: mineral of label {missing[0]}{others} is missing; "
                "give its index, or None for a pore"
            )
        return Kinds({label: int(given[label] or 0) for label in rock}, pores)
    if labels == "phases":
        phases, names = {label: label for label in ids}, {}
    elif volume.phases is not None:
        phases = dict(zip(ids, volume.phases.tolist(), strict=True))
        names = dict(volume.phase_names)
    else:
        return Kinds(pores=pores)
    kinds = sorted({phases[label] for label in rock})
    named = {one: names.get(one, f"phase {one}") for one in kinds}
    order = list(dict.fromkeys(named.values()))
    found = {label: order.index(named[phases[label]]) for label in rock}
    return Kinds(found, pores, tuple(order))


def kinds_of_file(path: Path, volume: LabelVolume, labels: str) -> Kinds:
    """Read the mineral, or ``hole``, of each phase of a volume.

    Args:
        path: A TOML file with lines such as ``1 = "quartz"`` and ``0 = "hole"``. The keys are
            phases of the volume: its labels if `labels` is ``phases``, or if the file of the volume
            has no phases of grains. A file with holes only leaves the minerals of all other labels
            as they are without the file.
        volume: The volume.
        labels: One of `LABELS`.

    Raises:
        InputError: for a key that is no whole number or no phase, or a phase without a key.
    """
    found = _names(path)
    ids = volume.ids.tolist()
    phases = ids if labels == "phases" or volume.phases is None else volume.phases.tolist()
    unknown = [key for key, name in found.items() if name == HOLE_NAME and key not in phases]
    if unknown:
        raise InputError(
            f"phases {unknown[0]} = hole, must be a phase or label of the volume; correct {path}"
        )
    pairs = dict(zip(ids, phases, strict=True))
    if set(found.values()) == {HOLE_NAME}:
        holes = {one: None for one, phase in pairs.items() if phase in found}
        return kinds_of(volume, holes, labels)
    voids = {0} if volume.has_voids and 0 not in found else set()
    _require_all(path, (phase for one, phase in pairs.items() if one not in voids), found)
    names, of_phase = indices(found)
    by_label = {one: of_phase[phase] for one, phase in pairs.items() if one not in voids}
    rock = {label: mineral for label, mineral in by_label.items() if mineral is not None}
    return Kinds(rock, frozenset({*by_label} - {*rock} | voids), tuple(names))


def kinds_of_minerals(
    path: Path,
    volume: LabelVolume,
    reading: Table,
    phases: Path | None = None,
    *,
    dtype: str | None = None,
    array: str | None = None,
) -> Kinds:
    """Read the mineral of each grain of a volume.

    Args:
        path: A CSV table, see ``mineral_table.read``, or a second volume with as many voxels. A
            grain has the phase that most of its voxels have in the second volume.
        volume: The volume of grains.
        reading: Arguments of ``reading.read`` with which the volume was read.
        phases: File of the phases of the second volume, see `kinds_of_file`; None: minerals are
            called ``phase 1`` and so on.
        dtype: Type of the numbers of a second volume that is a ``.raw`` file; None: that of the
            first one. Such a file has as many voxels as the file of the grains.
        array: Name of the array of phases in a second volume with several arrays.

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
        for name, value in (("dtype", dtype), ("array", array)):
            if value is not None:
                raise InputError(
                    f"minerals_{name} = {quoted(value)}, is for a second volume, not for a table; "
                    "leave it out"
                )
        names, found = mineral_table.read(path, grains)
    else:
        # the second volume has the voxels of the first one
        options: Table = {name: reading.get(name) for name in ("crop", "coarsen")}
        options |= _second(path, volume, reading.get("dtype"), dtype, array)
        step = options["coarsen"] = options["coarsen"] or 1
        voxel = tuple(size / step for size in volume.spacing)
        second = read(path, voxel=voxel, **options)
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


def _second(
    path: Path, volume: LabelVolume, first: str | None, dtype: str | None, array: str | None
) -> Table:
    """Return the options by which a second volume is read, for its format."""
    if path.suffix.lower() == ".raw":
        if dtype is None and first is None:
            raise InputError(
                f"minerals = {quoted(str(path))}, is a .raw file without minerals_dtype; give it, "
                "such as uint8"
            )
        options: Table = {"counts": volume.file_counts or volume.counts, "dtype": dtype or first}
        return options | {"array": array}
    if dtype is not None:
        raise InputError(
            f"minerals_dtype = {quoted(dtype)}, is for a .raw file; leave it out for "
            f"{quoted(str(path))}"
        )
    return {"array": array}


def _names(path: Path) -> dict[int, str]:
    """Return the mineral or ``hole`` of each key of a file of phases."""
    found: dict[int, str] = {}
    for key, name in load_toml(path, "phases").items():
        if not _WHOLE.fullmatch(key):
            raise InputError(f"phases key = {quoted(key)}, must be a whole number; correct it")
        if int(key) in found:
            raise InputError(f"phases key = {quoted(key)}, is given twice; remove one of them")
        found[int(key)] = require_name(f"phases {quoted(key)}", name)
        if name != HOLE_NAME and name.lower() in _HOLES:
            raise InputError(
                f"phases {quoted(key)} = {quoted(name)}, must be {quoted(HOLE_NAME)} for a pore; "
                "correct it"
            )
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
