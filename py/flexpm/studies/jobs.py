# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs of studies and calibrations: one command of flexpm each, named by the key of its inputs.

A job runs in a separate process and folder. When its outcome is on disk, it is never run again. SI
units.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from subprocess import CompletedProcess
from typing import Protocol

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table, json_text, read_json, write_text
from ..kinds.registry import KINDS, kind_of
from ..materials import interface, joint
from ..materials.keys import ELASTIC_SET, UNITS, is_used
from ..materials.material import load as load_material
from ..renamed import current
from ..require import quoted, require_known, require_number, require_text
from ..runs import input_names
from ..runs.output import Output
from ..runs.run_spec import RunSpec
from ..specimens.files.source import SpecimenSource
from ..specimens.space.any_spec import AnySpec
from ..specimens.spec import PACKING_FILE

#: Tests of a study; `elastic` is the direct solve.
_TESTS = tuple(KINDS)
#: Keys that change the material.
_CHANGES = tuple(f"set.{name}" for name in UNITS)
#: Keys that name files: a saved specimen, lines of joints, and a fracture network.
_FILES = ("specimen", "joints", "network")
#: Keys of how a file of joints is read, by the options of the command.
_OF_JOINT_FILES = {"joint_name": "name", "joint_origin": "origin", "joint": "joint"}
#: Keys that say how a specimen is cut, which no run asks for: it has the specimen.
_CUTS = (*_FILES, *_OF_JOINT_FILES, "network_seed")
#: Keys of what a run writes beside its results; they are no inputs of it.
_OUTPUTS = ("frames", "film")
#: Keys of a packing.
_PACKED = (*input_names.SIZE_NAMES, *input_names.PACKING)
#: Entries of result.json that are no inputs and no measures, or change from machine to machine.
NOT_MEASURES = (
    *("flexpm", "yade", "test", "model", "material", "seed", "confinement", "second_confinement"),
    "step_time",
)
#: Exit codes of a job that would end the same way again.
_FINAL = (0, 2, 3)
#: File with inputs and measures of a run that has ended.
OUTCOME = "outcome.json"


class Task(Protocol):
    """A process in a separate folder, run by a pool."""

    @property
    def inputs(self) -> Table:
        """Requested inputs, flat."""

    @property
    def output(self) -> Output:
        """Files that are written in addition to the results."""

    @property
    def key(self) -> str:
        """Name of all that determines the outcome."""

    @property
    def folder(self) -> str:
        """Folder of the run, relative to the folder of all runs."""

    def older_keys(self) -> list[str]:
        """Names under which the same was run before results changed."""

    def command(self, folder: Path, worker_path: Path) -> list[str]:
        """The command line for a folder; `worker_path` holds the package."""

    def checked(self, folder: Path, done: CompletedProcess[str]) -> CompletedProcess[str]:
        """Return how its process has ended, with the message of its folder."""


@dataclass(frozen=True)
class Job:
    """One run.

    Attributes:
        inputs: What was asked for, flat: ``test``, options by name, ``set.KEY`` for the material.
        arguments: Arguments of the command, without the folder.
        spec: All that determines the outcome.
        place: Folder of the run below the common folder; empty for the key.
        output: Additional files of the run.
    """

    inputs: Table
    arguments: tuple[str, ...]
    spec: RunSpec
    place: str = ""
    output: Output = field(default_factory=partial(Output, report=False))

    @property
    def key(self) -> str:
        """Name of the job."""
        return self.spec.key()

    @property
    def folder(self) -> str:
        """Folder of the run, relative to the folder of all runs."""
        return self.place or self.key

    def older_keys(self) -> list[str]:
        """Keys that the run had before."""
        return self.spec.older_keys()

    def checked(self, folder: Path, done: CompletedProcess[str]) -> CompletedProcess[str]:
        """Return the outcome of the process, which needs no further check."""
        return done

    def command(self, folder: Path, worker_path: Path) -> list[str]:
        """Return the command line for a folder; `worker_path` has the package.

        The process ends with its parent process, so that a stopped study leaves no process behind.
        """
        return [
            *("env", "OMP_NUM_THREADS=1", "FLEXPM_DEFER=1", f"PYTHONPATH={worker_path}"),
            *("setpriv", "--pdeathsig", "TERM"),
            *(sys.executable, "-P", "-m", "flexpm", *self.arguments),
            *(("--frames", str(self.output.frames)) if self.output.frames else ()),
            *(("--film", self.output.film) if self.output.film else ()),
            *("--out", str(folder)),
        ]


def make(inputs: Table, base: Path) -> Job:
    """Check the inputs of one run and name it.

    Args:
        inputs: ``test`` and options of ``flexpm run`` or ``flexpm elastic`` by name, with ``_`` or
            ``-``; ``set.KEY`` changes the material; ``frames`` and ``film`` change no result.
        base: Folder that the paths of files are relative to.

    Raises:
        InputError: for a missing test, an unknown key or a value out of range.
    """
    given = {spelt(key): value for key, value in inputs.items()}
    if "test" not in given:
        raise InputError(f"study test is missing; give one of {', '.join(_TESTS)}")
    test = given.pop("test")
    require_known("study test", test, _TESTS)
    output = Output(False, **{key: given.pop(key) for key in _OUTPUTS if key in given})
    shape = input_names.shape_of(test, given.get("shape"), given.get("depth"))
    used = {
        key: value
        for key, value in given.items()
        if has_use(key, test, given.get("model", RunSpec.model), shape)
    }
    changes = {key.removeprefix("set."): key for key in used if key.startswith("set.")}
    for key in used:
        name = key.removeprefix("set.")
        if not (joint.is_key(name) or interface.is_key(name)):
            require_known("study key", key, [*input_names.OPTIONS, "material", *_CUTS, *_CHANGES])
    for key in ("material", *_FILES):
        if key in used:
            require_text(f"study {key}", used[key])
            if key in _FILES or used[key].endswith(".toml"):
                used[key] = str(base / used[key])
    for key in ("joint_name", "joint"):
        if key in used:
            require_text(f"study {key}", used[key])
    if "joint_origin" in used:
        used["joint_origin"] = _place("study joint_origin", used["joint_origin"])
    model = used.get("model", RunSpec.model)
    assigned = [f"{name}={text_of(used[key])}" for name, key in changes.items()]
    specimen = _specimen(test, used)
    material = load_material(used.get("material"), model, solid=is_solid(specimen.kind))
    material = material.with_set(assigned, model)
    spec = RunSpec.from_options(test, used, material, specimen)
    if kind_of(test).is_solve:
        output = Output(report=False)  # nothing moves
    return Job({"test": test, **used}, tuple(arguments(test, used)), spec, output=output)


def _place(label: str, value: object) -> tuple[float, float]:
    """A point of two numbers [m].

    Raises:
        InputError: for anything else.
    """
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise InputError(f"{label} = {quoted(value)} m, must be two numbers, x and y; give [x, y]")
    x, y = (require_number(label, one, unit="m") for one in value)
    return x, y


def spelt(key: str) -> str:
    """A key with ``_`` for ``-``, but in the names of minerals and joints."""
    names, dot, name = key.rpartition(".")
    return f"{names}{dot}{name.replace('-', '_')}"


def has_use(key: str, test: str, model: object, shape: object = None) -> bool:
    """Whether an option, or ``set.KEY``, means something for a test on a model and a shape."""
    known = isinstance(model, str) and model in ELASTIC_SET  # what is not known is refused later
    if key == "interaction_range":
        return not known or input_names.takes_range(model)
    if not key.startswith("set.") or joint.is_key(key.removeprefix("set.")):
        return key not in input_names.unused(test, shape)
    return not known or is_used(key, str(model))


def _specimen(test: str, used: Table) -> AnySpec:
    """The specimen that inputs describe: packed or from a file, with its joints."""
    if "specimen" in used:
        for key in _PACKED:
            if key in used:
                raise InputError(
                    f"study {key} = {used[key]}, must not be given with specimen, whose file "
                    "contains it; leave out one of them"
                )
    packed = None if "specimen" in used else RunSpec.packed(test, used)
    file, joints, network = (Path(used[key]) if key in used else None for key in _FILES)
    seed, of_map = used.get("network_seed"), {key: used.get(key) for key in _OF_JOINT_FILES}
    return SpecimenSource.read(packed, file, joints, network, seed, **of_map).spec


def place_of(model: str, confinement: float, confinements: int) -> str:
    """Folder of a run of a comparison: the model, and the pressure if there are several.

    Args:
        model: Name of the model.
        confinement: Lateral pressure [Pa].
        confinements: Number of lateral pressures that are compared.
    """
    return f"{model}/{1e-6 * confinement:g}MPa" if confinements > 1 else model


def known(folder: Path, key: str | None = None) -> Table | None:
    """Return the outcome of a job that has ended in `folder`, or None.

    Args:
        folder: Folder of the run.
        key: Key of the job; the outcome of another key does not count. None: any.
    """
    try:
        outcome: Table = read_json(folder / OUTCOME)
        whole = outcome["exit_code"] in _FINAL and isinstance(outcome["message"], str)
        whole = whole and isinstance(outcome["result"], dict)
        outcome["result"] = current(outcome["result"])
        return outcome if whole and key in (None, outcome.get("key", key)) else None
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return None


def finished(job: Task, folder: Path) -> Table | None:
    """The outcome of a job that has ended below `folder` with all that it writes, or None."""
    outcome = known(folder / job.folder, job.key)
    if outcome is None or job.output.frames > outcome.get("frames", 0):
        return None
    return outcome if job.output.film in (None, outcome.get("film")) else None


def outdated(waiting: Iterable[Task], done: Callable[[str], bool]) -> str:
    """Name, in one line, the runs that are finished with results of an older number.

    Args:
        waiting: Jobs that are not finished.
        done: Function that returns whether a job of a key is finished.

    Returns:
        The line, or an empty text without such runs.
    """
    count = sum(any(map(done, job.older_keys())) for job in waiting)
    if not count:
        return ""
    return f"{count} finished runs are of an older results number and are run again"


def conclude(job: Task, folder: Path, done: CompletedProcess[str] | BaseException) -> Table:
    """Read the files of a job, and store its outcome in `folder` unless it was interrupted.

    Returns:
        ``exit_code``, ``message`` (the line on stderr; empty only if the run has succeeded) and
        ``result``: the measures, an empty dictionary without measures.
    """
    if isinstance(done, BaseException):  # the worker was lost, not the job's fault
        return {"exit_code": None, "message": f"{type(done).__name__}: {done}", "result": {}}
    done = job.checked(folder, done)
    outcome = {
        "key": job.key,
        "inputs": dict(job.inputs),
        "frames": job.output.frames,
        "film": job.output.film,
        "exit_code": done.returncode,
        # a table must not depend on where its runs lie
        "message": _message(done).replace(str(folder), job.folder),
        "result": _measures(folder / "result.json"),
    }
    if done.returncode in _FINAL:
        folder.mkdir(parents=True, exist_ok=True)
        write_text(folder / OUTCOME, json_text(outcome))
        _remove_checkpoint(folder)  # the largest files, of no use any more
    return outcome


def _message(done: CompletedProcess[str]) -> str:
    """Return the message of a run, or how it ended if it printed no message."""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    own = [line for line in lines if line.startswith("flexpm: ")]
    if own or done.returncode == 0:
        return own[-1].removeprefix("flexpm: ") if own else ""
    if done.returncode < 0:
        return f"ended by signal {-done.returncode}"
    return lines[-1] if lines else f"ended with exit code {done.returncode}"


def _remove_checkpoint(folder: Path) -> None:
    for file in (*folder.glob("checkpoint*"), folder / PACKING_FILE):
        file.unlink(missing_ok=True)


def _measures(file: Path) -> Table:
    try:
        content = read_json(file)
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(content, dict):
        return {}
    return {
        key: value
        for key, value in current(content).items()
        if key not in NOT_MEASURES and not isinstance(value, dict | list)
    }


def arguments(test: str, used: Table) -> Iterator[str]:
    """The command for a test with its options, which are named as in a study."""
    # a checkpoint that cannot be used is no fault of the run
    run = ("run", test, "--discard-checkpoint", "--no-report")
    yield from (test,) if kind_of(test).is_solve else run
    for key, value in used.items():
        if key.startswith("set."):
            yield from ("--set", f"{key.removeprefix('set.')}={text_of(value)}")
        elif not isinstance(value, bool):
            yield from (f"--{_OF_JOINT_FILES.get(key, key).replace('_', '-')}", text_of(value))
        elif value:
            yield f"--{key.replace('_', '-')}"
    yield "--quiet"


def text_of(value: object) -> str:
    """A value as an option has it."""
    if isinstance(value, bool):
        return str(value).lower()
    return ",".join(map(str, value)) if isinstance(value, list | tuple) else str(value)
