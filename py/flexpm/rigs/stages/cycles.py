# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages with a plan: load cycles, and a history of loads or displacements. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import yade

from ...arrays import FloatArray
from ...errors import InputError
from ...require import Bounds, require_number, require_one_of, require_whole
from ...runs.loading_rate import RATE, prescribed
from ...runs.runner import Span
from ..rig import REST_CROSSINGS
from .history import history_of
from .pressures import PartPressures
from .rest import WAYS

#: Cycles that one call may ask for.
_COUNT = Bounds(at_least=1, at_most=10_000)
#: Part of the way to a load that is gone ever slower, without waiting for cracks [-].
_LAST_PART = 0.25
#: Most wave crossings of that: a cracked specimen is softer than its first stiffness says.
_TO_REST = 3.0 * REST_CROSSINGS
#: A way is where a history begins within this part of the largest one of it [-].
_SAME_WAY = 1e-6


class PartCycles(PartPressures):
    """Base of a rig of parts that loads its specimen in cycles or by a history."""

    def cycle(
        self,
        amplitude: float,
        count: int = 1,
        *,
        by: str = "load",
        low: float = 0.0,
        rate: float = 1.0,
    ) -> None:
        """Load to `amplitude` and back to `low`, `count` times, and end there at rest.

        A load is reversed within 0.1 % of the requested load, or of the largest load if the
        requested load is 0. A displacement is reversed at the next row of the record.

        Args:
            amplitude: Load [N; N m with `rotate`] or displacement of the driven parts [m; rad].
            count: Number of cycles.
            by: ``"load"`` or ``"displacement"``.
            low: Load or displacement at the other end of a cycle, in the unit of `amplitude`.
            rate: Factor on the default loading rate [-]; with ``by="displacement"`` the rate is
                constant.

        Raises:
            InputError: for a value out of range, or if no part is driven.
            SimulationError: if the specimen does not carry the load.
        """
        require_one_of("cycle: by", by, WAYS)
        unit = "N" if by == "load" else "m"
        amplitude = require_number("cycle: amplitude", amplitude, unit=unit)
        low = require_number("cycle: low", low, unit=unit)
        count = require_whole("cycle: count", count, _COUNT)
        rate = require_number("cycle: rate", rate, RATE)
        if amplitude == low:
            raise InputError(
                f"cycle: amplitude = {amplitude:g} {unit}, must not be equal to low; change one of "
                "them"
            )
        self._require_scene("cycle")
        self._require_bearing("cycle", by, min(amplitude, low))
        self.scales()
        self._tell("cycle", amplitude=amplitude, count=count, by=by, low=low, rate=rate)
        for _ in range(count):
            self._go("cycle", by, low, amplitude, rate)
            self._go("cycle", by, amplitude, low, rate)
        self._end_at("cycle", by, low)

    def follow(
        self,
        times: Sequence[float] | FloatArray | Path | str,
        values: Sequence[float] | FloatArray | None = None,
        *,
        by: str = "displacement",
        rate: float = 1.0,
    ) -> None:
        """Follow a history of the load or the displacement of the driven parts.

        With real masses and ``by="displacement"`` the history is a boundary condition in time,
        linear between its rows. Waves carry it into the specimen, whose far end may be free, and
        the stage ends in motion.

        With scaled masses time has no meaning. Then, and also with ``by="load"``, the values are
        reached in sequence at the loading rate. The specimen comes to rest at the last value, and
        at a value that is equal to the value before it.

        Args:
            times: Increasing times, (n,) [s], or a CSV file. The file has a row of names, at most
                one row of units (s, N, kN, m or mm), and rows of time and value; further columns
                are ignored.
            values: One value for each time, (n,) [N, or m]; None with a file.
            by: ``"load"`` or ``"displacement"``.
            rate: Factor on the default loading rate [-]; unused with real masses and
                ``by="displacement"``.

        Raises:
            InputError: for a row that is not finite or whose time does not increase, with its
                number. Also for a displacement that does not begin at the present displacement, or
                if no part is driven.
            SimulationError: if the specimen does not carry the load.
        """
        require_one_of("follow: by", by, WAYS)
        rate = require_number("follow: rate", rate, RATE)
        instants, wanted = history_of(times, values, "N" if by == "load" else "m")
        self._require_scene("follow")
        self._require_bearing("follow", by, min(wanted))
        in_time = by == "displacement" and self.built.dynamic
        if in_time:
            self._require_driven("follow:")
            self._require_start(wanted)
            if round((instants[-1] - instants[0]) / yade.O.dt) < 1:
                raise InputError(
                    f"follow: times = {instants[-1] - instants[0]:g} s, must be >= one "
                    f"step of {yade.O.dt:g} s; give a longer history"
                )
            self._farthest = max(map(abs, wanted))
        else:
            self.scales()
        self._tell("follow", times=instants, values=wanted, by=by, rate=rate)
        if in_time:
            for row in range(1, len(wanted)):
                begin = partial(self._begin_line, instants, wanted, row)
                self._stage(begin, lambda: self.diverged)
            return
        for number, value in enumerate(wanted):
            if number and value == wanted[number - 1]:
                self._end_at("follow", by, value)
            else:
                self._go("follow", by, wanted[number - 1] if number else 0.0, value, rate)
        self._end_at("follow", by, wanted[-1])

    def _go(self, stage: str, by: str, before: float, value: float, rate: float) -> None:
        """Go to a load, decelerating in its last part, or to a displacement at a row."""
        if by == "displacement":
            self._go_to_strain(stage, value / self._frame.length, rate)
            return
        near = value - _LAST_PART * (value - before)
        self._pass_stress(stage, near / self._frame.area, rate)
        self._steer(stage, value / self._frame.area, _TO_REST, until="there", rate=rate)

    def _pass_stress(self, stage: str, stress: float, rate: float) -> None:
        """Load until the stress has passed a value, at any speed, as part of a stage."""
        senses: list[float] = []  # that with which the stage began, also if it is resumed

        def there() -> bool:
            if not senses:
                senses.append(self._sense_to(stress, self._runner.position.stage_start))
            return senses[0] * (self.stress - stress) >= 0.0

        begin = partial(self._begin_stress, stress, rate)
        entered = self._stage(begin, lambda: there() or self._is_over())
        if self.diverged or (entered and not there()):
            raise self._does_not_bear(stage, stress)

    def _end_at(self, stage: str, by: str, value: float) -> None:
        """End at rest at a load, or where the parts are."""
        if by == "load":
            self._steer(stage, value / self._frame.area, _TO_REST)
        else:
            self._come_to_rest(stage, REST_CROSSINGS)

    def _begin_line(self, times: list[float], values: list[float], row: int) -> Span:
        """Move linearly to the step closest to the time of a row; rows may share a step."""
        begun, end, last = (round((times[k] - times[0]) / yade.O.dt) for k in (row - 1, row, -1))

        def value(step: int) -> float:
            time = times[0] + step * yade.O.dt
            return values[-1] if step == last else float(np.interp(time, times, values))

        if end > begun:
            self._drive(prescribed((value(end) - value(begun)) / ((end - begun) * yade.O.dt)))
        return Span(end - begun, end - begun)

    def _require_start(self, wanted: list[float]) -> None:
        """Reject a history of displacements that does not begin at the present displacement."""
        rows = self.record["displacement"].tolist() if self._begun else []
        now = rows[-1] if rows else 0.0
        if abs(wanted[0] - now) > _SAME_WAY * max(map(abs, wanted)):
            raise InputError(
                f"follow: row 1: displacement = {wanted[0]:g} m, must be the present displacement "
                f"of the parts, {now:g} m; begin the history there"
            )

    def _require_bearing(self, stage: str, by: str, least: float) -> None:
        """Reject tensile loads on plates without bond."""
        if by == "load" and least < 0.0 and not self.may_pull:
            raise InputError(
                f"{stage}: load = {least:g} N, must not be below 0: {self._driven_part} only "
                "presses; pass bonded=True to platen or support"
            )
