# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliding of a block under its weight on a joint with a dip of 35 degrees."""

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

width, height, dip, friction, gravity = 0.02, 0.02, np.radians(35.0), 0.5, 9.81
rise = width * np.tan(dip)
ends = [(x, 0.25 * height + x * np.tan(dip)) for x in (-0.001, width + 0.001)]
block = flexpm.Specimen.rectangle(width, height + rise, 0.01, seed=3)
law = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": friction}
rock = flexpm.materials.load("augig-table7")
rock = rock.with_set({f"joint.slope.{key}": value for key, value in law.items()})
cut = block.with_joints({"slope": [ends]})
built = flexpm.build(cut, rock, "rigid", dynamic=True, gravity=gravity)
rig = flexpm.PartRig(built)
rig.hold(where=lambda x, y: y < ends[0][1] + (x - ends[0][0]) * np.tan(dip) - 1e-6)
rig.settle(moving=True)

before = built.snapshot().positions
start = yade.O.iter
built.run(int(0.002 / yade.O.dt))
top = before[:, 1] > height
way = np.linalg.norm((built.snapshot().positions - before)[top].mean(axis=0))
time = (yade.O.iter - start) * yade.O.dt
print(f"slid {way * 1e6:.2f} um in {time * 1e3:.1f} ms")
rig.save("incline")
