# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 11: a thin section of two minerals, and weak boundaries between them.

The script generates the labels of a section as in an image of grains, makes a specimen of them, and
compresses it twice: with boundaries between feldspar and quartz by the rule of mixing, and weaker.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/thin_section.py [FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

import flexpm

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else "thin-section")

# 1. Labels: each pixel has the index of its grain, every third grain is quartz. For a real section
#    in a PNG file use: flexpm specimen image FILE --pixel 2e-4 --phases FILE.
draw = np.random.default_rng(1)
rows, columns = np.mgrid[:200, :100]
places = draw.random((110, 2)) * (200, 100)
labels = cKDTree(places).query(np.column_stack((rows.ravel(), columns.ravel())))[1]
labels = labels.reshape(rows.shape)
minerals = {grain: int(grain % 3 == 0) for grain in range(len(places))}

# 2. The specimen: boundaries are smoothed, and the grains keep the areas of their pixels.
specimen = flexpm.Specimen.from_labels(
    labels, pixel=2e-4, thickness=0.08, minerals=minerals, edge=2e-3
)
quartz = specimen.tessellation.cell_areas[specimen.minerals == 1].sum()
drawn = np.count_nonzero(labels % 3 == 0) * 2e-4**2
print(
    f"{specimen.grains.max() + 1} grains, quartz {1e6 * quartz:.2f} mm2, "
    f"in the image {1e6 * drawn:.2f} mm2"
)

# 3. The rock, and the rock with weak boundaries between its minerals. A factor of a strength lowers
#    the fracture energy by its square, so that weak and strong boundaries are equally brittle.
rock = flexpm.materials.load(Path(__file__).with_name("two_minerals.toml"))
pair = "interface.feldspar/quartz"
weak = rock.with_set([f"{pair}.factor.{key}=0.35" for key in ("cohesion", "tensile_strength")])

# 4. Both in compression, until shortly after their peaks.
for name, material in (("as mixed", rock), ("weak", weak)):
    folder = FOLDER / name.replace(" ", "-")
    result = flexpm.run("uniaxial", specimen, material=material, stop_ratio=0.8, out=folder)
    print(f"{name:9} strength {result.peak_stress / 1e6:.0f} MPa")
    for two, modes in result.cracks_by_pair.items():
        print(f"          {two:19} {sum(modes.values())} points cracked")
print(f"files: {FOLDER}/")
