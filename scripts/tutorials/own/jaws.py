# SPDX-License-Identifier: GPL-3.0-or-later
"""Brazilian test with the curved jaws of the ISRM, whose radius is 1.5 times the disc radius."""

import numpy as np

import flexpm

diameter, thickness = 0.03, 0.015
disc = flexpm.Specimen.disc(diameter, thickness, seed=1)
rig = flexpm.PartRig(flexpm.build(disc, "augig-table2-bilinear", "rigid"))
# smooth jaws would let the disc roll between them
top = rig.jaw((0.0, 0.5 * diameter), 0.75 * diameter, friction=0.3)
bottom = rig.jaw((0.0, -0.5 * diameter), 0.75 * diameter, friction=0.3)
rig.contact_angle_of("contact_angle", top)
rig.drive(top, (0.0, -1.0), against=bottom)
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.5))
rig.save("jaws")
load, angle = rig.record["load"], rig.record["contact_angle"]
splitting = 2.0 * load.max() / (np.pi * diameter * thickness)
at_peak = np.degrees(angle[load.argmax()])
print(f"splitting strength {splitting / 1e6:.1f} MPa by 2 P / (pi D t)", *rig.warnings)
print(f"contact angle {at_peak:.0f} degrees at the peak")
