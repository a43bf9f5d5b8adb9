# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: uniaxial compression under control of the lateral strain.

A brittle rock releases more elastic energy than its cracks dissipate. The ends therefore move back
while the lateral strain grows. Under control of the axial strain the specimen collapses at its
peak.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/class_two.py [FOLDER]
"""

import sys

import flexpm  # isort: skip  (first: it makes YADE importable)
import matplotlib.pyplot as plt

specimen = flexpm.Specimen.rectangle(0.04, 0.08, thickness=0.08, seed=1)
_, (axial, lateral) = plt.subplots(1, 2, figsize=(8, 3.6), sharey=True, layout="constrained")
for control in ("axial", "lateral"):
    result = flexpm.run("uniaxial", specimen, "augig-table2-brittle", control=control)
    curve = result.curve
    stress, strain = 1e-6 * curve["axial_stress"], 1e3 * curve["axial_strain"]
    axial.plot(strain, stress, lw=1.2, label=f"control of the {control} strain")
    lateral.plot(1e3 * curve["lateral_strain"], stress, lw=1.2)
    peak = stress.argmax()
    print(
        f"{control}: peak {stress[peak]:.1f} MPa at {strain[peak]:.2f} permille, "
        f"end at {strain[-1]:.2f}, {len(curve)} rows, {result.status}"
    )
axial.set(xlabel="axial strain [‰]", ylabel="axial stress [MPa]")
axial.legend(loc="upper left", fontsize=8)
lateral.set(xlabel="lateral strain [‰]", xlim=(0.0, 4.0))
plt.savefig(f"{sys.argv[1] if len(sys.argv) > 1 else '.'}/class_two.png")
