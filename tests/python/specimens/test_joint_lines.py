# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints: their files, what lies outside, maps of outcrops, the command."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from cut_specimens import DIP, HEIGHT, LAW, WIDTH, require_lengths, require_pieces
from refusals import refusal
from work import growth_of

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.joints import lines as joint_lines
from flexpm.materials.material import load
from flexpm.results import doubts
from flexpm.specimens.specimen import Specimen


@pytest.fixture(scope="module")
def rectangle():
    return Specimen.rectangle(WIDTH, HEIGHT, 0.08)


def test_a_file_of_joints(tmp_path):
    file = tmp_path / "joints.csv"
    file.write_text("x1,y1,x2,y2,name\n0,0.01,0.01,0.02,a\n0.01,0.02,0.02,0.02,a\n0,0,1,1,b\n")
    assert joint_lines.read(file) == {
        "a": [[(0.0, 0.01), (0.01, 0.02), (0.02, 0.02)]],
        "b": [[(0.0, 0.0), (1.0, 1.0)]],
    }


def test_a_file_of_a_spreadsheet(tmp_path):
    """A byte-order mark, blanks, columns and rows of empty cells, Windows' ends of lines."""
    file = tmp_path / "joints.csv"
    text = "name ,x1, y1,x2,y2,\na,0,0.01 ,0.01,0.02\n , ,,,,\na,0.01,0.02,0.02,0.02,,\n,,,,,\n\n"
    file.write_text("\ufeff" + text, newline="\r\n")
    assert joint_lines.read(file) == {"a": [[(0.0, 0.01), (0.01, 0.02), (0.02, 0.02)]]}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x1,y1,x2,y2\n0,0,1,1\n", "columns x1,y1,x2,y2,name"),
        ("", "columns x1,y1,x2,y2,name"),
        ("x1,y1,x2,y2,name\n0,0,x,1,a\n", "line 2, joint 'a': x2 = 'x' m, must be a number"),
        (
            "x1,y1,x2,y2,name\n0,0,1,1,a\n0,0,0,0,a\n",
            "line 3, joint 'a': x2, y2 = .* must not be the start",
        ),
        ("x1,y1,x2,y2,name\n0,0,1,1,\n", "must be a name"),
        ("x1,y1,x2,y2,name\n0,0,1\n", "line 2, joint '': "),
        (
            "x1,y1,x2,y2,name\n0,0,1,1,a\n0,0,1,1,a,0.02,b\n",
            "line 3, joint 'a': cells = 7, must be 5",
        ),
        ("x1,y1,x2,y2,x1,name\n0,0,1,1,5,a\n", "must have rows and the columns .*, each once"),
        ('x1,y1,x2,y2,name\n0,0,1,1,"a\tb"\n', r"line 2, joint .*: name = .*, must be a name"),
        ('x1,y1,x2,y2,name\n0,0,1,1,"a\nb"\n', r"joint .*: name = .*, must be a name"),
        (
            "x1,y1,x2,y2,name\n0,0,1,1,excavation:fault\n",
            "line 2, joint 'excavation:fault': name = .*, must not begin with excavation:",
        ),
        ("x1,y1,x2,y2,name\n0,0,nan,1,a\n", "line 2, joint 'a': x2 = 'nan' m, must be a number"),
    ],
)
def test_files_that_hold_no_joints(tmp_path, text, message):
    file = tmp_path / "joints.csv"
    file.write_text(text)
    refusal(message, joint_lines.read, file)


def test_the_command_cuts_a_specimen(tmp_path, capsys, rectangle):
    file = tmp_path / "joints.csv"
    file.write_text("x1,y1,x2,y2,name\n0,0.01,0.02,0.03,weak\n")
    sizes = ["--width", str(WIDTH), "--height", str(HEIGHT), "--quiet"]
    settings_ = [word for one in LAW.split() for word in ("--set", one)]
    out = tmp_path / "out"
    call = ["elastic", *sizes, *settings_, "--joints", str(file), "--out", str(out)]
    assert cli.main(call) == 0
    found = json.loads((out / "result.json").read_text())
    cut = rectangle.with_joints({"weak": DIP})
    expected = flexpm.elastic(cut, load().with_set(LAW.split()))
    assert found["youngs_modulus"] == expected["youngs_modulus"]
    assert found["inputs"]["specimen"]["joints"] == cut.spec.joints
    assert cli.main(["rerun", str(out), "--quiet", "--out", str(tmp_path / "again")]) == 0
    assert "the same as in" in capsys.readouterr().out
    assert cli.main(["run", "uniaxial", *sizes, "--joints", str(file)]) == 2
    assert "joint = 'weak', has no law" in capsys.readouterr().err
    several = ["run", "uniaxial", *sizes, *settings_, "--joints", str(file), "--seeds", "1-2"]
    short = ["--max-strain", "1e-5", "--rate", "16", "--no-report"]
    assert cli.main([*several, *short, "--out", str(tmp_path / "several")]) == 3  # no peak
    for seed in (1, 2):
        result = tmp_path / "several" / f"seed-{seed}" / "result.json"
        assert json.loads(result.read_text())["inputs"]["specimen"]["joints"] == cut.spec.joints
    drawn = ["specimen", "rectangle", *sizes, "--joints", str(file), "--out", str(out)]
    assert cli.main(drawn) == 0


def test_a_point_that_is_there_twice_counts_once(tmp_path, rectangle):
    file = tmp_path / "joints.csv"
    rows = "0,0.01,0.01,0.02,a\n0.01,0.02,0.01,0.02,a\n0.01,0.02,0.02,0.03,a\n"
    file.write_text(f"x1,y1,x2,y2,name\n{rows}")
    assert joint_lines.read(file) == {"a": [[(0.0, 0.01), (0.01, 0.02), (0.02, 0.03)]]}
    cut = rectangle.with_joints({"a": [(0.0, 0.01), (0.01, 0.02), (0.01, 0.02), (0.02, 0.03)]})
    np.testing.assert_array_equal(
        cut.edge_joints, rectangle.with_joints(joint_lines.read(file)).edge_joints
    )


def test_a_file_of_joints_is_read_no_further_than_its_limit():
    refusal("is larger than 64 MB", joint_lines.read, Path("/dev/zero"))


@pytest.fixture(scope="module")
def block():
    return Specimen.rectangle(0.02, 0.04, 0.01)


def test_lines_that_start_beside_a_side(block):
    """A hair inside, on the side and outside: one answer for all, and the good line is cut."""
    good = [(0.0, 0.0271), (0.02, 0.0271)]
    for start in (0.00012, 0.0, -0.0001, 1e-9):
        lines = [good, [(start, 0.0263), (-0.005, 0.0289)]]
        found = block.with_joints({"a": lines}).joint_cuts["a"]
        assert (found.lines, found.idle) == (2, 1)
        assert found.outside == pytest.approx(
            math.dist(*lines[1]) * (1.0 - max(start, 0.0) / (start + 0.005)), rel=1e-3
        )
        refusal("lines that cut a cell = 0 of 1", block.with_joints, {"a": lines[1]})
    rng = np.random.default_rng(1)
    for inside, y, up in rng.uniform((1e-5, 0.001, -0.005), (0.003, 0.039, 0.005), (200, 3)):
        leaving = [(inside, y), (-0.005, y + up)]
        cut = block.with_joints({"a": [good, leaving]})
        require_lengths(cut)


def test_lines_outside_are_left_out(block):
    """A map laid over a specimen: what lies in it is cut as if the rest were not there."""
    inside = [[(0.0, 0.01), (0.02, 0.02)], [(0.01, 0.03), (0.03, 0.035)]]
    outside = [[(0.03 + 0.01 * k, -0.01), (0.2, 0.5)] for k in range(20)]
    cut = block.with_joints({"out": outside, "a": [*outside, *inside, *outside]})
    alone = block.with_joints({"a": inside})
    np.testing.assert_array_equal(cut.tessellation.vertices, alone.tessellation.vertices)
    found = cut.joint_cuts
    assert found["a"].idle == 40
    assert (found["out"].idle, found["out"].cut) == (20, 0.0)
    assert found["out"].outside == pytest.approx(found["out"].length, rel=1e-12)
    assert found["out"].reason == "lies outside the specimen"
    assert found["a"].cut == alone.joint_cuts["a"].cut
    require_lengths(cut)


def test_lines_that_cut_nothing_are_told(block, tmp_path):
    short = [[(0.004 * i + 0.001, 0.03), (0.004 * i + 0.0018, 0.0303)] for i in range(5)]
    cut = block.with_joints({"a": [[(0.0, 0.01), (0.02, 0.02)], *short]})
    found = cut.joint_cuts["a"]
    assert (found.lines, found.idle) == (6, 5)
    assert found.length == pytest.approx(26.6e-3, rel=1e-2)
    assert found.missing == pytest.approx(4.3e-3, rel=1e-2)
    assert cut.statistics()["joints"]["a"]["idle"] == 5
    told = doubts.of_cuts({"a": found.to_json()})
    assert len(told) == 1
    assert re.fullmatch(
        "joint a: 5 of 6 lines cut nothing, 4.3[0-9]* of 26.6 mm in the specimen; .*within grains",
        told[0],
    )
    alone = block.with_joints({"a": [(0.0, 0.01), (0.02, 0.02)]})
    assert doubts.of_cuts(alone.statistics()["joints"]) == []
    cut.save(tmp_path / "cut.json")
    assert Specimen.load(tmp_path / "cut.json").joint_cuts == cut.joint_cuts
    material = load().with_set([one.replace("weak", "a") for one in LAW.split()])
    result = flexpm.run("uniaxial", cut, material, "rigid", rate=20.0, max_strain=1e-5)
    assert result.joint_cuts == {"a": found.to_json()}
    assert told[0] in result.warnings


def test_a_line_under_two_names(block):
    line = [(0.0, 0.01), (0.02, 0.02)]
    cut = block.with_joints({"a": line, "b": line})
    found = cut.joint_cuts["b"]
    assert (found.idle, found.on) == (1, "a")
    assert found.taken == pytest.approx(found.length, rel=1e-9)
    assert found.reason == "lies on joint a, which was cut first"
    assert [len(contacts) > 0 for contacts in cut.joint_lines()] == [True, False]
    # its law may be given and is not used
    laws = [one.replace("weak", name) for name in "ab" for one in LAW.split()]
    flexpm.build(cut, load().with_set(laws)).run(3)
    with pytest.raises(InputError, match=r"joint b lies on joint a, which was cut first"):
        block.with_joints({"a": line}).with_joints({"b": line})


def outcrop_map(seed, count, width, height):
    """Traces in the manner of a digitised outcrop: in sets, stacked, bundled, ending at others.

    The window is larger than the specimen; some traces have their last point twice.
    """
    rng = np.random.default_rng(seed)
    sets = rng.uniform(0.0, math.pi, 3)
    lines = []
    for _ in range(count):
        middle = rng.uniform((-0.2, -0.2), (1.2, 1.2)) * (width, height)
        angle = rng.choice(sets) + rng.normal(0.0, 0.1)
        steps = rng.integers(1, 6)
        length = min(rng.lognormal(math.log(0.004), 0.8), 0.03) / steps
        trace = [middle]
        for _ in range(steps):
            angle += rng.normal(0.0, 0.15)
            trace.append(trace[-1] + length * np.array((math.cos(angle), math.sin(angle))))
        kind = rng.integers(0, 8) if lines else 7
        other = np.array(lines[rng.integers(len(lines))]) if lines else None
        if kind == 0:  # stacked: the same trace again
            trace = list(other)
        elif kind == 1:  # closer than a tenth of a grain, the other way round
            trace = list(other[::-1] + rng.uniform(-2e-4, 2e-4, 2))
        elif kind == 2:  # V-node
            trace[0] = other[0]
        elif kind == 3:  # ends at another
            share = rng.uniform()
            trace[-1] = share * other[0] + (1.0 - share) * other[1]
        elif kind == 4:
            trace.append(trace[-1])
        points = [tuple(map(float, point)) for point in trace]
        if any(point != points[0] for point in points):
            lines.append(points)
    names = rng.integers(0, 4, len(lines))
    return {
        f"set{k}": [line for line, name in zip(lines, names, strict=True) if name == k]
        for k in set(names.tolist())
    }


#: Maps as seed and number of traces: three by day, by night 200 of 100 to 3000 traces.
_MAPS = [
    (0, 100),
    (1, 300),
    (2, 1000),
    *(
        pytest.param(seed, round(100 * 30 ** ((seed - 3) / 196)), marks=pytest.mark.slow)
        for seed in range(3, 200)
    ),
]


@pytest.mark.parametrize(("seed", "count"), _MAPS)
def test_maps_of_outcrops_are_cut(seed, count):
    uncut = Specimen.rectangle(WIDTH, HEIGHT, 0.08, seed=seed + 1)
    told = []
    cut = uncut.with_joints(
        outcrop_map(seed, count, WIDTH, HEIGHT), lambda *given: told.append(given)
    )
    require_pieces(cut, uncut)
    require_lengths(cut)
    assert told[-1][0] == told[-1][1] == sum(map(len, cut.joints.values()))


def test_four_times_as_many_segments_are_hardly_more_than_four_times_the_work():
    """A line costs what lies near it."""
    rng = np.random.default_rng(1)
    ends = rng.uniform((0.0, 0.0), (0.012, 0.024), (2000, 2, 2))
    uncut = Specimen.rectangle(0.012, 0.024, 0.01)
    growth = growth_of(lambda count: uncut.with_joints({"a": list(ends[:count])}), 500, 2000)
    assert growth < 4.0**1.2
