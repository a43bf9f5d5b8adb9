# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 12: a first core. Uniaxial compression of a small cylinder of polyhedral grains.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/first_core.py [FOLDER]
"""

import sys

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "first-core"

# 1. Grains of 3 mm in a core of 15 mm x 30 mm. The report warns that these are few grains.
core = flexpm.Specimen.cylinder(0.015, 0.030, seed=1)
print(f"{core.statistics()['grains']} grains")

# 2. Stiffness by a static solution, then the test, with strengths that were calibrated in 3D.
granite = "augig3d-calibrated"
solved = flexpm.elastic(core, granite)["youngs_modulus"]
result = flexpm.run("uniaxial", core, granite, out=folder)
tested = result.youngs_modulus
print(f"E = {solved / 1e9:.1f} GPa by a static solution, {tested / 1e9:.1f} GPa in the test")
print(f"strength {result.peak_stress / 1e6:.0f} MPa, status {result.status}")

# 3. The values that a laboratory reports for a core.
print(f"crack initiation at {result.crack_initiation_stress / result.peak_stress:.2f} of the peak")
print(f"{result.fragments} fragments")
print(f"open {folder}/report.html and rotate the core")
