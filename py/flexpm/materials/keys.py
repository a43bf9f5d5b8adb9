# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a material with their units and ranges, paper Sec. 3.2, and their checks. SI units."""

from __future__ import annotations

import difflib
import math
import numbers
from collections.abc import Sequence

from ..errors import InputError

#: Unit of each key; None marks the keys that take one of a few words.
UNITS: dict[str, str | None] = {
    "young": "Pa",
    "poisson": "-",
    "normal_stiffness": "Pa/m",
    "shear_ratio": "-",
    "density": "kg/m3",
    "tensile_strength": "Pa",
    "cohesion": "Pa",
    "friction": "-",
    "tensile_fracture_energy": "N/m",
    "shear_fracture_energy": "N/m",
    "softening": None,
    "plane": None,
}
CHOICES = {"softening": ("bilinear", "brittle"), "plane": ("stress", "strain")}
ELASTIC_KEYS = ("young", "poisson", "normal_stiffness", "shear_ratio")
COMMON_KEYS = tuple(key for key in UNITS if key not in ELASTIC_KEYS)
ENERGY_KEYS = ("tensile_fracture_energy", "shear_fracture_energy")
#: Elastic set that each model uses. YADE's own models bond the same discs as the rigid model.
ELASTIC_SET = {
    "flexible": "flexible",
    "rigid": "rigid",
    "inner": "inner",
    "inner-un": "inner",
    "jcfpm": "rigid",
    "cohfrict": "rigid",
}


def checked(key: str, value: object, where: str = "") -> float | str:
    """Return `value` of `key` as float or word, or raise InputError naming the broken rule."""
    if key in CHOICES:
        check_name(f"material {where}{key}", value, list(CHOICES[key]))
        return str(value)
    label = f"material {where}{key} = {value!r} {UNITS[key]}".removesuffix(" -")
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise InputError(f"{label}, must be a number")
    try:
        number = float(value)
    except OverflowError:  # an integer beyond the largest double
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{label}, must be finite")
    if key == "poisson" and not 0.0 < number < 0.5:
        raise InputError(f"{label}, must lie between 0 and 0.5, both excluded")
    if key == "friction" and number < 0.0:
        raise InputError(f"{label}, must be >= 0")
    if key != "friction" and number <= 0.0:
        raise InputError(f"{label}, must be > 0")
    return number


def check_name(label: str, name: object, known: Sequence[str]) -> None:
    """Raise InputError, with the nearest known name, unless `name` is one of `known`."""
    if name not in known:
        raise InputError(
            f"{label} = {name!r}, unknown{nearest(str(name), known)}; known are {', '.join(known)}"
        )


def elastic_set_name(model: str) -> str:
    """Name of the elastic set that `model` uses."""
    check_name("model", model, list(ELASTIC_SET))
    return ELASTIC_SET[model]


def nearest(name: str, known: Sequence[str]) -> str:
    """Return ' (did you mean X?)' for the known name closest to `name`, or an empty text."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else ""
