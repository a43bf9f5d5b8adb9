# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells cut by lines of joints (D35 to D37), and of excavations (D77). Lengths in metres."""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Self

import numpy as np

from .._flexpm import Tessellation, Tiling, cut_by_joints
from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..joints.cuts import Cut, require_any, require_within
from ..joints.excavation import Excavation as Excavation
from ..joints.excavation import excavation_of, line_from_edge, ring_of
from ..joints.lines import EXCAVATION, Lines, Point, checked
from ..progress import Progress
from ..require import quoted, require_known, require_name
from .kernel_input import call, columns
from .outlines import polygon_outline

#: Part of a line outside of the specimen that is round-off [-].
_NOTHING = 1e-9


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
        discs: Disc of each cell, rows x, y, radius [m].
        edge_joints: Per shared edge an index into `names`, -1: none; None: no joints.
        lines: By the name of their joint.
        names: All joints, those of earlier cuts included.
        progress: Called with (lines done, lines, text).

    Returns:
        The cells, with the second parts of cut cells last, and the outcome of each joint's lines.

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


class Excavatable(ABC):
    """Closed lines that are sawn into the cells of a specimen and excavated in a test."""

    tessellation: Tessellation
    joints: Lines
    joint_cuts: dict[str, Cut]

    @property
    def told_cuts(self) -> dict[str, Cut]:
        """Return the outcome of the lines of joints with a law, without excavations."""
        there = self.joint_cuts.items()
        return {name: cut for name, cut in there if not name.startswith(EXCAVATION)}

    @property
    @abstractmethod
    def mean_diameter(self) -> float:
        """Mean diameter of the discs [m]."""

    @abstractmethod
    def _cut_by(
        self,
        lines: Lines,
        progress: Progress | None = None,
        origin: Point | None = None,
    ) -> Self:
        """Return the specimen cut by lines that are checked."""

    def with_excavations(self, excavations: Mapping[str, object]) -> Self:
        """Return the specimen cut along closed lines, within which a test excavates later (D77).

        The lines are cut in the same way as joints (D35), and are listed among the joints under the
        name ``excavation:NAME``. Their contacts have the law and the strength of the rock.
        `PartRig.excavate` removes the cells within a line. Joints that are cut first keep their
        edges.

        Args:
            excavations: By its name a polygon, rows x, y, or a circle, ``((x, y), radius)`` [m].

        Returns:
            The specimen; its cells keep their order, and second parts of cut cells come last.

        Raises:
            InputError: for a line that crosses itself, leaves the specimen, or meets no edge of a
                cell, for an existing name, and as ``with_joints``.
        """
        if not isinstance(excavations, Mapping) or not excavations:
            raise InputError(
                f"excavations = {quoted(excavations)}, must be polygons or circles by their name; "
                f"give {{name: polygon}}"
            )
        cut = self
        for name, given in excavations.items():
            label = EXCAVATION + require_name("excavation: name", name)
            if label in cut.joints:
                raise InputError(
                    f"excavation {name}: name = {name}, exists already; choose another name"
                )
            ring = ring_of(name, given, cut.mean_diameter)
            polygon_outline(f"excavation {name}", ring)
            cells = cut.tessellation
            edges = cells.vertices[cells.shared_edges[:, 2:]]
            line = line_from_edge(name, ring, edges)
            cut = cut._cut_by(checked({label: line}, excavations=True))
            found = cut.joint_cuts[label]
            if found.outside > _NOTHING * found.length:
                raise InputError(
                    f"excavation {name}: length outside of the specimen = {found.outside:.4g} m, "
                    "must be 0; move the line into it"
                )
        return cut

    def excavation(self, name: str) -> Excavation:
        """Return the content of a line of ``with_excavations``: cells, areas, raggedness.

        Raises:
            InputError: for an unknown name.
        """
        there = [one.removeprefix(EXCAVATION) for one in self.joints if one.startswith(EXCAVATION)]
        if not there:
            raise InputError(
                f"excavation = {quoted(name)}, does not exist in the specimen; add it with "
                "with_excavations"
            )
        require_known("excavation", name, there)
        cells = self.tessellation
        corners, ends = cells.vertices[cells.cell_vertices], cells.cell_offsets.tolist()
        return excavation_of(
            name,
            self.joints[EXCAVATION + name][0],
            [corners[start:end] for start, end in itertools.pairwise(ends)],
            cells.shared_edges[:, :2],
            cells.vertices[cells.shared_edges[:, 2:]],
        )
