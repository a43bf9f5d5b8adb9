# SPDX-License-Identifier: GPL-3.0-or-later
"""What half the paper's size changes: the corner points of Fig. 12, full size over half size.

``full_size_ratios.csv`` has the ratios of means over three packings of each size, with standard
errors; c and φ are of 0 and 4 MPa here. Runs of half the size are those of ``fig12.py``.
"""

from __future__ import annotations

import pandas
from common import macroscopic, options, results, rows_of

KEYS = ["model", "set.cohesion", "set.tensile_fracture_energy"]
#: Measures, by the heading of the table.
MEASURES = {
    "compression": "compressive_strength",
    "direct tension": "direct",
    "c": "cohesion",
    "φ": "friction_angle",
}

chosen = options(__doc__)
full, folder = results("full_size", chosen)
half = rows_of(chosen.out / "fig12.csv")
half = half[half["confinement"].fillna(0.0).isin([0.0, 4e6])]
sizes = [
    macroscopic(rows[rows["test"] != "brazilian"], KEYS).groupby(KEYS)[[*MEASURES.values()]]
    for rows in (full, half)
]
(mean, error), (mean_half, error_half) = ((size.mean(), size.sem()) for size in sizes)
ratio = mean / mean_half
share = ((error / mean) ** 2 + (error_half / mean_half) ** 2) ** 0.5
lines = []
for corner in mean.index:
    model, cohesion, energy = corner
    line = {
        "Model": model,
        "τ [MPa]": f"{1e-6 * float(cohesion):g}",
        "G_fn [N/m]": f"{float(energy):g}",
    }
    for heading, name in MEASURES.items():
        found = ratio.loc[corner, name]
        line[heading] = f"{found:.2f} ± {found * share.loc[corner, name]:.2f}"
    lines.append(line)
table = pandas.DataFrame(lines)
table.to_csv(folder / "full_size_ratios.csv", index=False)
print(table.to_string(index=False))
