# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of what a specimen is made from: each refusal is one line. Lengths in metres."""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterable
from typing import TypeGuard

from ..errors import InputError

#: Edges of cells below this share of the mean diameter are collapsed: 0.35 mm for discs of 2-4 mm.
SHORT_EDGE = 0.35 / 3.0


def require_positive(where: str, **values: float) -> None:
    """Refuse lengths that are not finite and above zero [m]."""
    for name, value in values.items():
        if not _is_number(value) or not value > 0.0:
            raise InputError(f"{where}: {name} = {value} m, must be finite and > 0; correct it")


def require_porosity(where: str, porosity: object) -> float:
    """Return a porosity [-], which must be at least 0 and below 1."""
    if not (_is_number(porosity) and 0.0 <= porosity < 1.0):
        raise InputError(f"{where}: porosity = {porosity}, must be >= 0 and < 1; correct it")
    return float(porosity)


def require_diameters(where: str, diameters: object, room: float) -> tuple[float, float]:
    """Return smallest and largest diameter [m], which must be in order and fit the room [m]."""
    given = list(diameters) if isinstance(diameters, Iterable) else []
    if len(given) != 2:
        raise InputError(
            f"{where}: diameters = {diameters} m, must be two numbers; give smallest and largest"
        )
    smallest, largest = given
    require_positive(where, **{"smallest diameter": smallest, "largest diameter": largest})
    if smallest > largest:
        raise InputError(
            f"{where}: diameters = {smallest}, {largest} m, smallest must not exceed largest; "
            "swap them"
        )
    if largest > 0.5 * room:
        raise InputError(
            f"{where}: largest diameter = {largest} m, must be <= half the specimen's smallest "
            f"dimension, {0.5 * room:.6g} m; choose smaller discs"
        )
    return float(smallest), float(largest)


def require_seed(where: str, seed: object) -> int:
    """Return a seed, which must be a whole number of 64 bits."""
    if isinstance(seed, numbers.Integral) and not isinstance(seed, bool):
        number = int(seed)  # numpy's integers do not convert
        if 0 <= number < 2**64:
            return number
    raise InputError(f"{where}: seed = {seed}, must be a whole number >= 0 and < 2**64; change it")


def require_short_edge(share: float) -> None:
    """Refuse a share of the mean diameter outside [0, 0.5)."""
    if not _is_number(share) or not 0.0 <= share < 0.5:
        raise InputError(
            f"Specimen: short_edge = {share} mean diameters, must be >= 0 and < 0.5; "
            f"the default is {SHORT_EDGE:.4g}"
        )


def _is_number(value: object) -> TypeGuard[float]:
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    return math.isfinite(float(value))
