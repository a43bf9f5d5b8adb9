# SPDX-License-Identifier: GPL-3.0-or-later
"""Three cycles of compression with increasing stress, then the complete curve."""

import flexpm  # isort: skip  (first: it makes YADE importable)

core = flexpm.Specimen.rectangle(0.02, 0.04, 0.02, seed=3)
rig = flexpm.rig(flexpm.build(core, "augig-table2-bilinear", "rigid"))
for top in (20e6, 40e6, 60e6):
    rig.stress_to(top)
    rig.stress_to(2e6)
rig.load(flexpm.Loading(kind="waiting"))
rig.save("cycles")
record = rig.record
lost = record["damage_energy"] + record["friction_energy"]
print(
    f"peak {record['axial_stress'].max() / 1e6:.1f} MPa, dissipated {lost[-1]:.3f} J", *rig.warnings
)
