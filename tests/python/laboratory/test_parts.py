# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts know their rig: refused calls, doubles, strangers, scenes taken up, set-up errors."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError, SimulationError
from flexpm.results.record import Curve
from flexpm.rigs.part_rig import PartRig
from flexpm.specimens.specimen import Specimen

LENGTH, HEIGHT, THICKNESS = 0.03, 0.01, 0.01
BEAM = Specimen.rectangle(LENGTH, HEIGHT, THICKNESS)
ROCK = flexpm.materials.load("augig-table7")


def built(specimen: Specimen = BEAM, model: str = "rigid", **options: object) -> flexpm.Model:
    return fresh(specimen, None, model, **options)


def refused(message: str, call, kind: type[Exception] = InputError) -> None:
    """The call is refused in one line that begins so."""
    with pytest.raises(kind) as error:
        call()
    assert str(error.value).startswith(message), str(error.value)
    assert "\n" not in str(error.value)


def beam(rig: PartRig):
    """Two rollers and a pin."""
    rollers = [rig.support((x, 0.0)) for x in (0.003, 0.027)]
    return rollers, rig.support((0.015, HEIGHT), pinned=True)


def largest_load(rig: PartRig) -> float:
    rig.load(flexpm.Loading(kind="waiting", rate=4.0))
    return float(rig.record["load"].max())


def test_a_call_that_is_refused_counts_nothing():
    rig = PartRig(built())
    for slip in (
        lambda: rig.support((0.015, 0.005)),
        lambda: rig.platen(7),
        lambda: rig.hold(box=((5.0, 5.0), (6.0, 6.0))),
    ):
        refusal("", slip)
    (left, right), pin = beam(rig)
    held = rig.hold(box=((0.013, 0.004), (0.017, 0.007)), axes="x")
    places = [part.position[0] for part in (left, right, pin)]
    assert places == pytest.approx([0.003, 0.027, 0.015], abs=1e-12)
    assert [part.number for part in (left, right, pin, held)] == [0, 1, 2, 0]
    assert [part.kind for part in (left, pin, held)] == ["support", "support", "held nodes"]
    assert str(right) == f"support at ({right.position[0]:g}, 0) m"
    assert held.axes == "x"


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_a_part_is_where_its_load_acts(model):
    rig = PartRig(built(model=model))
    asked = [(x, 0.0) for x in (0.0031, 0.0071, 0.0268)]
    rollers = [rig.support(place) for place in asked]
    head = rig.support((0.015, HEIGHT), length=0.003, pinned=True)
    for roller, place in zip(rollers, asked, strict=True):
        assert roller.position == pytest.approx(place, abs=1e-12)
        assert roller.requested_position == place
    assert head.position == pytest.approx((0.015, HEIGHT), abs=1e-12)
    # only half of it lies on the outline: it bears in the middle of that half
    side = rig.support((LENGTH, 0.0), length=0.002)
    assert side.position == pytest.approx((LENGTH - 0.0005, 0.0), abs=1e-12)
    assert side.requested_position == (LENGTH, 0.0)
    wall = rig.platen(3)
    assert wall.position == pytest.approx((0.0, 0.5 * HEIGHT), abs=1e-12)
    assert wall.requested_position is None
    assert rig.parts[-1]["position"] == pytest.approx([0.0, 0.5 * HEIGHT], abs=1e-12)


def test_moments_about_the_places_of_supports_vanish():
    rig = PartRig(built())
    (left, right), pin = beam(rig)
    rig.drive(pin, (0.0, -1.0), against=[left, right])
    rig.strain_to(2e-6)
    force = sum(part.force[1] for part in (left, right))
    assert force == pytest.approx(-pin.force[1], rel=0.01)
    # what is left is less than half a support, a quarter of a grain: loads below one are not even
    moment = sum(part.position[0] * part.force[1] for part in (left, right, pin))
    assert abs(moment / force) < 0.5 * left.width


def test_parts_are_those_of_their_rig_and_there_once():
    other = PartRig(built())
    stranger = other.platen(0)
    rig = PartRig(built())
    (left, right), pin = beam(rig)
    held = rig.hold(where=lambda x, y: (x > 0.013) & (x < 0.017) & (y < 0.007) & (y > 0.003))
    down = (0.0, -1.0)
    for call, message in (
        (lambda: rig.drive([pin, pin], down), "drive: part = support at"),
        (lambda: rig.drive(pin, down, against=[left, right, left]), "drive: part = support at"),
        (lambda: rig.drive(pin, down, against=[pin]), "drive: part = support at"),
        (lambda: rig.drive([], down), "drive: parts = none, must be >= 1"),
        (lambda: rig.drive(stranger, down), "drive: part = platen at (0.015, 0) m of another rig"),
        (lambda: rig.drive(pin, down, against=stranger), "drive: part against = platen at"),
        (lambda: rig.drive([pin, 5], down), "drive: part = 5, must be a part"),
        (lambda: rig.drive(pin, down, against=[None]), "drive: part against = None, must be a"),
        (lambda: rig.drive("pin", down), "drive: part = 'pin', must be parts of the rig"),
        (lambda: rig.drive(None, down), "drive: part = None, must be parts of the rig"),
        (lambda: rig.rotate([held, held]), "rotate: part = held nodes at"),
        (lambda: rig.rotate(held, held), "rotate: part = held nodes at"),
        (lambda: rig.rotate(pin), "rotate: part = support at"),
        (lambda: rig.press(held, 1e6), "press: part = held nodes at"),
        (lambda: rig.press(stranger, 1e6), "press: part = platen at"),
        (lambda: rig.press(pin, -1.0), "press: pressure = -1.0 Pa, must be >= 0"),
        (lambda: rig.displacement_of("way", stranger, down), "gauge way: part = platen at"),
    ):
        refused(message, call)
    rig.drive(pin, down, against=(left, right))
    assert rig.scales().modulus > 0.0


def test_one_part_needs_no_brackets_and_a_double_no_longer_adds():
    loads = []
    for brackets in (False, True):
        rig = PartRig(built())
        rollers, pin = beam(rig)
        rig.drive([pin] if brackets else pin, (0.0, -1.0), against=rollers)
        loads.append(largest_load(rig))
    assert loads[0] == loads[1] > 0.0


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_plates_do_not_lie_on_each_other(model):
    rig = PartRig(built(model=model))
    rig.platen(0)
    rig.support((0.01, HEIGHT), 0.004)
    for call in (
        lambda: rig.platen(0),
        lambda: rig.platen(2),
        lambda: rig.support((0.01, 0.0)),
        lambda: rig.support((0.0125, HEIGHT), 0.002),
    ):
        refusal("lies on plate [01], must not: both would carry the load", call)
    beside = rig.support((0.0135, HEIGHT), 0.003)  # it begins where the other one ends
    assert beside.number == 2
    assert beside.width == pytest.approx(0.003)


def test_supports_lie_on_the_outline_and_have_its_length():
    rig = PartRig(built())
    for call, message in (
        (lambda: rig.support((0.015, 0.0), 1.0), "support: length of a support = 1 m, must be <="),
        (lambda: rig.support((0.015, 0.0), 1e300), "support: length of a support = 1e+300 m"),
        (
            lambda: rig.support((0.015, -2e-4)),
            "support: position of a support = (0.015, -0.0002) m",
        ),
        (lambda: rig.support((-0.0005, 0.0)), "support: position of a support = (-0.0005, 0) m"),
        (lambda: rig.hold(box=((0.0, 0.0),)), "hold: box = ((0.0, 0.0),), must be two opposite"),
        (lambda: rig.hold(box=[(0, 0)] * 3), "hold: box = [(0, 0), (0, 0), (0, 0)], must be two"),
        (lambda: rig.hold(box=((0, 0), (1, 1, 1))), "hold: corner of the box = (1, 1, 1), must be"),
        (lambda: rig.hold(disc=(0, 0, 1)), "hold: disc = (0, 0, 1), must be a centre and a radius"),
        (lambda: rig.hold(where=5), "hold: where = 5, must be a function"),
    ):
        refused(message, call)
    assert rig.support((0.0, 0.0), 0.004).width == pytest.approx(0.002)  # half of it
    assert rig.support((0.015, HEIGHT), LENGTH).width == pytest.approx(LENGTH)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_scene_that_is_taken_up_gives_each_part_back_whatever_the_order(model, tmp_path):
    model = built(model=model)
    rig = PartRig(model)
    (left, right), pin = beam(rig)
    held = rig.hold(box=((0.013, 0.003), (0.017, 0.007)))
    other = rig.hold(box=((0.005, 0.003), (0.008, 0.007)), axes="x")
    rig.gauge("g", (0.004, 0.0), (0.026, 0.0))
    rig.displacement_of("w", pin, (0.0, -1.0))
    rig.drive(pin, (0.0, -1.0), against=[left, right])
    rig.start(flexpm.Loading())
    model.run(20)
    yade.O.save(str(tmp_path / "scene.bin"), quiet=True)
    yade.O.load(str(tmp_path / "scene.bin"), quiet=True)
    refused("drive: the scene is not", lambda: rig.drive(pin, (0.0, -1.0)))
    model.rebind()
    refused("support: the scene is not", lambda: rig.support((0.01, 0.0)))
    again = PartRig(model)
    refused("support: the call places another part than the 3", lambda: again.support((0.01, 0.0)))
    refused("support: the call places", lambda: again.support((0.015, HEIGHT)))  # no pin
    refused("support: the call places", lambda: again.support((0.003, 0.0), bonded=True))
    refused(
        "hold: the call places another part than the 2", lambda: again.hold(box=((0, 0), (1, 1)))
    )
    refused("hold: the call places", lambda: again.hold(box=((0.005, 0.003), (0.008, 0.007))))
    second = again.hold(box=((0.005, 0.003), (0.008, 0.007)), axes="x")
    head = again.support((0.015, HEIGHT), pinned=True)
    rollers = [again.support((x, 0.0)) for x in (0.027, 0.003)]
    first = again.hold(box=((0.013, 0.003), (0.017, 0.007)))
    assert [part.number for part in (*rollers, head)] == [1, 0, 2]
    assert (first.number, second.number) == (held.number, other.number)
    refused("gauge = 'h', must be a gauge", lambda: again.gauge("h", (0.004, 0.0), (0.026, 0.0)))
    refused("gauge g: first = ", lambda: again.gauge("g", (0.01, 0.0), (0.026, 0.0)))
    refused("gauge g: direction = ", lambda: again.gauge("g", (0.004, 0), (0.026, 0), along=(0, 1)))
    refused("gauge w: plate = 0", lambda: again.displacement_of("w", rollers[1], (0.0, -1.0)))
    refused("drive: driven = [0]", lambda: again.drive(rollers[1], (0.0, -1.0), against=rollers[0]))
    refused(
        "drive: area = 2.0, must be as the record has begun, 1.0",
        lambda: again.drive(head, (0.0, -1.0), against=rollers[::-1], area=2.0),
    )
    again.gauge("g", (0.004, 0.0), (0.026, 0.0))
    again.displacement_of("w", head, (0.0, -1.0))
    again.drive(head, (0.0, -1.0), against=rollers[::-1])
    assert len(again.record) > 0


def test_two_rigs_of_one_scene_do_not_share_parts():
    model = built()
    top = PartRig(model).platen(2)
    second = PartRig(model)
    refused(
        "platen: the call places another part than the 1 left in the scene",
        lambda: second.platen(0),
    )
    refused("drive: part = platen at", lambda: second.drive(top, (0.0, -1.0)))
    assert second.platen(2).number == 0
    assert second.platen(0).number == 1


def test_numbers_of_numpy_are_numbers_and_nonsense_is_refused_in_one_line():
    rig = PartRig(built())
    sides = [rig.platen(side) for side in np.arange(0, 4, 2)]
    assert [part.number for part in sides] == [0, 1]
    rig.support(np.array([0.0, 0.005]), np.float32(0.002), friction=np.float64(0.5))
    for call, message in (
        (lambda: rig.platen(None), "platen: side = None, must be a whole number"),
        (lambda: rig.platen(0.5), "platen: side = 0.5, must be a whole number"),
        (lambda: rig.platen(1, friction="a"), "platen: friction = 'a', must be a number"),
        (lambda: rig.platen(1, bonded="no"), "platen: bonded = 'no', must be true or false"),
        (lambda: rig.support((0.0, 0.005), friction=None), "support: friction = None, must be"),
        (lambda: rig.support((0.0, 0.005), friction=-1), "support: friction = -1, must be >= 0"),
        (lambda: rig.support((0.0, 0.005), pinned=2), "support: pinned = 2, must be true or"),
        (lambda: rig.support(5), "support: position = 5, must be x and y"),
        (lambda: rig.support("ab"), "support: position = 'ab', must be x and y"),
        (lambda: rig.support((0.0, "b")), "support: position: y = 'b' m, must be a number"),
        (lambda: rig.support((0.0, 0.005), None, normal=3), "support: normal = 3, must be x and y"),
        (lambda: rig.drive(sides[0], (0, 1), area="a"), "drive: area = 'a' m2, must be a number"),
        (lambda: rig.drive(sides[0], (0, 1), area=0), "drive: area = 0 m2, must be > 0"),
        (lambda: rig.drive(sides[0], (0, 1), strength=-1), "drive: strength = -1 Pa, must be >= 0"),
        (lambda: rig.drive(sides[0], 7), "drive: direction = 7, must be x and y"),
        (lambda: rig.gauge(5, (0, 0), (1, 1)), "gauge = 5, must be a text"),
        (lambda: rig.gauge("g", (0, 0), None), "gauge g: second = None, must be x and y"),
        (lambda: rig.hold(axes=3, box=((0, 0), (1, 1))), "hold: axes = 3, must be x, y"),
        (lambda: flexpm.Loading(control=5), "Loading: control = 5, must be a text"),
        (lambda: flexpm.Loading(static="a"), "Loading: static = 'a', must be true or false"),
        (lambda: BEAM.with_joints(np.ma.masked_array(np.eye(9))), "joints = masked_array("),
    ):
        refused(message, call)


def test_names_of_columns_are_checked_at_the_call():
    rig = PartRig(built())
    rollers, pin = beam(rig)
    rig.drive(pin, (0.0, -1.0), against=rollers)
    rig.gauge("cmod", (0.012, 0.0), (0.018, 0.0))
    for call, message in (
        (
            lambda: rig.alias_column("f", "axial_stres"),
            "alias_column: column = 'axial_stres', unknown (did you",
        ),
        (
            lambda: rig.alias_column("load", "axial_stress"),
            "alias_column = 'load', must not be the name of",
        ),
        (
            lambda: rig.alias_column("set_point", "load"),
            "alias_column = 'set_point', must not be the name of",
        ),
        (
            lambda: rig.alias_column("", "load"),
            "alias_column = '', must be a name of printable characters",
        ),
        (lambda: rig.gauge("", (0, 0), (1, 1)), "gauge = '', must be a name"),
        (lambda: rig.gauge("a\nb", (0, 0), (1, 1)), "gauge = 'a\\nb', must be a name"),
        (lambda: rig.gauge(" a", (0, 0), (1, 1)), "gauge = ' a', must be a name"),
        (lambda: rig.gauge("set_point", (0, 0), (1, 1)), "gauge = 'set_point', must not be"),
        (lambda: rig.gauge("initial_energy", (0, 0), (1, 1)), "gauge = 'initial_energy', must"),
        (
            lambda: rig.displacement_of("cmod", pin, (0, 1)),
            "gauge = 'cmod', must not be the name of",
        ),
    ):
        refused(message, call)
    rig.alias_column("force", "load")
    rig.alias_column("opening", "cmod")
    refused("gauge = 'force'", lambda: rig.gauge("force", (0, 0), (1, 1)))
    rig.strain_to(1e-8)
    assert np.array_equal(rig.record["force"], rig.record["load"])
    assert np.array_equal(rig.record["opening"], rig.record["cmod"])
    refused("gauge = 'late', must be a gauge", lambda: rig.gauge("late", (0, 0), (0.01, 0)))
    refused("record: column = 'axial_stres', unknown", lambda: rig.record["axial_stres"])
    refused(
        "Loading: control = 'cmodd' (did you mean cmod?), must be one of",
        lambda: rig.load(flexpm.Loading(control="cmodd")),
    )
    assert "axial_stres" in str(pytest.raises(InputError, Curve().__getitem__, "axial_stres").value)


def test_what_is_missing_to_load_a_specimen_is_said_in_one_line():
    side = 0.02
    rig = PartRig(built(Specimen.rectangle(side, side, THICKNESS)))
    refused("load: driven parts = none, must be at least 1; call drive", rig.load)
    refused("load: driven parts = none, must be at least 1", lambda: rig.strain_to(1e-6))
    refused("confine: part = None, must be a part of the rig; call press", lambda: rig.confine(1e6))
    floor, lid = rig.platen(0, bonded=True), rig.platen(2, bonded=True)
    rig.drive(lid, (0.0, 1.0), against=floor)
    message = "load: parts that fix the specimen along x = 0, must be at least 1; give a part"
    for _ in range(2):  # and nothing of it is left
        refused(message, rig.load)
    rig.hold(disc=((side / 2, side / 2), 0.003), axes="x")
    rig.strain_to(1e-8)
    assert rig.record["load"][-1] > 0.0

    rig = PartRig(built())
    rig.drive(rig.support((0.015, HEIGHT), pinned=True), (0.0, -1.0))
    refused("load: ", rig.load)

    rig = PartRig(built())
    wall = rig.platen(3)
    rig.drive(wall, (1.0, 0.0), against=rig.platen(1))
    refused("load: parts that fix the specimen along y = 0", rig.load)


def test_a_driven_plate_that_only_leaves_the_specimen_is_refused():
    rig = PartRig(built())
    left = rig.support((0.003, 0.0), pinned=True)
    right, pin = rig.support((0.027, 0.0)), rig.support((0.015, HEIGHT), pinned=True)
    rig.drive(right, (0.0, -1.0), against=pin)
    refused("load: driven part = plate at", rig.load)
    refused("load: driven part = plate at", lambda: rig.strain_to(1e-7))
    rig.drive(right, (0.0, 1.0), against=[left, pin])
    rig.strain_to(1e-8)  # and nothing of the refused loading is left
    assert rig.record["load"][-1] > 0.0


def test_a_record_whose_numbers_are_none_ends_as_diverged():
    rig = PartRig(built())
    rollers, pin = beam(rig)
    rig.drive(pin, (0.0, -1.0), against=rollers, strength=1e300)
    rig.load(flexpm.Loading(kind="waiting"))
    assert rig.diverged
    assert np.isfinite(rig.record["load"]).all()
    assert rig.warnings[0].startswith("the record ends before step")
    refused("strain_to: ", lambda: rig.strain_to(1.0), SimulationError)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_held_nodes_move_along_what_is_held_alone(model):
    rig = PartRig(built(model=model))
    held = rig.hold(box=((0.0, 0.0), (0.004, HEIGHT)), axes="x")
    refused("move: velocity of a node set along y = 1e-07 m/s", lambda: held.move((0.0, 1e-7)))
    refused("move: velocity: x = 'a' m/s", lambda: held.move(("a", 0.0)))
    refused("move: spin = None", lambda: held.move(spin=None))
    refused("drive: part = held nodes at", lambda: rig.drive(held, (0.0, 1.0)))
    rig.built.run(10)
    assert held.displacement == (0.0, 0.0)
    held.move((1e-9, 0.0))
    rig.built.run(10)
    assert held.displacement == pytest.approx((1e-8, 0.0))
    rig = PartRig(built(model=model))
    clamp = rig.hold(box=((0.0, 0.0), (0.004, HEIGHT)))
    turned = rig.hold(box=((0.026, 0.0), (LENGTH, HEIGHT)))
    rig.rotate(turned)
    refused("move: velocity of a node set along x", lambda: turned.move((1e-9, 0.0)))
    refused("drive: other parts are loaded after rotate", lambda: rig.drive(clamp, (1.0, 0.0)))


def test_a_watch_that_takes_the_scene_away_ends_in_one_line():
    for watch in (lambda _: yade.O.reset(), lambda _: setattr(yade.O, "engines", [])):
        for rig in (PartRig(built()), None):
            rig = rig or flexpm.rig(built())
            if isinstance(rig, PartRig):
                rollers, pin = beam(rig)
                rig.drive(pin, (0.0, -1.0), against=rollers)
            rig.watch = watch
            refused("watch: the callback changed the scene", rig.load, SimulationError)


def test_rigs_of_two_ends_are_for_rectangles_and_discs():
    triangle = Specimen.polygon([(0.0, 0.0), (0.02, 0.0), (0.01, 0.017)], 0.01)
    refused(
        "rig: specimen = polygon, must be one of rectangle, disc",
        lambda: flexpm.rig(built(triangle)),
    )


def test_every_rig_has_warnings_and_gives_its_record_to_yade():
    from yade import plot

    for model in ("flexible", "rigid", "jcfpm"):
        rig = flexpm.rig(built(Specimen.rectangle(0.01, 0.02, 0.01), model))
        rig.strain_to(1e-5)
        rig.to_yade_plot()
        assert plot.data["axial_stress"] == rig.record["axial_stress"].tolist()
        assert isinstance(rig.warnings, list)
        plot.reset()


def test_a_gauge_whose_grain_is_gone_is_said():
    rig = PartRig(built())
    rollers, pin = beam(rig)
    rig.gauge("there", (0.004, 0.0), (0.01, 0.0))
    rig.gauge("gone", (0.015, 0.0), (0.02, 0.0))
    rig.drive(pin, (0.0, -1.0), against=rollers)
    rig.strain_to(1e-8)
    assert rig.warnings == []
    places = {body.id: body.state.pos for body in yade.O.bodies}
    for number in [one for one, at in places.items() if np.hypot(at[0] - 0.02, at[1]) < 0.004]:
        yade.O.bodies.erase(number)
    assert [line for line in rig.warnings if line.startswith("gauge ")] == [
        "gauge gone reads a node of an erased grain, which no longer moves; rows from there on "
        "are not valid, place another gauge"
    ]


def test_a_set_point_that_is_missed_is_said():
    rig = PartRig(built())
    rollers, pin = beam(rig)
    rig.gauge("cmod", (0.012, 0.0), (0.018, 0.0))
    rig.drive(pin, (0.0, -1.0), against=rollers)
    rig.load(flexpm.Loading(kind="waiting", rate=30.0, control="cmod", max_strain=3e-6))
    record = rig.record
    off = np.abs(record["cmod"] / record["set_point"] - 1.0) > 0.02
    assert np.mean(off) > 0.1
    assert any(
        line.startswith("set point of cmod = missed by more than 2 %") for line in rig.warnings
    )
