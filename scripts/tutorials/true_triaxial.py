# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 12: true triaxial compression of a box. The larger lateral pressure increases.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/true_triaxial.py [FOLDER]
"""

import sys
from pathlib import Path

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "true-triaxial")

box = flexpm.Specimen.box(width=0.012, depth=0.012, height=0.024, seed=1)
for second in (4e6, 8e6, 12e6):
    result = flexpm.run(
        "triaxial",
        box,
        "augig3d-calibrated",
        confinement=4e6,  # on the sides across x
        second_confinement=second,  # on front and back, across y
        stop_ratio=0.9,
        out=folder / f"{second / 1e6:.0f}MPa",
    )
    print(f"pressures 4 and {second / 1e6:2.0f} MPa: strength {result.peak_stress / 1e6:.0f} MPa")
print(f"open {folder}/12MPa/report.html")
