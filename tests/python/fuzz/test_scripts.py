# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls from Python in any order: no crash, one line for each refusal, what a model foretells."""

from __future__ import annotations

import re
from pathlib import Path

import fuzz_script
import pytest
from fuzz_child import Child, drawing
from fuzz_script import NUMBERS, QUERIES
from hypothesis import example, given
from hypothesis import strategies as st

import flexpm
from flexpm.renamed import ATTRIBUTES

#: Exceptions of Python for an argument of another type, which have several lines.
FOREIGN = re.compile(r"(ArgumentError|TypeError|OverflowError): ")
#: Exceptions that no refusal is.
INTERNAL = ("SystemError", "AssertionError", "ZeroDivisionError", "KeyError", "IndexError")
NUMBER = st.integers(0, 60)
ANY = st.sampled_from([0.0, -1.0, 0.5, 5.0, 1e300, float("inf"), float("nan")])
#: On the outline, within, and nowhere [m].
PLACE = st.sampled_from([0.0, 0.006, 0.012, 0.016, -1.0, 1e300, float("nan")])
LAWS = (
    {"open": True},
    {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5},
    {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5, "cohesion": 1e6}
    | {"tensile_strength": 5e5, "dilation_angle": 8.0, "dilation_slip": 1e-4},
)
CUT = st.tuples(
    st.just("build_cut"),
    st.sampled_from(["flexible", "rigid"]),
    st.sampled_from([1, 2]),
    st.sampled_from([0.0, 0.3, 1.0]),
    st.sampled_from(LAWS),
)
#: A circle within, and lines that cross the outline or themselves.
CAVES = (
    ((0.006, 0.008), 0.003),
    [(0.003, 0.004), (0.009, 0.004), (0.009, 0.01), (0.003, 0.01)],
    [(0.003, 0.004), (0.009, 0.01), (0.009, 0.004), (0.003, 0.01)],
    ((0.006, 0.008), 0.02),
)
CAVE = st.tuples(
    st.just("build_cave"),
    st.sampled_from(["flexible", "rigid"]),
    st.sampled_from([1, 2]),
    st.sampled_from(CAVES),
)
SOLID = st.tuples(
    st.just("build_solid"), st.sampled_from(["flexible", "rigid"]), st.sampled_from([1, 2])
)
#: Parts by number, doubles, those of other rigs (from 100 on), and what is no part.
PICK = st.sampled_from([0, 1, 2, 3, 100, 101, None, 0.5, "part", True])
PICKS = st.lists(PICK, max_size=3)
COLUMN = st.sampled_from(["opening", "load", "axial_stress", "set_point", "", "a\nb", "opennig", 5])
#: A few numbers, good and bad, of loads, ways, pressures and times.
VALUE = st.sampled_from([0.0, 10.0, 1e-7, -1.0, 1e300, float("nan"), None, "a"])
CROSSINGS = st.sampled_from([1.0, 3, 0.0, -1.0, float("inf"), None])
BY = st.sampled_from(["load", "displacement", "force", 1])
STAGES = st.one_of(
    st.tuples(
        st.just("stage"),
        st.sampled_from(["settle", "relax", "unload"]),
        st.just([]),
        st.fixed_dictionaries({"transits": CROSSINGS}),
    ),
    st.tuples(
        st.just("stage"),
        st.just("dwell"),
        st.tuples(CROSSINGS),
        st.fixed_dictionaries({"by": BY}),
    ),
    st.tuples(
        st.just("stage"),
        st.just("cycle"),
        st.tuples(VALUE, st.sampled_from([1, 2, 0, 1.5, None])),
        st.fixed_dictionaries({"by": BY, "low": VALUE}),
    ),
    st.tuples(
        st.just("stage"),
        st.just("follow"),
        st.tuples(st.lists(VALUE, max_size=3), st.none() | st.lists(VALUE, max_size=3)),
        st.fixed_dictionaries({"by": BY}),
    ),
    st.tuples(
        st.just("stage"),
        st.just("excavate"),
        st.tuples(st.sampled_from(["cave", "cave", "other", "", None, 5])),
        st.sampled_from([{}, {}, {"parts": 2}, {"parts": 0}, {"parts": "all"}]),
    ),
    st.tuples(
        st.just("stage"),
        st.just("fluid"),
        st.tuples(VALUE),
        st.fixed_dictionaries(
            {"side": st.sampled_from([None, 1, [0, 2], 9, "a"]), "hole": st.sampled_from([None, 0])}
        ),
    ),
)
#: Strains and stresses that are soon there, and such as are none.
NEAR = st.sampled_from([1e-8, -1e-8, 0.0, float("nan"), None, "a"])
FAR = st.sampled_from([1e3, -1e3, 0.0, float("nan"), None, "a"])
RATE = st.sampled_from([100.0, 0.0, -1.0, float("nan"), "a"])
GOING = st.tuples(st.just("strain_to"), st.tuples(NEAR, st.just(100.0) | RATE)) | st.tuples(
    st.just("stress_to"), st.tuples(FAR, st.just(100.0) | RATE)
)
#: A loading up to a small strain.
LOADING = st.fixed_dictionaries(
    {
        "rate": st.just(100.0),
        "max_strain": st.sampled_from([1e-8, 1e-8, 0.0, float("nan")]),
        "kind": st.sampled_from(["constant", "adaptive", "waiting", "fast"]),
        "static": st.sampled_from([False, False, True, 1]),
        "control": st.sampled_from(["", "", "load", "lateral_strain", "opening", 5]),
    }
)
#: Calls of the rig between two ends.
ENDS = st.one_of(
    st.builds(lambda going: ("end", *going, {}), GOING),
    st.tuples(
        st.just("end"),
        st.just("confine"),
        st.tuples(st.sampled_from([1e5, 0.0, -1.0, float("nan"), None, "a"])),
        st.sampled_from([{}, {}, {"second": 2e5}, {"second": None}, {"second": -1.0}]),
    ),
    st.tuples(st.just("end"), st.just("roughen"), st.tuples(st.just(0.3) | ANY), st.just({})),
    st.tuples(
        st.just("end"),
        st.just("elastic"),
        st.tuples(st.none() | VALUE),
        st.fixed_dictionaries({"displacement": st.sampled_from([0.0, 1e-7]) | ANY, "load": VALUE}),
    ),
    st.tuples(st.just("end"), st.just("finish"), st.just(()), st.just({})),
    st.tuples(st.just("fail"), st.just(True), LOADING),
)
PARTS = st.one_of(
    ENDS,
    st.builds(lambda going: ("stage", *going, {}), GOING),
    st.tuples(st.just("fail"), st.just(False), LOADING),
    st.tuples(st.just("leave"), st.sampled_from(["left", "", "a\nb", "scene.bin"])),
    st.tuples(st.just("part"), st.lists(PICK, min_size=1, max_size=1)),
    st.tuples(st.just("support"), PLACE, PLACE, st.sampled_from([0.001, 0.0, 1.0]), st.booleans()),
    st.tuples(st.just("roller"), PLACE, PLACE, st.booleans()),
    st.tuples(st.just("platen"), st.sampled_from([0, 1, 2, 3, 4, 9, -1]), st.booleans()),
    st.tuples(
        st.just("hold"),
        *(PLACE, PLACE, st.sampled_from([0.002, 1.0, 0.0, -1.0])),
        st.sampled_from(["x", "y", "xy", "z"]),
    ),
    st.tuples(st.just("layer"), st.sampled_from([0, 2]), ANY),
    st.tuples(st.just("seat"), st.sampled_from([0, 2]), COLUMN),
    st.tuples(st.just("ends"), st.none() | VALUE, st.sampled_from([0.0, 1e-7]) | ANY, VALUE),
    st.tuples(st.just("jaw"), PLACE, PLACE, ANY, st.none() | ANY, COLUMN),
    st.tuples(st.just("soft"), st.tuples(ANY, ANY), PICKS, st.sampled_from([1e7, 1e12]) | ANY),
    st.tuples(st.just("soft"), st.just((0.0, -1.0)), st.just([0]), st.just(1e7)),
    st.tuples(st.just("drive"), st.tuples(ANY, ANY), PICKS, PICKS),
    st.tuples(st.just("drive"), st.just((0.0, -1.0)), st.just([0]), st.just([1])),
    st.tuples(st.just("turn"), st.none() | st.tuples(PLACE, PLACE), PICKS, PICKS),
    st.tuples(
        st.just("press"),
        st.lists(PICK, min_size=1, max_size=1),
        st.sampled_from([0.0, 1e5, -1.0, float("nan"), None]),
    ),
    st.tuples(
        st.just("press_all"),
        PICKS,
        st.lists(st.sampled_from([0.0, 1e5, -1.0, float("nan"), None]), max_size=3),
    ),
    STAGES,
    st.tuples(
        st.just("elastic"),
        st.lists(PICK, min_size=1, max_size=1),
        st.sampled_from([0.0, 1e5, -1.0, float("nan"), None]),
        st.sampled_from([0.0, 1e-6, 1.0]) | ANY,
        st.none() | ANY,
    ),
    st.tuples(st.just("move"), st.just([0]), ANY, ANY),
    st.tuples(st.just("again")),
    st.tuples(st.just("names"), COLUMN, COLUMN, st.lists(PICK, min_size=1, max_size=1)),
    st.tuples(st.just("read"), COLUMN),
    st.tuples(st.just("start"), st.sampled_from([1e-3, 1.0, 100.0, 0.0, float("inf")])),
    st.tuples(st.just("finish")),
    st.tuples(st.just("gauge"), COLUMN, PLACE, PLACE),
    st.tuples(st.just("set_nodes"), st.sampled_from([-1, 0, 5, 10**9]), st.sampled_from([0, 1, 9])),
    st.tuples(st.just("turn_set"), st.sampled_from([-1, 0, 1, 10**9]), ANY),
    st.tuples(st.just("move_set"), st.sampled_from([-1, 0, 1, 10**9]), ANY),
)
CALLS = st.one_of(
    CUT,
    CAVE,
    SOLID,
    PARTS,
    PARTS,
    st.tuples(
        st.just("build"),
        st.sampled_from(["flexible", "rigid", "inner"]),
        st.sampled_from([1, 2]),
        st.sampled_from([1, 2, 3]),
        st.sampled_from(["fan", "refined"]),
    ),
    st.tuples(st.just("step"), st.sampled_from([1, 3, 120])),
    st.tuples(st.sampled_from(["reset", "save", "load"])),
    st.tuples(st.sampled_from(["erase_bond", "erase_body", "view"]), NUMBER),
    st.tuples(st.just("touch"), st.sampled_from([0, 1, 2, 3, 9, -1])),
    st.tuples(st.sampled_from(["plate", "wall"]), ANY, ANY),
    st.tuples(st.just("ask"), st.sampled_from(QUERIES)),
    st.tuples(st.just("write"), ANY),
    st.tuples(st.just("set"), st.sampled_from(NUMBERS), ANY),
    st.tuples(st.just("dead"), st.booleans()),
    st.tuples(st.just("time_step"), ANY),
    st.tuples(
        st.just("engines"),
        st.sampled_from(["none", "solver", "twice", "reversed", "recorder", "bare"]),
    ),
    st.tuples(st.sampled_from(["bare", "clear"])),
)
#: Calls that a plain model foretells; others may move, stop or take apart anything.
PLAIN = st.one_of(
    st.tuples(st.just("step"), st.sampled_from([1, 7, 120])),
    st.tuples(st.sampled_from(["save", "load"])),
    st.tuples(st.just("ask"), st.sampled_from(QUERIES[:7])),
    st.tuples(st.just("view"), NUMBER),
    st.tuples(st.sampled_from(["erase_bond", "erase_body"]), NUMBER),
    st.tuples(st.just("touch"), st.integers(0, 3)),
    st.tuples(st.sampled_from(["reset"])),
)
BUILD = st.tuples(
    st.just("build"),
    st.sampled_from(["flexible", "rigid"]),
    st.sampled_from([1, 2]),
    st.just(3),
    st.just("refined"),
)


@pytest.fixture(scope="module")
def child():
    one = Child("script")
    yield one
    one.close()


def end_in_one_line(child, calls):
    for call, seen in zip(calls, child.run(calls), strict=True):
        error = seen["error"]
        assert "\n" not in error or FOREIGN.match(error), (call, error)
        assert not error.startswith(INTERNAL), (call, error)


@given(st.lists(CALLS, min_size=1, max_size=12))
@example([("bare",), ("ask", "counts")])
@example([("build", "inner", 1, 1, "fan"), ("start", 1e-3)])
@example([("bare",), ("engines", "solver"), ("step", 10)])
@example([("build", "flexible", 1, 3, "fan"), ("clear",), ("ends", None, 0.0, 0.0)])
@drawing(150)
def test_calls_in_any_order_end_in_one_line(child, calls):
    end_in_one_line(child, calls)


class Model:
    """What a scene holds, as far as it follows from the calls."""

    def __init__(self) -> None:
        self.now, self.saved, self.first = None, None, 0

    def do(self, call, seen):
        """Take the call; what it must have left, None where anything may be."""
        name = call[0]
        if name == "reset":
            self.now = (0, 0, 0)
        elif name == "build":
            self.now, self.first = (0, seen["bodies"], seen["bonds"]), seen["bonds"]
        elif name == "step" and self.now:
            step, bodies, bonds = self.now
            # grains that touch where a bond was erased have a contact again
            assert bonds <= seen["bonds"] <= self.first
            self.now = (step + call[1], bodies, seen["bonds"])
        elif name == "erase_bond" and self.now and self.now[2]:
            self.now = (*self.now[:2], self.now[2] - 1)
        elif name == "erase_body" and self.now and self.now[1]:
            step, bodies, bonds = self.now
            assert seen["bonds"] <= bonds  # those of the body are gone
            self.now = (step, bodies - 1, seen["bonds"])
        elif name == "save" and not seen["error"]:
            self.saved = (self.now, seen["state"])
        elif name == "load" and self.saved:
            self.now, state = self.saved
            return state
        return None


#: Public calls of rigs that are not drawn: what a run of the command makes of its own.
NOT_CALLED = {
    "approach",
    "keep_start",
    "looked_at",
    "likely_steps",
    "scales",
    "read_mouth",
    "has_scale",
    "confine",
    "bend",
    "balance",
    "unbalanced",
}


def test_every_call_of_a_rig_is_drawn():
    """What is new in parts and stages comes here, of 2D and of solids."""
    from flexpm.rigs.grain_rig import NodeRig, PlateRig
    from flexpm.rigs.parts import HeldNodes, Part
    from flexpm.rigs.solids.end_rig import EndRig

    source = Path(fuzz_script.__file__).read_text() + Path(__file__).read_text()
    drawn = {*re.findall(r"rig\.(\w+)\(", source), *re.findall(r'"(\w+)"', source)} | NOT_CALLED
    for kind in (flexpm.PartRig, flexpm.SolidPartRig, NodeRig, PlateRig, EndRig):
        calls = [name for name in dir(kind) if name[0] != "_" and callable(getattr(kind, name))]
        assert [name for name in calls if name not in drawn] == []
    for kind in (Part, HeldNodes):
        told = {name for name in dir(kind) if name[0] != "_"} - {*ATTRIBUTES["RigPart"]}
        assert told - {"move", *fuzz_script.PART_READINGS} <= {"rig", "number", "solver", "kind"}


@given(BUILD | CUT | CAVE, st.lists(PLAIN | PARTS, max_size=8))
@drawing(60)
def test_parts_laid_in_any_order_end_in_one_line(child, build, calls):
    end_in_one_line(child, [build, *calls])


#: How a test of a solid may begin.
BEGUN = (
    [],
    [("platen", 0, False), ("platen", 2, False)],
    [("platen", 0, False), ("platen", 2, False), ("drive", (0.0, -1.0), [1], [0])],
    [
        *(("platen", side, False) for side in (0, 2)),
        ("press", [1], 1e5),
        ("drive", (0.0, -1.0), [1], [0]),
        ("start", 1.0),
    ],
    [("roller", 0.006, 0.0, False), ("platen", 2, True), ("press", [1], 1e5)],
    [*(("hold", 0.006, z, 0.004, "xy") for z in (0.0, 0.016)), ("turn", None, [0], [1])],
)


@pytest.mark.long
@given(SOLID, st.sampled_from(BEGUN), st.lists(PLAIN | PARTS, max_size=8))
@drawing(40)
def test_parts_of_solids_laid_in_any_order_end_in_one_line(child, build, begun, calls):
    end_in_one_line(child, [build, *begun, *calls])


@given(BUILD, st.lists(PLAIN, max_size=12))
@drawing(60)
def test_a_scene_is_what_a_plain_model_says_and_a_saved_one_comes_back(child, build, calls):
    model, last = Model(), ""
    calls = [("reset",), build, *calls]
    for call, seen in zip(calls, child.run(calls), strict=True):
        where = (call, seen)
        state = model.do(call, seen)
        there = seen["step"], seen["bodies"], seen["bonds"]
        if call[0] in ("ask", "view", "save") and last:
            assert seen["state"] == last, where  # looking changes nothing
        if state is not None:
            assert seen["state"] == state, where
        assert there == model.now, where
        last = seen["state"]


@given(BUILD | CUT | SOLID, st.lists(PLAIN, max_size=8))
@drawing(15)
def test_the_same_calls_give_the_same_bits(child, build, calls):
    calls = [("reset",), build, *calls]
    assert child.run(calls) == child.run(calls)
