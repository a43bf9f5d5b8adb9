# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage that takes away what lies within a line of the specimen. SI units.

Deviation D77.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import yade

from ...arrays import IntArray
from ...errors import InputError, SimulationError
from ...results.fragments import connected
from ...runs.runner import Span
from ...specimens.joint_cutting import Excavation
from ..parts import HeldNodes
from ..rig import AT_REST, REST_CROSSINGS
from .cycles import PartCycles


class PartExcavation(PartCycles):
    """Base of a rig of parts whose specimen is excavated."""

    def excavate(self, name: str) -> None:
        """Take away the cells within a line of ``Specimen.with_excavations``, until all balances.

        They leave at once; what they bore falls on the wall as a wave. What they store and how they
        move leaves as ``erased_energy``, by which ``boundary_work`` of the record is less. Pressures
        stay, what is driven stands, and damping is on meanwhile, as in `relax`. Strains and gauges
        of a record that begins later count from there on.

        Args:
            name: Name of the excavation.

        Raises:
            InputError: for a name that the specimen has not, what is excavated already, and cells
                without which others, or held nodes, hang on nothing.
            SimulationError: if the forces do not come to balance.
        """
        found = self.built.specimen.excavation(name)
        self._require_scene("excavate")
        about = {"area": found.area, "raggedness": found.raggedness}
        self._tell("excavate", name=name, **about)
        begin = partial(self._begin_excavation, found)
        over = partial(self._has_come_to_rest, REST_CROSSINGS)
        entered = self._damped_stage(begin, over, "excavation")
        if entered and not self.diverged and not self._is_at_rest():
            imbalance = self._balance_of_all().largest
            raise SimulationError(
                f"excavate: imbalance = {imbalance:.2g} of the largest force, must fall below "
                f"{AT_REST}; {self._most_borne}; lower what loads, or excavate less"
            )

    def _begin_excavation(self, found: Excavation) -> Span:
        self._take_away(found)
        return self._begin_rest(REST_CROSSINGS)

    def _take_away(self, found: Excavation) -> None:
        """Erase the cells."""
        solver, bodies = self.built.solver, yade.O.bodies
        cells = [int(n) for n in found.cells if bodies[solver.bodyIds[int(n)]] is not None]
        if not cells:
            raise InputError(
                f"excavate: name = {found.name}, is excavated, must be another one or left out"
            )
        self._require_hanging(found, np.array(cells))
        self._scales = None
        if not self._begun:
            self._from_now = True
        for cell in cells:
            bodies.erase(solver.bodyIds[cell])
        solver.counts()  # they are gone from here on

    def _require_hanging(self, found: Excavation, cells: IntArray) -> None:
        """Refuse cells without which others are cut off, or sets of nodes lose all of theirs."""
        where = f"excavate: name = {found.name}"
        numbers, places = self.built.solver.nodePlaces(bonded=True)
        lost = set(numbers[found.contains(places)].tolist())
        for part in self._all_parts:
            if isinstance(part, HeldNodes) and part.nodes and lost.issuperset(part.nodes):
                raise InputError(f"{where}, has {part} within, must have none; hold others")
        state = self.built.snapshot()
        areas, pairs = state.grain_areas, state.contact_grains
        left = areas.copy()
        left[cells[cells < len(areas)]] = 0.0
        kept = (left > 0.0)[pairs].all(axis=1)
        before = connected(pairs, np.ones(len(pairs), dtype=bool), areas)
        after = connected(pairs, kept, left)
        if len(after) > len(before):
            last = np.flatnonzero(after.labels == len(after) - 1)
            x, y = self.built.specimen.centres[last].mean(axis=0)
            raise InputError(
                f"{where}, leaves {len(last)} grains at ({x:.4g}, {y:.4g}) m that hang on "
                "nothing, must leave none; excavate these, too, or less"
            )
