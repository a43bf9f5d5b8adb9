# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks that stand, hang, slide and topple under their weight: closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yade
from refusals import failure

import flexpm

GRAVITY = 9.81
FRICTION = 0.5
SIDE = 0.016
PHI = math.atan(FRICTION)


def joint(name: str, stiffness: float, friction: float) -> dict[str, float]:
    """A joint without strength; so soft on an incline that no point of it rattles."""
    values = {"normal_stiffness": stiffness, "shear_stiffness": stiffness, "friction": friction}
    none = {"cohesion": 0.0, "tensile_strength": 0.0}
    return {f"joint.{name}.{key}": value for key, value in {**values, **none}.items()}


def middle_of(block: list, what: str) -> np.ndarray:
    """Mean place or velocity of bodies."""
    return np.mean([[getattr(one, what)[axis] for axis in (0, 1)] for one in block], axis=0)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("beyond", [10.0, 2.0, -1.0])
def test_a_block_slides_as_coulomb_says_or_not_at_all(model, beyond):
    """Way since damping ended, less v0 t, against a t^2 / 2; a = g sin(dip - phi) / cos(phi)."""
    yade.O.reset()
    dip = PHI + math.radians(beyond)
    slope, low = math.tan(dip), 0.25 * SIDE
    specimen = flexpm.Specimen.rectangle(SIDE, SIDE * (1.0 + slope), thickness=0.01, seed=3)
    cut = specimen.with_joints(
        {"slope": [[[-1e-3, low - 1e-3 * slope], [0.017, low + 0.017 * slope]]]}
    )
    rock = flexpm.materials.load(None, model).with_set(joint("slope", 1e12, FRICTION), model)
    built = flexpm.build(cut, rock, model, mesh="fan", dynamic=True, gravity=GRAVITY)

    def below(x, y):
        return y < low + x * slope - 1e-6

    rig = flexpm.PartRig(built)
    rig.hold(where=below)
    block = [yade.O.bodies[body].state for body in built.solver.bodyIds]
    block = [one for one in block if not below(one.pos[0], one.pos[1])]
    rig.settle(moving=beyond > 0.0, transits=5 if beyond > 0.0 else 100)
    built.run(1)
    down = np.array([-math.cos(dip), -math.sin(dip)])
    start, speed = middle_of(block, "pos"), middle_of(block, "vel") @ down
    steps = math.ceil(1e-3 / yade.O.dt)
    built.run(steps)
    time = steps * yade.O.dt
    way = (middle_of(block, "pos") - start) @ down
    if beyond < 0.0:
        assert abs(way) < 1e-9  # a micrometre is asked for
    else:
        gain = GRAVITY * math.sin(dip - PHI) / math.cos(PHI)
        assert way - speed * time == pytest.approx(0.5 * gain * time**2, rel=0.01)


def standing(beyond: float, ratio: float) -> tuple[flexpm.PartRig, list[int]]:
    """A block on a base that dips `beyond` degrees more than width over height; its bodies."""
    yade.O.reset()
    dip, width = math.atan(ratio) + math.radians(beyond), ratio
    along, up = np.array([math.cos(dip), math.sin(dip)]), np.array([-math.sin(dip), math.cos(dip)])
    places = ((0.0, -0.5 * width), (width, -0.5 * width), (width, 1.0), (0.0, 1.0))
    corners = [tuple(x * along + y * up) for x, y in places]
    sizes = (0.4 * width, 0.6 * width)
    specimen = flexpm.Specimen.polygon(corners, 0.1, diameters=sizes, seed=1)
    ends = [(-0.1 * width * along).tolist(), (1.1 * width * along).tolist()]
    rock = flexpm.materials.load(None, "rigid").with_set(joint("base", 1e13, ratio + 0.3), "rigid")
    # a hundred times the weight, so that it takes a tenth of the time
    options = {"dynamic": True, "gravity": 100.0 * GRAVITY}
    built = flexpm.build(specimen.with_joints({"base": [ends]}), rock, "rigid", **options)
    rig = flexpm.PartRig(built)
    rig.hold(where=lambda x, y: x * up[0] + y * up[1] < -0.15 * width)
    bodies = built.solver.bodyIds
    return rig, [one for one in bodies if middle_of([yade.O.bodies[one].state], "pos") @ up > 0.1]


def turned(bodies: list[int], before: np.ndarray) -> float:
    """Angle by which bodies have turned about their middle [degrees]."""
    before, now = (places - places.mean(axis=0) for places in (before, places_of(bodies)))
    sine = np.sum(before[:, 0] * now[:, 1] - before[:, 1] * now[:, 0])
    return math.degrees(math.atan2(sine, np.sum(before * now)))


def places_of(bodies: list[int]) -> np.ndarray:
    states = [yade.O.bodies[one].state for one in bodies]
    return np.array([[one.pos[axis] for axis in (0, 1)] for one in states])


@pytest.mark.long
@pytest.mark.parametrize("ratio", [0.25, 0.5])
def test_a_block_stands_up_to_the_dip_of_its_width_over_its_height(ratio):
    rig, block = standing(-0.5, ratio)
    before = places_of(block)
    rig.settle()
    settled = turned(block, before)
    rig.built.run(60_000)
    assert turned(block, before) == pytest.approx(settled, abs=0.05)
    assert settled < 0.1


@pytest.mark.parametrize("ratio", [0.25, 0.5])
def test_a_block_beyond_it_topples(ratio):
    rig, block = standing(0.5, ratio)
    before = places_of(block)
    failure("settle: missing reactions = .* held nodes at", rig.settle)
    for _ in range(60):
        if abs(turned(block, before)) > 5.0:
            break
        rig.built.run(2000)
    assert turned(block, before) > 5.0


def column(dimension: int) -> flexpm.Specimen:
    """Three times as high as it is wide."""
    if dimension == 2:
        return flexpm.Specimen.rectangle(0.012, 0.036, thickness=0.01, seed=1)
    return flexpm.Specimen.box(0.009, 0.009, 0.027, seed=1)


@pytest.mark.parametrize("hangs", [False, True])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("dimension", [2, pytest.param(3, marks=pytest.mark.long)])
def test_a_column_bears_its_weight(dimension, model, hangs):
    """It stands on a plate or hangs from its top; mean stress density g height / 2."""
    yade.O.reset()
    specimen = column(dimension)
    sizes = specimen.dimensions
    height = sizes["height"]
    rig = flexpm.PartRig(flexpm.build(specimen, model=model, dynamic=True, gravity=GRAVITY))
    if hangs:
        reach = 1e-9 if model == "flexible" else 0.6 * specimen.mean_diameter
        part = rig.hold(where=lambda *at: at[-1] > height - reach)
    else:
        part = rig.platen(0)
    rig.settle()
    *across, up = part.force
    volume = math.prod(sizes.values()) * (specimen.thickness if dimension == 2 else 1.0)
    weight = 2650.0 * volume * GRAVITY
    assert rig.weight == pytest.approx(weight, rel=1e-6)
    assert up == pytest.approx(weight, rel=1e-3)
    assert max(map(abs, across)) < 1e-3 * weight
    stress = rig.built.solver.balance()["mean_stress"][dimension - 1]
    bears = 0.5 * 2650.0 * GRAVITY * height
    if hangs and model == "rigid":
        # grains are held at centres up to 0.6 diameters below the top: none bears above these
        least = (1.0 - reach / height) ** 2
        assert least < stress / bears < 1.0
    else:
        assert stress == pytest.approx(bears if hangs else -bears, rel=0.02)
    assert rig.warnings == []
    energies = rig.built.solver.energies()
    fallen = -energies.pop("potential_energy")
    given = energies.pop("boundary_work") + energies.pop("initial_energy")
    assert sum(energies.values()) == pytest.approx(given + fallen, abs=5e-3 * fallen)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_grains_that_break_off_a_solid_fall_freely(model):
    """Mean velocity of the lower part gains g t; the run goes on."""
    yade.O.reset()
    weak = {"tensile_strength": 50.0, "tensile_fracture_energy": 1e-9}
    rock = flexpm.materials.load(None, model, solid=True).with_set(weak, model)
    built = flexpm.build(column(3), rock, model, dynamic=True, gravity=GRAVITY)
    rig = flexpm.PartRig(built)
    rig.hold(where=lambda x, y, z: z > 0.02)
    falling = [yade.O.bodies[body].state for body in built.solver.bodyIds]
    falling = [one for one in falling if one.pos[2] < 0.008]

    def speed() -> float:
        return float(np.mean([one.vel[2] for one in falling]))

    built.run(math.ceil(1e-3 / yade.O.dt))  # waves of the break have passed
    begun, steps = speed(), math.ceil(1e-3 / yade.O.dt)
    built.run(steps)
    assert begun - speed() == pytest.approx(GRAVITY * steps * yade.O.dt, rel=0.02)
    assert not rig.diverged
