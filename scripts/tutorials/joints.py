# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 7: joints. Strength of a rock with a plane of weakness, compared with the closed form.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/joints.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "joints")
width, height = 0.03, 0.06

# 1. The material has the law of the joint in addition to the law of the rock.
law = {
    "normal_stiffness": 1.8e13,
    "shear_stiffness": 5e12,
    "cohesion": 10e6,
    "tensile_strength": 5e6,
    "friction": 0.5,
    "tensile_fracture_energy": 20.0,
    "shear_fracture_energy": 1000.0,
}
rock = flexpm.materials.load("augig-table7")
rock = rock.with_set({f"joint.bedding.{key}": value for key, value in law.items()})

# 2. One packing, cut along a line through its middle, from side to side.
whole = flexpm.Specimen.rectangle(width, height, thickness=0.02, seed=2)
for dip in (40, 50, 60):
    slope = np.tan(np.radians(dip))
    rise = 0.5 * width * slope
    line = [(0.0, 0.5 * height - rise), (width, 0.5 * height + rise)]
    cut = whole.with_joints({"bedding": line})
    result = flexpm.run("uniaxial", cut, rock, "rigid", rate=0.5, out=folder / f"dip-{dip}")

    # The plane slides if the shear stress exceeds its cohesion and its friction.
    plane = 2 * law["cohesion"] / ((1 - law["friction"] / slope) * np.sin(2 * np.radians(dip)))
    found = result.peak_stress / 1e6
    told = f"strength {found:5.1f} MPa, plane of weakness {plane / 1e6:5.1f} MPa"
    print(f"dip {dip} degrees: {told}")
