# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the content of a specimen file: types, numbers, geometry. Lengths in metres.

A checksum proves that a file is unchanged, but not that its content is consistent.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from ...files import Table
from ...joints.lines import Lines
from ...joints.lines import checksum as lines_checksum
from ...require import quoted
from ..spec import SpecimenSpec
from .rules import (
    Rule,
    is_count,
    is_number,
    is_positive,
    is_text,
    list_of,
    or_none,
    refuse,
    require_rules,
    row_of,
    spec_values,
)

if TYPE_CHECKING:
    from ..._flexpm import Tiling
    from ...arrays import FloatArray, IntArray

#: Distances below this share of the mean diameter are round-off, and that of areas [-].
_ROUND_OFF, _AREA = 1e-5, 1e-9
#: Turn of a rim of given cells that is no corner, as the kernel has it [rad].
_STRAIGHT = 1e-4
#: Longest edge of a cell on a circle, in mean diameters [-].
_CHORD = 3.0
#: A reference point may lie out of its cell by this share of its radius [-].
_OUTSIDE = 0.75
#: Farthest contacts of a joint from its lines, in mean diameters [-].
_FARTHEST = 3.0
#: Largest distance of two pieces of a sawn grain, in largest diameters [-].
_LARGEST_GRAIN = 2.0
#: Most joints of which all ways are tried in which they may have been cut.
_MOST_JOINTS = 10


def _is_outline(value: object) -> bool:
    if isinstance(value, Mapping):
        whole = value.keys() == {"x", "y", "radius"} and all(map(is_number, value.values()))
        return whole and value["radius"] > 0.0
    return _RING(value)


def _is_cuts(value: object) -> bool:
    """Whether a value is a table of joint names and the results of their cuts."""
    return isinstance(value, Mapping) and all(
        isinstance(cut, Mapping)
        and _CUT.keys() >= cut.keys() >= _CUT.keys() - {"on", "reason"}
        and all(_CUT[key](one) for key, one in cut.items())
        for cut in value.values()
    )


_CUT: dict[str, Rule] = {
    **dict.fromkeys(("lines", "idle"), is_count),
    **dict.fromkeys(("length", "cut", "taken", "outside"), is_number),
    "on": or_none(is_text),
    "reason": is_text,
}
_RING = list_of(row_of(2), 3)
#: What each key of a file holds.
_KEYS: dict[str, Rule] = {
    "spec": lambda value: isinstance(value, Mapping),
    "outline": _is_outline,
    "holes": list_of(_RING),
    "removed_discs": is_count,
    **dict.fromkeys(("minerals", "grains"), or_none(list_of(is_count, 1))),
    "mineral_names": list_of(is_text, 1),
    "vertices": list_of(row_of(2), 3),
    "cells": list_of(list_of(is_count, 3), 1),
    "discs": list_of(row_of(3), 1),
    "laguerre": list_of(lambda value: is_count(value) and value in (0, 1), 1),
    "sides": list_of(row_of(3, is_count)),
    "joints": list_of(row_of(3, is_count)),
    "lines": lambda value: isinstance(value, Mapping),
    "cuts": _is_cuts,
    "strengths": or_none(list_of(is_positive)),
}
#: Keys that files of earlier versions lack, or that not all have.
_LATER = ("lines", "cuts", "mineral_names", "laguerre")
#: What each field of the spec holds; sizes and numbers of a packing it checks itself.
_SPEC: dict[str, Rule] = {
    "kind": is_text,
    **dict.fromkeys(("diameters", "joint_origin"), or_none(row_of(2))),
    "joint_names": or_none(list_of(is_text, 1)),
    "networks": or_none(list_of(lambda value: isinstance(value, Mapping), 1)),
    **dict.fromkeys(
        ("discs", "outline", "minerals", "cells", "joints", "strengths"), or_none(is_text)
    ),
}


def require_types(content: Table) -> None:
    """Check that each key exists and has its type, and that related lists have equal lengths.

    Raises:
        InputError: for the first key that does not.
    """
    require_rules(content, _KEYS, _LATER)
    cells = len(content["cells"])
    for name in ("discs", "minerals", "grains", "laguerre"):
        if content.get(name) is not None and len(content[name]) != cells:
            raise refuse(f"{name} = {len(content[name])}, must be one for each of {cells} cells")
    smallest = min((row[2] for row in content["discs"]), default=1.0)
    if not smallest > 0.0:
        raise refuse(f"radius of a disc = {smallest} m, must be > 0")
    vertices = len(content["vertices"])
    for ring in (*content["cells"], *(row[:2] for key in _EDGES for row in content[key])):
        if max(ring) >= vertices:
            raise refuse(f"vertex = {max(ring)}, must be below their number {vertices}")


#: Keys with edges: two vertices and the number of a side or of a joint.
_EDGES = ("sides", "joints")


def spec_of(content: Table) -> SpecimenSpec:
    """Return the spec of the specimen in a file.

    Raises:
        InputError: for a field that is unknown, of another type or out of range.
    """
    known = [field.name for field in dataclasses.fields(SpecimenSpec)]
    return SpecimenSpec(**spec_values(content["spec"], known, _SPEC))


def require_sense(found: Table, sides: IntArray, joints: int, tiling: Tiling) -> None:
    """Check that the arguments of `Specimen` from a file are consistent.

    Args:
        found: The arguments.
        sides: Start, end and side of each edge on the outline, (n, 3).
        joints: Number of edges on joints.
        tiling: The cells.

    Raises:
        InputError: for arguments that are not consistent.
    """
    _require_outline(found)
    _require_sides(found, sides)
    _require_cells(found)
    _require_joints(found, joints, tiling)
    _require_factors(found)
    if found["spec"].is_laguerre and not tiling.tessellation.laguerre.all():
        raise refuse("laguerre = 0, must be 1 for all cells of a packing")


def _require_outline(found: Table) -> None:
    """Check that shape, sizes and holes are the shape, sizes and holes of the spec."""
    import numpy as np

    from .. import outlines, packed
    from ..kernel_input import Circle, checksum

    spec, outline, holes = found["spec"], found["outline"], found["holes"]
    rings = outline if isinstance(outline, Circle) else np.vstack((outline, *holes))
    if spec.outline is not None:
        kind, sizes = outlines.kind_of(outline)
        same = spec.outline == checksum(rings) and (kind, sizes) == (spec.kind, spec.sizes)
    elif spec.kind == "half-disc":
        corners = outlines.half_disc_corners(spec.sizes["diameter"], 0.5 * sum(spec.diameters))
        same = not holes and not isinstance(outline, Circle) and np.array_equal(outline, corners)
    else:
        usual = packed.outline_of(spec)
        same = not holes and type(outline) is type(usual)
        same = same and (
            outline == usual if isinstance(usual, Circle) else np.array_equal(outline, usual)
        )
    if not same:
        raise refuse(f"the outline is not the {spec.kind} in spec")


def _require_sides(found: Table, sides: IntArray) -> None:
    """Check that each outline edge belongs to one cell and lies on the side with its index."""
    import numpy as np

    from ..kernel_input import Circle
    from ..outlines import area_of

    cells, outline = found["tessellation"], found["outline"]
    rim = np.sort(cells.boundary_edges[:, 1:3], axis=1)
    given = np.sort(sides[:, :2], axis=1)
    if len(given) != len(rim) or {*map(tuple, rim.tolist())} != {*map(tuple, given.tolist())}:
        raise refuse("sides are not the edges that belong to exactly one cell")
    ends, number = cells.vertices[sides[:, :2]], sides[:, 2]
    least = _ROUND_OFF * 2.0 * float(np.mean(found["discs"][:, 2]))
    if isinstance(outline, Circle):
        centre = np.array([outline.x, outline.y])
        off = np.abs(np.hypot(*np.moveaxis(ends - centre, -1, 0)) - outline.radius)
        if found["spec"].joints is not None:  # these cut chords, which leave the circle by c^2 / 8R
            off -= 0.125 * (_CHORD * least / _ROUND_OFF) ** 2 / outline.radius
        whole, area = not number.any(), math.pi * outline.radius**2
    else:
        rings = (outline, *found["holes"])
        starts = np.vstack(rings)
        along = np.vstack([np.roll(ring, -1, axis=0) for ring in rings]) - starts
        whole, area = bool(np.all(number < len(starts))), sum(map(area_of, rings))
        number = np.minimum(number, len(starts) - 1)
        off = _off(ends, starts[number], along[number])
        bent = float(off.max(axis=1) @ np.hypot(*(ends[:, 1] - ends[:, 0]).T))
        if found["spec"].cells is not None:  # corners of rims that are nearly straight are none
            bends = (np.bincount(number)[number] - 1) * np.hypot(*along[number].T)
            off = np.maximum(off - 0.5 * _STRAIGHT * bends[:, None], 0.0)
    if not (whole and np.all(off <= least)):
        raise refuse("edges in sides do not lie on the outline")
    covered = float(np.sum(cells.cell_areas))
    if isinstance(outline, Circle):
        whole = 0.5 * area < covered <= area * (1.0 + _AREA)
    else:
        whole = abs(covered - area) <= _AREA * area + bent
    if not whole:
        raise refuse(f"area of the cells = {covered:.9g} m2, must be {area:.9g} m2 of the outline")


def _off(points: FloatArray, starts: FloatArray, along: FloatArray) -> FloatArray:
    """Return the distances of two points each from segments, (n, 2)."""
    import numpy as np

    from_start = points - starts[:, None]
    share = (
        np.einsum("nkc,nc->nk", from_start, along) / np.einsum("nc,nc->n", along, along)[:, None]
    )
    foot = np.clip(share, 0.0, 1.0)[..., None] * along[:, None]
    distance: FloatArray = np.hypot(*np.moveaxis(from_start - foot, -1, 0))
    return distance


def _require_cells(found: Table) -> None:
    """Check that the cells follow from their discs, or have the checksum in the spec."""
    import numpy as np

    from .. import packed
    from ..kernel_input import cells_checksum, checksum

    spec, cells, discs = found["spec"], found["tessellation"], found["discs"]
    cut = spec.joints is not None
    if spec.discs is not None and not cut and spec.discs != checksum(discs):
        raise refuse("discs differ from the discs in spec")
    pieces = found.get("grains")
    if spec.cells is not None and not cut and spec.cells != cells_checksum(cells, pieces):
        raise refuse("cells differ from the cells in spec")
    sawn = spec.kind == "half-disc" or (spec.outline is not None and spec.discs is None)
    if not (cut or sawn or spec.cells is not None):
        least = _ROUND_OFF * 2.0 * float(np.mean(discs[:, 2]))
        there = packed.tessellated(discs, found["outline"], spec.short_edge, drop_hidden=True)[1]
        same = np.array_equal(there.cell_vertices, cells.cell_vertices)
        same = same and np.array_equal(there.cell_offsets, cells.cell_offsets)
        if not (same and np.allclose(there.vertices, cells.vertices, rtol=0.0, atol=least)):
            raise refuse("cells differ from the cells of the discs")
    elif not (cut and spec.discs is not None and spec.cells is None):
        # discs that were given may lie anywhere, even far out of their cells
        _require_points(cells.vertices, cells.cell_vertices, cells.cell_offsets, discs)


def _require_points(
    vertices: FloatArray, corners: IntArray, offsets: IntArray, discs: FloatArray
) -> None:
    """Check that reference points are in their cells, or outside by a tolerance at most."""
    import numpy as np

    sizes = np.diff(offsets)
    cell = np.repeat(np.arange(len(sizes)), sizes)
    following = np.arange(1, len(corners) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    starts, ends = vertices[corners], vertices[corners[following]]
    along, away = ends - starts, discs[cell, :2] - starts
    inward = (along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) / np.hypot(*along.T)
    outside = np.maximum.reduceat(-inward / discs[cell, 2], offsets[:-1])
    bad = np.flatnonzero(~(outside <= _OUTSIDE))
    if len(bad):
        raise refuse(f"disc {bad[0]} does not lie in its cell")


def _require_joints(found: Table, joints: int, tiling: Tiling) -> None:
    """Check the joints: number as in the spec, on edges between cells, near their lines."""
    import numpy as np

    from ...joints.bend import largest_bend
    from ...joints.network import Network

    spec, lines, grains = found["spec"], found["joints"], found.get("grains")
    names = spec.joint_names or ()
    [*map(Network.of, spec.networks or ())]
    # grains that were given or sawn may have pieces without a joint, too
    sawn = spec.outline is not None and spec.discs is None
    may_be_split = spec.cells is not None or sawn
    some = (spec.joints is None) is not (grains is None)
    some = some and not (may_be_split and spec.joints is None and not names)
    if some or bool(names) is (spec.joints is None):
        raise refuse("only some of joints, joint_names and grains are given")
    if grains is not None:
        numbers, first = np.unique(grains, return_index=True)
        if not (np.array_equal(numbers, np.arange(len(first))) and np.all(np.diff(first) > 0)):
            raise refuse("grains are not numbered in the order of their first cells")
        if sawn and spec.diameters is not None:
            points = found["discs"][:, :2]
            apart = np.hypot(*(points - points[first[grains]]).T)
            if not apart.max() <= _LARGEST_GRAIN * spec.diameters[1]:
                raise refuse("grains are not pieces of cut grains")
        # what a cut has parted meets at the cut, but for the few cells that had to be split
        pairs = found["tessellation"].shared_edges[:, :2]
        parted = grains[pairs[:, 0]] == grains[pairs[:, 1]]
        cut = np.count_nonzero(parted & (tiling.edge_joints >= 0))
        if not may_be_split and 2 * cut < np.count_nonzero(parted):
            raise refuse("grains are not separated by joints only")
    used = tiling.edge_joints[tiling.edge_joints >= 0]
    cuts = found["joint_cuts"]  # lines of a joint may cut nothing
    bearing = {k for k, name in enumerate(names) if name not in cuts or cuts[name].cut > 0.0}
    if len(used) != joints or {*used.tolist()} != bearing:
        raise refuse("a joint that cuts has no edges in joints")
    if not lines:
        return  # of an earlier version
    if [*lines] != [*names]:
        raise refuse(f"lines = {quoted([*lines])}, must be lines of the joints in spec")
    far = _FARTHEST * 2.0 * float(np.mean(found["discs"][:, 2]))
    cells = found["tessellation"]
    ends = cells.vertices[cells.shared_edges[:, 2:]]
    for number, name in enumerate(names):
        if not largest_bend(lines[name], ends[tiling.edge_joints == number]) <= far:
            raise refuse(f"joint {name} does not lie on its lines")
    known = all(len(one) == 1 for one in lines.values()) and len(names) <= _MOST_JOINTS
    if known and spec.joints not in _checksums(lines):
        raise refuse("lines differ from the lines in spec")


def _checksums(lines: Lines) -> Iterable[str]:
    """Yield the checksums of joints that were cut in one call or in several calls."""
    names = [*lines]
    reached: dict[int, set[str | None]] = {0: {None}}
    for end in range(1, len(names) + 1):
        reached[end] = {
            lines_checksum({name: lines[name] for name in names[first:end]}, before)
            for first in range(end)
            for before in reached[first]
        }
    return {one for one in reached[len(names)] if one is not None}


def _require_factors(found: Table) -> None:
    """Check that strengths and minerals are the strengths and minerals of the spec."""
    from .. import strengths as contact_strengths
    from ..kernel_input import checksum, checksums_of_starts

    spec, strengths, minerals = found["spec"], found.get("strengths"), found.get("minerals")
    if (spec.strengths is None) is not (strengths is None):
        raise refuse("strengths and spec do not agree")
    if strengths is not None:
        contact_strengths.checked(strengths, len(found["tessellation"].shared_edges))
        if checksum(strengths) != spec.strengths:
            raise refuse("strengths differ from the strengths in spec")
    if (spec.minerals is None) is not (minerals is None):
        raise refuse("minerals and spec do not agree")
    if minerals is not None:
        # those of the cells that joints have cut, which were grains, or pieces of an image's grains
        grains = found.get("grains")
        least = len(minerals) if grains is None else int(grains.max()) + 1
        if spec.minerals not in checksums_of_starts(minerals, least):
            raise refuse("minerals differ from the minerals in spec")
