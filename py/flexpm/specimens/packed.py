# SPDX-License-Identifier: GPL-3.0-or-later
"""Packed discs and the cells of discs, paper Sec. 3.1. Lengths in metres."""

from __future__ import annotations

import numpy as np

from .._flexpm import Outline, Tessellation, disc_count, disc_radii, tessellate
from ..arrays import FloatArray
from ..errors import InputError
from ..progress import Progress
from . import packing
from .kernel_input import Circle, call, columns
from .spec import SpecimenSpec

_FEWEST_DISCS = 8


def packed_discs(
    where: str,
    spec: SpecimenSpec,
    frame: packing.Frame,
    area: float,
    progress: Progress | None,
) -> FloatArray:
    """Rows x, y, radius [m] of discs packed into a frame of an area [m2]."""
    assert spec.diameters is not None and spec.porosity is not None and spec.seed is not None
    spec.require_memory(area)
    smallest, largest = spec.diameters
    count = call(disc_count, area, smallest, largest, spec.porosity)
    if count < _FEWEST_DISCS:
        raise InputError(
            f"{where}: discs = {count}, must be >= {_FEWEST_DISCS} to fill the specimen; "
            "choose smaller diameters"
        )
    radii = call(disc_radii, count, smallest, largest, spec.seed)
    mean = 0.5 * (smallest + largest)
    centres, radii = call(packing.pack, frame, radii, mean, spec.seed, progress)
    return np.column_stack((centres, radii))


def frame_of(spec: SpecimenSpec) -> packing.Frame:
    """Room of the discs of a packing."""
    sizes = spec.sizes
    if spec.kind == "disc":
        return packing.Frame(radius=0.5 * sizes["diameter"])
    return packing.Frame(width=sizes["width"], height=sizes["height"])


def outline_of(spec: SpecimenSpec) -> FloatArray | Circle:
    """Outline of a packing: a rectangle from the origin, or a circle about it."""
    sizes = spec.sizes
    if spec.kind == "disc":
        return Circle(0.0, 0.0, 0.5 * sizes["diameter"])
    width, height = sizes["width"], sizes["height"]
    return np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])


def tessellated(
    discs: FloatArray, outline: FloatArray | Circle, short_edge: float, *, drop_hidden: bool
) -> tuple[FloatArray, Tessellation]:
    """Discs and their cells; hidden discs, which have no cell, are dropped or refused."""
    if isinstance(outline, Circle):
        shape = call(Outline.circle, outline.x, outline.y, outline.radius)
    else:
        shape = call(Outline.polygon, outline)
    while True:
        length = short_edge * 2.0 * float(np.mean(discs[:, 2])) if len(discs) else 0.0
        cells = call(tessellate, *columns(discs), shape, length, drop_hidden)
        if len(cells.hidden_discs) == 0:
            break
        discs = np.delete(discs, cells.hidden_discs, axis=0)
    discs.setflags(write=False)
    return discs, cells
