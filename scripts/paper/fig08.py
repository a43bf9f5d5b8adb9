# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 8 and 9 of the paper: stress over strain of flexible, inner-particle and rigid grains."""

from common import curves_of, options, results

from flexpm.plot_compare import curves_picture

PANELS = {"fig08": ("flexible", "inner", "inner-un"), "fig09": ("flexible", "rigid")}

rows, folder = results("fig08", options(__doc__))
for name, models in PANELS.items():
    for letter, law in (("a", "brittle"), ("b", "bilinear")):
        chosen = rows[rows["material"].str.endswith(law) & rows["model"].isin(models)]
        runs = curves_of(chosen[chosen["seed"] == 1], folder)
        if runs:
            curves_picture(folder / f"{name}{letter}.png", runs)
            print(folder / f"{name}{letter}.png")
