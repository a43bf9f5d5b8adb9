# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages that end at rest: settling under the weight, relaxing, unloading, a dwell. SI units."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import yade

from ...errors import InputError, SimulationError
from ...require import Bounds, require_flag, require_number, require_one_of
from ...runs.loading_rate import RATE
from ...runs.runner import Span
from ..rig import AT_REST, MEASURED_A_CROSSING, RAMP_CROSSINGS, REST_CROSSINGS
from .still import PartStill

#: Crossings that a stage may be asked to take.
CROSSINGS = Bounds(at_least=1.0, at_most=1e6)
#: Directions in which a cycle or a history is told.
WAYS = ("load", "displacement")


class PartRest(PartStill):
    """Base of a rig of parts whose specimen settles, relaxes and is unloaded."""

    def settle(self, *, moving: bool = False, transits: float = REST_CROSSINGS) -> None:
        """Step until the specimen is at rest under its weight.

        If the scene has not been stepped before, the weight rises from 0 in ten wave transit times.
        Meanwhile damping is on: a factor below 0.2 is raised to 0.7 and restored afterwards. At
        rest the reactions of the parts are equal to the weight within 0.1 %. Displacements, strains
        and gauges of a record that begins later are measured from this state; its first row is
        written when a loading begins. Until then `reading` returns the readings of the gauges.

        Args:
            moving: Accept motion under the weight, for example a block that slides or topples: no
                error is raised, and damping ends after `transits`.
            transits: Duration after which the specimen must be at rest, or, with `moving`, damping
                ends, in addition to the ten transits in which the weight rises [-]. The unit is the
                wave transit time of the specimen or, if longer, a quarter of its slowest natural
                period.

        Raises:
            InputError: without gravity, or without parts.
            SimulationError: if the specimen is not at rest by then.
        """
        moving = require_flag("settle: moving", moving)
        transits = require_number("settle: transits", transits, CROSSINGS)
        self._require_scene("settle")
        if not (self.built.dynamic and self.built.gravity > 0.0):
            raise InputError(
                f"settle: gravity = {self.built.gravity:g} m/s2, must be above 0; build with "
                "dynamic=True and gravity=9.81"
            )
        self._require_parts("settle")
        self._from_now = True
        self._tell("settle", moving=moving, transits=transits)
        self._asked_force = self.weight
        longest = RAMP_CROSSINGS + transits
        begin = partial(self._begin_settling, longest)
        over = partial(self._has_settled, longest)
        entered = self._damped_stage(begin, over, "weight")
        rests = not entered or moving or self.diverged or self._bears_weight()
        found, self._asked_force = self.balance(), None
        if not rests:
            raise SimulationError(
                f"settle: missing reactions = {self._missing_reaction:.2g} of the weight of "
                f"{self.weight:.4g} N, motion = {found.motion:.2g}, must be below {AT_REST}; "
                f"{self._most_borne}; allow more transits, or pass moving=True if blocks may "
                "still slide or topple"
            )

    def relax(self, *, transits: float = REST_CROSSINGS) -> None:
        """Stop the driven parts, and step until the specimen is at rest.

        With real masses damping is on meanwhile: a factor below 0.2 is raised to 0.7 and restored
        afterwards. At rest all forces are balanced within 0.1 % of the largest force on a part, or
        the stored energy is below 1e-7 of its maximum in the record.

        Args:
            transits: Duration after which the specimen must be at rest, in wave transit times [-].

        Raises:
            SimulationError: if the specimen is not at rest by then.
        """
        transits = require_number("relax: transits", transits, CROSSINGS)
        self._require_scene("relax")
        self._tell("relax", transits=transits)
        self._come_to_rest("relax", transits)

    def dwell(self, transits: float = 10.0, *, by: str = "displacement") -> None:
        """Step for a time at a constant displacement or a constant load of the driven parts.

        Args:
            transits: Duration in wave transit times [-].
            by: ``"displacement"``: the driven parts stop. ``"load"``: the driven parts move so that
                the load stays within 0.1 % of its value at the beginning; damping is not changed.

        Raises:
            InputError: for ``by="load"`` if no part is driven.
            SimulationError: if the load cannot be kept constant.
        """
        transits = require_number("dwell: transits", transits, CROSSINGS)
        require_one_of("dwell: by", by, WAYS)
        self._require_scene("dwell")
        if by == "load":
            self._require_loaded("dwell")
        self._tell("dwell", transits=transits, by=by)
        if by == "load":
            self._steer("dwell", None, transits, until="end")
        else:
            begin = partial(self._begin_rest, transits, damped=False)
            self._stage(begin, lambda: self.diverged, "dwell")

    def unload(self, *, rate: float = 1.0, transits: float = REST_CROSSINGS) -> None:
        """Reduce the load of the driven parts to 0, and end at rest; pressures do not change.

        Args:
            rate: Largest factor on the default loading rate [-].
            transits: Largest duration of the last part of the unloading, in wave transit times [-];
                the duration of the return displacement is added.

        Raises:
            InputError: if no loading has begun.
            SimulationError: if the load does not reach 0.
        """
        rate = require_number("unload: rate", rate, RATE)
        transits = require_number("unload: transits", transits, CROSSINGS)
        self._require_loaded("unload")
        self._tell("unload", rate=rate, transits=transits)
        self._steer("unload", 0.0, transits, rate=rate)

    def _begin_settling(self, longest: float) -> Span:
        rises = yade.O.iter == 0
        self._stand()
        self._damp()
        swing = self._swing_steps()
        if rises:
            self.built.pull_down(0.0)
        return self._span_of(longest, RAMP_CROSSINGS + 0.2 * (longest - RAMP_CROSSINGS), swing)

    def _swing_steps(self) -> float:
        """Return a quarter of the slowest natural period under the weight [steps]: deviation D74.

        Follows from Rayleigh's quotient of the static solution, since a specimen on few or soft
        contacts rocks far more slowly than a wave travels through it. Returns 0 if nothing supports
        the weight. A column that vibrates along itself has the wave transit time, and so has a 3D
        specimen, whose static solution has no weight.
        """
        try:
            ways = self.elastic().displacements
        except InputError:
            return 0.0
        square, sag = np.mean(np.sum(ways**2, axis=1)), -np.mean(ways[:, -1])
        if not sag > 0.0:
            return 0.0
        return float(0.5 * math.pi * math.sqrt(square / (self.built.gravity * sag)) / yade.O.dt)

    def _has_settled(self, longest: float) -> bool:
        begun = self._runner.position.stage_start
        crossing = self._crossing_of(longest)
        steps = yade.O.iter - begun
        if begun == 0 and steps <= RAMP_CROSSINGS * crossing:
            if steps % max(crossing // MEASURED_A_CROSSING, 1) == 0:
                self.built.pull_down(_risen(steps / (RAMP_CROSSINGS * crossing)))
            return self.diverged
        looks = steps % crossing == 0 and steps > RAMP_CROSSINGS * crossing
        return self.diverged or (looks and self._bears_weight())

    def _bears_weight(self) -> bool:
        """Whether parts and fluids carry the weight, and nothing moves."""
        return self._is_balanced() and self._missing_reaction < AT_REST

    @property
    def _missing_reaction(self) -> float:
        """Ratio of the missing reactions of all parts to the weight [-]; 0 if fluids also press."""
        if self._force_of_fluids:
            return 0.0
        *across, up = np.sum([part.force for part in self._all_parts], axis=0)
        return math.hypot(*across, up - self.weight) / self.weight


def _risen(part: float) -> float:
    """Return the share of the weight after a share of its ramp, smooth at both ends [-]."""
    return part * part * (3.0 - 2.0 * part)
