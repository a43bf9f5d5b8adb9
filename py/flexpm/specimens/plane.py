# SPDX-License-Identifier: GPL-3.0-or-later
"""2D specimens: outlines filled with packed or given grains, paper Sec. 3.1. Lengths in metres.

Grains are the Laguerre cells of packed discs, cells cut out of a packing, or cells of any shape.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypedDict, cast

import numpy as np
import numpy.typing as npt

from .._flexpm import PolygonOutline, Tessellation, Tiling, cells_in_outline, cells_of_polygons
from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import Table
from ..progress import Progress
from ..require import POSITIVE, require_flag, require_number
from . import packed, packing
from .checks import require_diameters, require_length, require_short_edge
from .files import tess
from .kernel_input import (
    Circle,
    call,
    cells_checksum,
    checksum,
    columns,
    disc_rows,
    mineral_indices,
    ring,
)
from .labels import ebsd, mineral_table
from .labels.given import FILLS, divide, whole_labels
from .labels.measures import of_grains
from .labels.picture import Picture
from .outlines import half_disc_corners, kind_of, polygon_outline
from .spec import SpecimenSpec

#: Areas of cells of which the seeds may be Laguerre's differ by less [-].
_ALIKE = 1e-7
#: Corners of a polygon, rows x, y [m].
Corners = Sequence[Sequence[float]] | FloatArray


class Packing(TypedDict, total=False):
    """Arguments that all packed shapes have.

    The first three may also follow the thickness as positional arguments, in this order.

    Attributes:
        diameters: Smallest and largest disc diameter [m]; default: 2 mm and 4 mm.
        porosity: Ratio that sets the number of discs [-]; the cells have no pores. Default: 0.10.
        seed: Integer from 0 to 2**64 - 1; the same seed gives the same specimen. Default: 1.
        short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-];
            default: the ratio that is 0.35 mm for the default diameters.
        progress: Function that is called with (steps done, steps expected, text).
    """

    diameters: tuple[float, float]
    porosity: float
    seed: int
    short_edge: float
    progress: Progress | None


#: Arguments of a packing that need no names.
_IN_ORDER = ("diameters", "porosity", "seed")


@dataclass(frozen=True)
class Filling:
    """Grains that fill an outline, as `Specimen` has them."""

    discs: FloatArray
    outline: FloatArray | Circle
    tessellation: Tessellation
    spec: SpecimenSpec
    removed_discs: int = 0
    holes: tuple[FloatArray, ...] = ()
    grains: IntArray | None = None
    minerals: IntArray | None = None
    regions: Table = field(default_factory=dict)
    mineral_names: tuple[str, ...] = ()


def packing_of(name: str, in_order: Sequence[object], named: Packing) -> Packing:
    """Return the arguments of a packing, given by name or by position.

    Raises:
        TypeError: for an unknown, repeated or surplus argument, as Python does.
    """
    if len(in_order) > len(_IN_ORDER):
        raise TypeError(
            f"{name}() takes {', '.join(_IN_ORDER)} by position; pass the others by keyword"
        )
    found = dict(zip(_IN_ORDER, in_order, strict=False))
    for key in named:
        if key in found:
            raise TypeError(f"{name}() got multiple values for argument {key!r}; give it once")
        if key not in Packing.__annotations__:
            raise TypeError(f"{name}() got an unexpected keyword argument {key!r}; remove it")
    return cast("Packing", found | named)


def packed_spec(
    kind: str,
    sizes: dict[str, float],
    thickness: float,
    how: Packing,
    outline: str | None = None,
) -> SpecimenSpec:
    """Return the inputs of a packed shape; `outline` is the checksum of an outline that is cut."""
    fields: Table = {**sizes, **how, "thickness": thickness, "outline": outline}
    fields.pop("progress", None)
    return SpecimenSpec(kind, **fields)


def pack(spec: SpecimenSpec, progress: Progress | None) -> Filling:
    """Pack a rectangle or disc, or cut half a disc out of a packed block.

    Raises:
        InputError: for discs that do not fit, or for a `spec` of given discs.
    """
    where = f"Specimen.{spec.kind}"
    if not spec.is_packed:
        what = spec.discs or spec.outline or spec.minerals or spec.joints or spec.strengths
        raise InputError(
            f"{where}: discs, outline, minerals, joints or strengths = {what}, were given and "
            "cannot be packed again; load the saved specimen"
        )
    if spec.kind == "half-disc":
        spec.require_memory()  # its arc has a chord for each grain
        assert spec.diameters is not None
        corners = half_disc_corners(spec.sizes["diameter"], 0.5 * sum(spec.diameters))
        return _sawn(where, spec, polygon_outline(where, corners), progress)
    frame, outline = packed.frame_of(spec), packed.outline_of(spec)
    given = packed.packed_discs(where, spec, frame, frame.area, progress)
    discs, cells = packed.tessellated(given, outline, spec.short_edge, drop_hidden=True)
    return Filling(discs, outline, cells, spec, len(given) - len(discs))


def polygon(
    corners: Corners, thickness: float, holes: Sequence[npt.ArrayLike], how: Packing
) -> Filling:
    """Saw an outline of any shape out of a packed block, see `Specimen.polygon`."""
    where = "Specimen.polygon"
    outline = polygon_outline(where, corners, holes)
    kind, sizes = kind_of(outline.rings[0])
    spec = packed_spec(kind, sizes, thickness, how, checksum(np.vstack(outline.rings)))
    return _sawn(where, spec, outline, how.get("progress"))


def from_polygons(polygons: Sequence[npt.ArrayLike], thickness: float, holes: bool) -> Filling:
    """Fill an outline with given cells, see `Specimen.from_polygons`."""
    where = "Specimen.from_polygons"
    require_length(where, "thickness", thickness)
    require_flag(f"{where}: holes", holes)
    given = [ring(f"{where}: polygon {number}", one) for number, one in enumerate(polygons)]
    return _of_cells(*call(cells_of_polygons, given, holes), thickness)


def from_labels(labels: npt.ArrayLike, thickness: float, options: Table) -> Filling:
    """Fill an outline with the grains of an image, see `Specimen.from_labels`."""
    require_length("Specimen.from_labels", "thickness", thickness)
    names: list[str] = []
    if isinstance(options["minerals"], str | Path):
        image = Picture(whole_labels(labels))
        names, kinds = mineral_table.of_image(Path(options["minerals"]), image)
        options = options | {"minerals": kinds}
    for fill in FILLS:
        found = divide(labels, **options, least_fill=fill)
        polygons = [np.ascontiguousarray(one) for one in found.polygons]
        try:
            tiling, rings = call(cells_of_polygons, polygons, found.has_holes)
            break
        except InputError:
            if fill == FILLS[-1]:
                raise
    grains = found.grains[tiling.origin].astype(np.int32)
    made = _of_cells(tiling, rings, thickness, grains)
    regions: Table = found.counts | {"source": found.source}
    if found.minerals is None:
        return replace(made, regions=regions)
    minerals = mineral_indices(found.minerals[grains], len(grains))
    spec = replace(made.spec, minerals=checksum(minerals))
    named = replace(made, mineral_names=tuple(names))
    return replace(named, minerals=minerals, spec=spec, regions=regions)


def from_ebsd(path: Path, thickness: float, options: Table) -> Filling:
    """Fill an outline with the grains of a map of orientations, see `Specimen.from_ebsd`."""
    found = ebsd.read(path)
    given = options.pop("phases")
    phases = None if given is None else ebsd.read_phases(Path(given), found)
    how = {key: options.pop(key) for key in ("misorientation", "unindexed")}
    oriented = ebsd.grains(found, phases=phases, **how)
    options |= {"pixel": found.grid.sides, "minerals": oriented.minerals}
    made = from_labels(oriented.labels, thickness, options)
    regions = oriented.counts | made.regions
    if len(oriented.names) > 1:
        return replace(made, regions=regions, mineral_names=tuple(oriented.names))
    spec = replace(made.spec, minerals=None)  # all alike: a rock without minerals has them, too
    return replace(made, minerals=None, spec=spec, regions=regions)


def from_tess(path: Path, thickness: float, scale: float, short_edge: float) -> Filling:
    """Fill an outline with the cells of a tessellation of Neper, see `Specimen.from_tess`."""
    where = "Specimen.from_tess"
    require_length(where, "thickness", thickness)
    require_short_edge(short_edge)
    given = tess.read(path).scaled(require_number(f"{where}: scale", scale, POSITIVE, "m"))
    outline = given.outline()
    if given.centres is not None and outline is not None:
        for radii in given.radii:
            with contextlib.suppress(InputError):  # seeds outside, or hidden: of no such cells
                discs = np.column_stack((given.centres, radii))
                _, cells = packed.tessellated(discs, outline, 0.0, drop_hidden=False)
                if np.allclose(cells.cell_areas, given.areas, rtol=_ALIKE, atol=0.0):
                    seeds = given.centres
                    made = from_discs(seeds, radii, outline, thickness, short_edge, False)
                    source = of_grains(cells, np.arange(cells.cells), None, ())
                    return replace(made, regions={"source": source})
    return from_polygons(given.polygons, thickness, holes=True)


def _of_cells(
    tiling: Tiling, rings: list[FloatArray], thickness: float, grains: IntArray | None = None
) -> Filling:
    """Fill an outline with cells from the kernel; each cell is a grain unless grains are given."""
    if grains is None:
        grains = _pieces(tiling)
    checksums = {
        "discs": checksum(tiling.discs),
        "outline": checksum(np.vstack(rings)),
        "cells": cells_checksum(tiling.tessellation, grains),
    }
    spec = _given_spec(rings[0], thickness, 0.0, checksums)
    return _of_tiling(tiling, rings[0], rings[1:], spec, grains)


def _pieces(tiling: Tiling) -> IntArray | None:
    """Grain of each cell, whole grains first; None if no grain was split."""
    _, first, grains = np.unique(tiling.origin, return_index=True, return_inverse=True)
    if len(first) == len(grains):
        return None
    rank = np.argsort(np.argsort(first))
    found: IntArray = rank[grains].astype(np.int32)
    return found


def from_discs(
    centres: npt.ArrayLike,
    radii: npt.ArrayLike,
    outline: Corners | Circle,
    thickness: float,
    short_edge: float,
    drop_hidden: bool,
) -> Filling:
    """Fill an outline with the cells of given discs, see `Specimen.from_discs`."""
    where = "Specimen.from_discs"
    require_length(where, "thickness", thickness)
    require_short_edge(short_edge)
    require_flag(f"{where}: drop_hidden", drop_hidden)
    given = disc_rows(centres, radii)
    if not isinstance(outline, Circle):
        outline = ring(f"{where}: outline", outline)
    discs, cells = packed.tessellated(given, outline, short_edge, drop_hidden=drop_hidden)
    checksums = {"discs": checksum(discs), "outline": checksum(outline)}
    spec = _given_spec(outline, thickness, short_edge, checksums)
    return Filling(discs, outline, cells, spec, len(given) - len(discs))


def _given_spec(
    outline: FloatArray | Circle, thickness: float, short_edge: float, checksums: dict[str, str]
) -> SpecimenSpec:
    """Return the inputs of a specimen without a packing: its outline, and checksums of the rest."""
    kind, sizes = kind_of(outline)
    given: Table = {"diameters": None, "porosity": None, "seed": None, **sizes, **checksums}
    return SpecimenSpec(kind, thickness=thickness, short_edge=short_edge, **given)


def _sawn(
    where: str, spec: SpecimenSpec, outline: PolygonOutline, progress: Progress | None
) -> Filling:
    """Saw an outline out of a packing of the box around it."""
    outer, *inner = outline.rings
    width, height = map(float, np.ptp(outer, axis=0))
    require_diameters(where, spec.diameters, min(width, height))
    frame = packing.Frame(width=width, height=height)
    block = packed.packed_discs(where, spec, frame, width * height, progress)
    length = spec.short_edge * 2.0 * float(np.mean(block[:, 2]))
    centres, radii = columns(block + np.append(outer.min(axis=0), 0.0))
    tiling = call(cells_in_outline, centres, radii, outline, length)
    return _of_tiling(tiling, outer, inner, spec, _pieces(tiling))


def _of_tiling(
    tiling: Tiling,
    outline: FloatArray,
    holes: Sequence[FloatArray],
    spec: SpecimenSpec,
    grains: IntArray | None,
) -> Filling:
    discs = tiling.discs
    for array in (discs, outline, *holes, *(() if grains is None else (grains,))):
        array.setflags(write=False)
    return Filling(discs, outline, tiling.tessellation, spec, holes=tuple(holes), grains=grains)
