# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages that end at rest: settling under the weight, relaxing, unloading, a dwell. SI units."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import yade
from yade import wrapper

from ...errors import InputError, SimulationError
from ...models.grains import Model
from ...models.grains import Model
from ...models.options import DAMPING
from ...require import Bounds, require_flag, require_number, require_one_of
from ...runs.loading_rate import RATE, WAITING_MODELS, Loading, Scales, Schedule
from ...runs.runner import Span
from ..grain_rig import SETTLING_DAMPING, GrainRig
from ..part_loads import PartLoads
from ..parts import HeldNodes, Part, RigPart
from ..readings import Balance
from ..rig import AT_REST, MEASURED_A_CROSSING, NODES_AT_REST, RAMP_CROSSINGS, REST_CROSSINGS

#: Stored energy over the largest so far that is none [-].
NO_ENERGY = 1e-7
#: A load is at its value within this part of it, or of the largest, where the value is 0 [-].
_LOAD_AT_REST = 0.5 * AT_REST
#: Velocity of what is steered and is where it is to be, over that of the loading [-]: a motion of
#: the loading that has stood still could not go on.
_STILL = 1e-12
#: Crossings in which a load that is steered to a value comes nearer to it by a factor of e.
_STEERING_CROSSINGS = 4.0
#: Crossings that a stage may be asked to take.
CROSSINGS = Bounds(at_least=1.0, at_most=1e6)
#: Tag of YADE's scene with the damping that is to come back: a saved scene has it, too.
_DAMPING_TAG = "flexpm_damping"
#: Directions in which a cycle or a history is told.
WAYS = ("load", "way")


class PartRest(PartLoads, GrainRig):
    """Base of a rig of parts that brings its specimen to rest."""

    built: Model
    _scales: Scales | None
    built: Model
    _scales: Scales | None
    #: Force of which a part must not be missing in balance [N]; None: that of the pressures.
    _asked_force: float | None = None
    #: Whether strains count from the state in which the record begins.
    _from_now = False

    def settle(self, *, moving: bool = False, crossings: float = REST_CROSSINGS) -> None:
        """Let the specimen come to rest under its weight, which rises from 0 where nothing moved.

        Damping is on meanwhile (0.7, if it was below 0.2) and then what it was. At rest the
        reactions of the parts are the weight within 0.1 %. Displacements, strains and gauges of a
        record that begins later count from there on.

        Args:
            moving: What the weight sets in motion, as a block that slides or topples, goes on: no
                error then, and damping ends after the crossings.
            crossings: Times that a wave takes through the specimen after which it must be at rest,
                or with `moving` damping ends, beside ten in which the weight rises.

        Raises:
            InputError: without gravity, or without parts.
            SimulationError: if it does not come to rest.
        """
        moving = require_flag("settle: moving", moving)
        crossings = require_number("settle: crossings", crossings, CROSSINGS)
        self._require_scene("settle")
        if not (self.built.dynamic and self.built.gravity > 0.0):
            raise InputError(
                f"settle: gravity = {self.built.gravity:g} m/s2, must be above 0; build with "
                "dynamic=True and gravity=9.81"
            )
        self._require_parts("settle")
        self._from_now = True
        self._tell("settle", moving=moving, crossings=crossings)
        self._asked_force = self.weight
        longest = RAMP_CROSSINGS + crossings
        begin = partial(self._begin_settling, longest)
        over = partial(self._has_settled, longest)
        entered = self._damped_stage(begin, over, "weight")
        rests = not entered or moving or self.diverged or self._bears_weight()
        found, self._asked_force = self.balance(), None
        if not rests:
            missing = max(found.largest, self._missing_reaction)
            raise SimulationError(
                f"settle: imbalance = {missing:.2g} of the weight of {self.weight:.4g} N, must "
                f"fall below {AT_REST}; {self._most_borne}; with settle(moving=True) what slides "
                "or topples may go on"
            )

    def relax(self, *, crossings: float = REST_CROSSINGS) -> None:
        """Hold what is driven, and let the stored energy come to rest.

        Damping is on meanwhile (0.7 if it was below 0.2, with real masses) and then what it was.
        At rest all forces balance within 0.1 % of the largest one on a part, or the stored energy
        is below 1e-7 of the largest of the record.

        Args:
            crossings: Times that a wave takes through the specimen after which it must be at rest.

        Raises:
            SimulationError: if it does not come to rest.
        """
        crossings = require_number("relax: crossings", crossings, CROSSINGS)
        self._require_scene("relax")
        self._tell("relax", crossings=crossings)
        self._come_to_rest("relax", crossings)

    def dwell(self, crossings: float = 10.0, *, by: str = "way") -> None:
        """Go on for a time while what is driven stands, or while its load stays.

        Args:
            crossings: Times that a wave takes through the specimen.
            by: ``"way"``: the driven parts stand; ``"load"``: they go where the load stays within
                0.1 % of what it is as the dwell begins, and no damping is changed.

        Raises:
            InputError: for a load without a part that loads.
            SimulationError: if the load does not stay.
        """
        crossings = require_number("dwell: crossings", crossings, CROSSINGS)
        require_one_of("dwell: by", by, WAYS)
        self._require_scene("dwell")
        if by == "load":
            self._require_loaded("dwell")
        self._tell("dwell", crossings=crossings, by=by)
        if by == "load":
            self._steer("dwell", None, crossings, rests=False)
        else:
            begin = partial(self._begin_rest, crossings, damped=False)
            self._stage(begin, lambda: self.diverged, "dwell")

    def unload(self, *, rate: float = 1.0, crossings: float = REST_CROSSINGS) -> None:
        """Take the load of the driven parts back to 0, where all is at rest; pressures stay.

        Args:
            rate: Factor on the default loading rate, at the fastest [-].
            crossings: Times that a wave takes through the specimen for the last of the load, beside
                those of the way back.

        Raises:
            InputError: if no loading has begun.
            SimulationError: if the load does not come to 0.
        """
        rate = require_number("unload: rate", rate, RATE)
        crossings = require_number("unload: crossings", crossings, CROSSINGS)
        self._require_loaded("unload")
        self._tell("unload", rate=rate, crossings=crossings)
        self._go_to_stress("unload", 0.0, rate)
        self._steer("unload", 0.0, crossings)

    @property
    def weight(self) -> float:
        """Weight of all grains [N]; 0 with scaled masses."""
        own = set(self.built.solver.bodyIds)
        mass = math.fsum(body.state.mass for body in yade.O.bodies if body.id in own)
        return mass * self.built.gravity

    # The weight

    def _begin_settling(self, longest: float) -> Span:
        rises = yade.O.iter == 0
        self._stand()
        self._damp()
        if rises:
            self.built.solver.gravity = (0.0, 0.0, 0.0)
        return self._span_of(longest, RAMP_CROSSINGS + 0.2 * (longest - RAMP_CROSSINGS))

    def _has_settled(self, longest: float) -> bool:
        begun = self._runner.position.stage_start
        crossing = self._crossing_of(longest)
        steps = yade.O.iter - begun
        if begun == 0 and steps <= RAMP_CROSSINGS * crossing:
            if steps % max(crossing // MEASURED_A_CROSSING, 1) == 0:
                part = _risen(steps / (RAMP_CROSSINGS * crossing))
                self.built.solver.gravity = (0.0, -part * self.built.gravity, 0.0)
            return self.diverged
        looks = steps % crossing == 0 and steps > RAMP_CROSSINGS * crossing
        return self.diverged or (looks and self._bears_weight())

    def _bears_weight(self) -> bool:
        """Whether parts and fluids bear the weight, and nothing moves."""
        return self._is_balanced() and self._missing_reaction < AT_REST

    @property
    def _missing_reaction(self) -> float:
        """What the parts together fail to bear of the weight [-]; 0 where fluids press, too."""
        if self._force_of_fluids:
            return 0.0
        x, y = np.sum([part.force for part in self._all_parts], axis=0)
        return math.hypot(x, y - self.weight) / self.weight

    # Rest

    def _come_to_rest(self, stage: str, crossings: float) -> None:
        """A part of a stage: stand until the stored energy is at rest, see `relax`."""
        begin = partial(self._begin_rest, crossings)
        entered = self._damped_stage(begin, partial(self._has_come_to_rest, crossings), stage)
        if entered and not self.diverged and not self._is_at_rest():
            found = self._balance_of_all()
            raise SimulationError(
                f"{stage}: imbalance = {found.largest:.2g} of the largest force, must fall below "
                f"{AT_REST}; {self._most_borne}; allow more crossings, or lower what loads"
            )

    def _begin_rest(self, crossings: float, damped: bool = True) -> Span:
        self._stand()
        if damped:
            self._damp()
        return self._span_of(crossings, 0.3 * crossings)

    def _has_come_to_rest(self, crossings: float) -> bool:
        steps = yade.O.iter - self._runner.position.stage_start
        looks = steps > 0 and steps % self._crossing_of(crossings) == 0
        return self.diverged or (looks and self._is_at_rest())

    def _is_at_rest(self) -> bool:
        """Whether all forces balance, or next to nothing is stored any more."""
        if self._is_empty():
            return True
        return self.unbalanced() < NODES_AT_REST and self._balance_of_all().largest < AT_REST

    def _is_empty(self) -> bool:
        """Whether the energy that is stored or moves is none beside the largest of the record."""
        energies = self.built.solver.energies()
        stored = energies["elastic_energy"] + abs(energies["kinetic_energy"])
        rows = self.record["elastic_energy"] if self._begun else np.zeros(0)
        return stored <= NO_ENERGY * float(rows.max(initial=0.0))

    def _is_balanced(self) -> bool:
        return self.unbalanced() < NODES_AT_REST and self.balance().largest < AT_REST

    def _balance_of_all(self) -> Balance:
        """Balance beside the largest force of a part or of a fluid, or the weight."""
        own = [math.hypot(*part.force) for part in self._all_parts]
        self._asked_force = max([*own, self.weight, self._force_of_fluids])
        found, self._asked_force = self.balance(), None
        return found

    @property
    def _fluids(self) -> list[wrapper.ConfinementController]:
        """Engines that press on the outline itself."""
        kind = wrapper.ConfinementController
        return [one for one in self.built.engines if isinstance(one, kind)]

    @property
    def _force_of_fluids(self) -> float:
        """Force of the largest pressure of a fluid on a width like the specimen's [N]."""
        specimen = self.built.specimen
        largest = max((one.pressure for one in self._fluids), default=0.0)
        return float(largest * specimen.equal_diameter * specimen.thickness)

    def _stand(self) -> None:
        """Stop what is driven, if a loading has begun."""
        if self._recorder.loading is not None:
            self._drive(replace(_endless(self._schedule(Loading())), velocity=0.0))

    # A load that is steered

    def _steer(
        self, stage: str, stress: float | None, crossings: float, *, rests: bool = True
    ) -> None:
        """A part of a stage: drive on until the load is what it is to be, and all at rest.

        Args:
            stage: Name of the stage.
            stress: That of the record to come to [Pa]; None: that as this part begins.
            crossings: Most wave crossings that it takes, or all, if nothing must rest.
            rests: End as all is at rest, with damping meanwhile.
        """
        targets: list[float] = []

        def over() -> bool:
            begun = self._runner.position.stage_start
            if not targets:
                targets.append(self._stress_at(begun) if stress is None else stress)
            steps = yade.O.iter - begun
            if self.diverged or steps == 0 or steps % self.built.solver.measurePeriod:
                return self.diverged
            self._move(-self._steering(targets[0]), 1.0)
            return rests and self._is_there(targets[0]) and self._is_at_rest()

        begin = partial(self._begin_steering, crossings, damped=rests)
        entered = (self._damped_stage if rests else self._stage)(begin, over, stage)
        if not entered or self.diverged:
            return
        if not (self._is_there(targets[0]) and (not rests or self._is_at_rest())):
            frame = self._frame
            raise SimulationError(
                f"{stage}: load = {self.stress * frame.area:.6g} of {self._driven_part}, must come "
                f"to {targets[0] * frame.area:.6g} within {AT_REST:g} and to rest; allow more "
                "crossings, or it does not bear the load"
            )

    def _begin_steering(self, crossings: float, damped: bool) -> Span:
        plan = self._steering_plan()
        self._drive(replace(_endless(plan), velocity=_STILL * plan.velocity))
        if damped:
            self._damp()
        return self._span_of(crossings, 0.5 * crossings)

    def _steering_plan(self) -> Schedule:
        kind = "waiting" if self.built.name in WAITING_MODELS else "constant"
        return self._schedule(Loading(kind=kind))

    def _steering(self, stress: float) -> float:
        """Velocity of the driven parts that brings the load nearer to a value."""
        scales, plan = self.scales(), self._steering_plan()
        time = _STEERING_CROSSINGS * scales.crossing_steps * yade.O.dt
        wanted = (stress - self.stress) / scales.modulus * scales.height / time
        fastest = plan.fastest * plan.velocity
        return float(np.clip(wanted, -fastest, fastest)) or _STILL * plan.velocity

    def _is_there(self, stress: float) -> bool:
        """Whether the load is within 0.1 % of a value, or of the largest for the value 0."""
        whole = abs(stress) or float(np.abs(self.record["axial_stress"]).max(initial=0.0))
        return abs(self.stress - stress) <= _LOAD_AT_REST * whole

    # Damping

    def _damped_stage(
        self, begin: Callable[[], Span], over: Callable[[], bool], text: str
    ) -> bool:
        """A stage that may put damping on, which then is what it was."""
        try:
            entered = self._stage(begin, over, text)
        finally:
            self._undamp()
        return entered

    def _damp(self) -> None:
        """Put damping on real masses that have none, until `_undamp`."""
        built = self.built
        if not built.dynamic or built.damping >= SETTLING_DAMPING:
            return
        yade.O.tags[_DAMPING_TAG] = repr(built.damping)
        built.damping = DAMPING
        built.set_masses()

    def _undamp(self) -> None:
        """Bring the damping back, and all of the weight."""
        tags = yade.O.tags
        if self._solver not in yade.O.engines:
            return
        if tags.has_key(_DAMPING_TAG) and tags[_DAMPING_TAG]:
            self.built.damping = float(tags[_DAMPING_TAG])
            tags[_DAMPING_TAG] = ""
        if self.built.dynamic:
            self.built.set_masses()

    # What there is

    def _span_of(self, longest: float, likely: float) -> Span:
        """Length of a stage by wave crossings, and its measurements."""
        crossing = math.ceil(self._crossing_steps())
        self._measure_every(max(crossing // MEASURED_A_CROSSING, 1))
        return Span(math.ceil(longest) * crossing, math.ceil(likely) * crossing)

    def _crossing_of(self, longest: float) -> int:
        """Steps in which a wave crosses the specimen, as the present stage began."""
        position = self._runner.position
        return (position.stage_end - position.stage_start) // math.ceil(longest)

    @property
    def _all_parts(self) -> list[RigPart]:
        solver = self.built.solver
        plates = [Part(self, solver, "plate", n) for n in range(len(solver.plates()))]
        sets = [HeldNodes(self, solver, "held nodes", n) for n in range(len(solver.nodeSets()))]
        return [*plates, *sets]

    @property
    def _most_borne(self) -> str:
        """The part with the largest force, in words."""
        parts = self._all_parts
        if not parts:
            return "no part bears"
        most = max(parts, key=lambda part: math.hypot(*part.force))
        x, y = most.force
        return f"{most} bears ({x:.4g}, {y:.4g}) N"

    @property
    def _driven_part(self) -> str:
        frame = self._frame
        kind, number = (
            (Part, frame.driven[0]) if frame.driven else (HeldNodes, frame.drivenSets[0])
        )
        name = "plate" if frame.driven else "held nodes"
        return str(kind(self, self.built.solver, name, number))

    def _require_parts(self, stage: str) -> None:
        if not self._all_parts:
            raise InputError(f"{stage}: parts = none, must be at least 1; lay what bears the weight")

    def _require_loaded(self, stage: str) -> None:
        """Refuse a stage of what loads before anything does."""
        self._require_scene(stage)
        if self._recorder.loading is None:
            raise InputError(f"{stage}: loading = none, must have begun; call load or stress_to")


def _endless(plan: Schedule) -> Schedule:
    """A plan at one velocity that nothing ends."""
    return replace(
        plan,
        fastest=1.0,
        running_shares=None,
        min_strain=-1e300,
        max_strain=1e300,
        least_peak=1e300,
        softening_growth=0.0,
    )


def _risen(part: float) -> float:
    """Share of the weight after a part of the time in which it rises, gently at both ends [-]."""
    return part * part * (3.0 - 2.0 * part)
