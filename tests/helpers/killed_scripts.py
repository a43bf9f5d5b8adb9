# SPDX-License-Identifier: GPL-3.0-or-later
"""Scripts of own tests as processes that kill themselves, and what their folders hold."""

from __future__ import annotations

import json
import os
import random
import subprocess
from pathlib import Path

from step_clock import STEP

import flexpm

PYTHON = "/usr/bin/python3"
HELPERS = Path(__file__).parent
#: Files that have the same bytes after a kill and after a rerun.
SAME = ("curve.csv", "cracks.csv", "fragments.csv", "events.csv", "final.vtu")

#: Steps between two checkpoints of a script that kills itself, at the looks of each tenth step.
SAVED_EACH, LOOK = 100, 10
#: Starts script after script in processes that kill themselves: imports and packing are done once.
KILLER = """
import functools, json, os
import flexpm, yade
from flexpm.rigs.outcome import kept
from flexpm.rigs.rig import TestRig
from self_signals import at_steps
from step_clock import step_clock
step_clock(setattr, look=LOOK)
flexpm.Specimen.rectangle = functools.cache(flexpm.Specimen.rectangle)
exec(open("packing.py").read(), {"flexpm": flexpm})
take = TestRig._step


def start(number, last, name):
    child = os.fork()
    if child == 0:
        begun = []
        def step(rig):
            if not begun:
                begun.append(yade.O.iter)
                with open(f"begun-{name}", "a") as file:
                    print(*begun, file=file)
            take(rig)
        TestRig._step = step
        at_steps([(last, number)] if last else [])
        with open("killed.py") as file:
            exec(file.read().replace('out="out"', f'out="{name}", report=False'), {})
        kept.close_open()
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


yade.O.reset()
ends = [
    [-start(number, last, name) for number, last in [*moments, (0, 0)]]
    for name, moments in enumerate(json.load(open("moments.json")))
]
json.dump(ends, open("ends.json", "w"))
"""


def started(folder: Path, script: str, interval: float = 30.0, rate: float = 4.0):
    """The script as a process in a folder."""
    text = script.replace("INTERVAL", str(interval)).replace("RATE", str(rate))
    (folder / "script.py").write_text(text)
    path = str(Path(flexpm.__file__).parents[1])
    return subprocess.Popen(
        [PYTHON, "script.py"],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": f"{path}{os.pathsep}{HELPERS}"},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def ended(process: subprocess.Popen, longest: float = 600.0) -> tuple[int, str]:
    """Its exit code and the last line of its errors, after that many seconds at most."""
    told = process.communicate(timeout=longest)[1].strip()
    return process.returncode, told.splitlines()[-1] if told else ""


def content(folder: Path) -> dict:
    """Its result.json, without what a machine changes."""
    found = json.loads((folder / "result.json").read_text())
    return {name: value for name, value in found.items() if name != "step_time"}


def require_same(folder: Path, other: Path) -> None:
    for name in SAME:
        assert (folder / name).read_bytes() == (other / name).read_bytes(), name
    assert content(folder) == content(other)


def killed(folder: Path, script: str, chains: list[list[tuple[int, int]]]) -> list[list[int]]:
    """Start the script again and again in processes that kill themselves at given steps.

    Args:
        folder: In which there is one folder a chain afterwards, named by its number.
        script: It begins with lines that make its specimen, up to an empty one.
        chains: Signals and steps, in order; a last start of each chain is left alone.

    Each start must have taken up a checkpoint of at most some steps before the kill.

    Returns:
        Signals by which the starts of each chain have ended.
    """
    (folder / "moments.json").write_text(json.dumps(chains))
    (folder / "packing.py").write_text(script.lstrip().partition("\n\n")[0])
    interval = str(SAVED_EACH * STEP)
    (folder / "killed.py").write_text(script.replace("INTERVAL", interval).replace("RATE", "4.0"))
    process = started(folder, KILLER.replace("LOOK", str(LOOK)))
    assert ended(process, 600.0 + 100.0 * len(chains)) == (0, "")
    for number, chain in enumerate(chains):
        begun = [int(line) for line in (folder / f"begun-{number}").read_text().split()]
        assert begun[0] == 0
        for (_, last), step in zip(chain, begun[1:], strict=True):
            assert max(0, last - SAVED_EACH - 2 * LOOK) <= step <= last
    return json.loads((folder / "ends.json").read_text())


def drawn(seed: int, numbers: list[int], last: int) -> list[tuple[int, int]]:
    """Moments over all steps of the test."""
    steps = sorted(random.Random(seed).sample(range(1, last), len(numbers)))
    return [*zip(numbers, steps, strict=True)]
