# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that a run announces against the steps that it takes, for all tests, shapes and models.

Small packings of seed 1, and of seed 2 for the tests that scatter most, are fitted; others of other
sizes, options and seeds judge the estimate. The estimate was also fitted to larger packings: the
tables of slow_limit.py, trends.py, models.toml and fresh_packings.py. Adds one CSV row a run and
passes over rows that exist. A run takes up to a minute on an idle core. Steps are those of the run,
`announced` at its start and `tenth` after a tenth of it. The second command prints how many runs
keep within which factor:

    export PYTHONPATH=build/python
    /usr/bin/python3 scripts/studies/step_counts.py step_counts.csv
    /usr/bin/python3 scripts/studies/step_counts.py step_counts.csv --table
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from growing_table import add_row, rows_of

import flexpm
from flexpm.kinds.registry import kind_of
from flexpm.laboratory.carrying_out import carry_out
from flexpm.laboratory.plan import plan_run
from flexpm.runs import runner
from flexpm.runs.run_spec import RunSpec, described

MODELS = ("flexible", "rigid")
MATERIALS = {
    ("2D", "flexible"): "augig-calibrated",
    ("2D", "rigid"): "augig-calibrated-rigid",
    ("3D", "flexible"): "augig3d-calibrated",
    ("3D", "rigid"): "augig3d-calibrated-rigid",
}
Sizes = Mapping[str, float]


class Case(NamedTuple):
    """A test on a shape: sizes [m] and options of the runs that are fitted and that judge."""

    test: str
    shape: str
    fitted: tuple[Sizes, Sizes]
    judging: tuple[Sizes, Sizes]


def _flat(width: float, height: float) -> Sizes:
    return {"width": width, "height": height, "thickness": 0.01}


def _box(width: float, depth: float, height: float) -> Sizes:
    return {"width": width, "depth": depth, "height": height}


def _core(diameter: float, height: float) -> Sizes:
    return {"diameter": diameter, "height": height}


def _disc(diameter: float, depth: float) -> Sizes:
    return {"diameter": diameter, "depth": depth}


def _round(diameter: float) -> Sizes:
    return {"diameter": diameter, "thickness": 0.01}


#: Options of tests that would take several minutes at the default rate.
QUICK = {"rate": 4.0, "stop_ratio": 0.5}
CASES = {
    "uniaxial 2D": Case(
        *("uniaxial", "rectangle", (_flat(0.016, 0.032), {}), (_flat(0.02, 0.044), {}))
    ),
    "tension 2D": Case(
        *("tension", "rectangle", (_flat(0.016, 0.032), {}), (_flat(0.02, 0.044), {}))
    ),
    "biaxial": Case(
        *("biaxial", "rectangle", (_flat(0.016, 0.032), {"confinement": 4e6})),
        (_flat(0.018, 0.03), {"confinement": 8e6}),
    ),
    "brazilian 2D": Case("brazilian", "disc", (_round(0.024), {}), (_round(0.036), {})),
    "bending 2D": Case(
        *("bending", "rectangle", (_flat(0.06, 0.014), {})),
        (_flat(0.07, 0.016), {"notch": 0.004, **QUICK}),
    ),
    "scb 2D": Case("scb", "half_disc", (_round(0.04), {}), (_round(0.05), QUICK)),
    "shear 2D": Case(
        *("shear", "rectangle", (_flat(0.03, 0.016), {})),
        (_flat(0.034, 0.018), {"normal_stress": 2e6}),
    ),
    "punch 2D": Case(
        *("punch", "rectangle", (_flat(0.036, 0.02), {"confinement": 2e6, "notch": 0.003})),
        (_flat(0.04, 0.022), {"confinement": 5e6, "notch": 0.004}),
    ),
    "uniaxial box": Case(
        *("uniaxial", "box", (_box(0.012, 0.012, 0.024), {})),
        (_box(0.014, 0.012, 0.03), {}),
    ),
    "uniaxial cylinder": Case(
        *("uniaxial", "cylinder", (_core(0.012, 0.024), {}), (_core(0.014, 0.026), {}))
    ),
    "tension box": Case(
        *("tension", "box", (_box(0.012, 0.012, 0.024), {}), (_box(0.014, 0.012, 0.03), {}))
    ),
    "tension cylinder": Case(
        *("tension", "cylinder", (_core(0.012, 0.024), {}), (_core(0.014, 0.026), {}))
    ),
    "triaxial box": Case(
        *("triaxial", "box", (_box(0.012, 0.012, 0.024), {"confinement": 4e6})),
        (_box(0.012, 0.014, 0.022), {"confinement": 2e6}),
    ),
    "triaxial cylinder": Case(
        *("triaxial", "cylinder", (_core(0.012, 0.024), {"confinement": 2e6})),
        (_core(0.013, 0.022), {"confinement": 4e6}),
    ),
    "brazilian 3D": Case(
        *("brazilian", "solid_disc", (_disc(0.02, 0.01), {}), (_disc(0.024, 0.009), {}))
    ),
    "brazilian 3D, jaws": Case(
        *("brazilian", "solid_disc", (_disc(0.02, 0.01), {"jaw_radius": 0.015})),
        (_disc(0.024, 0.009), {"jaw_radius": 0.018}),
    ),
    "bending 3D": Case(
        *("bending", "box", (_box(0.036, 0.008, 0.008), {"span": 0.032, **QUICK})),
        (_box(0.032, 0.008, 0.010), {"notch": 0.002, **QUICK}),
    ),
    "scb 3D": Case(
        *("scb", "solid_half_disc", (_disc(0.024, 0.008), QUICK)), (_disc(0.03, 0.008), QUICK)
    ),
    "shear 3D": Case(
        *("shear", "box", (_box(0.020, 0.010, 0.012), {})),
        (_box(0.018, 0.009, 0.012), {"normal_stress": 2e6}),
    ),
    "punch 3D": Case(
        *("punch", "box", (_box(0.036, 0.008, 0.020), {"confinement": 2e6, "notch": 0.003})),
        (_box(0.038, 0.008, 0.022), {"confinement": 5e6, "notch": 0.003}),
    ),
    "sonic 2D": Case("sonic", "rectangle", (_flat(0.02, 0.16), {}), (_flat(0.02, 0.2), {})),
    "sonic 3D": Case(
        *("sonic", "box", (_box(0.008, 0.008, 0.16), {}), (_box(0.009, 0.009, 0.2), {}))
    ),
}
#: Seeds of the fitted runs, and those of other packings of the tests that scatter most.
FITTED, AGAIN, JUDGING = 1, 2, 3
SCATTERED = ("uniaxial 2D", "brazilian 2D", "scb 3D")
FIELDS = ("case", "model", "seed", "role", "status", "announced", "tenth", "steps")


class Run(NamedTuple):
    """One run of the table."""

    case: str
    model: str
    seed: int

    @property
    def role(self) -> str:
        """Whether the estimate is fitted on it or judged by it."""
        return "judging" if self.seed == JUDGING else "fitted"


def runs() -> Iterator[Run]:
    """All runs, those that are fitted first."""
    for case in CASES:
        yield from (Run(case, model, FITTED) for model in MODELS)
    for case in SCATTERED:
        yield from (Run(case, model, AGAIN) for model in MODELS)
    for case in CASES:
        yield from (Run(case, model, JUDGING) for model in MODELS)


def spec_of(run: Run) -> tuple[RunSpec, Any, Any]:
    """Inputs, specimen and material of a run."""
    case = CASES[run.case]
    sizes, options = case.judging if run.role == "judging" else case.fitted
    specimen: Any = getattr(flexpm.Specimen, case.shape)(**sizes, seed=run.seed)
    dimension = "2D" if "thickness" in sizes else "3D"
    material = flexpm.materials.load(MATERIALS[dimension, run.model])
    plain = {name: options[name] for name in options if name != "jaw_radius"}
    own = {name: options[name] for name in options if name == "jaw_radius"}
    about = described(material, run.model)
    plain.setdefault("stop_ratio", kind_of(case.test).stop_ratio)
    spec = RunSpec(case.test, specimen.spec, about, run.model, own=own, **plain)
    return spec, specimen, material


def row_of(run: Run) -> list[object]:
    """Do a run."""
    spec, specimen, material = spec_of(run)
    announced: list[int] = []
    looks: list[tuple[float, float]] = []
    result = carry_out(
        plan_run(spec, specimen, material),
        progress=lambda done, expected, _: looks.append((done, expected)),
        foresee=lambda steps, _: announced.append(steps),
    )
    tenth = next(expected for done, expected in looks if done >= 0.1 * result.steps)
    told = announced[0] if announced else None
    return [*run, run.role, result.status, told, round(tenth), result.steps]


def main() -> None:
    """Do the runs, or print how good the announced numbers are."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV file that gets the rows")
    parser.add_argument("--table", action="store_true", dest="show", help="print the factors")
    options = parser.parse_args()
    rows = rows_of(options.table)
    if options.show:
        show(rows)
        return
    runner._LOOK_UP = 0.005  # small runs have a tenth, too
    done = {(row["case"], row["model"], int(row["seed"])) for row in rows}
    for run in runs():
        if run not in done:
            add_row(options.table, FIELDS, row_of(run))


def show(rows: list[dict[str, str]]) -> None:
    """Print the runs that keep within a factor of their announced steps."""
    for role in ("fitted", "judging"):
        for name, factor in (("announced", 2.0), ("tenth", 1.5)):
            off = {
                f"{row['case']}, {row['model']}, seed {row['seed']}": (
                    float(row[name]) / float(row["steps"])
                )
                for row in rows
                if row["role"] == role and row[name]
            }
            good = sum(1.0 / factor <= one <= factor for one in off.values())
            print(f"{role}, {name}: {good} of {len(off)} runs within a factor of {factor}")
            for run, one in off.items():
                if not 1.0 / factor <= one <= factor:
                    print(f"  {run}: {one:.2f}")


if __name__ == "__main__":
    main()
