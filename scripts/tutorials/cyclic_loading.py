# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: cyclic loading. Each cycle has a larger strain and returns to a tenth of its strain.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/cyclic_loading.py
"""

import flexpm  # isort: skip  (first: it makes YADE importable)

specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=3)
rig = flexpm.rig(flexpm.build(specimen, model="rigid"))
for cycle in range(1, 4):
    top = 0.25 * cycle * rig.reference_strain
    rig.strain_to(top)
    largest = rig.stress
    rig.strain_to(0.1 * top)
    lost = rig.record["damage_energy"][-1] + rig.record["friction_energy"][-1]
    print(f"cycle {cycle}: {largest / 1e6:.1f} MPa, {lost * 1e3:.3f} mJ dissipated until now")
