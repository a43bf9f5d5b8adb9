# SPDX-License-Identifier: GPL-3.0-or-later
"""Saved and loaded scenes continue to the same bits, also with contacts that are broken in part."""

from __future__ import annotations

import os
import re
import select
import signal
from itertools import pairwise

import pytest
from processes import HUNG
from yade import wrapper

STEPS = 300
O = wrapper.Omega()  # noqa: E741 - its name in YADE


@pytest.mark.parametrize("suffix", [".yade.gz", ".yade", ".xml", ".bin"])
def test_a_loaded_file_continues_to_the_same_bits(half_broken, bits, tmp_path, suffix):
    file = str(tmp_path / f"scene{suffix}")
    O.save(file)
    before = bits()
    half_broken.run(STEPS)
    uninterrupted = bits()
    changed = {name for name in before if before[name] != uninterrupted[name]}
    assert changed >= {"positions", "velocities", "point_opening", "point_damage", "energies"}
    O.reset()
    O.load(file)
    assert bits() == before
    O.run(STEPS, True)
    assert bits() == uninterrupted


def test_memory_and_reload_continue_to_the_same_bits(half_broken, bits, tmp_path):
    O.saveTmp()
    O.save(str(tmp_path / "scene.bin"))
    half_broken.run(STEPS)
    uninterrupted = bits()
    O.loadTmp()
    O.run(STEPS, True)
    assert bits() == uninterrupted
    O.load(str(tmp_path / "scene.bin"))
    O.run(50, True)
    O.reload()
    O.run(STEPS, True)
    assert bits() == uninterrupted


def test_a_scene_saved_in_the_middle_of_a_ramp_continues(make, bits, tmp_path):
    model = make()
    press = wrapper.ConfinementController(pressure=5e6, sides=[0, 1, 2, 3], rampSteps=400)
    platens = wrapper.EndDisplacementController(holdTop=False)
    model.add_engines(before=(press, platens))
    model.run(150)
    O.save(str(tmp_path / "scene.yade.gz"))
    model.run(400)
    uninterrupted = bits()
    O.load(str(tmp_path / "scene.yade.gz"))
    O.run(400, True)
    assert bits() == uninterrupted


def test_erased_grains_and_bonds_stay_dead_after_loading(make, bits, tmp_path, scene_solver):
    model = make(velocity=1e-9)
    model.run(10)
    bond = next(i for i in O.interactions if i.isReal)
    O.interactions.erase(bond.id1, bond.id2)
    O.bodies.erase(model.solver.bodyIds[-1])
    model.run(10)
    O.save(str(tmp_path / "scene.bin"))
    model.run(STEPS)
    uninterrupted = bits()
    O.load(str(tmp_path / "scene.bin"))
    O.run(STEPS, True)
    assert bits() == uninterrupted
    assert len(scene_solver().bodyIds) == len(model.specimen.discs)


def test_contacts_come_and_go_at_the_same_steps_after_loading(make, bits, tmp_path):
    def pairs() -> frozenset:
        return frozenset((i.id1, i.id2) for i in O.interactions if i.isReal)

    model = make()
    for bond in [i for i in O.interactions if i.isReal and 12 in (i.id1, i.id2)]:
        O.interactions.erase(bond.id1, bond.id2)
    cell = O.bodies[12].shape
    cell.held[:] = 1
    cell.velocities[:] = (0.0, 4e-7)
    model.run(437)
    O.save(str(tmp_path / "scene.bin"))
    uninterrupted, touching = [], [pairs()]
    for _ in range(100):
        model.run(13)
        uninterrupted.append(bits())
        touching.append(pairs())
    assert any(later - earlier for earlier, later in pairwise(touching)), "no new contact"
    assert any(earlier - later for earlier, later in pairwise(touching)), "no contact ended"
    O.load(str(tmp_path / "scene.bin"))
    for expected in uninterrupted:
        O.run(13, True)
        assert bits() == expected


def test_the_number_of_threads_does_not_change_a_bit(make, bits):
    results = []
    for threads in (1, 2):
        model = make(velocity=6e-9, threads=threads)
        model.run(2500)
        assert sum(model.solver.cracks()) > 0
        results.append(bits())
    assert results[0] == results[1]


def test_a_process_that_was_forked_steps_with_threads_of_its_own(make):
    model = make(threads=2)
    O.step()
    child = os.fork()
    if child == 0:
        O.step()
        os._exit(0 if model.solver.unbalanced() >= 0 else 1)
    end = os.pidfd_open(child)
    if not select.select([end], [], [], HUNG)[0]:
        os.kill(child, signal.SIGKILL)
    os.close(end)
    assert os.waitpid(child, 0)[1] == 0


def test_a_scene_of_another_layout_of_the_state_is_refused(make, tmp_path):
    make()
    file = tmp_path / "scene.xml"
    O.save(str(file))
    found = re.subn(r'(<assembly [^>]*version=")\d+"', r'\g<1>0"', file.read_text())
    assert found[1] == 1
    file.write_text(found[0])
    with pytest.raises(
        RuntimeError, match=r"state of the grains = version 0, must be \d+ .* again"
    ):
        O.load(str(file))
