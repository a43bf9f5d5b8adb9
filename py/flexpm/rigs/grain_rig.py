# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs for flexpm's grains, which engines of the plugin load and observe, paper Sec. 4.1. SI units.

Deformable grains between driven ends: boundary nodes are moved and boundary edges pressed directly.
Rigid grains, and discs of any: rigid plates with one-point contacts, sides pressed by a membrane of
independent plates.
"""

from __future__ import annotations

import functools
import math
from abc import abstractmethod
from dataclasses import replace

import numpy as np
from yade import EnumClass_TestState as TestState
from yade import wrapper

from ..arrays import FloatArray
from ..errors import InputError
from ..kinds.registry import kind_of
from ..kinds.test_kind import Rig
from ..models.grains import Model
from ..renamed import COLUMNS, present
from ..require import nearest, quoted
from ..results import doubts, measures
from ..results.record import Curve
from ..runs.loading_rate import RISE_TRANSITS, SLOWEST_WAIT, Scales, Schedule
from ..runs.runner import Runner
from .readings import Balance, Readings, balance_of, curve_of
from .rig import BOTTOM, LEFT, RIGHT, TOP, TestRig
from .weakest import scattered_strength

#: Rows of the record while a wave crosses the specimen, at least; the strain grows by no more than
#: the rate constant's part of the reference strain meanwhile.
_ROWS_A_CROSSING = 8
#: Most steps from one row to the next: so often numbers are checked.
_LONGEST_PERIOD = 100
#: Looks of a servo while a wave crosses the specimen.
_LOOKS_A_CROSSING = 100
#: Share of the elastic limit up to which a preload goes [-].
_PRELOAD_SHARE = 0.9
#: With less damping than this waves do not end within the crossings that balance may take [-].
SETTLING_DAMPING = 0.2
#: Velocity of what loads that is to stand and go on, over that of the loading [-].
STILL = 1e-12
#: Plates of the membrane on each side, paper Sec. 4.1.
_MEMBRANE_PLATES = 16


class GrainRig(TestRig):
    """Record and loading rate of grains; the type of rig decides how their ends are fixed."""

    built: Model
    #: Whether its scales follow from the contact point that softens first, by its own strength.
    _finds_weakest = False

    def __init__(
        self, built: Model, *, tension: bool = False, runner: Runner | None = None
    ) -> None:
        """Take grains that have just been built, or whose scene has been loaded."""
        super().__init__(built, tension=tension, runner=runner)
        #: Columns of the record by the second names that they are known by, too.
        self._same: dict[str, str] = {}
        self._recorder = built.engine(wrapper.AxialRecorder) or wrapper.AxialRecorder(
            frame=self._new_frame()
        )

    @property
    def record(self) -> Curve:
        """The present record."""
        return curve_of(self._recorder, self._same)

    @property
    def warnings(self) -> list[str]:
        """Reasons why the record is questionable, see `TestRig.warnings`."""
        record, recorder = self.record, self._recorder
        lines = super().warnings
        cuts = {name: cut.to_json() for name, cut in self.built.specimen.told_cuts.items()}
        if bend := self.built.joint_deviation:
            lines.append(doubts.of_bend(bend, cuts))
        lines += doubts.of_cuts(cuts)
        lines += doubts.of_gravity(self.built.gravity, self.built.damping)
        if recorder.controlled:
            missed = measures.set_point_missed(record, recorder.controlled)
            lines += doubts.of_set_point(recorder.controlled, missed)
        lines += [doubts.of_lost_gauge(name) for name in recorder.lostGauges()]
        loaded = recorder.loading is not None and self.planned
        if kind_of(self.kind).rig is Rig.PARTS and loaded:
            growth = measures.growth_before_peak(record, self.scales().crossing_steps)
            lines += doubts.of_growth(growth)  # a load that grew fast up to its peak
        return lines

    @property
    def confinement(self) -> float | None:
        """Requested confining pressure [Pa]; None without."""
        pressing = self._pressing()
        return pressing.pressure if pressing else None

    @property
    def diverged(self) -> bool:
        """Whether a number is no longer finite."""
        return self.built.solver.diverged

    @property
    def _stop_reason(self) -> str:
        return self.built.solver.stopReason

    @property
    def may_fail_at_once(self) -> bool:
        """Whether a joint may soften simultaneously, without an earlier crack. Deviation D58."""
        return self.built.specimen.edge_joints is not None

    @property
    def initial_energy(self) -> float:
        """Energy when the work began to count [J]."""
        return self.built.solver.energies()["initial_energy"]

    @property
    def contact_width(self) -> float | None:
        """Mean width on which the plates touch a disc [m]."""
        widths = [plate["contact_width"] for plate in self.built.solver.plates()]
        return float(np.mean(widths)) if self.disc else None

    def scales(self) -> Scales:
        """Return the quantities that determine the loading rate, for the present specimen.

        Raises:
            InputError: if nothing resists the loading.
        """
        try:
            found = Scales(**self._recorder.scales())
        except ValueError as error:
            raise InputError(f"load: {error}") from None
        except RuntimeError as error:  # a piece of the specimen is free to move
            raise InputError(
                f"load: {error}, or add parts that the loading does not lift"
            ) from None
        if self._finds_weakest:
            return found
        lowest = self._scattered_strength
        return found if lowest is None else replace(found, lowest_strength=lowest)

    @functools.cached_property
    def _scattered_strength(self) -> float | None:
        """Strength of the weakest contacts if strengths scatter [Pa]; no step changes it."""
        return scattered_strength(self.built, pulled=self.tension or self.disc)

    def _new_frame(self) -> wrapper.TestFrame:
        """Where the record's load and strains come from."""
        if self.disc:
            return wrapper.DiscFrame(diameter=self.built.specimen.dimensions["diameter"])
        return wrapper.RectangleFrame(tension=self.tension)

    def unbalanced(self) -> float:
        """Ratio of the largest unbalanced force to the mean contact force, last measured [-]."""
        return self.built.solver.unbalanced()

    def balance(self) -> Balance:
        """Return the missing reactions of the specimen under its pressure.

        The motion belongs to the last measured step.
        """
        return balance_of(self.built.solver, self._pressing_force())

    def _pressing_force(self) -> float:
        """Smallest force of the pressure on an entire side [N]."""
        sizes = self.built.specimen.dimensions
        side = min(sizes["width"], sizes["height"])
        return (self.confinement or 0.0) * side * self.built.specimen.thickness

    @property
    def _more_balance(self) -> str:
        damping = self.built.solver.damping
        if damping < SETTLING_DAMPING:  # real masses may have none: waves run on
            return f"damping = {damping:g}, take {SETTLING_DAMPING} or above"
        return super()._more_balance

    @property
    def _readings(self) -> Readings:
        return self._recorder

    @property
    def row_period(self) -> int:
        """Steps from one row of the record to the next."""
        return self.built.solver.measurePeriod

    def _limit_speed(self, speed: float, velocity: float) -> None:
        factor = self._recorder.loading.velocityFactor if self._recorder.loading else 1.0
        # a motion of the loading that has stood still could not go on
        now = float(np.clip(speed / factor, -velocity, velocity)) or STILL * velocity
        self._move(now if self.tension else -now, factor)

    def _drive(self, plan: Schedule) -> None:
        recorder, factor = self._recorder, 1.0
        plan = replace(plan, control=present(plan.control, COLUMNS, self._measures()))
        self._require_measure(plan.control)
        if not self.may_fail_at_once:
            plan = replace(plan, softening_growth=0.0)
        recorder.stopRatio, recorder.leastPeak = plan.stop_ratio, plan.least_peak
        recorder.minStrain, recorder.maxStrain = plan.min_strain, plan.max_strain
        recorder.plateauStrain = plan.plateau_strain
        if plan.plateau_strain:
            recorder.plateauFrom = len(recorder.rows)
        recorder.state, recorder.peak = TestState.running, 0.0
        self._end_servo()
        before = self._velocity()
        if recorder.loading is None:
            recorder.controlled = plan.control
            self._begin_record()
            recorder.loading = self._take_hold()
            undamped = plan.running_shares is not None or plan.control != ""
            real = self.built.dynamic  # a boundary condition alone: waves carry it into the grains
            recorder.loading.undampedLoading = undamped and not real
            # elastic velocities raise no wave: a loading that has them may begin at full speed;
            # one that looks ahead does so from the first row on
            ahead = plan.softening_growth > 0.0 and not plan.control
            factor = 1.0 if self.disc or ahead or real else plan.fastest
        velocity = plan.velocity if self.tension else -plan.velocity
        self._move(velocity, factor)
        if plan.rise_steps:
            factor = self._rising_factor(plan, before)
            self._move(velocity, factor)
        if waiting := self.built.engine(wrapper.CrackWaitController):
            waiting.release()
        for kind in (wrapper.LoadingRateController, wrapper.CrackWaitController):
            self.built.remove_engines(self.built.engine(kind))
        servo = self._begin_servo(plan, factor)
        if plan.fastest > 1.0 or factor < 1.0:
            self.built.add_engines(last=(self._rate_controller(plan),))
        self.built.add_engines(last=servo)

    def _velocity(self) -> FloatArray:
        """Velocity of the loading end, 0 before any loading [m/step, or m/s with real masses]."""
        loading = self._recorder.loading
        if isinstance(loading, wrapper.EndDisplacementController | wrapper.SolidLoadingController):
            return np.array((0.0, loading.velocity, 0.0)) * loading.velocityFactor
        if isinstance(loading, wrapper.PlateController):
            return np.array(loading.velocity) * loading.velocityFactor
        return np.zeros(3)

    def _rising_factor(self, plan: Schedule, before: FloatArray) -> float:
        """Return the initial velocity factor of ends with real masses: the present factor, or less.

        From rest or a reverse motion they begin slowly, and their velocity grows over wave
        transits.

        Args:
            plan: Plan whose velocity has been set.
            before: Present velocity [m/s].
        """
        loading = self._recorder.loading
        assert loading is not None
        wanted = self._velocity() / loading.velocityFactor
        part = float(np.dot(before, wanted) / np.dot(wanted, wanted))
        return float(np.clip(part, SLOWEST_WAIT * plan.fastest, plan.fastest))

    def _begin_servo(self, plan: Schedule, factor: float) -> tuple[wrapper.ServoController, ...]:
        """Return the servo of a plan with control; it replaces a prescribed motion. D51."""
        recorder = self._recorder
        if not plan.control:
            return ()
        crossing = self.scales().crossing_steps
        servo = wrapper.ServoController(
            recorder=recorder,
            ends=recorder.loading,
            velocityFactor=factor,
            fastest=plan.fastest_ends,
            crossingSteps=crossing,
            period=max(math.floor(crossing / _LOOKS_A_CROSSING), 1),
        )
        recorder.loading = servo
        return (servo,)

    def _require_measure(self, control: str) -> None:
        """Reject control of an unknown quantity, or a change of the controlled quantity."""
        possible = self._measures()
        if control and control not in possible:
            rule = f"must be one of {', '.join(possible)}" if possible else "must be left out here"
            hint = nearest(control, possible)
            raise InputError(f"Loading: control = {quoted(control)}{hint}, {rule}")
        first = self._recorder
        if control and first.loading is not None and control != first.controlled:
            raise InputError(
                f"Loading: control = {control!r}, must be as in the first loading of the record, "
                f"{first.controlled or 'none'}; start a new rig to change it"
            )

    def _measures(self) -> tuple[str, ...]:
        """Columns of the record that a servo can follow."""
        return () if self.disc else ("lateral_strain",)

    def _end_servo(self) -> None:
        """Give the ends back to themselves; the record has no set point from here on."""
        if servo := self.built.engine(wrapper.ServoController):
            self._recorder.loading, self._recorder.setPoint = servo.ends, math.nan
            self.built.remove_engines(servo)

    def _rate_controller(
        self, plan: Schedule
    ) -> wrapper.LoadingRateController | wrapper.CrackWaitController:
        crossing = self.scales().crossing_steps
        if plan.running_shares is None:
            doubling = RISE_TRANSITS * crossing if plan.fastest == 1.0 else crossing
            return wrapper.LoadingRateController(
                loading=self._recorder.loading, fastest=plan.fastest, crossingSteps=doubling
            )
        before, after = plan.running_shares
        return wrapper.CrackWaitController(
            recorder=self._recorder,
            fastest=plan.fastest,
            slowest=SLOWEST_WAIT,
            sweep=self._loaded_area() * plan.fastest * abs(plan.velocity) / self._ahead,
            runningShare=before,
            shareAfterPeak=after,
            crossingSteps=crossing,
            ofFriction=not kind_of(self.kind).slides,
            undampedDescent=self._is_free_to_fall(plan),
            fastestDescent=plan.fastest_descent,
            softeningGrowth=plan.softening_growth,
        )

    def _is_free_to_fall(self, plan: Schedule) -> bool:
        """Whether damping does not act on steady motion after the peak. Deviation D55.

        The halves of a beam would fly apart, blocks would slide past their equilibrium, and a test
        with a controlled quantity unloads at its rate.
        """
        joints = self.built.specimen.edge_joints
        return kind_of(self.kind).falls_freely and joints is None and not plan.control

    def _loaded_area(self) -> float:
        """Force over the record's stress [m2]."""
        part = 0.5 * math.pi if self.disc else 1.0  # of a disc 2P / (pi D t)
        return part * self.scales().width * self.built.specimen.thickness

    def _begin_record(self) -> None:
        solver = self.built.solver
        self._set_row_period()
        solver.mirrorPeriod = solver.checkPeriod  # nothing in a test reads the bodies
        self._recorder.fromNow = self._pressing() is not None
        self.built.add_engines(after=(self._recorder,))

    def _set_row_period(self) -> None:
        self._set_period_for(self.scales().crossing_steps)

    def _set_period_for(self, crossing: float) -> None:
        steps = math.ceil(crossing / _ROWS_A_CROSSING)
        self.built.solver.measurePeriod = min(steps, _LONGEST_PERIOD)

    def _measure_every(self, steps: int) -> None:
        solver = self.built.solver
        solver.measurePeriod = min(solver.measurePeriod, steps)

    def _preloadable(self) -> wrapper.LoadingController:
        """Driven ends that can take the specimen along its elastic solution."""
        self._refuse_preload()

    def _preload(self, steps: int) -> None:
        ends = self._preloadable()
        if self.built.dynamic:
            raise InputError("load: static = True, must be False with real masses; leave it out")
        try:
            ends.preload(_PRELOAD_SHARE, steps)
        except ValueError as error:
            raise InputError(f"load: static = True, {error}") from None
        self.built.solver.measurePeriod = 1

    def _release(self) -> None:
        self._set_row_period()
        self._preloadable().release()

    def _synchronize(self) -> None:
        self.built.solver.mirrorPeriod = 1  # a script may go on from here
        self.built.solver.mirrorBodies()

    def _pressing(self) -> wrapper.PressureController | None:
        """The engine that presses on the sides."""
        return self.built.engine(wrapper.PressureController)

    @abstractmethod
    def _take_hold(self) -> wrapper.LoadingController:
        """Fix the lower end, and remove the pressure from the upper end, which is driven next."""

    @abstractmethod
    def _move(self, velocity: float, factor: float) -> None:
        """Set the velocity of the upper end, positive away from the lower end."""


class NodeRig(GrainRig):
    """Boundary nodes and edges of deformable grains."""

    def _ends(self) -> wrapper.EndDisplacementController:
        return self.built.required(wrapper.EndDisplacementController)

    def _pressing(self) -> wrapper.ConfinementController | None:
        return self.built.engine(wrapper.ConfinementController)

    def _press(self, pressure: float, ramp: int) -> None:
        if edges := self._pressing():
            edges.startPressure, edges.pressure = edges.pressure, pressure
            edges.rampSteps, edges.rampBegin = ramp, -1
            return
        edges = wrapper.ConfinementController(
            pressure=pressure, sides=[RIGHT, TOP, LEFT], rampSteps=ramp
        )
        ends = self._new_ends(hold_top=False)
        self.built.add_engines(before=(edges, ends))

    def _take_hold(self) -> wrapper.LoadingController:
        if edges := self._pressing():
            edges.sides = [RIGHT, LEFT]  # the reaction of the top takes over there
            self.built.solver.clearPressure(TOP)
            self._ends().holdTop = True
        else:
            self.built.add_engines(before=(self._new_ends(),))
        ends = self._ends()
        if self.built.specimen.edge_joints is not None:
            # what slides lets go within the time of a wave
            ends.ofJoints, ends.renewPeriod = True, math.ceil(self.scales().crossing_steps)
        return ends

    def _new_ends(self, *, hold_top: bool = True) -> wrapper.EndDisplacementController:
        return wrapper.EndDisplacementController(
            holdTop=hold_top, elasticStart=not self.built.dynamic
        )

    def _move(self, velocity: float, factor: float) -> None:
        self._ends().velocity, self._ends().velocityFactor = velocity, factor

    def _preloadable(self) -> wrapper.LoadingController:
        return self._ends()


class PlateRig(GrainRig):
    """Rigid plates: the first plate is below, the second above."""

    def _press(self, pressure: float, ramp: int) -> None:
        self._lay_ends()
        pressed = [1, *self._lay_membranes()]
        self.built.set_masses()
        engine = wrapper.PressureController(plates=pressed, pressure=pressure, rampSteps=ramp)
        self.built.add_engines(before=(engine,))

    def _take_hold(self) -> wrapper.LoadingController:
        if membrane := self._pressing():
            membrane.plates = membrane.plates[1:]
        elif self.disc:
            self._lay_touching()
        else:
            self._lay_ends()
        # plates that touch a disc at a point press into it at first: its velocities change soon
        elastic = not (self.disc or self.built.dynamic)
        upper = wrapper.PlateController(plates=[1], elasticStart=elastic)
        self.built.add_engines(before=(upper,))
        return upper

    def _move(self, velocity: float, factor: float) -> None:
        upper = self._recorder.loading
        assert isinstance(upper, wrapper.PlateController)
        upper.velocity, upper.velocityFactor = (0.0, velocity, 0.0), factor

    def _lay_ends(self) -> None:
        for side in (BOTTOM, TOP):
            self.built.solver.addSidePlates(side, bonded=self.tension)
        self.built.set_masses()

    @property
    def _membrane_pieces(self) -> int:
        # a short specimen has fewer boundary grains than the paper's has plates
        made = self.built.specimen
        fitting = int(made.dimensions["height"] / (2.0 * made.mean_diameter))
        return max(min(_MEMBRANE_PLATES, fitting), 1)

    def _lay_membranes(self) -> list[int]:
        solver, pieces = self.built.solver, self._membrane_pieces
        return [n for side in (LEFT, RIGHT) for n in solver.addSidePlates(side, pieces=pieces)]

    def _lay_touching(self) -> None:
        """Lay plates against a disc.

        Deviation D28: the points that touch first are kept from sliding, else the disc would roll.
        """
        for normal in ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0)):
            self.built.solver.fixTangential(self.built.solver.addTouchingPlate(normal))
        self.built.set_masses()
