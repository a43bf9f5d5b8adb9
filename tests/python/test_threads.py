# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads of YADE's own loops: as many as were asked for while a test steps, all elsewhere."""

from __future__ import annotations

import json
import os
import sys

import pytest
from processes import captured

SCRIPT = """
import ctypes, json, os, sys
model, threads = sys.argv[1], int(sys.argv[2])
import flexpm, yade
from flexpm.bench import timing
from flexpm.runs import runner
most = ctypes.CDLL("libgomp.so.1").omp_get_max_threads
seen, before, real = set(), most(), runner.Runner._step_on
def look(self, step, over):
    seen.add(most())
    real(self, step, over)
runner.Runner._step_on = look
specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
result = flexpm.run("tension", specimen, model=model, rate=8.0, threads=threads)
last = most()
yade.O.run(5, True)  # with all threads that there were: the scene has room for them
yade.O.reset()
built = flexpm.build(specimen, None, model, threads=threads)
built.run(3)
yade.O.run(5, True)
timed = timing.compare(specimen, steps=20, threads=1, names=("jcfpm",)).cases[0].step_time
waits = os.environ.get("OMP_WAIT_POLICY")
print(json.dumps([before, sorted(seen), last, most(), result.curve.csv(), timed, waits]))
"""


def told(package_parent, model, threads, available):
    surroundings = {
        **os.environ,
        "PYTHONPATH": str(package_parent),
        "OMP_NUM_THREADS": str(available),
    }
    command = [sys.executable, "-c", SCRIPT, model, str(threads)]
    done = captured(command, env=surroundings, timeout=600)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.long
@pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="one core")
@pytest.mark.parametrize("model", ["jcfpm", "cohfrict", "inner"])
def test_yades_loops_use_the_threads_that_were_asked_for(package_parent, model):
    before, seen, last, at_end, record, timed, waits = told(package_parent, model, 1, 2)
    assert (before, seen, last, at_end) == (2, [1], 2, 2)
    assert timed > 0.0
    assert waits is None  # nothing is left for programs that are started from here
    assert record == told(package_parent, model, 1, 1)[4]


@pytest.mark.long
@pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="one core")
def test_two_threads_are_used_if_they_are_asked_for_and_there(package_parent):
    assert told(package_parent, "jcfpm", 2, 2)[:4] == [2, [2], 2, 2]
    assert told(package_parent, "jcfpm", 2, 1)[:4] == [1, [1], 1, 1]
