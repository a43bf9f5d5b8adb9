# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 12 of the paper: influence of shear strength and fracture energies, rigid and flexible."""

from common import macroscopic_pictures, options, results

KEYS = ["model", "set.tensile_fracture_energy", "set.cohesion"]

rows, folder = results("fig12", options(__doc__))
for path in macroscopic_pictures("fig12", rows, folder, KEYS, x="set.cohesion"):
    print(path)
