# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of a page: cracks and fragments of a test on its undeformed grains, position by position.

All comes from files of a run: specimen.vtu, cracks.csv and curve.csv.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from ...arrays import FloatArray, IntArray
from ...results.cracks import MODES, NAMES, AnyCrack
from ...results.fragments import Fragments, connected
from ...results.record import Curve
from ...results.result import Result
from ...results.snapshot import Snapshot
from ...results.solids.state import AnySnapshot, SolidSnapshot
from ..joint_colours import joint_colour
from ..maps import MINERALS
from ..words import words_of_result
from .page import Map, rows_to_draw
from .page_solid import solid_view

#: Length of the longer side in a map's own units, of 0.02 mm in the paper's specimen.
_LENGTH = 8000
#: Positions of a slider.
_POSITIONS = 100
#: Colours of fragments that are not the largest.
_COLOURS = 7


def crack_map(
    name: str,
    title: str,
    specimen: AnySnapshot,
    result: Result,
    rows: IntArray | None = None,
    chart: str = "",
    after: SolidSnapshot | None = None,
    *,
    turns: bool = False,
) -> Map:
    """Make the map of a test.

    Args:
        name: Name of its element, a word.
        title: Heading.
        specimen: The specimen before the test; of a solid its section is drawn.
        result: The test, with at least one row in its record.
        rows: Rows of the record that a chart shows; positions are some of these. None: of all.
        chart: Name of that chart.
        after: A solid after the test, for its stresses.
        turns: A solid has a view that turns, too.
    """
    drawing = specimen.drawn
    minerals = [kind["name"] for kind in result.material.get("minerals", ())]
    known = np.arange(len(result.curve)) if rows is None else rows
    chosen, at = _positions(result, known)
    positions = known[chosen]
    scale, corner = _frame(drawing.positions)
    outlines = _outlines(drawing, scale, corner)
    found = _fragments(specimen, result.cracks, at, len(positions))
    letters = [_letters(one) for one in found]
    seen = [grain for grain, path in enumerate(outlines) if path]  # of a solid those in its section
    width, height = np.ptp(drawing.positions, axis=0) * scale
    joints = {k: name for k, name in enumerate(drawing.joint_names) if name not in result.notches}
    return Map(
        name=name,
        title=title,
        size=(math.ceil(width), math.ceil(height)),
        bar=_bar(scale, float(width)),
        rock=_rock(drawing, outlines, minerals),
        grains=[outlines[grain] for grain in seen],
        notches=_ways(_units(drawing.contact_ends[_notches(drawing, joints)], scale, corner)),
        joints=_joint_paths(drawing, joints, scale, corner),
        cracks=_crack_paths(drawing, result.cracks, at, scale, corner),
        fragments=["".join(map(one.__getitem__, seen)) for one in letters],
        texts=[_text(result, row, len(one)) for row, one in zip(positions, found, strict=True)],
        rows=[int(row) for row in chosen],
        chart=chart,
        view=solid_view(name, specimen, after, result.cracks, at, letters)
        if turns and isinstance(specimen, SolidSnapshot)
        else None,
    )


def _positions(result: Result, known: IntArray) -> tuple[IntArray, IntArray]:
    """Positions of a slider among rows of the record, and from which on each crack is there."""
    record, names = result.curve, words_of_result(result)
    places = np.column_stack([record[names.x.column], record[names.y.column], _counts(record)])
    chosen = rows_to_draw(places[known], _POSITIONS)
    steps = record["step"][known[chosen]]
    at = np.searchsorted(steps, [crack.step for crack in result.cracks])
    return chosen, np.minimum(at, len(chosen) - 1)


def _counts(record: Curve) -> FloatArray:
    return record["tensile_cracks"] + record["shear_cracks"]


def _text(result: Result, row: int, fragments: int) -> str:
    record, names = result.curve, words_of_result(result)
    strain, stress = (
        f"{axis.name} {axis.factor * record[axis.column][row]:.4g} {axis.unit}"
        for axis in (names.x, names.y)
    )
    tensile, shear = (int(record[f"{mode}_cracks"][row]) for mode in MODES.values())
    return (
        f"step {int(record['step'][row])}: {strain}, {stress}; cracked points: {tensile} in "
        f"tension, {shear} in shear; fragments: {fragments}"
    )


def _frame(places: FloatArray) -> tuple[float, FloatArray]:
    """Units of the map in a metre, and the upper left corner [m]."""
    low, high = places.min(axis=0), places.max(axis=0)
    return _LENGTH / float(np.max(high - low)), np.array([low[0], high[1]])


def _units(places: FloatArray, scale: float, corner: FloatArray) -> IntArray:
    """Places [m] in units of the map, y downwards."""
    found: IntArray = np.rint((places - corner) * np.array([scale, -scale])).astype(int)
    return found


def _bar(scale: float, width: float) -> tuple[int, str]:
    """Scale bar of a round length, about a quarter of the width."""
    quarter = 0.25 * width / scale * 1e3  # mm
    decade = 10.0 ** math.floor(math.log10(quarter))
    length = max(step for step in (1.0, 2.0, 5.0) if step * decade <= quarter) * decade
    return round(1e-3 * length * scale), f"{length:g} mm"


def _outlines(drawing: Snapshot, scale: float, corner: FloatArray) -> list[str]:
    """Path of each grain: the edges of its triangles that no other one shares.

    Nodes with equal positions on the map are merged, so that thin triangles become lines, and an
    edge may occur several times.
    """
    nodes = _units(drawing.positions, scale, corner)
    grains = int(drawing.triangle_grain.max(initial=-1)) + 1
    edges: list[Counter[tuple[tuple[int, int], tuple[int, int]]]] = [
        Counter() for _ in range(grains)
    ]
    starts = nodes[drawing.triangles]
    ends = np.roll(starts, -1, axis=1)
    for grain, first, last in zip(
        np.repeat(drawing.triangle_grain, 3).tolist(),
        map(tuple, starts.reshape(-1, 2).tolist()),
        map(tuple, ends.reshape(-1, 2).tolist()),
        strict=True,
    ):
        if edges[grain][last, first] > 0:
            edges[grain][last, first] -= 1
        elif first != last:
            edges[grain][first, last] += 1
    return ["".join(map(_path, _loops(one))) for one in edges]


def _loops(
    edges: Counter[tuple[tuple[int, int], tuple[int, int]]],
) -> list[list[tuple[int, int]]]:
    """Corners of closed ways along edges that have a direction."""
    following: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for first, last in sorted(edges.elements()):
        following.setdefault(first, []).append(last)
    loops = []
    while following:
        place = min(following)
        loop = []
        while place in following:
            loop.append(place)
            ways = following[place]
            after = ways.pop()
            if not ways:
                del following[place]
            place = after
        loops.append(loop)
    return [loop for loop in loops if len(loop) > 2]


def _path(corners: Sequence[tuple[int, int]]) -> str:
    """Closed path of SVG in steps from corner to corner."""
    (x, y), *_ = corners
    steps = "".join(
        f"{b[0] - a[0]} {b[1] - a[1]} ".replace(" -", "-") for a, b in itertools.pairwise(corners)
    )
    return f"M{x} {y}l{steps.strip()}z"


def _rock(
    drawing: Snapshot, outlines: Sequence[str], minerals: Sequence[str]
) -> list[tuple[str, str, str]]:
    """Return all grains of each mineral as one path."""
    kind = np.zeros(len(outlines), dtype=int)
    if drawing.grain_mineral is not None:
        kind = drawing.grain_mineral
    found = []
    for number in np.unique(kind).tolist():
        name = minerals[number] if number < len(minerals) else ""
        # a section of a solid ends with the last grain that it cuts
        there = np.flatnonzero(kind[: len(outlines)] == number)
        path = "".join(outlines[grain] for grain in there)
        found.append((name, MINERALS[number % len(MINERALS)], path))
    return found


def _ways(ends: IntArray) -> str:
    """Path along straight pieces, by the ends of each (K, 2, 2)."""
    pieces = ends.reshape(-1, 4).tolist()
    return "".join(f"M{x0} {y0}l{x1 - x0} {y1 - y0}" for x0, y0, x1, y1 in pieces)


def _notches(drawing: Snapshot, joints: Mapping[int, str]) -> IntArray:
    """Contacts that are open before the test, without those of joints without strength."""
    if drawing.contact_joint is None:
        return drawing.cuts
    of_joint = np.isin(drawing.contact_joint, [*joints])
    return drawing.cuts[~of_joint[drawing.cuts]]


def _joint_paths(
    drawing: Snapshot, joints: Mapping[int, str], scale: float, corner: FloatArray
) -> list[tuple[str, str, str]]:
    """Name, colour and path of the contacts of each joint, if it has any."""
    if drawing.contact_joint is None:
        return []
    paths = {
        number: _ways(_units(drawing.contact_ends[drawing.contact_joint == number], scale, corner))
        for number in joints
    }
    return [(joints[number], joint_colour(number), path) for number, path in paths.items() if path]


def _crack_paths(
    drawing: Snapshot,
    cracks: Sequence[AnyCrack],
    at: IntArray,
    scale: float,
    corner: FloatArray,
) -> list[tuple[str, int, str]]:
    """Cracks of one mode that are there from the same position on as one path.

    A point has its share of the contact. Points of contacts that came later have no place here.
    """
    first = _first_points(drawing)
    segments = drawing.point_segments
    parts: dict[tuple[str, int], list[str]] = {}
    for crack, position in zip(cracks, at.tolist(), strict=True):
        if crack.contact not in first:
            continue
        segment = segments[first[crack.contact] + crack.point]
        step = _ways(_units(segment, scale, corner))
        parts.setdefault((NAMES[crack.mode], position), []).append(step)
    return [(mode, position, "".join(steps)) for (mode, position), steps in parts.items()]


def _first_points(drawing: AnySnapshot) -> dict[int, int]:
    """Row of the first point of each contact, by the number of the contact."""
    rows = np.flatnonzero(drawing.point_number == 0)
    return dict(
        zip(drawing.contact[drawing.point_contact[rows]].tolist(), rows.tolist(), strict=True)
    )


def _fragments(
    drawing: AnySnapshot, cracks: Sequence[AnyCrack], at: IntArray, positions: int
) -> list[Fragments]:
    """Fragments at each position: grains are connected while a point of their contact is bonded."""
    left = drawing.point_damage < 1.0
    areas = drawing.grain_areas
    first = _first_points(drawing)
    order = np.argsort(at, kind="stable")
    found, next_crack = [], 0
    for position in range(positions):
        while next_crack < len(order) and at[order[next_crack]] <= position:
            crack = cracks[order[next_crack]]
            if crack.contact in first:
                left[first[crack.contact] + crack.point] = False
            next_crack += 1
        found.append(connected(drawing.contact_grains, drawing.any_of(left), areas))
    return found


def _letters(found: Fragments) -> str:
    """Colour of each grain: of the largest fragment, of a loose grain, or by the first grain."""
    first = np.full(len(found), len(found.labels))
    np.minimum.at(first, found.labels[found.labels >= 0], np.flatnonzero(found.labels >= 0))
    letters = [
        "0" if rank == 0 else "x" if grains == 1 else str(1 + start % _COLOURS)
        for rank, (grains, start) in enumerate(zip(found.grains, first.tolist(), strict=True))
    ]
    return "".join("-" if label < 0 else letters[label] for label in found.labels.tolist())
