# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains without bonds: blocks on slopes, a column that stands, and one that collapses."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade
from fuzz_child import drawing
from hypothesis import assume, example, given
from hypothesis import strategies as st
from refusals import refusal

import flexpm

GRAVITY = 100.0 * 9.81  # so that a test takes a tenth of the time
FRICTION = 0.5
PHI = math.atan(FRICTION)
#: The strengths do not matter to grains without bonds.
LOOSE = {
    "normal_stiffness": 1e10,
    "friction": FRICTION,
    "tensile_strength": 1e5,
    "cohesion": 1e5,
}


def rock(model: str) -> flexpm.Material:
    return flexpm.materials.load(None, model, solid=True).with_set(LOOSE, model)


def hold(built: flexpm.Model, where) -> None:
    """Fix positions and rotations of the grains in a region."""
    nodes, places = built.solver.nodePlaces(bonded=True)
    held = built.solver.addNodeSet(nodes[where(*places.T)].tolist())
    built.solver.turnNodeSet(held, (0.0, 0.0, 0.0))
    built.set_masses()


def middle_of(built: flexpm.Model, grains: np.ndarray, what: str = "pos") -> np.ndarray:
    """Mean position or velocity of grains."""
    ids = [built.solver.bodyIds[grain] for grain in np.flatnonzero(grains)]
    return np.mean([getattr(yade.O.bodies[one].state, what) for one in ids], axis=0)


@pytest.mark.parametrize(
    ("model", "beyond"), [("flexible", 10.0), ("rigid", 10.0), ("rigid", -1.0)]
)
def test_a_block_slides_on_a_3d_joint_as_coulomb_says_or_not_at_all(model, beyond):
    """Way since damping ended, less v0 t, against a t^2 / 2; a = g sin(dip - phi) / cos(phi)."""
    yade.O.reset()
    dip, width, low = PHI + math.radians(beyond), 0.012, 0.003
    slope = math.tan(dip)
    whole = flexpm.Specimen.box(width, 0.006, low + width * slope + 5e-3, diameters=(2.8e-3, 3e-3))
    plane = {"point": (0.0, 0.0, low), "dip": math.degrees(dip), "dip_direction": 270.0}
    values = {"normal_stiffness": 1e12, "shear_stiffness": 1e12, "friction": FRICTION}
    joint = {f"joint.slope.{key}": value for key, value in values.items()}
    material = flexpm.materials.load(None, model, solid=True).with_set(joint, model)
    cut = whole.with_joints({"slope": plane})
    built = flexpm.build(cut, material, model, dynamic=True, gravity=GRAVITY, damping=0.3)
    block = cut.centres[:, 2] > low + slope * cut.centres[:, 0]
    hold(built, lambda x, y, z: z < low + slope * x - 1e-6)
    down = np.array([-math.cos(dip), 0.0, -math.sin(dip)])
    built.run(9000 if model == "rigid" else 4000)
    built.damping = 0.0 if beyond > 0.0 else 0.3
    start, speed = middle_of(built, block) @ down, middle_of(built, block, "vel") @ down
    way = 1e-4  # contacts hand over to pairs after some hundredths of a millimetre
    gain = GRAVITY * math.sin(dip - PHI) / math.cos(PHI)
    steps = math.ceil(math.sqrt(2.0 * way / abs(gain)) / yade.O.dt)
    built.run(steps)
    time = steps * yade.O.dt
    slid = middle_of(built, block) @ down - start
    if beyond < 0.0:
        assert abs(slid) < 1e-8
    else:
        known, state = built.solver.pairs(), built.snapshot()
        assert len(known["grains"]) > 10
        assert np.array_equal(state.pairs.force, known["force"][known["normal_force"] > 0.0])
        # 1 % of the friction, by which a hand-over changes it, is 2 % of the acceleration
        assert slid - speed * time == pytest.approx(0.5 * gain * time**2, rel=0.05)


@pytest.mark.parametrize(("model", "rate"), [("flexible", 4.0), ("rigid", 0.5)])
def test_a_sheared_joint_keeps_its_energy_where_pairs_take_over(model, rate):
    """Corners of faces have the masses that pairs ask for, and faces in one plane are one face."""
    box = flexpm.Specimen.box(0.016, 0.009, 0.016)
    plane = {"point": (0.008, 0.0045, 0.008), "dip": 0.0, "dip_direction": 0.0}
    law = {"normal_stiffness": 1e13, "shear_stiffness": 5e12, "friction": 0.5}
    law |= {"cohesion": 0.0, "tensile_strength": 0.0}
    material = flexpm.materials.load("augig3d-calibrated" + ("-rigid" if model == "rigid" else ""))
    done = flexpm.run(
        "shear",
        box.with_joints({"bed": plane}),
        material.with_set({f"joint.bed.{key}": value for key, value in law.items()}, model),
        model=model,
        normal_stress=5e6,
        rate=rate,
        max_displacement=7e-5,
    )
    assert done.energy_error < 1e-3
    if model == "rigid":  # the other one is far too fast
        sliding = done.curve["shear_displacement"] > 3e-5
        assert np.mean(done.curve["shear_stress"][sliding]) == pytest.approx(2.5e6, rel=0.03)


MIDDLE = np.array([0.03, 0.03, 0.03])


def slope_and_block(dip: float, sides: tuple[float, float, float]) -> flexpm.SolidSpecimen:
    """A cuboid on a slope: grain 0 of the cells of seven spheres, and the grain below it.

    Args:
        dip: Of the slope, towards x [degree].
        sides: Of the cuboid down the slope, across, and normal to the slope [m].
    """
    down, across, up = axes = axes_of(dip)
    ways = [0.0 * up, -sides[2] * up]
    ways += [sign * side * axis for side, axis in zip(sides, axes, strict=True) for sign in (1, -1)]
    rows = [(*(MIDDLE + way), 1e-3) for way in ways[:-1]]
    # edges of the cuboid are short beside the mean diameter of all seven
    sizes = dict.fromkeys(("width", "depth", "height"), 0.06)
    whole = flexpm.Specimen.from_spheres(rows, **sizes, short_edge=0.0)
    left = whole.without_grains(range(2, len(rows)))
    assert left.cells.volumes[0] == pytest.approx(math.prod(sides), rel=1e-9)
    return left


def axes_of(dip: float) -> np.ndarray:
    """Unit vectors down a slope, across and normal to it."""
    angle = math.radians(dip)
    return np.array(
        [
            [math.cos(angle), 0.0, -math.sin(angle)],
            [0.0, 1.0, 0.0],
            [math.sin(angle), 0.0, math.cos(angle)],
        ]
    )


def motions_on_slope(
    dip: float, sides: tuple[float, float, float], friction: float, steps: int, damping: float = 0.3
) -> list[tuple[float, float, int]]:
    """Way down the slope [m], rotation about the axis across [rad], pairs that press: twice.

    The damping is that after the first half, which has 0.3.
    """
    yade.O.reset()
    down, across, up = axes_of(dip)
    material = rock("flexible").with_set({"normal_stiffness": 1e13, "friction": friction})
    options = {"dynamic": True, "gravity": GRAVITY, "damping": 0.3, "bonded": False}
    built = flexpm.build(slope_and_block(dip, sides), material, **options)
    low = float(MIDDLE @ up - 0.5 * sides[2]) - 1e-6
    hold(built, lambda x, y, z: x * up[0] + y * up[1] + z * up[2] < low)
    found = []
    for _ in range(2):
        built.run(steps)
        state = built.snapshot()
        nodes = slice(0, state.node_offsets[1])
        before, now = state.reference[nodes], state.positions[nodes]
        way = (now - before).mean(axis=0)
        arms, now = before - before.mean(axis=0), now - now.mean(axis=0)
        about = np.cross(across, arms)
        turn = math.atan2(np.sum(about * now), np.sum(np.cross(about, across) * now))
        found.append((float(way @ down), turn, len(state.pairs)))
        built.damping = damping
    return found


@given(
    friction=st.floats(0.2, 1.2),
    shape=st.floats(0.3, 1.2),
    height=st.floats(0.006, 0.014),
    margin=st.sampled_from([-1.0, 1.0, 4.0]),
)
@drawing(12, by_night=10)
@example(friction=0.4, shape=0.7, height=0.015, margin=1.0)
@example(friction=1.5, shape=0.7, height=0.015, margin=1.0)
def test_blocks_on_slopes_rest_slide_or_topple_within_a_degree(friction, shape, height, margin):
    """Slides from the friction angle on, topples where its centre is beyond its edge."""
    slides, topples = (math.degrees(math.atan(one)) for one in (friction, shape))
    assume(abs(slides - topples) > 2.0 + margin)
    dip = min(slides, topples) + margin
    sides = (shape * height, 0.008, height)
    (before, turned, _), (way, turn, _) = motions_on_slope(
        dip, sides, friction, 7000, damping=0.3 if margin < 0.0 else 0.0
    )
    if margin < 0.0:  # an edge under load gives way a little, and then rests
        assert abs(way - before) < 1e-7
        assert abs(turn - turned) < 1e-4
    elif slides < topples:
        assert way > 1e-5
        assert way > 2.0 * before
        assert abs(turn) < 0.02  # it chatters without damping
    else:
        assert turn > 2e-5
        assert turn > 2.0 * turned


def test_a_block_that_topples_turns_about_its_edge_as_a_pair():
    way, turn, pairs = motions_on_slope(45.0, (0.006, 0.008, 0.012), 1.2, 4000)[1]
    assert turn > 0.1
    assert pairs == 1
    # the centre moves on an arc about the lower edge, which is 3 mm down the slope from it
    start = math.atan2(0.006, -0.003)
    arc = np.hypot(0.003, 0.006) * (math.cos(start - turn) - math.cos(start))
    assert way == pytest.approx(arc, rel=0.02)


@pytest.mark.parametrize(("model", "tolerance"), [("rigid", 1e-9), ("flexible", 1e-5)])
def test_three_blocks_that_have_fallen_weigh_on_what_bears_them(model, tolerance):
    """Cubes on cubes after a fall of 4 mm: rho g h at each face, that of the pair among them."""
    yade.O.reset()
    side, gap = 0.01, 0.004
    ends = np.cumsum([0.0, side, gap, side, side, side])
    middles = 0.5 * (ends[1:] + ends[:-1])
    powers = [2.5e-5]
    for distance, end, middle in zip(np.diff(middles), ends[1:], middles, strict=False):
        powers.append(powers[-1] - 2.0 * distance * (end - middle - 0.5 * distance))
    radii = np.sqrt(np.array(powers) - min(powers) + 1e-8)
    rows = [(0.5 * side, 0.5 * side, *one) for one in zip(middles, radii, strict=True)]
    whole = flexpm.Specimen.from_spheres(rows, width=side, depth=side, height=float(ends[-1]))
    blocks = whole.without_grains([1])
    options = {"dynamic": True, "gravity": GRAVITY, "damping": 0.7, "bonded": False}
    built = flexpm.build(blocks, rock(model), model, **options)
    hold(built, lambda x, y, z: z < side + 1e-9)
    built.run(16000)
    state = built.snapshot()
    weight = yade.O.bodies[built.solver.bodyIds[1]].state.mass * GRAVITY
    assert state.pairs.grains.tolist() == [[0, 1]]
    assert state.pairs.force[0, 2] == pytest.approx(3.0 * weight, rel=tolerance)
    forces = state.point_traction[:, 0] * state.point_area
    between = np.bincount(state.point_contact, forces) / weight
    assert between == pytest.approx([-2.0, -1.0], rel=tolerance)
    # the deepest place is half of the overlap away from both faces
    assert 2.0 * state.pairs.depth[0] * 1e10 * side**2 == pytest.approx(3.0 * weight, rel=2e-3)


@pytest.fixture(scope="module")
def column() -> flexpm.SolidSpecimen:
    """Grains on a floor that is wider than they are."""
    whole = flexpm.Specimen.box(0.036, 0.01, 0.02, diameters=(3.5e-3, 4.5e-3), seed=1)
    x, _, z = whole.centres.T
    return whole.without_grains((z > 4e-3) & (np.abs(x - 0.018) > 6e-3))


def test_a_column_without_bonds_collapses_and_keeps_its_energy(column):
    yade.O.reset()
    built = flexpm.build(
        column, rock("rigid"), "rigid", dynamic=True, gravity=GRAVITY, bonded=False
    )
    hold(built, lambda x, y, z: z < 4e-3)
    free = column.centres[:, 2] > 4e-3
    before = middle_of(built, free)
    built.run(1500)
    energies = built.solver.energies()
    fallen = middle_of(built, free) - before
    assert fallen[2] < -1e-3
    ids = [built.solver.bodyIds[grain] for grain in np.flatnonzero(free)]
    x = np.array([yade.O.bodies[one].state.pos[0] for one in ids])
    assert np.ptp(x) > np.ptp(column.centres[free, 0]) + 2e-3
    assert energies["friction_energy"] > 0.05 * -energies["potential_energy"]
    assert sum(energies.values()) == pytest.approx(0.0, abs=0.02 * -energies["potential_energy"])
    assert built.solver.cracks() == (0, 0)
    assert built.largest_clearance < 0.02


@pytest.mark.parametrize("solid", [False, True], ids=["plane", "space"])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_contacts_without_bonds_press_and_do_not_pull(solid, model):
    """Two halves of a specimen that are pulled apart, and pushed on each other."""
    specimen = (
        flexpm.Specimen.box(0.008, 0.008, 0.012)
        if solid
        else flexpm.Specimen.rectangle(0.01, 0.02, thickness=0.01, seed=1)
    )
    height, forces = specimen.extent["height"], {}
    for bonded in (True, False):
        for sign in (-1.0, 1.0):
            yade.O.reset()
            material = flexpm.materials.load(None, model, solid=solid)
            built = flexpm.build(specimen, material, model, bonded=bonded)
            rig = flexpm.PartRig(built)
            up = np.array([0.0, 0.0, 1.0] if solid else [0.0, 1.0])
            rig.hold(where=lambda *at: at[-1] < 0.3 * height)
            high = rig.hold(where=lambda *at: at[-1] > 0.7 * height)
            built.set_masses()
            high.move(tuple(sign * 1e-9 * height * up))
            built.run(400)
            forces[bonded, sign] = sign * float(np.dot(high.force, up))
            assert built.solver.cracks() == (0, 0)
    assert forces[True, 1.0] == pytest.approx(forces[True, -1.0], rel=0.1)
    assert forces[False, -1.0] > 0.3 * forces[True, -1.0]
    assert abs(forces[False, 1.0]) < 0.02 * forces[True, 1.0]


def test_removed_grains_leave_the_volume_and_the_faces_of_the_others(column):
    whole = flexpm.Specimen.box(0.036, 0.01, 0.02, diameters=(3.5e-3, 4.5e-3), seed=1)
    x, _, z = whole.centres.T
    kept = (z <= 4e-3) | (np.abs(x - 0.018) <= 6e-3)
    assert len(column.spheres) == kept.sum()
    same = whole.without_grains(np.flatnonzero(~kept))
    np.testing.assert_array_equal(same.cells.volumes, column.cells.volumes)
    # short edges collapse otherwise beside free walls
    np.testing.assert_allclose(column.cells.volumes, whole.cells.volumes[kept], rtol=0.05)
    assert column.cells.volumes.sum() == pytest.approx(whole.cells.volumes[kept].sum(), rel=5e-3)


def test_removed_grains_keep_the_minerals_of_the_others_in_files(tmp_path):
    whole = flexpm.Specimen.box(0.008, 0.008, 0.012).with_minerals(np.arange(44) % 2)
    left = whole.without_grains([0, 3])
    assert left.minerals.tolist() == [k % 2 for k in range(44) if k not in (0, 3)]
    left.save(tmp_path / "left.json")
    again = flexpm.Specimen.load_solid(tmp_path / "left.json")
    np.testing.assert_array_equal(again.cells.volumes, left.cells.volumes)


def test_what_cannot_be_done_is_refused(column):
    whole = flexpm.Specimen.box(0.008, 0.008, 0.012)
    plane = {"point": (0.004, 0.004, 0.006), "dip": 30.0, "dip_direction": 0.0}
    cut = whole.with_joints({"a": plane})
    refusal("grain = 44, must be 0 to 43", whole.without_grains, [44])
    refusal("flags = 3, must be 44", whole.without_grains, [True, False, True])
    refusal("grains left = 1, must be >= 2", whole.without_grains, range(43))
    for one in (cut, column):
        refusal("cells = cut or given", one.without_grains, [0])
    refusal("grains = [0.7], must be integers or bools", whole.without_grains, [0.7])
    words = "bonded = False, must be True for model jcfpm"
    refusal(words, flexpm.build, whole, None, "jcfpm", bonded=False)
