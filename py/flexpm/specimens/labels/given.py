# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains from an array of labels: checks of the arguments, and division of the image into cells."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...arrays import BoolArray, FloatArray, IntArray
from ...errors import InputError
from ...files import Table
from ...require import Bounds, require_number, require_whole
from ..checks import require_length
from . import regions
from .chains import Network
from .loops import divided
from .measures import of_image
from .smoothing import smooth
from .whole import KINDS, whole_numbers

_WHERE = "Specimen.from_labels"
#: Pixels of an image; one takes about 200 bytes.
MOST_PIXELS = 20_000_000
#: Grains of an image.
MOST_GRAINS = 100_000
#: Why a file or an array of three dimensions is refused.
NO_VOLUMES = "flexpm specimen volume reads volumes"
#: Default spacing of corners over the mean diameter of the grains [-], and the least one [pixels].
_EDGE, LEAST_EDGE = 0.25, 2.0
#: Least parts of their convex hulls that pieces fill [-]: the next one if no mesh fits the pieces.
FILLS = (0.6, 0.75, 0.9)


@dataclass(frozen=True)
class Division:
    """Pieces of grains into which an image is divided.

    Attributes:
        polygons: Corners of each piece, counter-clockwise, (n, 2) [m]. The first piece of each
            grain comes first, in the order of the grains.
        grains: Grain of each piece.
        labels: Label of each grain.
        pixels: Number of pixels of each grain.
        minerals: Index of each grain's mineral; None without minerals.
        edge: Spacing of corners [m].
        has_holes: Whether some pixels belong to no grain.
        counts: Numbers of regions and pixels that were reassigned, by reason.
        source: Figures of the regions of the image itself, see ``measures.of_image``.
    """

    polygons: list[FloatArray]
    grains: IntArray
    labels: IntArray
    pixels: IntArray
    minerals: IntArray | None
    edge: float
    has_holes: bool
    counts: dict[str, int]
    source: Table


def divide(
    labels: npt.ArrayLike,
    pixel: float | tuple[float, float],
    *,
    minerals: Mapping[int, int | None] | None = None,
    edge: float | None = None,
    smallest: int = 4,
    smoothed: bool = True,
    least_fill: float = FILLS[0],
) -> Division:
    """Divide an image of labels into pieces of grains, see `Specimen.from_labels`.

    Args:
        labels: As for `Specimen.from_labels`.
        pixel: As for `Specimen.from_labels`, or width and height of a pixel [m].
        minerals: As for `Specimen.from_labels`.
        edge: As for `Specimen.from_labels` [m].
        smallest: As for `Specimen.from_labels`.
        smoothed: Smooth the boundaries. False: they follow the edges of pixels.
        least_fill: Smallest ratio of a piece's area to the area of its convex hull [-].

    Returns:
        The pieces.

    Raises:
        InputError: as `Specimen.from_labels`.
    """
    image: IntArray = np.ascontiguousarray(whole_labels(labels)[::-1])  # the lowest row first
    sides = pixel if isinstance(pixel, tuple) else (pixel, pixel)
    for side in sides:
        require_length(_WHERE, "pixel", side)
    size = math.sqrt(sides[0] * sides[1])
    require_whole(f"{_WHERE}: smallest", smallest, Bounds(at_least=1, at_most=MOST_PIXELS))
    kinds = None if minerals is None else _minerals(minerals, image)
    holes = _holes(image, kinds)
    found = regions.find(image, holes, smallest, _phases(kinds))
    if found.number > MOST_GRAINS:
        raise InputError(
            f"{_WHERE}: grains = {found.number}, must be <= {MOST_GRAINS}; raise smallest or cut "
            "the image"
        )
    pieces, grains = divided(found, least_fill)
    sizes: IntArray = np.bincount(found.image[found.image >= 0])
    asked = (
        None
        if edge is None
        else require_number(f"{_WHERE}: edge", edge, Bounds(at_least=LEAST_EDGE * size), "m")
    )
    mean = float(np.mean(np.sqrt(4.0 / math.pi * sizes)))
    spacing = max(LEAST_EDGE, _EDGE * mean) if asked is None else asked / size
    network = Network.of(pieces)
    lines = smooth(network, spacing) if smoothed else [one.raster for one in network.chains]
    return Division(
        [np.array(sides) * polygon for polygon in network.polygons(lines)],
        grains,
        found.labels,
        sizes,
        None if kinds is None else np.array([kinds[v] for v in found.labels.tolist()], np.int32),
        spacing * size,
        bool((found.image < 0).any()),
        found.counts,
        of_image(image, holes, kinds, np.array(sides)),
    )


def whole_labels(labels: npt.ArrayLike) -> IntArray:
    """Return labels as an array of integers, (rows, columns).

    Raises:
        InputError: for an array that is not an image of integers, or that is too large.
    """
    given = np.asarray(labels)
    if given.ndim == 3:
        raise InputError(
            f"{_WHERE}: labels = array of shape {given.shape}, must be rows of one image: "
            f"{NO_VOLUMES}; give one slice"
        )
    if given.ndim != 2 or given.dtype.kind not in KINDS or min(given.shape, default=0) < 2:
        raise InputError(
            f"{_WHERE}: labels = {given.dtype} array of shape {given.shape}, must be rows of whole "
            "numbers, two or more of each; correct it"
        )
    if given.size > MOST_PIXELS:
        raise InputError(
            f"{_WHERE}: labels = {given.shape[0]} x {given.shape[1]} pixels, must be <= "
            f"{MOST_PIXELS} in all; crop the image or use larger pixels"
        )
    return whole_numbers(
        f"{_WHERE}: labels", given, lambda index: f"row {index[0]}, column {index[1]}"
    )


def _minerals(minerals: object, image: IntArray) -> dict[int, int | None]:
    """Return the mineral index of each label; None for holes."""
    if not isinstance(minerals, Mapping):
        raise InputError(
            f"{_WHERE}: minerals = {minerals!r}, must be indices by label, or None; give "
            f"{{label: index}}"
        )
    found: dict[int, int | None] = {}
    for label, mineral in minerals.items():
        if mineral is not None:
            require_whole(f"{_WHERE}: minerals[{label}]", mineral, Bounds(at_least=0, at_most=99))
        found[label] = mineral
    values, first, counts = np.unique(image, return_index=True, return_counts=True)
    for value, at, count in zip(values.tolist(), first.tolist(), counts.tolist(), strict=True):
        if value not in found:
            row, column = divmod(at, image.shape[1])
            raise InputError(
                f"{_WHERE}: minerals of label {value} are missing: {count} pixels have it, one at "
                f"row {image.shape[0] - 1 - row}, column {column}; give its mineral, or None for a "
                "hole"
            )
    return found


def _holes(image: IntArray, kinds: Mapping[int, int | None] | None) -> BoolArray:
    empty = [label for label, kind in (kinds or {}).items() if kind is None]
    holes: BoolArray = np.isin(image, empty)
    return holes


def _phases(kinds: Mapping[int, int | None] | None) -> dict[int, int] | None:
    if kinds is None:
        return None
    return {label: kind for label, kind in kinds.items() if kind is not None}
