# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 7 under other readings of the paper, full size: five measures each, beside Table 3.

``readings_table.csv`` has means and standard errors, ``readings_changes.csv`` the change of each
measure on the same packing.

A reading changes one thing that the paper leaves open, or two where its name says so, on the same
packings. Those at ten times the rate are no readings but tell what loading too fast would give.
"""

from __future__ import annotations

from collections.abc import Sequence

import pandas
from common import HERE, macroscopic, options, results

from flexpm.materials.references import reference_of
from flexpm.studies import jobs, study

#: What each test adds to a reading; nothing is asked of the curve beyond its peak.
TESTS = (
    {"test": "uniaxial", "stop_ratio": 0.9},
    {"test": "biaxial", "confinement": 4e6, "stop_ratio": 0.9},
    {"test": "biaxial", "confinement": 12e6, "stop_ratio": 0.9},
    {"test": "tension", "stop_ratio": 0.8},
    {"test": "brazilian", "stop_ratio": 0.8},
)
COMMON = {"model": "flexible", "material": "augig-table7", "points": 3}
SEEDS = range(1, 6)
HALF_AREA = {"set.tensile_fracture_energy": 10.0, "set.shear_fracture_energy": 400.0}
FAST = {"loading": "constant", "rate": 10.0}
#: The reading in use is of Fig. 14, with the same confinements as the others, or with those named.
IN_USE = "in use"
RANGES = {
    "in use, c and φ from 0, 2, 4 MPa": (0.0, 2e6, 4e6),
    "in use, c and φ from 4, 8, 12 MPa": (4e6, 8e6, 12e6),
}
#: Inputs of each reading, by the words of the table.
READINGS = {
    "G_f is half the area": HALF_AREA,
    "ten times the constant rate": FAST,
    "half the area, ten times the rate": {**HALF_AREA, **FAST},
    "plane strain": {"set.plane": "strain"},
    "two points in a contact": {"points": 2},
    "porosity 0.05": {"porosity": 0.05},
    "porosity 0.15": {"porosity": 0.15},
    "grains meshed as fans": {"mesh": "fan"},
}
#: Measure, heading, factor to its unit, digits.
MEASURES = (
    ("compressive_strength", "compression [MPa]", 1e-6, 1),
    ("indirect", "Brazilian [MPa]", 1e-6, 2),
    ("direct", "direct tension [MPa]", 1e-6, 2),
    ("cohesion", "c [MPa]", 1e-6, 1),
    ("friction_angle", "φ [°]", 1.0, 1),
)


def in_use(known: pandas.DataFrame, pressures: Sequence[float], name: str) -> pandas.DataFrame:
    """Measures of the reading in use, with c and φ from some confinements [Pa]."""
    compressed = known["test"].isin(["uniaxial", "biaxial"])
    part = known[~compressed | known["confinement"].fillna(0.0).isin(pressures)]
    rock = macroscopic(part.assign(reading=name), ["reading"])
    # the strength without confinement belongs to the rock, whatever the range
    alone = known[known["test"] == "uniaxial"].set_index("seed")["peak_stress"]
    return rock.assign(compressive_strength=rock["seed"].map(alone))


chosen = options(__doc__)
made = [
    (reading, jobs.make({**COMMON, **test, "seed": seed, **changes}, HERE))
    for reading, changes in READINGS.items()
    for seed in SEEDS
    for test in TESTS
]
rows, folder = results("readings", chosen, plan=study.Study("readings", [job for _, job in made]))
rows["reading"] = rows["key"].map({job.key: reading for reading, job in made})
known, _ = results("fig14", chosen)
measured = [in_use(known, [test.get("confinement", 0.0) for test in TESTS], IN_USE)]
measured += [in_use(known, pressures, name) for name, pressures in RANGES.items()]
measured.append(macroscopic(rows, ["reading"]))
found = pandas.concat(measured, ignore_index=True)
rock = reference_of("augig")
goals = {
    "compressive_strength": rock.compressive_strength,
    "indirect": rock.brazilian_strength,
    "cohesion": rock.cohesion,
    "friction_angle": rock.friction_angle,
}
base = found[found["reading"] == IN_USE].set_index("seed")
lines, changes = [], []
for reading, group in found.groupby("reading", sort=False):
    values = group.set_index("seed")[[name for name, *_ in MEASURES]].astype(float)
    # a mean of other packings could not be compared
    whole = [name for name in values if values[name].notna().sum() == len(SEEDS)]
    if not whole:
        continue
    mean, error = values.mean(), values.sem()
    change = 100.0 * (values / base[values.columns].astype(float) - 1.0)
    line, paired = {"Reading": reading}, {"Reading": reading}
    for name, heading, factor, digits in MEASURES:
        label = heading.split(" [")[0]
        line[heading] = paired[label] = ""
        if name in whole:
            line[heading] = f"{factor * mean[name]:.{digits}f} ± {factor * error[name]:.{digits}f}"
            paired[label] = f"{change[name].mean():+.1f} ± {change[name].sem():.1f}"
    squares = [(mean[name] / goal - 1.0) ** 2 for name, goal in goals.items() if name in whole]
    distance = f"{100.0 * (sum(squares) / len(goals)) ** 0.5:.0f}"
    line["distance [%]"] = distance if len(squares) == len(goals) else ""
    lines.append(line)
    if reading != IN_USE:
        changes.append(paired)
last = {"Reading": "Table 3", "distance [%]": ""}
for name, heading, factor, digits in MEASURES:
    last[heading] = f"{factor * goals[name]:.{digits}f}" if name in goals else ""
tables = {"table": pandas.DataFrame([*lines, last]), "changes": pandas.DataFrame(changes)}
for name, table in tables.items():
    table.to_csv(folder / f"readings_{name}.csv", index=False)
    print(table.to_string(index=False))
