# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial: direct shear of a joint with a custom rig.

Two boxes fix the halves of a specimen of 48 mm x 24 mm. A platen presses on the upper half, and the
lower half is driven along the joint. The joint opens as it slides, because it dilates.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/direct_shear.py [FOLDER]
"""

import sys

import flexpm  # isort: skip  (first: it makes YADE importable)
import matplotlib.pyplot as plt

width, height, pressure = 0.048, 0.024, 2e6
law = {
    **{"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "cohesion": 1e6, "friction": 0.6},
    **{"shear_fracture_energy": 20.0, "dilation_angle": 15.0, "dilation_slip": 60e-6},
}
rock = flexpm.materials.load("augig-table7").with_set(
    {f"joint.teeth.{key}": value for key, value in law.items()}
)
specimen = flexpm.Specimen.rectangle(width, height, thickness=0.02, seed=1)
cut = specimen.with_joints({"teeth": [(0.0, height / 2), (width, height / 2)]})
rig = flexpm.PartRig(flexpm.build(cut, rock), kind="shear")

# Parts: both sides of each half, the bottom, and the platen on top.
lower, upper = (
    [rig.support((x, y * height), 0.4 * height, bonded=True) for x in (0.0, width)]
    for y in (0.25, 0.75)
)
rig.platen(0, bonded=True)
lid = rig.platen(2)
rig.drive(lower, (1, 0), against=upper, area=width * 0.02, strength=law["cohesion"])
rig.gauge("slip", (width / 2, 0.6 * height), (width / 2, 0.4 * height), along=(1, 0))
rig.displacement_of("dilation", lid, (0, 1))

# The normal pressure first, then a displacement of the lower half of 0.1 mm.
rig.press(lid, pressure)
rig.load(flexpm.Loading(kind="waiting", max_strain=1e-4, stop_ratio=0.0))

slip, stress, dilation = (rig.record[name] for name in ("slip", "axial_stress", "dilation"))
print(f"peak {stress.max() / 1e6:.2f} MPa, c + mu sigma_n {(1e6 + 0.6 * pressure) / 1e6:.2f} MPa")
print(f"residual {stress[-1] / 1e6:.3f} MPa, mu sigma_n {0.6 * pressure / 1e6:.3f} MPa")
print(f"opened by {dilation[-1] * 1e6:.1f} um", *rig.warnings)
rows = (1, "shear stress [MPa]", stress / 1e6), (2, "dilation [µm]", 1e6 * dilation)
for row, name, values in rows:
    plt.subplot(1, 2, row, xlabel="shear displacement [µm]", title=name).plot(1e6 * slip, values)
plt.savefig(f"{sys.argv[1] if len(sys.argv) > 1 else '.'}/direct_shear.png")
