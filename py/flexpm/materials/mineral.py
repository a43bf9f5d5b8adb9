# SPDX-License-Identifier: GPL-3.0-or-later
"""Minerals of a heterogeneous rock: changes of each mineral to the rock's material. SI units."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..errors import InputError
from ..files import Table
from ..require import (
    POSITIVE,
    quoted,
    require_known,
    require_name,
    require_number,
    require_table,
)
from .keys import COMMON_KEYS, ELASTIC_KEYS, ROCK_KEYS, scaled

#: Fractions are to sum up to 1 within this.
_SUM_TOLERANCE = 1e-6
#: Minerals of a rock; each pair of them has a law of contact.
MOST = 100
#: How keys of ``--set`` begin that are of no mineral.
_RESERVED = ("joint.", "interface.")
_KEYS = tuple(key for key in COMMON_KEYS if key not in ROCK_KEYS)


@dataclass(frozen=True)
class Mineral:
    """A mineral, described by its changes to the rock's material."""

    name: str
    fraction: float  #: of the area [-]
    changes: Mapping[str, object]  #: common keys, and `elastic`: changed keys by name of the set

    def __post_init__(self) -> None:
        require_name("mineral name", self.name)

    @classmethod
    def from_dict(cls, data: object, number: int) -> Mineral:
        """Make a mineral from a table `[[mineral]]`.

        Args:
            data: The table.
            number: Its position, from 1, for messages.

        Raises:
            InputError: for a key that is unknown, missing or out of range; the message names the
                key.
        """
        where = f"material [[mineral]] {number}"
        changes = require_table(where, data)
        for key in ("name", "fraction"):
            if key not in changes:
                raise InputError(f"{where} {key} is missing; give the mineral a {key}")
        name, fraction = require_name(f"{where} name", changes.pop("name")), changes.pop("fraction")
        fraction = require_number(f"{where} fraction", fraction, POSITIVE)
        for key in changes:
            require_known(f"mineral {name} key", key, [*_KEYS, "name", "fraction", "elastic"])
        if "elastic" in changes:
            sets = require_table(f"{where} elastic", changes["elastic"])
            changes["elastic"] = {
                key: require_table(f"{where} [elastic.{key}]", own) for key, own in sets.items()
            }
        return cls(name, fraction, changes)

    def scaled(self, ratio: float) -> Mineral:
        """Return the mineral of grains whose diameters are multiplied by a ratio [-]."""
        changes = scaled(self.changes, ratio)
        sets = changes.get("elastic")
        if isinstance(sets, Mapping):
            changes["elastic"] = {
                name: scaled(own, ratio) if isinstance(own, Mapping) else own
                for name, own in sets.items()
            }
        return dataclasses.replace(self, changes=changes)


def checked(minerals: object) -> tuple[Mineral, ...]:
    """Minerals from tables; their names differ and their fractions sum up to 1."""
    if not isinstance(minerals, list | tuple):
        raise InputError(
            f"material mineral = {quoted(minerals)}, must be tables [[mineral]]; write double "
            "brackets"
        )
    if len(minerals) > MOST:
        raise InputError(
            f"material minerals = {len(minerals)}, must be <= {MOST}; merge similar minerals"
        )
    made = tuple(
        table if isinstance(table, Mineral) else Mineral.from_dict(table, number)
        for number, table in enumerate(minerals, 1)
    )
    names = [mineral.name for mineral in made]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"mineral = {name!r}, is given twice; give each mineral another name")
        if name.startswith(_RESERVED):
            raise InputError(
                f"mineral = {quoted(name)}, must not begin with {' or '.join(_RESERVED)}, as "
                "keys of joints and interfaces do; give it another name"
            )
    total = math.fsum(mineral.fraction for mineral in made)
    if made and abs(total - 1.0) > _SUM_TOLERANCE:
        raise InputError(f"mineral fractions = {total:.6g} in all, must sum to 1; correct them")
    return made


def with_values(
    kinds: Sequence[Mineral], values: Mapping[str, object], elastic_set: str
) -> tuple[Mineral, ...]:
    """Minerals with changed values.

    Args:
        kinds: The minerals.
        values: By ``MINERAL.KEY``.
        elastic_set: Name of the set that elastic keys belong to.

    Raises:
        InputError: for an unknown mineral, or a key that a mineral cannot have.
    """
    found = {kind.name: kind for kind in kinds}
    for name, value in values.items():
        mineral, _, key = name.rpartition(".")
        if not found:
            raise InputError(
                f"set {name} = {value!r}, the material has no minerals; use a material with "
                "[[mineral]] tables"
            )
        require_known("set mineral", mineral, list(found))
        require_known(f"set {mineral} key", key, [*_KEYS, *ELASTIC_KEYS])
        changes: Table = dict(found[mineral].changes)
        if key in ELASTIC_KEYS:
            sets = dict(changes.get("elastic", {}))
            sets[elastic_set] = {**sets.get(elastic_set, {}), key: value}
            changes["elastic"] = sets
        else:
            changes[key] = value
        found[mineral] = dataclasses.replace(found[mineral], changes=changes)
    return tuple(found.values())
