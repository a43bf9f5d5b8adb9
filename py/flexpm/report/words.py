# SPDX-License-Identifier: GPL-3.0-or-later
"""What each test calls its stress, its strain and its measures, in tables and pictures.

Nothing heavy is loaded here: the command writes tables.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ..arrays import FloatArray
    from ..results.record import Curve


class Drawn(NamedTuple):
    """A column of the record as an axis of a picture."""

    column: str
    name: str
    factor: float = 1.0  #: from SI's unit to `unit`
    unit: str = "-"

    @property
    def label(self) -> str:
        """Label of the axis."""
        return f"{self.name} [{self.unit}]"

    def of(self, record: Curve) -> FloatArray:
        """Values of a record along the axis [`unit`]."""
        values: FloatArray = self.factor * record[self.column]
        return values


class Shown(NamedTuple):
    """A measure as tables of several runs show it."""

    factor: float
    heading: str
    digits: int


def _strain(name: str) -> Drawn:
    return Drawn("axial_strain", name, 100.0, "%")


def _stress(name: str) -> Drawn:
    return Drawn("axial_stress", name, 1e-6, "MPa")


_AXIAL_STRAIN, _AXIAL_STRESS = _strain("axial strain"), _stress("axial stress")
_USUAL = ("youngs_modulus", "poissons_ratio", "peak_stress", "peak_strain")
_CRACKS = ("tensile_cracks", "shear_cracks")
_FRACTURE = ("peak_load", "fracture_toughness", "fracture_energy")
_SHOWN = {
    "youngs_modulus": Shown(1e-9, "E [GPa]", 4),
    "poissons_ratio": Shown(1.0, "nu", 3),
    "peak_stress": Shown(1e-6, "peak [MPa]", 4),
    "peak_strain": Shown(100.0, "strain [%]", 3),
    "tensile_cracks": Shown(1.0, "tensile", 4),
    "shear_cracks": Shown(1.0, "shear", 4),
    "peak_load": Shown(1e-3, "peak [kN]", 4),
    "fracture_toughness": Shown(1e-6, "K_I [MPa m^0.5]", 4),
    "fracture_energy": Shown(1.0, "G [J/m2]", 4),
    "residual_strength": Shown(1e-6, "residual [MPa]", 4),
    "vp": Shown(1.0, "v_p [m/s]", 5),
    "vs": Shown(1.0, "v_s [m/s]", 5),
}


@dataclass(frozen=True)
class Words:
    """Words of a test; those of the ends of a rectangle unless told otherwise."""

    x: Drawn = _AXIAL_STRAIN
    y: Drawn = _AXIAL_STRESS
    peak: str = "peak stress"  #: in a terminal
    measures: tuple[str, ...] = (*_USUAL, *_CRACKS)  #: in tables of several runs

    @property
    def shown(self) -> dict[str, Shown]:
        """Measures of tables of several runs, in their order."""
        return {name: _SHOWN[name] for name in self.measures}

    def title(self, also: str = "") -> str:
        """Heading of a picture of the record, and of what it shows beside the test's own."""
        name = self.y.name if self.y.column != "axial_stress" else "stress"
        return f"{name[0].upper()}{name[1:]}{also} over {self.over}"

    @property
    def over(self) -> str:
        """What is drawn along the axis x, in one word where it is a strain."""
        return self.x.name if self.x.column != "axial_strain" else "strain"


_BEAM = Words(
    _strain("strain of the outer fibre"),
    _stress("bending stress"),
    "peak bending stress",
    (*_FRACTURE, "peak_stress", "peak_strain", *_CRACKS),
)
_OTHERS = {
    "brazilian": Words(
        _strain("closure of the plates / D"),
        _stress("stress 2 P / (π D t)"),
        "peak of 2 P / (pi D t)",
    ),
    "bending": _BEAM,
    "scb": _BEAM,
    "shear": Words(
        Drawn("displacement", "displacement", 1e6, "µm"),
        _stress("shear stress"),
        "peak shear stress",
        ("peak_stress", "residual_strength", *_CRACKS),
    ),
    "sonic": Words(
        Drawn("time", "time", 1e6, "µs"),
        Drawn("far_displacement", "displacement of the upper section", 1e9, "nm"),
        measures=("vp", "vs"),
    ),
}


def words_of_test(test: str) -> Words:
    """Words of a test, by its name."""
    return _OTHERS.get(test, Words())
