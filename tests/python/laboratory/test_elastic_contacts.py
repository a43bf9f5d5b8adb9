# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution where contacts open and close: a column that nearly topples, corners."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade

import flexpm

GRAVITY = 9.81
#: A rock that never breaks.
NEVER = dict.fromkeys(("tensile_strength", "cohesion"), 1e9)
NEVER |= dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e6)


def column(
    model: str, ratio: float, beyond: float, *, gravity=GRAVITY, friction=3.0, seed=1, **base
) -> flexpm.PartRig:
    """A column, `ratio` as wide as high, on a joint `beyond` degrees steeper than it stands on."""
    yade.O.reset()
    dip = math.atan(ratio) + math.radians(beyond)
    along, up = np.array([math.cos(dip), math.sin(dip)]), np.array([-math.sin(dip), math.cos(dip)])
    places = ((0.0, -0.5 * ratio), (ratio, -0.5 * ratio), (ratio, 1.0), (0.0, 1.0))
    corners = [tuple(x * along + y * up) for x, y in places]
    size = base.get("size", 0.4) * ratio
    specimen = flexpm.Specimen.polygon(corners, 0.1, diameters=(size, 1.5 * size), seed=seed)
    ends = [(-0.1 * ratio * along).tolist(), (1.1 * ratio * along).tolist()]
    stiffness = base.get("stiffness", 1e13)
    law = {"normal_stiffness": stiffness, "shear_stiffness": stiffness, "friction": friction}
    law |= {"cohesion": 0.0, "tensile_strength": 0.0}
    rock = flexpm.materials.load("augig-table2-bilinear").with_set(NEVER, model)
    rock = rock.with_set({f"joint.base.{key}": value for key, value in law.items()}, model)
    joined = specimen.with_joints({"base": [ends]})
    rig = flexpm.PartRig(flexpm.build(joined, rock, model, dynamic=True, gravity=gravity))
    rig.hold(where=lambda x, y: x * up[0] + y * up[1] < -0.15 * ratio)
    return rig


def apart(state: flexpm.Snapshot, rig: flexpm.PartRig) -> float:
    """Largest difference of displacements from those of the rig, over their largest."""
    now = rig.built.snapshot()
    moved = now.positions - now.reference
    return float(np.abs(state.displacements - moved).max() / np.abs(moved).max())


@pytest.mark.parametrize(("model", "short"), [("rigid", 0.5), ("flexible", 2.0)])
def test_a_column_that_nearly_topples_stands_where_it_comes_to_rest(model, short):
    """Its weight is small, so that it does not lean by standing."""
    rig = column(model, 0.5, -short, gravity=0.1 * GRAVITY)
    state = rig.elastic()
    assert state.beyond_friction == 0
    rig.settle()
    again = rig.elastic()
    np.testing.assert_allclose(
        again.displacements, state.displacements, atol=1e-4 * np.abs(state.displacements).max()
    )
    # a tenth of a per cent of the weight is much where it nearly topples: on to rest
    rig.settle(moving=True, transits=100)
    assert apart(state, rig) < 1e-3


def test_the_search_for_open_contacts_ends_for_columns_that_rock():
    """Points went to and fro: open by the shear of all their way, and closed without it."""
    for ratio, short, options in (
        (1.0, 3.0, {"friction": 0.8, "seed": 31, "stiffness": 1e12}),
        (0.5, 0.5, {"friction": 0.8, "seed": 22, "stiffness": 1e14}),
    ):
        rig = column("rigid", ratio, -short, gravity=981.0, **options)
        rig.built.run(1000 if ratio == 1.0 else 2000)
        state = rig.elastic()
        assert state.solutions < 60
        assert state.force(rig._all_parts[0])[1] == pytest.approx(rig.weight, rel=1e-6)


def test_each_search_ends_or_names_a_free_motion():
    draw = np.random.default_rng(5)
    stands = 0
    for _ in range(40):
        rig = column(
            str(draw.choice(["rigid", "flexible"])),
            float(draw.choice([0.25, 0.5, 1.0])),
            float(draw.choice([-3.0, -1.0, -0.2, -0.05, 0.2])),
            gravity=100.0 * GRAVITY,
            friction=float(draw.choice([0.8, 1.3])),
            seed=int(draw.integers(1, 100)),
            stiffness=float(10.0 ** draw.uniform(10.0, 14.0)),
        )
        rig.built.run(int(draw.choice([1, 30, 300])))
        try:
            state = rig.elastic()
        except flexpm.InputError as error:
            assert "hold nodes against every rigid motion" in str(error)
            continue
        stands += 1
        assert state.force(rig._all_parts[0])[1] == pytest.approx(rig.weight, rel=1e-6)
    assert stands > 20


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_block_on_two_corners_is_pressed_askew(model):
    """An arch on a floor with friction, under a plate that a pressure brings onto its top."""
    yade.O.reset()
    width, height, foot = 0.020, 0.014, 0.004
    corners = [(0.0, 0.0), (foot, 0.0), (0.5 * width, 0.3 * height), (width - foot, 0.0)]
    corners += [(width, 0.0), (width, height + 1e-7), (0.0, height - 1e-7)]
    arch = flexpm.Specimen.polygon(corners, 0.01, seed=2)
    rock = flexpm.materials.load("augig-table2-bilinear").with_set(NEVER, model)
    rig = flexpm.PartRig(flexpm.build(arch, rock, model))
    feet = [rig.support((x, 0.0), foot, friction=5.0) for x in (0.5 * foot, width - 0.5 * foot)]
    top = rig.support((0.5 * width, height), width, normal=(0.0, -1.0))
    state = rig.elastic({top: 2e6})
    rig.press(top, 2e6)
    rig.built.run(6000)
    assert apart(state, rig) < 1e-3
    for one in feet:
        scale = 1e-3 * np.abs(top.force).max()
        np.testing.assert_allclose(state.force(one), one.force, atol=scale)
    total = np.sum([state.force(one) for one in (*feet, top)], axis=0)
    np.testing.assert_allclose(total, 0.0, atol=1e-9 * abs(state.force(top)[1]))
