# SPDX-License-Identifier: GPL-3.0-or-later
"""Inner-particle model: grains of about 26 bonded discs, paper Sec. 4.1, Fig. 5(e). SI units.

Discs of one grain are bonded elastically, those of two grains by the bilinear law over the stretch
of the grains' edge that they share. All contacts have the stiffness of the material's inner set,
which is fitted so that the specimen has the elastic constants of the rock, unless the set has none.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy.optimize import root_scalar

from .._flexpm import AssemblyInput, InnerCells, inner_cells
from ..errors import InputError
from ..materials.material import Material
from .specimen import Specimen

#: Poisson's ratio is met within this [-].
_TOLERANCE = 1e-3
#: About how fast Poisson's ratio falls with k_s / k_n, for the first guess [-].
_SLOPE = -0.45
_MOST_SOLVES = 12
#: Width of a specimen that stands in for a disc in the fit, in mean diameters of grains.
_ACROSS = 14.0


def cells(specimen: Specimen) -> InnerCells:
    """Cut the grains of a specimen into the cells of their inner particles."""
    return inner_cells(specimen.tessellation)


def tell(cells: AssemblyInput, inner: InnerCells, model: str) -> None:
    """Tell contacts between grains from those within."""
    cells.parent = np.ascontiguousarray(inner.grain, dtype=np.int32)
    cells.outer = np.ascontiguousarray(inner.outer, dtype=np.int32)
    cells.edge_normals = model == "inner-un"


def rectangle_like(specimen: Specimen) -> Specimen:
    """Return a rectangle of grains as in another specimen, to measure its elastic constants."""
    side = _ACROSS * specimen.mean_diameter
    diameters = (2.0 * float(specimen.radii.min()), 2.0 * float(specimen.radii.max()))
    seed = 0 if specimen.seed is None else specimen.seed
    return Specimen.rectangle(
        side, 2.0 * side, specimen.thickness, diameters, seed=seed, short_edge=specimen.short_edge
    )


def fitted(material: Material, solve: Callable[[Material], tuple[float, float]]) -> Material:
    """Fit stiffness and shear ratio of a material's inner set to the rock's elastic constants.

    These are the set's `young` and `poisson`; without them it is used as it is. Poisson's ratio
    depends on the shear ratio alone, and the modulus is proportional to the stiffness: one root is
    sought, the stiffness follows.

    Args:
        material: With an inner set, whose values are the start.
        solve: Young's modulus [Pa] and Poisson's ratio [-] of the specimen with a material.

    Returns:
        The material with the fitted set.

    Raises:
        InputError: if no shear ratio gives the Poisson's ratio.
    """
    start = material.elastic["inner"]
    modulus, ratio = start.young, start.poisson
    if modulus is None or ratio is None:
        _refuse_half(modulus, ratio)
        return material
    found: dict[float, tuple[float, float]] = {}

    def excess(shear_ratio: float) -> float:
        if not shear_ratio > 0.0:
            raise InputError(_no_fit(ratio, found))
        found[shear_ratio] = solve(_with(material, shear_ratio=shear_ratio))
        error = found[shear_ratio][1] - ratio
        return 0.0 if abs(error) < _TOLERANCE else error

    first = excess(start.shear_ratio)
    if first != 0.0:
        second = max(start.shear_ratio - first / _SLOPE, 0.2 * start.shear_ratio)
        root_scalar(excess, method="secant", x0=start.shear_ratio, x1=second, maxiter=_MOST_SOLVES)
    best = min(found, key=lambda shear_ratio: abs(found[shear_ratio][1] - ratio))
    if abs(found[best][1] - ratio) >= _TOLERANCE:
        raise InputError(_no_fit(ratio, found))
    stiffness = start.normal_stiffness * modulus / found[best][0]
    return _with(material, shear_ratio=best, normal_stiffness=stiffness)


def _with(material: Material, **values: float) -> Material:
    inner = dataclasses.replace(material.elastic["inner"], **values)
    return dataclasses.replace(material, elastic={**material.elastic, "inner": inner})


def _refuse_half(modulus: float | None, ratio: float | None) -> None:
    if modulus is not None or ratio is not None:
        missing = "young" if modulus is None else "poisson"
        raise InputError(
            f"material [elastic.inner] {missing} is missing; a fit of the stiffness needs young "
            "and poisson, without a fit give neither"
        )


def _no_fit(ratio: float, found: dict[float, tuple[float, float]]) -> str:
    ratios = [poisson for _, poisson in found.values()]
    return (
        f"build: poisson = {ratio}, cannot be met by inner particles, which reach from "
        f"{min(ratios):.3f} to {max(ratios):.3f}; change poisson in [elastic.inner]"
    )
