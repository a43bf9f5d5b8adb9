# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells cut by lines of joints (D35 to D37). Lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .._flexpm import Tessellation, Tiling, cut_by_joints
from ..arrays import FloatArray, IntArray
from ..joints.cuts import Cut, require_any, require_within
from ..joints.lines import Lines
from ..progress import Progress
from .kernel_input import call, columns


def cut_cells(
    cells: Tessellation,
    discs: FloatArray,
    edge_joints: IntArray | None,
    lines: Lines,
    names: Sequence[str],
    progress: Progress | None,
) -> tuple[Tiling, dict[str, Cut]]:
    """Cut cells by lines of joints.

    Args:
        cells: The cells.
        discs: Rows x, y, radius [m], one for each cell.
        edge_joints: Per shared edge an index into `names`, -1: none; None: no joints.
        lines: By the name of their joint.
        names: All joints, those of earlier cuts included.
        progress: Called with (lines done, lines, text).

    Returns:
        The cells, second parts of cut ones last, and what came of the lines of each joint.

    Raises:
        InputError: if no line cuts anything, for lines far away, and for too many segments.
    """
    low, high = (tuple(end(cells.vertices, axis=0).tolist()) for end in (np.min, np.max))
    require_within(lines, low, high)
    numbers = {name: number for number, name in enumerate(names)}
    of_lines = [numbers[name] for name in lines for _ in lines[name]]
    none = np.full(len(cells.shared_edges), -1, dtype=np.int32)

    def tell(done: int) -> None:
        if progress is not None:
            progress(done, len(of_lines), "cutting joints")

    tiling, lengths, counts = call(
        cut_by_joints,
        cells,
        *columns(discs),
        none if edge_joints is None else edge_joints,
        [np.array(line) for given in lines.values() for line in given],
        np.array(of_lines, dtype=np.int32),
        tell,
    )
    cuts, first = {}, 0
    for name in lines:
        own = slice(first, first + len(lines[name]))
        first = own.stop
        length, cut, taken, outside = map(math.fsum, lengths[own].T)
        on = counts[own, 1][np.argmax(lengths[own, 2])] if taken > 0.0 else -1
        cuts[name] = Cut(
            lines=len(lines[name]),
            idle=int((counts[own, 0] == 0).sum()),
            length=length,
            cut=cut,
            taken=taken,
            outside=outside,
            on=None if on < 0 else names[on],
        )
    require_any(cuts, lines, low, high)
    return tiling, cuts
