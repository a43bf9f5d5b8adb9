# SPDX-License-Identifier: GPL-3.0-or-later
"""A disc split between jaws of three plates each along an arc of 24 degrees."""

import numpy as np

import flexpm

diameter, thickness, arc = 0.03, 0.015, np.radians(24.0)
disc = flexpm.Specimen.disc(diameter, thickness, seed=1)
rig = flexpm.PartRig(flexpm.build(disc, "augig-table2-bilinear", "rigid"))
sides = {}
for name, down in (("top", 0.5 * np.pi), ("bottom", -0.5 * np.pi)):
    angles = down + arc * np.array([-0.5, 0.0, 0.5])
    rim = 0.5 * diameter * np.column_stack([np.cos(angles), np.sin(angles)])
    sides[name] = [rig.support(place) for place in rim]
rig.drive(sides["top"], (0.0, -1.0), against=sides["bottom"])
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.5))
rig.save("jaws")
load = rig.record["load"].max()
splitting = 2.0 * load / (np.pi * diameter * thickness)
print(f"splitting strength {splitting / 1e6:.1f} MPa, of a flat load", *rig.warnings)
