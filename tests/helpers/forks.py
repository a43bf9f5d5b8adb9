# SPDX-License-Identifier: GPL-3.0-or-later
"""Snippets of Python, each run in a fork of a process that has loaded YADE: a crash kills none."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import traceback
from dataclasses import dataclass
from pathlib import Path

#: Time after which a snippet hangs [s]; on a busy machine, too.
_PATIENCE = 600.0

_PREPARE = """
import copy, inspect, pickle, re
import flexpm
import numpy as np
import yade
from yade import utils, wrapper
O = yade.O
nan, inf = float("nan"), float("inf")
specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
disc = flexpm.Specimen.disc(0.02, 0.01, seed=1)
centres = np.ascontiguousarray(specimen.discs[:, :2])
radii = np.ascontiguousarray(specimen.discs[:, 2])
def cells(centres=centres, radii=radii, **members):
    found = flexpm._flexpm.AssemblyInput(specimen.tessellation, centres, radii, 0.01)
    for name, value in {"mesh": "fan", **members}.items():
        setattr(found, name, value)
    return found
def assemble(cells, materials=(wrapper.GrainMat(),)):
    solver = wrapper.GrainSolver()
    solver.assemble(cells, list(materials))
    return solver
def build(**options):
    return flexpm.build(specimen, **options)
"""


@dataclass(frozen=True)
class Ending:
    """How a snippet ended.

    Attributes:
        signal: That killed it, 0 if none.
        error: Class of its exception, empty if it raised none.
        message: Message of the exception.
    """

    signal: int
    error: str = ""
    message: str = ""

    @property
    def lines(self) -> int:
        """Lines of the message."""
        return self.message.strip().count("\n") + 1


class Forks:
    """The process whose forks run the snippets."""

    def __init__(self, package_parent: Path) -> None:
        """Start it, with the package of this folder."""
        environment = dict(os.environ, PYTHONPATH=str(package_parent), OMP_NUM_THREADS="1")
        self._process = subprocess.Popen(
            [sys.executable, __file__],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )

    def run(self, snippet: str) -> Ending:
        """Run a snippet in a fork."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(snippet) + "\n")
        self._process.stdin.flush()
        return Ending(**json.loads(self._process.stdout.readline()))

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


def _serve() -> None:
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what YADE prints does not mix with the answers
    names: dict[str, object] = {}
    exec(_PREPARE, names)
    for line in sys.stdin:
        answers.write(json.dumps(_ending(json.loads(line), names)) + "\n")
        answers.flush()


def _ending(snippet: str, names: dict[str, object]) -> dict[str, object]:
    """Fork, run, and wait for the end."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        os.write(writing, json.dumps(_outcome(snippet, names)).encode())
        os._exit(0)
    os.close(writing)
    told = b""
    while select.select([reading], [], [], _PATIENCE)[0]:
        part = os.read(reading, 65536)
        told += part
        if not part:
            break
    else:
        os.kill(child, signal.SIGALRM)  # it hangs
    os.close(reading)
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        return {"signal": os.WTERMSIG(status)}
    if not told:
        return {"signal": 0, "error": "exit", "message": f"ended with {os.WEXITSTATUS(status)}"}
    return json.loads(told)


def _outcome(snippet: str, names: dict[str, object]) -> dict[str, object]:
    try:
        exec(snippet, names)
    except Exception as error:
        if isinstance(error, SyntaxError | NameError | AssertionError):
            traceback.print_exc()
        return {"signal": 0, "error": type(error).__name__, "message": str(error)}
    return {"signal": 0}


if __name__ == "__main__":
    _serve()
