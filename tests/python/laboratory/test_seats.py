# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts on a spherical seat, in 2D and 3D: they turn, bear no moment; folders, refusals."""

from __future__ import annotations

import json

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh, require_balance

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError

LENGTH, HEIGHT, THICKNESS, SPAN = 0.06, 0.010, 0.01, 0.044
DOWN = (0.0, -1.0)


def beam(length: float | None, *, seated: bool = False, model: str = "flexible", **leaves: object):
    """A beam between two supports and a pin; these, and the rig."""
    made = flexpm.Specimen.rectangle(LENGTH, HEIGHT, THICKNESS, seed=1)
    name = "augig-table7" if model == "flexible" else "augig-table2-bilinear"
    rig = flexpm.PartRig(fresh(made, name, model), **leaves)
    left, right = (
        rig.support((0.5 * (LENGTH + s * SPAN), 0.0), length, seated=seated) for s in (-1, 1)
    )
    pin = rig.support((0.5 * LENGTH, HEIGHT), pinned=True)
    rig.drive(pin, DOWN, against=[left, right])
    return rig, left, right


def stiffness(length: float | None, *, seated: bool = False) -> float:
    return beam(length, seated=seated)[0].elastic(displacement=1e-9).load


def test_a_beam_on_long_seats_is_as_stiff_as_on_short_ones():
    """One that rests on the inner ends of long plates has a shorter span, and is stiffer."""
    short, long = stiffness(None, seated=True), 0.012
    assert stiffness(long, seated=True) == pytest.approx(short, rel=0.03)
    inner = (SPAN / (SPAN - long)) ** 3
    assert stiffness(long) > 0.5 * (1.0 + inner) * short


def test_seats_turn_as_the_ends_of_the_beam_do():
    """By 3 delta / span, of the part of the deflection that bends the beam."""
    rig, left, right = beam(0.012, seated=True)
    rig.rotation_of("tilt", left)
    way = 1e-6
    state = rig.elastic(displacement=way)
    thin = 1.0 + 3.0 * (HEIGHT / SPAN) ** 2  # Timoshenko's, of the shear modulus that granite has
    assert state.angle(left) == pytest.approx(-3.0 * way / SPAN / thin, rel=0.1)
    assert state.angle(right) == pytest.approx(-state.angle(left), rel=0.05)
    rig.strain_to(2e-7)
    record = rig.record
    per_way = np.polyfit(record["displacement"], record["tilt"], 1)[0]
    assert per_way == pytest.approx(state.angle(left) / way, rel=1e-3)
    slope = np.polyfit(record["displacement"], record["load"], 1)[0]
    assert slope == pytest.approx(state.load / way, rel=1e-3)
    assert left.angle == record["tilt"][-1]
    assert rig.warnings == []


def test_a_seated_platen_divides_its_load_evenly():
    """Two columns on seats, one softer: it bears less, but for a seated platen, by moments."""
    shares = []
    for seated in (False, True):
        yade.O.reset()
        made = flexpm.Specimen.rectangle(0.016, 0.016, THICKNESS, seed=1)
        cut = made.with_joints(
            {"slit": [[0.008, -1e-3], [0.008, 0.017]], "soft": [[0.008, 0.008], [0.017, 0.008]]}
        )
        law = {"normal_stiffness": 2e12, "shear_stiffness": 1e12, "friction": 0.5}
        law |= {"tensile_strength": 1e9, "cohesion": 1e9}
        rock = flexpm.materials.load("augig-table7").with_set("joint.slit.open=true")
        rock = rock.with_set({f"joint.soft.{key}": value for key, value in law.items()})
        rig = flexpm.PartRig(flexpm.build(cut, rock))
        low = [rig.support((x, 0.0), 7.9e-3, friction=10.0, seated=True) for x in (0.004, 0.012)]
        top = rig.platen(2, seated=seated)
        rig.drive(top, DOWN, against=low)
        state = rig.elastic(displacement=1e-7)
        left, right = (state.force(part)[1] for part in low)
        shares.append(left / (left + right))
    assert shares[0] > 0.58
    middles = [0.5 * (ends[0][0] + ends[1][0]) for ends in (one["face"] for one in rig.parts[:2])]
    even = (middles[1] - 0.008) / (middles[1] - middles[0])
    assert shares[1] == pytest.approx(even, rel=1e-6)
    assert state.force(low[0])[1] + state.force(low[1])[1] == pytest.approx(state.load, rel=1e-9)


WEDGE = 0.02  # slope of the top of a column [-]


def wedge(model: str, slope: float, *, seated: bool):
    """A column that is held at its base, under a plate that is square to it; both."""
    yade.O.reset()
    width, height = 0.012, 0.018
    rise = 0.5 * width * slope
    corners = [(0.0, 0.0), (width, 0.0), (width, height + rise), (0.0, height - rise)]
    made = flexpm.Specimen.polygon(corners, THICKNESS, seed=3)
    never = dict.fromkeys(("tensile_strength", "cohesion"), 1e9)
    never |= dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e6)
    rock = flexpm.materials.load("augig-table2-bilinear").with_set(never, model)
    rig = flexpm.PartRig(flexpm.build(made, rock, model))
    base = rig.hold(box=((0.0, 0.0), (width, 2e-3)))
    middle = (0.5 * width, height)
    return rig, base, rig.support(middle, width, normal=DOWN, seated=seated)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("slope", [-WEDGE, WEDGE])
@pytest.mark.parametrize("seated", [True, False])
def test_a_seat_lies_on_an_inclined_face_and_else_its_corner_takes_all(model, slope, seated):
    rig, base, top = wedge(model, slope, seated=seated)
    face = rig.parts[0]["face"]
    width, middle = top.width, 0.5 * (face[0][0] + face[1][0])
    assert top.angle == pytest.approx(slope if seated else 0.0, rel=1e-9)
    state = rig.elastic({top: 2e6})
    rig.press(top, 2e6)
    pushed = -top.force[1]
    assert pushed == pytest.approx(2e6 * width * THICKNESS, rel=1e-3)
    # moment of the plate about the middle of its face, as what holds the column bears it
    arm = (base.moment / pushed + base.position[0] - middle) / width
    if seated:
        # all of it bears; the grains before it are not alike
        assert top.angle == pytest.approx(slope, rel=1e-3)
        assert state.angle(top) == pytest.approx(top.angle, rel=1e-4)
        assert abs(arm) < 2e-3
    else:
        assert top.angle == 0.0
        assert arm == pytest.approx(np.copysign(0.5, slope), rel=0.1)
    require_balance(rig, 1e-6)


def test_what_has_no_seat_is_not_read_and_a_folder_tells_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rig, left, _ = beam(0.012, seated=True, model="rigid", out="first", report=False)
    with pytest.raises(InputError, match="gauge tilt: part = plate at .*, must be seated"):
        rig.rotation_of("tilt", rig._all_parts[2])
    refusal("support: seated = 1, must be", rig.support, (0.0, 0.5 * HEIGHT), seated=1)
    rig.rotation_of("tilt", left)
    rig.strain_to(1e-7)
    rig.finish()
    told = json.loads((tmp_path / "first" / "result.json").read_text())["inputs"]
    assert [part.get("seated", False) for part in told["parts"]] == [True, True, False]
    yade.O.reset()
    assert cli.main(["rerun", "first", "--out", "second", "--no-report"]) == 0
    for name in ("curve.csv", "final.vtu"):
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "second" / name).read_bytes()
    assert "tilt" in (tmp_path / "first" / "curve.csv").read_text().splitlines()[0]


@pytest.mark.parametrize("seated", [False, True])
def test_energies_close_with_seats(seated):
    rig, *_ = beam(0.012, seated=seated, model="rigid")
    rig.strain_to(2e-6)
    rig.relax()
    require_balance(rig, 1e-6)


SIZE = 0.012
SOLID_DOWN = (0, 0, -1)
MODELS = pytest.mark.parametrize("model", ["flexible", "rigid"])


def block(model: str, *, seated: bool):
    """A block that is held at one half of its base, below a platen, and both parts."""
    box = flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(fresh(box, "augig-table7", model))
    base = rig.hold(box=((0, 0, 0), (0.6 * SIZE, SIZE, 0.2 * SIZE)))
    top = rig.platen(2, seated=seated)
    rig.drive(top, SOLID_DOWN, against=base)
    return rig, base, top


def eccentricity(force: np.ndarray, moment: np.ndarray, base, middle: np.ndarray) -> float:
    """How far the load is off the middle of the platen, by what the base bears, in sizes [-]."""
    whole = moment + np.cross(np.array(base.position) - middle, force)
    return float(np.hypot(*whole[:2]) / abs(force[2]) / SIZE)


@MODELS
def test_a_seated_platen_loads_through_its_middle(model):
    """What holds the block bears a moment about the seat only if the platen is not seated."""
    found = {}
    for seated in (False, True):
        rig, base, top = block(model, seated=seated)
        middle = np.array(top.position)
        state = rig.elastic(displacement=1e-8)
        linear = eccentricity(
            *(np.array(of(base)) for of in (state.force, state.moment)), base, middle
        )
        if seated:
            rig.rotation_of("tilt", top)
        rig.strain_to(2e-6)
        rig.relax()
        stepped = eccentricity(np.array(base.force), np.array(base.moment), base, middle)
        found[seated] = linear, stepped
    assert max(found[True]) < 1e-3
    assert min(found[False]) > 0.05
    # it goes down where nothing is below, at larger x
    angle = np.array(state.angle(top))
    assert angle[1] > 5.0 * abs(angle[0])
    assert angle[2] == 0.0
    factor = top.displacement[2] / state.displacement(top)[2]
    assert np.array(top.angle) == pytest.approx(
        factor * angle, rel=0.1, abs=0.05 * factor * angle[1]
    )
    assert rig.record["tilt"][-1] == pytest.approx(np.linalg.norm(top.angle), rel=0.01)
    require_balance(rig, 1e-5)


@MODELS
def test_seats_lie_down_on_a_mantle_and_press_evenly(model):
    """Facets of a mantle are inclined to a plate before it; the nearest three bear it at first."""
    core = flexpm.Specimen.cylinder(SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(fresh(core, "augig-table7", model))
    place, edge = (0.5 * SIZE, 0.0, 0.65 * SIZE), 0.4 * SIZE
    plate = rig.support(place, edge, normal=(-1, 0, 0), seated=True, strip=1e13)
    base = rig.hold(box=((-SIZE, -SIZE, 0.0), (SIZE, SIZE, 0.15 * SIZE)))
    laid = np.array(plate.angle)
    assert laid[0] == 0.0
    assert 1e-4 < np.linalg.norm(laid) < 0.5
    assert rig.parts[0]["seated"]
    assert "seated" not in rig.parts[1]
    state = rig.elastic({plate: 2e6})
    turned = np.array(state.angle(plate)) - laid
    assert np.linalg.norm(turned) < 0.05
    rig.press(plate, 2e6)
    pushed = 2e6 * plate.area
    assert -plate.force[0] == pytest.approx(pushed, rel=2e-3)
    assert base.force[0] == pytest.approx(pushed, rel=2e-3)
    assert np.linalg.norm(np.array(plate.angle) - laid) > 0.0
    rig.drive(plate, (-1, 0, 0), against=base)
    before = rig.built.solver.energies()
    rig.strain_to(1e-6)
    energies = require_balance(rig, 1e-3)
    assert energies["elastic_energy"] > before["elastic_energy"]


@MODELS
@pytest.mark.parametrize("turned", [0.0, 40.0, 90.0, 200.0])
def test_a_plate_that_was_laid_on_a_mantle_loads_it_at_once(model, turned):
    """What it lies on counts as touched, wherever it lies: static solutions and steps agree."""
    core = flexpm.Specimen.cylinder(SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(fresh(core, "augig-table7", model))
    x, y = np.cos(np.radians(turned)), np.sin(np.radians(turned))
    base = rig.hold(box=((-SIZE, -SIZE, 0.0), (SIZE, SIZE, 0.15 * SIZE)))
    place = (0.5 * SIZE * x, 0.5 * SIZE * y, 0.65 * SIZE)
    plate = rig.support(place, 0.4 * SIZE, normal=(-x, -y, 0), seated=True)
    assert np.linalg.norm(np.array(plate.position)[:2]) == pytest.approx(0.5 * SIZE, rel=0.06)
    rig.drive(plate, (-x, -y, 0), against=base)
    state = rig.elastic(displacement=1e-8)
    rig.strain_to(1e-7)
    load, way = rig.record["load"][-1], rig.record["displacement"][-1]
    # few contacts bear at first, more as it goes on
    assert 0.3 * state.load / 1e-8 < load / way < 3.0 * state.load / 1e-8
    require_balance(rig, 1e-3)


def test_seats_alone_are_refused():
    rig = flexpm.SolidPartRig(fresh(flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)))
    low, top = rig.platen(0, seated=True), rig.platen(2, seated=True)
    rig.drive(top, SOLID_DOWN, against=low)
    refusal("load: the specimen can tip over", rig.strain_to, 1e-6)


@MODELS
def test_a_pressed_plate_bears_its_pressure_beside_a_soft_machine(model):
    """Also where a load is asked for, of which the machine gives a part of the way."""
    box = flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(fresh(box, "augig-table7", model))
    low, top, left, right = (rig.platen(side) for side in (0, 2, 3, 1))
    rig.drive(top, SOLID_DOWN, against=low, machine=1e8)
    state = rig.elastic({left: 1e6, right: 1e6}, load=1e3)
    assert state.load == pytest.approx(1e3)
    assert state.force(left)[0] == pytest.approx(1e6 * left.area, rel=1e-3)
    assert state.force(right)[0] == pytest.approx(-1e6 * right.area, rel=1e-3)
