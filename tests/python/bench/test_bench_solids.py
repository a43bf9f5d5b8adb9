# SPDX-License-Identifier: GPL-3.0-or-later
"""Step times of a solid's models: what is timed, its set-up, and what is refused."""

import json

import numpy as np
import pytest

from flexpm.bench import solids
from flexpm.bench import timing as bench
from flexpm.bench.cases import solid_builders
from flexpm.cli import main as cli
from flexpm.kinds.registry import kind_of
from flexpm.specimens.space.spec import SolidSpec
from flexpm.specimens.specimen import Specimen

yade = bench.yade  # importable only once flexpm has been imported

SIZES = {"width": 0.009, "depth": 0.01, "height": 0.012}
SMALL = [word for name, size in SIZES.items() for word in (f"--{name}", str(size))]


def test_models_of_a_solid_are_those_that_it_is_tested_with():
    builders = solid_builders("box")
    assert set(builders) == set(kind_of("uniaxial").models_of("box")) >= {"flexible", "rigid"}


@pytest.mark.parametrize("name", ["flexible", "rigid"])
def test_grains_are_timed_with_all_that_a_run_does(name):
    counts = solid_builders("box")[name][1](Specimen.box(**SIZES, seed=2), 1)
    kinds = [type(engine).__name__ for engine in yade.O.engines]
    assert kinds.index("SolidSolver") < kinds.index("AxialRecorder")
    assert counts["tetrahedra"] > 20 * counts["grains"]
    yade.O.run(10, True)
    yade.O.reset()


def test_the_set_up_is_timed_by_stages_and_gives_the_packing_of_the_seed():
    made, found = solids.timed_set_up(SolidSpec("box", **SIZES, seed=2), None)
    assert np.array_equal(made.spheres, Specimen.box(**SIZES, seed=2).spheres)
    stages = ("packing", "cells", "model", "start", "first_step")
    assert all(found[f"{stage}_time"] > 0.0 for stage in stages)
    assert found["peak_memory"] > 1e7
    text = dict(solids.set_up_rows({**found, "peak_memory": 2**20, "memory_per_grain": 2048.0}))
    assert text["memory"] == "2.0 KiB a grain, peak of the process 1 MiB"
    assert len(yade.O.bodies) == 0


def test_costs_are_told_a_grain_and_a_bond():
    counts = {"grains": 1000, "contacts": 4000, "nodes": 5, "tetrahedra": 6}
    cases = [
        bench.Case(name, name, 0, counts, [time], [time])
        for name, time in (("flexible", 5e-4), ("jcfpm", 1e-3))
    ]
    host = {"processor": "p", "cores": 1, "flexpm": "1", "yade": "2", "python": "3"}
    rows = dict(solids.model_rows(bench.Timing(host, {}, 1, 3, cases)))
    assert rows["flexible"] == "500.0 us, 500.0 ns a grain, 125.0 ns a bond, 0.500 of JCFpm's"
    assert rows["jcfpm"] == "1000 us, 1000 ns a grain, 250.0 ns a bond"
    assert rows["nodes, tetrahedra"] == "5, 6"


def test_the_command_tells_of_a_box(tmp_path, capsys):
    file = tmp_path / "bench.json"
    command = ["bench", "--shape", "box", *SMALL, "--steps", "10", "--json", str(file), "--quiet"]
    assert cli.main(command) == 0
    text, data = capsys.readouterr().out, json.loads(file.read_text())
    assert set(data["models"]) == set(solid_builders("box"))
    assert data["specimen"]["depth"] == SIZES["depth"]
    assert "ns a grain" in text and "elastic start" in text and "two threads" in text


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--depth", "0.01"], "bench: depth = 0.01 m, goes with --shape box; leave it out"),
        (["--shape", "box", "--scaling"], "bench: scaling goes with the plane"),
        (["--shape", "box", "--width", "0.001"], "Specimen.box: largest diameter"),
        (["--shape", "cylinder"], "shape"),
    ],
)
def test_what_is_no_benchmark_of_a_box_is_refused_with_one_line(options, told, capsys):
    assert cli.main(["bench", *options]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert told in error
