# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 12: a triaxial envelope. One core under three pressures on its lateral surface.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/triaxial_envelope.py [FOLDER]
"""

import sys

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "triaxial-envelope"

core = flexpm.Specimen.cylinder(0.015, 0.030, seed=1)
found = flexpm.compare(
    "triaxial",
    core,
    ["flexible"],
    "augig3d-calibrated",
    confinements=[0.0, 2e6, 4e6],
    stop_ratio=0.9,
    out=folder,
)
pressures = [case.confinement for case in found.cases]
peaks = [result.peak_stress for result in found.results]
for pressure, peak in zip(pressures, peaks, strict=True):
    print(f"pressure {pressure / 1e6:.0f} MPa: peak {peak / 1e6:6.1f} MPa")
line = flexpm.strength.mohr_coulomb(pressures, peaks)
print(f"c = {line.cohesion / 1e6:.1f} MPa, phi = {line.friction_angle:.0f} degrees")
print(f"open {folder}/report.html")
