# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 1: the first test. Uniaxial compression of a small specimen of the paper's granite.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/first_test.py [FOLDER]
"""

import sys

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "first-test"

# 1. Grains: about a hundred in a rectangle of 20 mm x 40 mm, 80 mm thick.
specimen = flexpm.Specimen.rectangle(width=0.02, height=0.04, thickness=0.08, seed=1)
counts = specimen.statistics()
print(f"{counts['grains']} grains, {counts['contacts']} contacts")

# 2. Stiffness without a simulation, by one static solution of the bonded grains.
found = flexpm.elastic(specimen)
print(f"E = {found['youngs_modulus'] / 1e9:.1f} GPa by a static solution")

# 3. The test. Its folder has the results, the record, the cracks and the figures.
result = flexpm.run("uniaxial", specimen, out=folder)
print(f"E = {result.youngs_modulus / 1e9:.1f} GPa in the test, status {result.status}")
print(
    f"strength {result.peak_stress / 1e6:.0f} MPa at a strain of {100 * result.peak_strain:.2f} %"
)
print(f"{result.tensile_cracks} points cracked in tension, {result.shear_cracks} in shear")
print(f"open {folder}/report.html")
