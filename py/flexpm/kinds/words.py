# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of stress, strain and measures of a test, in tables and plots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from ..arrays import FloatArray


class Columns(Protocol):
    """Protocol of a record: access to its columns."""

    def __getitem__(self, name: str) -> FloatArray:
        """Return the values of a column."""


class Drawn(NamedTuple):
    """A column of the record as an axis of a plot."""

    column: str
    name: str
    factor: float = 1.0  #: from SI's unit to `unit`
    unit: str = "-"

    @property
    def label(self) -> str:
        """Label of the axis."""
        return f"{self.name} [{self.unit}]"

    def of(self, record: Columns) -> FloatArray:
        """Return the values of a record along the axis [`unit`]."""
        values: FloatArray = self.factor * record[self.column]
        return values


class Shown(NamedTuple):
    """Format of a measure in tables of several runs."""

    factor: float
    heading: str
    digits: int


def strain(name: str) -> Drawn:
    """Return the axis of the record's strain, with a name."""
    return Drawn("axial_strain", name, 100.0, "%")


def stress(name: str) -> Drawn:
    """Return the axis of the record's stress, with a name."""
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
    """Words of a test; the defaults are the words of a test between the ends of a rectangle."""

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
        """Measures in tables of several runs, in their order."""
        return {name: SHOWN[name] for name in self.measures}

    def title(self, also: str = "") -> str:
        """Return the heading of a plot of the record; `also` names additional quantities."""
        name = self.y.name if (self.y.column, self.y.unit) != ("axial_stress", "MPa") else "stress"
        return f"{name[0].upper()}{name[1:]}{also} over {self.over}"

    @property
    def over(self) -> str:
        """Name of the quantity along the axis x; ``strain`` for a strain in percent."""
        return self.x.name if (self.x.column, self.x.unit) != ("axial_strain", "%") else "strain"
