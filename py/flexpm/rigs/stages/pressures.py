# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages that apply pressure: on several parts, or of a fluid on sides and holes. SI units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial

import yade
from yade import wrapper

from ...errors import InputError, SimulationError
from ...require import ANY, NOT_NEGATIVE, Bounds, quoted, require_number, require_whole
from ...runs.runner import Span
from ...specimens.kernel_input import Circle
from ..parts import Part, require_apart, require_part
from ..rig import AT_REST, RAMP_CROSSINGS, REST_CROSSINGS
from .rest import PartRest


class PartPressures(PartRest):
    """Base of a rig of parts that presses on plates and on the outline itself."""

    def fluid(
        self,
        pressure: float,
        *,
        side: int | Sequence[int] | None = None,
        hole: int | None = None,
    ) -> None:
        """Press with a fluid on sides of the outline, or on the wall of a hole, until equilibrium.

        The pressure acts on the present edges along their present normals, and stays. It rises or
        falls from the earlier pressure. Detached grains feel no pressure. Strains and gauges of
        a record that begins later are counted from this state.

        Args:
            pressure: Pressure on the outline, positive into the specimen [Pa].
            side: Indices of one or several sides, as for `platen`; sides of holes follow the outer
                sides.
            hole: Index of a hole in the order of ``holes``: all of its sides.

        Raises:
            InputError: for a side or hole that does not exist, or sides some of which another fluid
                presses.
            SimulationError: if the forces do not reach equilibrium.

        Example:
            >>> rig = flexpm.PartRig(flexpm.build(specimen))
            >>> low = rig.hold(box=((0.0, 0.0), (0.012, 1e-4)))
            >>> rig.fluid(1e6, side=2)
            >>> print(f"{low.force[1]:.0f} N")
            120 N
        """
        pressure = require_number("fluid: pressure", pressure, NOT_NEGATIVE, "Pa")
        sides = self._sides_under(side, hole)
        self._require_scene("fluid")
        there = self._fluid_on(sides)
        largest = max(pressure, there.pressure if there else 0.0)
        width = self.built.specimen.equal_diameter
        self._tell("fluid", pressure=pressure, side=sides)
        begin = partial(self._begin_fluid, pressure, sides)
        force = largest * width * self.built.specimen.thickness
        what = f"{pressure:g} Pa of a fluid on {len(sides)} sides"
        self._press_until_rest("fluid", begin, force, what)

    def _press_all(self, pressures: Mapping[Part, float]) -> None:
        """Press several parts simultaneously, see ``PartRig.press``."""
        parts, values = [], []
        for part, pressure in pressures.items():
            parts.append(require_part("press: part", self, part, Part))
            values.append(require_number("press: pressure", pressure, NOT_NEGATIVE, "Pa"))
        if not parts:
            raise InputError("press: parts = none, must be >= 1; pass a part of the rig")
        require_apart("press: part", parts)
        for part in parts:
            self._require_free(part)
        self._require_scene("press")
        numbers = [part.number for part in parts]
        self._tell("press", plates=numbers, pressures=values)
        forces = [
            max(value, self._pressure_on(part.number)) * part.area
            for part, value in zip(parts, values, strict=True)
        ]
        least = min((force for force in forces if force > 0.0), default=0.0)
        begin = partial(self._begin_pressures, numbers, values)
        what = f"{max(values):g} Pa on {len(parts)} parts"
        self._press_until_rest("press", begin, least, what)

    def _require_free(self, part: Part) -> None:
        """Reject pressure on a part that the loading drives, unless it was pressed before that."""
        if self._runner.has_begun:  # in an earlier start of the script
            return
        if self._recorder.loading is not None and part.number in self._frame.driven:
            raise InputError(
                f"press: part = {part}, is driven, must not be; press it before `load`"
            )

    def _press_until_rest(self, stage: str, begin: partial[Span], force: float, what: str) -> None:
        """Step until equilibrium relative to a force [N], with damping meanwhile."""
        self._scales = None  # joints that are closed now bear what they did not bear before
        self._from_now = True
        self._asked_force = force
        entered = self._damped_stage(begin, self._rests_under_pressure, "pressure")
        rests = not entered or self.diverged or self._bears_pressures()
        found, self._asked_force = self.balance(), None
        if not rests:
            raise SimulationError(
                f"{stage}: imbalance = {found.largest:.2g} of {what}, must fall below {AT_REST}; "
                f"{self._most_borne}; {self._more_balance}"
            )

    def _rests_under_pressure(self) -> bool:
        """Whether forces balance under the full pressures; checked once per wave transit time."""
        steps = yade.O.iter - self._runner.position.stage_start
        crossing = self._crossing_of(RAMP_CROSSINGS + REST_CROSSINGS)
        looks = steps > RAMP_CROSSINGS * crossing and steps % crossing == 0
        return self.diverged or (looks and self._bears_pressures())

    def _bears_pressures(self) -> bool:
        """Whether all forces balance; without pressure or load, whether no part carries a force."""
        engines = [*self._pressing_engines(), *self._fluids]
        pressing = any(one.pressure for one in engines) or self.weight
        if pressing or self._asked_force is None or self._recorder.loading is not None:
            return self._is_balanced()
        largest = max((math.hypot(*part.force) for part in self._all_parts), default=0.0)
        missing = math.hypot(*self.built.solver.balance()["missing_force"])
        return max(largest, missing) <= AT_REST * self._asked_force

    def _begin_pressures(self, numbers: list[int], values: list[float]) -> Span:
        before = [self._pressure_on(number) for number in numbers]
        self._let_go(numbers)
        span = self._begin_ramp()
        for number, start, pressure in zip(numbers, before, values, strict=True):
            engine = wrapper.PressureController(
                plates=[number],
                pressure=pressure,
                startPressure=start,
                rampSteps=self._ramp_of(span),
            )
            self.built.add_engines(before=(engine,))
        return span

    def _begin_fluid(self, pressure: float, sides: list[int]) -> Span:
        span = self._begin_ramp()
        if there := self._fluid_on(sides):
            there.startPressure, there.pressure = there.pressure, pressure
            there.rampSteps, there.rampBegin = self._ramp_of(span), -1
            return span
        engine = wrapper.ConfinementController(
            sides=sides, pressure=pressure, rampSteps=self._ramp_of(span)
        )
        self.built.add_engines(before=(engine,))
        return span

    def _begin_ramp(self) -> Span:
        self._damp()
        likely = 2.0 * RAMP_CROSSINGS
        return self._span_of(RAMP_CROSSINGS + REST_CROSSINGS, likely)

    def _ramp_of(self, span: Span) -> int:
        return RAMP_CROSSINGS * (span.longest // (RAMP_CROSSINGS + REST_CROSSINGS))

    def _pressing_engines(self) -> list[wrapper.PressureController]:
        """Engines that press plates."""
        kind = wrapper.PressureController
        return [one for one in self.built.engines if type(one) is kind]

    def _pressure_on(self, plate: int) -> float:
        """Return the pressure that was applied to a plate [Pa]."""
        return sum(one.pressure for one in self._pressing_engines() if plate in one.plates)

    def _let_go(self, plates: list[int]) -> None:
        """Remove plates from the engines that press them."""
        for engine in self._pressing_engines():
            engine.plates = [plate for plate in engine.plates if plate not in plates]
            if not engine.plates:
                self.built.remove_engines(engine)

    def _fluid_on(self, sides: list[int]) -> wrapper.ConfinementController | None:
        """Return the engine that presses on exactly these sides; None if none presses on any."""
        for engine in self._fluids:
            if set(engine.sides) & set(sides):
                if set(engine.sides) != set(sides):
                    raise InputError(
                        f"fluid: side = {sides}, must be all or none of the sides with one fluid, "
                        f"{list(engine.sides)}; repeat the first list"
                    )
                return engine
        return None

    def _sides_under(self, side: object, hole: object) -> list[int]:
        """Return the indices of the sides that a call names."""
        holes = self.built.specimen.holes
        outline = self.built.specimen.outline
        outside = 1 if isinstance(outline, Circle) else len(outline)
        if (side is None) == (hole is None):
            raise InputError("fluid: give exactly one of side and hole")
        if hole is not None:
            bounds = Bounds(at_least=0, at_most=len(holes) - 1)
            if not holes:
                raise InputError(
                    f"fluid: hole = {quoted(hole)}, the specimen has none; give a side"
                )
            number = require_whole("fluid: hole", hole, bounds)
            first = outside + sum(len(one) for one in holes[:number])
            return list(range(first, first + len(holes[number])))
        return sides_of(side, Bounds(at_least=0, at_most=outside + sum(map(len, holes)) - 1))


def sides_of(side: object, bounds: Bounds = ANY) -> list[int]:
    """Return one or several indices of sides that a call of ``fluid`` names, in order."""
    given = list(side) if isinstance(side, Iterable) and not isinstance(side, str) else [side]
    numbers = sorted({require_whole("fluid: side", one, bounds) for one in given})
    if not numbers:
        raise InputError("fluid: side = none, must be >= 1; give a side")
    return numbers
