# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on YADE's own bonded models, paper Sec. 4. SI units.

They follow the tests of the other models: plates without friction (grips in tension), the same
schedule, the same record. YADE's classes do every step; rows of the record are taken in Python
between steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import yade

from .._version import __version__
from ..models.sphere_bonds import tributary_lengths
from ..models.spheres import SphereModel
from ..results.result import Result
from .loading_rate import quasistatic_ratio, rate_constant
from .run_spec import RunSpec
from .runner import Course
from .schedule import Schedule, end_strains
from .sphere_loading import (
    BOTTOM,
    LEFT,
    RIGHT,
    TOP,
    Grips,
    Plates,
    Pressure,
    hold_sideways,
    middle_of_bottom,
    start_evenly,
)
from .sphere_record import Ending, Gauge, Recorder, Sample

#: A fall of the stress counts once this share of the reference strength has been reached [-].
_LEAST_PEAK = 0.2
#: Rows of the record up to the reference strain.
_ROWS = 200
#: Rows from one checkpoint to the next; loading the scene there is a part of the run.
_ROWS_KEPT = 50
#: The isotropic stress is reached in this many crossings of a wave, and then held until at rest.
_RAMP_CROSSINGS = 20
_REST = 1e-3  #: at rest: largest resultant over mean contact force [-]
_MOST_HOLDING = 200  #: crossings
#: Diametral strain of an elastic disc between narrow plates over 2P / (pi D t E), about.
_DIAMETRAL = 5.0


def run_uniaxial(built: SphereModel, spec: RunSpec, course: Course) -> Result:
    """Compress a built rectangle axially without lateral pressure."""
    plan = _schedule(built, spec)
    area = _area(built)

    def prepare() -> None:
        _squeeze(built).move(-plan.velocity)
        start_evenly(built, -plan.velocity, 0.0, plan.height)

    def sampler() -> Callable[[], Sample]:
        plates, gauge = Plates(built), Gauge(built)

        def sample() -> Sample:
            axial, lateral = gauge.strains()
            pulls = plates.pulls()
            return Sample(-pulls.mean / area, pulls.mismatch, -plates.travel(), -axial, lateral)

        return sample

    return _run("uniaxial", built, plan, area, Steps(prepare, sampler), course)


def run_tension(built: SphereModel, spec: RunSpec, course: Course) -> Result:
    """Pull the outermost layers of spheres of a built rectangle apart."""
    plan = _schedule(built, spec)
    grips, area = Grips(built), _area(built)

    def prepare() -> None:
        grips.close()
        hold_sideways(built, middle_of_bottom(built))
        start_evenly(built, plan.velocity, 0.0, plan.height)
        grips.move(plan.velocity)

    def sampler() -> Callable[[], Sample]:
        gauge = Gauge(built)

        def sample() -> Sample:
            axial, lateral = gauge.strains()
            pulls = grips.pulls()
            return Sample(pulls.mean / area, pulls.mismatch, grips.travel(), axial, -lateral)

        return sample

    return _run("tension", built, plan, area, Steps(prepare, sampler), course)


def run_biaxial(built: SphereModel, spec: RunSpec, course: Course) -> Result:
    """Press a built rectangle isotropically, then compress it axially at constant pressure.

    Strains count from the isotropic state.
    """
    confinement = spec.confinement
    plan = _schedule(built, spec)
    sides, area = Pressure(built, (LEFT, RIGHT)), _area(built)

    def prepare() -> None:
        hold_sideways(built, middle_of_bottom(built))
        if confinement > 0.0:
            _press_evenly(built, confinement, plan, course)
        _squeeze(built, confinement).move(-plan.velocity)
        start_evenly(built, -plan.velocity, 0.0, plan.height)
        sides.update(confinement)

    def sampler() -> Callable[[], Sample]:
        plates, gauge = Plates(built), Gauge(built)

        def sample() -> Sample:
            axial, lateral = gauge.strains()
            height = plan.height + plates.travel()
            applied = sides.lateral_stress(height)
            sides.update(confinement)
            pulls, travel = plates.pulls(), -plates.travel()
            stress = -pulls.mean / area
            return Sample(stress, pulls.mismatch, travel, -axial, lateral, applied, math.nan)

        return sample

    return _run("biaxial", built, plan, area, Steps(prepare, sampler), course)


def run_brazilian(built: SphereModel, spec: RunSpec, course: Course) -> Result:
    """Squeeze a built disc between two plates; stress is 2P / (pi D t), strain travel / D."""
    plan = _schedule(built, spec)
    area = 0.5 * math.pi * plan.height * built.specimen.thickness

    def prepare() -> None:
        reach = np.array([yade.O.bodies[body].shape.radius for body in built.ids])
        heights = built.specimen.centres[:, 1]
        lowest, highest = heights - reach, heights + reach
        plates = Plates.lay(built, float(lowest.min()), float(highest.max()))
        # Deviation D28: a disc that stands on one sphere would roll
        hold_sideways(built, int(np.argmin(lowest)))
        hold_sideways(built, int(np.argmax(highest)))
        plates.move(-plan.velocity)

    def sampler() -> Callable[[], Sample]:
        plates = Plates(built)

        def sample() -> Sample:
            pulls, travel = plates.pulls(), -plates.travel()
            return Sample(-pulls.mean / area, pulls.mismatch, travel, travel / plan.height)

        return sample

    result = _run("brazilian", built, plan, area, Steps(prepare, sampler), course)
    result.youngs_modulus = None  # the slope of the plates' travel is no modulus of the rock
    return result


#: Tests of these models by name.
TESTS: dict[str, Callable[..., Result]] = {
    "uniaxial": run_uniaxial,
    "tension": run_tension,
    "biaxial": run_biaxial,
    "brazilian": run_brazilian,
}


def _squeeze(built: SphereModel, pressure: float = 0.0) -> Plates:
    """Put plates on bottom and top of a rectangle; they carry the pressure from then on."""
    low, high = built.specimen.outline[:, 1].min(), built.specimen.outline[:, 1].max()
    moved = [
        np.mean([yade.O.bodies[built.ids[grain]].state.pos[1] for grain in ends])
        - np.mean(built.specimen.centres[list(ends), 1])
        for ends in (tributary_lengths(built.specimen, side) for side in (BOTTOM, TOP))
    ]
    plates = Plates.lay(built, float(low + moved[0]), float(high + moved[1]))
    for plate, side in ((plates.bottom, BOTTOM), (plates.top, TOP)):
        built.touch(plate, tributary_lengths(built.specimen, side))
    if pressure > 0.0:
        yade.O.step()
        Pressure(built, (BOTTOM, TOP)).remove()
        for plate in (plates.bottom, plates.top):
            built.press(plate, pressure)
    else:
        hold_sideways(built, middle_of_bottom(built))
    return plates


def _press_evenly(built: SphereModel, confinement: float, plan: Schedule, course: Course) -> None:
    """Raise the same pressure on all sides and wait until the specimen is at rest."""
    sides = Pressure(built, (BOTTOM, RIGHT, TOP, LEFT))
    crossing = math.ceil(_crossing_steps(built))
    for turn in range(_MOST_HOLDING):
        sides.update(confinement * min(1.0, (turn + 1) / _RAMP_CROSSINGS))
        for _ in range(crossing):
            yade.O.step()
        course(yade.O.iter, max(plan.steps, yade.O.iter), "isotropic pressure")
        if turn >= _RAMP_CROSSINGS and yade.utils.unbalancedForce(useMaxForce=True) < _REST:
            return


def _schedule(built: SphereModel, spec: RunSpec) -> Schedule:
    """Velocity and end as in the other models, from the contacts alone."""
    test = spec.test
    height = built.specimen.dimensions.get("height", built.specimen.dimensions.get("diameter"))
    modulus = _modulus(built)
    factor = _DIAMETRAL if test == "brazilian" else 1.0
    reference = factor * (_strength(built, test) + spec.confinement) / modulus
    crossing = _crossing_steps(built) * yade.O.dt
    velocity = spec.rate * rate_constant(test, built.name) * reference * height / crossing
    largest = spec.max_strain or end_strains(test) * reference
    return Schedule(velocity, reference, largest, height, yade.O.dt, spec.stop_ratio)


def _modulus(built: SphereModel) -> float:
    """Of a row of grains: K_n times the mean diameter [Pa]."""
    law = built.material.law(built.name)
    return law["normal_stiffness"] * built.specimen.mean_diameter


def _strength(built: SphereModel, test: str) -> float:
    """Strength that the contacts alone would give the specimen [Pa]."""
    law = built.material.law(built.name)
    if test in ("tension", "brazilian"):
        return law["tensile_strength"]
    friction = law["friction"]
    return 2.0 * law["cohesion"] * (math.sqrt(1.0 + friction**2) + friction)


def _crossing_steps(built: SphereModel) -> float:
    """Steps in which a wave crosses the specimen's height."""
    dimensions = built.specimen.dimensions
    height = dimensions.get("height", dimensions.get("diameter"))
    width = dimensions.get("width", height)
    mass = sum(yade.O.bodies[body].state.mass for body in built.ids)
    stiffness = _modulus(built) * width * built.specimen.thickness / height
    return math.sqrt(mass / stiffness) / yade.O.dt


def _area(built: SphereModel) -> float:
    return built.specimen.dimensions["width"] * built.specimen.thickness


@dataclass
class Steps:
    """What makes a test: it is prepared once; sampling begins anew when it is resumed."""

    prepare: Callable[[], None]
    sampler: Callable[[], Callable[[], Sample]]


def _run(
    test: str, built: SphereModel, plan: Schedule, area: float, steps: Steps, course: Course
) -> Result:
    ending = Ending(_LEAST_PEAK * _strength(built, test), plan.max_strain, plan.stop_ratio)
    to_reference = plan.reference_strain * plan.height / (plan.velocity * plan.dt)
    period = max(1, round(to_reference / _ROWS))

    def prepare() -> None:
        steps.prepare()
        yade.O.trackEnergy = True

    def record() -> Recorder:
        recorder = Recorder(built, area, plan.height, ending, steps.sampler())
        while not recorder.over:
            course.step(period)
            recorder.record()
            done = yade.O.iter
            expected = max(min(plan.steps, 2.0 * to_reference), 1.05 * done)
            course(done, expected, f"peak {recorder.peak * 1e-6:5.1f} MPa")
            if len(recorder.curve) % _ROWS_KEPT == 0 and not recorder.over:
                recorder.remember()
                course.renew(built.rebind)
        return recorder

    recorder = course.stage(prepare, record)
    if not recorder.diverged:
        recorder.remember()
        course.finish()
    return _result(test, built, recorder, course.step_time)


def _result(test: str, built: SphereModel, recorder: Recorder, step_time: float | None) -> Result:
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=test,
        model=built.name,
        material={"name": built.material.name, **built.material.law(built.name)},
        seed=built.specimen.seed,
        **built.counts(),
        step_time=step_time,
    )
    result.curve = recorder.curve
    result.cracks = built.cracks.cracks(recorder.curve)
    result.measure(quasistatic_ratio(test, built.name), diverged=recorder.diverged)
    return result
