# SPDX-License-Identifier: GPL-3.0-or-later
"""Plan of a run; impossible inputs are rejected before YADE's scene is changed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from ..files import output_folder, refuse_folders
from ..kinds.option import Asked
from ..kinds.test_kind import Rig
from ..materials.material import Material
from ..models.options import SPHERE_MODELS
from ..require import require_known
from ..rigs.frames import COLLECTION, STATE, TABLE
from ..runs import written
from ..runs.checkpoint import INTERVAL, Checkpoint
from ..runs.output import BEGUN, ROSE, Output, refuse_other_result
from ..runs.run_spec import TESTS, RunSpec
from ..specimens.specimen import AnySpecimen

#: Names of the files of a run.
FILES = (*written.FILES, "specimen.vtu", BEGUN, ROSE, TABLE, COLLECTION, STATE)


@dataclass(frozen=True)
class Plan:
    """A run that can be done."""

    spec: RunSpec
    specimen: AnySpecimen
    material: Material
    folder: Path | None
    checkpoint: Checkpoint | None  #: in the folder, with what an earlier start has left
    output: Output  #: what is written beside the results


def plan_run(
    spec: RunSpec,
    specimen: AnySpecimen,
    material: Material,
    out: Path | str | None = None,
    checkpoint_interval: float = INTERVAL,
    output: Output | None = None,
) -> Plan:
    """Reject impossible inputs of a run before YADE's scene is changed.

    Args:
        spec: The run.
        specimen: The grains that `spec` describes.
        material: The material that `spec` describes.
        out: Folder for the files of the result; None writes nothing.
        checkpoint_interval: Wall time between two checkpoints [s], > 0.
        output: Additional files; None for the default.

    Raises:
        InputError: for a test without simulation, grains without a contact that the test needs, a
            checkpoint of other inputs in `out`, or frames of a run that is already complete.
    """
    output = output or Output()
    if out is None and output.frames:
        raise InputError(f"run: frames = {output.frames}, must be 0 without out; give a folder")
    if output.frames and spec.kind.rig is Rig.WAVE:
        raise InputError(
            f"run: frames = {output.frames}, must be 0 for {spec.test}; leave them out"
        )
    require_known("run: test", spec.test, TESTS)
    _require_contacts(spec, specimen)
    # grains that were given, too, have a mean diameter by now
    spec.kind.settle(Asked(spec.test, specimen.dimensions, spec.options, specimen.mean_diameter))
    folder = None if out is None else output_folder(out)
    if folder is not None:
        refuse_folders(folder, FILES)
    checkpoint = None if folder is None else Checkpoint(folder, spec, checkpoint_interval)
    if folder is not None:
        refuse_other_result(folder, spec)
    if folder is not None and checkpoint is not None and checkpoint.found:
        _require_frames(folder, output)
    return Plan(spec, specimen, material, folder, checkpoint, output)


def _require_frames(folder: Path, output: Output) -> None:
    """Refuse frames of a run that is complete and has none: they are taken while it goes on."""
    if output.frames and (folder / "result.json").is_file() and not (folder / TABLE).is_file():
        raise InputError(
            f"run: frames = {output.frames}, must be 0 in {folder}, where the run is complete "
            f"without; repeat it: flexpm rerun {folder} --frames {output.frames} --out FOLDER"
        )


def _require_contacts(spec: RunSpec, specimen: AnySpecimen) -> None:
    """Refuse a single grain that cannot deform, or whose contacts would set the start."""
    rigid = spec.model in ("rigid", *SPHERE_MODELS)
    grains = len(specimen.radii)
    if not spec.is_solid and grains < 2 and (rigid or spec.start == "static"):
        raise InputError(
            f"run: grains = {grains}, must be >= 2 for {spec.test} of model "
            f"{spec.model} with start {spec.start}; use smaller grains, so that there are contacts"
        )
