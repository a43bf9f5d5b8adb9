# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage that removes the cells within a line of the specimen, in one or several steps. SI units.

Deviation D77.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import yade
from yade import wrapper

from ...arrays import IntArray
from ...errors import InputError, SimulationError
from ...require import Bounds, require_whole
from ...results.fragments import connected
from ...runs.runner import Span
from ...specimens.joint_cutting import Excavation
from ..parts import HeldNodes
from ..rig import AT_REST, RAMP_CROSSINGS, REST_CROSSINGS
from .cycles import PartCycles

#: Parts in which forces on a wall may be released.
_PARTS = Bounds(at_least=1, at_most=1000)


class PartExcavation(PartCycles):
    """Base of a rig of parts whose specimen is excavated."""

    def excavate(self, name: str, parts: int = 1) -> None:
        """Remove the cells within a line of ``Specimen.with_excavations``, until equilibrium.

        The stored and kinetic energy of the cells leaves as ``erased_energy``, by which
        ``boundary_work`` of the record decreases. Pressures stay, driven parts stop, and damping is
        on meanwhile, as in `relax`. Strains and gauges of a record that begins later are counted
        from this state.

        Args:
            name: Name of the excavation.
            parts: 1: all cells leave in one step, and their load reaches the wall as a wave. A
                larger number keeps the forces of the cells on the wall and releases them in this
                number of equal parts, each slowly and until equilibrium; their work is boundary
                work.

        Raises:
            InputError: for a name that the specimen does not have, cells that are already
                excavated, and cells without which other cells, or fixed nodes, would be
                unconnected.
            SimulationError: if the forces do not reach equilibrium.
        """
        found = self.built.specimen.excavation(name)
        parts = require_whole("excavate: parts", parts, _PARTS)
        self._require_scene("excavate")
        about = {"area": found.area, "raggedness": found.raggedness}
        self._tell("excavate", name=name, **about, **({"parts": parts} if parts > 1 else {}))
        ramp = RAMP_CROSSINGS if parts > 1 else 0
        for number in range(1, parts + 1):
            begin = partial(self._begin_excavation, found, number, parts)
            over = partial(self._has_come_to_rest, ramp + REST_CROSSINGS, ramp)
            entered = self._damped_stage(begin, over, "excavation")
            if entered and not self.diverged and not self._is_at_rest():
                imbalance = self._balance_of_all().largest
                raise SimulationError(
                    f"excavate: imbalance = {imbalance:.2g} of the largest force, must fall below "
                    f"{AT_REST}, {number} of {parts} parts released; {self._most_borne}; reduce "
                    "the loads, excavate less, or release in more parts"
                )

    def _begin_excavation(self, found: Excavation, number: int, parts: int) -> Span:
        if number == 1:
            self._take_away(found, gradually=parts > 1)
        if parts == 1:
            return self._begin_rest(REST_CROSSINGS)
        span = self._begin_rest(RAMP_CROSSINGS + REST_CROSSINGS)
        wall = self.built.required(wrapper.ReleaseController)
        wall.startPart, wall.part = wall.part, 1.0 - number / parts
        wall.rampSteps = span.longest // (RAMP_CROSSINGS + REST_CROSSINGS) * RAMP_CROSSINGS
        wall.rampBegin = -1
        return span

    def _take_away(self, found: Excavation, *, gradually: bool) -> None:
        """Erase the cells; for a gradual excavation an engine keeps their forces on the wall."""
        solver, bodies = self.built.solver, yade.O.bodies
        cells = [int(n) for n in found.cells if bodies[solver.bodyIds[int(n)]] is not None]
        if not cells:
            raise InputError(
                f"excavate: name = {found.name}, is already excavated; give another name or leave "
                "it out"
            )
        earlier = self.built.engine(wrapper.ReleaseController)
        if earlier is not None and earlier.part > 0.0:
            raise InputError(
                f"excavate: name = {found.name}, begins before the previous excavation is in "
                "equilibrium; wait for its end"
            )
        self._require_hanging(found, np.array(cells))
        nodes, forces = solver.wallForces(cells) if gradually else ([], [])
        self._scales = None
        if not self._begun:
            self._from_now = True
        for cell in cells:
            bodies.erase(solver.bodyIds[cell])
        solver.counts()  # they are gone from here on
        if gradually:
            self.built.remove_engines(earlier)
            wall = wrapper.ReleaseController(nodes=nodes, forces=forces, part=1.0)
            self.built.add_engines(before=(wall,))

    def _require_hanging(self, found: Excavation, cells: IntArray) -> None:
        """Reject cells whose removal cuts others off, or removes all nodes of a fixed set."""
        where = f"excavate: name = {found.name}"
        numbers, places = self.built.solver.nodePlaces(bonded=True)
        lost = set(numbers[found.contains(places)].tolist())
        for part in self._all_parts:
            if isinstance(part, HeldNodes) and part.nodes and lost.issuperset(part.nodes):
                raise InputError(f"{where}, contains {part}; pass other nodes to hold")
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
                f"{where}, leaves {len(last)} grains at ({x:.4g}, {y:.4g}) m without a connection "
                "to a part; excavate them too, or excavate less"
            )
