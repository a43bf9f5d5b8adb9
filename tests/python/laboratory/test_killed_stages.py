# SPDX-License-Identifier: GPL-3.0-or-later
"""Own tests of all stages and parts that are killed go on to the same bits; they are repeated."""

from __future__ import annotations

import functools
import json
import signal

import numpy as np
import pytest
from killed_scripts import content, drawn, ended, killed, require_same, started

import flexpm
from flexpm.cli import main as cli

#: A square with a hole that is let go in parts, on a seat and a strip, in a soft machine.
PLANE = """
import flexpm
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)
made = made.with_excavations({"hole": ((0.006, 0.006), 0.002)})

rig = flexpm.PartRig(flexpm.build(made, model="rigid"), out="out", checkpoint_interval=INTERVAL)
floor, top = rig.platen(0, friction=0.5, strip=1e14), rig.platen(2, friction=0.5, seated=True)
sides = [rig.platen(side) for side in (1, 3)]
rig.press({top: 2e6, **dict.fromkeys(sides, 1e6)})
rig.excavate("hole", parts=2)
rig.drive(top, (0.0, -1.0), against=floor, machine=4e8)
rig.rotation_of("tilt", top)
rig.stress_to(280.0)
rig.cycle(300.0, 1, low=280.0)
rig.dwell(3.0)
rig.dwell(3.0, by="displacement")
rig.relax()
rig.unload()
rig.follow([0.0, 1.0, 2.0], [0.0, 200.0, 100.0], by="load")
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""
#: All stages that a solid has, in a folder.
SOLID = """
import flexpm
box = flexpm.Specimen.box(0.009, 0.009, 0.009, seed=1)

rig = flexpm.SolidPartRig(flexpm.build(box, model="rigid"), out="out", checkpoint_interval=INTERVAL)
floor, top = rig.platen(0, friction=0.5), rig.platen(2, friction=0.5, seated=True)
left, right = rig.platen(3), rig.platen(1)
pin = rig.hold(ball=((0.0045, 0.0045, 0.0045), 0.002), axes="y")
rig.press({left: 1e6, right: 1e6, top: 2e6})
rig.gauge("wide", (0.0, 0.0045, 0.0045), (0.009, 0.0045, 0.0045))
rig.rotation_of("tilt", top)
rig.drive(top, (0.0, 0.0, -1.0), against=floor)
rig.stress_to(350.0)
rig.cycle(400.0, 1, low=350.0)
rig.dwell(3.0)
rig.relax()
rig.unload()
rig.follow([0.0, 1.0, 2.0], [0.0, 200.0, 100.0], by="load")
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""
#: Held nodes that turn, and turn back, in a folder.
TWIST = """
import flexpm
box = flexpm.Specimen.box(0.012, 0.012, 0.016, seed=1)

rig = flexpm.SolidPartRig(flexpm.build(box, model="rigid"), out="out", checkpoint_interval=INTERVAL)
low = rig.hold(box=((0, 0, 0), (0.012, 0.012, 0.004)))
high = rig.hold(box=((0, 0, 0.012), (0.012, 0.012, 0.016)))
rig.rotate(high, about=(0.006, 0.006, 0.0), strength=10.0)
rig.strain_to(5e-4)
rig.cycle(2.0, 1, low=0.0)
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""
#: A core under a fluid on its mantle, then in a soft machine, in a folder.
FLUID = """
import flexpm
core = flexpm.Specimen.cylinder(0.012, 0.018, seed=1)

built = flexpm.build(core, model="rigid")
rig = flexpm.SolidPartRig(built, out="out", checkpoint_interval=INTERVAL)
base, top = rig.platen(0), rig.platen(2)
rig.press(top, 2e6)
rig.fluid(2e6, side=1)
rig.drive(top, (0, 0, -1), against=base, area=top.area, length=0.018, machine=1e8)
rig.stress_to(6e6)
rig.relax()
rig.fluid(3e6, side=1)
rig.load(flexpm.Loading(rate=RATE, kind="waiting", max_strain=2e-3))
"""
SCRIPTS = {"plane": PLANE, "solid": SOLID, "twist": TWIST, "fluid": FLUID}
KILLS = [signal.SIGKILL, signal.SIGTERM]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of a script that nobody has killed, by its name."""

    @functools.cache
    def made(name):
        folder = tmp_path_factory.mktemp(name)
        assert ended(started(folder, SCRIPTS[name])) == (0, "")
        return folder / "out"

    return made


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "early"),
    [
        ("plane", 1),
        ("solid", 0),
        ("fluid", None),
        pytest.param("twist", None, marks=pytest.mark.slow),
    ],
)
def test_a_killed_test_of_all_stages_goes_on_to_the_same_bits(whole, tmp_path, name, early):
    found = content(whole(name))
    stages = found["inputs"]["stages"]
    names = [one["stage"] for one in stages]
    assert names.count("fluid") == (2 if name == "fluid" else 0)
    assert name != "twist" or found["inputs"]["drive"]["turns"]
    moments = [] if early is None else [drawn(3, KILLS, stages[early]["last_step"])]
    moments.append(drawn(4, KILLS, found["steps"]))
    for number, ends in enumerate(killed(tmp_path, SCRIPTS[name], moments)):
        assert ends == [*KILLS, 0]
        require_same(tmp_path / str(number), whole(name))


@pytest.mark.long
@pytest.mark.parametrize("name", ["plane", "solid"])
def test_it_is_made_again_to_the_same_bits(whole, tmp_path, name):
    inputs = content(whole(name))["inputs"]
    assert inputs["repeatable"]
    if name == "solid":
        assert [part["part"] for part in inputs["parts"]] == [*["plate"] * 4, "held nodes"]
        assert content(whole(name))["peak_load"] is None  # its load still rises
        page = (whole(name) / "report.html").read_text()
        assert "Parts" in page
        assert "moment" not in page  # z is a direction, no turn
    again = tmp_path / "again"
    assert cli.main(["rerun", str(whole(name)), "--out", str(again), "--no-report"]) == 0
    require_same(again, whole(name))
    assert json.loads((again / "result.json").read_text())["inputs"]["calls"] == inputs["calls"]


@pytest.mark.long
def test_other_threads_give_the_same_bits(whole, tmp_path):
    assert PLANE.count('model="rigid"') == 1
    script = PLANE.replace('model="rigid"', 'model="rigid", threads=2')
    assert ended(started(tmp_path, script)) == (0, "")
    require_same(tmp_path / "out", whole("plane"))


@pytest.mark.slow
def test_kills_over_all_stages_and_parts(whole, tmp_path):
    """A hundred."""
    last, kinds = content(whole("plane"))["steps"], [signal.SIGTERM, *[signal.SIGKILL] * 3]
    moments = [drawn(seed, kinds, last) for seed in range(25)]
    for number, ends in enumerate(killed(tmp_path, PLANE, moments)):
        assert ends[-1] == 0, ends
        require_same(tmp_path / str(number), whole("plane"))


#: With real masses the velocity of the ends is still rising at both kills.
RISING = """
import flexpm
made = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)

built = flexpm.build(made, model="rigid", dynamic=True)
rig = flexpm.rig(built, out="out", checkpoint_interval=INTERVAL)
rig.load(flexpm.Loading(max_strain=1e-3))
"""


@pytest.mark.long
def test_a_killed_test_with_real_masses_has_the_same_slow_start(tmp_path):
    (tmp_path / "whole").mkdir()
    assert ended(started(tmp_path / "whole", RISING)) == (0, "")
    whole = tmp_path / "whole" / "out"
    curve = flexpm.Result.read(whole).curve
    rows = [np.argmax(curve["velocity_factor"] > part) for part in (0.05, 0.5)]
    moments = [(signal.SIGTERM, int(curve["step"][row])) for row in rows]
    (ends,) = killed(tmp_path, RISING, [moments])
    assert ends == [signal.SIGTERM, signal.SIGTERM, 0]
    require_same(tmp_path / "0", whole)
