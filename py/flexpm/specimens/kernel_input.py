# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of user input of a specimen to arrays for the kernel. Lengths in metres."""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ParamSpec, TypeVar

import numpy as np
import numpy.typing as npt

from .._flexpm import Tessellation
from ..arrays import FloatArray, IntArray
from ..errors import InputError

Parameters = ParamSpec("Parameters")
Returned = TypeVar("Returned")


@dataclass(frozen=True)
class Circle:
    """Circular outline.

    Attributes:
        x: Centre [m].
        y: Centre [m].
        radius: Radius [m].
    """

    x: float
    y: float
    radius: float


def checksum(given: FloatArray | IntArray | Circle) -> str:
    """Return a short hash of numbers, with which files refer to long data."""
    plain = dataclasses.astuple(given) if isinstance(given, Circle) else given
    values = np.ascontiguousarray(plain, dtype=float)
    return hashlib.sha256(values.tobytes()).hexdigest()[:16]


def checksums_of_starts(given: IntArray, least: int) -> Iterator[str]:
    """`checksum` of the first numbers, of `least` of them and of each more."""
    values = np.ascontiguousarray(given, dtype=float)
    digest = hashlib.sha256(values[:least].tobytes())
    yield digest.hexdigest()[:16]
    for value in values[least:]:
        digest.update(value.tobytes())
        yield digest.hexdigest()[:16]


def cells_checksum(cells: Tessellation, grains: IntArray | None = None) -> str:
    """Short hash of the shapes of all cells, and of the grains that they are pieces of."""
    parts = [cells.vertices.ravel(), cells.cell_offsets, cells.cell_vertices]
    if grains is not None:
        parts.append(grains)
    return checksum(np.concatenate(parts).astype(float))


def call(
    function: Callable[Parameters, Returned],
    *arguments: Parameters.args,
    **options: Parameters.kwargs,
) -> Returned:
    """Call the kernel; its complaint about a value becomes an InputError."""
    try:
        return function(*arguments, **options)
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(error)) from None


def columns(discs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centres and radii of rows x, y, radius [m]."""
    return np.ascontiguousarray(discs[:, :2]), np.ascontiguousarray(discs[:, 2])


def disc_rows(centres: npt.ArrayLike, radii: npt.ArrayLike) -> FloatArray:
    """Rows x, y, radius of discs given as centres and radii [m]."""
    points = rows("Specimen.from_discs: centres", centres)
    try:
        sizes = np.array(radii, dtype=float)
    except (TypeError, ValueError):
        raise InputError(
            "Specimen.from_discs: radii are not numbers; give one per centre"
        ) from None
    if sizes.shape != (len(points),):
        raise InputError(
            f"Specimen.from_discs: radii = array of shape {sizes.shape}, must be one per centre, "
            f"{len(points)}; complete them"
        )
    return np.column_stack((points, sizes))


def rows(name: str, values: npt.ArrayLike) -> FloatArray:
    """Rows x, y of numbers; `name` is named in the message."""
    try:
        found = np.array(values, dtype=float, order="C")
    except (TypeError, ValueError):
        raise InputError(f"{name}: not numbers, must be rows x, y; correct them") from None
    if found.ndim != 2 or found.shape[1] != 2:
        raise InputError(f"{name} = array of shape {found.shape}, must be rows x, y; correct it")
    return found


def ring(name: str, values: npt.ArrayLike) -> FloatArray:
    """Corners x, y of a polygon; the first one again at the end, as in GeoJSON, is left out."""
    found = rows(name, values)
    return found[:-1] if len(found) > 1 and np.array_equal(found[0], found[-1]) else found


def mineral_indices(minerals: npt.ArrayLike, grains: int) -> IntArray:
    """Return the index of the mineral of each grain."""
    given = np.asarray(minerals)
    if given.shape != (grains,) or given.dtype.kind not in "iu" or given.min() < 0:
        raise InputError(
            f"Specimen.with_minerals: minerals = {given.dtype} array of shape {given.shape}, must "
            f"be {grains} indices from 0; give one per grain"
        )
    given = given.astype(np.int32)
    given.setflags(write=False)
    return given
