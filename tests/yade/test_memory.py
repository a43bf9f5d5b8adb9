# SPDX-License-Identifier: GPL-3.0-or-later
"""Memory: half a million steps take none, a reset leaves nothing, a result takes one state."""

from __future__ import annotations

import sys

import pytest
from processes import captured

import flexpm
from flexpm.models.grains import SolidModel

COMMON = """
import flexpm, yade
from pathlib import Path
from yade import utils, wrapper

def memory():
    # resident set [MB]
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096e-6
"""
STEPS = """
built = flexpm.build(flexpm.Specimen.rectangle(0.012, 0.024, 0.01))
flexpm.rig(built).start(flexpm.Loading(rate=1e-4))
built.solver.measurePeriod = 100
built.run(100_000)
before = memory()
built.run(500_000)
print(memory() - before)
"""
CYCLES = """
specimen = flexpm.Specimen.rectangle(0.04, 0.08, 0.01)

def grains():
    flexpm.build(specimen).run(1)

def spheres():
    scene = yade.O
    scene.materials.append(wrapper.FrictMat())
    scene.bodies.append([utils.sphere((x, y, 0.0), r) for x, y, r in specimen.discs])
    scene.engines = [
        wrapper.ForceResetter(),
        wrapper.InsertionSortCollider([wrapper.Bo1_Sphere_Aabb()]),
        wrapper.InteractionLoop(
            [wrapper.Ig2_Sphere_Sphere_ScGeom()],
            [wrapper.Ip2_FrictMat_FrictMat_FrictPhys()],
            [wrapper.Law2_ScGeom_FrictPhys_CundallStrack()],
        ),
        wrapper.NewtonIntegrator(),
    ]
    scene.dt = 1e-12
    scene.step()

def growth(make):
    for cycle in range(21):
        yade.O.reset()
        make()
        if cycle == 5:
            before = memory()
    return (memory() - before) / 15

print(growth(grains), growth(spheres))
"""

PEAKS = """
import gc
from flexpm._flexpm import give_back_memory
from flexpm.bench.cases import start

def most(work):
    # memory left by what is done, and the most within it [MB]
    gc.collect()
    give_back_memory()
    before = memory()
    Path("/proc/self/clear_refs").write_text("5")
    kept = work()
    lines = Path("/proc/self/status").read_text().splitlines()
    peak = next(float(line.split()[1]) for line in lines if line.startswith("VmHWM")) * 1024e-6
    return memory() - before, peak - before

built = flexpm.build(flexpm.Specimen.box(0.025, 0.025, 0.05))
write_vtu(folder / "first.vtu", built.snapshot())  # loads VTK
state = built.snapshot()
size = 1e-6 * sum(getattr(one, "nbytes", 0) for one in vars(state).values())
print(size, *most(lambda: write_vtu(folder / "state.vtu", state)))
del state
start(built)
print(*most(yade.O.step))
"""


def numbers(script: str) -> list[float]:
    """What a script prints in a process of its own."""
    done = captured([sys.executable, "-c", COMMON + script], check=True)
    return [float(word) for word in done.stdout.split()]


@pytest.mark.long
def test_half_a_million_steps_take_no_memory():
    (grown,) = numbers(STEPS)
    assert grown < 2.0  # MB, of which 5000 rows of the record take 0.7


@pytest.mark.long
def test_build_and_reset_leave_a_tenth_of_what_as_many_spheres_do():
    """YADE keeps each engine of an assignment to O.engines, and with it what the engine holds.

    With the spheres that is a collider and interactions, 3.6 kB of each body; the state of grains
    goes with the scene.
    """
    grains, spheres = numbers(CYCLES)
    assert grains <= 0.1 * spheres


def test_a_result_takes_the_state_of_a_solid_once(monkeypatch):
    """A core of 304 000 grains has one of 3.4 GB."""
    taken = []
    snapshot = SolidModel.snapshot

    def noted(built):
        taken.append(snapshot(built))
        return taken[-1]

    monkeypatch.setattr(SolidModel, "snapshot", noted)
    box = flexpm.Specimen.box(0.008, 0.008, 0.012)
    result = flexpm.run("tension", box, rate=20.0)
    (state,) = taken
    assert result.snapshot is state
    assert result.largest_separation == state.parting / box.mean_diameter > 0.0


def test_a_file_of_a_solid_and_its_elastic_start_take_little_memory(tmp_path):
    """Arrays and texts are made one at a time, and the start gives back what it has needed.

    Of 1790 grains, where constant parts count for more than of a hundred thousand.
    """
    given = f"from flexpm.results.vtu import write_vtu\nfolder = Path({str(tmp_path)!r})\n"
    size, _, in_file, left, in_start = numbers(given + PEAKS)
    assert in_file < 0.7 * size
    assert left < 0.25 * in_start
