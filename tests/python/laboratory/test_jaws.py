# SPDX-License-Identifier: GPL-3.0-or-later
"""Curved jaws around discs of 2D and 3D: contact angle, own radius, strips, refusals."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh, require_balance

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError

DIAMETER, THICKNESS = 0.03, 0.01
RADIUS = 0.5 * DIAMETER
#: Strength that sets the loading rate; nothing breaks here [Pa].
STRENGTH = 3e7
DOWN = (0.0, -1.0)


def made(model: str = "rigid", **leaves: object) -> flexpm.PartRig:
    disc = flexpm.Specimen.disc(DIAMETER, THICKNESS, diameters=(1.6e-3, 2.4e-3), seed=1)
    rock = flexpm.materials.load("augig-table2-bilinear", model)
    strong = {"tensile_strength": 1e12, "cohesion": 1e12, "softening": "brittle"}
    return flexpm.PartRig(fresh(disc, rock.with_set(strong, model), model), **leaves)


def between(rig: flexpm.PartRig, radius: float, machine: float | None = None, **jaws: object):
    top, low = (rig.jaw((0.0, y), radius, **jaws) for y in (RADIUS, -RADIUS))
    rig.contact_angle_of("angle", top)
    area = DIAMETER * THICKNESS
    rig.drive(
        top, DOWN, against=low, length=DIAMETER, area=area, strength=STRENGTH, machine=machine
    )
    return top, low


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_the_contact_angle_grows_with_the_load(model):
    rig = made(model)
    top, low = between(rig, 1.5 * RADIUS)
    rig.strain_to(1e-2, rate=4.0)
    load, angle = rig.record["load"], rig.record["angle"]
    assert np.all(np.diff(load[load > 0.2 * load.max()]) > 0.0)
    assert np.all(np.diff(angle) >= 0.0)
    assert 0.0 < angle[len(angle) // 4] < angle[-1] < 1.5
    assert top.contact_angle == angle[-1]
    assert top.force[1] == pytest.approx(-low.force[1], rel=0.05)
    assert top.kind == "jaw"


def test_the_face_of_a_jaw_touches_the_disc_at_its_place_alone():
    rig = made()
    between(rig, 1.5 * RADIUS, friction=0.3)
    for one, y in zip(rig.parts, (RADIUS, -RADIUS), strict=True):
        face = np.array(one["face"])
        assert face[len(face) // 2] == pytest.approx([0.0, y], abs=1e-3 * RADIUS)
        away = np.linalg.norm(face, axis=1) - RADIUS
        assert np.all(away > -1e-5 * RADIUS)
        assert away[0] > 0.1 * RADIUS
        # on the circle of the jaw
        centre = [0.0, y - 1.5 * y]
        assert np.linalg.norm(face - centre, axis=1) == pytest.approx(1.5 * RADIUS, rel=1e-3)


def hertz(load: float, young: float) -> float:
    """Contact angle of two cylinders, the jaw hollow and rigid, in plane stress [rad]."""
    relative = 1.0 / (1.0 / RADIUS - 1.0 / (1.5 * RADIUS))
    half = np.sqrt(4.0 * load * relative / (np.pi * THICKNESS * young))
    return 2.0 * half / RADIUS


def middle_stresses(state: flexpm.Snapshot) -> tuple[float, float]:
    """Means of the lateral and the axial stress over the middle tenth of the disc [Pa]."""
    radii, angles = np.meshgrid(0.1 * RADIUS * np.array([0.4, 0.7, 1.0]), np.arange(0.0, 6.2, 0.26))
    places = np.column_stack([(radii * np.cos(angles)).ravel(), (radii * np.sin(angles)).ravel()])
    found = state.stress_at(places)
    return float(np.nanmean(found.xx)), float(np.nanmean(found.yy))


@pytest.mark.long
def test_contact_angle_and_splitting_stress_are_those_of_hertz():
    """The angle, mean over loads, since it grows node by node: within 5 %; each within a node at
    both ends. The stress in the middle: within 2 %, that of diametric loads spread as Hertz's.
    """
    yade.O.reset()
    grain = DIAMETER / 40.0
    sizes = (0.9 * grain, 1.1 * grain)
    disc = flexpm.Specimen.disc(DIAMETER, THICKNESS, diameters=sizes, seed=1)
    rock = flexpm.materials.load("augig-table7")
    stiff = {"normal_stiffness": 100.0 * rock.law("flexible")["normal_stiffness"]}
    rock = rock.with_set(stiff, "flexible")
    square = flexpm.Specimen.rectangle(*[0.02] * 2, THICKNESS, diameters=(1e-3, 1.2e-3), seed=1)
    young = flexpm.elastic(square, rock)["youngs_modulus"]
    rig = flexpm.PartRig(flexpm.build(disc, rock))
    top, low = between(rig, 1.5 * RADIUS)
    ratios = []
    for angle in np.linspace(0.25, 0.40, 7):
        load = (angle / hertz(1.0, young)) ** 2
        state = rig.elastic(load=load)
        ratios.append(state.contact_angle(top) / angle)
        assert state.contact_angle(top) == pytest.approx(angle, abs=2.0 * grain / RADIUS)
        assert state.force(low)[1] == pytest.approx(load, rel=1e-6)
        splitting = 2.0 * load / (np.pi * DIAMETER * THICKNESS)
        # a pair of loads at an angle t splits by cos^2 t - 3 sin^2 t; t^2 is (angle / 4)^2 in mean
        spread = 0.25 * (0.5 * angle) ** 2
        lateral, axial = middle_stresses(state)
        assert lateral == pytest.approx(splitting * (1.0 - 3.5 * spread), rel=0.02)
        assert axial == pytest.approx(-3.0 * splitting * (1.0 - 5.0 / 6.0 * spread), rel=0.04)
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.05)


def test_a_jaw_of_the_discs_own_radius_lies_on_its_angle_at_once():
    rig = made()
    top, _ = between(rig, RADIUS, angle=0.5, friction=0.3)
    rig.strain_to(1e-4)
    assert rig.record["angle"][-1] == pytest.approx(0.5, rel=0.02)
    assert top.width == pytest.approx(2.0 * RADIUS * np.sin(0.25), rel=0.02)
    found = rig.layout["parts"][0]
    assert found["radius"] == RADIUS


def test_a_smooth_jaw_of_the_discs_own_radius_leaves_it_free_to_turn():
    rig = made()
    between(rig, RADIUS, angle=0.5)
    for call in (lambda: rig.strain_to(1e-5), lambda: rig.elastic(displacement=1e-8)):
        assert "give a jaw friction" in refusal("against rotation = 0, must be at least 1; ", call)


def test_the_static_solution_has_the_force_of_the_steps():
    rig = made("flexible")
    top, low = between(rig, RADIUS, angle=0.5, friction=0.3)
    state = rig.elastic(displacement=1e-8)
    assert state.force(low)[1] == pytest.approx(-state.force(top)[1], rel=1e-9)
    rig.strain_to(1e-3)
    rig.dwell(60.0, by="displacement")
    way = rig.record["displacement"][-1]
    assert top.force[1] == pytest.approx(state.force(top)[1] * way / 1e-8, rel=0.02)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_jaw_with_friction_in_a_soft_machine_bears_in_series_with_it(model):
    """What rubs at its slopes is a part of the load, and of the energies, which close."""
    jaws = {"angle": 0.9, "friction": 0.3}
    rig = made(model)
    between(rig, RADIUS, **jaws)
    stiff = rig.elastic(displacement=1e-8)
    machine = 0.5 * stiff.load / 1e-8
    rig = made(model)
    top, low = between(rig, RADIUS, machine=machine, **jaws)
    soft = rig.elastic(load=stiff.load)
    assert soft.way == pytest.approx(3e-8, rel=1e-6)
    assert soft.displacement(top)[1] == pytest.approx(-1e-8, rel=1e-6)
    rig.strain_to(1e-3, rate=4.0)
    rig.dwell(60.0, by="displacement")
    record = rig.record
    assert record["machine_energy"][-1] == pytest.approx(
        0.5 * top.force[1] ** 2 / machine, rel=1e-9
    )
    crosshead = record["displacement"][-1] - top.force[1] / machine
    assert record["crosshead_displacement"][-1] == pytest.approx(crosshead, rel=1e-9)
    assert top.force[1] == pytest.approx(-low.force[1], rel=1e-3)
    energies = require_balance(rig, 1e-6)
    assert energies["friction_energy"] > 1e-4 * energies["boundary_work"]


def test_strips_soften_what_a_disc_lies_on():
    stiffness = []
    for strip in (None, 1e14, 1e11):
        rig = made("flexible")
        between(rig, RADIUS, angle=0.5, friction=0.3, strip=strip)
        stiffness.append(rig.elastic(displacement=1e-9).load / 1e-9)
    assert stiffness[0] > stiffness[1] > 2.0 * stiffness[2]
    assert rig.layout["parts"][0]["strip"] == 1e11


def test_what_is_no_jaw_of_a_disc_is_refused_in_one_line():
    rig = made()
    top = (0.0, RADIUS)
    for call, message in (
        (lambda: rig.jaw(top, 0.9 * RADIUS), "jaw: radius = 0.0135 m, must be >= 0.015 m"),
        (lambda: rig.jaw(top, RADIUS), "jaw: angle = None, must be given if the jaw has"),
        (lambda: rig.jaw(top, np.inf), "jaw: radius = inf"),
        (lambda: rig.jaw(top, 1.0, angle=0.0), "jaw: angle = 0.0 rad, must be > 0"),
        (lambda: rig.jaw(top, 1.0, angle=3.0), "jaw: angle = 3.0 rad, must be <="),
        (lambda: rig.jaw((0.0, 0.5 * RADIUS), 1.0), "jaw: position = (0, 0.0075) m, must be on"),
        (lambda: rig.jaw(top, 1.0, friction=-1.0), "jaw: friction = -1.0, must be >= 0"),
        (lambda: rig.jaw(top, 1.0, strip=0.0), "jaw: strip = 0.0 Pa/m, must be > 0"),
    ):
        with pytest.raises(InputError) as error:
            call()
        assert str(error.value).startswith(message), str(error.value)
        assert "\n" not in str(error.value)
    rig.jaw(top, 1.5 * RADIUS, friction=0.2)
    refusal("jaw: .* lies on plate 0", rig.jaw, top, 1.5 * RADIUS)
    plain = flexpm.PartRig(fresh(flexpm.Specimen.rectangle(0.02, 0.02, 0.01), None, "rigid"))
    refusal("jaw: the specimen is not a disc", plain.jaw, (0.01, 0.02), 0.05)
    side = plain.platen(2)
    refusal("gauge angle: part = platen .* must be a jaw", plain.contact_angle_of, "angle", side)


def test_jaws_in_a_folder_are_made_again_to_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rig = made(out="first", report=False)
    between(rig, 1.5 * RADIUS)
    rig.strain_to(2e-3, rate=4.0)
    rig.finish()
    parts = json.loads((tmp_path / "first" / "result.json").read_text())["inputs"]["parts"]
    assert [part["radius"] for part in parts] == [1.5 * RADIUS] * 2
    yade.O.reset()
    assert cli.main(["rerun", "first", "--out", "second", "--no-report"]) == 0
    for name in ("curve.csv", "final.vtu"):
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "second" / name).read_bytes()


SOLID_DIAMETER, DEPTH, MATERIAL = 0.024, 0.009, "augig-table7"
RIM = 0.5 * SOLID_DIAMETER


@pytest.fixture(scope="module")
def disc():
    return flexpm.Specimen.solid_disc(SOLID_DIAMETER, DEPTH, seed=1)


def rig_of(specimen, model="flexible"):
    return flexpm.SolidPartRig(fresh(specimen, MATERIAL, model))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_disc_splits_between_jaws_with_friction(disc, model):
    rig = rig_of(disc, model)
    low = rig.jaw((0, 0, -RIM), 1.5 * RIM, friction=0.3)
    high = rig.jaw((0, 0, RIM), 1.5 * RIM, friction=0.3)
    assert high.normal == pytest.approx((0.0, 0.0, -1.0))
    assert high.contact_angle == 0.0
    rig.contact_angle_of("contact", high)
    area = 0.5 * math.pi * SOLID_DIAMETER * DEPTH
    rig.drive(high, (0, 0, -1), against=low, area=area, length=SOLID_DIAMETER, strength=15e6)
    rig.load(flexpm.Loading(kind="waiting"))
    record = rig.record
    peak = int(np.argmax(record["load"]))
    assert 0 < peak < len(record) - 1
    assert record["end_mismatch"][:peak].max() < 0.02
    # the disc is a prism, of which whole facets come to lie on the jaw
    facet = 2.0 * math.tan(math.pi / (len(disc.outline().walls) - 2))
    contact = record["contact"][1 : peak + 1] / facet
    assert np.all(np.diff(contact) >= 0.0)
    assert contact[0] == pytest.approx(1.0, rel=1e-3)
    assert high.contact_angle == record["contact"][-1]
    names = ("kinetic", "elastic", "damage", "friction", "damping", "drag")
    stored = sum(record[f"{name}_energy"][-1] for name in names) - rig.initial_energy
    assert stored == pytest.approx(record["boundary_work"][-1], rel=1e-3)
    # the laboratory's own test, whose smooth jaws hold what they touch from rolling
    run = flexpm.run("brazilian", disc, MATERIAL, model, jaw_radius=1.5 * RIM)
    assert record["axial_stress"].max() == pytest.approx(run.peak_stress, rel=0.15)


def test_a_jaw_of_the_discs_own_radius_touches_all_of_its_angle(disc):
    rig = rig_of(disc)
    low = rig.support((0, 0.5 * DEPTH, -RIM), (0.2 * RIM, DEPTH, RIM), normal=(0, 0, 1))
    high = rig.jaw((0.8 * RIM, 0, 0.6 * RIM), RIM, angle=0.6, friction=0.5)
    assert high.normal == pytest.approx((-0.8, 0.0, -0.6))
    rig.drive(high, (-0.8, 0.0, -0.6), against=low)
    # pushed aside over a smooth support, its points neither stay open nor stick
    with pytest.raises(InputError, match="until no plate contact opens or closes"):
        rig.elastic(displacement=1e-6)
    plates = rig.built.solver.plates()
    assert plates[high.number]["radius"] == pytest.approx(RIM, rel=0.02)  # of the prism
    assert [part["face"] != [] for part in rig.parts] == [True, True]
    assert rig.parts[1]["radius"] == plates[high.number]["radius"]
    ends = np.array(rig.parts[1]["face"])[[0, -1]]
    assert np.hypot(*ends.T) == pytest.approx([RIM, RIM], rel=1e-9)
    for _ in range(3):
        yade.O.step()
    assert high.contact_angle == 0.0  # nothing presses yet


def test_a_jaw_that_is_laid_again_is_found(disc, tmp_path):
    rig = rig_of(disc)
    rig.jaw((0, 0, RIM), 1.5 * RIM, angle=0.5)
    yade.O.save(str(tmp_path / "scene.bin"), quiet=True)
    yade.O.load(str(tmp_path / "scene.bin"), quiet=True)
    rig.built.rebind()
    again = flexpm.SolidPartRig(rig.built)
    refusal("the call places another part than the", again.jaw, (0, 0, RIM), 1.6 * RIM, angle=0.5)
    assert again.jaw((0, 0, RIM), 1.5 * RIM, angle=0.5).number == 0


def test_what_no_jaw_is_is_refused(disc):
    rig = rig_of(disc)
    first = rig.jaw((0, 0, RIM), 1.5 * RIM, angle=1.0)
    held = rig.hold(ball=((0.0, 0.5 * DEPTH, 0.0), 0.3 * RIM))
    refused = (
        (lambda: rig.jaw((0, 0.5 * RIM, 0), RIM), "position = .* m, must be on the rim"),
        (lambda: rig.jaw((RIM, 0, 0), 0.5 * RIM), "radius = 0.006 m, must be >= 0.012 m"),
        (lambda: rig.jaw((RIM, 0, 0), RIM), "angle = None, must be given"),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, angle=3.0), "angle = 3.0 rad, must be <="),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, strip=0), "strip = 0.* Pa/m, must be > 0"),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, friction=-1), "friction = -1, must be >= 0"),
        (lambda: rig.jaw((0, 0, RIM), 1.5 * RIM), "before two plates = .*use another position"),
        (
            lambda: rig.support((0, 0.5 * DEPTH, RIM), 0.3 * RIM, normal=(0, 0, -1)),
            "before two plates = .*use another position",
        ),
        (lambda: rig.contact_angle_of("contact", rig.platen(4)), "part = .*, must be a jaw"),
        (lambda: rig.contact_angle_of("contact", held), "must be a support or a platen"),
        (lambda: rig.press(first, 1e6), "area of a plate = 0 m\\^2"),
    )
    for call, told in refused:
        refusal(told, call)
    box = flexpm.Specimen.box(0.012, 0.012, 0.012, seed=1)
    refusal("jaw: the specimen is not a disc", lambda: rig_of(box).jaw((0, 0, 0), 1.0))
