# SPDX-License-Identifier: GPL-3.0-or-later
"""Three-point bending of a beam with a hole next to its middle."""

import numpy as np

import flexpm

length, height, radius = 0.06, 0.016, 0.003
angles = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
hole = [0.5 * length + 0.006, 0.006] + radius * np.column_stack([np.cos(angles), np.sin(angles)])
outline = [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)]
beam = flexpm.Specimen.polygon(outline, 0.01, holes=[hole], seed=1)
rig = flexpm.PartRig(flexpm.build(beam, "augig-table2-bilinear", "rigid"))
rollers = [rig.support((x, 0.0)) for x in (0.1 * length, 0.9 * length)]
pin = rig.support((0.5 * length, height), pinned=True)
rig.drive(pin, (0.0, -1.0), against=rollers)
rig.load(flexpm.Loading(kind="waiting", rate=0.5, stop_ratio=0.5))
rig.save("beam_with_hole")
print(f"peak load {rig.record['load'].max():.0f} N", *rig.warnings)
