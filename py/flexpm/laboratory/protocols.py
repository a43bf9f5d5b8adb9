# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on a specimen, paper Sec. 4.1. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Unpack

from ..dimensions import is_solid
from ..files import Table
from ..materials.material import Material
from ..materials.material import load as load_material
from ..progress import Progress
from ..results.result import Result
from ..runs.checkpoint import INTERVAL
from ..runs.groups import GrainOptions, RunOptions, documented, options_of
from ..runs.output import Output
from ..runs.run_spec import RunSpec
from ..specimens.specimen import AnySpecimen, require_specimen
from .carrying_out import carry_out
from .plan import plan_run


@documented
def run(
    test: str,
    specimen: AnySpecimen,
    material: Material | str | None = None,
    model: str = GrainOptions.model,
    *,
    threads: int = 1,
    out: Path | str | None = None,
    progress: Progress | None = None,
    checkpoint_interval: float = INTERVAL,
    **options: Unpack[RunOptions],
) -> Result:
    """Run a test in YADE's scene, which is reset first and holds the final state afterwards.

    With `out`, checkpoints are saved there. A run into a folder that holds a checkpoint of the same
    inputs goes on from it, to the same bits as without an interruption; if that run was complete,
    its result is returned and no step is done.

    Args:
        test: Name of the test, one of those below. It is over when the deviator, the axial stress
            minus the least confining pressure, has fallen to `stop_ratio` of its peak, when the
            strain reaches `max_strain`, or, under a confining pressure and without `max_strain`,
            when the deviator has been constant within 2 % over a strain of 0.5 %.
        specimen: The grains. The axial direction is y in 2D and z in 3D.
        material: Preset, file, or material; None for the default of model and dimension.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        threads: Threads of a step; results do not depend on it. Default: 1.
        out: Folder for the files of the result; None writes nothing.
        progress: Called with (steps done, steps expected, text).
        checkpoint_interval: Wall time between two checkpoints [s], > 0. Default: 30.
        options: The keywords below, in SI units; an option of some tests is for these alone.

    Keyword Args:
        {keywords}

    Tests and the shapes of their specimens:

        {tests}

    Returns:
        The measures, the record and the cracks.

    Raises:
        InputError: for an argument out of range, or if `out` holds a checkpoint of other inputs.
    """
    require_specimen("run", specimen)
    asked: Table = {**options}
    output = Output(**{name: asked.pop(name) for name in options_of(Output) if name in asked})
    chosen = load_material(material, model, solid=is_solid(specimen.spec.kind))
    spec = RunSpec.asked(test, specimen.spec, chosen, {"model": model, **asked})
    plan = plan_run(spec, specimen, chosen, out, checkpoint_interval, output)
    return carry_out(plan, threads=threads, progress=progress)
