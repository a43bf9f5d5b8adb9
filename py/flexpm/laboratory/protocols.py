# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on a specimen, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yade
from yade import wrapper

from .._version import __version__
from ..errors import SimulationError
from ..files import output_folder
from ..materials import material as materials
from ..materials.material import Material
from ..models import grains as models
from ..models.grains import Model
from ..models.options import SPHERE_MODELS
from ..progress import Progress
from ..report import curves as plot
from ..report import maps as plot_maps
from ..require import require_known
from ..results import vtu as export
from ..results.cracks import cracks_from_snapshot
from ..results.record import COLUMNS, Curve
from ..results.result import Result
from ..specimens.specimen import Specimen
from .checkpoint import INTERVAL, Checkpoint
from .grain_loading import loading_of, squeeze_disc
from .loading_rate import quasistatic_ratio
from .run_spec import RunSpec, described
from .runner import Course
from .schedule import Schedule, schedule

#: A fall of the stress counts once this share of the reference strength has been reached [-].
_LEAST_PEAK = 0.2
#: Rows of the record while a wave crosses the specimen, at least; the strain grows by no more than
#: the rate constant's part of the reference strain meanwhile.
_ROWS_A_CROSSING = 8
#: Most steps from one row to the next: so often numbers are checked.
_LONGEST_PERIOD = 100
#: Steps by which the recorder may be late [-].
_LATEST_LOOK = 1000
#: Wave crossings over which an isotropic pressure rises.
_RAMP_CROSSINGS = 10
#: Forces balance once the largest unbalanced one is below this part of the mean contact force [-].
_AT_REST = 0.01
#: Most wave crossings to wait for that.
_LONGEST_REST = 100
#: Share of the elastic limit up to which ``static`` goes [-].
_STATIC_SHARE = 0.9
#: Steps, all of them recorded, that lead there.
_STATIC_STEPS = 20


@dataclass(frozen=True)
class Plan:
    """A run that can be done."""

    spec: RunSpec
    specimen: Specimen
    material: Material
    folder: Path | None
    checkpoint: Checkpoint  #: of an earlier start of the same run, if there was one


def run(
    test: str,
    specimen: Specimen,
    material: Material | str | None = None,
    model: str = "flexible",
    *,
    confinement: float = 0.0,
    points: int = 3,
    mesh: str = "refined",
    rate: float = 1.0,
    max_strain: float | None = None,
    stop_ratio: float = RunSpec.stop_ratio,
    dynamic: bool = False,
    gravity: float = 0.0,
    start: str | None = None,
    loading: str | None = None,
    threads: int = 1,
    out: Path | str | None = None,
    progress: Progress | None = None,
    checkpoint_interval: float = INTERVAL,
) -> Result:
    """Run a test in YADE's scene, which is reset first and holds the final state afterwards.

    With `out`, checkpoints are saved there. A run into a folder that holds a checkpoint of the same
    inputs goes on from it, to the same bits as without an interruption; if that run was complete,
    its result is returned and no step is done.

    Args:
        test: ``uniaxial``: compression between frictionless ends; ``tension``: direct tension of
            the same ends; ``biaxial``: compression under `confinement`, applied to all sides first;
            ``brazilian``: a disc between two plates.
            A test is over when the stress above the confinement has fallen to `stop_ratio` of its
            peak or the strain reaches `max_strain`.
        specimen: A rectangle, y is the axial direction; for ``brazilian`` a disc.
        material: Preset, file, or material; None for the default of the model.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        confinement: Lateral pressure [Pa], for ``biaxial`` only.
        points: Contact points per contact, 1, 2 or 3.
        mesh: ``refined`` or ``fan``.
        rate: Factor on the default loading rate [-], > 0.
        max_strain: Largest axial strain [-]; None for 8 times that of the reference strength, 16
            times for discs.
        stop_ratio: Part of its peak to which the stress falls before the test ends [-]: above 0, at
            most 0.9. What comes after a peak takes most of a confined test.
        dynamic: Real masses and time instead of scaled masses and unit steps.
        gravity: Acceleration downwards [m/s2]; other than 0 with `dynamic` only.
        start: ``rest``, or ``static``: begin at the elastic solution just below the first crack;
            for uniaxial compression and tension of the flexible model. None: ``static`` for its
            tension with scaled masses, else ``rest``.
        loading: ``adaptive``: faster than the rate while the specimen is elastic, down to the rate
            as damage and friction take the work; ``constant``: at the rate. None: ``adaptive`` for
            the grain models with scaled masses, else ``constant``.
        threads: Threads of a step; results do not depend on it.
        out: Folder for the files of the result; None writes nothing.
        progress: Called with (steps done, steps expected, text).
        checkpoint_interval: Wall time between two checkpoints [s], > 0.

    Returns:
        The measures, the record and the cracks.

    Raises:
        InputError: for an argument out of range, or if `out` holds a checkpoint of other inputs.
    """
    chosen = materials.load(material, model)
    spec = RunSpec(
        test,
        specimen.spec,
        described(chosen, model),
        model,
        points=points,
        mesh=mesh,
        confinement=confinement,
        rate=rate,
        max_strain=max_strain,
        stop_ratio=stop_ratio,
        dynamic=dynamic,
        gravity=gravity,
        start=start or "",
        loading=loading or "",
    )
    plan = plan_run(spec, specimen, chosen, out, checkpoint_interval)
    return carry_out(plan, threads=threads, progress=progress)


def plan_run(
    spec: RunSpec,
    specimen: Specimen,
    material: Material,
    out: Path | str | None = None,
    checkpoint_interval: float = INTERVAL,
) -> Plan:
    """Refuse what a run could not do, before YADE's scene is touched.

    Args:
        spec: The run.
        specimen: The grains that `spec` describes.
        material: The material that `spec` describes.
        out: Folder for the files of the result; None writes nothing.
        checkpoint_interval: Wall time between two checkpoints [s], > 0.

    Raises:
        InputError: for a test that is no simulation, or a checkpoint of other inputs in `out`.
    """
    require_known("run: test", spec.test, list(TESTS))
    folder = None if out is None else output_folder(out)
    return Plan(spec, specimen, material, folder, Checkpoint(folder, spec, checkpoint_interval))


def carry_out(plan: Plan, *, threads: int = 1, progress: Progress | None = None) -> Result:
    """Do a run; arguments and outcome as for ``run``."""
    spec, folder, checkpoint = plan.spec, plan.folder, plan.checkpoint
    yade.O.reset()
    built = models.build(
        plan.specimen,
        plan.material,
        spec.model,
        points=spec.points,
        mesh=spec.mesh,
        dynamic=spec.dynamic,
        gravity=spec.gravity,
        threads=threads,
    )
    if checkpoint.found:
        checkpoint.restore()
        built.rebind()
        built.set_threads(threads)
    elif folder is not None:
        export.write_vtu(folder / "specimen.vtu", built.snapshot())
    result = tests_of(spec.model)[spec.test](built, spec, Course(checkpoint, progress))
    result.inputs = spec.to_json()
    result.resumed_at = checkpoint.resumed_at
    result.measure_fragments(built.snapshot())
    if folder is not None:
        write_files(folder, result)
    return result


def run_uniaxial(built: Model, spec: RunSpec, course: Course) -> Result:
    """Compress a built specimen axially without lateral pressure."""
    return _run_axial(built, spec, course)


def run_tension(built: Model, spec: RunSpec, course: Course) -> Result:
    """Pull a built specimen axially."""
    return _run_axial(built, spec, course)


def run_biaxial(built: Model, spec: RunSpec, course: Course) -> Result:
    """Press a built specimen from all sides, then compress it axially under lateral pressure.

    Strains count from the isotropic state.
    """

    loading = loading_of(built)

    def prepare() -> None:
        crossing = math.ceil(wrapper.AxialRecorder().scales()["crossing_steps"])
        loading.confine(built, spec.confinement, _RAMP_CROSSINGS * crossing)

    course.stage(prepare, lambda: _settle(built, course, loading.ramp(built)))
    return _run_axial(built, spec, course, lambda: loading.hold(built), fromNow=True)


def run_brazilian(built: Model, spec: RunSpec, course: Course) -> Result:
    """Press a built disc between two plates; stress 2 P / (pi D t), strain closure / D."""
    result = _finish(built, spec, course, lambda: load(built, spec))
    result.youngs_modulus = None  # the slope of the plates' closure is no modulus of the rock
    result.poissons_ratio = None
    result.contact_width = float(np.mean([p["contact_width"] for p in built.solver.plates()]))
    return result


def load(built: Model, spec: RunSpec, **options: Any) -> None:
    """Put the engines that load and record a test into the scene.

    Args:
        built: The specimen; for ``biaxial`` already under its lateral pressure.
        spec: Test, rate, loading and end.
        options: Attributes of the ``AxialRecorder``.
    """
    disc, tension = spec.test == "brazilian", spec.test == "tension"
    diameter = built.specimen.dimensions["diameter"] if disc else 0.0
    recorder = wrapper.AxialRecorder(diameter=diameter, tension=tension, **options)
    built.add_engines(after=(recorder,))
    plan = _limit(recorder, built, spec)
    # the elastic velocities raise no wave, so a test that has them may begin at the fastest rate
    pace = 1.0 if disc else plan.fastest_pace
    velocity = pace * plan.velocity
    if disc:
        recorder.loading = squeeze_disc(built, velocity)
    else:
        recorder.loading = loading_of(built).drive(built, velocity if tension else -velocity)
    recorder.loading.velocityFactor = pace
    if plan.fastest_pace > 1.0:
        engine = wrapper.LoadingRateController(
            loading=recorder.loading,
            fastest=plan.fastest_pace,
            crossingSteps=recorder.scales()["crossing_steps"],
        )
        built.add_engines(last=(engine,))


TESTS: dict[str, Callable[..., Result]] = {
    "uniaxial": run_uniaxial,
    "tension": run_tension,
    "biaxial": run_biaxial,
    "brazilian": run_brazilian,
}


def tests_of(model: str) -> dict[str, Callable[..., Result]]:
    """Tests that a model can do, by name."""
    if model in SPHERE_MODELS:
        from . import sphere_protocols as yade_protocols  # which needs this module

        return yade_protocols.TESTS
    return TESTS


def _run_axial(
    built: Model,
    spec: RunSpec,
    course: Course,
    before: Callable[[], None] = bool,
    **options: Any,
) -> Result:
    """Drive the top of a built specimen until the test is over."""

    def prepare() -> None:
        before()
        load(built, spec, **options)

    if spec.start == "static":
        course.stage(
            lambda: _lead(built, prepare),
            lambda: course.run_to(
                course.stage_start + _STATIC_STEPS,
                expected=_STATIC_STEPS,
                over=lambda: built.engine("AxialRecorder").state != 0,
            ),
        )
        return _finish(built, spec, course, lambda: _go_on(built))
    return _finish(built, spec, course, prepare)


def _lead(built: Model, prepare: Callable[[], None]) -> None:
    """Record each step of the way along the elastic solution."""
    prepare()
    built.engine("EndDisplacementController").preload(_STATIC_SHARE, _STATIC_STEPS)
    built.solver.measurePeriod = 1


def _go_on(built: Model) -> None:
    built.solver.measurePeriod = _row_period(built.engine("AxialRecorder").scales())
    built.engine("EndDisplacementController").release()


def _row_period(scales: dict[str, float]) -> int:
    """Steps from one row of the record to the next."""
    return min(math.ceil(scales["crossing_steps"] / _ROWS_A_CROSSING), _LONGEST_PERIOD)


def _limit(recorder: Any, built: Model, spec: RunSpec) -> Schedule:
    """Tell the recorder when the test is over."""
    scales = recorder.scales()
    plan = schedule(scales, spec)
    built.solver.measurePeriod = _row_period(scales)
    built.solver.mirrorPeriod = built.solver.checkPeriod  # nothing in a test reads the bodies
    recorder.maxStrain = plan.max_strain
    recorder.stopRatio = plan.stop_ratio
    recorder.leastPeak = spec.confinement + _LEAST_PEAK * scales["strength"]
    return plan


def _finish(built: Model, spec: RunSpec, course: Course, prepare: Callable[[], None]) -> Result:
    """Do the last stage of a test, in which its recorder works."""
    diverged = False

    def advance() -> None:
        nonlocal diverged
        recorder = built.engine("AxialRecorder")
        plan = schedule(recorder.scales(), spec)
        diverged = _drive(plan, built, course)

    course.stage(prepare, advance)
    built.solver.mirrorPeriod = 1  # a script may go on from here
    built.solver.mirrorBodies()
    if not diverged:
        course.finish()
    return _result(spec.test, built, diverged, course.step_time)


def _settle(built: Model, course: Course, ramp: int) -> None:
    """Raise the pressure in `ramp` steps and run until the forces balance, looking now and then."""
    steps = math.ceil(ramp / _RAMP_CROSSINGS)
    expected = course.stage_start + ramp + 10 * steps
    for look in range(1, _LONGEST_REST + 1):
        end = course.stage_start + ramp + look * steps
        if end < yade.O.iter:
            continue  # a resumed run has looked then
        course.run_to(end, expected=expected, text=lambda: "isotropic pressure")
        if built.solver.unbalanced() < _AT_REST:
            return
    raise SimulationError(
        f"run: unbalanced-force ratio = {built.solver.unbalanced():.2g} after the isotropic stage, "
        f"must fall below {_AT_REST}; lower the confinement"
    )


def write_files(folder: Path, result: Result) -> None:
    """Write numbers, record, cracks, final state and pictures of a result into `folder`."""
    result.write(folder)
    export.write_vtu(folder / "final.vtu", result.snapshot)
    plot.curve_picture(folder / "curve.png", result)
    minerals = [kind["name"] for kind in result.material.get("minerals", ())]
    plot_maps.crack_picture(folder / "cracks.png", result.snapshot, minerals=minerals)
    plot_maps.fragment_picture(folder / "fragments.png", result.snapshot)


def _drive(plan: Schedule, built: Model, course: Course) -> bool:
    """Run until the recorder stops the simulation; tell whether a number was not finite."""
    recorder = built.engine("AxialRecorder")
    # most tests end well before the largest strain; the bar grows if one does not
    likely = math.ceil(2.0 * plan.reference_strain / plan.max_strain * plan.steps)
    try:
        course.run_to(
            # the recorder looks now and then, so it may find the end a little late
            course.stage_start + plan.steps + _LATEST_LOOK,
            expected=course.stage_start + min(plan.steps, likely),
            text=lambda: f"peak {recorder.peak * 1e-6:5.1f} MPa",
            over=lambda: recorder.state != 0,
        )
    except RuntimeError:
        if not built.solver.diverged:
            raise
        return True
    return False


def _result(test: str, built: Model, diverged: bool, step_time: float | None) -> Result:
    counts, recorder = built.solver.counts(), built.engine("AxialRecorder")
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=test,
        model=built.name,
        material=built.describe_material(),
        seed=built.specimen.seed,
        grains=counts["grains"],
        contacts=counts["contacts"],
        nodes=counts["nodes"],
        triangles=counts["triangles"],
        particles=counts["particles"],
        inner_contacts=counts["inner_contacts"],
        step_time=step_time,
    )
    names = recorder.names
    columns = [names.index(name) for name in COLUMNS]
    result.curve = Curve.from_array(recorder.rows[:, columns])
    result.cracks = cracks_from_snapshot(built.snapshot(), result.curve)
    result.measure(
        quasistatic_ratio(result.test, built.name),
        diverged=diverged,
        initial_energy=built.solver.energies()["initial_energy"],
    )
    return result
