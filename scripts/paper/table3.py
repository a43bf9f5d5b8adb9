# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 3 of the paper: Augig granite against the calibrated presets, on packings of their own."""

import pandas
from common import RESULTS, macroscopic, options, results

from flexpm.materials.references import reference_of

rock = reference_of("augig")
#: Name, factor, value in Table 3 and digits of each measure; direct over indirect tensile strength
#: has no target and is below 1 in rock.
MEASURES = {
    "youngs_modulus": ("E [GPa]", 1e-9, rock.youngs_modulus, 1),
    "poissons_ratio": ("ν [-]", 1.0, rock.poissons_ratio, 3),
    "compressive_strength": ("uniaxial compression [MPa]", 1e-6, rock.compressive_strength, 1),
    "indirect": ("indirect tension [MPa]", 1e-6, rock.brazilian_strength, 2),
    "cohesion": ("c [MPa]", 1e-6, rock.cohesion, 1),
    "friction_angle": ("φ [degrees]", 1.0, rock.friction_angle, 1),
    "ratio": ("direct / indirect tension [-]", 1.0, None, 2),
}

chosen = options(__doc__)
rows, folder = results("table3", chosen)
elastic = rows[rows["test"] == "elastic"][["model", "seed", "youngs_modulus", "poissons_ratio"]]
strengths = macroscopic(rows[rows["test"] != "elastic"], ["model"])
found = strengths.merge(elastic, on=["model", "seed"])
lines = []
for measure, (name, factor, target, digits) in MEASURES.items():
    line = {"Measure": name, "Table 3": "" if target is None else f"{factor * target:.{digits}f}"}
    for model, group in found.groupby("model"):
        values = factor * group[measure].astype(float)
        line[model] = f"{values.mean():.{digits}f} ± {values.std():.{digits}f}"
        if target is not None:
            line[model] += f" ({100.0 * (values.mean() / (factor * target) - 1.0):+.1f} %)"
    lines.append(line)
table = pandas.DataFrame(lines)
for place in (folder, RESULTS) if chosen.keep else (folder,):
    table.to_csv(place / "table3_presets.csv", index=False)
print(table.to_string(index=False))
