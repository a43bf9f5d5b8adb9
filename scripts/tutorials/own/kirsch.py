# SPDX-License-Identifier: GPL-3.0-or-later
"""A borehole in a square under two pressures: stress at its wall and Kirsch's solution."""

import numpy as np

import flexpm

side, radius, largest, smallest = 0.05, 0.0025, 20e6, 10e6
angles = np.linspace(0.0, 2 * np.pi, 40, endpoint=False)
hole = 0.5 * side + radius * np.column_stack([np.cos(angles), np.sin(angles)])
square = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
rock = flexpm.materials.load("augig-table7").with_set("normal_stiffness=2e15")
specimen = flexpm.Specimen.polygon(square, 0.01, holes=[hole], seed=1)
rig = flexpm.PartRig(flexpm.build(specimen, rock))
floor, right, top, left = (rig.platen(number) for number in range(4))
rig.press({right: smallest, top: smallest})
rig.drive(top, (0.0, -1.0), against=floor, area=side * 0.01, length=side)
rig.stress_to(largest)
state = rig.built.snapshot()
rim = 0.5 * side + 1.1 * radius * np.column_stack([np.cos(angles), np.sin(angles)])
stress = state.stress_at(rim).polar((0.5 * side, 0.5 * side)).hoop
mean, half, far = 0.5 * (largest + smallest), 0.5 * (largest - smallest), 1.0 / 1.1**2
for place, name, sign in ((0, "at the side", 1.0), (10, "above", -1.0)):
    kirsch = mean * (1.0 + far) + sign * half * (1.0 + 3.0 * far**2)
    print(f"hoop stress {name}: {-stress[place] / 1e6:.1f} MPa, Kirsch {kirsch / 1e6:.1f} MPa")
rig.save("kirsch")
