# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs of studies and calibrations: one command of flexpm each, named by a hash of its inputs.

A job runs in a process and a folder of its own. Once its outcome is on disk it is never run again.
SI units.
"""

from __future__ import annotations

import hashlib
import importlib
import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import click

from .._version import __version__
from ..errors import InputError
from ..files import json_text, write_text
from ..materials import material as materials
from ..materials.keys import UNITS, check_name
from ..materials.mixing import description

#: Tests of a study; `elastic` is the direct solve.
TESTS = ("uniaxial", "tension", "biaxial", "brazilian", "elastic")
#: Keys that only some tests have a use for; the others leave them out.
_ONLY = {
    "width": ("uniaxial", "tension", "biaxial", "elastic"),
    "height": ("uniaxial", "tension", "biaxial", "elastic"),
    "diameter": ("brazilian",),
    "confinement": ("biaxial",),
    "rate": ("uniaxial", "tension", "biaxial", "brazilian"),
    "max_strain": ("uniaxial", "tension", "biaxial", "brazilian"),
    "stop_ratio": ("uniaxial", "tension", "biaxial", "brazilian"),
    "start": ("uniaxial", "tension"),
    "pace": ("uniaxial", "tension", "biaxial", "brazilian"),
    "dynamic": ("uniaxial", "tension", "biaxial", "brazilian"),
    "gravity": ("uniaxial", "tension", "biaxial", "brazilian"),
}
#: Options of the command that do not change what a job computes.
_INERT = ("out", "quiet", "threads")
#: Entries of result.json that are no inputs and no measures, or change from machine to machine.
_NOT_MEASURES = ("flexpm", "yade", "test", "model", "material", "seed", "confinement", "step_time")
#: Exit codes of a job that would end the same way again.
_FINAL = (0, 2, 3)
_OUTCOME = "outcome.json"


@dataclass(frozen=True)
class Job:
    """One run.

    Attributes:
        inputs: What was asked for, flat: ``test``, options by name, ``set.KEY`` for the material.
        arguments: Of the command, without the folder.
        name: Hash of all that determines the outcome, with the defaults filled in.
    """

    inputs: Mapping[str, Any]
    arguments: tuple[str, ...]
    name: str

    def command(self, folder: Path, worker_path: Path) -> list[str]:
        """The command line for a folder; `worker_path` holds the package.

        The process ends with the one that started it, so that a killed study leaves none behind.
        """
        return [
            *("env", "OMP_NUM_THREADS=1", "FLEXPM_DEFER=1", f"PYTHONPATH={worker_path}"),
            *("setpriv", "--pdeathsig", "TERM"),
            *(sys.executable, "-P", "-m", "flexpm", *self.arguments, "--out", str(folder)),
        ]


def make(inputs: Mapping[str, Any], base: Path) -> Job:
    """Check the inputs of one run and name it.

    Args:
        inputs: ``test`` and options of ``flexpm run`` or ``flexpm elastic`` by name, with ``_`` or
            ``-``; ``set.KEY`` changes the material.
        base: Folder that the path of a material file is relative to.

    Raises:
        InputError: for a missing test, an unknown key or a value out of range.
    """
    given = {key.replace("-", "_"): value for key, value in inputs.items()}
    if "test" not in given:
        raise InputError(f"study test is missing; give one of {', '.join(TESTS)}")
    test = given.pop("test")
    check_name("study test", test, TESTS)
    used = {key: value for key, value in given.items() if test in _ONLY.get(key, TESTS)}
    if str(used.get("material", "")).endswith(".toml"):
        used["material"] = str(base / used["material"])
    command = _command(test)
    arguments = [*([] if test == "elastic" else [test]), *_options(command, used), "--quiet"]
    return Job({"test": test, **used}, (command.name, *arguments), _name(command, arguments))


def known(folder: Path) -> dict[str, Any] | None:
    """The outcome of a job that has ended in `folder`, or None."""
    try:
        return json.loads((folder / _OUTCOME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def conclude(job: Job, folder: Path, done: CompletedProcess[str] | BaseException) -> dict[str, Any]:
    """Read what a job has left, and note its outcome in `folder` unless it was interrupted.

    Returns:
        ``exit_code``, ``message`` (the line on stderr, or empty) and ``result``: the measures, an
        empty dictionary if there are none.
    """
    if isinstance(done, BaseException):  # the worker was lost, not the job's fault
        return {"exit_code": None, "message": f"{type(done).__name__}: {done}", "result": {}}
    lines = [line for line in done.stderr.splitlines() if line.startswith("flexpm: ")]
    outcome = {
        "inputs": dict(job.inputs),
        "exit_code": done.returncode,
        # a table must not depend on where its runs lie
        "message": lines[-1].removeprefix("flexpm: ").replace(str(folder), job.name)
        if lines
        else "",
        "result": _measures(folder / "result.json"),
    }
    if done.returncode in _FINAL:
        folder.mkdir(parents=True, exist_ok=True)
        write_text(folder / _OUTCOME, json_text(outcome))
        for checkpoint in folder.glob("checkpoint*"):
            checkpoint.unlink(missing_ok=True)  # the largest file, of no use any more
    return outcome


def _measures(file: Path) -> dict[str, Any]:
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {
        key: value
        for key, value in content.items()
        if key not in _NOT_MEASURES and not isinstance(value, dict | list)
    }


def _options(command: click.Command, used: Mapping[str, Any]) -> list[str]:
    """The command's options for values that it will check."""
    known = {option.name: option for option in command.params if option.name not in _INERT}
    for name in ("test", "assignments"):
        known.pop(name, None)
    arguments: list[str] = []
    for key, value in used.items():
        check_name("study key", key, [*known, *(f"set.{name}" for name in UNITS)])
        if key.startswith("set."):
            arguments += ["--set", f"{key.removeprefix('set.')}={_text(value)}"]
        elif not getattr(known[key], "is_flag", False):
            arguments += [known[key].opts[0], _text(value)]
        elif value is True:
            arguments.append(known[key].opts[0])
    return arguments


def _text(value: Any) -> str:
    return ",".join(map(repr, value)) if isinstance(value, list) else str(value)


def _name(command: click.Command, arguments: list[str]) -> str:
    """Hash of the inputs with defaults filled in, after the command has checked them."""
    context = command.make_context(command.name, list(arguments))
    values = {key: value for key, value in context.params.items() if key not in _INERT}
    model = values["model"]
    changes = values.pop("assignments")
    material = materials.load(values.pop("material"), model).with_set(changes, model)
    everything = {"flexpm": __version__, "command": command.name, **values}
    everything["material"] = description(material, model)
    text = json.dumps(everything, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _command(test: str) -> click.Command:
    commands = importlib.import_module("flexpm.cli.main").command.commands
    return commands["elastic" if test == "elastic" else "run"]
