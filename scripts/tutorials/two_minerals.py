# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 4: stiffness, strength and cracks of a rock of two minerals.

The script reads the rock of two_minerals.toml and compares its Young's modulus with the bounds of
Reuss and Voigt. It compresses this rock and a rock without quartz on the same packing.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/two_minerals.py [FOLDER]
"""

from __future__ import annotations

import dataclasses
import sys
from pathlib import Path

import numpy as np

import flexpm
from flexpm.materials.mixing import mineral_materials

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else "two-minerals")

# 1. The rock, and a rock of feldspar only.
rock = flexpm.materials.load(Path(__file__).with_name("two_minerals.toml"))
feldspar = dataclasses.replace(rock, name="feldspar", minerals=())

# 2. One packing. The seed of the packing also determines which grains are quartz.
specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=4)

# 3. Young's modulus by a static solution. The modulus of the mixture is between two bounds.
moduli, shares = [], []
for kind, material in zip(rock.minerals, mineral_materials(rock), strict=True):
    moduli.append(flexpm.elastic(specimen, material)["youngs_modulus"])
    shares.append(kind.fraction)
    print(f"all {kind.name:9}  E = {moduli[-1] / 1e9:5.1f} GPa")
moduli, shares = np.array(moduli), np.array(shares)
mixture = flexpm.elastic(specimen, rock)["youngs_modulus"]
reuss, voigt = 1.0 / np.sum(shares / moduli), np.sum(shares * moduli)
bounds = f"between {reuss / 1e9:.1f} and {voigt / 1e9:.1f}"
print(f"both           E = {mixture / 1e9:5.1f} GPa, {bounds}")

# 4. Both rocks in compression, until shortly after their peaks, before nearly all points crack.
for material in (feldspar, rock):
    folder = FOLDER / material.name
    result = flexpm.run("uniaxial", specimen, material=material, stop_ratio=0.8, out=folder)
    print(f"{material.name:13}  strength {result.peak_stress / 1e6:.0f} MPa")

# 5. Cracks by the minerals on both sides. Quartz is stronger: few cracks are between quartz grains.
minerals = result.snapshot.grain_mineral
kinds = np.sort(minerals[result.snapshot.contact_grains], axis=1)
cracked = np.array([crack.contact for crack in result.cracks])
for pair in ((0, 0), (0, 1), (1, 1)):
    here = np.all(kinds == pair, axis=1)
    points = np.count_nonzero(here[result.snapshot.point_contact])
    share = np.count_nonzero(here[cracked]) / points
    names = " - ".join(rock.minerals[kind].name for kind in pair)
    print(f"{names:20}  {100 * share:4.1f} % of the points have cracked")
print(f"files: {FOLDER}/")
