# SPDX-License-Identifier: GPL-3.0-or-later
"""Minerals of a heterogeneous rock, and contacts between two of them. SI units, magnitudes.

The paper has one kind of grain; minerals, their place and the rule of mixing are ours, Deviation
D27. Half of a contact belongs to each grain: stiffnesses act in series, and what carries least
gives way first.

    K_n = 2 / (1 / K_nA + 1 / K_nB),  eta K_n in the same way,
    sigma_t, c, mu, G_fn, G_fs: the smaller of the two; brittle if one of them is.
"""

from __future__ import annotations

import dataclasses
import math
import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from .keys import COMMON_KEYS, ELASTIC_KEYS, ENERGY_KEYS, check_name, elastic_set_name

if TYPE_CHECKING:
    from .material import ElasticSet, Material

#: Models that can have grains of several minerals.
MODELS = ("flexible", "rigid")
#: Fractions are to sum up to 1 within this.
_SUM_TOLERANCE = 1e-6
_KEYS = tuple(key for key in COMMON_KEYS if key != "plane")


@dataclass(frozen=True)
class Mineral:
    """A mineral by what it changes of the rock's material."""

    name: str
    fraction: float  #: of the area [-]
    changes: Mapping[str, Any]  #: common keys, and `elastic`: changed keys by name of the set

    @classmethod
    def from_dict(cls, data: Any, number: int) -> Mineral:
        """Make a mineral from a table `[[mineral]]`.

        Args:
            data: The table.
            number: Its place, from 1, for messages.

        Raises:
            InputError: naming the key that is unknown, missing or out of range.
        """
        where = f"material [[mineral]] {number}"
        if not isinstance(data, Mapping):
            raise InputError(f"{where} = {data!r}, must be a table with name and fraction")
        changes = dict(data)
        for key in ("name", "fraction"):
            if key not in changes:
                raise InputError(f"{where} {key} is missing; give the mineral a {key}")
        name, fraction = str(changes.pop("name")), changes.pop("fraction")
        if isinstance(fraction, bool) or not isinstance(fraction, int | float):
            raise InputError(f"{where} fraction = {fraction!r}, must be a number")
        if not (math.isfinite(fraction) and fraction > 0.0):
            raise InputError(f"{where} fraction = {fraction}, must be > 0")
        for key in changes:
            check_name(f"mineral {name} key", key, [*_KEYS, "name", "fraction", "elastic"])
        return cls(name, float(fraction), changes)


def checked(minerals: Sequence[Any]) -> tuple[Mineral, ...]:
    """Minerals from tables; their names differ and their fractions sum up to 1."""
    if not isinstance(minerals, list | tuple):
        raise InputError(f"material mineral = {minerals!r}, must be tables [[mineral]]")
    made = tuple(
        table if isinstance(table, Mineral) else Mineral.from_dict(table, number)
        for number, table in enumerate(minerals, 1)
    )
    names = [mineral.name for mineral in made]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"mineral = {name!r}, is there twice; give each a name of its own")
    total = math.fsum(mineral.fraction for mineral in made)
    if made and abs(total - 1.0) > _SUM_TOLERANCE:
        raise InputError(f"mineral fractions = {total:.6g} in all, must sum up to 1")
    return made


def with_values(
    kinds: Sequence[Mineral], values: Mapping[str, Any], elastic_set: str
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
            raise InputError(f"set {name} = {value!r}, needs a material with [[mineral]] tables")
        check_name("set mineral", mineral, list(found))
        check_name(f"set {mineral} key", key, [*_KEYS, *ELASTIC_KEYS])
        changes = dict(found[mineral].changes)
        if key in ELASTIC_KEYS:
            sets = dict(changes.get("elastic", {}))
            sets[elastic_set] = {**sets.get(elastic_set, {}), key: value}
            changes["elastic"] = sets
        else:
            changes[key] = value
        found[mineral] = dataclasses.replace(found[mineral], changes=changes)
    return tuple(found.values())


def mineral_materials(rock: Material) -> list[Material]:
    """The material of each mineral; the rock itself if it has none."""
    return [_changed(rock, mineral) for mineral in rock.minerals] or [rock]


def pair_materials(rock: Material, model: str) -> list[Material]:
    """Material of the contacts of each ordered pair of minerals, row by row.

    Raises:
        InputError: for a pair whose fracture energy lies below the elastic energy.
    """
    grains = mineral_materials(rock)
    pairs = [_pair(first, second, model) for first in grains for second in grains]
    for pair in pairs:
        try:
            pair.law(model)
        except InputError as error:
            raise InputError(f"contact {pair.name}: {error}") from None
    return pairs


def _changed(rock: Material, mineral: Mineral) -> Material:
    changes = dict(mineral.changes)
    elastic = dict(rock.elastic)
    sets = changes.pop("elastic", {})
    if not isinstance(sets, Mapping):
        raise InputError(f"mineral {mineral.name} elastic = {sets!r}, must be tables")
    for name, values in sets.items():
        where = f"mineral {mineral.name} [elastic.{name}]"
        check_name(f"mineral {mineral.name} elastic set", name, list(elastic))
        if not isinstance(values, Mapping):
            raise InputError(f"{where} = {values!r}, must be a table")
        for key in values:
            check_name(f"{where} key", key, list(ELASTIC_KEYS))
        elastic[name] = dataclasses.replace(elastic[name], **values)
    if changes.get("softening") == "brittle":
        changes = dict.fromkeys(ENERGY_KEYS) | changes
    try:
        return dataclasses.replace(rock, name=mineral.name, elastic=elastic, minerals=(), **changes)
    except InputError as error:
        raise InputError(f"mineral {mineral.name}: {error}") from None


def _pair(first: Material, second: Material, model: str) -> Material:
    """Contact between grains of two materials, by the rule above."""
    brittle = "brittle" in (first.softening, second.softening)
    weaker = {
        key: min(getattr(first, key), getattr(second, key))
        for key in ("tensile_strength", "cohesion", "friction")
    }
    energies = {
        key: None if brittle else min(getattr(first, key), getattr(second, key))
        for key in ENERGY_KEYS
    }
    name = elastic_set_name(model)
    return dataclasses.replace(
        first,
        name=f"{first.name}-{second.name}",
        elastic={name: _in_series(first.elastic[name], second.elastic[name])},
        softening="brittle" if brittle else "bilinear",
        **weaker,
        **energies,
    )


def _in_series(first: ElasticSet, second: ElasticSet) -> ElasticSet:
    contact = operator.attrgetter("normal_stiffness", "shear_ratio")
    if contact(first) == contact(second):
        return first  # to the same bits
    normal = _harmonic(first.normal_stiffness, second.normal_stiffness)
    shear = _harmonic(
        first.shear_ratio * first.normal_stiffness, second.shear_ratio * second.normal_stiffness
    )
    # of the first grain: triangles have no part in a contact
    return dataclasses.replace(first, normal_stiffness=normal, shear_ratio=shear / normal)


def _harmonic(first: float, second: float) -> float:
    return 2.0 / (1.0 / first + 1.0 / second)
