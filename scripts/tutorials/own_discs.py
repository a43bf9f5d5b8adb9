# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 5: user-supplied discs. The grains become coarser from the bottom to the top.

Discs from any source, such as a packing of YADE or a table, become grains: each disc gets its
Laguerre cell.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/own_discs.py [FOLDER]
"""

import sys

import numpy as np

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "own-discs"
width, height = 0.03, 0.06

# 1. Rows of discs of scattered sizes, which increase with the height.
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

# 2. The cells of the discs fill the outline without gaps.
outline = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
specimen = flexpm.Specimen.from_discs(discs[:, :2], discs[:, 2], outline, thickness=0.02)
lower = specimen.centres[:, 1] < 0.5 * height
print(f"{np.count_nonzero(lower)} grains below the middle, {np.count_nonzero(~lower)} above")

# 3. In tension the specimen breaks where fewer contacts carry the load.
result = flexpm.run("tension", specimen, out=folder)
heights = np.array([crack.y for crack in result.cracks])
print(f"strength {result.peak_stress / 1e6:.1f} MPa")
print(
    f"half of the cracked points are above {1e3 * np.median(heights):.0f} of {1e3 * height:.0f} mm"
)
