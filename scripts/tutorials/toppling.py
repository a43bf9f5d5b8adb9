# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: toppling of a block on an inclined base. Its width is half of its height.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/toppling.py
"""

import math

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

width, height, thickness = 0.5, 1.0, 0.1
law = {"normal_stiffness": 1e13, "shear_stiffness": 1e13, "friction": 0.8}
rock = flexpm.materials.load(None, "rigid")
rock = rock.with_set({f"joint.base.{key}": law[key] for key in law}, "rigid")
limit = math.degrees(math.atan(width / height))

for dip in (limit - 0.5, limit + 0.5):
    angle = math.radians(dip)
    along = np.array([math.cos(angle), math.sin(angle)])
    up = np.array([-math.sin(angle), math.cos(angle)])
    places = ((0.0, -0.25), (width, -0.25), (width, height), (0.0, height))
    corners = [tuple(x * along + y * up) for x, y in places]
    specimen = flexpm.Specimen.polygon(corners, thickness, diameters=(0.2, 0.3), seed=1)
    base = [tuple(-0.05 * along), tuple((width + 0.05) * along)]
    yade.O.reset()
    # with a hundred times the weight the motion takes a tenth of the time
    built = flexpm.build(
        specimen.with_joints({"base": [base]}), rock, "rigid", dynamic=True, gravity=981.0
    )
    rig = flexpm.PartRig(built)
    rig.hold(where=lambda x, y: x * up[0] + y * up[1] < -0.08)  # noqa: B023
    try:
        rig.settle()
        print(f"dip = {dip:.2f} degrees: stable, with a weight of {rig.weight:.0f} N")
    except flexpm.SimulationError as error:
        print(f"dip = {dip:.2f} degrees: {error}")
        top = yade.O.bodies[built.solver.bodyIds[int((specimen.centres @ up).argmax())]].state
        x, y = top.pos[0], top.pos[1]
        while math.hypot(top.pos[0] - x, top.pos[1] - y) < math.radians(5.0) * height:
            built.run(1000)
        print(f"  topples by 5 degrees after {yade.O.iter * yade.O.dt:.3f} s")
