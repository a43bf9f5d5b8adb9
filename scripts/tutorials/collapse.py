# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 16: a column of grains without bonds collapses under gravity and comes to rest.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/collapse.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

from flexpm.report.outside import draw_solid

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
width, depth, height, floor = 0.07, 0.055, 0.025, 0.005  # [m]

# 1. A packing fills a box. Grains beside the column and above the floor are removed.
box = flexpm.Specimen.box(width, depth, height, diameters=(4e-3, 5e-3), seed=1)
x, y, z = box.centres.T
beside = (np.abs(x - 0.5 * width) > 0.01) | (np.abs(y - 0.5 * depth) > 0.008)
specimen = box.without_grains((z > floor) & beside)
column = specimen.centres[:, 2] > floor

# 2. The grains are rigid and have no bonds. A small contact stiffness allows a large time step.
soft = {"normal_stiffness": 1e9, "friction": 0.3, "tensile_strength": 1e4, "cohesion": 1e4}
material = flexpm.materials.load("augig3d-calibrated-rigid", "rigid", solid=True)
built = flexpm.build(
    specimen,
    material.with_set(soft, "rigid"),
    "rigid",
    bonded=False,
    dynamic=True,
    gravity=9.81,
    damping=0.3,
)

# 3. The grains of the floor are fixed.
rig = flexpm.PartRig(built)
rig.hold(where=lambda x, y, z: z < floor)
built.set_masses()

ids = [built.solver.bodyIds[grain] for grain in np.flatnonzero(column)]
for _ in range(4):
    built.run(round(0.1 / yade.O.dt))
    places = np.array([yade.O.bodies[one].state.pos for one in ids])
    left = places[places[:, 2] > 0.0]
    speed = np.linalg.norm([yade.O.bodies[one].state.vel for one in ids], axis=1)
    pressing = np.count_nonzero(built.solver.pairs()["normal_force"])
    print(
        f"{len(left)} of {len(ids)} grains on the floor, {1e3 * np.ptp(left[:, 0]):.1f} mm wide, "
        f"highest centre {1e3 * left[:, 2].max():.1f} mm, "
        f"mean speed {1e3 * speed[places[:, 2] > 0.0].mean():.1f} mm/s, {pressing} pairs press"
    )

draw_solid(
    folder / "collapse.png", built.snapshot(), "A column of grains without bonds after 0.4 s"
)
