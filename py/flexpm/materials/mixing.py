# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of the minerals of a rock, and of contacts between two minerals. SI units, magnitudes.

The paper has one type of grain. Minerals, their positions and the rule of mixing are extensions,
Deviation D27. Half of a contact belongs to each grain: stiffnesses act in series, and the weaker
half yields first.

    K_n = 2 / (1 / K_nA + 1 / K_nB),  eta K_n in the same way,
    sigma_t, c, mu, G_fn, G_fs: the smaller of the two; brittle if either mineral is brittle;
    mu_r: the smaller of the two, which is mu of a mineral without mu_r; slip length: the smaller.

An interface of the material takes precedence for the contacts of its pair.
"""

from __future__ import annotations

import dataclasses
import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..errors import InputError
from ..files import Table
from ..require import require_known
from . import interface
from .interface import ENERGY_OF, KEYS, Interface
from .keys import ELASTIC_KEYS, ELASTIC_SET, ENERGY_KEYS, elastic_set_name, is_used
from .material import ENERGY_TOLERANCE, ElasticSet, Law, Material
from .mineral import Mineral

#: Models whose contacts can have strengths of their own.
SCATTER_MODELS = ("flexible", "rigid")
#: Models that can have grains of several minerals; inner particles are of one rock.
MODELS = tuple(model for model in ELASTIC_SET if elastic_set_name(model) != "inner")


def mineral_materials(rock: Material) -> list[Material]:
    """The material of each mineral; the rock itself if it has none."""
    return [_changed(rock, mineral) for mineral in rock.minerals] or [rock]


def pair_materials(rock: Material, model: str) -> list[Material]:
    """Material of the contacts of each ordered pair of minerals, row by row.

    Raises:
        InputError: for a pair whose fracture energy lies below the elastic energy.
    """
    grains, own = mineral_materials(rock), {one.pair: one for one in rock.interfaces}
    pairs = [
        _with_interface(_pair(first, second, model), own.get(_names(first, second)), model)
        for first in grains
        for second in grains
    ]
    for pair in pairs:
        try:
            pair.law(model)
        except InputError as error:
            raise InputError(f"contact {pair.name}: {error}") from None
    return pairs


def description(rock: Material, model: str = "flexible") -> Table:
    """Return ``rock.law`` of `model`; if grains differ, also laws of minerals, by `minerals`.

    The modulus `weibull` of the scatter of strengths is there only if the rock has it.

    Raises:
        InputError: as ``law`` for any mineral or pair of minerals, or if `model` cannot have
            several minerals, or strengths that scatter.
    """
    values: Table = {**rock.law(model)}
    if rock.weibull is not None:
        if model not in SCATTER_MODELS:
            raise InputError(
                f"material weibull = {rock.weibull:g}, must not be given for model {model}; leave "
                f"it out, or use one of the models {', '.join(SCATTER_MODELS)}"
            )
        values["weibull"] = rock.weibull
    if rock.joints:
        values["joints"] = rock.joint_laws(model)
    if not rock.minerals:
        return values
    if model not in MODELS:
        raise InputError(
            f"material = {rock.name!r} has minerals, model {model} has one type of grain; use one "
            f"of the models {', '.join(MODELS)}"
        )
    pairs = pair_materials(rock, model)
    grains = mineral_materials(rock)
    values["minerals"] = [
        {"name": kind.name, "fraction": kind.fraction, **own.law(model)}
        for kind, own in zip(rock.minerals, grains, strict=True)
    ]
    if rock.interfaces:
        number = {kind.name: place for place, kind in enumerate(rock.minerals)}
        values["interfaces"] = [
            {"pair": list(one.pair), **_contact_law(pairs[place].law(model))}
            for one in rock.interfaces
            for place in [number[one.pair[0]] * len(grains) + number[one.pair[1]]]
        ]
    return values


def from_description(described: Table, model: str) -> Material:
    """Return the material of a ``description``, with the parameters that `model` uses.

    Args:
        described: Return value of ``description``, with the ``name`` of the rock.
        model: Name of the model.

    Raises:
        InputError: for a key that is unknown, missing or out of range.
    """
    values: Table = dict(described)
    kinds = [_as_in_a_file(kind, model) for kind in values.pop("minerals", ())]
    joints = {joint["name"]: _without_nulls(joint) for joint in values.pop("joints", ())}
    pairs = list(values.pop("interfaces", ()))
    for kind in kinds:
        kind.pop("plane", None)  # the same for all
    tables = {"mineral": kinds, "joint": joints, "interface": pairs}
    own = {name: table for name, table in tables.items() if table}
    return Material.from_dict(_as_in_a_file(values, model) | own)


def value_of(rock: Material, label: str, model: str) -> object:
    """Return the value of a key of the rock, or of ``interface.MINERAL/MINERAL.KEY``, for a model.

    A factor that is not given is 1; the factor of an energy is the square of the factor of its
    strength. None for a key that the law does not have.

    Raises:
        InputError: for a mineral that the rock does not have, and as ``pair_materials``.
    """
    if not interface.is_key(label):
        return {**rock.law(model), "weibull": rock.weibull}.get(label)
    names = [kind.name for kind in rock.minerals]
    pair, key, is_factor = interface.read_key(label, names)
    if is_factor:
        own = {one.pair: one for one in rock.interfaces}.get(pair)
        return own.factor_of(key) if own else 1.0
    first, second = map(names.index, pair)
    law = pair_materials(rock, model)[first * len(names) + second].law(model)
    return {**law}.get(key)


@dataclass(frozen=True)
class LongSoftening:
    """A strength that was lowered while its fracture energy stayed."""

    contact: str  #: the mineral or the interface, for messages
    strength: str  #: key of the strength
    length: float  #: softening length 2 G / strength [m]
    ratio: float  #: of this length to the one without the change [-]


def long_softening(described: Table, most: float) -> list[LongSoftening]:
    """Return minerals and interfaces whose softening length is above `most` times the usual length.

    The usual length is the rock's length for a mineral, and the length by the rule of mixing for an
    interface. A fracture energy that was also changed is regarded as intended.

    Args:
        described: Return value of ``description``.
        most: Largest ratio that is not returned [-].
    """
    minerals = {kind["name"]: kind for kind in described.get("minerals", ())}
    changed = [(f"mineral {name}", kind, [described]) for name, kind in minerals.items()]
    for one in described.get("interfaces", ()):
        mixed = [minerals.get(name, {}) for name in one["pair"]]
        changed.append((f"interface {'/'.join(one['pair'])}", one, mixed))
    found = []
    for contact, own, usual in changed:
        for strength, energy in ENERGY_OF.items():
            if any(law.get(key) is None for law in (own, *usual) for key in (strength, energy)):
                continue
            if own[energy] != _weaker(usual, energy):
                continue
            ratio = _weaker(usual, strength) / own[strength]
            if ratio > most:
                length = 2.0 * own[energy] / own[strength]
                found.append(LongSoftening(contact, strength, length, ratio))
    return found


def is_brittle(described: Table) -> bool:
    """Return whether contacts of any mineral break at their peak, without energy for softening.

    Args:
        described: Return value of ``description``; a missing key is ignored.
    """
    contacts = [*(described.get("minerals") or [described]), *described.get("interfaces", ())]
    return any(map(_breaks_at_once, contacts))


def _as_in_a_file(law: Table, model: str) -> Table:
    """Values of one model as a material's file has them; a value that is null is not there."""
    given = {key: value for key, value in law.items() if value is not None}
    elastic = {key: given.pop(key) for key in ELASTIC_KEYS if key in given}
    return given | {"elastic": {elastic_set_name(model): elastic}}


def _without_nulls(joint: Table) -> Table:
    return {key: value for key, value in joint.items() if key != "name" and value is not None}


def _breaks_at_once(law: Table) -> bool:
    if law.get("softening") == "brittle":
        return True
    if any(law.get(key) is None for key in (*ENERGY_KEYS, "normal_stiffness", "shear_ratio")):
        return False
    normal = law["normal_stiffness"]
    tensile = law["tensile_strength"] ** 2 / (2.0 * normal)
    shear = law["cohesion"] ** 2 / (2.0 * law["shear_ratio"] * normal)
    given = (law[key] for key in ENERGY_KEYS)
    return any(
        energy <= elastic * (1.0 + ENERGY_TOLERANCE)
        for energy, elastic in zip(given, (tensile, shear), strict=True)
    )


def _changed(rock: Material, mineral: Mineral) -> Material:
    changes: Table = dict(mineral.changes)
    elastic = dict(rock.elastic)
    sets = changes.pop("elastic", {})
    if not isinstance(sets, Mapping):
        raise InputError(
            f"mineral {mineral.name} elastic = {sets!r}, must be tables; give one for each model"
        )
    for name, values in sets.items():
        where = f"mineral {mineral.name} [elastic.{name}]"
        require_known(f"mineral {mineral.name} elastic set", name, list(elastic))
        if not isinstance(values, Mapping):
            raise InputError(f"{where} = {values!r}, must be a table; give keys with values")
        for key in values:
            require_known(f"{where} key", key, list(ELASTIC_KEYS))
        elastic[name] = dataclasses.replace(elastic[name], **values)
    if changes.get("softening") == "brittle":
        changes = dict.fromkeys(ENERGY_KEYS) | changes
    try:
        return dataclasses.replace(
            rock, name=mineral.name, elastic=elastic, minerals=(), interfaces=(), **changes
        )
    except InputError as error:
        raise InputError(f"mineral {mineral.name}: {error}") from None


def _pair(first: Material, second: Material, model: str) -> Material:
    """Contact between grains of two materials, by the rule above."""
    brittle = "brittle" in (first.softening, second.softening)
    weaker: Table = {
        key: min(getattr(first, key), getattr(second, key))
        for key in ("tensile_strength", "cohesion", "friction")
    }
    energies: Table = {
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
        **_residual(first, second),
    )


def _residual(first: Material, second: Material) -> Table:
    """Residual friction and slip length of the contact between grains of two materials."""
    lengths = [one.slip_length for one in (first, second) if one.slip_length is not None]
    if not lengths:
        return {}
    values = (
        one.friction if one.residual_friction is None else one.residual_friction
        for one in (first, second)
    )
    return {"residual_friction": min(values), "slip_length": min(lengths)}


def _with_interface(pair: Material, own: Interface | None, model: str) -> Material:
    """Return the contact of a pair with the values of its interface."""
    if own is None:
        return pair
    name = elastic_set_name(model)
    elastic = pair.elastic[name]
    mixed = {key: getattr(elastic if key in ELASTIC_KEYS else pair, key) for key in KEYS}
    idle = [key for key in own.factors if mixed[key] is None and not is_used(key, model)]
    factors = {key: factor for key, factor in own.factors.items() if key not in idle}
    changes = dataclasses.replace(own, factors=factors).law_of(mixed)
    springs = {key: changes.pop(key) for key in ELASTIC_KEYS if key in changes}
    if changes.get("softening") == "brittle":
        changes = dict.fromkeys(ENERGY_KEYS) | changes
    try:
        sets = {name: dataclasses.replace(elastic, **springs)}
        return dataclasses.replace(pair, elastic=sets, **changes)
    except InputError as error:
        raise InputError(f"interface {own.name}: {error}") from None


def _contact_law(law: Law) -> Table:
    """Return the part of a law that belongs to the contact."""
    return {key: value for key, value in law.items() if key in KEYS}


def _weaker(laws: Sequence[Mapping[str, float]], key: str) -> float:
    """Return the contact's value of a key that mixes by the smaller value of both grains."""
    return min(law[key] for law in laws)


def _names(first: Material, second: Material) -> tuple[str, str]:
    return (min(first.name, second.name), max(first.name, second.name))


def _in_series(first: ElasticSet, second: ElasticSet) -> ElasticSet:
    contact = operator.attrgetter("normal_stiffness", "shear_ratio")
    if contact(first) == contact(second):
        return first  # to the same bits
    normal = _harmonic(first.normal_stiffness, second.normal_stiffness)
    shear = _harmonic(
        first.shear_ratio * first.normal_stiffness, second.shear_ratio * second.normal_stiffness
    )
    # those of the first grain: triangles have no part in a contact
    return dataclasses.replace(first, normal_stiffness=normal, shear_ratio=shear / normal)


def _harmonic(first: float, second: float) -> float:
    return 2.0 / (1.0 / first + 1.0 / second)
