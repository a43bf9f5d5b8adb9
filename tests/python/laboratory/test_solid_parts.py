# SPDX-License-Identifier: GPL-3.0-or-later
"""Own tests of solids from parts: closed forms, pressures, friction, folders, what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from killed_scripts import content
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError

SIZE, MATERIAL = 0.012, "augig-table7"


@pytest.fixture(scope="module")
def box():
    return flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)


def rig_of(specimen, model="flexible", **leaves):
    return flexpm.PartRig(fresh(specimen, MATERIAL, model), **leaves)


def imbalance(rig) -> float:
    """What the balance of energies lacks at the end of the record [J]."""
    names = ("kinetic", "elastic", "damage", "friction", "damping", "drag")
    last = {name: rig.record[f"{name}_energy"][-1] for name in names}
    return sum(last.values()) - rig.initial_energy - rig.record["boundary_work"][-1]


def test_platens_are_in_series_with_what_is_between_them():
    tall = flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1)
    rig = rig_of(tall)
    base, top = rig.platen(0), rig.platen(2)
    assert top.area == pytest.approx(SIZE**2, rel=1e-9)
    assert top.position == pytest.approx((0.5 * SIZE, 0.5 * SIZE, 2.0 * SIZE))
    rig.displacement_of("way", top, (0, 0, -1))
    rig.gauge("wide", (0.0, 0.5 * SIZE, SIZE), (SIZE, 0.5 * SIZE, SIZE))
    rig.drive(top, (0, 0, -1), against=base, area=SIZE**2, length=2.0 * SIZE)
    rig.strain_to(2e-4)
    # two layers of contacts, of the grains' own stiffness per area (D20)
    alone = flexpm.elastic(tall, MATERIAL, "flexible")["youngs_modulus"]
    stiffness = rig.built.material.law("flexible")["normal_stiffness"]
    series = 1.0 / (1.0 / alone + 2.0 / (stiffness * 2.0 * SIZE))
    assert rig.stress / rig.strain == pytest.approx(series, rel=1e-3)
    record = rig.record
    assert record["way"][-1] == pytest.approx(record["displacement"][-1], rel=1e-9)
    assert 0.0 < record["wide"][-1] < record["way"][-1]
    assert top.force[2] == pytest.approx(-base.force[2], rel=1e-3)
    assert abs(imbalance(rig)) < 1e-6 * record["elastic_energy"][-1]
    assert rig.warnings == []


# slips have two components, and signs of both
@pytest.mark.parametrize("way", [(1.0, 0.0), (0.0, 1.0), (0.8, 0.6), (-0.6, -0.8)])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_block_slides_at_its_friction(box, model, way):
    friction, pressure = 0.3, 2e6
    rig = rig_of(box, model)
    base, top = rig.platen(0, friction=friction), rig.platen(2)
    behind = {(0, 1): 3, (0, -1): 1, (1, 1): 4, (1, -1): 5}
    sides = [rig.platen(behind[axis, np.sign(way[axis])]) for axis in (0, 1) if way[axis] != 0.0]
    rig.press(top, pressure)
    load = pressure * SIZE**2
    assert -top.force[2] == pytest.approx(load, rel=1e-3)
    assert base.force[2] == pytest.approx(load, rel=1e-3)
    rig.drive(sides, (*way, 0), against=base)
    # sides give unequally, so that the slip turns into the way by and by: what is across the way
    # falls to a tenth in each 1e-6 m, of rigid grains to a third
    rig.strain_to(3e-6 if model == "flexible" else 5e-6)
    held, holds = -np.array(base.force[:2]), friction * load
    assert np.hypot(*held) == pytest.approx(friction * base.force[2], rel=1e-5)
    assert held == pytest.approx(holds * np.array(way), abs=1e-3 * holds)
    # the push of rigid grains swings about it
    moved, push = rig.record["displacement"], rig.record["load"]
    assert push[moved > 0.8 * moved[-1]].mean() == pytest.approx(holds, rel=1e-3)
    slid = rig.record["friction_energy"][-1] / holds
    assert 0.8 * moved[-1] < slid < moved[-1]  # the rest is elastic
    assert abs(imbalance(rig)) < 5e-4 * rig.record["friction_energy"][-1]


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_pressures_from_three_sides_stand_together(box, model):
    rig = rig_of(box, model)
    for side in (0, 3, 4):
        rig.platen(side)
    tops = {rig.platen(2): 6e6, rig.platen(1): 2e6, rig.platen(5): 3e6}
    rig.press(tops)
    for part, pressure in tops.items():
        assert np.dot(part.force, part.normal) == pytest.approx(pressure * SIZE**2, rel=1e-3)
    # one of them is driven on, the others press as before
    driven = next(iter(tops))
    rig.drive(driven, (0, 0, -1), area=SIZE**2)
    rig.stress_to(8e6)
    assert rig.stress == pytest.approx(8e6, rel=0.02)
    for part, pressure in list(tops.items())[1:]:
        assert np.dot(part.force, part.normal) == pytest.approx(pressure * SIZE**2, rel=0.02)


def test_it_goes_back_and_on_without_a_wave(box):
    rig = rig_of(box)
    base, top = rig.platen(0), rig.platen(2)
    rig.drive(top, (0, 0, -1), against=base, area=SIZE**2, length=SIZE)
    rig.strain_to(2e-4)
    high, modulus = rig.stress, rig.stress / rig.strain
    rig.relax()
    rows = len(rig.record)
    rig.strain_to(1e-4)
    assert rig.stress / rig.strain == pytest.approx(modulus, rel=1e-3)
    assert rig.record["end_mismatch"][rows:].max() < 2e-3
    rig.unload()
    assert abs(rig.stress) < 1e-3 * high


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_a_part_is_where_its_load_acts(model):
    size = (0.012, 0.008, 0.008)
    rig = rig_of(flexpm.Specimen.box(*size, seed=1), model)
    # a quarter of the cube around the corner lies on the bottom
    corner = rig.support((0.012, 0.0, 0.0), 0.004)
    inside = rig.support((0.0041, 0.004, 0.0), 0.003)
    line = rig.support((0.006, 0.002, 0.008))
    wall = rig.platen(3)
    assert corner.position == pytest.approx((0.011, 0.001, 0.0), abs=1e-9)
    assert corner.requested_position == (0.012, 0.0, 0.0)
    assert inside.position == pytest.approx((0.0041, 0.004, 0.0), abs=1e-9)
    assert inside.requested_position == (0.0041, 0.004, 0.0)
    assert line.position == pytest.approx((0.006, 0.004, 0.008), abs=1e-9)
    assert line.requested_position == (0.006, 0.002, 0.008)
    assert wall.position == pytest.approx((0.0, 0.004, 0.004), abs=1e-9)
    assert wall.requested_position is None


def test_a_roller_is_a_line_across_the_depth():
    beam = flexpm.Specimen.box(0.036, 0.008, 0.008, seed=1)
    rig = rig_of(beam, "rigid")
    rollers = [rig.support((x, 0.004, 0.0)) for x in (0.004, 0.032)]
    head = rig.support((0.018, 0.004, 0.008), pinned=True)
    assert rig.parts[2]["position"] == pytest.approx([0.018, 0.004, 0.008], abs=1e-12)
    assert head.position == pytest.approx(head.requested_position, abs=1e-12)
    rig.drive(head, (0, 0, -1), against=rollers)
    rig.strain_to(2e-6)
    left, right = (one.force[2] for one in rollers)
    assert left == pytest.approx(right, rel=0.1)
    assert left + right == pytest.approx(-head.force[2], rel=0.01)


def test_a_support_has_the_area_of_its_box(box):
    rig = rig_of(box)
    half = rig.support((0.5 * SIZE, 0.5 * SIZE, 0.0), (0.5 * SIZE, SIZE, SIZE), bonded=True)
    assert half.area == pytest.approx(0.5 * SIZE**2, rel=1e-9)
    small = rig.support((SIZE, 0.5 * SIZE, 0.5 * SIZE), 0.25 * SIZE)
    assert small.area == pytest.approx((0.25 * SIZE) ** 2, rel=1e-9)
    assert small.normal == (-1.0, 0.0, 0.0)
    core = flexpm.Specimen.cylinder(SIZE, SIZE, seed=1)
    rig = rig_of(core)
    mantle = rig.support((0.5 * SIZE, 0.0, 0.5 * SIZE), 0.25 * SIZE, normal=(-1, 0, 0))
    assert mantle.area == pytest.approx((0.25 * SIZE) ** 2, rel=0.05)


def test_what_is_wrong_is_refused(box):
    rig = rig_of(box)
    base, top = rig.platen(0), rig.platen(2)
    refused = [
        (lambda: rig.platen(6), "side = 6, must be one of 0, 1, 2, 3, 4, 5"),
        (lambda: rig.platen(1, seated=1), "seated = 1, must be"),
        (lambda: rig.support((0.006, 0.006, 0.0), seated=True), "length = None, must be given"),
        (lambda: rig.rotation_of("tilt", top), "must be seated"),
        (lambda: rig.platen(1, bonded=True, friction=0.2), "must be 0 for a bonded plate"),
        (lambda: rig.support((0.0, 0.0)), "position = \\(0.0, 0.0\\), must be x, y and z"),
        (lambda: rig.support((0.006, 0.006, 0.006), 0.003), "off the nearest flat side"),
        (lambda: rig.support((0.006, 0.006, 0.0), -1.0), "length = -1.0 m, must be > 0"),
        (lambda: rig.support((0.006, 0.006, 0.0), bonded=True), "length = None, must be given"),
        (lambda: rig.support((0.0, 0.006, 0.006), normal=(1, 0, 0)), "normal is not along z"),
        (lambda: rig.support((0.0, 0.006, 0.008)), "triangles at x = 0 m, z = 0.008 m = 0"),
        (lambda: rig.hold(), "give exactly one of box, ball and where"),
        (lambda: rig.rotate([]), "rotate: parts = none, must be at least 1"),
        (lambda: rig.drive(top, (0, -1)), "must be x, y and z"),
        (lambda: rig.drive(top, (0, 0, 1), against=base) or rig.load(), "pulls without bond"),
        (lambda: top.width, "width of platen at .* is available in 2D only"),
        (lambda: rig.platen(2), "overlaps .*choose another position"),
        (lambda: rig.support((0.006, 0.006, 0.0), 0.003), "overlaps .*choose another position"),
        (lambda: rig.support((0.006, 0.006, 0.0)), "overlaps .*choose another position"),
    ]
    for call, told in refused:
        refusal(told, call)
    spheres = fresh(box, model="jcfpm")
    refusal("test of model jcfpm = 'own', must be one of", flexpm.SolidPartRig, spheres)
    flat = fresh(flexpm.Specimen.rectangle(SIZE, SIZE, 0.01, seed=1))
    refusal("must be 3D; use flexpm.PartRig", flexpm.SolidPartRig, flat)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_held_nodes_bear_what_they_pull(model):
    tall = flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1)
    rig = rig_of(tall, model)
    low = rig.hold(box=((0, 0, 0), (SIZE, SIZE, 0.2 * SIZE)))
    high = rig.hold(where=lambda _x, _y, z: z > 1.8 * SIZE, axes="xyz")
    rig.displacement_of("way", high, (0, 0, 1))
    rig.drive(high, (0, 0, 1), against=low)
    rig.load(flexpm.Loading(kind="waiting"))
    record = rig.record
    peak = int(np.argmax(record["load"]))
    assert 0 < peak < len(record) - 1
    assert record["end_mismatch"][: peak + 1].max() < 0.05
    assert record["way"] == pytest.approx(record["displacement"], rel=1e-9, abs=1e-15)
    assert high.force[2] == pytest.approx(-low.force[2], abs=0.05 * record["load"].max())
    load, way = record["load"], record["displacement"]
    work = 0.5 * np.sum((load[1:] + load[:-1]) * np.diff(way)) + 0.5 * load[0] * way[0]
    assert high.work == pytest.approx(work, rel=0.03)
    # what the elastic start gives of motion is the rest
    assert record["boundary_work"][-1] - high.work == pytest.approx(rig.motion_energy, abs=1e-12)
    assert low.axes == "xyz"
    refusal("spin = 1.0, must be x, y and z", low.move, spin=1.0)


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_held_nodes_that_turn_twist_a_solid(model, tmp_path):
    tall = flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1)
    rig = rig_of(tall, model, out=tmp_path / "twisted")
    low = rig.hold(box=((0, 0, 0), (SIZE, SIZE, 0.3 * SIZE)))
    high = rig.hold(where=lambda _x, _y, z: z > 1.7 * SIZE)
    about = (0.5 * SIZE, 0.5 * SIZE, SIZE)
    rig.rotate(high, low, about=about, axis=(0, 0, 2), strength=15.0)
    rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.7))
    record = rig.record
    load, angle = record["load"], record["displacement"]
    peak = int(np.argmax(load))
    assert 0 < peak < len(record) - 1
    assert high.angle == pytest.approx((0.0, 0.0, angle[-1]), rel=1e-9)
    assert low.angle == pytest.approx((0.0, 0.0, -angle[-1]), rel=1e-9)
    # the record has the sum of both moments; at rest they are opposite
    assert high.moment[2] == pytest.approx(-low.moment[2], abs=0.05 * load.max())
    work = 0.5 * np.sum((load[1:] + load[:-1]) * np.diff(angle)) + 0.5 * load[0] * angle[0]
    assert high.work + low.work == pytest.approx(work, rel=0.03)
    works = record["boundary_work"][-1] - high.work - low.work
    assert works == pytest.approx(rig.motion_energy, abs=1e-12)
    assert abs(imbalance(rig)) < 1e-3 * record["boundary_work"][-1]
    rig.finish()
    found = content(tmp_path / "twisted")
    assert found["inputs"]["drive"]["turns"]
    assert found["peak_load"] is None
    assert "moment" in (tmp_path / "twisted" / "report.html").read_text()


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_static_solution_of_a_solid_is_where_steps_lead(model):
    tall = flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1)
    rig = rig_of(tall, model)
    floor, top = rig.platen(0, bonded=True), rig.platen(2, bonded=True)
    refusal("driven parts = none", rig.elastic, displacement=1e-6)
    rig.drive(top, (0, 0, -1), against=floor, strength=1e4)
    refusal(
        "displacement = 1e-06, must be left out if a load is given",
        rig.elastic,
        displacement=1e-6,
        load=1.0,
    )
    found = rig.elastic(displacement=1e-6)
    assert found.load == pytest.approx(1e-6 * rig.scales().modulus, rel=1e-9)
    assert found.force(top) == pytest.approx((0.0, 0.0, -found.load), abs=1e-6 * found.load)
    assert found.force(floor) == pytest.approx((0.0, 0.0, found.load), abs=1e-6 * found.load)
    assert found.displacement(top) == pytest.approx((0.0, 0.0, -1e-6))
    tenfold = rig.elastic(load=10.0 * found.load)
    assert tenfold.way == pytest.approx(1e-5, rel=1e-9)
    for name in ("tetrahedron_stress", "point_opening", "point_traction"):
        small, large = getattr(found, name), getattr(tenfold, name)
        assert large == pytest.approx(10.0 * small, rel=1e-9, abs=1e-9 * np.abs(large).max())
    assert yade.O.iter == 0
    rig.strain_to(1e-6)
    way, load = rig.record["displacement"][-1], rig.record["load"][-1]
    assert load / way == pytest.approx(found.load / found.way, rel=5e-3)
    # the grains are where the steps have led them
    led = rig.built.snapshot().positions - found.reference
    told = way / found.way * (found.positions - found.reference)
    assert np.abs(led - told).max() < 0.02 * np.abs(told).max()
    refusal("steps of the scene = .* must be 0", rig.elastic, displacement=1e-6)


def test_the_static_solution_of_a_twist_turns_what_is_held():
    rig = rig_of(flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1))
    low = rig.hold(box=((0, 0, 0), (SIZE, SIZE, 0.3 * SIZE)))
    high = rig.hold(where=lambda _x, _y, z: z > 1.7 * SIZE)
    about = np.array([0.5 * SIZE, 0.5 * SIZE, 0.0])
    rig.rotate(high, about=tuple(about))
    found = rig.elastic(load=1.0)
    assert found.load == pytest.approx(1.0)
    assert found.moment(high)[2] == pytest.approx(1.0, rel=1e-6)
    assert found.angle(high) == pytest.approx((0.0, 0.0, found.way))
    # nothing else acts: all forces sum to 0, and so do moments about a place
    couple = found.load / SIZE  # forces of this size make the moment
    assert np.add(found.force(high), found.force(low)) == pytest.approx(0.0, abs=1e-5 * couple)
    across = np.cross(np.subtract(low.position, about), found.force(low))
    balance = np.add(found.moment(high), found.moment(low)) + across
    assert balance == pytest.approx(0.0, abs=1e-5)
    held = found.reference[:, 2] > 1.7 * SIZE
    arms = found.reference[held] - about
    way = found.way * np.cross([0.0, 0.0, 1.0], arms)
    assert found.positions[held] - found.reference[held] == pytest.approx(way, rel=1e-6, abs=1e-14)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_plate_that_slides_takes_along_what_friction_holds(model, box):
    rig = rig_of(box, model)
    floor, lid = rig.platen(0, friction=0.5), rig.platen(2, friction=0.5)
    pin = rig.hold(ball=((0.5 * SIZE, 0.5 * SIZE, 0.5 * SIZE), 0.2 * SIZE))
    rig.drive(lid, (1.0, 0.0, 0.0), against=pin)
    found = rig.elastic(displacement=1e-6)
    push = found.force(lid)[0]
    assert push > 0.0
    total = np.add(np.add(found.force(floor), found.force(lid)), found.force(pin))
    assert total == pytest.approx((0.0, 0.0, 0.0), abs=1e-5 * push)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_held_nodes_without_a_point_bear_a_moment_alone(model):
    rig = rig_of(flexpm.Specimen.box(SIZE, SIZE, 2.0 * SIZE, seed=1), model)
    low = rig.hold(box=((0, 0, 0), (SIZE, SIZE, 0.3 * SIZE)))
    high = rig.hold(where=lambda _x, _y, z: z > 1.7 * SIZE)
    rig.rotate(high, axis=(1, 0, 0))
    found = rig.elastic(displacement=1e-6)
    assert found.angle(high) == pytest.approx((1e-6, 0.0, 0.0))
    couple = found.load / SIZE
    assert found.force(high) == pytest.approx((0.0, 0.0, 0.0), abs=1e-5 * couple)
    assert found.moment(low)[0] == pytest.approx(-found.load, rel=1e-6)
    rig.strain_to(1e-4)
    angle = rig.record["displacement"][-1]
    assert rig.record["load"][-1] / angle == pytest.approx(found.load / 1e-6, rel=5e-3)
    way = np.multiply(angle / 1e-6, found.displacement(high))
    assert high.displacement == pytest.approx(way, abs=0.01 * np.linalg.norm(way))
    assert np.linalg.norm(high.force) < 5e-3 * couple
    with pytest.raises(InputError, match="rotate: about = .*, must be as the record has begun"):
        rig.rotate(high, about=(0.0, 0.0, 0.0), axis=(1, 0, 0))


def test_a_solid_turns_about_an_axis_as_told(box):
    rig = rig_of(box)
    held = rig.hold(ball=((0.5 * SIZE, 0.5 * SIZE, 0.5 * SIZE), 0.3 * SIZE))
    held.move(spin=np.array([0.0, 1e-3, 0.0]))
    for _ in range(20):
        yade.O.step()
    assert held.angle == pytest.approx((0.0, 0.02, 0.0), rel=1e-9)
    for wrong, message in (
        ({"axis": (0, 0, 0)}, "rotate: axis: length of its direction = 0"),
        ({"axis": (0, 1)}, "rotate: axis: direction = .*, must be x, y and z"),
        ({"about": (0, 1)}, "rotate: about = .*, must be x, y and z"),
        ({"back": held}, "is given twice"),
        ({"area": 0.0}, "rotate: area = 0"),
    ):
        refusal(message, rig.rotate, held, **wrong)


def test_a_moved_set_takes_the_specimen_along(box):
    rig = rig_of(box)
    held = rig.hold(ball=((0.5 * SIZE, 0.5 * SIZE, 0.5 * SIZE), 0.3 * SIZE), axes="z")
    held.move((0.0, 0.0, 1e-9))
    for _ in range(50):
        yade.O.step()
    assert held.displacement == pytest.approx((0.0, 0.0, 5e-8), rel=1e-9)
    refusal("along x = 1 m/s, must be 0", held.move, (1.0, 0.0, 0.0))
    with pytest.raises(InputError, match="axes = 'yx', must be some of xyz"):
        rig.hold(box=((0, 0, 0), (1e-3, 1e-3, 1e-3)), axes="yx")
    refusal("hold: disc, must not be given in 3D; give a ball", rig.hold, disc=((0.0, 0.0), 1.0))
    refusal("is fixed already", rig.hold, ball=((0.5 * SIZE, 0.5 * SIZE, 0.5 * SIZE), 0.3 * SIZE))


def test_one_name_of_the_rig_takes_specimens_of_both_dimensions(box):
    rig = rig_of(box)
    assert type(rig) is flexpm.SolidPartRig
    plane = fresh(flexpm.Specimen.rectangle(0.02, 0.02, 0.01, seed=1), model="rigid")
    assert type(flexpm.PartRig(plane)) is flexpm.PartRig
    refusal("SolidPartRig: specimen = rectangle, must be 3D", flexpm.SolidPartRig, plane)
    yade.O.reset()
