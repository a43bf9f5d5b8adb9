# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 5: own discs. Grains that grow coarser from the bottom to the top.

flexpm packs its specimens itself; discs from elsewhere, a packing of YADE's or a table, become
grains just as well: each disc gets its Laguerre cell.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/own_discs.py [FOLDER]
"""

import sys

import numpy as np

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "own-discs"
width, height = 0.03, 0.06

# 1. Rows of discs, each a quarter smaller or larger than its neighbours, larger further up.
rng = np.random.default_rng(7)
rows, y = [], 0.0
while y < height:
    size = 2e-3 + 3e-3 * y / height
    count = round(width / size)
    x = (np.arange(count) + rng.uniform(0.3, 0.7, count)) * width / count
    radius = 0.5 * size * rng.uniform(0.8, 1.0, count)
    rows.append(np.column_stack([x, np.full(count, y + 0.5 * size), radius]))
    y += size
discs = np.concatenate(rows)
discs = discs[discs[:, 1] < height]

# 2. The cells between them fill the outline without gaps.
outline = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
specimen = flexpm.Specimen.from_discs(discs[:, :2], discs[:, 2], outline, thickness=0.02)
lower = specimen.centres[:, 1] < 0.5 * height
print(f"{np.count_nonzero(lower)} grains below the middle, {np.count_nonzero(~lower)} above")

# 3. Pulled, it breaks where fewer contacts share the load.
result = flexpm.run("tension", specimen, out=folder)
heights = np.array([crack.y for crack in result.cracks])
print(f"strength {result.peak_stress / 1e6:.1f} MPa")
print(
    f"half of the cracked points lie above {1e3 * np.median(heights):.0f} of {1e3 * height:.0f} mm"
)
