# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 2: a strength envelope. One packing under three confining pressures.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/envelope.py [FOLDER]
"""

import sys

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "envelope"

# Rigid grains take a fraction of the time of flexible grains. Only the peaks are needed.
specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=1)
found = flexpm.compare(
    "biaxial", specimen, models=["rigid"], confinements=[0.0, 4e6, 8e6], stop_ratio=0.9, out=folder
)
pressures = [case.confinement for case in found.cases]
peaks = [result.peak_stress for result in found.results]
for pressure, peak in zip(pressures, peaks, strict=True):
    print(f"pressure {pressure / 1e6:.0f} MPa: peak {peak / 1e6:6.1f} MPa")

# Mohr-Coulomb is a line, Hoek-Brown a curve. Both are fitted to the peaks by least squares.
line = flexpm.strength.mohr_coulomb(pressures, peaks)
print(f"Mohr-Coulomb: c = {line.cohesion / 1e6:.1f} MPa, phi = {line.friction_angle:.0f} degrees")
curve = flexpm.strength.hoek_brown(pressures, peaks)
print(f"Hoek-Brown: sigma_ci {curve.sigma_ci / 1e6:.0f} MPa, m_i {curve.m_i:.1f}")
print(f"open {folder}/report.html")
