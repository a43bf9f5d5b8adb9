# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 7 of the paper: elastic constants over the shear ratio of the contacts."""

from common import options, results

from flexpm.studies.figures import draw
from flexpm.studies.study import Study

PANELS = {
    "ab": ("rigid", None, "rigid grains"),
    "cd": ("flexible", 25.8e9, "flexible, E = 25.8 GPa"),
    "ef": ("flexible", 51.6e9, "flexible, E = 51.6 GPa"),
}

rows, folder = results("fig07", options(__doc__))
for letters, (model, young, title) in PANELS.items():
    where = {"model": model} | ({"set.young": young} if young else {})
    pictures = [
        {
            "x": "set.shear_ratio",
            "y": measure,
            "by": ["set.normal_stiffness"],
            "where": where,
            "file": f"fig07{letter}.png",
            "title": f"Fig. 7 {letter}: {title}",
        }
        for letter, measure in zip(letters, ("youngs_modulus", "poissons_ratio"), strict=True)
    ]
    for path in draw(Study("Fig. 7", [], pictures), rows, folder):
        print(path)
