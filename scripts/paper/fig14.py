# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 14 and 15 of the paper: envelope and curves of the flexible model with Table 7."""

from common import curves_of, envelope_of, macroscopic, options, results

from flexpm.plot_compare import curves_picture, envelope_picture
from flexpm.references import reference_of

rows, folder = results("fig14", options(__doc__))
macroscopic(rows, ["model"]).to_csv(folder / "fig14.csv", index=False)
envelope_picture(folder / "fig14.png", [envelope_of("flexible", rows)], reference_of("augig"))
shown = rows[rows["confinement"].fillna(0.0).isin([0.0, 4e6])]
compressed = shown[shown["test"].isin(["uniaxial", "biaxial"]) & (shown["seed"] == 1)]
curves_picture(folder / "fig15.png", curves_of(compressed, folder))
print(folder / "fig14.png", folder / "fig15.png")
