# SPDX-License-Identifier: GPL-3.0-or-later
"""Curved jaws of own tests of discs of space."""

from __future__ import annotations

import importlib
import math

import numpy as np
import pytest

import flexpm
from flexpm.errors import InputError

# importing flexpm has told Python where YADE is
yade = importlib.import_module("yade")
DIAMETER, DEPTH, MATERIAL = 0.024, 0.009, "augig-table7"
RIM = 0.5 * DIAMETER


@pytest.fixture(scope="module")
def disc():
    return flexpm.Specimen.solid_disc(DIAMETER, DEPTH, seed=1)


def rig_of(specimen, model="flexible"):
    yade.O.reset()
    return flexpm.SolidPartRig(flexpm.build(specimen, MATERIAL, model))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_disc_splits_between_jaws_with_friction(disc, model):
    rig = rig_of(disc, model)
    low = rig.jaw((0, 0, -RIM), 1.5 * RIM, friction=0.3)
    high = rig.jaw((0, 0, RIM), 1.5 * RIM, friction=0.3)
    assert high.normal == pytest.approx((0.0, 0.0, -1.0))
    assert high.contact_angle == 0.0
    rig.contact_of("contact", high)
    area = 0.5 * math.pi * DIAMETER * DEPTH
    rig.drive(high, (0, 0, -1), against=low, area=area, length=DIAMETER, strength=15e6)
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
    found = rig.elastic(way=1e-6)
    assert np.dot(found.force(high), high.normal) > 0.0
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
    with pytest.raises(InputError, match="must be one of them"):
        again.jaw((0, 0, RIM), 1.6 * RIM, angle=0.5)
    assert again.jaw((0, 0, RIM), 1.5 * RIM, angle=0.5).number == 0


def test_what_no_jaw_is_is_refused(disc):
    rig = rig_of(disc)
    first = rig.jaw((0, 0, RIM), 1.5 * RIM, angle=1.0)
    held = rig.hold(ball=((0.0, 0.5 * DEPTH, 0.0), 0.3 * RIM))
    refused = (
        (lambda: rig.jaw((0, 0.5 * RIM, 0), RIM), "place = .* m, must be on the rim"),
        (lambda: rig.jaw((RIM, 0, 0), 0.5 * RIM), "radius = 0.006 m, must be >= 0.012 m"),
        (lambda: rig.jaw((RIM, 0, 0), RIM), "angle = None, must be given"),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, angle=3.0), "angle = 3.0 rad, must be <="),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, strip=0), "strip = 0.* Pa/m, must be > 0"),
        (lambda: rig.jaw((RIM, 0, 0), 2 * RIM, friction=-1), "friction = -1, must be >= 0"),
        (lambda: rig.jaw((0, 0, RIM), 1.5 * RIM), "before two plates = .*take another place"),
        (
            lambda: rig.support((0, 0.5 * DEPTH, RIM), 0.3 * RIM, normal=(0, 0, -1)),
            "before two plates = .*take another place",
        ),
        (lambda: rig.contact_of("contact", rig.platen(4)), "part = .*, must be a jaw"),
        (lambda: rig.contact_of("contact", held), "must be a support or a platen"),
        (lambda: rig.press(first, 1e6), "area of a plate = 0 m\\^2"),
    )
    for call, told in refused:
        with pytest.raises(InputError, match=told):
            call()
    box = flexpm.Specimen.box(0.012, 0.012, 0.012, seed=1)
    with pytest.raises(InputError, match="jaw: specimen = no disc, must be one"):
        rig_of(box).jaw((0, 0, 0), 1.0)
