# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens and model for which a material was calibrated. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass

from ..errors import InputError
from ..files import Table
from ..require import POSITIVE, require_known, require_number, require_table
from .keys import ELASTIC_SET

_WHERE = "material made_for"
#: Dimensions of specimens, 2D first.
DIMENSIONS = ("2D", "3D")


def dimension_of(*, solid: bool) -> str:
    """Name of a dimension.

    Args:
        solid: Whether the specimen is 3D.
    """
    return DIMENSIONS[solid]


def stand_in(model: str) -> str:
    """Model whose calibrations `model` uses where it has none of its own.

    The presets are calibrated for flexible and for rigid grains. Inner particles and YADE's spheres
    use the strengths of rigid grains.
    """
    return "flexible" if model == "flexible" else "rigid"


@dataclass(frozen=True)
class MadeFor:
    """Specimens and model of a calibration. All values are checked on construction."""

    dimension: str  #: 2D or 3D
    model: str  #: name of the model
    mean_diameter: float | None = None  #: mean diameter of the grains [m]; None: unknown

    def __post_init__(self) -> None:
        require_known(f"{_WHERE} dimension", self.dimension, DIMENSIONS)
        require_known(f"{_WHERE} model", self.model, list(ELASTIC_SET))
        if self.mean_diameter is not None:
            diameter = require_number(f"{_WHERE} mean_diameter", self.mean_diameter, POSITIVE, "m")
            object.__setattr__(self, "mean_diameter", diameter)

    @classmethod
    def from_dict(cls, data: object) -> MadeFor:
        """Read a table ``made_for``.

        Raises:
            InputError: naming the key that is unknown, missing or out of range.
        """
        values = require_table(_WHERE, data)
        for key in values:
            require_known(f"{_WHERE} key", key, ("dimension", "model", "mean_diameter"))
        for key in ("dimension", "model"):
            if key not in values:
                raise InputError(f"{_WHERE} {key} is missing; give it, or leave out made_for")
        return cls(**values)

    def to_dict(self) -> Table:
        """Return the table, without the diameter if that is unknown."""
        return {key: value for key, value in asdict(self).items() if value is not None}

    def suits(self, model: str, *, solid: bool) -> bool:
        """Whether a run is of the dimension and the model of the calibration.

        Args:
            model: Model of the run. A calibration of the model's stand-in suits, too.
            solid: Whether its specimen is 3D.
        """
        models = (model, stand_in(model))
        return self.dimension == dimension_of(solid=solid) and self.model in models


def checked(made_for: object) -> MadeFor | None:
    """A calibration's specimens and model from a table, or as they are."""
    if made_for is None or isinstance(made_for, MadeFor):
        return made_for
    if isinstance(made_for, Mapping):
        return MadeFor.from_dict(made_for)
    raise InputError(f"{_WHERE} = {made_for!r}, must be a table; give dimension and model")
