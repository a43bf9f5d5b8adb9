# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 3: direct and indirect tension of a rectangle and of a disc.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/brazilian.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import flexpm

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "tension")

bar = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.02, seed=1)
disc = flexpm.Specimen.disc(0.03, thickness=0.02, seed=1)
direct = flexpm.run("tension", bar, out=folder / "direct")
split = flexpm.run("brazilian", disc, out=folder / "indirect")

print(f"direct tension   {direct.peak_stress / 1e6:5.1f} MPa")
print(f"Brazilian test   {split.peak_stress / 1e6:5.1f} MPa, 2 P / (pi D t)")
ratio = flexpm.strength.tensile_ratio(direct.peak_stress, split.peak_stress)
print(f"ratio of direct to indirect strength {ratio:.2f}")

# A disc that splits cracks along the line between the plates.
positions = np.array([crack.x for crack in split.cracks])
near = np.abs(positions - disc.centres[:, 0].mean()) < 0.03 / 6
print(f"{100 * near.mean():.0f} % of the cracked points are in the middle third")
