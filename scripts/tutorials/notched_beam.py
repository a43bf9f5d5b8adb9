# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: bending of a notched beam with a custom rig.

A beam of 112 mm x 24 mm with a notch of 10 mm is on two rollers with a span of 96 mm. A pin loads
its middle until the load has dropped to a fifth of its peak. A gauge measures the notch opening.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/notched_beam.py
"""

import flexpm  # isort: skip  (first: it makes YADE importable)

from flexpm.kinds.toughness import bending_toughness

width, height, span, notch, thickness = 0.112, 0.024, 0.096, 0.010, 0.08
specimen = flexpm.Specimen.rectangle(width, height, thickness, seed=3)
cut = specimen.with_joints({"notch": [[width / 2, 0.0], [width / 2, notch]]})
material = flexpm.materials.load("augig-table2-bilinear").with_set("joint.notch.open=true")
rig = flexpm.PartRig(flexpm.build(cut, material, model="rigid"))

rollers = [rig.support((x, 0.0)) for x in ((width - span) / 2, (width + span) / 2)]
pin = rig.support((width / 2, height), pinned=True)
rig.gauge("cmod", (width / 2 - 0.003, 0.0), (width / 2 + 0.003, 0.0))
rig.drive([pin], (0.0, -1.0), against=rollers)
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.2))

record = rig.record
peak = record["load"].argmax()
sizes = {"span": span, "height": height, "thickness": thickness, "notch": notch}
toughness = bending_toughness(record["load"][peak], **sizes)
print(
    f"peak load {record['load'][peak]:.0f} N, the notch open by {record['cmod'][peak] * 1e6:.1f} um"
)
print(f"fracture toughness {toughness / 1e6:.2f} MPa m^0.5")
print(f"at the end the notch is open by {record['cmod'][-1] * 1e6:.0f} um")
print("reactions", *(f"{roller.force[1]:.0f} N" for roller in rollers), *rig.warnings)
