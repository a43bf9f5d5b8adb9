# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on a specimen, paper Sec. 4.1. SI units."""

from __future__ import annotations

from pathlib import Path

from ..dimensions import is_solid
from ..kinds.option import Value
from ..kinds.registry import kind_of
from ..materials.material import Material
from ..materials.material import load as load_material
from ..progress import Progress
from ..results.result import Result
from ..runs.checkpoint import INTERVAL
from ..runs.input_names import paced
from ..runs.output import Output
from ..runs.run_spec import RunSpec, described
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import Specimen
from .carrying_out import carry_out
from .plan import plan_run, require_tested


def run(
    test: str,
    specimen: Specimen | SolidSpecimen,
    material: Material | str | None = None,
    model: str = "flexible",
    *,
    confinement: float = 0.0,
    points: int = 3,
    mesh: str = "refined",
    rate: float | str = 1.0,
    halvings: int | None = None,
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
            ``triaxial``: the same of solids, ``second_confinement`` on front and back of a box;
            ``brazilian``: a disc between two plates, whose axial stress is 2 P / (pi D t), P the
            force, D the diameter, t the thickness; ``bending``: a beam on two supports, pressed in
            the middle; ``scb``: half a disc with a notch on two supports, pressed on top;
            ``shear``: the lower half of a rectangle is pushed along below the upper;
            ``sonic``: a plane pulse through a specimen, with real masses and without damping, for
            the speed of its `wave`. ``flexpm run --help`` tells all of them.
            A test is over when the deviator, the axial stress minus the least confining pressure,
            has fallen to `stop_ratio` of its peak, when the strain reaches `max_strain`, or, under
            a confining pressure and without `max_strain`, when the deviator has been constant
            within 2 % over a strain of 0.5 %.
        specimen: A rectangle, y is the axial direction; for ``brazilian`` a disc, for ``scb`` half
            of one, of the plane or of space; for ``uniaxial``, ``tension`` and ``sonic`` also, for
            ``triaxial`` only a box or a cylinder, for ``bending``, ``shear`` and ``punch`` also a
            box, z is the axial direction.
        material: Preset, file, or material; None for the default of model and dimension.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        confinement: Lateral pressure [Pa], for ``biaxial`` and others that take one.
        points: Contact points per contact, 1, 2 or 3.
        mesh: ``refined`` or ``fan``.
        rate: Factor on the default loading rate [-], > 0; ``auto``: 1, with 5 `halvings`.
        halvings: A test that ends ``not_quasistatic`` is loaded again at half the rate, at most so
            many times, 1 to 20, until it is ``ok`` and the peaks of two rates agree within 1 %;
            ``rates`` of the result has them all. None: it is done once. Not for ``sonic``.
        max_strain: Largest axial strain [-]; None for 8 times that of the reference strength, 16
            times for discs.
        stop_ratio: Part of its peak to which the deviator falls before the test ends [-]: above 0,
            at most 0.9; None: 0.5, and 0.1 in bending.
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
    require_tested("run", specimen)
    output = Output(report, frames, film)
    chosen = load_material(material, model, solid=is_solid(specimen.spec.kind))
    factor, halvings = paced(rate, halvings)
    spec = RunSpec(
        test,
        specimen.spec,
        described(chosen, model),
        model,
        points=points,
        mesh=mesh,
        confinement=confinement,
        rate=factor,
        halvings=halvings,
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
