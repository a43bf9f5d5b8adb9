# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 14: a 3D core with an inclined joint, compared with the single plane of weakness.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/jointed_core.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "jointed-core")
diameter, height, confinement = 0.012, 0.024, 5e6

# 1. The material has the law of the joint: friction without cohesion.
law = {
    "normal_stiffness": 1e13,
    "shear_stiffness": 5e12,
    "cohesion": 0.0,
    "tensile_strength": 0.0,
    "friction": 0.3,
}
rock = flexpm.materials.load("augig3d-calibrated", solid=True)
rock = rock.with_set({f"joint.fault.{key}": value for key, value in law.items()})

# 2. One packing, cut along a whole plane through its middle. The axis of the core is x = y = 0.
core = flexpm.Specimen.cylinder(diameter, height, seed=1)
for dip in (40, 50, 60):
    plane = {"point": (0.0, 0.0, 0.5 * height), "dip": dip, "dip_direction": 90}
    cut = core.with_joints({"fault": plane})
    deviation = cut.joint_deviations()["fault"]
    result = flexpm.run(
        "triaxial",
        cut,
        rock,
        confinement=confinement,
        rate=0.5,
        max_strain=3.5e-4,
        out=folder / f"dip-{dip}",
    )

    # 3. The joint slides, and the axial stress is nearly constant.
    slides = result.curve["axial_strain"] > 2.5e-4
    found = np.mean(result.curve["axial_stress"][slides]) - confinement
    slope = np.tan(np.radians(dip))
    share = (1.0 - law["friction"] / slope) * np.sin(2.0 * np.radians(dip))
    theory = 2.0 * law["friction"] * confinement / share
    told = f"{found / 1e6:.2f} MPa, plane of weakness {theory / 1e6:.2f} MPa"
    print(f"dip {dip} degrees: deviation {deviation:g} m, sliding at {told}")
