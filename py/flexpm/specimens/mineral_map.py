# SPDX-License-Identifier: GPL-3.0-or-later
"""Which grain is of which mineral. Sizes are areas in m2, of solids volumes in m3."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import Table
from ..materials.material import Material
from ..materials.mixing import description
from .specimen import AnySpecimen

#: Keeps the draw of minerals apart from other draws with the same seed.
_STREAM = 27


def assign(fractions: Sequence[float], areas: FloatArray, seed: int) -> IntArray:
    """Draw a mineral for each grain so that the minerals have their fractions of the area.

    Grains in random order are cut where the fractions end: each cut is off by half a grain at most.

    Args:
        fractions: Fraction of each mineral [-], sum 1.
        areas: Area of each grain [m2].
        seed: The same seed draws the same.

    Returns:
        Index of the mineral of each grain.
    """
    areas = np.asarray(areas, dtype=float)
    order = np.random.default_rng([_STREAM, seed]).permutation(len(areas))
    covered = np.cumsum(areas[order])
    ends = np.cumsum(fractions)[:-1] * covered[-1]
    # a grain belongs to where its middle lies
    found = np.empty(len(areas), dtype=np.int32)
    found[order] = np.searchsorted(ends, covered - 0.5 * areas[order])
    return found


def minerals_of(specimen: AnySpecimen, material: Material) -> IntArray | None:
    """Index of the mineral of each grain, or None for a rock of one kind of grain.

    Minerals of the specimen are used if it has them. Otherwise they are sampled with the seed of
    the specimen (0 without a seed).

    Raises:
        InputError: if the specimen has more minerals than the material, or names a mineral that
            has another index in the material.
    """
    if specimen.before is not None and specimen.parents is not None:
        before = minerals_of(specimen.before, material)  # pieces of a grain are of its mineral
        return None if before is None else np.ascontiguousarray(before[specimen.parents])
    given, count = specimen.minerals, len(material.minerals)
    most = 0 if given is None else int(given.max())
    if most > 0 and most >= count:  # grains of the first mineral alone need no table
        order = ", ".join(specimen.mineral_names)
        raise InputError(
            f"specimen minerals = {most}, must be below the number of minerals of "
            f"{material.name}, {count}; give it more [[mineral]] tables"
            + (f", in the order {order}" if order else "")
        )
    if count == 0:
        return None
    if given is not None:
        names = [mineral.name for mineral in material.minerals]
        for place, name in enumerate(specimen.mineral_names):
            if name in names and names.index(name) != place:
                raise InputError(
                    f"specimen mineral {place + 1} = {name}, is mineral {names.index(name) + 1} of "
                    f"{material.name}; give its [[mineral]] tables the order "
                    f"{', '.join(specimen.mineral_names)}"
                )
        return given
    fractions = [mineral.fraction for mineral in material.minerals]
    areas = specimen.cell_sizes
    if specimen.grains is None:
        return assign(fractions, areas, specimen.seed or 0)
    # pieces of a grain are of its mineral
    found = assign(fractions, np.bincount(specimen.grains, areas).astype(float), specimen.seed or 0)
    whole: IntArray = found[specimen.grains]
    return whole


def size_fractions(specimen: AnySpecimen, found: IntArray, count: int) -> list[float]:
    """Fraction of the area, or of the volume, that each of `count` minerals has [-]."""
    areas = specimen.cell_sizes
    found_areas = np.bincount(found, weights=areas, minlength=count)
    return [float(area) for area in found_areas / areas.sum()]


def describe(
    specimen: AnySpecimen,
    material: Material,
    model: str,
    minerals: IntArray | None,
) -> Table:
    """Name and parameters of a material, of minerals also the area or volume that they have.

    Args:
        specimen: The grains.
        material: Their material.
        model: Name of the model.
        minerals: Index of each grain's mineral, or None if all grains are alike.
    """
    found: Table = {"name": material.name, **description(material, model)}
    if minerals is not None:
        kinds = found["minerals"]
        name = f"{specimen.size_name}_fraction"
        for kind, part in zip(kinds, size_fractions(specimen, minerals, len(kinds)), strict=True):
            kind[name] = part
    return found
