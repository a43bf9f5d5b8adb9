# SPDX-License-Identifier: GPL-3.0-or-later
"""A rock with two sets of joints: strengths of three generated networks."""

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade

sets = {"bedding": (60.0, 0.015, 30.0), "cross": (40.0, 0.010, 110.0)}  # 1/m, m, degrees
network = {
    name: {
        "intensity": intensity,
        "length": {"law": "constant", "value": length},
        "orientation": {"law": "constant", "angle": angle},
    }
    for name, (intensity, length, angle) in sets.items()
}
law = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.5, "cohesion": 5e6}
rock = flexpm.materials.load("augig-table2-bilinear")
for name in sets:
    rock = rock.with_set({f"joint.{name}.{key}": value for key, value in law.items()})
whole = flexpm.Specimen.rectangle(0.03, 0.06, 0.02, seed=1)
for seed in (1, 2, 3):
    core = whole.with_network({"set": network}, seed=seed)
    yade.O.reset()
    rig = flexpm.rig(flexpm.build(core, rock, "rigid"))
    rig.load(flexpm.Loading(kind="waiting"))
    rig.save(f"joint_sets/{seed}")
    peak = rig.record["axial_stress"].max()
    print(f"network {seed}: {peak / 1e6:.1f} MPa", *rig.warnings)
