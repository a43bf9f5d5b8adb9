# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a material with their units and ranges, paper Sec. 3.2, and their checks. SI units."""

from __future__ import annotations

from collections.abc import Mapping

from ..errors import InputError
from ..files import Table
from ..require import Bounds, require_known, require_number

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
    "residual_friction": "-",
    "slip_length": "m",
    "softening": None,
    "plane": None,
    "weibull": "-",
}
CHOICES = {"softening": ("bilinear", "brittle"), "plane": ("stress", "strain")}
ELASTIC_KEYS = ("young", "poisson", "normal_stiffness", "shear_ratio")
COMMON_KEYS = tuple(key for key in UNITS if key not in ELASTIC_KEYS)
ENERGY_KEYS = ("tensile_fracture_energy", "shear_fracture_energy")
#: Keys of the friction after a crack, which are given together or not at all.
RESIDUAL_KEYS = ("residual_friction", "slip_length")
#: Keys that the rock has, and no mineral of its own.
ROCK_KEYS = ("plane", "weibull")
#: Elastic set that each model uses. YADE's own models bond the same discs as the rigid model.
ELASTIC_SET = {
    "flexible": "flexible",
    "rigid": "rigid",
    "inner": "inner",
    "inner-un": "inner",
    "jcfpm": "rigid",
    "cohfrict": "rigid",
}
#: Keys of the triangles alone, which rigid grains do not have.
_OF_TRIANGLES = ("young", "poisson", "plane")
#: Keys of softening, which the bonds of YADE's spheres do not have.
_OF_SOFTENING = (*ENERGY_KEYS, *RESIDUAL_KEYS, "softening")
#: Keys that a model does not use. The stiffness of inner particles is fitted to a rock's E and nu;
#: the bonds of YADE's spheres break without softening.
_UNUSED: dict[str, tuple[str, ...]] = {
    "flexible": (),
    "rigid": _OF_TRIANGLES,
    **dict.fromkeys(("inner", "inner-un"), ("plane",)),
    **dict.fromkeys(("jcfpm", "cohfrict"), (*_OF_TRIANGLES, *_OF_SOFTENING)),
}


def _around(magnitude: float) -> Bounds:
    return Bounds(above=0.0, at_least=1e-12 * magnitude, at_most=1e12 * magnitude)


#: Range of energies [N/m]; those of brittle softening follow from squares.
_ENERGY = Bounds(above=0.0, at_least=1e-40, at_most=1e40)
#: Range of the slip over which friction falls [m].
_SLIP = Bounds(above=0.0, at_least=1e-15, at_most=1e6)
#: Range of Weibull's modulus: below 1 the factors have no density at 0, above 1e6 no scatter.
MODULUS = Bounds(at_least=1.0, at_most=1e6)
#: Ranges of the keys: 1e-12 to 1e12 times a rock's, within which all sums are numbers.
_BOUNDS = {
    "young": _around(1e10),
    "poisson": Bounds(above=0.0, below=0.5),
    "normal_stiffness": _around(1e14),
    "shear_ratio": _around(1.0),
    "density": _around(1e3),
    "tensile_strength": _around(1e7),
    "cohesion": _around(1e7),
    "friction": Bounds(at_least=0.0, at_most=1e12),
    "tensile_fracture_energy": _ENERGY,
    "shear_fracture_energy": _ENERGY,
    "residual_friction": Bounds(at_least=0.0, at_most=1e12),
    "slip_length": _SLIP,
    "weibull": MODULUS,
}

#: Units of the keys of a joint; None marks true or false.
JOINT_UNITS: dict[str, str | None] = {
    "normal_stiffness": "Pa/m",
    "shear_stiffness": "Pa/m",
    "friction": "",
    "cohesion": "Pa",
    "tensile_strength": "Pa",
    "tensile_fracture_energy": "N/m",
    "shear_fracture_energy": "N/m",
    "dilation_angle": "degrees",
    "dilation_slip": "m",
    "residual_friction": "",
    "slip_length": "m",
    "open": None,
}
_STRENGTH = Bounds(at_least=0.0, at_most=1e19)
JOINT_BOUNDS = {
    "normal_stiffness": _around(1e14),
    "shear_stiffness": _around(1e14),
    "friction": _BOUNDS["friction"],
    "cohesion": _STRENGTH,
    "tensile_strength": _STRENGTH,
    "tensile_fracture_energy": _ENERGY,
    "shear_fracture_energy": _ENERGY,
    "dilation_angle": Bounds(at_least=0.0, below=90.0),
    "dilation_slip": Bounds(at_least=0.0, at_most=1e6),
    "residual_friction": _BOUNDS["residual_friction"],
    "slip_length": _SLIP,
}


def checked(key: str, value: object, where: str = "") -> float | str:
    """Return `value` of `key` as float or word, or raise InputError naming the broken rule."""
    if key in CHOICES:
        require_known(f"material {where}{key}", value, CHOICES[key])
        return str(value)
    unit = (UNITS[key] or "").removeprefix("-")
    return require_number(f"material {where}{key}", value, _BOUNDS[key], unit)


def check_residual(where: str, values: Mapping[str, object]) -> None:
    """Reject a friction that rises with slip, or one of the two keys without the other.

    Args:
        where: Beginning of the message.
        values: Values by key, with `friction` and both keys of the residual friction.

    Raises:
        InputError: naming the key.
    """
    given = [key for key in RESIDUAL_KEYS if values.get(key) is not None]
    if not given:
        return
    if len(given) == 1:
        (missing,) = {*RESIDUAL_KEYS} - {*given}
        raise InputError(
            f"{where} {missing} is missing; {given[0]} needs it, give both keys or none"
        )
    residual, friction = values["residual_friction"], values["friction"]
    assert isinstance(residual, float)
    assert isinstance(friction, float)
    if residual > friction:
        raise InputError(
            f"{where} residual_friction = {residual!r}, must be <= the friction {friction!r}; "
            "lower it, or raise the friction"
        )


def scaled(values: Mapping[str, object], ratio: float) -> Table:
    """Return values by key for grains whose diameters are multiplied by a ratio [-].

    If all lengths of a specimen are multiplied by s, it has the same stresses at the same strains
    under two conditions: stiffnesses of contacts per area are divided by s, and fracture energies
    and slip lengths are multiplied by s. Openings and slips are then multiplied by s. Other values
    do not change.
    """
    found: Table = dict(values)
    for key in (*ENERGY_KEYS, "slip_length"):
        if isinstance(found.get(key), int | float):
            found[key] *= ratio
    if isinstance(found.get("normal_stiffness"), int | float):
        found["normal_stiffness"] /= ratio
    return found


def is_used(key: str, model: str) -> bool:
    """Whether results of a model depend on a key of the rock, of a mineral or of an interface."""
    require_known("model", model, list(ELASTIC_SET))
    return key.rpartition(".")[2] not in _UNUSED[model]


def elastic_set_name(model: str) -> str:
    """Name of the elastic set that `model` uses."""
    require_known("model", model, list(ELASTIC_SET))
    return ELASTIC_SET[model]
