# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading and stepping of a specimen: the stages of which tests consist. SI units."""

from __future__ import annotations

import contextlib
import math
import sys
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import NoReturn

import numpy as np
import yade
from yade import EnumClass_TestState as TestState

from ..errors import InputError, SimulationError
from ..files import Table
from ..models.grains import Model
from ..models.spheres import SphereModel
from ..require import quoted, require_number
from ..results import doubts, measures
from ..results.result import Result
from ..runs.loading_rate import WAITING_MODELS, Loading, Schedule
from ..runs.loading_start import LoadingStart
from ..runs.runner import Runner, Span
from ..threads import limited
from .approach import ROWS, TRANSITS, Approach
from .outcome.calls import Keeper
from .outcome.folder import save
from .readings import RigReadings, ended_rising

BOTTOM, RIGHT, TOP, LEFT = range(4)

#: Wave crossings over which an isotropic pressure rises.
RAMP_CROSSINGS = 10
#: Most wave crossings until the forces then balance.
REST_CROSSINGS = 100
#: Forces balance once each part of what presses that is not borne is below this [-] ...
AT_REST = 0.001
#: ... and the largest unbalanced force below this part of the mean contact force [-].
NODES_AT_REST = 0.01
#: Measurements of the balance while a wave crosses the specimen, at least.
MEASURED_A_CROSSING = 8
#: Stages that end at rest, or with an error.
_AT_REST_STAGES = ("confine", "press", "fluid", "settle", "relax", "unload", "cycle", "excavate")
#: What the state of a record that has ended says.
_ENDS: dict[int, str] = {
    TestState.past_peak: "drop",
    TestState.plateau_reached: "plateau",
    TestState.largest_strain_reached: "largest_strain",
}
#: Steps, all of them recorded, of the way along the elastic solution.
_PRELOAD_STEPS = 20
#: Steps by which the end of a stage may be seen late.
_LATEST_LOOK = 1000
#: A strain is reached within this multiple of the steps that the ends need for it.
_PATIENCE = 4


class TestRig(RigReadings):
    """A specimen in YADE's scene between ends that load it.

    A test is a sequence of its stages: calls of `confine`, `load` and `strain_to`. Each stage sets
    the scene up and steps to its end. In a run that resumes from a checkpoint, finished stages are
    skipped and the interrupted stage continues. A stage therefore makes all of its changes at its
    beginning, or repeats them with the same outcome.
    """

    __test__ = False  # no test of pytest
    #: Whether a scene that was saved after any step continues to the same bits.
    saves_anywhere = True

    def __init__(
        self, built: Model | SphereModel, *, tension: bool = False, runner: Runner | None = None
    ) -> None:
        """Take a specimen that has just been built, or whose scene has been loaded."""
        super().__init__(built, tension=tension)
        self._runner = runner or Runner()
        done = yade.O.iter  # what came before is not known
        #: What has been done so far, as plain values: each stage, and the steps at its ends.
        self.stages: list[Table] = [{"stage": "found", "last_step": done}] if done else []
        self._watching = False
        self._coming: Table | None = None  # the stage that has been asked for, until it begins
        #: Called after each step.
        self.watch: Callable[[TestRig], None] | None = None
        #: Writes the folder of a script's own test, if it has one.
        self.kept: Keeper | None = None

    def confine(self, pressure: float) -> None:
        """Press on the top and the sides until the specimen is in equilibrium; the bottom is fixed.

        In equilibrium the reactions and the mean stress of the specimen differ from the pressure by
        less than 0.1 %. The remaining waves are smaller than 0.1 %, too. Strains are measured from
        this state.

        Args:
            pressure: Confining pressure on all sides [Pa].

        Raises:
            SimulationError: if the forces do not reach equilibrium.

        Example:
            >>> rig = flexpm.rig(flexpm.build(specimen))
            >>> rig.confine(1e6)
            >>> print(f"{rig.confinement / 1e6:.0f} MPa, {rig.ended_by}")
            1 MPa, equilibrium
        """
        self._tell("confine", pressure=pressure, **self._pressed_part)
        begin = partial(self._begin_confinement, pressure)
        entered = self._stage(begin, self._at_rest, "isotropic pressure")
        if entered and not self.diverged and not self._at_rest():
            found = self.balance()
            raise SimulationError(
                f"confine: imbalance = {found.largest:.2g} of {pressure:g} Pa (reactions "
                f"{found.reaction:.2g}, mean stress {found.stress:.2g}, motion {found.motion:.2g}"
                f"), must fall below {AT_REST}; {self._more_balance}"
            )

    def roughen(self, friction: float) -> None:
        """Raise InputError: ends with friction are available for 3D specimens of grains only."""
        raise InputError(
            f"roughen: friction = {quoted(friction)}, is available for 3D specimens of flexible or "
            "rigid grains between platens; leave it out, or use a PartRig with friction of its "
            "plates"
        )

    def load(self, loading: Loading | None = None) -> None:
        """Drive the ends until the stress has dropped from its peak, or to the largest strain.

        Args:
            loading: Rate, start and end; None for the defaults.

        Example:
            >>> rig = flexpm.rig(flexpm.build(specimen), tension=True)
            >>> rig.load(flexpm.Loading(rate=6.0))
            >>> rig.ended_by
            'drop'
        """
        loading = Loading() if loading is None else loading
        if not isinstance(loading, Loading):
            raise InputError(
                f"load: loading = {quoted(loading)}, must be a flexpm.Loading; pass Loading(...)"
            )
        self._tell("load", **asdict(loading))
        begin = partial(self.start, loading)
        if loading.static:
            self._stage(partial(self._begin_preload, loading), self._is_over, "elastic start")
            begin = partial(self._begin_release, loading)
        entered = self._stage(begin, self._is_over)
        by_default = entered and loading.max_strain is None and not self.diverged
        ended = self._readings.state == TestState.largest_strain_reached
        if by_default and ended and measures.still_rises(self.record):
            self.stages[-1]["still_rises"] = True

    @property
    def warnings(self) -> list[str]:
        """Reasons why the record is questionable, e.g. a load that still rose at the end."""
        rose = [doubts.of_rise(self._reached)] if ended_rising(self.stages, self.record) else []
        return super().warnings + rose

    def strain_to(self, strain: float, rate: float = 1.0) -> None:
        """Load or unload at a constant rate until the record's axial strain has reached `strain`.

        Ends that only press do not pull: in a compression test the stage ends at zero stress, with
        one line on stderr.

        Args:
            strain: Axial strain at which the stage ends, at the next row of the record [-].
            rate: Factor on the default loading rate [-].

        Raises:
            InputError: for a strain or a rate out of range.
            SimulationError: if the strain is not reached.
        """
        strain = require_number("strain_to: strain", strain)
        self._tell("strain_to", strain=strain, rate=rate)
        self._go_to_strain("strain_to", strain, rate)

    def stress_to(self, stress: float, rate: float = 1.0) -> None:
        """Load or unload until the record's axial stress has reached `stress`.

        Grains are loaded as by ``Loading(kind="waiting")``, because in a steady motion damping
        would cause a drag and an uneven load. The loading slows down near the requested stress. The
        stage ends when the stress is reached within a tolerance: 0.5 % of the requested stress, or
        0.1 % of the largest earlier stress if this is more. Ends without bond cannot pull: in a
        compression test the stage ends at zero stress, with one line on stderr.

        Args:
            stress: Axial stress at the end of the stage [Pa].
            rate: Factor on the default loading rate [-].

        Raises:
            InputError: for a stress or a rate out of range.
            SimulationError: if the specimen does not carry the stress.
        """
        stress = require_number("stress_to: stress", stress, unit="Pa")
        self._tell("stress_to", stress=stress, rate=rate)
        self._go_to_stress("stress_to", stress, rate)

    def start(self, loading: Loading) -> Span:
        """Set the scene up as `load` does, without a step, and return the number of steps."""
        plan = self._schedule(loading)
        self._drive(plan)
        return _span(plan)

    def save(self, folder: Path | str, *, report: bool = True) -> Result:
        """Write the present results of the test into a folder, as a run does; the scene stays.

        The folder gets ``result.json``, ``curve.csv``, ``cracks.csv``, ``events.csv``,
        ``fragments.csv``, ``final.vtu``, the pictures and ``report.html``. A specimen that is not a
        plain packing adds ``grains.json``. Frames and checkpoints are not written. ``inputs`` in
        ``result.json`` has specimen, material, parts, loading and stages; ``repeatable`` is false
        there, because only the script repeats the test.

        Args:
            folder: Folder of the files; made if it does not exist. A folder in which this test was
                saved before is replaced.
            report: Also write report.html.

        Returns:
            The result, as ``Result.read`` reads it from the folder.

        Raises:
            InputError: if the folder has another run, or results of another program.
            BusyError: if another process uses it.
        """
        return save(self, self.stages, folder, report=report, step_time=self._runner.step_time)

    def keep_start(self, start: LoadingStart) -> None:
        """Store the scene from which slower loadings restart, unless it is stored or has passed.

        Scenes that cannot resume at any step are not kept: their test restarts from the beginning.
        """
        runner = self._runner
        wanted = runner.is_between and not runner.position.start
        if wanted and self.saves_anywhere and not self.diverged:
            start.keep(runner.position)

    def looked_at(self) -> contextlib.AbstractContextManager[None]:
        """Context for reading the state at any time, without effect on the later results."""
        return contextlib.nullcontext()

    @property
    def ended_by(self) -> str | None:
        """Event that has ended the last stage.

        ``drop``: the deviator dropped to the stop ratio; ``plateau``: it was constant;
        ``largest_strain``; ``equilibrium``: the specimen is at rest. None: no such event.
        """
        if self.diverged or not self.stages:
            return None
        if self.stages[-1]["stage"] in _AT_REST_STAGES:
            return "equilibrium"
        return _ENDS.get(self._readings.state)

    def finish(self) -> None:
        """Update YADE's objects, for scripts that continue, and save the last state.

        A test with a folder also gets its pictures and its report, as at the end of its script.
        """
        self._synchronize()
        if not self.diverged:
            self._runner.save()
        if self.kept is not None:
            self.kept.draw()

    # What each kind of rig does in its own way

    @abstractmethod
    def _press(self, pressure: float, ramp: int) -> None:
        """Press on the top and the sides, rising over `ramp` steps, and fix the bottom."""

    def _measure_every(self, steps: int) -> None:
        """Measure the balance of forces at least every `steps`; most rigs do so at each step."""

    @abstractmethod
    def _drive(self, plan: Schedule) -> None:
        """Drive the ends by a plan from now on; the first call begins the record."""

    @property
    @abstractmethod
    def row_period(self) -> int:
        """Steps from one row of the record to the next."""

    @abstractmethod
    def _limit_speed(self, speed: float, velocity: float) -> None:
        """Move the ends on at a speed, which is at most the velocity times its factor.

        Args:
            speed: Positive in the sense of the loading [m/step, or m/s with real masses].
            velocity: At a factor of 1 [the same].
        """

    @property
    def may_pull(self) -> bool:
        """Whether the ends can pull the specimen: grips or bonded plates."""
        return self.tension

    @property
    def _more_balance(self) -> str:
        """Remedy if forces do not reach equilibrium."""
        return "lower the pressure"

    def _crossing_steps(self) -> float:
        """Steps in which a wave crosses the specimen, before it is loaded."""
        return self.scales().crossing_steps

    def _preload(self, steps: int) -> None:
        """Advance by `steps` along the elastic solution, close to the first crack."""
        self._refuse_preload()

    def _release(self) -> None:
        """Release the nodes that the preload has moved."""
        self._refuse_preload()

    def _refuse_preload(self) -> NoReturn:
        raise SimulationError(
            f"load: static = True, must be False for model {self.built.name}; leave it out"
        )

    def _step(self) -> None:
        yade.O.step()

    def _watched_step(self) -> None:
        self._step()
        if self.kept is not None:
            self.kept.look()
        if self.watch is None:
            return
        done = yade.O.iter
        self._watching = True
        try:
            self.watch(self)
        finally:
            self._watching = False
        if yade.O.iter != done or not yade.O.engines:
            raise SimulationError(
                f"watch: the callback changed the scene (step {done} to {yade.O.iter}, "
                f"{len(yade.O.engines)} engines); it may only read"
            )

    @property
    def has_scale(self) -> bool:
        """Whether the strain at failure is known, so that frames can be spaced."""
        return True

    @abstractmethod
    def _synchronize(self) -> None:
        """Update YADE's objects."""

    # Stages

    @property
    def _pressed_part(self) -> Table:
        """Part on which `confine` acts; empty if it acts on all sides."""
        return {}

    def _tell(self, stage: str, **values: object) -> None:
        plain = {k: v.item() if isinstance(v, np.generic) else v for k, v in values.items()}
        self._coming = {"stage": stage, **plain}

    def _stage(self, begin: Callable[[], Span], over: Callable[[], bool], text: str = "") -> bool:
        """Run a stage; False if an earlier start has finished it, or the run has diverged."""
        if self._watching:
            name = self._coming["stage"] if self._coming else text
            raise SimulationError(
                f"watch: the callback called {name}, which steps the scene; the callback may only "
                "read"
            )
        if self.kept is not None and self._runner.has_begun:
            self._coming = None  # an earlier start has told of it
        if self.diverged or not self._runner.enter(begin):
            return False
        if self._coming is not None:
            self.stages.append({**self._coming, "first_step": yade.O.iter})
            self._coming = None
        try:
            self._step_through(over, text)
        except RuntimeError:
            if not self.diverged:
                raise
        except ValueError as error:  # an engine cannot do what it was asked for
            raise InputError(str(error)) from None
        finally:
            self.stages[-1]["last_step"] = yade.O.iter
        return True

    def _go_to_strain(self, stage: str, strain: float, rate: float) -> None:
        """Load to a strain as part of a stage, see `strain_to`."""
        found: list[Approach] = []

        def over() -> bool:
            first = self._runner.position.stage_start
            if not found:
                rest = strain - self._value_at("axial_strain", first)
                velocity = self._schedule(Loading(rate, max_strain=abs(rest))).velocity
                stops = rest < 0.0 and self._stops_at_zero
                found.append(Approach(self, velocity, None, would_pull=stops))
            return self._is_over() or found[0].is_over(first)

        entered = self._stage(partial(self._begin_way, strain, rate), over)
        if entered and not self.diverged and found[0].stopped:
            if (self.strain - strain) * self.scales().modulus > found[0].tolerance:
                self._tell_zero(f"{stage}: axial strain = {self.strain:.6g}", f"{strain:.6g}")
        elif self.diverged or (entered and not self._is_over()):
            raise SimulationError(
                f"{stage}: axial strain = {self.strain:.6g}, must come to {strain:.6g}; "
                + ("lower the rate" if self.diverged else "the specimen strains elsewhere")
                + self._borne
            )

    def _go_to_stress(self, stage: str, stress: float, rate: float) -> None:
        """Load to a stress as part of a stage, see `stress_to`."""
        found: list[Approach] = []

        def over() -> bool:
            first = self._runner.position.stage_start
            if not found:
                velocity = self._schedule(Loading(rate)).velocity
                pulls = stress < 0.0 and not self.may_pull
                found.append(Approach(self, velocity, stress, would_pull=pulls))
            return found[0].is_over(first) or self._is_over()

        entered = self._stage(partial(self._begin_stress, stress, rate), over)
        if entered and not self.diverged and found[0].stopped:
            self._tell_zero(f"{stage}: axial stress = 0 Pa", f"{stress:.6g} Pa")
        elif self.diverged or (entered and not found[0].is_there):
            raise self._does_not_bear(stage, stress)

    def _does_not_bear(self, stage: str, stress: float) -> SimulationError:
        return SimulationError(
            f"{stage}: axial stress = {self.stress:.6g} Pa, must come to {stress:.6g} Pa; the "
            f"specimen does not carry it; give a smaller stress{self._borne}"
        )

    @property
    def _stops_at_zero(self) -> bool:
        """Whether a strain is reached only as long as the ends do not pull."""
        return not self.may_pull

    def _tell_zero(self, reached: str, asked: str) -> None:
        """Print that a stage has ended at zero stress, before its target."""
        line = f"{reached}, not {asked}: the ends only press, the stage ends at zero stress"
        print(line, file=sys.stderr, flush=True)

    def approach(self, stress: float, velocity: float) -> None:
        """Bring the stress closer to a value, see `Approach`.

        Args:
            stress: Target stress [Pa].
            velocity: Largest velocity at a factor of 1 [m/step, or m/s with real masses].
        """
        self._limit_speed(self._closing_speed(stress), velocity)

    def _closing_speed(self, stress: float) -> float:
        """Return the loading speed that brings the stress closer to a value. Deviation D74."""
        scales = self.scales()
        time = max(TRANSITS * scales.crossing_steps, ROWS * self.row_period) * yade.O.dt
        return (stress - self.stress) / scales.modulus * scales.height / time * self._ahead

    @property
    def _borne(self) -> str:
        """Text for a message, about the part whose load has missed its target; empty by default."""
        return ""

    def _step_through(self, over: Callable[[], bool], text: str) -> None:
        frames = self.kept is not None and self.kept.has_frames
        with limited(self.built.threads):
            self._runner.run(
                self._step if self.watch is None and not frames else self._watched_step,
                over,
                lambda: text or self._standing(),
                save=self.saves_anywhere,
                foreseen=not text,
            )

    def _begin_confinement(self, pressure: float) -> Span:
        crossing = math.ceil(self._crossing_steps())
        self._press(pressure, RAMP_CROSSINGS * crossing)
        self._measure_every(max(crossing // MEASURED_A_CROSSING, 1))
        return Span((RAMP_CROSSINGS + REST_CROSSINGS) * crossing, 2 * RAMP_CROSSINGS * crossing)

    def _begin_preload(self, loading: Loading) -> Span:
        self.start(loading)
        self._preload(_PRELOAD_STEPS)
        return Span(_PRELOAD_STEPS, _PRELOAD_STEPS)

    def _begin_release(self, loading: Loading) -> Span:
        self._release()
        return _span(self._schedule(loading))

    def _begin_way(self, strain: float, rate: float) -> Span:
        way = strain - self.strain
        plan = self._schedule(Loading(rate, max_strain=abs(way)))
        least, largest = (-1e300, strain) if way > 0.0 else (strain, 1e300)
        velocity = math.copysign(plan.velocity, way)
        endless = replace(plan, velocity=velocity, least_peak=1e300)
        self._drive(replace(endless, min_strain=least, max_strain=largest))
        return Span(_PATIENCE * plan.steps + _LATEST_LOOK, plan.steps)

    def _begin_stress(self, stress: float, rate: float) -> Span:
        kind = "waiting" if self.built.name in WAITING_MODELS else "constant"
        plan, sense = self._schedule(Loading(rate, kind)), self._sense_to(stress, yade.O.iter)
        # a stress that falls as it is to fall is no failure
        peak = plan.least_peak if sense > 0.0 else 1e300
        plan = replace(plan, least_peak=peak, plateau_strain=0.0)
        self._drive(replace(plan, velocity=sense * plan.velocity))
        return _span(plan)

    def _sense_to(self, stress: float, step: int) -> float:
        """Return -1 if the stress at a step must decrease to reach `stress`, else 1."""
        return 1.0 if stress >= self._stress_at(step) else -1.0

    def _stress_at(self, step: int) -> float:
        """Stress of the last row of the record up to a step, 0 before the first [Pa]."""
        return self._value_at("axial_stress", step)

    def _value_at(self, column: str, step: int) -> float:
        """Value of a column in the last row up to a step, 0 before the first."""
        record = self.record
        before = record[column][record["step"] <= step]
        return float(before[-1]) if len(before) else 0.0

    def _at_rest(self) -> bool:
        """Whether forces balance under the full pressure; checked once per wave transit time."""
        start, end = self._runner.position.stage_start, self._runner.position.stage_end
        crossings, rest = divmod(
            yade.O.iter - start, (end - start) // (RAMP_CROSSINGS + REST_CROSSINGS)
        )
        if rest != 0 or crossings <= RAMP_CROSSINGS:
            return False
        return self.unbalanced() < NODES_AT_REST and self.balance().largest < AT_REST

    def _is_over(self) -> bool:
        return self.diverged or self._readings.state != TestState.running

    def _standing(self) -> str:
        peak, stress = self._readings.peak, self._readings.differential
        part = f", now {100.0 * stress / peak:3.0f} % of it" if peak > 0.0 else ""
        return f"peak {peak * 1e-6:5.1f} MPa{part}"


def _span(plan: Schedule) -> Span:
    return Span(plan.steps + _LATEST_LOOK, plan.likely_steps)
