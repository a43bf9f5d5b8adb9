#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Four-point bending: a custom test with a folder, from which a killed script resumes."""

import flexpm

length, height, thickness, span = 0.06, 0.012, 0.01, 0.048
specimen = flexpm.Specimen.rectangle(length, height, thickness, seed=1)
rig = flexpm.PartRig(flexpm.build(specimen, model="rigid"), out="beam", frames=10)
middle = 0.5 * length
rollers = [rig.support((middle + x * span, 0.0), pinned=x < 0.0) for x in (-0.5, 0.5)]
heads = [rig.support((middle + x * span, height)) for x in (-1.0 / 6.0, 1.0 / 6.0)]
section = thickness * height**2 / span  # ratio of the load to the stress at the bottom
rig.drive(heads, (0.0, -1.0), against=rollers, area=section, length=height)
rig.gauge("sag", (middle, 0.0), (middle, height))
rig.strain_to(2e-5)  # a small load, and unloading
rig.strain_to(0.0)
rig.load(flexpm.Loading(kind="waiting"))
print(f"bending strength {1e-6 * rig.record['axial_stress'].max():.1f} MPa")
