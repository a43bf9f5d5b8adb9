# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of specimens of one dimension: those of the other raise an error of one line."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from ..dimensions import FEATURES, refused


def _missing(name: str, feature: str) -> Callable[..., NoReturn]:
    """A method that raises InputError.

    Args:
        name: Its name.
        feature: The feature that it asks for, a key of ``FEATURES``.
    """

    needed = f"must be {FEATURES[feature].dimension}D"

    def method(self: PlaneOnly | SolidOnly, *_: object, **__: object) -> NoReturn:
        raise refused(f"Specimen.{name}: specimen = {self.kind}, {needed}", feature)

    method.__name__ = name
    method.__doc__ = f"Raise InputError: {FEATURES[feature].refusal}."
    return method


class PlaneOnly:
    """Calls that a solid refuses."""

    @property
    def kind(self) -> str:
        """Shape of the specimen."""
        raise NotImplementedError

    joints_from_geojson = _missing("joints_from_geojson", "joint_maps")
    with_excavations = _missing("with_excavations", "excavation")
    excavation = _missing("excavation", "excavation")
    with_strengths = _missing("with_strengths", "strengths")
    with_weibull_strengths = _missing("with_weibull_strengths", "strengths")


class SolidOnly:
    """Calls that a 2D specimen refuses."""

    @property
    def kind(self) -> str:
        """Shape of the specimen."""
        raise NotImplementedError

    joints_from_dfnworks = _missing("joints_from_dfnworks", "dfnworks")
    without_grains = _missing("without_grains", "removed_grains")
    with_holes = _missing("with_holes", "holes")
