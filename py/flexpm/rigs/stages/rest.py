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
        """Let the specimen come to rest under its weight, which rises from 0 where nothing moved.

        Damping is on meanwhile (0.7, if it was below 0.2) and then what it was. At rest the
        reactions of the parts are the weight within 0.1 %. Displacements, strains and gauges of a
        record that begins later count from there on; it has its first row as a loading begins.
        Until then `reading` returns what a gauge reads.

        Args:
            moving: What the weight sets in motion, as a block that slides or topples, goes on: no
                error then, and damping ends after the transits.
            transits: Times that a wave takes through the specimen, or a quarter of its slowest
                swing, after which it must be at rest, or with `moving` damping ends, beside ten in
                which the weight rises.

        Raises:
            InputError: without gravity, or without parts.
            SimulationError: if it does not come to rest.
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
                f"settle: reactions lack {self._missing_reaction:.2g} of the weight of "
                f"{self.weight:.4g} N and motion is {found.motion:.2g}, must fall below {AT_REST}; "
                f"{self._most_borne}; allow more transits, or with settle(moving=True) what "
                "slides or topples may go on"
            )

    def relax(self, *, transits: float = REST_CROSSINGS) -> None:
        """Hold what is driven, and let the stored energy come to rest.

        Damping is on meanwhile (0.7 if it was below 0.2, with real masses) and then what it was.
        At rest all forces balance within 0.1 % of the largest one on a part, or the stored energy
        is below 1e-7 of the largest of the record.

        Args:
            transits: Times that a wave takes through the specimen after which it must be at rest.

        Raises:
            SimulationError: if it does not come to rest.
        """
        transits = require_number("relax: transits", transits, CROSSINGS)
        self._require_scene("relax")
        self._tell("relax", transits=transits)
        self._come_to_rest("relax", transits)

    def dwell(self, transits: float = 10.0, *, by: str = "displacement") -> None:
        """Go on for a time while what is driven stands, or while its load stays.

        Args:
            transits: Times that a wave takes through the specimen.
            by: ``"displacement"``: the driven parts stand; ``"load"``: they go where the load
                stays within 0.1 % of what it is as the dwell begins, and no damping is changed.

        Raises:
            InputError: for a load without a part that loads.
            SimulationError: if the load does not stay.
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
        """Take the load of the driven parts back to 0, where all is at rest; pressures stay.

        Args:
            rate: Factor on the default loading rate, at the fastest [-].
            transits: Times that a wave takes through the specimen for the last of the load, beside
                those of the way back.

        Raises:
            InputError: if no loading has begun.
            SimulationError: if the load does not come to 0.
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
        """Steps of a quarter of the slowest swing under the weight, 0 where nothing holds it: D74.

        Rayleigh's quotient of the static solution: what stands on few or soft contacts rocks far
        more slowly than a wave crosses it. A column that swings along itself has the crossing,
        and so has a solid, whose static solution is without weight.
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
        """Ratio of the missing reactions of all parts to the weight [-]; 0 if fluids press, too."""
        if self._force_of_fluids:
            return 0.0
        *across, up = np.sum([part.force for part in self._all_parts], axis=0)
        return math.hypot(*across, up - self.weight) / self.weight


def _risen(part: float) -> float:
    """Return the share of the weight after a share of its ramp, smooth at both ends [-]."""
    return part * part * (3.0 - 2.0 * part)
