# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on a specimen, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import yade
from yade import wrapper

from .._version import __version__
from ..errors import InputError
from ..files import Table, output_folder, refuse_folders
from ..kinds.option import Asked, Value
from ..kinds.registry import kind_of
from ..kinds.test_kind import Rig, Stage
from ..materials.material import Material
from ..materials.material import load as load_material
from ..materials.mixing import is_brittle
from ..models.grains import Model, build
from ..models.options import SPHERE_MODELS
from ..models.spheres import SphereModel
from ..progress import Progress
from ..report.curves import curve_picture
from ..report.emission import emission_picture
from ..report.maps import crack_picture, fragment_picture
from ..report.tables import size_text
from ..report.waves import wave_picture
from ..require import require_known
from ..results.cracks import count_by_pair, cracks_from_snapshot
from ..results.emission import EventRule, event_rule
from ..results.result import Result
from ..results.vtu import read_vtu, write_vtu
from ..rigs.fitting import rig as rig_of
from ..rigs.frames import COLLECTION, STATE, TABLE, FrameWriter
from ..rigs.part_rig import PartRig
from ..rigs.rig import TestRig
from ..rigs.wave_rig import WaveRig
from ..runs.asked import write_report
from ..runs.checkpoint import INTERVAL, Checkpoint
from ..runs.loading_rate import Loading, quasistatic_ratio
from ..runs.output import Output, refuse_other_result
from ..runs.run_spec import TESTS, RunSpec, described
from ..runs.runner import Foresee, Runner
from ..specimens.files import given
from ..specimens.specimen import Specimen, require_specimen
from .part_tests import grains_across, measure, part_rig, prepared

#: Names of the files of a run.
FILES = (
    *("result.json", "curve.csv", "cracks.csv", "events.csv", "fragments.csv"),
    *("specimen.vtu", "final.vtu", "checkpoint.json", given.FILE),
    *("curve.png", "cracks.png", "events.png", "fragments.png"),
    "report.html",
    *(TABLE, COLLECTION, STATE),
)


@dataclass(frozen=True)
class Plan:
    """A run that can be done."""

    spec: RunSpec
    specimen: Specimen
    material: Material
    folder: Path | None
    checkpoint: Checkpoint | None  #: in the folder, with what an earlier start has left
    output: Output  #: what is written beside the results


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
    stop_ratio: float | None = None,
    dynamic: bool = False,
    gravity: float = 0.0,
    start: str | None = None,
    loading: str | None = None,
    span: float | None = None,
    notch: float | None = None,
    normal_stress: float | None = None,
    max_displacement: float | None = None,
    wave: str | None = None,
    control: str | None = None,
    damping: float | None = None,
    interaction_range: float | None = None,
    threads: int = 1,
    out: Path | str | None = None,
    progress: Progress | None = None,
    checkpoint_interval: float = INTERVAL,
    report: bool = True,
    frames: int = 0,
    film: str | None = None,
    **own: Value,
) -> Result:
    """Run a test in YADE's scene, which is reset first and holds the final state afterwards.

    With `out`, checkpoints are saved there. A run into a folder that holds a checkpoint of the same
    inputs goes on from it, to the same bits as without an interruption; if that run was complete,
    its result is returned and no step is done.

    Args:
        test: ``uniaxial``: compression between frictionless ends; ``tension``: direct tension of
            the same ends; ``biaxial``: compression under `confinement`, applied to all sides first;
            ``brazilian``: a disc between two plates, whose axial stress is 2 P / (pi D t), P the
            force, D the diameter, t the thickness; ``bending``: a beam on two supports, pressed in
            the middle; ``scb``: half a disc with a notch on two supports, pressed on top;
            ``shear``: the lower half of a rectangle is pushed along below the upper;
            ``sonic``: a plane pulse through a rectangle, with real masses and without damping, for
            the speed of its `wave`. ``flexpm run --help`` tells all of them.
            A test is over when the stress above the confinement has fallen to `stop_ratio` of its
            peak or the strain reaches `max_strain`.
        specimen: A rectangle, y is the axial direction; for ``brazilian`` a disc.
        material: Preset, file, or material; None for the default of the model.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        confinement: Lateral pressure [Pa], for ``biaxial`` and others that take one.
        points: Contact points per contact, 1, 2 or 3.
        mesh: ``refined`` or ``fan``.
        rate: Factor on the default loading rate [-], > 0.
        max_strain: Largest axial strain [-]; None for 8 times that of the reference strength, 16
            times for discs.
        stop_ratio: Part of its peak to which the stress falls before the test ends [-]: above 0, at
            most 0.9; None: 0.5, and 0.1 in bending. What comes after a peak takes most of a
            confined test.
        dynamic: Real masses and time instead of scaled masses and unit steps.
        gravity: Acceleration downwards [m/s2]; other than 0 with `dynamic` only.
        start: ``rest``, or ``static``: begin at the elastic solution just below the first crack;
            for uniaxial compression and tension of the flexible model. None: ``static`` for its
            tension with scaled masses, else ``rest``.
        loading: ``waiting``: fast, and nearly still while a crack runs, for ``flexible`` and
            ``rigid``; ``adaptive``: faster than the rate while the specimen is elastic, down to the
            rate as damage and friction take the work; ``constant``: at the rate. None: ``waiting``
            for flexible and rigid grains with scaled masses, ``adaptive`` for inner particles
            unless contacts are brittle, else ``constant``.
        span: Distance of the supports in ``bending`` [m]; None: four times the height, or 8/9
            of the length; in ``scb``; None: 0.6 of the diameter.
        notch: Depth of the notch of ``bending`` [m]; None: no notch; of ``scb``; None: half of the
            radius.
        normal_stress: On the upper half in ``shear`` [Pa]; None: 1 MPa.
        max_displacement: At which ``shear`` ends [m]; None: a multiple of that of its strength.
        wave: ``p`` or ``s`` for ``sonic``; None: ``p``.
        control: What grows at the rate, for ``flexible`` and ``rigid``. ``uniaxial``: ``axial``:
            the ends go at it; ``lateral``: the lateral strain does, and the ends go back where the
            specimen snaps back. ``bending`` and ``scb``: ``displacement``, or ``cmod``: the opening
            of the notch. None: the first.
        damping: Local damping alpha of the loading [-], 0 <= alpha < 1, not for ``sonic``; None:
            0.7 with scaled masses, 0 with `dynamic`. Confining pressures act on a specimen that is
            damped with 0.7 at least, until it is at rest.
        interaction_range: For ``jcfpm`` and ``cohfrict``: spheres nearer than this multiple of the
            sum of their radii are bonded, too, 1 to 2 [-]; None: only neighbours.
        threads: Threads of a step; results do not depend on it.
        out: Folder for the files of the result; None writes nothing.
        progress: Called with (steps done, steps expected, text).
        checkpoint_interval: Wall time between two checkpoints [s], > 0.
        report: Write report.html, too.
        frames: Write the state at even strains, this many up to the strain of the reference
            strength, and around the peak; fewer if the test ends before or has fewer rows. 0: none.
        film: ``gif`` or ``mp4``: write a film of the frames, too.
        own: Other options of the test, by the names that ``flexpm run --help`` lists with ``_`` for
            ``-``; SI units.

    Returns:
        The measures, the record and the cracks.

    Raises:
        InputError: for an argument out of range, or if `out` holds a checkpoint of other inputs.
    """
    require_specimen("run", specimen)
    output = Output(report, frames, film)
    chosen = load_material(material, model)
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
        stop_ratio=kind_of(test).stop_ratio if stop_ratio is None else stop_ratio,
        dynamic=dynamic,
        gravity=gravity,
        start=start or "",
        loading=loading or "",
        span=span,
        notch=notch,
        normal_stress=normal_stress,
        max_displacement=max_displacement,
        wave=wave,
        control=control,
        damping=damping,
        interaction_range=interaction_range,
        own=own,
    )
    plan = plan_run(spec, specimen, chosen, out, checkpoint_interval, output)
    return carry_out(plan, threads=threads, progress=progress)


def plan_run(
    spec: RunSpec,
    specimen: Specimen,
    material: Material,
    out: Path | str | None = None,
    checkpoint_interval: float = INTERVAL,
    output: Output | None = None,
) -> Plan:
    """Refuse what a run could not do, before YADE's scene is touched.

    Args:
        spec: The run.
        specimen: The grains that `spec` describes.
        material: The material that `spec` describes.
        out: Folder for the files of the result; None writes nothing.
        checkpoint_interval: Wall time between two checkpoints [s], > 0.
        output: What is written beside the results; None for the default.

    Raises:
        InputError: for a test that is no simulation, grains that have no contact and need one, a
            checkpoint of other inputs in `out`, or frames of a run that is complete there.
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


def _require_contacts(spec: RunSpec, specimen: Specimen) -> None:
    """Refuse a single grain that cannot deform, or whose contacts would set the start."""
    rigid = spec.model in ("rigid", *SPHERE_MODELS)
    if len(specimen.discs) < 2 and (rigid or spec.start == "static"):
        raise InputError(
            f"run: grains = {len(specimen.discs)}, must be >= 2 for {spec.test} of model "
            f"{spec.model} with start {spec.start}; there is no contact"
        )


def carry_out(
    plan: Plan,
    *,
    threads: int = 1,
    progress: Progress | None = None,
    foresee: Foresee | None = None,
) -> Result:
    """Do a run; arguments and outcome as for ``run``.

    Args:
        plan: The run.
        threads: Threads of a step.
        progress: Called with (steps done, steps expected, text).
        foresee: Called once, as soon as steps of the loading have been timed, with the steps that
            the run will probably have and the wall time of those that are left [s].
    """
    spec, folder, checkpoint = plan.spec, plan.folder, plan.checkpoint
    output = plan.output
    if folder is not None:
        given.save(folder, plan.specimen)
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
    if checkpoint is not None and checkpoint.found:
        checkpoint.restore()
        built.rebind()
        built.set_threads(threads)
    elif folder is not None:
        write_vtu(folder / "specimen.vtu", built.snapshot(), _about(spec.to_json()))
    runner = Runner(checkpoint, progress, foresee)
    rig = _rig_of(built, spec, runner)
    if folder is not None and output.frames:
        resumed_at = yade.O.iter if checkpoint is not None and checkpoint.found else None
        rig.watch = FrameWriter(folder, output.frames, _about(spec.to_json()), resumed_at)
    for stage in spec.kind.stages:
        _STAGES[stage](rig, spec)
    rig.finish()
    result = _result(rig, spec)
    result.step_time = runner.step_time
    result.resumed_at = checkpoint.resumed_at if checkpoint is not None else None
    if folder is not None:
        write_files(folder, result)
        _write_others(folder, result, output, rig)
    return result


def _rig_of(built: Model | SphereModel, spec: RunSpec, runner: Runner) -> TestRig:
    if spec.kind.rig is Rig.PARTS and isinstance(built, Model):
        return part_rig(built, spec, runner)
    if spec.kind.rig is Rig.WAVE and isinstance(built, Model):
        return WaveRig(built, spec.wave or "", runner=runner)
    return rig_of(built, tension=spec.kind.pulls, runner=runner)


def _write_others(folder: Path, result: Result, output: Output, rig: TestRig) -> None:
    """Write what can be left out: the page, the last frame, the film."""
    if output.report:
        write_report(folder, result)
    if isinstance(rig.watch, FrameWriter):
        rig.watch.finish(rig)
        from ..report import film, paraview  # take long to load

        frames = rig.watch.frames
        files = [folder / one.file for one in frames]
        steps, stresses = [one.step for one in frames], [one.axial_stress for one in frames]
        paraview.write_state(folder / STATE, result, [*zip(files, steps, stresses, strict=True)])
        if output.film:
            strains = [one.axial_strain for one in frames]
            shown = [*zip(files, strains, stresses, strict=True)]
            film.write_film(folder / f"film.{output.film}", result, shown)


def _about(inputs: Table | None) -> Table:
    """What a file for ParaView says of its run."""
    if inputs is None:
        return {}
    specimen, material = inputs["specimen"], inputs["material"]
    about = {name: inputs[name] for name in ("test", "model", "confinement")}
    return {**about, "material": material["name"], "seed": specimen["seed"], "flexpm": __version__}


def _confine(rig: TestRig, spec: RunSpec) -> None:
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
    """Go on to the largest displacement, whatever the stress does."""
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


def _result(rig: TestRig, spec: RunSpec) -> Result:
    counts, snapshot = rig.built.counts(), rig.built.snapshot()
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=spec.test,
        model=spec.model,
        material=rig.built.describe_material(),
        seed=rig.built.specimen.seed,
        grains=counts["grains"],
        contacts=counts["contacts"],
        nodes=counts.get("nodes"),
        triangles=counts.get("triangles"),
        particles=counts.get("particles"),
        inner_contacts=counts.get("inner_contacts"),
    )
    if spec.kind.quasi_static:
        result.grains_across = grains_across(rig.built.specimen)
    result.inputs = spec.to_json()
    result.curve = rig.record
    kinds = [kind["name"] for kind in result.material.get("minerals", ())]
    result.cracks = cracks_from_snapshot(snapshot, result.curve, kinds)
    result.cracks_by_pair = count_by_pair(result.cracks)
    sudden = rig.may_fail_at_once and not rig.diverged
    result.measure(
        _largest_unbalanced(spec),
        waiting=spec.loading == "waiting",
        crossing=rig.scales().crossing_steps if sudden else None,
        diverged=rig.diverged,
        initial_energy=rig.initial_energy,
    )
    if isinstance(rig, PartRig):
        measure(result, rig, spec)
    if isinstance(rig, WaveRig):
        result.measure_wave(spec.wave or "", rig.distance)
    for name in spec.kind.no_constants:
        setattr(result, name, None)
    result.contact_width = rig.contact_width
    result.measure_fragments(snapshot)
    if isinstance(rig.built, Model):  # bonds of spheres tell no energy
        result.measure_emission(_event_rule(rig.built.specimen, rig.built.solver))
        result.joint_bend = rig.built.joint_bend
        cuts = rig.built.specimen.joint_cuts.items()
        result.joint_cuts = {name: cut.to_json() for name, cut in cuts} or None
        result.loose_grains, result.largest_parting = rig.built.parting
    return result


def _largest_unbalanced(spec: RunSpec) -> float:
    """Largest unbalanced-force ratio of a test that is to be quasi-static [-]."""
    if not spec.kind.quasi_static:
        return math.inf
    waiting, brittle = spec.loading == "waiting", is_brittle(spec.material)
    return quasistatic_ratio(spec.test, spec.model, waiting=waiting, brittle=brittle)


def _event_rule(specimen: Specimen, solver: wrapper.GrainSolver) -> EventRule:
    """What makes an event, by the speed of a wave through a disc of the specimen's area."""
    diameter = specimen.equal_diameter
    return event_rule(specimen.mean_diameter, diameter, solver.crossingSteps(diameter))


def write_files(folder: Path, result: Result) -> None:
    """Write numbers, record, cracks, final state and pictures of a result into `folder`."""
    result.write(folder)
    draw = wave_picture if kind_of(result.test).rig is Rig.WAVE else curve_picture
    draw(folder / "curve.png", result)
    if result.snapshot is not None:
        write_vtu(folder / "final.vtu", result.snapshot, _about(result.inputs))
        minerals = [kind["name"] for kind in result.material.get("minerals", ())]
        caption = size_text(result)
        cut = bool(result.material.get("joints"))
        notches = _notches(folder / "specimen.vtu") if cut else []
        broken = result.cracks_by_pair
        crack_picture(folder / "cracks.png", result.snapshot, caption, minerals, notches, broken)
        fragment_picture(folder / "fragments.png", result.snapshot, caption)
        emission_picture(folder / "events.png", result, caption)


def _notches(specimen: Path) -> list[int]:
    """Numbers of the contacts that are cut open in the file of a specimen before its test."""
    before = read_vtu(specimen)
    return [int(number) for number in before.contact[before.cuts]]
