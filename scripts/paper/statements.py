# SPDX-License-Identifier: GPL-3.0-or-later
"""Statements of the paper on Figs. 7 to 14, judged by the tables of the figures' scripts.

Writes ``paper-out/statements.csv``, and to ``verdicts.csv`` how many statements of each section are
reproduced. A statement is not judged before the script of its figure has made its table.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import judge
import pandas
from common import macroscopic, options

FLEXIBLE, RIGID = {"model": "flexible"}, {"model": "rigid"}
INNER, INNER_UN = {"model": "inner"}, {"model": "inner-un"}
MODELS = {"flexible": FLEXIBLE, "rigid": RIGID}
BRITTLE = {"material": "augig-table2-brittle"}
BILINEAR = {"material": "augig-table2-bilinear"}
LAWS = {"brittle": BRITTLE, "bilinear": BILINEAR}
STIFF_BRITTLE = FLEXIBLE | {"material": "augig-table2-brittle-quartz"}
STIFF_BILINEAR = FLEXIBLE | {"material": "augig-table2-bilinear-quartz"}
#: Models of Fig. 11.
THREE = {
    "brittle": {"rigid": RIGID | BRITTLE, "51.6": STIFF_BRITTLE, "25.8": FLEXIBLE | BRITTLE},
    "bilinear": {"rigid": RIGID | BILINEAR, "51.6": STIFF_BILINEAR, "25.8": FLEXIBLE | BILINEAR},
}
ENERGY, SHEAR, FRICTION = "set.tensile_fracture_energy", "set.cohesion", "set.friction"
TABLE_KEYS = {
    "fig11": ["model", "material"],
    "fig12": ["model", ENERGY, SHEAR],
    "fig13": ["model", SHEAR, FRICTION],
    "fig14": ["model"],
}
#: Verdicts in the order of their table.
SHOWN = ("reproduced", "in part", "within scatter", "not reproduced", "not judged", judge.NOT_RUN)
QUOTIENT = "compression_over_direct"
#: A slope over a strain that goes back tells how the strain is measured, not how brittle a fall is.
RECOVERS = "not judged; the strain of {} recovers after the peak (see Fig. {})"


class Statement(NamedTuple):
    """One statement, the study that tells, and the judge of its table."""

    section: str
    says: str
    study: str
    judge: Callable[[pandas.DataFrame], str]


def flexible_above(measure: str, **given: Any) -> Callable[[pandas.DataFrame], str]:
    """Flexible grains above rigid ones."""
    return partial(judge.above, measure=measure, more=FLEXIBLE, less=RIGID, **given)


def rigid_above(measure: str, **given: Any) -> Callable[[pandas.DataFrame], str]:
    """Rigid grains above flexible ones."""
    return partial(judge.above, measure=measure, more=RIGID, less=FLEXIBLE, **given)


def both_laws(of: Callable[..., str], **given: Any) -> Callable[[pandas.DataFrame], str]:
    """Brittle and bilinear contacts, one by one."""
    return partial(judge.each, judge=partial(of, **given), cases=LAWS)


def both_models(
    of: Callable[..., str], measure: str, x: str, at: str
) -> Callable[[pandas.DataFrame], str]:
    """Flexible and rigid grains over `x`, one by one."""
    return partial(judge.each, judge=partial(of, measure=measure, x=x, at=[at]), cases=MODELS)


def flexible_more(measure: str, x: str, at: str) -> Callable[[pandas.DataFrame], str]:
    """Flexible grains are influenced more by `x`."""
    return partial(judge.stronger, measure=measure, x=x, more=FLEXIBLE, less=RIGID, at=[at])


def rigid_more(measure: str, x: str, at: str) -> Callable[[pandas.DataFrame], str]:
    """Rigid grains are influenced more by `x`."""
    return partial(judge.stronger, measure=measure, x=x, more=RIGID, less=FLEXIBLE, at=[at])


def elastic(table: pandas.DataFrame, reading: str, model: str, young: float | None = None) -> str:
    """Tell how E and nu change over eta at the middle K_n, and over K_n at eta = 0.28 (Fig. 7)."""
    rows = table[table["model"] == model]
    rows = rows if young is None else rows[rows["set.young"] == young]
    middle = sorted(rows["set.normal_stiffness"].unique())[1]
    told = []
    for label, x, part in (
        ("η 0.1 to 1", "set.shear_ratio", rows[rows["set.normal_stiffness"] == middle]),
        ("K_n times 4", "set.normal_stiffness", rows[rows["set.shear_ratio"] == 0.28]),
    ):
        means = part.groupby(x)[["youngs_modulus", "poissons_ratio"]].mean().iloc[[0, -1]]
        modulus = " to ".join(f"{1e-9 * value:.1f}" for value in means["youngs_modulus"])
        ratio = " to ".join(f"{value:.3f}" for value in means["poissons_ratio"])
        told.append(f"{label}: E {modulus} GPa, ν {ratio}")
    return "; ".join([reading, *told])


def step_times(table: pandas.DataFrame) -> str:
    """Quotients of step times (Table 4), which depend on the machine."""
    hours = table.set_index("model")
    told = []
    for test in ("uniaxial", "brazilian"):
        rigid, flexible, inner = (hours.loc[name, test] for name in ("rigid", "refined", "inner"))
        told.append(f"{test} {flexible / rigid:.2f} and {inner / flexible:.1f}")
    return "not reproduced; " + ", ".join(told)


STATEMENTS = [
    Statement(
        "4.2",
        "Rigid: K_n and η both influence E, more so η at higher K_n; ν follows mainly η (7a, b)",
        "fig07",
        partial(
            elastic,
            reading="in part: η counts alike at each K_n, K_n not for ν",
            model="rigid",
        ),
    ),
    Statement(
        "4.2",
        "Flexible, E = 25.8 GPa: the triangles govern E and ν, η hardly counts (7c, d)",
        "fig07",
        partial(elastic, reading="reproduced", model="flexible", young=25.8e9),
    ),
    Statement(
        "4.2",
        "Flexible, E = 51.6 GPa: the contacts count as well, mostly for ν (7e, f)",
        "fig07",
        partial(
            elastic,
            reading="in part: η counts for ν, K_n for E",
            model="flexible",
            young=51.6e9,
        ),
    ),
    Statement(
        "4.3.1",
        "The flexible model lies between the two models of inner particles (8): strength",
        "fig08",
        both_laws(judge.between, measure="peak_stress", ends=[INNER, INNER_UN], middle=FLEXIBLE),
    ),
    Statement(
        "4.3.1",
        "Inner particles are less brittle (8): slope after the peak, inner above flexible",
        "fig08",
        lambda _: RECOVERS.format("inner particles", 8),
    ),
    Statement(
        "4.3.1",
        "They are so with the edges' normals, too (8): inner-un above flexible",
        "fig08",
        lambda _: RECOVERS.format("inner particles", 8),
    ),
    Statement(
        "4.3.1",
        "Deformable grains do not change the brittle fall after the peak (9): slope",
        "fig09",
        lambda _: RECOVERS.format("rigid grains", 9),
    ),
    Statement(
        "4.3.1",
        "Brittle: deformable grains do not change the compressive strength (9a)",
        "fig09",
        partial(judge.alike, measure="peak_stress", one=FLEXIBLE, other=RIGID, where=BRITTLE),
    ),
    Statement(
        "4.3.1",
        "Bilinear: deformable grains raise the compressive strength (9b)",
        "fig09",
        flexible_above("peak_stress", where=BILINEAR),
    ),
    Statement(
        "4.3.1",
        "The rigid model has two slopes, the flexible one (9): modulus at 80 % of the peak over "
        "that at 20 %, flexible above rigid",
        "fig09",
        both_laws(judge.above, measure="tangent_modulus_ratio", more=FLEXIBLE, less=RIGID),
    ),
    Statement(
        "4.3.1",
        "The two slopes are less distinct when bilinear (9): the same, bilinear above brittle",
        "fig09",
        partial(
            judge.above, measure="tangent_modulus_ratio", more=BILINEAR, less=BRITTLE, where=RIGID
        ),
    ),
    Statement(
        "4.3.1",
        "Damage begins at higher stress in the flexible model (9): at 5 % of the tensile cracks",
        "fig09",
        both_laws(judge.above, measure="tensile_onset_stress", more=FLEXIBLE, less=RIGID),
    ),
    Statement(
        "4.3.1",
        "Flexible / rigid step time 8.15 and 4.79, inner / flexible 3.03 and 1.21 (Table 4)",
        "table4",
        step_times,
    ),
    Statement(
        "4.3.2",
        "Brittle: φ is higher in the flexible model, E = 25.8 GPa, than in the rigid one (11a)",
        "fig11",
        flexible_above("friction_angle", where=BRITTLE),
    ),
    Statement(
        "4.3.2",
        "Brittle: indirect tensile strength is below the direct one in all models (11a): "
        "direct / indirect above 1",
        "fig11",
        partial(
            judge.each, judge=partial(judge.above_one, measure="ratio"), cases=THREE["brittle"]
        ),
    ),
    *(
        Statement(
            "4.3.2",
            f"Brittle: E = 51.6 GPa is closer to rigid than to 25.8 GPa (11a): {name}",
            "fig11",
            partial(
                judge.closer,
                measure=measure,
                to=RIGID | BRITTLE,
                than_to=FLEXIBLE | BRITTLE,
                middle=STIFF_BRITTLE,
            ),
        )
        for measure, name in (("compressive_strength", "strength"), ("friction_angle", "φ"))
    ),
    Statement(
        "4.3.2",
        "Bilinear: φ is higher in the flexible model, E = 25.8 GPa, than in the rigid one (11b)",
        "fig11",
        flexible_above("friction_angle", where=BILINEAR),
    ),
    Statement(
        "4.3.2",
        "Bilinear: indirect tensile strength is above the direct one in all models (11b): "
        "direct / indirect below 1",
        "fig11",
        partial(
            judge.each, judge=partial(judge.below_one, measure="ratio"), cases=THREE["bilinear"]
        ),
    ),
    Statement(
        "4.3.2",
        "Bilinear: more so in the flexible model (11b): direct / indirect, rigid above flexible",
        "fig11",
        rigid_above("ratio", where=BILINEAR),
    ),
    *(
        Statement(
            "4.3.2",
            f"Bilinear: E = 51.6 GPa lies between rigid and 25.8 GPa (11b): {name}",
            "fig11",
            partial(
                judge.between,
                measure=measure,
                ends=[RIGID | BILINEAR, FLEXIBLE | BILINEAR],
                middle=STIFF_BILINEAR,
                where={},
            ),
        )
        for measure, name in (("compressive_strength", "strength"), ("friction_angle", "φ"))
    ),
    *(
        Statement(
            "4.3.3",
            f"{name} is higher in the flexible model (12{panel})",
            "fig12",
            flexible_above(measure, at=[ENERGY, SHEAR]),
        )
        for panel, measure, name in (
            ("a", "compressive_strength", "Compressive strength"),
            ("c", "cohesion", "Cohesion"),
            ("d", "direct", "Direct tensile strength"),
            ("e", "indirect", "Indirect tensile strength"),
            ("g", QUOTIENT, "Compression / direct tension"),
        )
    ),
    *(
        Statement(
            "4.3.3",
            f"{name} grows with fracture energy (12{panel})",
            "fig12",
            both_models(judge.grows, measure, ENERGY, SHEAR),
        )
        for panel, measure, name in (
            ("a", "compressive_strength", "Compressive strength"),
            ("d", "direct", "Direct tensile strength"),
            ("e", "indirect", "Indirect tensile strength"),
        )
    ),
    *(
        Statement(
            "4.3.3",
            f"{name} grows with τ/σ_t from 1 to 4 (12{panel})",
            "fig12",
            both_models(judge.grows, measure, SHEAR, ENERGY),
        )
        for panel, measure, name in (
            ("a", "compressive_strength", "Compressive strength"),
            ("c", "cohesion", "Cohesion"),
            ("e", "indirect", "Indirect tensile strength"),
            ("g", QUOTIENT, "Compression / direct tension"),
        )
    ),
    Statement(
        "4.3.3",
        "Fracture energy counts more for the flexible model's compressive strength (12a)",
        "fig12",
        flexible_more("compressive_strength", ENERGY, SHEAR),
    ),
    Statement(
        "4.3.3",
        "φ falls with τ/σ_t from 1 to 4 (12b)",
        "fig12",
        both_models(judge.falls, "friction_angle", SHEAR, ENERGY),
    ),
    Statement(
        "4.3.3",
        "Fracture energy counts less for the flexible model's φ (12b)",
        "fig12",
        rigid_more("friction_angle", ENERGY, SHEAR),
    ),
    Statement(
        "4.3.3",
        "τ/σ_t has a negligible influence on direct tensile strength (12d)",
        "fig12",
        both_models(judge.negligible, "direct", SHEAR, ENERGY),
    ),
    Statement(
        "4.3.3",
        "Direct / indirect is always lower in the flexible model (12f): rigid above flexible",
        "fig12",
        rigid_above("ratio", at=[ENERGY, SHEAR]),
    ),
    Statement(
        "4.3.3",
        "Flexible, τ/σ_t = 2: direct / indirect is below 1 for all fracture energies (12f)",
        "fig12",
        partial(judge.below_one, measure="ratio", where=FLEXIBLE | {SHEAR: 23e6}, at=[ENERGY]),
    ),
    Statement(
        "4.3.3",
        "Compressive strength grows with friction from 0.2 to 0.8 (13a)",
        "fig13",
        both_models(judge.grows, "compressive_strength", FRICTION, SHEAR),
    ),
    Statement(
        "4.3.3",
        "Friction counts more for the flexible model's compressive strength (13a)",
        "fig13",
        flexible_more("compressive_strength", FRICTION, SHEAR),
    ),
    Statement(
        "4.3.3",
        "φ is almost linear in friction (13b)",
        "fig13",
        both_models(judge.straight, "friction_angle", FRICTION, SHEAR),
    ),
    Statement(
        "4.3.3",
        "Friction counts less for the flexible model's cohesion (13c)",
        "fig13",
        rigid_more("cohesion", FRICTION, SHEAR),
    ),
    *(
        Statement(
            "4.3.3",
            f"Friction has a negligible influence on {name} (13{panel})",
            "fig13",
            both_models(judge.negligible, measure, FRICTION, SHEAR),
        )
        for panel, measure, name in (
            ("d", "direct", "direct tensile strength"),
            ("e", "indirect", "indirect tensile strength"),
            ("f", "ratio", "direct / indirect"),
        )
    ),
    Statement(
        "4.3.3",
        "Friction counts more for the flexible model's compression / direct tension (13g)",
        "fig13",
        flexible_more(QUOTIENT, FRICTION, SHEAR),
    ),
    Statement(
        "4.3.4",
        "With Table 7, indirect tensile strength is above the direct one (14): "
        "direct / indirect below 1",
        "fig14",
        partial(judge.below_one, measure="ratio", where=FLEXIBLE),
    ),
    *(
        Statement(
            "4.3.4",
            f"With Table 7 the flexible model meets Augig's {name} (14)",
            "fig14",
            partial(judge.meets, measure=measure, value=value, where=FLEXIBLE),
        )
        for name, measure, value in (
            ("compressive strength, 122.1 MPa", "compressive_strength", 122.1e6),
            ("indirect tensile strength, 8.8 MPa", "indirect", 8.8e6),
            ("cohesion, 21 MPa", "cohesion", 21e6),
            ("φ, 53 degrees", "friction_angle", 53.0),
        )
    ),
]


def table_of(study: str) -> pandas.DataFrame | None:
    """Results of a study, for the sweeps as measures of the rock; None if not run."""
    file = chosen.out / f"{study}.csv"
    if not file.exists():
        return None
    rows = pandas.read_csv(file)
    return macroscopic(rows, TABLE_KEYS[study]) if study in TABLE_KEYS else rows


def packings(table: pandas.DataFrame | None) -> str:
    """How many packings a study is of; step times are of one."""
    return "1" if table is None or "seed" not in table else str(table["seed"].nunique())


chosen = options(__doc__)
chosen.out.mkdir(parents=True, exist_ok=True)
tables = {study: table_of(study) for study in {statement.study for statement in STATEMENTS}}
found = pandas.DataFrame(
    {
        "Section": statement.section,
        "The paper says": statement.says,
        "Packings": packings(tables[statement.study]),
        "Here": judge.NOT_RUN
        if tables[statement.study] is None
        else statement.judge(tables[statement.study]),
    }
    for statement in STATEMENTS
)
found.to_csv(chosen.out / "statements.csv", index=False)
print(found.to_string(index=False))
verdicts = found["Here"].map(judge.overall)
names = [name for name in SHOWN if name in set(verdicts)]
counts = pandas.crosstab(found["Section"], verdicts, margins=True, margins_name="all")[names]
counts.to_csv(chosen.out / "verdicts.csv")
print(counts.to_string())
