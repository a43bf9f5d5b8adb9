# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of a 2D specimen that a solid does not have: each raises an error of one line."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from ...errors import InputError


def _missing(name: str, what: str) -> Callable[..., NoReturn]:
    """A method that raises InputError.

    Args:
        name: Its name.
        what: What it would give the specimen.
    """

    def method(self: PlaneOnly, *_: object, **__: object) -> NoReturn:
        raise InputError(
            f"Specimen.{name}: specimen = {self.kind}, must be 2D: {what} are available in 2D "
            "only; leave them out or take a 2D specimen"
        )

    method.__name__ = name
    method.__doc__ = f"Raise InputError: {what} are available in 2D only."
    return method


class PlaneOnly:
    """What a solid refuses."""

    @property
    def kind(self) -> str:
        """Shape of the specimen."""
        raise NotImplementedError

    with_joints = _missing("with_joints", "joints")
    joints_from_csv = _missing("joints_from_csv", "joints")
    joints_from_geojson = _missing("joints_from_geojson", "joints")
    with_network = _missing("with_network", "fracture networks")
    with_excavations = _missing("with_excavations", "excavations")
    excavation = _missing("excavation", "excavations")
    with_strengths = _missing("with_strengths", "strengths of single contacts")
    with_weibull_strengths = _missing("with_weibull_strengths", "strengths of single contacts")
