# SPDX-License-Identifier: GPL-3.0-or-later
"""Punch-through shear of the two bridges between notches from above and below."""

import flexpm  # isort: skip  (first: it makes YADE importable)

width, height, thickness, depth = 0.03, 0.02, 0.01, 0.005
places = [0.01, 0.02]
notches = [[(x, 0.0), (x, depth)] for x in places]
notches += [[(x, height - depth), (x, height)] for x in places]
block = flexpm.Specimen.rectangle(width, height, thickness, seed=1)
cut = block.with_joints({"notch": notches})
rock = flexpm.materials.load("augig-table2-bilinear").with_set("joint.notch.open=true")
rig = flexpm.PartRig(flexpm.build(cut, rock, "rigid"))
inner = places[1] - places[0]
platen = rig.support((0.5 * width, height), length=0.9 * inner, pinned=True)
supports = [rig.support((x, 0.0), length=0.009) for x in (0.005, width - 0.005)]
rig.drive(platen, (0.0, -1.0), against=supports, area=2 * (height - 2 * depth) * thickness)
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.5))
rig.save("punch_through")
print(f"shear strength {rig.record['axial_stress'].max() / 1e6:.1f} MPa", *rig.warnings)
