# SPDX-License-Identifier: GPL-3.0-or-later
"""Exponents of measures in the keys of a material: d ln(measure) / d ln(key) [-].

``scripts/studies/exponents.py`` has measured them about one material, on small specimens. They hold
near this material, and near every material that is similar to it: strengths times k, elastic moduli
and stiffnesses times e, energies times k^2 / e.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...files import Table, load_toml
from ...materials.keys import elastic_set_name
from ...materials.material import Material

#: Table that the script has made.
FILE = Path(__file__).with_name("exponents.toml")
#: Keys that are named for a measure: at most so many, with exponents from this size on [-] that
#: exceed their standard error by this factor.
_MOST, _LEAST, _SIGMAS = 3, 0.1, 2.0
#: Largest factor between the ratios of materials that are near each other [-].
_ALIKE = 2.0


@dataclass(frozen=True)
class Exponent:
    """Exponent of a measure in a key."""

    value: float
    error: float | None = None  #: standard error, from the scatter of the packings; None: unknown

    @property
    def clear(self) -> float:
        """The exponent, 0 within its scatter."""
        return self.value if abs(self.value) >= _SIGMAS * (self.error or 0.0) else 0.0


@dataclass(frozen=True)
class Exponents:
    """Exponents about a material.

    Attributes:
        model: Name of the model.
        dimension: Dimension of the specimens: 2D or 3D.
        step: Relative change of the keys with which they were measured [-].
        material: Content of the material's file.
        measures: Measures of the material itself, by their names in a scorecard.
        of: Exponents by measure and key.
    """

    model: str
    dimension: str
    step: float
    material: Table
    measures: Mapping[str, float]
    of: Mapping[str, Mapping[str, Exponent]]

    def text(self, measure: str) -> str:
        """Return the keys that change a measure most, with their exponents; empty if none does."""
        known = [(key, one.clear) for key, one in self.of.get(measure, {}).items()]
        known = sorted(
            (one for one in known if abs(one[1]) >= _LEAST), key=lambda one: -abs(one[1])
        )
        return ", ".join(f"{key} {value:+.2f}" for key, value in known[:_MOST])

    def holds_for(self, material: Material) -> bool:
        """Whether a material has about the ratios of the measured one, up to `_ALIKE`."""
        own, other = (_ratios(one, self.model) for one in (self.measured, material))
        return all(
            one is not None and two is not None and max(one / two, two / one) <= _ALIKE
            for one, two in zip(own, other, strict=True)
        )

    @property
    def measured(self) -> Material:
        """The material about which the exponents were measured."""
        return Material.from_dict(self.material)


def _ratios(material: Material, model: str) -> tuple[float | None, ...]:
    """Return the ratios that similar materials share."""
    law = material.elastic[elastic_set_name(model)]
    stiffness, strength = law.normal_stiffness, material.tensile_strength
    energies = (material.tensile_fracture_energy, material.shear_fracture_energy)
    return (
        material.cohesion / strength,
        material.friction,
        *(None if one is None else one * stiffness / strength**2 for one in energies),
        None if law.young is None else stiffness / law.young,
        material.weibull,
    )


def load(model: str, dimension: str) -> Exponents | None:
    """Return the exponents of a model in a dimension; None if they were not measured."""
    content = load_toml(FILE, "exponents")
    if (content["model"], content["dimension"]) != (model, dimension):
        return None
    of = {
        measure: {key: Exponent(*map(float, one)) for key, one in keys.items()}
        for measure, keys in content["exponents"].items()
    }
    measures, material = content["measures"], content["material"]
    return Exponents(model, dimension, content["step"], material, measures, of)
