# SPDX-License-Identifier: GPL-3.0-or-later
"""With real masses a followed displacement is a boundary condition: d'Alembert's wave.

SI units.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest

import flexpm  # isort: skip  (first: it tells Python where YADE is)
import yade

from flexpm.arrays import FloatArray
from flexpm.errors import InputError, SimulationError
from flexpm.results import waves

DENSITY = 2650.0
#: Displacement of the driven end in the end [m]: far below what softens a contact.
PLATEAU = 1e-9
NEVER = dict.fromkeys(("tensile_strength", "cohesion"), 1e9)
NEVER |= dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e6)
LINES = 200


class Bar(NamedTuple):
    """A bar whose sides are held across it, and the speed of a plane wave in it."""

    rig: flexpm.PartRig
    length: float
    grain: float
    speed: float
    #: Where the wave begins [m]; None: somewhere among the lowest grains.
    origin: float | None
    driven: flexpm.rigs.parts.HeldNodes
    held: flexpm.rigs.parts.HeldNodes | None


def bar_of(
    specimen: flexpm.Specimen,
    model: str,
    grain: float,
    speed: float,
    *,
    free: bool,
    origin: float | None = None,
) -> Bar:
    """Drive the low end of a bar, hold the high one or leave it free."""
    yade.O.reset()
    rock = flexpm.materials.load("augig-table7").with_set(NEVER, model)
    rig = flexpm.PartRig(flexpm.build(specimen, rock, model, dynamic=True))
    width, length = np.ptp(specimen.outline, axis=0)
    end = 1e-9 if model == "flexible" else 0.67 * grain
    low = rig.hold(where=lambda x, y: y < end)
    high = None if free else rig.hold(where=lambda x, y: y > length - end)
    top = length - end if high else math.inf

    def sides(x: FloatArray, y: FloatArray) -> FloatArray:
        return ((x < end) | (x > width - end)) & (y >= end) & (y <= top)

    rig.hold(where=sides, axes="x")
    rig.drive(low, (0.0, 1.0), against=high or ())
    return Bar(rig, length, grain, speed, origin, low, high)


def column(model: str, pulse_grains: int, *, free: bool, grains: float = 3.0) -> Bar:
    """Bonded squares, one above the other; their pulse is so many of them long."""
    count = int(grains * pulse_grains)
    size = 0.06 / count
    square = size * np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    cells = [square + size * np.array((0.0, number)) for number in range(count)]
    law = flexpm.materials.load("augig-table7").law(model)
    soft = 1.0 / (law["normal_stiffness"] * size)
    if model == "flexible":  # plane stress, no strain across
        soft += (1.0 - law["poisson"] ** 2) / law["young"]
    speed = math.sqrt(1.0 / (soft * DENSITY))
    # a rigid square is driven by its centre; below a flexible one half a contact is missing
    half = 0.5 / (soft * law["normal_stiffness"])
    origin = half if model == "flexible" else 0.5 * size
    specimen = flexpm.Specimen.from_polygons(cells, 0.01)
    return bar_of(specimen, model, size, speed, free=free, origin=origin)


def packing(model: str, *, free: bool) -> Bar:
    """Grains of a packing, 80 of them along the bar."""
    specimen = flexpm.Specimen.rectangle(0.005, 0.06, 0.01, diameters=(5e-4, 1e-3), seed=1)
    found = flexpm.elastic(specimen, model=model)
    modulus = waves.modulus("p", found["youngs_modulus"], found["poissons_ratio"])
    speed = math.sqrt(modulus / DENSITY)
    return bar_of(specimen, model, specimen.mean_diameter, speed, free=free)


def rise(time: FloatArray | float, duration: float) -> FloatArray:
    """Displacement that begins and ends gently, over the plateau [-]."""
    part = np.clip(np.asarray(time) / duration, 0.0, 1.0)
    return part - np.sin(2.0 * math.pi * part) / (2.0 * math.pi)


class Seen(NamedTuple):
    """Displacements of all nodes over the plateau, by times, and where nodes are along the bar."""

    times: FloatArray
    moved: FloatArray  #: (times, nodes)
    places: FloatArray  #: [m]

    def mean(self, place: float, bar: Bar) -> FloatArray:
        """Mean displacement of a section."""
        return self.moved[:, np.abs(self.places - place) < bar.grain].mean(axis=1)

    def wave(self, place: float, bar: Bar, duration: float, origin: float) -> FloatArray:
        """The same of d'Alembert's wave that begins at `origin`."""
        delay = (self.places[np.abs(self.places - place) < bar.grain] - origin) / bar.speed
        return np.array([rise(now - delay, duration).mean() for now in self.times])

    def ahead(self, bar: Bar, origin: float) -> float:
        """Largest displacement ahead of the front."""
        front = 1.03 * bar.speed * self.times[:, None] + origin
        return float(np.abs(np.where(self.places > front, self.moved, 0.0)).max())


def followed(bar: Bar, pulse: float, until: float) -> Seen:
    """Let the driven end follow a rise `pulse` long [m], up to a time [s]."""
    duration = pulse / bar.speed
    times = np.linspace(0.0, duration, LINES + 1)
    rows: list[tuple[float, FloatArray]] = []
    every = max(1, round(until / yade.O.dt / 400))

    def look(rig: flexpm.PartRig) -> None:
        if yade.O.iter % every == 0:
            state = rig.built.snapshot()
            rows.append((yade.O.time, (state.positions - state.reference)[:, 1] / PLATEAU))

    places = bar.rig.built.snapshot().reference[:, 1]
    bar.rig.watch = look
    bar.rig.follow([*times, until], [*PLATEAU * rise(times, duration), PLATEAU], by="way")
    bar.rig.watch = None
    return Seen(*map(np.array, zip(*rows, strict=True)), places)


def half_time(times: FloatArray, values: FloatArray) -> float:
    """Time at which half the plateau arrives [s]."""
    row = int(np.argmax(values > 0.5))
    return float(np.interp(0.5, values[row - 1 : row + 1], times[row - 1 : row + 1]))


def errors(bar: Bar, pulse: float) -> tuple[float, float, float]:
    """Errors of shape and arrival, before the far end is reached, and what runs ahead [-]."""
    duration, sections = pulse / bar.speed, [0.35 * bar.length, 0.6 * bar.length]
    seen = followed(bar, pulse, 0.97 * bar.length / bar.speed)
    means = [seen.mean(place, bar) for place in sections]
    origin = bar.origin
    if origin is None:  # where it begins among the lowest grains, by when it comes to the first
        wave = seen.wave(sections[0], bar, duration, 0.0)
        late = half_time(seen.times, means[0]) - half_time(seen.times, wave)
        origin = -bar.speed * late
        assert abs(origin) < bar.grain
    waves_there = [seen.wave(place, bar, duration, origin) for place in sections]
    shape = max(
        float(np.abs(mean - wave).max()) for mean, wave in zip(means, waves_there, strict=True)
    )
    arrivals = [
        half_time(seen.times, mean) / half_time(seen.times, wave) - 1.0
        for mean, wave in zip(means, waves_there, strict=True)
    ]
    return shape, max(map(abs, arrivals)), seen.ahead(bar, origin)


@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_followed_displacement_is_the_wave_of_dalembert(model, free):
    bar = column(model, 20, free=free)
    shape, late, ahead = errors(bar, bar.length / 3.0)
    assert shape < 0.02 and late < 0.01 and ahead < 1e-3
    # books close, and all energy comes through the driven end
    energies = bar.rig.built.solver.energies()
    stored = energies["kinetic_energy"] + energies["elastic_energy"]
    assert stored == pytest.approx(energies["boundary_work"], rel=1e-3)
    assert abs(bar.rig.motion_energy) < 1e-9 * stored
    assert bar.driven.work == pytest.approx(stored, rel=1e-3)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_its_errors_halve_with_the_grains(model):
    coarse, fine = (errors(column(model, count, free=True), 0.02) for count in (20, 40))
    assert fine[0] < 0.5 * coarse[0]
    assert fine[1] < max(0.5 * coarse[1], 2e-4)  # a hundredth of a step is none


@pytest.mark.parametrize(("model", "free"), [("flexible", True), ("rigid", False)])
def test_it_is_one_through_a_packing_of_grains(model, free):
    bar = packing(model, free=free)
    shape, late, ahead = errors(bar, bar.length / 3.0)  # 27 grains
    assert shape < 0.02 and late < 0.01 and ahead < 1e-3


@pytest.mark.parametrize("free", [False, True])
def test_the_far_end_sends_it_back(free):
    """A free end moves twice as far as the wave; a held one stays and is pushed twice as hard."""
    bar = column("flexible", 20, free=free, grains=2.0)
    pulse = 0.5 * bar.length
    if bar.held is None:
        seen = followed(bar, pulse, 1.6 * bar.length / bar.speed)
        assert seen.mean(bar.length, bar)[-1] == pytest.approx(2.0, rel=0.02)
        return
    pushed = [0.0]
    duration = pulse / bar.speed
    times = np.linspace(0.0, duration, LINES + 1)
    bar.rig.watch = lambda rig: pushed.append(bar.held.force[1])
    end, values = 1.6 * bar.length / bar.speed, PLATEAU * rise(times, duration)
    bar.rig.follow([*times, end], [*values, PLATEAU])
    largest = 2.0 * DENSITY * bar.speed * 2.0 * PLATEAU / duration * bar.grain * 0.01
    assert -min(pushed) == pytest.approx(largest, rel=0.02)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("seed", [1, 3, 5])
def test_a_bar_with_a_free_end_is_followed_and_saved(model, seed, tmp_path):
    yade.O.reset()
    specimen = flexpm.Specimen.rectangle(0.008, 0.016, 0.01, diameters=(2e-3, 4e-3), seed=seed)
    built = flexpm.build(specimen, model=model, dynamic=True)
    rig = flexpm.PartRig(built, out=tmp_path, frames=2, report=False)
    low = rig.hold(where=lambda x, y: y < 2e-3)
    rig.drive(low, (0.0, 1.0))
    rig.follow([0.0, 2e-5, 4e-5], [0.0, 1e-9, 1e-9])
    work = rig.record["boundary_work"][-1]
    assert abs(rig.motion_energy) < 1e-9 * work and rig.warnings == []
    rig.relax()
    rig.finish()
    result = flexpm.Result.read(tmp_path)
    assert (result.status, result.tensile_cracks) == ("ok", 0)
    # what needs a rate has none: nothing resists
    with pytest.raises(InputError, match="resistance of the supports = 0 N, .* moves along y"):
        rig.load()


def test_a_history_that_no_step_can_follow_is_refused_and_its_rows_may_share_steps():
    bar = column("rigid", 20, free=True, grains=0.5)
    step = yade.O.dt
    with pytest.raises(InputError, match=r"follow: times = .* s, must take at least one step of"):
        bar.rig.follow([0.0, 0.3 * step], [0.0, PLATEAU])
    times = np.linspace(0.0, 10.0 * step, 101)
    seen = []
    bar.rig.watch = lambda rig: seen.append(bar.driven.displacement[1])
    bar.rig.follow(times, PLATEAU * (times / times[-1]) ** 2)
    assert seen == pytest.approx(PLATEAU * (np.arange(1, 11) / 10.0) ** 2, rel=1e-9)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("kind", ["constant", "waiting"])
def test_a_loading_with_real_masses_gives_grains_no_velocity(model, kind):
    """Ends, plates and held nodes: after its first step what lies in the middle stands still."""
    for rig_of in (flexpm.rig, flexpm.PartRig):
        yade.O.reset()
        specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
        rig = rig_of(flexpm.build(specimen, model=model, dynamic=True))
        if isinstance(rig, flexpm.PartRig):
            floor, top = rig.platen(0, friction=0.3), rig.platen(2, friction=0.3)
            rig.drive(top, (0.0, -1.0), against=floor)
        state = rig.built.snapshot()
        middle = np.abs(state.reference[:, 1] - 0.012) < 0.003

        def look(rig: object, middle=middle) -> None:
            if yade.O.iter == 3:
                now = rig.built.snapshot()
                assert np.all((now.positions - now.reference)[middle] == 0.0)
                raise StopIteration

        rig.watch = look
        with pytest.raises(StopIteration):
            rig.load(flexpm.Loading(kind=kind))
        with pytest.raises((InputError, SimulationError), match=r"static = True, must be False"):
            rig.load(flexpm.Loading(static=True))
