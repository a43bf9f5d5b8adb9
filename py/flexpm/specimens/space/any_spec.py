# SPDX-License-Identifier: GPL-3.0-or-later
"""Specs of specimens of the plane and of space, told apart by their kind. SI units.

Nothing heavy is loaded here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

from dataclasses import fields

from ...dimensions import is_solid
from ...files import Table
from ..spec import SIZES as PLANE_SIZES
from ..spec import SpecimenSpec
from .spec import SIZES as SOLID_SIZES
from .spec import SolidSpec

#: What a specimen of any dimension is made from.
AnySpec = SpecimenSpec | SolidSpec

#: Sizes of each shape of any dimension and their defaults [m].
SIZES = {**PLANE_SIZES, **SOLID_SIZES}


def spec_type(kind: object) -> type[SpecimenSpec] | type[SolidSpec]:
    """Return the class of the specs of a kind; the 2D class for an unknown kind."""
    return SolidSpec if is_solid(kind) else SpecimenSpec


def field_names(kind: object) -> list[str]:
    """Names of the fields of a kind's specs."""
    return [field.name for field in fields(spec_type(kind))]


def spec_of(values: Table) -> AnySpec:
    """The spec that the fields of a file make.

    Raises:
        InputError: for a value out of range.
    """
    return spec_type(values.get("kind"))(**values)
