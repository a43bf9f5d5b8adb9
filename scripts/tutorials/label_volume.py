# SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorial 13: from a label volume to a broken core.

The script draws a segmented scan of a rock of two minerals with a pore, and writes it as a stack of
TIFF images. It makes a core of the scan, prints how well the cells agree with the voxels, and
compresses the core.

    PYTHONPATH=build/python /usr/bin/python3 scripts/tutorials/label_volume.py [FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

import flexpm
from flexpm.report.volume_sections import volume_picture

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else "label-volume")
VOXEL = 3e-4  # [m]

# 1. A scan: each voxel has the label of its grain, 0 in the pore. For a real scan use the command:
#    flexpm specimen volume FILE --voxel 3e-4 --phases FILE --shape cylinder --diameter 0.015.
draw = np.random.default_rng(1)
z, y, x = np.indices((90, 50, 50))
places = draw.random((170, 3)) * (90, 50, 50)
labels = 1 + cKDTree(places).query(np.stack((z, y, x), axis=-1))[1]
labels[(x - 32) ** 2 + (y - 25) ** 2 + (z - 45) ** 2 < 7**2] = 0
layers = [Image.fromarray(layer) for layer in labels.astype(np.uint16)]
FOLDER.mkdir(parents=True, exist_ok=True)
layers[0].save(FOLDER / "scan.tif", save_all=True, append_images=layers[1:])

# 2. The core: every third grain is quartz, and label 0 is a pore.
minerals = {label: int(label % 3 == 0) for label in range(1, 171)} | {0: None}
core = flexpm.Specimen.from_label_volume(
    FOLDER / "scan.tif", voxel=VOXEL, minerals=minerals, shape="cylinder", diameter=0.015
)
fit = core.fit.totals
print(
    f"{len(core.spheres)} of {fit['grains']} grains, {100 * fit['agreement']:.1f} % of the voxels"
)
pore, scanned = (100 * fit[name] for name in ("pore_fraction", "source_pore_fraction"))
print(f"pore {pore:.2f} %, in the scan {scanned:.2f} %")
volume_picture(FOLDER / "volume.png", core.fit)

# 3. The core in compression, until shortly after its peak.
rock = Path(__file__).with_name("two_minerals.toml")
result = flexpm.run("uniaxial", core, material=str(rock), stop_ratio=0.8, out=FOLDER / "core")
print(f"strength {result.peak_stress / 1e6:.0f} MPa")
for two, modes in result.cracks_by_pair.items():
    print(f"{two:19} {sum(modes.values())} points cracked")
print(f"files: {FOLDER}/")
