# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 11 of the paper: strength envelopes and tensile strengths, brittle and bilinear."""

from common import envelope_of, macroscopic, options, results

from flexpm.materials.references import reference_of
from flexpm.report.comparison import envelope_picture

LABELS = {"": "E = 25.8 GPa", "-quartz": "E = 51.6 GPa"}

rows, folder = results("fig11", options(__doc__))
macroscopic(rows, ["model", "material"]).to_csv(folder / "fig11.csv", index=False)
for letter, law in (("a", "brittle"), ("b", "bilinear")):
    chosen = rows[rows["material"].str.contains(law)]
    envelopes = []
    for (model, material), group in chosen.groupby(["model", "material"], sort=False):
        elastic = LABELS["-quartz" if material.endswith("-quartz") else ""]
        label = "rigid" if model == "rigid" else f"{model}, {elastic}"
        envelopes.append(envelope_of(label, group))
    envelope_picture(folder / f"fig11{letter}.png", envelopes, reference_of("augig"))
    print(folder / f"fig11{letter}.png")
