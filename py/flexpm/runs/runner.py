# SPDX-License-Identifier: GPL-3.0-or-later
"""Runner of a test: stages, progress, checkpoints, and an orderly end when interrupted."""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median
from typing import NamedTuple

import yade

from ..errors import SimulationError
from ..progress import Progress
from ..threads import for_scenes
from .checkpoint import PAUSE, Checkpoint, Position

#: Name of YADE's scene in memory.
_MARK = "flexpm"
#: Wall time after which progress is shown [s].
_LOOK_UP = 0.1
#: Look whose steps tell how long a stage takes; the first has steps that prepare others.
_TIMED_LOOK = 2


#: Takes the steps that a run will probably have and the wall time of those that are left [s].
Foresee = Callable[[int, float], None]


class Span(NamedTuple):
    """Length of a stage in steps."""

    longest: int  #: it ends there in any case
    likely: int  #: for the progress


class Runner:
    """Runs the stages of a test in sequence; a resumed run skips finished stages.

    YADE's scene and `position` have all data that a stage needs to continue.

    Attributes:
        position: Progress of the run.
        stages: Number of stages that have been requested.
    """

    def __init__(
        self,
        checkpoint: Checkpoint | None = None,
        progress: Progress | None = None,
        foresee: Foresee | None = None,
        position: Position | None = None,
    ) -> None:
        """Start from a position, by default the position of the checkpoint.

        Args:
            checkpoint: Where the scene is saved; None saves nothing.
            progress: Function that is called with (steps done, steps expected, text).
            foresee: Function that is called once, when steps of the loading have been timed.
            position: Position of the run, which the checkpoint saves from now on. A position at the
                end of a stage skips that stage.
        """
        self._checkpoint, self._progress, self._foresee = checkpoint, progress, foresee
        if checkpoint is not None and position is not None:
            checkpoint.position = position
        self.position = checkpoint.position if checkpoint else position or Position()
        self.stages = 0
        #: Writes the tables of a stage that is under way, beside its checkpoints.
        self.leave: Callable[[], None] | None = None
        self._left, self._took = time.perf_counter(), 0.0
        self._spans: list[float] = []

    @property
    def step_time(self) -> float | None:
        """Median wall time of a step [s], of the earlier run if this one did none."""
        return median(self._spans) if self._spans else self.position.step_time

    @property
    def has_begun(self) -> bool:
        """Whether an earlier start has begun the stage that comes next."""
        return self.stages < self.position.stage

    def enter(self, prepare: Callable[[], Span]) -> bool:
        """Begin the next stage of the test.

        Args:
            prepare: Sets the scene up for the stage; called once, not when the stage is resumed.

        Returns:
            Whether steps remain: False for a stage that an earlier start has finished, or a stage
            without steps, after which a slower loading begins.
        """
        number, position = self.stages + 1, self.position
        if position.stage < number:
            span = prepare()
            position.stage, position.stage_start = number, yade.O.iter
            position.stage_end = position.stage_start + span.longest
            position.stage_likely = position.stage_start + span.likely
        self.stages = number  # one that cannot be prepared is none
        return position.stage == number and position.stage_end > position.stage_start

    @property
    def is_between(self) -> bool:
        """Whether all stages until now are over and the next stage has not begun."""
        return self.position.stage == self.stages

    def run(
        self,
        step: Callable[[], None],
        over: Callable[[], bool],
        text: Callable[[], str],
        *,
        save: bool = True,
        foreseen: bool = False,
    ) -> None:
        """Run to the end of the stage, or until it is over.

        An interruption saves a checkpoint before it reaches the caller.

        Args:
            step: Function that does a step.
            over: Function that returns whether the stage is over before its end.
            text: Function that returns the state of the test.
            save: Whether the scene may be saved after any step.
            foreseen: Function that reports the expected time of the run, which this stage ends.

        Raises:
            RuntimeError: if an engine has failed.
        """
        looks = 0
        try:
            while yade.O.iter < self.position.stage_end and not over():
                self._step_on(step, over)
                looks += 1
                if foreseen and looks == _TIMED_LOOK:
                    self._tell_expected()
                self._show(text())
                if save and self._checkpoint is not None and self._checkpoint.due:
                    self.save()
                if self._is_behind:
                    self._leave()
        except Exception:
            raise
        except BaseException:  # an interruption, which Python lets through between two steps
            if save:
                self.save()
            self._leave()
            raise

    def reload(self) -> None:
        """Save the scene and continue from it as if it had been read from a file.

        YADE does not save the order of its interactions and the state of its collider. If a run
        depends on these, its bits are independent of interruptions only if it reloads its scene at
        each checkpoint, and has its checkpoints at fixed steps.
        """
        self.save()
        yade.O.saveTmp(_MARK, quiet=True)
        with for_scenes():
            yade.O.loadTmp(_MARK, quiet=True)

    def save(self) -> None:
        """Save the present state."""
        self.position.step_time = self.step_time
        if self._checkpoint is not None:
            self._checkpoint.save()

    @property
    def _is_behind(self) -> bool:
        """Whether it is time to write the present tables, for scenes that are not saved."""
        if self._checkpoint is None:
            return False
        pause = max(self._checkpoint.interval, PAUSE * (self._took - 1.0))
        return time.perf_counter() - self._left > pause

    def _leave(self) -> None:
        """Write the present tables."""
        if self.leave is None:
            return
        begin = time.perf_counter()
        self.leave()
        self._left = time.perf_counter()
        self._took = self._left - begin

    def _step_on(self, step: Callable[[], None], over: Callable[[], bool]) -> None:
        """Step until it is time to look up."""
        # O.run works in a thread, and waiting for it loses exceptions of engines that come early
        number = first = yade.O.iter
        end = self.position.stage_end
        begin = time.perf_counter()
        while number < end and time.perf_counter() - begin < _LOOK_UP and not over():
            step()
            number += 1
        if number > first:  # else the machine has stood still meanwhile
            self._spans.append((time.perf_counter() - begin) / (number - first))

    def _tell_expected(self) -> None:
        """Report where the stage will probably end and when, from the pace of the last steps."""
        likely = self.position.stage_likely
        left = likely - yade.O.iter
        if self._foresee is not None and left > 0:
            self._foresee(likely, left * self._spans[-1])
            self._foresee = None

    def _show(self, text: str) -> None:
        if self._progress is not None:
            done, bodies = yade.O.iter, len(yade.O.bodies)
            self._progress(done, max(self.position.stage_likely, 1.05 * done), text)
            if yade.O.iter != done or len(yade.O.bodies) != bodies or not yade.O.engines:
                raise SimulationError(
                    f"progress: the callback changed the scene (step {done} to {yade.O.iter}, "
                    f"{bodies} to {len(yade.O.bodies)} bodies); it may only read"
                )
