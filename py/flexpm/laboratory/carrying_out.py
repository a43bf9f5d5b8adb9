# SPDX-License-Identifier: GPL-3.0-or-later
"""Doing a run: its scene, its rig, the stages of its test, its files. SI units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import yade

from .._flexpm import give_back_memory
from ..kinds.option import END_FRICTION, JAW_RADIUS
from ..kinds.pulse import FREE, SIDES
from ..kinds.test_kind import Rig, Stage
from ..models.grains import Model, build
from ..models.spheres import SphereModel
from ..progress import Progress
from ..results.result import Result
from ..results.vtu import write_vtu
from ..rigs.fitting import rig as rig_of
from ..rigs.frames import FRAMES, FrameWriter, LastState, show_frames
from ..rigs.rig import TestRig
from ..rigs.solids.disc_rig import SolidDiscRig
from ..rigs.solids.end_rig import EndRig
from ..rigs.solids.wave_rig import SolidWaveRig
from ..rigs.wave_rig import WaveRig
from ..runs.asked import write_report
from ..runs.kept_packing import keep
from ..runs.loading_rate import Loading
from ..runs.loading_start import LoadingStart
from ..runs.output import RESULT, ROSE, Output
from ..runs.run_spec import RunSpec
from ..runs.runner import Foresee, Runner
from ..runs.written import about, write_files, write_so_far
from ..specimens.specimen import AnySpecimen, Specimen
from . import halving
from .outcome import outcome
from .part_tests import part_rig, prepared
from .plan import Plan


def carry_out(
    plan: Plan,
    *,
    threads: int = 1,
    progress: Progress | None = None,
    foresee: Foresee | None = None,
    announce: Callable[[str], None] | None = None,
) -> Result:
    """Do a run; arguments and outcome as for ``run``.

    Args:
        plan: The run.
        threads: Number of threads of a step.
        progress: Function that is called with (steps done, steps expected, text).
        foresee: Function that is called once per loading, after steps of it have been timed, with
            the expected number of steps and the wall time of the remaining steps [s].
        announce: Function that is called with a line before a slower loading begins: result of the
            last loading and expected cost of the next loading.
    """
    spec, folder, checkpoint = plan.spec, plan.folder, plan.checkpoint
    if folder is not None:
        packing = keep(folder, plan.specimen)
        if checkpoint is not None:
            checkpoint.packing = packing
    start = LoadingStart(folder)
    runner = Runner(checkpoint, progress, foresee)
    restore = checkpoint.restore if checkpoint is not None and checkpoint.found else None
    while True:
        position = runner.position
        rate = halving.rate_of(spec, len(position.tried))
        rig, result = _tested(plan, replace(spec, rate=rate), runner, threads, start, restore)
        result.inputs = spec.to_json()
        result.step_time = runner.step_time
        if spec.halvings is None:
            break
        settled = position.start.get("step", 0)
        loadings = [*position.tried, halving.loading(result, rate, settled)]
        if halving.is_over(spec, loadings):
            halving.conclude(result, loadings)
            start.forget()
            break
        _announce(halving.told(spec, loadings), announce, progress, result.steps)
        position = start.after(replace(position, tried=loadings))
        runner = Runner(checkpoint, progress, foresee, position)
        restore = start.restore if position.start else None
    result.resumed_at = checkpoint.resumed_at if checkpoint is not None else None
    if folder is not None:
        write_files(folder, result)
        _write_others(folder, result, plan.output, rig)
    return result


def _tested(
    plan: Plan,
    spec: RunSpec,
    runner: Runner,
    threads: int,
    start: LoadingStart,
    restore: Callable[[], None] | None,
) -> tuple[TestRig, Result]:
    """Build the scene of a run, or load a saved scene, and do the remaining part of the test."""
    folder, output = plan.folder, plan.output
    yade.O.reset()
    specimen, material = prepared(spec, plan.specimen, plan.material)
    built = build(
        specimen,
        material,
        spec.model,
        points=spec.points,
        mesh=spec.mesh,
        damping=spec.settling_damping,
        dynamic=spec.dynamic,
        gravity=spec.gravity,
        interaction_range=spec.interaction_range,
        threads=threads,
    )
    give_back_memory()  # making a large solid takes twice what it needs
    if restore is not None:
        restore()
        built.rebind()
        built.set_threads(threads)
    elif folder is not None:
        write_vtu(folder / "specimen.vtu", built.snapshot(), about(spec.to_json()))
        give_back_memory()
        if specimen.spec.networks:
            _draw_network(folder / ROSE, specimen)
    rig = _rig_of(built, spec, runner)
    if folder is not None and not (folder / RESULT).exists():  # else they are those of the end
        runner.leave = partial(_leave, folder, rig, plan.spec)
    if folder is not None and output.frames:
        rig.watch = _frame_writer(plan, spec, restore)
    for stage in spec.kind.stages:
        if spec.halvings is not None and spec.kind.settles and stage in (Stage.LOAD, Stage.SLIDE):
            rig.keep_start(start)
        _STAGES[stage](rig, spec)
    rig.finish()
    give_back_memory()
    result = outcome(rig, spec)
    give_back_memory()
    return rig, result


def _draw_network(path: Path, specimen: AnySpecimen) -> None:
    """Write the picture of the fracture networks of a specimen."""
    if isinstance(specimen, Specimen):
        from ..report.rose import rose_picture

        rose_picture(path, specimen)
    else:
        from ..report.stereonet import stereonet_picture

        stereonet_picture(path, specimen)


def _leave(folder: Path, rig: TestRig, spec: RunSpec) -> None:
    """Write the tables of a test that is under way, once there is a record."""
    if not rig.diverged and len(rig.record):
        with rig.looked_at():
            write_so_far(folder, outcome(rig, spec))


def _frame_writer(plan: Plan, spec: RunSpec, restore: Callable[[], None] | None) -> FrameWriter:
    """Return the frames of a run, which continue the frames of a resumed checkpoint."""
    assert plan.folder is not None
    resumed_at = yade.O.iter if restore is not None else None
    checkpoint, memory = plan.checkpoint, None
    # else the checkpoint knows the frames of a faster loading, which a slower one replaces
    if checkpoint is not None and checkpoint.resumed_at == resumed_at is not None:
        memory = checkpoint.told.get(FRAMES)
    frames = FrameWriter(
        *(plan.folder, plan.output.frames, about(spec.to_json()), resumed_at), memory
    )
    if checkpoint is not None:
        checkpoint.telling = lambda: {FRAMES: frames.remember()}
    return frames


def _announce(
    line: str,
    announce: Callable[[str], None] | None,
    progress: Progress | None,
    steps: int,
) -> None:
    """Announce a slower loading; without a function, by the progress."""
    if announce is not None:
        announce(line)
    elif progress is not None:
        progress(0, max(steps, 1), line)


def _rig_of(built: Model | SphereModel, spec: RunSpec, runner: Runner) -> TestRig:
    if spec.kind.rig is Rig.PARTS and isinstance(built, Model):
        return part_rig(built, spec, runner)
    if spec.kind.rig is Rig.WAVE and isinstance(built, Model):
        kind = SolidWaveRig if spec.is_solid else WaveRig
        return kind(built, spec.wave or "", free=spec.own.get(SIDES) == FREE, runner=runner)
    rig = rig_of(built, tension=spec.kind.pulls, runner=runner)
    friction = spec.own.get(END_FRICTION.name)
    if isinstance(rig, EndRig) and isinstance(friction, float):
        rig.roughen(friction)
    radius = spec.own.get(JAW_RADIUS)
    if isinstance(rig, SolidDiscRig) and isinstance(radius, float):
        rig.bend(radius)
    return rig


def _write_others(folder: Path, result: Result, output: Output, rig: TestRig) -> None:
    """Write optional files: the report, the last frame, the film."""
    if output.report:
        write_report(folder, result)
    if isinstance(rig.watch, FrameWriter):
        rig.watch.finish(LastState.of(rig))
        show_frames(folder, rig.watch.frames, result, output.film)


def _confine(rig: TestRig, spec: RunSpec) -> None:
    second = spec.own.get("second_confinement")
    if isinstance(rig, EndRig) and isinstance(second, float):
        rig.confine(spec.confinement, second)
    else:
        rig.confine(spec.confinement)
    rig.built.damping = spec.local_damping


def _load(rig: TestRig, spec: RunSpec) -> None:
    static = spec.start == "static"
    control = spec.kind.controls[spec.control] if spec.control else ""
    rig.load(Loading(spec.rate, spec.loading, static, spec.max_strain, spec.stop_ratio, control))


def _press(rig: TestRig, spec: RunSpec) -> None:
    pressure = spec.pressure
    if pressure > 0.0:
        rig.confine(pressure)
    rig.built.damping = spec.local_damping


def _slide(rig: TestRig, spec: RunSpec) -> None:
    """Continue to the largest displacement at any stress."""
    way = spec.max_displacement
    strain = None if way is None else way / rig.scales().height
    rig.load(Loading(spec.rate, spec.loading, max_strain=strain, stop_ratio=0.0))


def _send(rig: TestRig, _: RunSpec) -> None:
    assert isinstance(rig, WaveRig)
    rig.send()


_STAGES: dict[Stage, Callable[[TestRig, RunSpec], None]] = {
    Stage.CONFINE: _confine,
    Stage.PRESS: _press,
    Stage.LOAD: _load,
    Stage.SLIDE: _slide,
    Stage.SEND: _send,
}
