# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints: cells cut by lines, their laws, refused input, the command."""

import math
import os
import re

import numpy as np
import pytest
from cut_specimens import DIP, HEIGHT, LAW, WIDTH, joint_edges, off, require_lengths, require_pieces
from fuzz_child import drawing
from hypothesis import assume, given
from hypothesis import strategies as st
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.joints import bend as joint_bend
from flexpm.materials.material import load
from flexpm.materials.mixing import description, from_description
from flexpm.specimens.specimen import Specimen


@pytest.fixture(scope="module")
def rectangle():
    return Specimen.rectangle(WIDTH, HEIGHT, 0.08)


@pytest.fixture(scope="module")
def weak():
    return load().with_set(LAW.split())


def test_a_joint_from_side_to_side(rectangle):
    cut = rectangle.with_joints({"weak": DIP})
    require_pieces(cut, rectangle)
    edges = joint_edges(cut)
    lengths = np.hypot(*(edges[:, 1] - edges[:, 0]).T)
    assert off(edges, DIP).max() < 0.5 * rectangle.mean_diameter
    assert 1.0 <= lengths.sum() / math.hypot(0.02, 0.02) < 1.1
    assert len(cut.discs) > len(rectangle.discs)
    # whole grains are as they were, in their places
    same = cut.grains[: len(rectangle.discs)]
    np.testing.assert_array_equal(same, np.arange(len(rectangle.discs)))
    assert (cut.discs[: len(rectangle.discs)] == rectangle.discs).all(axis=1).sum() > 10


def test_a_joint_parts_the_specimen(rectangle, weak):
    """Without strength it leaves two fragments from the start, and no crack."""
    built = flexpm.build(rectangle.with_joints({"weak": DIP}), weak)
    assert built.solver.cracks() == (0, 0)
    snapshot = built.snapshot()
    assert snapshot.point_damage.max() == 1.0
    sound = snapshot.any_of(snapshot.point_damage < 1.0)
    # union of what is bonded
    parts = np.arange(snapshot.contact_grains.max() + 1)
    for _ in range(len(parts)):
        a, b = parts[snapshot.contact_grains[sound]].T
        low = np.minimum(a, b)
        before = parts.copy()
        np.minimum.at(parts, snapshot.contact_grains[sound][:, 0], low)
        np.minimum.at(parts, snapshot.contact_grains[sound][:, 1], low)
        if np.array_equal(before, parts):
            break
    assert len(set(parts.tolist())) == 2


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_weak_joint_is_the_strength(rectangle, weak, model):
    """A cohesionless joint at 45 degrees with friction 0.5 slides; what is left is inertia."""
    cut = rectangle.with_joints({"weak": DIP})
    options = {"max_strain": 5e-4, "rate": 0.5, "loading": "constant"}
    result = flexpm.run("uniaxial", cut, weak, model, **options)
    whole = flexpm.elastic(rectangle, weak, model)["youngs_modulus"] * 5e-4
    assert result.curve["axial_stress"].max() < 0.3 * whole
    assert result.tensile_cracks == 0
    assert result.energy_error < 0.01


def test_a_joint_as_strong_as_the_rock_is_the_rock(rectangle):
    """With the stiffness of the rock's contacts it changes the constants no more than its cells."""
    rock = load()
    law = rock.law()
    joint = {
        "normal_stiffness": law["normal_stiffness"],
        "shear_stiffness": law["shear_ratio"] * law["normal_stiffness"],
        **{key: law[key] for key in ("friction", "cohesion", "tensile_strength")},
        **{key: law[key] for key in ("tensile_fracture_energy", "shear_fracture_energy")},
    }
    strong = rock.with_set({f"joint.weak.{key}": value for key, value in joint.items()})
    cut = rectangle.with_joints({"weak": DIP})
    found = flexpm.elastic(cut, strong)["youngs_modulus"]
    assert found == pytest.approx(flexpm.elastic(rectangle, rock)["youngs_modulus"], rel=0.03)
    built = flexpm.build(cut, strong)
    assert built.snapshot().point_damage.max() == 0.0


def test_a_notch_ends_where_the_cut_ends(rectangle):
    notched = rectangle.with_joints({"notch": [(0.01, -0.001), (0.01, 0.012)]})
    edges = joint_edges(notched)
    assert edges[..., 1].min() == 0.0
    # half of its way through the last cell, or back to the one before
    assert abs(edges[..., 1].max() - 0.012) <= 0.5 * 0.005
    require_pieces(notched, rectangle)
    opened = load().with_set("joint.notch.open=true")
    law = opened.joint_laws()[0]
    assert law["friction"] == opened.friction
    assert law["normal_stiffness"] == opened.law()["normal_stiffness"]
    flexpm.build(notched, opened).run(3)


def test_a_line_may_bend_and_joints_may_cross(rectangle):
    lines = {
        "bent": [(0.004, -0.001), (0.006, 0.02), (0.016, 0.024)],
        "across": [[(0.0, 0.015), (0.02, 0.016)], [(0.0, 0.03), (0.02, 0.03)]],
    }
    cut = rectangle.with_joints(lines)
    require_pieces(cut, rectangle)
    assert cut.spec.joint_names == ("bent", "across")
    assert {*cut.edge_joints.tolist()} == {-1, 0, 1}
    one_by_one = rectangle.with_joints({"bent": lines["bent"]}).with_joints(
        {"across": lines["across"]}
    )
    require_pieces(one_by_one, rectangle)
    assert one_by_one.spec.joint_names == ("bent", "across")


def numbers(low, high):
    """In 10 000 steps, as many floats exceed the size of an example; or in 10: lines coincide."""
    steps = st.integers(0, 10000) | st.integers(0, 10).map(lambda tenth: 1000 * tenth)
    return steps.map(lambda step: low + (high - low) * step / 10000)


segments = st.tuples(
    numbers(0.001, WIDTH - 0.001),
    numbers(0.001, HEIGHT - 0.001),
    numbers(0.0, math.pi),
    numbers(0.004, 0.02),
)
#: As many as drawn: lists of up to 100 would have six as a rule.
joint_sets = st.sampled_from(range(1, 101)).flatmap(
    lambda count: st.lists(segments, min_size=count, max_size=count)
)


#: Sets that were cut badly once, with the seed of the packing: a grain that its point did not see
#: whole, a piece below 2 %, edges without length where lines coincide; an end on an edge hung.
FOUND = [
    ([(0.013600000000000001, 0.0238, 3.1415926535897927, 0.0136)], 1),
    ([(0.00678, 0.00443, 0.85055, 0.004)], 5),
    (
        [
            (0.001, 0.0335, 2.5114, 0.0054),
            (0.001, 0.0376, 1.424, 0.004),
            (0.007, 0.0359, 0.285, 0.02),
        ],
        3,
    ),
    ([(0.001, 0.02293313891528908, 1.591, 0.01912848594065457), (0.004, 0.034, 0.0, 0.02)], 1),
    (
        [
            (0.012196, 0.026764, 2.9477563868633028, 0.004),
            (0.0127414, 0.0268286, 1.4489025318356126, 0.004),
            (0.017047, 0.0271098, 0.20451768174869553, 0.004),
            (0.0093394, 0.0248868, 0.4118627968856219, 0.004),
        ],
        5,
    ),
    (
        [
            (0.0129232, 0.009436, 2.441645810369987, 0.004),
            (0.0152542, 0.0167928, 0.7118848953034471, 0.0090208),
            (0.0119836, 0.0118604, 0.0, 0.004),
        ],
        1,
    ),
]


#: Lines that may begin and end outside, cross themselves and go back the same way.
points = st.tuples(numbers(-0.001, WIDTH + 0.001), numbers(-0.001, HEIGHT + 0.001))
polyline = st.lists(points, min_size=2, max_size=5)
back_again = polyline.map(lambda line: line + line[-2::-1])
polylines = st.lists(polyline | back_again, min_size=1, max_size=8)


def require_cut(drawn, seed):
    """Cut a packing by joints of centres x, y, angle and half a length, and check the pieces."""
    uncut = Specimen.rectangle(WIDTH, HEIGHT, 0.08, seed=seed)
    lines = [
        [
            (x - length * math.cos(angle), y - length * math.sin(angle)),
            (x + length * math.cos(angle), y + length * math.sin(angle)),
        ]
        for x, y, angle, length in drawn
    ]
    require_pieces(uncut.with_joints({"set": lines}), uncut)


@pytest.mark.parametrize(("drawn", "seed"), FOUND)
def test_sets_of_joints_that_were_cut_badly(drawn, seed):
    require_cut(drawn, seed)


@pytest.mark.parametrize(
    "line",
    [
        [(0.0, 0.036), (0.0078, 0.036), (0.0078, 0.01), (0.0078, 0.036)],
        [(0.0166, 0.0242), (0.0034, 0.0242), (-0.001, 0.041), (0.01, -0.001)],
    ],
)
def test_a_line_may_turn_back_onto_itself(line):
    for seed in range(1, 6):
        uncut = Specimen.rectangle(WIDTH, HEIGHT, 0.08, seed=seed)
        require_pieces(uncut.with_joints({"back": line}), uncut)


@drawing(50, by_night=20)
@given(joint_sets, st.integers(1, 5))
def test_any_set_of_joints(drawn, seed):
    require_cut(drawn, seed)


@drawing(50, by_night=20)
@given(polylines, st.integers(1, 5))
def test_any_set_of_polylines(drawn, seed):
    uncut = Specimen.rectangle(WIDTH, HEIGHT, 0.08, seed=seed)
    assume(all(any(point != line[0] for point in line) for line in drawn))
    try:
        cut = uncut.with_joints({"set": drawn})
    except InputError as error:
        assert re.search("lines that cut a cell = 0 of", str(error))
        return
    require_pieces(cut, uncut)
    require_lengths(cut)


def test_a_cut_specimen_is_loaded_to_the_bit(rectangle, tmp_path):
    cut = rectangle.with_joints({"weak": DIP})
    cut.save(tmp_path / "cut.json")
    again = Specimen.load(tmp_path / "cut.json")
    assert again.spec == cut.spec
    for name in ("edge_joints", "grains", "discs"):
        np.testing.assert_array_equal(getattr(again, name), getattr(cut, name))
    np.testing.assert_array_equal(again.tessellation.shared_edges, cut.tessellation.shared_edges)


def test_the_bend_of_a_line_is_its_distance():
    """Beyond its ends a line goes on; at a corner the distance is that from the corner."""
    corner = [[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]]
    places = np.array([(-3.0, 0.0), (0.5, 0.25), (1.0, 9.0), (1.3, -0.4)])
    pairs = np.stack((places, places), axis=1)
    far = [joint_bend.largest_bend(corner, pair[None]) for pair in pairs]
    assert far == pytest.approx([0.0, 0.25, 0.0, 0.5])
    both = [*corner, [(0.0, 0.2), (1.0, 0.2)]]
    assert joint_bend.largest_bend(both, pairs[1:2]) == pytest.approx(0.05)
    assert joint_bend.largest_bend(corner, pairs) == pytest.approx(0.5)
    # an edge from one line to the other follows neither
    assert joint_bend.largest_bend(both, np.array([[(0.5, 0.0), (0.6, 0.2)]])) == pytest.approx(0.2)


def test_straight_joints_are_straight():
    """Where a cut would leave a sliver, the grains give way to the joint."""
    for seed in range(1, 9):
        whole = Specimen.rectangle(0.012, 0.024, 0.01, seed=seed)
        for dip in (35.0, 50.0, 60.0):
            rise = 0.016 * math.tan(math.radians(dip))
            cut = whole.with_joints({"weak": [(-0.01, 0.012 - rise), (0.022, 0.012 + rise)]})
            assert cut.joint_deviations() == {"weak": 0.0}


CROSSING = [[(-0.001, 0.01), (0.013, 0.014)], [(0.006, -0.001), (0.006, 0.025)]]


def test_joints_that_cross_are_straight_mostly():
    """The first one always; vertices of it slide along it to where the second one crosses."""
    bent = 0
    for seed in range(1, 21):
        whole = Specimen.rectangle(0.012, 0.024, 0.01, seed=seed)
        bends = whole.with_joints(dict(zip("ab", CROSSING, strict=True))).joint_deviations()
        assert bends["a"] == 0.0
        bent += bends["b"] > 0.0
    assert bent == 5


def test_a_joint_that_bends_to_the_grains_says_so(rectangle, weak, tmp_path):
    straight, bent = (
        Specimen.rectangle(0.012, 0.024, 0.01, seed=seed).with_joints({"weak": CROSSING})
        for seed in (25, 3)
    )
    assert straight.joint_deviations() == {"weak": 0.0}
    found = bent.joint_deviations()["weak"]
    edges = [off(joint_edges(bent), line).max(axis=1) for line in CROSSING]
    assert found == pytest.approx(np.minimum(*edges).max())
    assert found > 0.05 * bent.mean_diameter
    bent.save(tmp_path / "bent.json")
    assert Specimen.load(tmp_path / "bent.json").joint_deviations() == bent.joint_deviations()
    rig = {"material": weak, "model": "rigid", "rate": 20.0}
    result = flexpm.run("uniaxial", bent, **rig)
    assert result.joint_deviation == found
    assert sum(line.startswith(f"joint_deviation = {found:.3g} m") for line in result.warnings) == 1
    own = flexpm.PartRig(fresh(bent, weak, "rigid"))
    low, high = (own.hold(box=((0.0, y), (0.012, y + 0.002))) for y in (0.0, 0.022))
    own.drive([high], (0.0, -1.0), against=[low])
    own.load(flexpm.Loading(rate=20.0))
    assert own.warnings[0] in result.warnings
    silent = flexpm.run("uniaxial", straight, **rig)
    assert silent.joint_deviation == 0.0
    assert not any("joint_deviation" in line for line in silent.warnings)
    notch = rectangle.with_joints({"weak": [(0.0, 0.02), (0.007, 0.0213)]})
    notch = notch.with_joints({"weak": [(0.02, 0.03), (0.015, 0.03)]})
    assert len(notch.joints["weak"]) == 2
    assert notch.joint_deviations() == {"weak": 0.0}


def test_pieces_have_the_mineral_of_their_grain(rectangle):
    marked = rectangle.with_minerals(np.arange(len(rectangle.discs)) % 3)
    cut = marked.with_joints({"weak": DIP})
    np.testing.assert_array_equal(cut.minerals, marked.minerals[cut.grains])


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        (
            {"a": [(0.03, 0.0), (0.04, 0.02)], "b": [(0.03, 0.0), (0.05, 0.02)]},
            r"lines that cut a cell = 0 of 2, must be >= 1 \(joint a lies outside the specimen\); "
            r"the lines extend from \(0.03, 0\) m to \(0.05, 0.02\) m, the specimen from .* m to "
            r"\(0.02, 0.04\) m",
        ),
        ({"a": [(0.0101, 0.02), (0.0102, 0.02)]}, "= 0 of 1, .*joint a ends within grains"),
        ({"a": [(0.0, 0.0)]}, "joint a = .* must be a line of two or more points"),
        ({"a": [(0.0, 0.01), (0.0, 0.01)]}, "start and end of a line without length"),
        (
            {"a": [DIP, [(0.0, 0.01), (1e286, 0.01)]]},
            r"joint a: line 1 from \(0.0, 0.01\) m: .* must lie within 1e6 sizes of the specimen",
        ),
        ({"a": [(0.0, math.nan), (0.0, 0.01)]}, "must be a line of two or more points"),
        ({"a b": DIP}, "must be a name without spaces"),
        ({"a\n": DIP}, "must be a name without spaces"),
        ({"a\x00": DIP}, "must be a name without spaces"),
        ({"a": [[(0.0, 0.01), (0.02, 0.02)]] * 20001}, "segments in the specimen = 20001, must be"),
        ({}, "must be lines by the name"),
        ("joints", "must be lines by the name"),
    ],
)
def test_joints_that_cannot_be(rectangle, joints, message):
    refusal(message, rectangle.with_joints, joints)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            {"friction": 0.5},
            r"\[joint.a\] normal_stiffness, shear_stiffness are missing; give all keys of a new",
        ),
        (
            {"normal_stiffness": 1e14, "shear_stiffness": 3e13},
            r"\[joint.a\] friction is missing; give all keys of a new joint together",
        ),
        ({"open": True, "cohesion": 1e6}, r"\[joint.a\] cohesion = 1000000.0 Pa, must be 0"),
        ({"frictoin": 0.5}, r"\[joint.a\] key = 'frictoin', unknown \(did you mean friction"),
        ({"open": 1}, r"\[joint.a\] open = 1, must be true or false"),
        ({"cohesion": -1.0}, r"\[joint.a\] cohesion = -1.0 Pa, must be >= 0"),
        (
            {"cohesion": 1e7, "shear_fracture_energy": 1e-3},
            r"\[joint.a\] shear_fracture_energy = 0.001 N/m, must not be below",
        ),
        (
            {"dilation_angle": 30.0, "dilation_slip": 1e-3},
            r"dilation_angle = 30.0 degrees, must not exceed the friction angle, 26.57 degrees",
        ),
        ({"dilation_angle": 5.0}, r"\[joint.a\] dilation_slip is missing; give the slip"),
        ({"dilation_angle": 95.0}, r"dilation_angle = 95.0 degrees, must be < 90"),
    ],
)
def test_laws_that_cannot_be(values, message):
    whole = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5}
    missing = set(values) <= {"normal_stiffness", "shear_stiffness"}
    alone = missing or "open" in values or "friction" in values
    given = values if alone else {**whole, **values}
    base = {"tensile_strength": 1e7, "cohesion": 3e7, "friction": 0.4, "softening": "brittle"}
    sets = {"flexible": {"young": 3e10, "poisson": 0.2, "normal_stiffness": 1e14}}
    sets["flexible"]["shear_ratio"] = 0.3
    refusal(message, lambda: load({**base, "elastic": sets, "joint": {"a": given}}).joint_laws())


def test_a_joint_without_a_law_is_named(rectangle, weak):
    cut = rectangle.with_joints({"wek": DIP})
    refusal(r"joint = 'wek', unknown \(did you mean weak\?\)", flexpm.run, "uniaxial", cut, weak)
    refusal(r"joint = 'wek', has no law; add a table \[joint.wek\]", flexpm.elastic, cut)


@pytest.mark.parametrize("model", ["jcfpm", "cohfrict", "inner", "inner-un"])
def test_other_models_have_no_joints(rectangle, weak, model):
    cut = rectangle.with_joints({"weak": DIP})
    for call in (flexpm.build, lambda *given: flexpm.run("uniaxial", *given)):
        refusal(f"model = {model}, must be .* joints", call, cut, weak, model)


def test_a_material_with_joints_comes_back(weak):
    told = {"name": weak.name, **description(weak, "flexible")}
    again = from_description(told, "flexible")
    assert description(again, "flexible") == description(weak, "flexible")
    changed = weak.with_set("joint.weak.friction=0.7")
    assert changed.joints[0].friction == 0.7
    refusal(r"set joint.weak = 'frction', unknown", weak.with_set, "joint.weak.frction=0.7")


if os.environ.get("HYPOTHESIS_PROFILE") == "night":
    _MAPS = [(seed, 100 + round(2900 * (seed / 199) ** 2)) for seed in range(200)]
