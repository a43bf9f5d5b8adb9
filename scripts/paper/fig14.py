# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 14 and 15 of the paper: envelope and curves of the flexible model with Table 7."""

from common import (
    curves_of,
    envelope_of,
    macroscopic,
    of_first_packing,
    options,
    results,
)

from flexpm.materials.references import reference_of
from flexpm.report.comparison import curves_picture, envelope_picture


def drawn(inputs):
    """The curve of a run is drawn: the first packing without confinement and under 4 MPa."""
    pressure = {"uniaxial": 0.0, "biaxial": inputs.get("confinement")}.get(inputs["test"])
    return of_first_packing(inputs) and pressure in (0.0, 4e6)


rows, folder = results("fig14", options(__doc__), drawn)
macroscopic(rows, ["model"]).to_csv(folder / "fig14.csv", index=False)
envelope_picture(folder / "fig14.png", [envelope_of("flexible", rows)], reference_of("augig"))
print(folder / "fig14.png")
curves = curves_of(rows[[drawn(row) for row in rows.to_dict("records")]], folder)
if curves:
    curves_picture(folder / "fig15.png", curves)
    print(folder / "fig15.png")
