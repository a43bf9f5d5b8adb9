# SPDX-License-Identifier: GPL-3.0-or-later
"""Material from which the calibration of a rock begins: by similarity, then by exponents.

A material is similar to another one if its strengths are multiplied by k, its moduli and
stiffnesses by e, and its energies by k^2 / e. All stresses are then multiplied by k, Young's
modulus by e and the strains by k / e; quotients, angles and Poisson's ratio stay. SI units.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear

from ...materials.keys import ELASTIC_KEYS, ENERGY_KEYS, elastic_set_name
from ...materials.material import Material
from ...materials.material import load as load_material
from ...materials.references import reference_of
from ..calibration_measures import ELASTIC_MEASURES
from ..scorecards import exponents
from ..scorecards.exponents import Exponents
from ..scorecards.measures import MEASURES
from ..scorecards.rock import Entry, Rock
from .aims import Aim, rounded

#: Calibrated presets by dimension and model.
_PRESETS = {
    ("2D", "flexible"): "augig-calibrated",
    ("2D", "rigid"): "augig-calibrated-rigid",
    ("3D", "flexible"): "augig3d-calibrated",
    ("3D", "rigid"): "augig3d-calibrated-rigid",
}
#: Elastic keys that scale with Young's modulus.
_SCALED = ("young", "normal_stiffness")
_MODULUS, _STRENGTH = "youngs_modulus", "compressive_strength"
#: Largest factor on a key of the step by exponents, and change of a key that costs as much as a
#: deviation from a target by its tolerance, as logarithms.
_LARGEST, _SCATTER = math.log(2.0), 0.5
#: Least tolerance of a target in the step [-]: exponents are no better.
_TOLERANCE = 0.02


@dataclass(frozen=True)
class Origin:
    """A material that was measured.

    Attributes:
        material: The material.
        measures: Measures of it, by their names in a scorecard.
        exponents: Exponents about it, or None.
    """

    material: Material
    measures: Mapping[str, float]
    exponents: Exponents | None


#: Measures over a fixed strain after the peak.
_OF_A_WINDOW = ("drop_", "dilation_")


@dataclass(frozen=True)
class Start:
    """A material from which a calibration begins.

    Attributes:
        origin: The material that it is similar to, before the step by exponents.
        values: Values of its keys.
        factors: Factors on strengths (k) and on moduli (e) [-].
        steps: Factors on keys by the exponents [-].
    """

    origin: Origin
    values: dict[str, float]
    factors: tuple[float, float]
    steps: dict[str, float]


def origin(dimension: str, model: str) -> Origin:
    """Return the material with exponents of a model in a dimension, else the calibrated preset."""
    known = exponents.load(model, dimension)
    if known is not None:
        return Origin(Material.from_dict(known.material), known.measures, known)
    material = load_material(_PRESETS[dimension, model])
    rock = reference_of(material.name)
    assert rock is not None  # the presets are named after rocks
    measures = {_MODULUS: rock.youngs_modulus, _STRENGTH: rock.compressive_strength}
    return Origin(material, measures, None)


def start(
    source: Origin, model: str, rock: Rock, aims: Sequence[Aim], keys: Sequence[str]
) -> Start:
    """Return the start for a rock.

    Args:
        source: A material that was measured.
        model: Name of the model.
        rock: The rock; moduli stay if it has no Young's modulus.
        aims: Targets.
        keys: Keys that the step by exponents may change.
    """
    k = rock.compressive_strength / source.measures[_STRENGTH]
    young = rock.entries.get(_MODULUS, Entry()).value
    e = 1.0 if young is None else young / source.measures[_MODULUS]
    values = similar(source.material, model, k, e)
    steps = {} if source.exponents is None else _steps(source.exponents, (k, e), aims, keys)
    for key, factor in steps.items():
        values[key] *= factor
    return Start(source, {key: rounded(one) for key, one in values.items()}, (k, e), steps)


def similar(material: Material, model: str, k: float, e: float) -> dict[str, float]:
    """Return the values of a material whose stresses are k times and whose moduli are e times."""
    chosen = material.elastic[elastic_set_name(model)]
    elastic = {key: getattr(chosen, key) for key in ELASTIC_KEYS}
    values = {
        "tensile_strength": material.tensile_strength * k,
        "cohesion": material.cohesion * k,
        "friction": material.friction,
        **{key: (getattr(material, key) or 0.0) * k * k / e for key in ENERGY_KEYS},
        "slip_length": (material.slip_length or 0.0) * k / e,
        "weibull": material.weibull,
        **{key: one * e if one and key in _SCALED else one for key, one in elastic.items()},
    }
    found = {key: one for key, one in values.items() if one}
    if material.residual_friction is not None:
        found["residual_friction"] = material.residual_friction
    return found


def expected(measure: str, value: float, factors: tuple[float, float]) -> float:
    """Return a measure of a similar material from that of the material itself."""
    k, e = factors
    if measure == _MODULUS:
        return value * e
    return value * k if MEASURES[measure].unit.startswith("Pa") else value


def without_exponents(known: Exponents, aims: Sequence[Aim], keys: Sequence[str]) -> list[str]:
    """Return the measures that the step leaves out, as exponents of some keys are missing."""
    used = [key for key in keys if key in _measured(known)]
    names = [aim.measure for aim in aims if aim.measure not in ELASTIC_MEASURES]
    return [name for name in names if not _moves(known, name, used)]


def _moves(known: Exponents, measure: str, keys: Sequence[str]) -> bool:
    """Whether the step takes a measure: all exponents are known, and some are beyond their scatter.

    Drops and dilations are no similar measures: they are taken over a fixed strain.
    """
    of = known.of.get(measure, {})
    if measure.startswith(_OF_A_WINDOW) or not all(key in of for key in keys):
        return False
    return any(of[key].clear for key in keys)


def _measured(known: Exponents) -> set[str]:
    """Return the keys whose exponents were measured in more than the elastic solution."""
    return {key for name, of in known.of.items() if name not in ELASTIC_MEASURES for key in of}


def _steps(
    known: Exponents, factors: tuple[float, float], aims: Sequence[Aim], keys: Sequence[str]
) -> dict[str, float]:
    """Return factors on keys that bring the measures to their targets, by linear least squares.

    Of several changes that do so about equally well it is the smallest one. Exponents within their
    scatter count as 0. The elastic targets take no part, since the elastic keys meet them whatever
    the other keys are.
    """
    keys = [key for key in keys if key in _measured(known)]
    rows, wanted = [], []
    for aim in aims:
        name = aim.measure
        if name in ELASTIC_MEASURES or not _moves(known, name, keys):
            continue
        of = known.of[name]
        found = expected(name, known.measures[name], factors)
        if found <= 0.0 or (aim.target.least and found >= aim.measured):
            continue
        tolerance = max(aim.target.tolerance, _TOLERANCE)
        rows.append([of[key].clear / tolerance for key in keys])
        wanted.append(math.log(aim.measured / found) / tolerance)
    if not rows:
        return {}
    matrix = np.vstack([rows, np.eye(len(keys)) / _SCATTER])
    aimed = np.concatenate([wanted, np.zeros(len(keys))])
    found = lsq_linear(matrix, aimed, bounds=(-_LARGEST, _LARGEST)).x
    return {key: math.exp(one) for key, one in zip(keys, found.tolist(), strict=True)}
