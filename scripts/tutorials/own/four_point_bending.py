# SPDX-License-Identifier: GPL-3.0-or-later
"""Four-point bending of a beam: bending strength, and the strain of its lowest fibre."""

import flexpm  # isort: skip  (first: it makes YADE importable)

length, height, thickness, span, inner = 0.06, 0.012, 0.01, 0.048, 0.016
beam = flexpm.Specimen.rectangle(length, height, thickness, seed=1)
rig = flexpm.PartRig(flexpm.build(beam, "augig-table2-bilinear"))
rollers = [rig.support((0.5 * (length + s * span), 0.0)) for s in (-1, 1)]
# only one pin is pinned: two pinned parts would fix the length of the fibre between them
pins = [rig.support((0.5 * (length + s * inner), height), pinned=s < 0) for s in (-1, 1)]
rig.gauge("fibre", (0.5 * (length - inner), 0.0), (0.5 * (length + inner), 0.0), strain=True)
rig.drive(pins, (0.0, -1.0), against=rollers)
rig.load(flexpm.Loading(kind="waiting", stop_ratio=0.5))
rig.save("four_point_bending")

load, fibre = rig.record["load"], rig.record["fibre"]
peak = load.argmax()
stress = 3 * load * (span - inner) / (2 * thickness * height**2)
half = abs(load[:peak] - 0.5 * load[peak]).argmin()
print(f"bending strength {stress[peak] / 1e6:.1f} MPa")
print(f"strain of the lowest fibre at half the load {fibre[half] * 1e6:.0f} um/m", *rig.warnings)
