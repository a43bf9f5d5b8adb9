# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparison of step times: turns, ratios, what is timed, and the files it writes."""

import json

import numpy as np
import pytest
from refusals import refused_command

from flexpm.bench import memory, report, solids
from flexpm.bench import timing as bench
from flexpm.bench.cases import solid_builders
from flexpm.cli import main as cli
from flexpm.kinds.registry import kind_of
from flexpm.specimens.space.spec import SolidSpec
from flexpm.specimens.specimen import Specimen

yade = bench.yade  # importable only once flexpm has been imported

SMALL = ["--width", "0.016", "--height", "0.032", "--quiet"]


@pytest.fixture(scope="module")
def specimen():
    return Specimen.rectangle(0.016, 0.032, 0.01, seed=2)


def timing(**times):
    cases = [bench.Case(name, name, 0, {}, values, values) for name, values in times.items()]
    return bench.Timing({}, {}, 1, 3, cases)


def test_a_ratio_is_taken_within_each_turn():
    # the machine halves its speed in the second turn; the model costs a quarter throughout
    found = timing(refined=[1.0, 2.0, 1.0], jcfpm=[4.0, 8.0, 4.0])
    assert found.ratio("refined") == 0.25
    assert found.ratio("jcfpm", "refined") == 4.0


def test_a_ratio_is_not_the_ratio_of_medians():
    found = timing(refined=[1.0, 2.0, 3.0], jcfpm=[2.0, 1.0, 9.0])
    assert found.ratio("refined") == 0.5


@pytest.mark.parametrize("name", ["refined", "fan"])
def test_own_models_are_timed_with_all_that_a_run_does(specimen, name):
    bench.BUILDERS[name][1](specimen, 1)
    kinds = [type(engine).__name__ for engine in yade.O.engines]
    assert (
        kinds.index("EndDisplacementController")
        < kinds.index("GrainSolver")
        < kinds.index("AxialRecorder")
    )
    before = yade.O.bodies[0].state.pos
    yade.O.run(300, True)
    recorder = yade.O.engines[kinds.index("AxialRecorder")]
    assert len(recorder.rows) == 300 // yade.O.engines[kinds.index("GrainSolver")].measurePeriod
    assert yade.O.bodies[0].state.pos != before


def test_rigid_grains_are_timed_between_plates(specimen):
    bench.BUILDERS["rigid"][1](specimen, 1)
    assert {"PlateController", "AxialRecorder"} <= {type(e).__name__ for e in yade.O.engines}
    yade.O.run(10, True)
    assert max(plate["displacement"][1] ** 2 for plate in solver().plates()) > 0.0


def solver():
    return next(e for e in yade.O.engines if type(e).__name__ == "GrainSolver")


def test_ratios_stand_beside_those_of_the_paper_for_each_test():
    found = timing(refined=[2.0, 4.0, 2.0], rigid=[1.0, 2.0, 1.0])
    assert report.disc_rows(found) == [("refined / rigid, brazilian", "2.00, paper 4.79")]
    assert "ratio_to_jcfpm" not in found.as_dict()["models"]["rigid"]


def test_two_threads_come_with_a_word_when_cores_are_busy():
    found = {"one": 2.0, "two": 1.0, "gain": 2.0, "load": 0.0, "cores": 2}
    assert report.threads_rows(found) == [("two threads", "2.00 times as fast as one")]
    assert "not free (load 3.0)" in report.threads_rows({**found, "load": 3.0})[0][1]


def test_set_up_memory_and_file_are_measured(specimen):
    again, found = memory.timed_set_up(0.01, 0.016, 0.032, 2, None)
    assert np.array_equal(again.discs, specimen.discs)
    assert found["grains"] == len(specimen.discs)
    assert all(found[f"{part}_time"] > 0.0 for part in ("specimen", "model", "first_step", "vtu"))
    assert len(yade.O.bodies) == 0


def test_memory_traffic_is_that_of_the_arrays(specimen):
    counts = bench.BUILDERS["refined"][1](specimen, 1)
    # arrays of doubles that grow with the nodes: x, y of displacement and velocity, and the mass
    lower = 5 * 8 * counts["nodes"] + 5 * 8 * counts["triangles"]
    assert lower < memory.bytes_per_step(counts) < 10 * lower
    assert memory.bytes_per_step(dict.fromkeys(counts, 0)) == 0


def test_growth_is_drawn_and_described(tmp_path):
    row = {"specimen_time": 1.0, "model_time": 1.0, "first_step_time": 1.0, "vtu_time": 1.0}
    row |= {"memory_per_grain": 1024.0, "bandwidth": 1e9, "triad": 4e9}
    found = [
        {**row, "grains": n, "step_time": n * cost, "time_per_grain": cost}
        for n, cost in ((100, 1e-6), (1000, 1.5e-6))
    ]
    text = dict(report.scaling_rows(found))
    assert "1.50 of the first" in text["1000 grains"]
    assert text["100 grains"].endswith("25% of the triad's")
    report.scaling_picture(tmp_path / "growth.png", found)
    assert (tmp_path / "growth.png").stat().st_size > 1000


@pytest.mark.parametrize("name", ["jcfpm", "cohfrict"])
def test_yade_models_hold_the_bonds_of_the_specimen_and_move(specimen, name):
    counts = bench.BUILDERS[name][1](specimen, 1)
    edges = np.array(specimen.tessellation.shared_edges)[:, :2]
    pairs = {(i.id1, i.id2) for i in yade.O.interactions if i.isReal}
    assert pairs == {(int(a), int(b)) for a, b in edges}
    assert counts["contacts"] == len(pairs)
    yade.O.run(100, True)
    assert max(np.linalg.norm(yade.O.forces.f(k)) for k in range(counts["grains"])) > 0.0


def test_models_take_turns_and_their_scenes_go(specimen):
    found = bench.compare(specimen, steps=20, names=("fan", "jcfpm"))
    assert [case.name for case in found.cases] == ["fan", "jcfpm"]
    assert all(len(case.times) == bench.TURNS for case in found.cases)
    assert all(time > 0.0 for case in found.cases for time in case.times)
    assert found.steps == 20
    assert len(yade.O.bodies) == 0


@pytest.mark.long
def test_the_command_writes_the_same_numbers(tmp_path, capsys):
    file = tmp_path / "new" / "bench.json"
    assert cli.main(["bench", *SMALL, "--steps", "20", "--json", str(file)]) == 0
    text, data = capsys.readouterr().out, json.loads(file.read_text())
    assert set(bench.BUILDERS) == set(data["models"])
    jcfpm = data["models"]["jcfpm"]
    assert jcfpm[f"ratio_to_{report.REFERENCE}"] == 1.0
    assert jcfpm["quartiles"][0] <= jcfpm["step_time"] <= jcfpm["quartiles"][1]
    assert f"{data['models']['refined']['grains']}, {jcfpm['contacts']}" in text
    assert f"{1e6 * jcfpm['step_time']:#.4g}".rstrip(".") in text
    assert data["machine"]["cores"] >= 1


@pytest.mark.parametrize("options", [["--steps", "0"], ["--threads", "0"], ["--width", "-1"]])
def test_wrong_options_are_refused_with_one_line(options, capsys):
    refused_command(capsys, options[0].strip("-"), "bench", *options)


solid_yade = bench.yade  # importable only once flexpm has been imported

SIZES = {"width": 0.009, "depth": 0.01, "height": 0.012}
SOLID_SMALL = [word for name, size in SIZES.items() for word in (f"--{name}", str(size))]


def test_models_of_a_solid_are_those_that_it_is_tested_with():
    builders = solid_builders("box")
    assert set(builders) == set(kind_of("uniaxial").models_of("box")) >= {"flexible", "rigid"}


@pytest.mark.parametrize("name", ["flexible", "rigid"])
def test_grains_are_timed_with_all_that_a_run_does(name):
    counts = solid_builders("box")[name][1](Specimen.box(**SIZES, seed=2), 1)
    kinds = [type(engine).__name__ for engine in solid_yade.O.engines]
    assert kinds.index("SolidSolver") < kinds.index("AxialRecorder")
    assert counts["tetrahedra"] > 20 * counts["grains"]
    solid_yade.O.run(10, True)
    solid_yade.O.reset()


def test_the_set_up_is_timed_by_stages_and_gives_the_packing_of_the_seed():
    made, found = solids.timed_set_up(SolidSpec("box", **SIZES, seed=2), None)
    assert np.array_equal(made.spheres, Specimen.box(**SIZES, seed=2).spheres)
    stages = ("packing", "cells", "model", "start", "first_step")
    assert all(found[f"{stage}_time"] > 0.0 for stage in stages)
    assert found["peak_memory"] > 1e7
    text = dict(solids.set_up_rows({**found, "peak_memory": 2**20, "memory_per_grain": 2048.0}))
    assert text["memory"] == "2.0 KiB a grain, peak of the process 1 MiB"
    assert len(solid_yade.O.bodies) == 0


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


def test_the_command_tells_of_a_box(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(bench, "SIDES", (1.0, 1.25))
    file = tmp_path / "bench.json"
    command = [
        "bench",
        "--shape",
        "box",
        *SOLID_SMALL,
        "--steps",
        "10",
        "--scaling",
        "--json",
        str(file),
        "--quiet",
    ]
    assert cli.main(command) == 0
    text, data = capsys.readouterr().out, json.loads(file.read_text())
    assert set(data["models"]) == set(solid_builders("box"))
    assert data["specimen"]["depth"] == SIZES["depth"]
    assert "ns a grain" in text and "elastic start" in text and "two threads" in text
    small, large = data["scaling"]
    assert small["grains"] == data["set_up"]["grains"]
    assert large["grains"] == pytest.approx(1.25**3 * small["grains"], rel=0.05)
    for row in (small, large):
        assert row["time_per_grain"] * row["grains"] == pytest.approx(row["step_time"])
        assert f"{row['grains']} grains: set-up" in text
    assert file.with_suffix(".png").stat().st_size > 1000


@pytest.mark.parametrize(("large", "sides"), [(False, [1.0, 1.92]), (True, [1.0, 1.92, 3.8])])
def test_boxes_grow_to_a_hundred_thousand_grains(monkeypatch, large, sides):
    specs = []

    def set_up(spec, progress):
        specs.append(spec)
        return None, {"grains": 10}

    timed = bench.Timing({}, {}, 1, 1, [bench.Case("flexible", "", 0, {}, [1e-5], [1e-5])])
    monkeypatch.setattr(solids, "timed_set_up", set_up)
    monkeypatch.setattr(bench, "compare", lambda *given, **named: timed)
    plan = bench.Plan(shape="box", scaling=True, large=large)
    found = bench._grow_solid(plan, SolidSpec("box"), None)
    assert [spec.width / 0.025 for spec in specs] == pytest.approx(sides)
    assert [spec.volume / specs[0].volume for spec in specs] == pytest.approx(
        [side**3 for side in sides]
    )
    assert [row["time_per_grain"] for row in found] == pytest.approx([1e-6] * len(sides))


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--depth", "0.01"], "bench: depth = 0.01 m, goes with --shape box; leave it out"),
        (["--scaling", "--large"], "bench: large = True, goes with --scaling --shape box"),
        (["--shape", "box", "--large"], "bench: large = True, goes with --scaling --shape box"),
        (["--shape", "box", "--width", "0.001"], "Specimen.box: largest diameter"),
        (["--shape", "cylinder"], "shape"),
    ],
)
def test_what_is_no_benchmark_of_a_box_is_refused_with_one_line(options, told, capsys):
    refused_command(capsys, told, "bench", *options)
