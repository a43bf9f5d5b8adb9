# SPDX-License-Identifier: GPL-3.0-or-later
"""What a test calls its stress, its strain and its measures, in tables and pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from ..arrays import FloatArray


class Columns(Protocol):
    """A record, as far as it is read here."""

    def __getitem__(self, name: str) -> FloatArray:
        """Values of a column."""


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

    def of(self, record: Columns) -> FloatArray:
        """Values of a record along the axis [`unit`]."""
        values: FloatArray = self.factor * record[self.column]
        return values


class Shown(NamedTuple):
    """A measure as tables of several runs show it."""

    factor: float
    heading: str
    digits: int


def strain(name: str) -> Drawn:
    """The record's strain under a name."""
    return Drawn("axial_strain", name, 100.0, "%")


def stress(name: str) -> Drawn:
    """The record's stress under a name."""
    return Drawn("axial_stress", name, 1e-6, "MPa")


#: Measures that count cracks, which all tests up to a peak have.
CRACKS = ("tensile_cracks", "shear_cracks")
#: Measures that a table of several runs may show, keys of result.json.
SHOWN = {
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


_STRAIN, _STRESS = strain("axial strain"), stress("axial stress")


@dataclass(frozen=True)
class Words:
    """Words of a test; those of the ends of a rectangle unless told otherwise."""

    x: Drawn = _STRAIN
    y: Drawn = _STRESS
    peak: str = "peak stress"  #: in a terminal
    #: in tables of several runs
    measures: tuple[str, ...] = (
        *("youngs_modulus", "poissons_ratio", "peak_stress", "peak_strain"),
        *CRACKS,
    )

    @property
    def shown(self) -> dict[str, Shown]:
        """Measures of tables of several runs, in their order."""
        return {name: SHOWN[name] for name in self.measures}

    def title(self, also: str = "") -> str:
        """Heading of a picture of the record, and of what it shows beside the test's own."""
        name = self.y.name if (self.y.column, self.y.unit) != ("axial_stress", "MPa") else "stress"
        return f"{name[0].upper()}{name[1:]}{also} over {self.over}"

    @property
    def over(self) -> str:
        """What is drawn along the axis x, in one word where it is a strain."""
        return self.x.name if (self.x.column, self.x.unit) != ("axial_strain", "%") else "strain"
