# SPDX-License-Identifier: GPL-3.0-or-later
"""The course of a test: stages, progress, checkpoints, and an orderly end when interrupted."""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median
from typing import Any

import yade

from ..progress import Progress
from .checkpoint import Checkpoint

#: Name of YADE's scene in memory.
_MARK = "flexpm"
#: Wall time after which progress is shown [s].
_LOOK_UP = 0.1


class Course:
    """Runs the stages of a test one after the other; a resumed run skips those that are over.

    All that a stage needs to go on is in YADE's scene, or follows from it and the inputs.
    """

    def __init__(self, checkpoint: Checkpoint, progress: Progress | None) -> None:
        self._checkpoint, self._progress = checkpoint, progress
        self._stages = 0
        self._spans: list[float] = []

    def __call__(self, done: float, expected: float, text: str) -> None:
        """Show progress."""
        if self._progress is not None:
            self._progress(done, expected, text)

    @property
    def stage_start(self) -> int:
        """Step at which the present stage began."""
        return self._checkpoint.stage_start

    @property
    def resumed_at(self) -> int | None:
        """Step at which an earlier run was taken up, or None."""
        return self._checkpoint.resumed_at

    @property
    def step_time(self) -> float | None:
        """Median wall time of a step [s], of the earlier run if this one did none."""
        return median(self._spans) if self._spans else self._checkpoint.step_time

    def stage(self, prepare: Callable[[], None], advance: Callable[[], Any]) -> Any:
        """Do the next stage of the test.

        Args:
            prepare: Sets the scene up for the stage; done once, not when the stage is resumed.
            advance: Runs to the end of the stage from any step of it.

        Returns:
            What `advance` has returned, None for a stage that is over.
        """
        self._stages += 1
        if self._checkpoint.stage > self._stages:
            return None
        if self._checkpoint.stage < self._stages:
            prepare()
            self._checkpoint.stage = self._stages
            self._checkpoint.stage_start = yade.O.iter
        return advance()

    def step(self, count: int) -> None:
        """Step `count` times."""
        begin = time.perf_counter()
        for _ in range(count):
            yade.O.step()
        self._spans.append((time.perf_counter() - begin) / count)

    def renew(self, rebind: Callable[[], None]) -> None:
        """Save the scene and go on from it as a file would give it back.

        YADE does not save the order of its interactions and what its collider has found. A run
        that depends on these has the same bits whether it is killed or not only if it loads its
        scene at each checkpoint, and has its checkpoints at fixed steps.

        Args:
            rebind: Takes over the objects of the scene that has been loaded.
        """
        self._save()
        yade.O.saveTmp(_MARK, quiet=True)
        yade.O.loadTmp(_MARK, quiet=True)
        rebind()

    def finish(self) -> None:
        """Save the last state, so that a run into the same folder finds it done."""
        self._save()

    def run_to(
        self,
        end: int,
        *,
        expected: float,
        text: Callable[[], str] = str,
        over: Callable[[], bool] = bool,
    ) -> None:
        """Run until step `end` or until `over` is true, which an engine brings about.

        An interruption saves a checkpoint before it goes on to the caller.

        Args:
            end: Step at which to end.
            expected: Steps that the whole test will probably take, for the progress.
            text: Tells how the test stands.
            over: Whether the test is over before `end`.

        Raises:
            RuntimeError: if an engine has failed.
        """
        omega = yade.O
        try:
            while omega.iter < end and not over():
                self._step_on(end, over)
                self(omega.iter, max(expected, 1.05 * omega.iter), text())
                if self._checkpoint.due:
                    self._save()
        except Exception:
            raise
        except BaseException:  # an interruption, which Python lets through between two steps
            self._save()
            raise

    def _step_on(self, end: int, over: Callable[[], bool]) -> None:
        """Step until it is time to look up."""
        # O.run works in a thread, and waiting for it loses exceptions of engines that come early
        step, number = yade.O.step, yade.O.iter
        first, begin = number, time.perf_counter()
        while number < end and time.perf_counter() - begin < _LOOK_UP and not over():
            step()
            number += 1
        self._spans.append((time.perf_counter() - begin) / (number - first))

    def _save(self) -> None:
        self._checkpoint.step_time = self.step_time
        self._checkpoint.save()
