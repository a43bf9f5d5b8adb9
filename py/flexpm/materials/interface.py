# SPDX-License-Identifier: GPL-3.0-or-later
"""Interfaces: contacts of a pair of minerals with a law other than the rule of mixing. SI units.

A boundary between two minerals is often weaker, or stiffer, than both. A table ``[[interface]]``
names the pair, which may be one mineral twice, and has values of the contact's law or factors on
the values of the rule of mixing (Deviation D27). Other values do not change, except fracture
energies: a factor of a strength multiplies the energy of the same mode by its square.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ..errors import InputError
from ..files import Table
from ..require import Bounds, quoted, require_known, require_number, require_table
from .keys import ENERGY_KEYS, RESIDUAL_KEYS, scaled
from .keys import checked as checked_value

#: Keys of a contact's law that an elastic set has.
_ELASTIC = ("normal_stiffness", "shear_ratio")
#: Keys that may have a factor: not words, and not keys that the rule of mixing may lack.
FACTOR_KEYS = (*_ELASTIC, *("tensile_strength", "cohesion", "friction"), *ENERGY_KEYS)
#: All keys of a contact's law; the others are of the grains.
KEYS = (*FACTOR_KEYS, *RESIDUAL_KEYS, "softening")
#: Fracture energy of the mode of each strength.
ENERGY_OF = dict(zip(("tensile_strength", "cohesion"), ENERGY_KEYS, strict=True))
_FACTOR = Bounds(above=0.0, at_least=1e-12, at_most=1e12)
#: Begins the key of a value on the command line.
_PREFIX = "interface."


@dataclass(frozen=True)
class Interface:
    """Values of the contacts of a pair of minerals that replace the rule of mixing."""

    pair: tuple[str, str]  #: names of the minerals, in the order of the alphabet
    values: Mapping[str, object] = field(default_factory=dict)  #: by key of the law
    factors: Mapping[str, object] = field(default_factory=dict)  #: of what mixing gives [-], by key

    @property
    def name(self) -> str:
        """Both minerals, as messages and options have them."""
        return "/".join(self.pair)

    def __post_init__(self) -> None:
        where = f"interface {self.name}"
        for key in (*self.values, *self.factors):
            require_known(f"{where} key", key, list(KEYS))
        for key in self.factors:
            if key not in FACTOR_KEYS:
                raise InputError(f"{where} factor.{key}, must not be given; give {key} itself")
            if key in self.values:
                raise InputError(
                    f"{where} {key} = {self.values[key]!r}, must not be given with factor.{key} = "
                    f"{self.factors[key]!r}; leave out one of them"
                )
        values = {key: checked_value(key, value, where + " ") for key, value in self.values.items()}
        factors = {
            key: require_number(f"{where} factor.{key}", value, _FACTOR)
            for key, value in self.factors.items()
        }
        object.__setattr__(self, "pair", _in_order(*self.pair))
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "factors", factors)

    @classmethod
    def from_dict(cls, data: object, number: int) -> Interface:
        """Make an interface from a table ``[[interface]]``.

        Args:
            data: The table.
            number: Its position, from 1, for messages.

        Raises:
            InputError: for a key that is unknown, missing or out of range; the message names the
                key.
        """
        where = f"material [[interface]] {number}"
        values = require_table(where, data)
        if "pair" not in values:
            raise InputError(f"{where} pair is missing; give the names of two minerals")
        pair = values.pop("pair")
        if not (
            isinstance(pair, list | tuple)
            and len(pair) == 2
            and all(isinstance(one, str) for one in pair)
        ):
            raise InputError(
                f"{where} pair = {quoted(pair)}, must be the names of two minerals; give a list of "
                "both"
            )
        factors = require_table(f"{where} factor", values.pop("factor", {}))
        return cls((pair[0], pair[1]), values, factors)

    def scaled(self, ratio: float) -> Interface:
        """Return the interface of grains whose diameters are multiplied by a ratio [-]."""
        return dataclasses.replace(self, values=scaled(self.values, ratio))

    def law_of(self, mixed: Mapping[str, object]) -> Table:
        """Return values of the contact's law that differ from the rule of mixing.

        Args:
            mixed: Law by the rule of mixing; its energies are None for brittle softening.
        """
        changed: Table = dict(self.values)
        implied = {key: one for key, one in self._implied().items() if mixed[key] is not None}
        for key, factor in {**self.factors, **implied}.items():
            value = mixed[key]
            if value is None:
                raise InputError(
                    f"interface {self.name} factor.{key} = {factor!r}, has nothing to multiply, as "
                    "the softening is brittle; leave it out, or give softening = bilinear and "
                    f"{key}"
                )
            assert isinstance(value, float) and isinstance(factor, float)
            changed[key] = factor * value
        return changed

    def factor_of(self, key: str) -> object:
        """Return the factor of a key [-]: given, implied for a fracture energy, or 1."""
        return {**self._implied(), **self.factors}.get(key, 1.0)

    def _implied(self) -> dict[str, float]:
        """Return factors of unspecified fracture energies: squares of the factors of strengths.

        Such a contact softens over a length in proportion to its strength.
        """
        if self.values.get("softening") == "brittle":
            return {}
        found = {}
        for strength, energy in ENERGY_OF.items():
            factor = self.factors.get(strength)
            if isinstance(factor, float) and not {energy} & {*self.values, *self.factors}:
                found[energy] = factor**2
        return found


def checked(interfaces: object, minerals: Sequence[str]) -> tuple[Interface, ...]:
    """Return interfaces from tables, or from interfaces.

    Args:
        interfaces: List of tables or interfaces.
        minerals: Names of the rock's minerals.

    Raises:
        InputError: for a mineral that the rock does not have, or a pair that occurs twice.
    """
    if not isinstance(interfaces, list | tuple):
        raise InputError(
            f"material interface = {quoted(interfaces)}, must be tables [[interface]]; write "
            "double brackets"
        )
    made = tuple(
        table if isinstance(table, Interface) else Interface.from_dict(table, number)
        for number, table in enumerate(interfaces, 1)
    )
    pairs = [one.pair for one in made]
    for one in made:
        if not minerals:
            raise InputError(
                f"interface {one.name}: the material has no minerals; add [[mineral]] tables or "
                "leave the interface out"
            )
        for name in one.pair:
            require_known(f"interface {one.name}: mineral", name, list(minerals))
        if pairs.count(one.pair) > 1:
            raise InputError(f"interface = {one.name!r}, is given twice; put all keys in one table")
    return made


def is_key(label: str) -> bool:
    """Whether a key reads ``interface.MINERAL/MINERAL.KEY`` or ``...factor.KEY``."""
    return label.startswith(_PREFIX) and "/" in label


def with_values(
    interfaces: Sequence[Interface], values: Mapping[str, object], minerals: Sequence[str]
) -> tuple[Interface, ...]:
    """Return interfaces with changed values; a new pair makes an interface.

    A value replaces a factor of the same key, and vice versa.

    Args:
        interfaces: The interfaces.
        values: By ``interface.MINERAL/MINERAL.KEY`` or ``interface.MINERAL/MINERAL.factor.KEY``.
        minerals: Names of the rock's minerals.

    Raises:
        InputError: for a mineral or a key that is unknown.
    """
    found = {one.pair: one for one in interfaces}
    for label, value in values.items():
        pair, key, is_factor = read_key(label, minerals)
        old = found.get(pair, Interface(pair))
        own, factors = dict[str, object](old.values), dict[str, object](old.factors)
        own.pop(key, None)
        factors.pop(key, None)
        (factors if is_factor else own)[key] = value
        found[pair] = dataclasses.replace(old, values=own, factors=factors)
    return checked([*found.values()], minerals)


def read_key(label: str, minerals: Sequence[str]) -> tuple[tuple[str, str], str, bool]:
    """Pair and key of the law that a key names, and whether it is a factor.

    Raises:
        InputError: for a mineral that the rock does not have.
    """
    names, _, key = label.removeprefix(_PREFIX).rpartition(".")
    pair = _split(label, names.removesuffix(".factor"), minerals)
    return pair, key, names.endswith(".factor")


def _split(label: str, names: str, minerals: Sequence[str]) -> tuple[str, str]:
    """Return the minerals of a text MINERAL/MINERAL; a name may contain a slash.

    Raises:
        InputError: for a text that names no pair of the minerals, or more than one pair.
    """
    parts = names.split("/")
    pairs = (("/".join(parts[:at]), "/".join(parts[at:])) for at in range(1, len(parts)))
    found = sorted({_in_order(*pair) for pair in pairs if {*pair} <= {*minerals}})
    if len(found) > 1:
        both = " or ".join(f"{first} with {second}" for first, second in found)
        raise InputError(
            f"set {label}: {names!r} is {both}; give the pair as [[interface]] of the material's "
            "file, or use names of minerals without /"
        )
    if found:
        return found[0]
    if not minerals:
        raise InputError(
            f"set {label}: the material has no minerals; use a material with [[mineral]] tables"
        )
    raise InputError(
        f"set {label}: {names!r}, must be two of the minerals {', '.join(minerals)}; write A/B"
    )


def _in_order(first: str, second: str) -> tuple[str, str]:
    return (first, second) if first <= second else (second, first)
