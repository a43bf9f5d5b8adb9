# SPDX-License-Identifier: GPL-3.0-or-later
"""An own test of all stages and parts that is killed goes on to the same bits; it is repeated."""

from __future__ import annotations

import signal

import numpy as np
import pytest
from killed_scripts import content, drawn, ended, killed, require_same, started

import flexpm
from flexpm.cli import main as cli

#: A square with a hole that is let go in parts, on a seat and a strip, in a soft machine.
SCRIPT = """
import flexpm
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)
made = made.with_excavations({"hole": ((0.006, 0.006), 0.002)})

rig = flexpm.PartRig(flexpm.build(made, model="rigid"), out="out", checkpoint_interval=INTERVAL)
floor, top = rig.platen(0, friction=0.5, strip=1e14), rig.platen(2, friction=0.5, seated=True)
sides = [rig.platen(side) for side in (1, 3)]
rig.press({top: 2e6, **dict.fromkeys(sides, 1e6)})
rig.excavate("hole", parts=2)
rig.drive(top, (0.0, -1.0), against=floor, machine=4e8)
rig.angle_of("tilt", top)
rig.stress_to(280.0)
rig.cycle(300.0, 1, low=280.0)
rig.dwell(3.0)
rig.dwell(3.0, by="way")
rig.relax()
rig.unload()
rig.follow([0.0, 1.0, 2.0], [0.0, 200.0, 100.0], by="load")
rig.load(flexpm.Loading(rate=RATE, kind="waiting"))
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of the script that nobody has killed."""
    folder = tmp_path_factory.mktemp("whole")
    assert ended(started(folder, SCRIPT)) == (0, "")
    return folder / "out"


@pytest.mark.long
def test_a_killed_test_of_all_stages_goes_on_to_the_same_bits(whole, tmp_path):
    stages = {one["stage"]: one["last_step"] for one in content(whole)["inputs"]["stages"]}
    kills = [signal.SIGKILL, signal.SIGTERM]
    moments = [drawn(3, kills, stages["excavate"]), drawn(4, kills, content(whole)["steps"])]
    for number, ends in enumerate(killed(tmp_path, SCRIPT, moments)):
        assert ends == [*kills, 0]
        require_same(tmp_path / str(number), whole)


@pytest.mark.long
def test_it_is_made_again_to_the_same_bits(whole, tmp_path):
    assert content(whole)["inputs"]["repeatable"]
    again = tmp_path / "again"
    assert cli.main(["rerun", str(whole), "--out", str(again), "--no-report"]) == 0
    require_same(again, whole)


@pytest.mark.long
def test_other_threads_give_the_same_bits(whole, tmp_path):
    assert SCRIPT.count('model="rigid"') == 1
    script = SCRIPT.replace('model="rigid"', 'model="rigid", threads=2')
    assert ended(started(tmp_path, script)) == (0, "")
    require_same(tmp_path / "out", whole)


@pytest.mark.slow
def test_kills_over_all_stages_and_parts(whole, tmp_path):
    """A hundred."""
    last, kinds = content(whole)["steps"], [signal.SIGTERM, *[signal.SIGKILL] * 3]
    moments = [drawn(seed, kinds, last) for seed in range(25)]
    for number, ends in enumerate(killed(tmp_path, SCRIPT, moments)):
        assert ends[-1] == 0, ends
        require_same(tmp_path / str(number), whole)


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
