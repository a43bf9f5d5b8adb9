# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages of own tests: balance of what they end with, energies, histories, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade
from refusals import failure, refusal
from scenes import fresh

import flexpm
from flexpm.errors import SimulationError

WIDTH, HEIGHT, THICKNESS = 0.012, 0.018, 0.01
AREA = WIDTH * THICKNESS
ENERGIES = ("kinetic", "elastic", "damage", "friction", "damping", "drag", "potential")


def made(model: str = "flexible", **options: object) -> flexpm.PartRig:
    specimen = flexpm.Specimen.rectangle(WIDTH, HEIGHT, THICKNESS, seed=3)
    return flexpm.PartRig(fresh(specimen, model=model, **options))


def between(model: str = "flexible", *, bonded: bool = False, **options: object):
    """A specimen between a floor and a platen that drives it, both smooth."""
    rig = made(model, **options)
    floor, top = rig.platen(0, bonded=bonded), rig.platen(2, bonded=bonded)
    rig.hold(disc=((0.5 * WIDTH, 0.5 * HEIGHT), 0.1 * HEIGHT), axes="x")
    rig.drive(top, (0.0, -1.0), against=floor)
    return rig, floor, top


def misfit(rig: flexpm.PartRig) -> float:
    """Largest error of the energy balance of the record, over the largest stored energy [-]."""
    record = rig.record
    sums = sum(record[f"{name}_energy"] for name in ENERGIES)
    error = sums - record["boundary_work"] - rig.initial_energy
    return float(np.abs(error).max() / record["elastic_energy"].max())


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("held", [False, True])
def test_what_has_settled_stands_on_its_weight_without_damping(model, held):
    rig = made(model, dynamic=True, gravity=9.81)
    step = yade.O.dt
    base = rig.hold(box=((-1.0, -1.0), (1.0, 0.2 * HEIGHT))) if held else rig.platen(0)
    rig.settle()
    density = 2650.0
    assert rig.weight == pytest.approx(density * AREA * HEIGHT * 9.81, rel=1e-9)
    assert base.force[1] == pytest.approx(rig.weight, rel=1e-3)
    assert (rig.built.damping, yade.O.dt) == (0.0, step)
    energies = rig.built.solver.energies()
    sums = sum(energies[f"{name}_energy"] for name in ENERGIES)
    given = energies["boundary_work"] + energies["initial_energy"]
    assert sums == pytest.approx(given, abs=1e-2 * energies["elastic_energy"])
    # the weight came slowly: little was there for damping to take
    assert energies["damping_energy"] < 0.2 * energies["elastic_energy"]
    rig.built.run(500)
    assert base.force[1] == pytest.approx(rig.weight, rel=2e-3)
    assert [stage["stage"] for stage in rig.stages] == ["settle"]


def test_a_record_that_begins_after_settling_counts_from_there():
    rig, _, _ = between(dynamic=True, gravity=1e5, bonded=True)  # so that the sag is seen
    rig.gauge("sag", (0.5 * WIDTH, 0.25 * HEIGHT), (0.5 * WIDTH, 0.75 * HEIGHT))
    rig.settle()
    state = rig.built.snapshot()
    sag = float(np.abs(state.positions - state.reference)[:, 1].max())
    rig.strain_to(1e-9)
    assert abs(rig.record["sag"][0]) < 0.05 * sag


def test_what_nothing_holds_does_not_settle_and_damping_comes_back():
    rig = made("rigid", dynamic=True, gravity=9.81)
    rig.platen(1)
    with pytest.raises(
        SimulationError, match=r"settle: missing reactions = 1 of the weight"
    ) as raised:
        rig.settle(transits=5)
    assert "plate at (0.012, " in str(raised.value) and "\n" not in str(raised.value)
    assert rig.built.damping == 0.0
    assert rig.built.solver.gravity[1] == -9.81
    rig.settle(transits=5, moving=True)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_several_parts_come_to_their_pressures_at_once(model):
    rig = made(model)
    floor, right, top, left = (rig.platen(side) for side in range(4))
    rig.press({top: 4e6, right: 1e6})
    sizes = {top: AREA, right: HEIGHT * THICKNESS}
    for part, pressure, against in ((top, 4e6, floor), (right, 1e6, left)):
        force = math.hypot(*part.force)
        assert force == pytest.approx(pressure * sizes[part], rel=1e-3)
        assert math.hypot(*against.force) == pytest.approx(force, rel=1e-3)
    stress = rig.built.solver.balance()["mean_stress"]
    assert stress[:2] == pytest.approx((-1e6, -4e6), rel=2e-3)
    state = rig.elastic()
    moved = rig.built.snapshot().positions - state.reference
    assert state.displacements == pytest.approx(moved, abs=1e-3 * np.abs(moved).max())
    rig.press({top: 1e6, right: 2e6})  # each from what it had
    assert math.hypot(*top.force) == pytest.approx(1e6 * AREA, rel=1e-3)
    assert math.hypot(*right.force) == pytest.approx(2e6 * sizes[right], rel=1e-3)
    assert [stage["stage"] for stage in rig.stages] == ["press"] * 2


def test_a_pressure_is_taken_off_again():
    rig, floor, _ = between("rigid", bonded=True)
    right = rig.platen(1)
    rig.hold(where=lambda x, y: x < 0.1 * WIDTH, axes="x")
    rig.press(right, 1e6)
    before = rig.built.solver.energies()["elastic_energy"]
    rig.press(right, 0.0)
    assert abs(right.force[0]) < 1e-3 * 1e6 * HEIGHT * THICKNESS
    assert rig.built.solver.energies()["elastic_energy"] < 1e-4 * before


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("bonded", [False, True])
def test_cycles_below_the_onset_leave_nothing_behind(model, bonded):
    rig, floor, top = between(model, bonded=bonded)
    load = 0.2 * rig.scales().strength
    rig.cycle(load, 2)
    rig.relax()
    record = rig.record
    largest = record["elastic_energy"].max()
    assert np.all(record["damage_energy"] == 0.0)
    assert np.all(record["friction_energy"] == 0.0)
    assert record["load"].max() == pytest.approx(load, rel=1e-3)
    peaks = record["load"] > 0.99 * load
    assert np.count_nonzero(np.diff(peaks.astype(int)) == 1) == 2
    assert rig.built.solver.energies()["elastic_energy"] < 1e-6 * largest
    taken = record["damping_energy"][-1] + record["drag_energy"][-1]
    assert record["boundary_work"][-1] == pytest.approx(taken, abs=1e-6 * largest)
    assert misfit(rig) < 1e-5
    for part in (floor, top):
        assert abs(part.force[1]) < 1e-3 * load
    assert [stage["stage"] for stage in rig.stages] == ["cycle", "relax"]
    assert rig.warnings == []


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_load_stays_is_taken_off_and_comes_again(model):
    rig, floor, top = between(model)
    load = 0.2 * rig.scales().strength
    rig.stress_to(load)
    rig.relax()
    way = rig.record["displacement"][-1]
    rig.dwell(3.0)
    assert rig.record["displacement"][-1] == way
    rig.stress_to(1.5 * load)
    kept = rig.record["load"][-1]
    rig.dwell(20.0, by="load")
    record = rig.record
    stays = record["load"][record["step"] > rig.stages[-1]["first_step"]]
    assert stays == pytest.approx(kept, rel=2e-2)
    assert stays[-1] == pytest.approx(kept, rel=1e-3)
    rig.unload()
    assert abs(top.force[1]) < 1e-3 * kept
    assert rig.record["displacement"][-1] == pytest.approx(0.0, abs=1e-3 * way)
    rig.stress_to(load)  # from standing still
    assert rig.record["load"][-1] == pytest.approx(load, rel=0.1)
    assert misfit(rig) < 1e-5
    assert floor.force[1] == pytest.approx(-top.force[1], rel=1e-2)


def test_a_cycle_by_way_ends_where_it_is_to_be():
    rig, _, _ = between("rigid")
    rig.cycle(4e-6, 2, by="displacement", low=1e-6)
    way = rig.record["displacement"]
    assert way.max() == pytest.approx(4e-6, rel=0.05)
    assert way[-1] == pytest.approx(1e-6, rel=0.05)
    assert np.ptp(way[-3:]) == 0.0


def test_a_history_of_loads_from_a_file_has_its_units(tmp_path):
    path = tmp_path / "history.csv"
    rows = "time,load,note\nmin,kN,\n0,0.2,a\n1,0.2,b\n2.5,0.1,\n"
    path.write_text(rows, encoding="utf-8-sig")  # as spreadsheets write it
    rig, _, top = between("rigid")
    rig.follow(path, by="load")
    assert rig.stages[-1]["times"] == [0.0, 60.0, 150.0]
    assert rig.stages[-1]["values"] == [200.0, 200.0, 100.0]
    assert rig.record["load"].max() == pytest.approx(200.0, rel=2e-3)
    assert top.force[1] == pytest.approx(-100.0, rel=1e-3)


def test_with_real_masses_a_way_follows_its_times():
    rig, _, top = between("rigid", bonded=True, dynamic=True, damping=0.3)
    times, ways = [0.0, 2e-5, 3e-5, 5e-5], [0.0, 2e-7, 2e-7, -1e-7]
    rig.follow(times, ways)
    record = rig.record
    step = yade.O.dt
    took = [rig.stages[-1][f"{end}_step"] for end in ("first", "last")]
    assert (took[1] - took[0]) * step == pytest.approx(5e-5, abs=2.0 * step)
    asked = np.interp((record["step"] - took[0]) * step, times, ways)
    assert record["displacement"] == pytest.approx(asked, abs=2.0 * step * 1.5e-2)
    assert top.displacement[1] == pytest.approx(1e-7, abs=2.0 * step * 1.5e-2)


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("t,w\ns,m\n0,0\n1,nan\n", "line 4: 1, nan, must be finite"),
        ("t,w\ns,m\n0,0\n0,1\n", r"line 4: time = 0 s, must be > 0 s"),
        ("t,w\ns,m\ns,m\n0,0\n", "line 3: 's,m', must be numbers below a row of names and at most"),
        ("t,w\ns,ft\n0,0\n1,1\n", "line 2: unit = 'ft', must be one of m, cm, mm, um"),
        ("t,w\n0,0\n1,b\n", "line 3: '1,b', must be numbers"),
        ("t\n0\n", "line 1: columns = 1, must be >= 2"),
        ("t,w\n0,0\n", "rows = 1, must be 2 to"),
    ],
)
def test_a_history_that_is_none_is_refused_with_its_row(tmp_path, rows, message):
    rig, _, _ = between("rigid")
    path = tmp_path / "history.csv"
    path.write_text(rows, encoding="utf-8")
    refusal(message, rig.follow, path)
    assert rig.stages == []


def test_what_stages_cannot_do_is_refused_in_one_line():
    rig, floor, top = between("rigid")
    for wrong, message in (
        (lambda: rig.settle(), "settle: gravity = 0 m/s2, must be above 0"),
        (lambda: rig.unload(), "unload: loading = none, must have begun"),
        (lambda: rig.dwell(by="load"), "dwell: loading = none"),
        (lambda: rig.dwell(0.0), "dwell: transits = 0"),
        (lambda: rig.dwell(by="force"), "dwell: by = 'force'"),
        (lambda: rig.relax(transits=math.nan), "relax: transits = nan"),
        (lambda: rig.cycle(1.0, 0), "cycle: count = 0"),
        (lambda: rig.cycle(1.0, low=1.0), "cycle: amplitude = 1 N, must not be equal to low"),
        (lambda: rig.cycle(-1.0), "cycle: load = -1 N, must not be below 0: plate at"),
        (lambda: rig.follow([0, 1], [0]), "follow: values = 1, must be as many as times, 2"),
        (lambda: rig.follow([0, 0], [0, 1]), "follow: row 2: time = 0 s, must be > 0 s"),
        (lambda: rig.follow("no.csv"), "follow: file = 'no.csv', cannot be read .No such file"),
        (lambda: rig.press({}), "press: parts = none"),
        (lambda: rig.press({top: -1.0}), "press: pressure = -1"),
        (lambda: rig.press({top: 1.0}, 2.0), "press: pressure and a table"),
        (lambda: rig.press(top), "press: pressure = None"),
        (lambda: rig.fluid(1.0), "fluid: give exactly one of side and hole"),
        (lambda: rig.fluid(1.0, side=4), "fluid: side = 4, must be <= 3"),
        (lambda: rig.fluid(1.0, hole=0), "fluid: hole = 0, the specimen has none"),
        (lambda: rig.fluid(-1.0, side=1), "fluid: pressure = -1"),
    ):
        refusal(message, wrong)
    assert rig.stages == []


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_fluid_presses_like_platens_and_its_work_is_the_energy(model):
    """Against a smooth floor and wall: the mean stress, the reactions, and the energies."""
    rig = made(model)
    floor, left = rig.platen(0), rig.platen(3)
    rig.fluid(2e6, side=[1, 2])
    stress = rig.built.solver.balance()["mean_stress"]
    assert stress == pytest.approx((-2e6, -2e6, 0.0), abs=6e3)
    assert floor.force == pytest.approx((0.0, 2e6 * AREA), abs=2e-3 * 2e6 * AREA)
    assert left.force[0] == pytest.approx(2e6 * HEIGHT * THICKNESS, rel=2e-3)
    energies = rig.built.solver.energies()
    kept = sum(energies[f"{name}_energy"] for name in ENERGIES)
    assert energies["boundary_work"] == pytest.approx(kept, rel=1e-6)
    state = rig.elastic()
    moved = rig.built.snapshot().positions - state.reference
    assert state.displacements == pytest.approx(moved, abs=1e-2 * np.abs(moved).max())
    refusal("fluid: side = .1., must be all or none of the sides with one", rig.fluid, 1e6, side=1)
    rig.fluid(0.0, side=[1, 2])
    assert rig.built.solver.energies()["elastic_energy"] < 1e-5 * energies["elastic_energy"]


def test_a_load_that_a_specimen_does_not_bear_ends_in_one_line():
    rig, _, _ = between("rigid")
    load = 50.0 * rig.scales().strength
    with pytest.raises(
        SimulationError, match="cycle: axial stress = .* does not carry it"
    ) as raised:
        rig.cycle(load)
    assert "\n" not in str(raised.value)
    assert "; plate at (" in str(raised.value) and " carries (0, -" in str(raised.value)
    rig, _, _ = between("rigid")
    failure("follow: .*; plate at .* carries .0, -", rig.follow, [0.0, 1.0], [0.0, load], by="load")
