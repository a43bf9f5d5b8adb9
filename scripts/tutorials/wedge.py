# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 15: a wedge on two joints slides under gravity, or is stable.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/wedge.py
"""

from dataclasses import replace

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

side, gravity, time = 0.01, 9.81, 1e-3
middle = np.full(3, 0.5 * side)
planes = {"a": (60.0, 35.0), "b": (50.0, 145.0)}  # dip and dip direction


def normal(dip, direction):
    """Upper unit normal of a plane; x is east, y north, z up."""
    down, around = np.radians([dip, direction])
    return np.array([np.sin(down) * np.sin(around), np.sin(down) * np.cos(around), np.cos(down)])


# 1. The factor of safety of Hoek and Bray is wedge_factor * tan(friction) / tan(plunge).
first, second = (normal(*angles) for angles in planes.values())
line = np.cross(first, second)
line *= -np.sign(line[2]) / np.linalg.norm(line)  # the intersection, downwards
plunge = -np.arcsin(line[2])
across = np.cross([0.0, 0.0, 1.0], line)
bisector = first + second
tilt = np.arccos(abs(bisector @ across) / np.linalg.norm(bisector) / np.linalg.norm(across))
opening = np.pi - np.arccos(first @ second)
wedge_factor = np.sin(tilt) / np.sin(0.5 * opening)
limit = np.arctan(np.tan(plunge) / wedge_factor)
print(f"the wedge slides below a friction angle of {np.degrees(limit):.2f} degrees")

# 2. One grain fills a box. The joints cut it into a wedge and three parts that are fixed.
block = flexpm.Specimen.from_spheres([(*middle, 0.5 * side)], width=side, depth=side, height=side)
joints = {
    name: {"point": tuple(middle), "dip": dip, "dip_direction": direction}
    for name, (dip, direction) in planes.items()
}
cut = block.with_joints(joints)
from_middle = cut.centres - middle
(wedge,) = np.flatnonzero((from_middle @ first > 0.0) & (from_middle @ second > 0.0))


def is_below(x, y, z):
    """Whether points are below one of the joints."""
    points = np.column_stack((x, y, z)) - middle
    return np.minimum(points @ first, points @ second) < -1e-6


# 3. The material was calibrated for grains of another size; only its joints matter here.
rock = replace(flexpm.materials.load("augig3d-calibrated", solid=True), made_for=None)
law = {"normal_stiffness": 1e12, "shear_stiffness": 1e12, "cohesion": 0.0, "tensile_strength": 0.0}

for beyond in (1.0, -1.0, -3.0):
    friction = np.tan(limit + np.radians(beyond))
    laws = {f"joint.{name}.{key}": law[key] for name in planes for key in law}
    laws |= {f"joint.{name}.friction": float(friction) for name in planes}
    yade.O.reset()
    built = flexpm.build(cut, rock.with_set(laws), dynamic=True, gravity=gravity)
    rig = flexpm.PartRig(built)
    rig.hold(where=is_below)
    slides = beyond < 0.0
    rig.settle(moving=slides, transits=5 if slides else 100)
    body = yade.O.bodies[built.solver.bodyIds[int(wedge)]].state
    start, speed = np.array(body.pos), np.array(body.vel)
    steps = round(time / yade.O.dt)
    built.run(steps)
    slip = line @ (np.array(body.pos) - start - speed * steps * yade.O.dt)

    # 4. The wedge accelerates by its weight along the intersection minus the friction.
    gain = gravity * (np.sin(plunge) - np.cos(plunge) * wedge_factor * friction)
    free = 0.5 * max(gain, 0.0) * time**2
    print(
        f"friction angle = limit {beyond:+.0f} degrees: slip {slip * 1e9:7.2f} nm in 1 ms, "
        f"rigid wedge {free * 1e9:.2f} nm"
    )
