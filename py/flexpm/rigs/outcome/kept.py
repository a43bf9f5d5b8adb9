# SPDX-License-Identifier: GPL-3.0-or-later
"""Folder of a custom test while it runs: its files grow, and a stopped test resumes from there.

The script makes the same calls again. Finished calls are skipped, and the interrupted stage
continues. SI units.
"""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import json
import os
import signal
import sys
import threading
import weakref
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import FrameType
from typing import TypedDict

import numpy as np
import yade

from ...errors import InputError
from ...files import Table, output_folder, read_json, refuse_folders
from ...models.grains import Model
from ...models.spheres import SphereModel
from ...renamed import current_stage
from ...results.result import Result
from ...results.result_checks import UNFINISHED
from ...runs.asked import write_report
from ...runs.checkpoint import INTERVAL, Checkpoint
from ...runs.output import BEGUN, RESULT, Output, is_of_flexpm, refuse_other_kind
from ...runs.run_spec import law_of
from ...runs.runner import Runner
from ...runs.written import FILES, about, draw_pictures, write_numbers
from ...specimens.files import given
from ..frames import COLLECTION, FRAMES, STATE, TABLE, FrameWriter, LastState, show_frames
from ..rig import TestRig
from .calls import Calls
from .folder import inputs_before, inputs_of, result_so_far

#: Entries of a solver that say how it is stepped, not what it steps.
_NO_STATE = ("ompThreads", "stepsToCome", "label", "bodyIds")


class Leaves(TypedDict, total=False):
    """Output of a custom test, see `flexpm.rig`."""

    out: Path | str | None
    frames: int
    film: str | None
    report: bool
    checkpoint_interval: float


class Terminated(BaseException):
    """SIGTERM has ended the process during a test."""


class KeptTest:
    """A custom test with a folder.

    Attributes:
        runner: Steps the test and saves checkpoints.
        calls: Calls of the script.
    """

    def __init__(
        self, built: Model | SphereModel, folder: Path | str, output: Output, interval: float
    ) -> None:
        """Resume from the folder, or begin there.

        Raises:
            InputError: if the folder has other content, or the scene has already advanced.
            BusyError: if another process uses the folder.
        """
        close_open()
        if yade.O.iter != 0:
            raise InputError(
                f"out: step of the scene = {yade.O.iter}, must be 0 at the start of a test with a "
                "folder; call O.reset() and build the specimen again"
            )
        self._name, self._output = str(folder), output
        self._folder = output_folder(folder)
        refuse_folders(self._folder, (*FILES, BEGUN, TABLE, COLLECTION, STATE))
        refuse_other_kind(self._folder, "run")
        before = inputs_before(built)
        self._before = before.to_json()
        self._checkpoint = Checkpoint(self._folder, before, interval)
        found, told = self._checkpoint.found, self._checkpoint.told
        earlier = told.get("calls", []) if found else self._calls_of_result()
        self._stages: list[Table] = [current_stage(one) for one in told.get("stages", [])]
        self._reason: str = told.get("reason", "")
        if isinstance(built, SphereModel):
            self._reason = "YADE's own spheres"
        if found:
            threads = built.threads
            self._checkpoint.restore()
            built.rebind()
            built.set_threads(threads)
        self.runner = Runner(self._checkpoint)
        self.calls = Calls(self._name, self.runner, earlier, passes=found)
        self._resumed_at = yade.O.iter if found else None
        self._result: Result | None = None  # what is written, and not drawn yet
        self._last: LastState | None = None  # the state that was written with it
        self._ended, self._doing = "", ""
        self._stop: Callable[[], None] = _nothing
        self._held: TestRig | None = None  # the rig, until the test is closed
        given.save(self._folder, built.specimen)

    @classmethod
    def of(
        cls, built: Model | SphereModel, call: str, leaves: Leaves, **asked: object
    ) -> KeptTest | None:
        """Return the output of a rig, or None if it has no output.

        Args:
            built: The specimen.
            call: Name of the call that makes the rig.
            leaves: Requested output.
            asked: Arguments of the call.

        Raises:
            InputError: for frames without a folder, and as for a new test.
        """
        unknown = leaves.keys() - Leaves.__annotations__.keys()
        if unknown:
            raise TypeError(f"{call}() got an unexpected keyword argument {min(unknown)!r}")
        output = Output(leaves.get("report", True), leaves.get("frames", 0), leaves.get("film"))
        out = leaves.get("out")
        if out is None:
            if output.frames:
                raise InputError(
                    f"{call}: frames = {output.frames}, must be 0 without out; give a folder"
                )
            return None
        made = cls(built, out, output, leaves.get("checkpoint_interval", INTERVAL))
        with made.calls.of(call, asked):
            return made

    def attach(self, rig: TestRig) -> None:
        """Watch over a rig that has just been made."""
        # a script may make its rig in a function, and has it no more when it ends
        rig.kept, self._rig, self._held = self, weakref.ref(rig), rig
        if self._resumed_at is not None:
            rig.stages = [*self._stages]
        self._checkpoint.telling = self._tell
        self._frames: FrameWriter | None = None
        if self._output.frames:
            said = about({**self._before, "confinement": 0.0})
            self._frames = FrameWriter(
                *(self._folder, self._output.frames, said, self._resumed_at),
                self._checkpoint.told.get(FRAMES),
            )
        self._mark, self._done = _mark(rig), (yade.O.iter, len(rig.stages))
        _open.append(self)

    @property
    def has_frames(self) -> bool:
        """Whether each step is to be looked at."""
        return self._frames is not None

    def look(self) -> None:
        """See a step of the rig."""
        rig = self._rig()
        if self._frames is not None and rig is not None and rig.has_scale:
            self._frames(rig)

    def before(self, name: str) -> None:
        """Begin a call; changes since the last call did not come from the rig."""
        rig = self._rig()
        assert rig is not None
        last = self.calls.made[-1]["call"]
        if rig.watch is not None:
            self._reason = self._reason or f"watch was set for {name}"
        elif _mark(rig) != self._mark:
            self._reason = self._reason or f"the scene was changed between {last} and {name}"
        self._doing = name
        self._stop = _catch_term()

    def after(self, name: str, error: BaseException | None) -> None:
        """End a call: write its outcome."""
        self._stop()
        rig = self._rig()
        assert rig is not None
        done = (yade.O.iter, len(rig.stages))
        if done != self._done:
            self._done = done
            with contextlib.suppress(*(() if error is None else (OSError, RuntimeError))):
                if error is None and not rig.diverged:
                    self.runner.save()
                self._write(rig, "" if error is None else _said(name, error))
        self._mark = _mark(rig)
        if isinstance(error, Terminated):
            os.kill(os.getpid(), signal.SIGTERM)

    def close(self) -> None:
        """Make pictures and report of the test, and unlock its folder."""
        if self in _open:
            _open.remove(self)
        self.draw()
        self._held = None
        self._checkpoint.release()

    def draw(self) -> None:
        """Make pictures and report from the last written files."""
        rig = self._rig()
        broken = _broken()
        if rig is not None and _is_there(rig) and yade.O.iter != self._done[0]:
            last = self.calls.made[-1]["call"]
            self._reason = self._reason or f"steps were made by hand after {last}"
        if rig is not None and self._is_behind(rig, broken):
            self._write(rig, broken)
        if self._result is None:
            return
        result, self._result = self._result, None
        draw_pictures(self._folder, result)
        if self._frames is not None and self._last is not None:
            self._frames.finish(self._last)
            show_frames(self._folder, self._frames.frames, result, self._output.film)
        if self._output.report:
            write_report(self._folder, result)

    def _is_behind(self, rig: TestRig, broken: str) -> bool:
        """Whether the files disagree with the end of the script."""
        if not _is_there(rig) or self.calls.missing:
            return False
        left = self._ended or self._resumed_at is not None or _mark(rig) != self._mark
        return bool(left or broken) and len(rig.stages) > 0

    def _tell(self) -> Table:
        """Return the additional content of a checkpoint; the present numbers are also written."""
        rig = self._rig()
        assert rig is not None
        if self.calls.inside and rig.saves_anywhere:
            self._write(rig, f"{self._doing} is in progress")
        told: Table = {"calls": self.calls.made, "stages": rig.stages, "reason": self._reason}
        return told if self._frames is None else {**told, FRAMES: self._frames.remember()}

    def _write(self, rig: TestRig, ended: str) -> None:
        """Write numbers, record, cracks and state as they are now."""
        inputs = inputs_of(rig, rig.stages)
        if not (self._reason or self.calls.storable):
            self._reason = "an argument of a call is no plain value"
        inputs |= {
            "damping": self._before["damping"],
            "repeatable": not self._reason,
            "calls": json.loads(json.dumps(self.calls.made)),
            "reason": self._reason,
        }
        if ended:
            inputs["doubts"] = [
                f"{UNFINISHED}: {ended}; all results up to there are here",
                *inputs["doubts"],
            ]
        result = result_so_far(rig, inputs)
        result.step_time, result.resumed_at = self.runner.step_time, self._resumed_at
        if ended:
            result.status, result.ended_by = UNFINISHED, None
        assert result.snapshot is not None
        write_numbers(self._folder, result)
        self._result, self._ended = result, ended
        if self._frames is not None:
            self._last = LastState.of(rig, result.snapshot)

    def _calls_of_result(self) -> list[Table]:
        """Calls of a test that has left its result here and no checkpoint.

        Raises:
            InputError: for a result of something else.
        """
        file = self._folder / RESULT
        if not file.exists():
            return []
        try:
            there = read_json(file)["inputs"]
            if _fixed(there) == _fixed(self._before):
                return [*there["calls"]]
        except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
            pass
        whose = "another run" if is_of_flexpm(file) else "another program"
        raise InputError(
            f"out = {self._name!r}, has a {RESULT} of {whose}, which would be replaced; choose "
            "another folder"
        )


#: What a test begins with.
_FIXED = (
    "test",
    "specimen",
    "material",
    "model",
    "points",
    "mesh",
    "dynamic",
    "gravity",
    "damping",
)


def _fixed(inputs: Table) -> Table:
    """Inputs that a test begins with, without labels."""
    found = {name: inputs[name] for name in _FIXED if name in inputs}
    return {**found, "material": law_of(inputs["material"])}


#: Tests whose script goes on; the scene is that of the last one.
_open: list[KeptTest] = []


@atexit.register
def close_open() -> None:
    """Make pictures of tests whose script has ended, or has begun another test."""
    for test in [*_open]:
        test.close()


def _mark(rig: TestRig) -> bytes:
    """Return a checksum of all that a script could change between two calls."""
    built = rig.built
    known: list[object] = [
        *(yade.O.iter, yade.O.dt, len(yade.O.bodies), built.damping, rig.diverged),
        [type(one).__name__ for one in yade.O.engines],
    ]
    digest = hashlib.sha256()
    if isinstance(built, Model) and _is_there(rig):
        solver = built.solver
        known += [{key: one for key, one in solver.dict().items() if key not in _NO_STATE}]
        known += [solver.plates(), solver.nodeSets()]
        for array in solver.snapshot().values():
            digest.update(np.ascontiguousarray(array).tobytes())
    digest.update(repr(known).encode())
    return digest.digest()


def _is_there(rig: TestRig) -> bool:
    """Whether YADE's scene is still the scene of a rig."""
    return bool(rig.built.engines) and rig.built.engines[0] in yade.O.engines


def _said(name: str, error: BaseException) -> str:
    """How a call ended, in a line."""
    if isinstance(error, KeyboardInterrupt | Terminated) or type(error).__name__ == "Terminated":
        return f"{name} was interrupted at step {yade.O.iter}"
    return f"{name} ended by {_line(error)}"


def _broken() -> str:
    """The error by which the script has ended, an empty text if it has not."""
    error = getattr(sys, "last_value", None)
    if error is None or hasattr(sys, "ps1"):
        return ""
    return f"the script ended by {_line(error)}"


def _line(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())}"[:300]


def _catch_term() -> Callable[[], None]:
    """Make SIGTERM raise an exception between two steps; return a function that undoes this."""
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        return _nothing

    def end(number: int, frame: FrameType | None) -> None:
        raise Terminated

    signal.signal(signal.SIGTERM, end)
    return partial(_undo, signal.SIGTERM)


def _undo(number: signal.Signals) -> None:
    signal.signal(number, signal.SIG_DFL)


def _nothing() -> None:
    """Undo nothing."""
