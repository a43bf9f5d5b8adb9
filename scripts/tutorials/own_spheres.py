# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 12: user-supplied spheres. The grains of a box become coarser from bottom to top.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/own_spheres.py [FOLDER]
"""

import sys

import numpy as np

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "own-spheres"
width, height = 0.012, 0.024

# 1. Layers of spheres near the points of a grid. Their sizes increase with the height.
rng = np.random.default_rng(7)
layers, z = [], 0.0
while z < height:
    size = 2e-3 + 2e-3 * z / height
    count = round(width / size)
    places = np.moveaxis(np.indices((count, count, 1)), 0, -1).reshape(-1, 3)
    places = places + rng.uniform(0.2, 0.8, places.shape)
    radius = 0.5 * size * rng.uniform(0.8, 1.0, len(places))
    layers.append(np.column_stack([places * [width / count, width / count, size], radius]))
    layers[-1][:, 2] += z
    z += size
spheres = np.concatenate(layers)
spheres = spheres[spheres[:, 2] < height]

# 2. The cells of the spheres fill the box without gaps.
box = flexpm.Specimen.from_spheres(spheres, width=width, depth=width, height=height)
print(f"{len(box.radii)} grains")

# 3. In tension the box breaks among the coarse grains.
result = flexpm.run("tension", box, "augig3d-calibrated", out=folder)
heights = np.array([crack.z for crack in result.cracks])
print(f"strength {result.peak_stress / 1e6:.2f} MPa, status {result.status}")
print(
    f"half of the cracked points are above {1e3 * np.median(heights):.0f} of {1e3 * height:.0f} mm"
)
