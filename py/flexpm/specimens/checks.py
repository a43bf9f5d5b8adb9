# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of what a specimen is made from: each refusal is one line. Lengths in metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..errors import InputError
from .packing import Frame

#: Edges of cells below this share of the mean diameter are collapsed: 0.35 mm for discs of 2-4 mm.
SHORT_EDGE = 0.35 / 3.0


def disc_rows(centres: Any, radii: Any) -> np.ndarray:
    """Rows x, y, radius of discs given as centres and radii [m]."""
    points = rows("Specimen.from_discs: centres", centres)
    try:
        sizes = np.array(radii, dtype=float)
    except (TypeError, ValueError):
        raise InputError("Specimen.from_discs: radii are no numbers; give one per centre") from None
    if sizes.shape != (len(points),):
        raise InputError(
            f"Specimen.from_discs: radii = array of shape {sizes.shape}, must be one per centre, "
            f"{len(points)}; complete them"
        )
    return np.column_stack((points, sizes))


def rows(name: str, values: Any) -> np.ndarray:
    """Rows x, y of numbers; `name` is named in the message."""
    try:
        rows = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{name}: not numbers, must be rows x, y; correct them") from None
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise InputError(f"{name} = array of shape {rows.shape}, must be rows x, y; correct it")
    return rows


def require_positive(where: str, **values: float) -> None:
    """Refuse lengths that are not finite and above zero [m]."""
    for name, value in values.items():
        if not _is_number(value) or not value > 0.0:
            raise InputError(f"{where}: {name} = {value} m, must be finite and > 0; correct it")


def require_number(where: str, **values: float) -> None:
    """Refuse what is not a finite number [-]."""
    for name, value in values.items():
        if not _is_number(value):
            raise InputError(f"{where}: {name} = {value}, must be a finite number; correct it")


def require_diameters(
    where: str, diameters: tuple[float, float], frame: Frame
) -> tuple[float, float]:
    """Return smallest and largest diameter [m], which must be in order and fit the frame."""
    try:
        smallest, largest = diameters
    except (TypeError, ValueError):
        raise InputError(
            f"{where}: diameters = {diameters} m, must be two numbers; give smallest and largest"
        ) from None
    require_positive(where, **{"smallest diameter": smallest, "largest diameter": largest})
    if smallest > largest:
        raise InputError(
            f"{where}: diameters = {smallest}, {largest} m, smallest must not exceed largest; "
            "swap them"
        )
    room = 2.0 * frame.radius if frame.radius else min(frame.width, frame.height)
    if largest > 0.5 * room:
        raise InputError(
            f"{where}: largest diameter = {largest} m, must be <= half the specimen's smallest "
            f"dimension, {0.5 * room:.6g} m; choose smaller discs"
        )
    return float(smallest), float(largest)


def require_seed(where: str, seed: int) -> None:
    """Refuse what is not an integer of 64 bits."""
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or not 0 <= seed < 2**64:
        raise InputError(
            f"{where}: seed = {seed}, must be a whole number >= 0 and < 2**64; change it"
        )


def require_short_edge(share: float) -> None:
    """Refuse a share of the mean diameter outside [0, 0.5)."""
    if not _is_number(share) or not 0.0 <= share < 0.5:
        raise InputError(
            f"Specimen: short_edge = {share} mean diameters, must be >= 0 and < 0.5; "
            f"the default is {SHORT_EDGE:.4g}"
        )


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.number)) and math.isfinite(value)
