# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of an image of pieces: lines between junctions, each shared by two pieces.

Lengths in pixels. A chain begins and ends where three or more lines meet, or at a corner of the
image.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from ...arrays import FloatArray, IntArray
from .loops import Corners, loops_of


@dataclass
class Chain:
    """A line between two junctions."""

    ends: tuple[int, int]  #: vertices
    raster: FloatArray  #: its line along edges of pixels, (n, 2)
    is_outer: bool = True  #: whether one side is no rock

    @property
    def is_straight(self) -> bool:
        """Whether the chain follows a single row or column."""
        return bool(np.ptp(self.raster, axis=0).min() == 0.0)


@dataclass(frozen=True)
class Network:
    """All chains, and the chains of each piece."""

    chains: list[Chain]
    pieces: list[list[tuple[int, bool]]]  #: chains around each, and whether each goes forwards

    @classmethod
    def of(cls, image: IntArray) -> Network:
        """Return the lines of an image of pieces, none of which encloses another piece."""
        width = image.shape[1] + 1
        degree = Corners.of(image).degree().ravel()
        junction = degree > 2
        rows, columns = (size + 1 for size in image.shape)
        corners = np.array([0, columns - 1, (rows - 1) * columns, rows * columns - 1])
        junction[corners] |= degree[corners] == 2
        chains: list[Chain] = []
        known: dict[tuple[int, int], int] = {}
        pieces: list[list[tuple[int, bool]]] = [[] for _ in range(image.max() + 1)]
        for piece, loop in loops_of(image):
            at = np.flatnonzero(junction[loop])
            if not len(at):
                at = np.array([int(np.argmin(loop))])
            loop = np.append(np.roll(loop, -at[0]), loop[at[0]])
            stops = [*(at - at[0]).tolist(), len(loop) - 1]
            for begin, end in itertools.pairwise(stops):
                line = loop[begin : end + 1]
                number = known.get((int(line[-1]), int(line[-2])))
                if number is not None:
                    chains[number].is_outer = False
                    pieces[piece].append((number, False))
                    continue
                known[int(line[0]), int(line[1])] = len(chains)
                pieces[piece].append((len(chains), True))
                y, x = np.divmod(line, width)
                raster = np.stack((x, y), axis=1).astype(float)
                chains.append(Chain((int(line[0]), int(line[-1])), raster))
        return cls(chains, pieces)

    def polygons(self, lines: list[FloatArray]) -> list[FloatArray]:
        """Return the corners of each piece, (n, 2), from the corners of each chain."""
        return [
            np.concatenate(
                [lines[number][:-1] if ahead else lines[number][:0:-1] for number, ahead in around]
            )
            for around in self.pieces
        ]
