# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 12: own spheres. Grains that grow coarser from the bottom to the top of a box.

PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/own_spheres.py [FOLDER]
"""

import sys

import numpy as np

import flexpm

folder = sys.argv[1] if len(sys.argv) > 1 else "own-spheres"
width, height = 0.012, 0.024

# 1. Layers of spheres about a grid, larger further up.
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

# 2. The cells between them fill the box without gaps.
box = flexpm.Specimen.from_spheres(spheres, width=width, depth=width, height=height)
print(f"{len(box.radii)} grains")

# 3. Pulled, it breaks among the coarse grains.
result = flexpm.run("tension", box, "augig3d-calibrated", out=folder)
heights = np.array([crack.z for crack in result.cracks])
print(f"strength {result.peak_stress / 1e6:.2f} MPa, status {result.status}")
print(
    f"half of the cracked points lie above {1e3 * np.median(heights):.0f} of {1e3 * height:.0f} mm"
)
