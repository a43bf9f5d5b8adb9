# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests on a specimen, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import yade
from yade import wrapper

from . import __version__, curve, export, materials, models, plot
from .curve import Curve
from .errors import InputError
from .files import output_folder
from .materials import Material
from .models import Model
from .results import Result, cracks_from_snapshot
from .specimen import Specimen

#: Called with (steps done, steps expected, text).
Progress = Callable[[float, float, str], None]

#: Share of a wave crossing's stretch by which the ends may move in that time: the mean strain grows
#: by k times the reference strain while a wave crosses the specimen once. Fixed by halving the rate.
RATE_CONSTANT = {"uniaxial": 0.02}

#: A test ends at this multiple of the reference strain unless told otherwise [-].
DEFAULT_STRAINS = 4.0
#: A fall of the stress counts once this share of the reference strength has been reached [-].
_LEAST_PEAK = 0.2
#: Wall time between two looks at a running simulation [s].
_POLL = 0.1


@dataclass
class Schedule:
    """How fast and how far a test is driven."""

    velocity: float  #: of the moving end, magnitude [m/step, or m/s with real masses]
    ramp_steps: int  #: over which the velocity rises
    reference_strain: float  #: strain of the reference strength [-]
    max_strain: float  #: at which the test ends [-]
    height: float  #: [m]
    dt: float  #: [s], or 1 with scaled masses

    @property
    def steps(self) -> int:
        """Steps up to the largest strain."""
        return math.ceil(self.max_strain * self.height / (self.velocity * self.dt))


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
    dynamic: bool = False,
    threads: int = 1,
    out: Path | str | None = None,
    progress: Progress | None = None,
) -> Result:
    """Run a test in YADE's scene, which is reset first and holds the final state afterwards.

    Args:
        test: ``uniaxial``: compression between frictionless platens until the stress has fallen to
            half its peak or the strain reaches `max_strain`.
        specimen: A rectangle; y is the axial direction.
        material: Preset, file, or material; None for the default of the model.
        model: ``flexible``.
        confinement: Lateral pressure [Pa]; 0 for ``uniaxial``.
        points: Contact points per contact, 1, 2 or 3.
        mesh: ``refined`` or ``fan``.
        rate: Factor on the default loading rate [-], > 0.
        max_strain: Largest axial strain [-]; None for 4 times that of the reference strength.
        dynamic: Real masses and time instead of scaled masses and unit steps.
        threads: Threads of a step; results do not depend on it.
        out: Folder for the files of the result; None writes nothing.
        progress: Called with (steps done, steps expected, text).

    Returns:
        The measures, the record and the cracks.

    Raises:
        InputError: for an argument out of range.
    """
    if test not in TESTS:
        raise InputError(f"run: test = {test!r}, must be one of {', '.join(TESTS)}")
    _require_positive("rate", rate)
    if max_strain is not None:
        _require_positive("max_strain", max_strain)
    if not (math.isfinite(confinement) and confinement >= 0.0):
        raise InputError(f"run: confinement = {confinement} Pa, must not be below 0")
    folder = None if out is None else output_folder(out)
    chosen = materials.load(material or materials.default_name(model), model)
    yade.O.reset()
    built = models.build(
        specimen, chosen, model, points=points, mesh=mesh, dynamic=dynamic, threads=threads
    )
    if folder is not None:
        export.write_vtu(folder / "specimen.vtu", built.snapshot())
    result = TESTS[test](built, confinement, rate, max_strain, progress)
    if folder is not None:
        write_files(folder, result, built.snapshot())
    return result


def run_uniaxial(
    built: Model,
    confinement: float,
    rate: float,
    max_strain: float | None,
    progress: Progress | None,
) -> Result:
    """Compress a built specimen axially without lateral pressure."""
    if confinement != 0.0:
        raise InputError(
            f"run: confinement = {confinement} Pa, must be 0 for uniaxial; leave it out"
        )
    recorder = wrapper.AxialRecorder()
    built.add_engines(after=(recorder,))
    plan = schedule(recorder.scales(), "uniaxial", rate, max_strain)
    recorder.maxStrain = plan.max_strain
    recorder.leastPeak = _LEAST_PEAK * recorder.scales()["strength"]
    platens = wrapper.PlatenEngine(velocity=-plan.velocity, rampSteps=plan.ramp_steps)
    built.add_engines(before=(platens,))
    diverged, step_time = _drive(plan, recorder, progress)
    return _result("uniaxial", built, recorder, diverged, step_time)


TESTS: dict[str, Callable[..., Result]] = {"uniaxial": run_uniaxial}


def schedule(
    scales: dict[str, float], test: str, rate: float, max_strain: float | None
) -> Schedule:
    """Loading rate and end of a test from the scales that the recorder names.

    v = k eps_ref H / T with T the steps in which a wave of the scaled masses crosses the height
    and eps_ref the strain of the reference strength.

    Args:
        scales: ``AxialRecorder.scales()``.
        test: Name of the test.
        rate: Factor on the rate [-].
        max_strain: Largest axial strain [-], or None for the default.

    Returns:
        Velocity, ramp and end.
    """
    reference = scales["strength"] / scales["modulus"]
    crossing = scales["crossing_steps"]
    dt = yade.O.dt
    velocity = rate * RATE_CONSTANT[test] * reference * scales["height"] / (crossing * dt)
    largest = DEFAULT_STRAINS * reference if max_strain is None else max_strain
    return Schedule(velocity, math.ceil(crossing), reference, largest, scales["height"], dt)


def write_files(folder: Path, result: Result, snapshot: dict[str, np.ndarray]) -> None:
    """Write numbers, record, cracks, final state and pictures of a result into `folder`."""
    result.write(folder)
    export.write_vtu(folder / "final.vtu", snapshot)
    plot.curve_picture(folder / "curve.png", result)
    plot.crack_picture(folder / "cracks.png", snapshot)


def _drive(
    plan: Schedule, recorder: Any, progress: Progress | None
) -> tuple[bool, float | None]:
    """Run until the recorder stops the simulation.

    Returns:
        Whether it met a number that is not finite, and the median wall time of a step [s].
    """
    omega = yade.O
    # most tests end well before the largest strain; the bar grows if one does not
    expected = min(plan.steps, math.ceil(2.0 * plan.reference_strain / plan.max_strain * plan.steps))
    samples: list[tuple[float, int]] = [(time.perf_counter(), omega.iter)]
    omega.run(plan.steps + plan.ramp_steps)
    try:
        while omega.running:
            time.sleep(_POLL)
            samples.append((time.perf_counter(), omega.iter))
            if progress is not None:
                progress(omega.iter, max(expected, 1.05 * omega.iter), _status(recorder))
        omega.wait()
    except RuntimeError as error:
        if "not a finite number" not in str(error):
            raise
        return True, _step_time(samples)
    except BaseException:
        omega.pause()
        raise
    return False, _step_time(samples)


def _status(recorder: Any) -> str:
    return f"peak {recorder.peak * 1e-6:5.1f} MPa"


def _step_time(samples: list[tuple[float, int]]) -> float | None:
    """Median wall time of a step [s] over the looks at the simulation."""
    spans = [
        (later[0] - earlier[0]) / (later[1] - earlier[1])
        for earlier, later in zip(samples, samples[1:], strict=False)
        if later[1] > earlier[1]
    ]
    return median(spans) if spans else None


def _result(
    test: str, built: Model, recorder: Any, diverged: bool, step_time: float | None
) -> Result:
    counts = built.solver.counts()
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=test,
        model=built.name,
        material={"name": built.material.name, **built.material.law(built.name)},
        seed=built.specimen.seed,
        grains=counts["grains"],
        contacts=counts["contacts"],
        nodes=counts["nodes"],
        triangles=counts["triangles"],
        step_time=step_time,
    )
    names = recorder.names
    columns = [names.index(name) for name in curve.COLUMNS]
    result.curve = Curve.from_array(recorder.rows[:, columns])
    result.cracks = cracks_from_snapshot(built.snapshot(), result.curve)
    result.measure(diverged=diverged)
    return result


def _require_positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"run: {name} = {value}, must be above 0")
