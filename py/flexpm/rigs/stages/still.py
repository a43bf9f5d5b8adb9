# SPDX-License-Identifier: GPL-3.0-or-later
"""Stop of a rig of parts, return to equilibrium, and control of its load to a value. SI units."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
import yade
from yade import wrapper

from ...errors import InputError, SimulationError
from ...models.grains import Model
from ...models.options import DAMPING
from ...runs.loading_rate import WAITING_MODELS, Loading, Scales, Schedule, prescribed
from ...runs.runner import Span
from ..grain_rig import SETTLING_DAMPING, STILL, GrainRig
from ..parts import HeldNodes, Part, RigPart, in_words
from ..readings import Balance
from ..rig import AT_REST, MEASURED_A_CROSSING, NODES_AT_REST
from ..statics.elastic_state import PartStatics

#: Stored energy over the largest so far that is none [-].
NO_ENERGY = 1e-7
#: A load is at its value within this part of it, or of the largest, where the value is 0 [-].
_LOAD_AT_REST = 0.5 * AT_REST
#: Tag of YADE's scene with the damping that is to come back: a saved scene has it, too.
_DAMPING_TAG = "flexpm_damping"


class PartStill(PartStatics, GrainRig):
    """Base of a rig of parts that brings its specimen to rest."""

    built: Model
    _scales: Scales | None
    _farthest: float
    #: Force of which a part must not be missing in balance [N]; None: that of the pressures.
    _asked_force: float | None = None
    #: Whether strains count from the state in which the record begins.
    _from_now = False

    @property
    def weight(self) -> float:
        """Weight of all grains [N]; 0 with scaled masses."""
        own = set(self.built.solver.bodyIds)
        mass = math.fsum(body.state.mass for body in yade.O.bodies if body.id in own)
        return mass * self.built.gravity

    def _come_to_rest(self, stage: str, crossings: float) -> None:
        """Stop until the stored energy is at rest, as a part of a stage; see `relax`."""
        begin = partial(self._begin_rest, crossings)
        entered = self._damped_stage(begin, partial(self._has_come_to_rest, crossings), stage)
        if entered and not self.diverged and not self._is_at_rest():
            found = self._balance_of_all()
            raise SimulationError(
                f"{stage}: imbalance = {found.largest:.2g} of the largest force, must fall below "
                f"{AT_REST}; {self._most_borne}; allow more transits, or reduce the loads"
            )

    def _begin_rest(self, crossings: float, damped: bool = True) -> Span:
        self._stand()
        if damped:
            self._damp()
        return self._span_of(crossings, 0.3 * crossings)

    def _has_come_to_rest(self, crossings: float, least: int = 0) -> bool:
        """Whether a stage of `least` transit times is over; checked after each transit time."""
        steps = yade.O.iter - self._runner.position.stage_start
        crossing = self._crossing_of(crossings)
        looks = steps > least * crossing and steps % crossing == 0
        return self.diverged or (looks and self._is_at_rest())

    def _is_at_rest(self) -> bool:
        """Whether all forces balance, or the stored energy is negligible."""
        if self._is_empty():
            return True
        return self.unbalanced() < NODES_AT_REST and self._balance_of_all().largest < AT_REST

    def _is_empty(self) -> bool:
        """Whether stored and kinetic energy are negligible compared with the record's maximum."""
        energies = self.built.solver.energies()
        stored = energies["elastic_energy"] + abs(energies["kinetic_energy"])
        rows = self.record["elastic_energy"] if self._begun else np.zeros(0)
        return stored <= NO_ENERGY * float(rows.max(initial=0.0))

    def _is_balanced(self) -> bool:
        return self.unbalanced() < NODES_AT_REST and self.balance().largest < AT_REST

    def _balance_of_all(self) -> Balance:
        """Return the balance relative to the largest force of a part or fluid, or to the weight."""
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
        """Stop the driven parts, if a loading has begun."""
        if self._recorder.loading is not None:
            self._drive(prescribed(0.0))

    # A load that is steered

    def _steer(
        self,
        stage: str,
        stress: float | None,
        crossings: float,
        *,
        until: str = "rest",
        rate: float = 1.0,
    ) -> None:
        """Drive until the load has reached a value, as a part of a stage.

        Args:
            stage: Name of the stage.
            stress: Target stress of the record [Pa]; None: the stress at the beginning of this
                part.
            crossings: Largest duration of the last part of the displacement [wave transit times].
            until: End of this part. ``"rest"``: the load is reached and the specimen at rest, with
                damping on; ``"there"``: the load is reached; ``"end"``: the duration is over.
            rate: Factor on the largest velocity [-].
        """
        targets: list[float] = []

        def is_done() -> bool:
            return self._is_there(targets[0]) and (until != "rest" or self._is_at_rest())

        def over() -> bool:
            begun = self._runner.position.stage_start
            if not targets:
                targets.append(self._stress_at(begun) if stress is None else stress)
            steps = yade.O.iter - begun
            if self.diverged or steps == 0 or steps % self.built.solver.measurePeriod:
                return self.diverged
            self._move(-self._steering(targets[0], rate), 1.0)
            return until != "end" and is_done()

        begin = partial(self._begin_steering, stress, crossings, until == "rest", rate)
        if not self._damped_stage(begin, over, stage) or self.diverged or is_done():
            return
        area = self._frame.area
        raise SimulationError(
            f"{stage}: load = {self.stress * area:.6g} of {self._driven_part}, must come to "
            f"{targets[0] * area:.6g} within {AT_REST:g}"
            + (" and to rest" if until == "rest" else "")
            + f"; the specimen does not carry the load, or needs more transits{self._borne}"
        )

    def _begin_steering(
        self, stress: float | None, crossings: float, damped: bool, rate: float
    ) -> Span:
        plan = self._steering_plan()
        scales = self.scales()
        way = 0.0 if stress is None else abs(stress - self.stress) / scales.modulus * scales.height
        way *= self._ahead
        back = math.ceil(2.0 * way / (rate * plan.fastest * plan.velocity * yade.O.dt))
        self._drive(prescribed(STILL * plan.velocity))
        if damped:
            self._damp()
        span = self._span_of(crossings, 0.5 * crossings)
        return Span(span.longest + back, span.likely + back // 2)

    def _steering_plan(self) -> Schedule:
        kind = "waiting" if self.built.name in WAITING_MODELS else "constant"
        return self._schedule(Loading(kind=kind))

    def _steering(self, stress: float, rate: float) -> float:
        """Velocity of the driven parts that brings the load nearer to a value. Deviation D74."""
        plan = self._steering_plan()
        fastest = rate * plan.fastest * plan.velocity
        wanted = self._closing_speed(stress)
        return float(np.clip(wanted, -fastest, fastest)) or STILL * plan.velocity

    def _is_there(self, stress: float) -> bool:
        """Whether the load is within 0.1 % of a value, or of the largest for the value 0."""
        whole = abs(stress) or float(np.abs(self.record["axial_stress"]).max(initial=0.0))
        return abs(self.stress - stress) <= _LOAD_AT_REST * whole

    # Damping

    def _damped_stage(self, begin: Callable[[], Span], over: Callable[[], bool], text: str) -> bool:
        """Run a stage that may change the damping, and restore the damping afterwards."""
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
            self.built.set_masses()
        if self.built.gravity > 0.0:
            self.built.pull_down()

    # What there is

    def _span_of(self, longest: float, likely: float, least: float = 0.0) -> Span:
        """Return the length of a stage; a transit time has at least `least` steps."""
        crossing = math.ceil(max(self._crossing_steps(), least))
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
        """Return the part with the largest force, in words."""
        parts = self._all_parts
        if not parts:
            return "no part carries a load"
        most = max(parts, key=lambda part: math.hypot(*part.force))
        return _bears(most)

    @property
    def _borne(self) -> str:
        return f"; {_bears(self._driven_part)}"

    @property
    def _driven_part(self) -> RigPart:
        frame = self._frame
        kind, number = (Part, frame.driven[0]) if frame.driven else (HeldNodes, frame.drivenSets[0])
        name = "plate" if frame.driven else "held nodes"
        return kind(self, self.built.solver, name, number)

    def _require_parts(self, stage: str) -> None:
        if not self._all_parts:
            raise InputError(
                f"{stage}: parts = none, must be >= 1; add a part that carries the weight"
            )

    def _require_loaded(self, stage: str) -> None:
        """Reject a stage of driven parts before any part is driven."""
        self._require_scene(stage)
        if self._recorder.loading is None:
            raise InputError(f"{stage}: loading = none, must have begun; call load or stress_to")


def _bears(part: RigPart) -> str:
    """A part and its force, in words."""
    return f"{part} carries {in_words(part.force, 4)} N"
