# SPDX-License-Identifier: GPL-3.0-or-later
"""Folder of a custom test: its inputs, its result, its files. SI units."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ...errors import InputError
from ...files import (
    FolderLock,
    Table,
    output_folder,
    read_json,
    refuse_folders,
    remove_earlier,
)
from ...kinds.registry import OWN
from ...materials.mixing import is_brittle
from ...models.grains import Model
from ...models.spheres import SphereModel
from ...renamed import comparable, current, current_stage
from ...report.pages.page import FILE as REPORT
from ...report.words import turns_by
from ...results import measures
from ...results.cracks import MODES
from ...results.result import Result
from ...runs.asked import write_report
from ...runs.loading_rate import WAITING_MODELS, rates_of
from ...runs.output import BEGUN, RESULT, is_of_flexpm, refuse_other_kind
from ...runs.run_inputs import RunInputs
from ...runs.run_spec import described, law_of, results_of
from ...runs.written import FILES, write_files
from ...specimens.files import given
from ..readings import RigReadings, ended_rising
from .result import result_of

#: Number of the way in which the inputs of a script's own test are written.
SCHEMA = 1
_ONSETS = [on for mode in MODES.values() for on in (f"first_{mode}_crack", f"{mode}_onset")]
#: What a record without an area has no meaning of: its stress is the load.
_STRESSES = ("peak_stress", *(f"{onset}_stress" for onset in _ONSETS))
#: What one without a length has none of: its strain is the displacement.
_STRAINS = ("peak_strain", *(f"{onset}_strain" for onset in _ONSETS))
#: What needs both.
_MODULI = ("youngs_modulus", "poissons_ratio", "elastic_poissons_ratio", "softening_slope")

#: What stays in a test, from its first stage to its last.
_FIXED = ("test", "specimen", "material", "model", "points", "mesh", "ends", "parts", "drive")


def save(
    rig: RigReadings,
    stages: Sequence[Table],
    folder: Path | str,
    *,
    report: bool = True,
    step_time: float | None = None,
) -> Result:
    """Write the present results of a custom test; arguments as for ``TestRig.save``."""
    place = output_folder(folder)
    refuse_folders(place, FILES)
    lock = FolderLock(place)
    inputs = inputs_of(rig, stages)
    _refuse_others(place, inputs)
    result = result_so_far(rig, inputs)
    result.step_time = step_time
    given.save(place, rig.built.specimen)
    assert result.snapshot is not None
    write_files(place, result)
    if report:
        write_report(place, result)
    else:
        remove_earlier(place / REPORT)
    del lock  # the folder is free from here on
    return result


class OwnInputs(RunInputs):
    """Inputs of a custom test that are known before its first stage."""

    @property
    def results(self) -> int:
        """Number of the results, see ``results_number``."""
        return results_of(self)


def inputs_before(built: Model | SphereModel) -> OwnInputs:
    """Specimen, material and model, from which a test begins."""
    run = OwnInputs(
        OWN.name, built.specimen.spec, described(built.material, built.name), built.name
    )
    if isinstance(built, Model):
        run = replace(
            run,
            points=built.points,
            mesh=built.mesh,
            dynamic=built.dynamic,
            gravity=built.gravity,
            damping=built.damping,
        )
    return run


def inputs_of(rig: RigReadings, stages: Sequence[Table]) -> Table:
    """Return the inputs of the test that plain values can describe."""
    loads = [stage for stage in stages if "rate" in stage]
    run = replace(
        inputs_before(rig.built),
        rate=loads[-1]["rate"] if loads else RunInputs.rate,
        loading=_loading(rig, stages),
        confinement=rig.confinement or 0.0,
    )
    told = {"schema": SCHEMA, "repeatable": False, **rig.layout, "stages": [*stages]}
    content: Table = json.loads(json.dumps({**run.to_json(), **told, "doubts": rig.warnings}))
    return content


def _loading(rig: RigReadings, stages: Sequence[Table]) -> str:
    """Kind of the last loading; ``stress_to`` waits for cracks where grains can."""
    kinds = [stage["kind"] for stage in stages if "kind" in stage]
    waits = any("stress" in stage for stage in stages) and rig.built.name in WAITING_MODELS
    return kinds[-1] if kinds else "waiting" if waits else "constant"


def result_so_far(rig: RigReadings, inputs: Table) -> Result:
    """Return the present result of the test."""
    waiting = inputs["loading"] == "waiting"
    result = result_of(rig, OWN.name, _largest_unbalanced(rig, waiting), waiting=waiting)
    result.inputs = inputs
    drive = inputs.get("drive", {})
    without_area, without_length = (drive.get(size) == 1.0 for size in ("area", "length"))
    for name in (
        *(_STRESSES if without_area else ()),
        *(_STRAINS if without_length else ()),
        *(_MODULI if without_area or without_length else ()),
    ):
        setattr(result, name, None)
    rises = measures.still_rises(result.curve)
    if drive and not turns_by(drive, solid=rig.solid) and len(result.curve) and not rises:
        result.peak_load = float(result.curve["load"].max())
    if ended_rising(inputs["stages"], result.curve) and result.status != "diverged":
        result.status = "no_peak"
    return result


def _largest_unbalanced(rig: RigReadings, waiting: bool) -> float:
    """Largest unbalanced-force ratio that is quasi-static [-], infinite where none is known."""
    rates = rates_of(rig.kind, rig.built.name, solid=rig.solid)
    ratio = rates.quasistatic
    if waiting:
        brittle = is_brittle(described(rig.built.material, rig.built.name))
        ratio = None if rates.waiting_ratios is None else rates.waiting_ratios[brittle]
    return math.inf if ratio is None else ratio


def _refuse_others(folder: Path, inputs: Table) -> None:
    """Reject a folder with another run than an earlier state of this test.

    Raises:
        InputError: for such a folder.
    """
    refuse_other_kind(folder, "run")
    file = folder / RESULT
    if (folder / BEGUN).exists():
        whose = "another run"
    elif not file.exists() or _is_earlier(file, inputs):
        return
    else:
        whose = "another run" if is_of_flexpm(file) else "another program"
    raise InputError(
        f"save: folder = {str(folder)!r}, has files of {whose}, which would be replaced; choose "
        "another folder"
    )


def _is_earlier(file: Path, inputs: Table) -> bool:
    """Whether a result.json belongs to the same test, at this or an earlier stage."""
    try:
        there = current(read_json(file))["inputs"]
        stages = [comparable(current_stage(one)) for one in there["stages"]]
        now = [comparable(one) for one in inputs["stages"]]
        same = all(_fixed(there, name) == _fixed(inputs, name) for name in _FIXED)
        # the last one may have been under way, without its last step
        pairs = zip(stages, now[: len(stages)], strict=True)
        return same and all(
            later.get(key) == value for one, later in pairs for key, value in one.items()
        )
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return False


def _fixed(inputs: Table, name: str) -> object:
    """Return an input without the labels of a material and without the positions of parts.

    The last digits of a position depend on the present position of the part.
    """
    value = inputs.get(name)
    if name == "material":
        return law_of(inputs[name])
    if name == "parts":
        moving = ("position", "face")  # without erased grains a face is shorter
        return [{key: one[key] for key in one if key not in moving} for one in inputs.get(name, ())]
    return value
