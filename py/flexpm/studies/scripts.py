# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a study that are custom tests of a script: parameters in, a folder out. SI units.

A script gets its parameters as options, ``--seed 3 --out DIR``, a function as arguments. The key of
such a run includes the bytes of the script and of the files that it imports from its folder.
"""

from __future__ import annotations

import hashlib
import inspect
import json
import modulefinder
import os
import runpy
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from subprocess import CompletedProcess

from ..errors import InputError
from ..files import Table, read_text
from ..kinds.registry import OWN
from ..require import POSITIVE, quoted, require_number
from ..results.result import Result
from ..results.result_checks import UNFINISHED
from ..runs.output import RESULT, Output
from .jobs import spelt, text_of

#: Set in a run of a function, whose script must not begin the study anew.
_WITHIN = "FLEXPM_STUDY_RUN"
#: Exit code of ``timeout`` for what it has ended, and time until that is killed then [s].
_OVER, _GRACE = 124, 20
#: Exit codes of what ends the same way each time: errors of flexpm, and a folder without a result.
_ENDS = {"flexpm.errors.InputError": 2, "flexpm.errors.SimulationError": 3}
#: Names that parameters cannot have: columns of the table, and the folder.
_TAKEN = ("out", "test", "key", "exit_code", "message")
#: Number of the way in which keys are made.
_SCHEMA = 1

Value = bool | int | float | str


@dataclass(frozen=True)
class Script:
    """A script or function that a study runs instead of a test.

    Attributes:
        file: The script, or the file of the function.
        function: Name of the function; empty for a script.
        limit: Wall time of a run [s]; None for no limit.
    """

    file: Path
    function: str = ""
    limit: float | None = None

    def __post_init__(self) -> None:
        """Reject a file that cannot be read, or a limit out of range."""
        if self.limit is not None:
            require_number("study [study] limit", self.limit, POSITIVE, "s")
        try:
            compile(read_text(self.file), str(self.file), "exec")
        except OSError as error:
            raise InputError(
                f"study script = {str(self.file)!r}, cannot be read ({error.strerror}); give a "
                "Python script"
            ) from None
        except (SyntaxError, ValueError, RecursionError) as error:
            about = " ".join(str(error).split())[:80]
            raise InputError(
                f"study script = {str(self.file)!r}, is not a Python script: {about}; correct it"
            ) from None

    def checksum(self) -> str:
        """Checksum of the script and of all files that it imports from its folder."""
        finder = modulefinder.ModuleFinder([str(self.file.parent)])
        finder.run_script(str(self.file))
        files = [getattr(one, "__file__", None) for one in finder.modules.values()]
        digest = hashlib.sha256()
        for file in sorted({self.file.resolve(), *(Path(one).resolve() for one in files if one)}):
            digest.update(hashlib.sha256(file.read_bytes()).digest())
        return digest.hexdigest()


@dataclass(frozen=True)
class ScriptJob:
    """One run of a script.

    Attributes:
        inputs: Its parameters by name.
        script: The script or function.
        checksum: Checksum of its bytes, see `Script.checksum`.
    """

    inputs: Table
    script: Script
    checksum: str
    output: Output = field(default_factory=partial(Output, report=False))

    @property
    def key(self) -> str:
        """Name of the run: a short hash of parameters, script and results number."""
        content = {
            "schema": _SCHEMA,
            "results": dict(OWN.results),
            "script": self.checksum,
            "function": self.script.function,
            "inputs": self.inputs,
        }
        text = json.dumps(content, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    @property
    def folder(self) -> str:
        """Folder of the run, relative to the folder of all runs."""
        return self.key

    def older_keys(self) -> list[str]:
        """Return earlier keys: none, because earlier results of a script are unknown."""
        return []

    def command(self, folder: Path, worker_path: Path) -> list[str]:
        """The command line for a folder, as for a job of a test."""
        file = str(self.script.file.resolve())
        limit = [] if self.script.limit is None else [f"{self.script.limit:g}"]
        timed = ["timeout", f"--kill-after={_GRACE}", *limit] if limit else []
        if self.script.function:
            given = json.dumps(self.inputs)
            what = ["-c", _CALL, file, self.script.function, given, str(folder)]
        else:
            options = [
                one for key, value in self.inputs.items() for one in (f"--{key}", text_of(value))
            ]
            what = [file, *options, "--out", str(folder)]
        return [
            *("env", "OMP_NUM_THREADS=1", "MPLBACKEND=agg", f"{_WITHIN}=1"),
            f"PYTHONPATH={worker_path}",
            *("setpriv", "--pdeathsig", "TERM", *timed),
            *(sys.executable, *what),
        ]

    def checked(self, folder: Path, done: CompletedProcess[str]) -> CompletedProcess[str]:
        """Return how a process has ended, with an exit code and a line about its folder."""
        lines = done.stderr.strip().splitlines()
        code, said = done.returncode, lines[-1] if lines else ""
        if code == _OVER and self.script.limit is not None:
            said = f"limit = {self.script.limit:g} s, is over; raise it in [study]"
        elif code == 1:
            name, _, text = said.partition(": ")
            code, said = _ENDS.get(name, code), text if name in _ENDS else said
        elif code == 0:
            code, said = _of_folder(folder)
        elif code > 0 and not said:
            said = f"the script ended by exit code {code}"
        return CompletedProcess(done.args, code, done.stdout, f"flexpm: {said}" if said else "")


_CALL = "from flexpm.studies.scripts import call; call()"


def make(script: Script, inputs: Table, checksum: str) -> ScriptJob:
    """A run of a script.

    Raises:
        InputError: for a name or a value that is no parameter.
    """
    given = {spelt(key): value for key, value in inputs.items()}
    for key, value in given.items():
        if not key.isidentifier() or key in _TAKEN:
            raise InputError(
                f"study key = {quoted(key)}, must be the name of a parameter, and none of "
                f"{', '.join(_TAKEN)}; rename it"
            )
        plain = value if isinstance(value, list) else [value]
        if not all(isinstance(one, bool | int | float | str) for one in plain):
            raise InputError(
                f"study {key} = {quoted(value)}, must be a number, a text, a truth value or a list "
                "of these; convert it"
            )
    return ScriptJob(given, script, checksum)


def of_function(
    function: Callable[..., object], runs: list[Table], limit: float | None = None
) -> list[ScriptJob]:
    """Runs of a function, which is called with ``out`` and the parameters.

    Args:
        function: At the top of a script or module; each run is a process that loads it from there.
        runs: Parameters of each run.
        limit: Wall time of a run [s]; None for no limit.

    Raises:
        InputError: for a function that no other process can load, or that does not take these
            parameters.
    """
    script = Script(_file_of(function), function.__name__, limit)
    signature, checksum = inspect.signature(function), script.checksum()
    found = [make(script, one, checksum) for one in runs]
    for job in found:
        try:
            signature.bind(out="", **job.inputs)
        except TypeError as error:
            raise InputError(
                f"study: function {function.__name__}: {error}; its arguments must be out and the "
                "parameters"
            ) from None
    return found


def _file_of(function: Callable[..., object]) -> Path:
    """Return the file that defines a function at its top level.

    Raises:
        InputError: without such a file.
    """
    name = getattr(function, "__qualname__", "")
    module = sys.modules.get(getattr(function, "__module__", None) or "")
    file = getattr(module, "__file__", None)
    if (
        not (inspect.isfunction(function) and name.isidentifier() and file)
        or getattr(module, name, None) is not function
    ):
        raise InputError(
            f"study: function = {quoted(function)}, cannot be sent to workers; define it with def "
            "at the top level of a script"
        )
    return Path(file)


def refuse_within() -> None:
    """Reject a study within a run of a study, whose process loads the script again.

    Raises:
        InputError: in such a run.
    """
    if os.environ.get(_WITHIN):
        raise InputError(
            "study: begun within a run of a study; put the call below if __name__ == "
            '"__main__": in the script'
        )


def call() -> None:
    """Call a function of a script, as the command of a run does."""
    file, name, given, out = sys.argv[1:]
    sys.argv[1:] = []
    sys.path.insert(0, str(Path(file).parent))
    runpy.run_path(file, run_name="__flexpm_study__")[name](out=out, **json.loads(given))


def parameters(**defaults: Value) -> Mapping[str, Value]:
    """Return parameters of a study's script: its options, ``--seed 3 --out DIR``, or the defaults.

    Args:
        defaults: Each parameter with its default, whose type decides between number and text.

    Returns:
        Values by name.

    Raises:
        InputError: for an unknown option, or a value of another type.
    """
    found, given = dict(defaults), sys.argv[1:]
    if len(given) % 2 or not all(one.startswith("--") for one in given[::2]):
        raise InputError(
            f"options = {quoted(' '.join(given))}, must be pairs of --name value; complete them"
        )
    for option, text in zip(given[::2], given[1::2], strict=True):
        name = spelt(option.removeprefix("--"))
        if name not in defaults:
            raise InputError(f"option = {quoted(option)}, unknown; known are {', '.join(defaults)}")
        found[name] = _like(option, text, defaults[name])
    return found


def _like(label: str, text: str, default: Value) -> Value:
    """A text as a value of the default's kind."""
    kind = type(default)
    if isinstance(default, bool):
        if text.lower() in ("true", "false"):
            return text.lower() == "true"
        raise InputError(f"{label} = {quoted(text)}, must be true or false; choose one")
    try:
        return kind(text)
    except ValueError:
        raise InputError(
            f"{label} = {quoted(text)}, must be of type {kind.__name__}; correct it"
        ) from None


def _of_folder(folder: Path) -> tuple[int, str]:
    """Return exit code and line for the folder of a script that has ended without error."""
    if not (folder / RESULT).is_file():
        return 3, f"no {RESULT} was left in the folder of the run; give out to flexpm.PartRig"
    try:
        result = Result.read(folder)
    except InputError as error:
        return 3, str(error)
    if result.failed or result.status == UNFINISHED:
        return 3, f"status = {result.status} after {result.steps} steps"
    return 0, ""
