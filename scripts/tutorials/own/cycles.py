# SPDX-License-Identifier: GPL-3.0-or-later
"""Three cycles of compression, each higher than the last one, then the whole curve."""

import flexpm  # isort: skip  (first: it tells Python where YADE is)

core = flexpm.Specimen.rectangle(0.02, 0.04, 0.02, seed=3)
rig = flexpm.rig(flexpm.build(core, "augig-table2-bilinear", "rigid"))
for top in (20e6, 40e6, 60e6):
    rig.stress_to(top)
    rig.stress_to(2e6)
rig.load(flexpm.Loading(kind="waiting"))
rig.save("cycles")
record = rig.record
lost = record["damage_energy"] + record["friction_energy"]
print(f"peak {record['axial_stress'].max() / 1e6:.1f} MPa, lost {lost[-1]:.3f} J", *rig.warnings)
