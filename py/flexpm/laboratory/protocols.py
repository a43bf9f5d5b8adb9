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
    """Run a laboratory test in YADE's scene, and return its result.

    The scene is reset first, and holds the final state afterwards. With `out`, checkpoints are
    saved in that folder. If the folder holds a checkpoint of the same inputs, the run resumes from
    it and reaches the same bits as an uninterrupted run. If the folder holds the finished run, its
    result is returned without a step.

    Args:
        test: Name of the test, see the list below. A test ends when the deviator (axial stress
            minus least confining pressure) has dropped to `stop_ratio` of its peak, or when the
            strain reaches `max_strain`. Under a confining pressure and without `max_strain` it also
            ends when the deviator has been constant within 2 % over a strain of 0.5 %.
        specimen: The bonded grains, 2D or 3D. The axial direction is y in 2D and z in 3D.
        material: Name of a preset, TOML file, or material; None: the default of model and
            dimension.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        threads: Number of threads of a step; results do not depend on it. Default: 1.
        out: Folder for the files of the result; None writes no files.
        progress: Function that is called with (steps done, steps expected, text).
        checkpoint_interval: Wall time between two checkpoints [s], > 0. Default: 30.
        options: The keywords below, in SI units. Some keywords apply to a few tests only.

    Keyword Args:
        {keywords}

    Tests and the shapes of their specimens:

        {tests}

    Returns:
        Measured quantities, record and cracks.

    Raises:
        InputError: for an argument out of range, or if `out` holds a checkpoint of other inputs.

    Example:
        A direct tension test on a specimen of 37 grains, too few and too fast for a strength:

        >>> result = flexpm.run("tension", specimen, rate=6.0)
        >>> print(result.status)
        not_quasistatic
        >>> round(result.youngs_modulus / 1e9, 1)  # [GPa]
        24.4
        >>> result.curve["axial_stress"].max() == result.peak_stress
        True
    """
    require_specimen("run", specimen)
    asked: Table = {**options}
    output = Output(**{name: asked.pop(name) for name in options_of(Output) if name in asked})
    chosen = load_material(material, model, solid=is_solid(specimen.spec.kind))
    spec = RunSpec.asked(test, specimen.spec, chosen, {"model": model, **asked})
    plan = plan_run(spec, specimen, chosen, out, checkpoint_interval, output)
    return carry_out(plan, threads=threads, progress=progress)
