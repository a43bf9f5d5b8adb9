# SPDX-License-Identifier: GPL-3.0-or-later
"""Report of a calibration: table, figure of targets and results, preset. SI units, degrees."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import tomli_w

from ..files import Table, write_text
from ..materials.keys import elastic_set_name
from ..materials.material import Material
from ..materials.material import load as load_material
from ..report.style import drawing
from ..results.strength import tensile_ratio
from ..text import label_of, words_of
from .calibration_measures import ELASTIC_MEASURES, QUOTIENTS, is_stress, keys_of
from .calibration_problem import Calibration
from .calibration_search import Evaluation, Outcome

#: A list of numbers or words on several lines of TOML.
_LIST = re.compile(r"(?<== )\[\n(?:    [^\n{]*,\n)+\]")
#: Digits of the values in a preset.
_DIGITS = 4
#: Units by the key of result.json, or of a measure that no single test tells; others are stresses.
_UNITS = {
    "youngs_modulus": (1e-9, "GPa"),
    "poissons_ratio": (1.0, ""),
    "fracture_toughness": (1e-6, "MPa m^0.5"),
    "friction_angle": (1.0, "degrees"),
    "hoek_brown_m": (1.0, ""),
    "direct_indirect_ratio": (1.0, ""),
    "drop_after_peak": (1.0, ""),
}
#: Direct over indirect tension that granites show [-], as the record has it.
_GRANITES = 0.77


def table_rows(plan: Calibration, outcome: Outcome) -> list[tuple[str, str]]:
    """Name and text of each target: result, spread, error of the mean, target, met or not.

    Where both strengths in tension are targets their ratio follows, beside what granites show.
    """
    rows = []
    for target in plan.targets:
        factor, unit = unit_of(target.name)
        best = outcome.best
        mean, spread, error = (of(target.name) for of in (best.mean, best.spread, best.error))
        text = "-" if mean is None else f"{factor * mean:.4g}"
        if spread is not None and error is not None:
            text += f" ± {factor * spread:.2g}, error of the mean {factor * error:.2g}"
        verdict = "met" if outcome.met[target.name] else "NOT met"
        least = "at least " if target.least else ""
        wanted = f"{least}{factor * target.value:.4g} {unit}".rstrip()
        # a run gives another Poisson's ratio where points soften early
        kind = "elastic " if target.name in ELASTIC_MEASURES else ""
        rows.append((f"{kind}{words_of(target.name)}", f"{text}, target {wanted}: {verdict}"))
    ratio = _tensile_ratio(outcome.best)
    if ratio is not None:
        rows.append(("direct over indirect tension", f"{ratio:.2f}; granites {_GRANITES:.2f}"))
    return rows


def unit_of(measure: str) -> tuple[float, str]:
    """Factor and unit in which a measure is shown."""
    usual = (1e-6, "MPa") if is_stress(measure) else (1.0, "")
    return _UNITS.get(keys_of(measure)[0], usual)


def _tensile_ratio(best: Evaluation) -> float | None:
    """Direct over indirect tension of the means [-]; None unless both are targets.

    It is no target here, so that it says what the fit has left open.
    """
    names = QUOTIENTS["direct_indirect_ratio"]
    if "direct_indirect_ratio" in best.measures or not best.measures.keys() >= set(names):
        return None
    return tensile_ratio(*map(best.mean, names))


def write_preset(path: Path, start: Material, plan: Calibration, outcome: Outcome) -> Material:
    """Write the material with the best values as a TOML file and return it."""
    assignments = [f"{key}={rounded(value)!r}" for key, value in outcome.best.values.items()]
    found = start.with_set(assignments, plan.model)
    found = dataclasses.replace(found, name=plan.name, made_for=plan.made_for)
    notes = [f"# {name}: {text}" for name, text in table_rows(plan, outcome)]
    head = ["# SPDX-License-Identifier: GPL-3.0-or-later", *_tested_on(plan), *notes]
    write_text(path, "\n".join(head) + "\n\n" + toml_text(content_of(found, plan.model)))
    return load_material(path)


def content_of(material: Material, model: str) -> Table:
    """Return the content of the file of a material, with the elastic set of one model."""
    content = _without_none(dataclasses.asdict(material))
    kinds, joints, pairs = (content.pop(key) for key in ("minerals", "joints", "interfaces"))
    # other models' sets are those of the rock that the search started from
    content["elastic"] = _only_of(model, content["elastic"])
    if joints:
        content["joint"] = {one.pop("name"): _without_none(one) for one in map(dict, joints)}
    if kinds:
        content["mineral"] = [kind | kind.pop("changes") for kind in map(dict, kinds)]
        for kind in content["mineral"]:
            if "elastic" in kind:
                kind["elastic"] = _only_of(model, kind["elastic"])
    if pairs:
        content["interface"] = [
            {"pair": list(one["pair"]), **one["values"], "factor": one["factors"]} for one in pairs
        ]
    return content


def toml_text(content: Table) -> str:
    """Return tables as TOML, each list of numbers or words in one line."""
    return _LIST.sub(_in_a_line, tomli_w.dumps(content))


def _in_a_line(found: re.Match[str]) -> str:
    """Return a list of TOML in one line."""
    entries = found[0].strip("[]").split(",\n")
    return f"[{', '.join(one.strip() for one in entries if one.strip())}]"


def _tested_on(plan: Calibration) -> list[str]:
    """Specimens of the results."""
    packings = ", ".join(map(str, plan.verify.seeds))
    discs = ", ".join(map(str, plan.verify.disc_seeds))
    if not packings:
        return [f"# Calibrated for the {plan.model} model by a function of a script:"]
    return [
        f"# Calibrated for the {plan.model} model. Mean and standard deviation over the packings",
        f"# with the seeds {packings}" + (":" if discs == packings else ""),
        *([] if discs == packings else [f"# and of discs with the seeds {discs}:"]),
    ]


def _only_of(model: str, sets: Mapping[str, Table]) -> Table:
    """The elastic set of a model alone."""
    name = elastic_set_name(model)
    return {name: sets[name]} if name in sets else {}


def rounded(value: float) -> float:
    """A value with the digits that a calibration can tell."""
    return float(f"{value:.{_DIGITS}g}")


def picture(path: Path, plan: Calibration, outcome: Outcome) -> None:
    """Draw each result over its target, with the packings' values and the tolerance."""
    with drawing(path, (5.6, 1.2 + 0.42 * len(plan.targets))) as axes:
        for row, target in enumerate(plan.targets):
            found = np.array(outcome.best.measures[target.name], dtype=float) / target.value
            low, high = 1.0 - target.tolerance, 1.0 + target.tolerance
            if target.least:
                high = max(high, *found[np.isfinite(found)], 1.0)
            axes.barh(row, high - low, left=low, height=0.6, color="#dbe6ee")
            axes.plot(found, np.full(len(found), row), "o", ms=3.5, mfc="none", mec="#0072b2")
            axes.plot(np.mean(found), row, "D", ms=5.0, color="black")
        axes.axvline(1.0, color="0.4", lw=0.8)
        axes.set_yticks(range(len(plan.targets)), [words_of(t.name) for t in plan.targets])
        axes.invert_yaxis()
        axes.set_xlabel("result over target [-]; circles: packings, band: tolerance")
        axes.set_title(label_of(f"{plan.name}, {plan.model} model"), fontsize=9.5, loc="left")


def _without_none(content: Table) -> Table:
    """TOML has no null: keys that are not given are left out."""
    return {
        key: _without_none(value) if isinstance(value, dict) else value
        for key, value in content.items()
        if value is not None
    }
