# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: a block on an incline. It slides according to Coulomb's law, or is stable.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/incline.py
"""

import math

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

side, friction, gravity, time = 0.016, 0.5, 9.81, 1e-3
phi = math.degrees(math.atan(friction))
law = {"normal_stiffness": 1e12, "shear_stiffness": 1e12, "friction": friction}
rock = flexpm.materials.load().with_set({f"joint.slope.{key}": law[key] for key in law})

for dip in (phi - 1.0, phi + 2.0, phi + 10.0):
    slope = math.tan(math.radians(dip))
    line = [(-side, (0.25 - slope) * side), (2.0 * side, (0.25 + 2.0 * slope) * side)]
    specimen = flexpm.Specimen.rectangle(side, (1.0 + slope) * side, thickness=0.01, seed=3)
    yade.O.reset()
    built = flexpm.build(
        specimen.with_joints({"slope": [line]}), rock, mesh="fan", dynamic=True, gravity=gravity
    )
    rig = flexpm.PartRig(built)
    rig.hold(where=lambda x, y: y < 0.25 * side + slope * x - 1e-6)  # noqa: B023
    steep = dip > phi
    rig.settle(moving=steep, transits=5 if steep else 100)
    block = yade.O.bodies[built.solver.bodyIds[int(specimen.centres[:, 1].argmax())]].state
    start, speed = block.pos[0], -block.vel[0]
    steps = round(time / yade.O.dt)
    built.run(steps)
    way = (start - block.pos[0] - speed * steps * yade.O.dt) / math.cos(math.radians(dip))
    gain = gravity * math.sin(math.radians(dip - phi)) / math.cos(math.radians(phi))
    free = 0.5 * max(gain, 0.0) * time**2
    print(
        f"dip = phi {dip - phi:+.0f} degrees: {way * 1e9:8.2f} nm in 1 ms, Coulomb {free * 1e9:.2f}"
    )
