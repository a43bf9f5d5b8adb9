# SPDX-License-Identifier: GPL-3.0-or-later
"""Triaxial test of a 3D core: a fluid on its lateral surface, rough platens, up to its peak."""

import flexpm

diameter, height, pressure = 0.012, 0.024, 4e6
core = flexpm.Specimen.cylinder(diameter, height, seed=1)
rig = flexpm.PartRig(flexpm.build(core, "augig3d-calibrated"))
base, top = (rig.platen(side, friction=0.1) for side in (0, 2))
still = rig.elastic({top: pressure})
stiffness = pressure * height / -still.displacement(top)[2]
rig.press(top, pressure)
rig.fluid(pressure, side=1)
middle = 0.5 * height
rig.gauge("lateral", (-0.5 * diameter, 0, middle), (0.5 * diameter, 0, middle), strain=True)
rig.drive(top, (0, 0, -1), against=base, area=top.area, length=height, strength=150e6)
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.9))  # fragments harden again later
rig.save("core_in_a_cell")
stress, strain = rig.record["axial_stress"], rig.record["axial_strain"]
peak = stress.argmax()
widening = rig.record["lateral"][peak] / strain[peak]
print(f"peak {stress[peak] / 1e6:.0f} MPa under {pressure / 1e6:g} MPa", *rig.warnings)
print(f"ratio of lateral to axial strain {widening:.2f} at the peak")
print(f"stiffness including the platens {stiffness / 1e9:.1f} GPa")
