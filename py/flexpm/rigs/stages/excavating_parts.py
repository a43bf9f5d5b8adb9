# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage that takes away what lies within a line of the specimen, at once or in parts. SI units.

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
from ...results.record import ERASED_ENERGY
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
        """Take away the cells within a line of ``Specimen.with_excavations``, until all balances.

        What they store and how they move leaves as ``erased_energy``; with a record that has begun
        it is a column of it. Pressures stay, what is driven stands, and damping is on meanwhile, as
        in `relax`. Strains and gauges of a record that begins later count from there on.

        Args:
            name: Name of the excavation.
            parts: 1: they leave at once, and what they bore falls on the wall as a wave. Else the
                forces that they exert on the wall stay, and are released in so many equal parts,
                each slowly and until all is at rest. Their work is boundary work (deviation D77).

        Raises:
            InputError: for a name that the specimen has not, what is excavated already, and cells
                without which others, or held nodes, hang on nothing.
            SimulationError: if the forces do not come to balance.
        """
        found = self.built.specimen.excavation(name)
        parts = require_whole("excavate: parts", parts, _PARTS)
        self._require_scene("excavate")
        self._tell("excavate", name=name, parts=parts)
        for number in range(1, parts + 1):
            begin = partial(self._begin_part, found, number, parts)
            entered = self._damped_stage(begin, self._rests_in_part, f"excavation {number}/{parts}")
            if self._begun and entered:
                self.stages[-1][ERASED_ENERGY] = self.built.solver.energies()[ERASED_ENERGY]
            if entered and not self.diverged and not self._is_at_rest():
                imbalance = self._balance_of_all().largest
                raise SimulationError(
                    f"excavate: imbalance = {imbalance:.2g} of the largest force after part "
                    f"{number} of {parts}, must fall below {AT_REST}; {self._most_borne}; release "
                    "in more parts, or support the wall"
                )
        self.built.remove_engines(self._release)

    @property
    def _release(self) -> wrapper.ReleaseController | None:
        """What exerts the forces of excavated cells."""
        return self.built.engine(wrapper.ReleaseController)

    def _begin_part(self, found: Excavation, number: int, parts: int) -> Span:
        if number == 1:
            self._take_away(found, gradually=parts > 1)
        self._stand()
        self._damp()
        span = self._span_of(RAMP_CROSSINGS + REST_CROSSINGS, 2.0 * RAMP_CROSSINGS)
        if release := self._release:
            release.startPart, release.part = release.part, 1.0 - number / parts
            crossing = span.longest // (RAMP_CROSSINGS + REST_CROSSINGS)
            release.rampSteps, release.rampBegin = RAMP_CROSSINGS * crossing, -1
        return span

    def _rests_in_part(self) -> bool:
        steps = yade.O.iter - self._runner.position.stage_start
        crossing = self._crossing_of(RAMP_CROSSINGS + REST_CROSSINGS)
        looks = steps % crossing == 0 and steps > RAMP_CROSSINGS * crossing
        return self.diverged or (looks and self._is_at_rest())

    def _take_away(self, found: Excavation, *, gradually: bool) -> None:
        """Erase the cells, their forces on the wall kept by an engine if they go gradually."""
        solver, bodies = self.built.solver, yade.O.bodies
        cells = [int(n) for n in found.cells if bodies[solver.bodyIds[int(n)]] is not None]
        if not cells:
            raise InputError(
                f"excavate: name = {found.name}, is excavated, must be another one or left out"
            )
        if self._release is not None:
            raise InputError(
                f"excavate: name = {found.name}, must come when the forces of an excavation "
                "before are released; it has not come to balance"
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
            engine = wrapper.ReleaseController(nodes=nodes, forces=forces, part=1.0)
            self.built.add_engines(before=(engine,))

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
