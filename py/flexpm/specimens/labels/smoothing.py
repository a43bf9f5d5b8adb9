# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth lines for the staircases of chains. Lengths in pixels.

The two pieces of a chain share its line, so that there are no gaps and no overlaps. The corners of
the line are evenly spaced along the smoothed staircase. They are shifted sideways together until
the line preserves the areas on both sides. A line gets more corners where it would be more than a
pixel from its staircase or meet another line; in the last step these are the corners of the
staircase. Where a line would leave a junction along another line, a piece of its staircase is kept.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...arrays import FloatArray, IntArray
from .chains import Chain, Network

#: Passes of the filter 1/4, 1/2, 1/4 over the vertices of a staircase: the next if a line fails.
_PASSES = (8, 4, 2)
#: Largest way that the filter moves a vertex.
_MOVED = 0.75
#: Largest distance of a line from its staircase.
_FARTHEST = 1.0
#: Least distance of two lines that have no end in common.
_GAP = 0.35
#: Least angle between two lines at a junction [rad].
_LEAST_ANGLE = math.radians(10.0)
#: Steps of a staircase that are kept at an end first, and twice as many each time again.
_KEPT = 2
#: Growth of the number of corners of a line that cannot stay.
_MORE = 1.5


@dataclass
class _Plan:
    """Parameters of the line of a chain."""

    count: int  #: edges of what is smoothed
    kept: list[int]  #: steps of the staircase kept at the begin and at the end

    def is_last(self, chain: Chain) -> bool:
        """Whether the line is the staircase itself."""
        steps = len(chain.raster) - 1
        return sum(self.kept) + 2 >= steps or 2 * self.count >= steps - sum(self.kept)


def smooth(network: Network, edge: float) -> list[FloatArray]:
    """Return the corners of the line of each chain, (n, 2) each.

    Args:
        network: The chains.
        edge: Spacing of the corners.
    """
    plans = [_Plan(_first_count(chain, edge), [0, 0]) for chain in network.chains]
    lines = [_line(chain, plan) for chain, plan in zip(network.chains, plans, strict=True)]
    while True:
        changed = set()
        for number, place in _wrong(network, lines):
            chain, plan = network.chains[number], plans[number]
            if number in changed or chain.is_straight or plan.is_last(chain):
                continue
            changed.add(number)
            if place in (0, 1):
                plan.kept[place] = max(_KEPT, 2 * plan.kept[place])
            else:
                plan.count = max(math.ceil(_MORE * plan.count), plan.count + 1)
            lines[number] = _line(chain, plan)
        if not changed:
            return lines


def _first_count(chain: Chain, edge: float) -> int:
    """Return the number of edges with which a line begins."""
    if chain.is_straight:
        return 1 if chain.is_outer else max(1, round((len(chain.raster) - 1) / edge))
    length = float(_way(_filtered(chain.raster, _PASSES[0]))[-1])
    return max(3 if chain.ends[0] == chain.ends[1] else 2, round(length / edge))


def _line(chain: Chain, plan: _Plan) -> FloatArray:
    """Return the line with the fewest edges, at least as planned, that is nowhere too far off."""
    raster = chain.raster
    if chain.is_straight:
        steps = np.linspace(0.0, 1.0, plan.count + 1)[:, None]
        line: FloatArray = raster[0] + steps * (raster[-1] - raster[0])
        return line
    if plan.is_last(chain):
        return _corners(raster)
    begin, end = plan.kept[0], len(raster) - 1 - plan.kept[1]
    parts = [_corners(raster[: begin + 1])[:-1]] if begin else []
    parts.append(_smoothed(raster[begin : end + 1], plan.count))
    parts += [_corners(raster[end:])[1:]] if plan.kept[1] else []
    return np.concatenate(parts)


def _smoothed(raster: FloatArray, count: int) -> FloatArray:
    """Return corners at even distances, and more of them where the line would be too far off."""
    if np.ptp(raster, axis=0).min() == 0.0:
        return raster[[0, -1]]
    smoothed = [_filtered(raster, passes) for passes in _PASSES]
    while 2 * count < len(raster) - 1:
        for flat in smoothed:
            line = _fitted(flat, raster, count)
            if line is not None:
                return line
        count = max(math.ceil(_MORE * count), count + 1)
    return _corners(raster)


def _fitted(flat: FloatArray, raster: FloatArray, count: int) -> FloatArray | None:
    """Return a line with the area of the staircase that is nowhere too far off, or None.

    Args:
        flat: The smoothed staircase.
        raster: The staircase.
        count: Smallest number of edges of the line; it has more edges where it would be too far
            off.
    """
    way = _way(flat)
    nodes = np.linspace(0.0, way[-1], count + 1)
    while 2 * len(nodes) < len(raster) + 2:
        line = _with_area(_at(flat, way, nodes), _area(raster))
        if line is None:
            return None
        away = _away(raster, line)
        if away.max() <= _FARTHEST and _away(line, raster).max() <= _FARTHEST:
            return line
        worst = float(way[int(away.argmax())])
        if np.abs(nodes - worst).min() < 1.0:
            return None
        nodes = np.sort(np.append(nodes, worst))
    return None


def _filtered(raster: FloatArray, passes: int) -> FloatArray:
    """Return a staircase without its steps; no vertex moves by more than `_MOVED`."""
    flat = raster.copy()
    for _ in range(min(passes, len(raster) // 2)):
        flat[1:-1] = 0.25 * flat[:-2] + 0.5 * flat[1:-1] + 0.25 * flat[2:]
    moved = flat - raster
    far = np.maximum(np.hypot(*moved.T) / _MOVED, 1.0)
    found: FloatArray = raster + moved / far[:, None]
    return found


def _way(line: FloatArray) -> FloatArray:
    """Return the path length along a line at each of its points."""
    return np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))


def _at(line: FloatArray, way: FloatArray, nodes: FloatArray) -> FloatArray:
    """Return the points of a line at path lengths, its ends included."""
    found = np.stack([np.interp(nodes, way, line[:, k]) for k in (0, 1)], axis=1)
    found[0], found[-1] = line[0], line[-1]
    return found


def _area(line: FloatArray) -> float:
    """Return the area left of a line, except for a part that depends on its ends only."""
    x, y = (line - line[0]).T
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _with_area(line: FloatArray, target: float) -> FloatArray | None:
    """Return the line with its inner corners shifted sideways to enclose an area, or None."""
    along = line[2:] - line[:-2]
    reach = np.hypot(*along.T)
    if reach.min() <= 0.0:
        return None
    aside = np.stack((along[:, 1], -along[:, 0]), axis=1) / reach[:, None]
    found = line.copy()
    for _ in range(8):
        found_along = found[2:] - found[:-2]
        slope = 0.5 * float(
            np.sum(found_along[:, 1] * aside[:, 0] - found_along[:, 0] * aside[:, 1])
        )
        if slope <= 0.0:
            return None
        found[1:-1] += (target - _area(found)) / slope * aside
    return found if abs(_area(found) - target) <= 1e-9 * max(1.0, abs(target)) else None


def _corners(raster: FloatArray) -> FloatArray:
    """Return a staircase without the vertices on its straight parts."""
    steps = np.diff(raster, axis=0)
    turns = np.any(steps[1:] != steps[:-1], axis=1)
    corners: FloatArray = raster[np.concatenate(([True], turns, [True]))]
    return corners


def _away(points: FloatArray, line: FloatArray) -> FloatArray:
    """Return the distances of points from a line."""
    starts, along = line[:-1], np.diff(line, axis=0)
    squares = np.maximum(np.sum(along**2, axis=1), 1e-300)
    to = points[:, None] - starts[None]
    share = np.clip(np.sum(to * along[None], axis=2) / squares[None], 0.0, 1.0)
    away = to - share[:, :, None] * along[None]
    distances: FloatArray = np.sqrt(np.sum(away**2, axis=2).min(axis=1))
    return distances


def _wrong(network: Network, lines: list[FloatArray]) -> list[tuple[int, int]]:
    """Return chains whose lines are too near to others, or leave a junction in the wrong order.

    The second number of each pair is the location: 0 the begin of the chain, 1 its end, 2 between.
    """
    found = _crowded(network, lines)
    segments, owner, ends = _segments(network, lines)
    one, other = _near(segments)
    apart = (ends[one][:, :, None] != ends[other][:, None, :]).all(axis=(1, 2))
    one, other = one[apart], other[apart]
    near = _distance(segments[one], segments[other]) < _GAP
    first = np.searchsorted(owner, np.arange(len(lines) + 1))
    for row in np.unique(np.append(one[near], other[near])).tolist():
        number = int(owner[row])
        count, place = int(first[number + 1] - first[number]), row - int(first[number])
        at_begin, at_end = place <= count // 4, place >= count - 1 - count // 4
        found.append((number, 2 if at_begin is at_end else int(at_end)))
    return found


def _segments(network: Network, lines: list[FloatArray]) -> tuple[FloatArray, IntArray, IntArray]:
    """Return the ends of all segments (n, 2, 2), and the chain and end point indices of each."""
    segments, owner, ends = [], [], []
    inner = -1
    for number, (chain, line) in enumerate(zip(network.chains, lines, strict=True)):
        count = len(line) - 1
        ids = np.append(chain.ends[0], np.append(inner - np.arange(count - 1), chain.ends[1]))
        inner -= count - 1
        segments.append(np.stack((line[:-1], line[1:]), axis=1))
        owner.append(np.full(count, number))
        ends.append(np.stack((ids[:-1], ids[1:]), axis=1))
    return np.concatenate(segments), np.concatenate(owner), np.concatenate(ends).astype(int)


def _near(segments: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of segments that may be near each other."""
    from scipy.spatial import cKDTree

    lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    most = max(2.0, float(np.median(lengths)))
    parts = np.ceil(lengths / most).astype(int)
    of = np.repeat(np.arange(len(segments)), parts)
    place = np.arange(len(of)) - np.repeat(np.cumsum(parts) - parts, parts)
    share = (place + 0.5) / parts[of]
    middles = segments[of, 0] + share[:, None] * (segments[of, 1] - segments[of, 0])
    pairs = cKDTree(middles).query_pairs(most + _GAP, output_type="ndarray")
    found = np.sort(of[pairs], axis=1)
    found = np.unique(found[found[:, 0] != found[:, 1]], axis=0)
    return found[:, 0], found[:, 1]


def _distance(one: FloatArray, other: FloatArray) -> FloatArray:
    """Return the distances between segments, (n, 2, 2) each; 0 where they intersect."""
    away = np.min(
        [
            _from(one[:, 0], other),
            _from(one[:, 1], other),
            _from(other[:, 0], one),
            _from(other[:, 1], one),
        ],
        axis=0,
    )
    crossing = (_side(one, other[:, 0]) * _side(one, other[:, 1]) < 0.0) & (
        _side(other, one[:, 0]) * _side(other, one[:, 1]) < 0.0
    )
    return np.where(crossing, 0.0, away)


def _side(line: FloatArray, points: FloatArray) -> FloatArray:
    along, to = line[:, 1] - line[:, 0], points - line[:, 0]
    side: FloatArray = along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]
    return side


def _from(points: FloatArray, line: FloatArray) -> FloatArray:
    along, to = line[:, 1] - line[:, 0], points - line[:, 0]
    share = np.clip(np.sum(to * along, axis=1) / np.sum(along**2, axis=1), 0.0, 1.0)
    away: FloatArray = np.hypot(*(to - share[:, None] * along).T)
    return away


def _crowded(network: Network, lines: list[FloatArray]) -> list[tuple[int, int]]:
    """Return chains that leave a junction too near to others, or not in their staircases' order.

    The second number of each pair is the end of the chain: 0 its begin, 1 its end.
    """
    leaving: dict[int, list[tuple[float, float, int, int]]] = {}
    for number, (chain, line) in enumerate(zip(network.chains, lines, strict=True)):
        for end, way in ((0, 1), (1, -1)):
            first, smooth_first = (one[::way][1] - one[::way][0] for one in (chain.raster, line))
            here, there = (math.atan2(one[1], one[0]) for one in (first, smooth_first))
            leaving.setdefault(chain.ends[end], []).append((here, there, number, end))
    found: list[tuple[int, int]] = []
    for around in leaving.values():
        around.sort()
        turns = [
            (after[1] - before[1]) % (2.0 * math.pi)
            for before, after in zip(around, around[1:] + around[:1], strict=True)
        ]
        if len(around) > 1 and (
            min(turns) < _LEAST_ANGLE or abs(sum(turns) - 2.0 * math.pi) > 1e-6
        ):
            found += [(number, end) for _, _, number, end in around]
    return found
