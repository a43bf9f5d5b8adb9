# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of a fracture network, read from tables of its file: a name and numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self, TypeVar

from ..errors import InputError
from ..files import Table
from ..require import (
    Bounds,
    quoted,
    require_known,
    require_number,
    require_one_of,
    require_table,
)


def number(bounds: Bounds, unit: str = "") -> float:
    """A field that is a number within bounds."""
    found: float = dataclasses.field(metadata={"bounds": bounds, "unit": unit})
    return found


def word(*choices: str) -> str:
    """A field that is one of a few words."""
    found: str = dataclasses.field(metadata={"choices": choices})
    return found


@dataclass(frozen=True)
class Law:
    """Base of laws; fields, of ``number`` and ``word``, are the keys of its table."""

    @classmethod
    def of(cls, where: str, table: Table) -> Self:
        """The law of a table.

        Raises:
            InputError: for a key that is missing or unknown, or a value out of range.
        """
        found = {field.name: field.metadata for field in dataclasses.fields(cls)}
        for key in table:
            require_known(f"{where} key", key, [*found])
        values: Table = {}
        for name, about in found.items():
            if name not in table:
                raise InputError(f"{where} {name} is missing; give {', '.join(found)}")
            label, value = f"{where} {name}", table[name]
            if "choices" in about:
                require_one_of(label, value, about["choices"])
                values[name] = value
            else:
                values[name] = require_number(label, value, about["bounds"], about["unit"])
        made = cls(**values)
        if rule := made.broken():
            raise InputError(f"{where} {rule}")
        return made

    def broken(self) -> str:
        """Return the violated rule of several numbers: quantity, value, rule, remedy; or empty."""
        return ""


Kind = TypeVar("Kind", bound=Law)


def law_of(where: str, given: object, laws: Mapping[str, type[Kind]]) -> Kind:
    """The law that a table names.

    Args:
        where: Name of the table, for messages.
        given: The table.
        laws: Those that there are, by name.

    Raises:
        InputError: for input that is not a table of a law.
    """
    table = require_table(where, given)
    name = table.pop("law", None)
    if not isinstance(name, str) or name not in laws:
        raise InputError(
            f"{where} law = {quoted(name)}, must be one of {', '.join(laws)}; choose one of them"
        )
    return laws[name].of(where, table)


def table_of(law: Law, laws: Mapping[str, type[Kind]]) -> Table:
    """The table of a law, which ``law_of`` reads."""
    name = next(name for name, kind in laws.items() if isinstance(law, kind))
    return {"law": name, **dataclasses.asdict(law)}
