# SPDX-License-Identifier: GPL-3.0-or-later
"""With real masses a followed displacement is a boundary condition: d'Alembert's wave.

In 2D and 3D, SI units.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np
import pytest
import yade
from refusals import refusal
from scenes import fresh

import flexpm
from flexpm.arrays import FloatArray
from flexpm.errors import InputError, SimulationError
from flexpm.results import waves

DENSITY = 2650.0
#: Displacement of the driven end in the end [m]: far below what softens a contact.
PLATEAU = 1e-9
NEVER = dict.fromkeys(("tensile_strength", "cohesion"), 1e9)
NEVER |= dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e6)
LINES = 200
DIMENSIONS = (2, 3)


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
    section: float  #: [m2]

    @property
    def momentum(self) -> float:
        """That of all grains along the bar [kg m/s]."""
        solver = self.rig.built.solver
        solver.mirrorBodies()
        states = [yade.O.bodies[body].state for body in solver.bodyIds]
        along = len(sizes_of(self.rig.built.specimen)) - 1
        return sum(one.mass * one.vel[along] for one in states)


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
    rock = flexpm.materials.load("augig-table7").with_set(NEVER, model)
    rig = flexpm.PartRig(fresh(specimen, rock, model, dynamic=True))
    sizes = sizes_of(specimen)
    length = sizes[-1]
    end = 1e-9 if model == "flexible" else 0.67 * grain
    low = rig.hold(where=lambda *at: at[-1] < end)
    high = None if free else rig.hold(where=lambda *at: at[-1] > length - end)
    top = length - end if high else math.inf
    for wanted in itertools.product((False, True), repeat=len(sizes) - 1):

        def on_sides(*at: FloatArray, wanted=wanted) -> FloatArray:
            """Places on the sides that are wanted, and on no other ones."""
            there = (at[-1] >= end) & (at[-1] <= top)
            for place, size, one in zip(at, sizes[:-1], wanted, strict=False):
                there &= ((place < end) | (place > size - end)) == one
            return there

        axes = "".join(axis for axis, one in zip("xy", wanted, strict=False) if one)
        if axes and on_sides(*np.transpose(rig.built.solver.nodePlaces()[1])).any():
            rig.hold(where=on_sides, axes=axes)
    direction = (0.0,) * (len(sizes) - 1) + (1.0,)
    rig.drive(low, direction, against=high or ())
    section = float(np.prod(sizes[:-1])) * (specimen.thickness if len(sizes) == 2 else 1.0)
    return Bar(rig, length, grain, speed, origin, low, high, section)


def sizes_of(specimen: flexpm.Specimen) -> tuple[float, ...]:
    """Sizes along all axes, the length last [m]."""
    names = ("width", "depth", "height")
    return tuple(specimen.dimensions[name] for name in names if name in specimen.dimensions)


def column(
    model: str, pulse_grains: int, *, free: bool, dimension: int = 2, grains: float = 3.0
) -> Bar:
    """Bonded squares or cubes, one above the other; their pulse is so many of them long."""
    count = int(grains * pulse_grains)
    size = 0.06 / count
    law = flexpm.materials.load("augig-table7").law(model)
    soft = 1.0 / (law["normal_stiffness"] * size)
    if model == "flexible":  # plane stress in 2D, no strain across
        held = waves.modulus if dimension == 2 else waves.solid_modulus
        soft += 1.0 / held("p", law["young"], law["poisson"])
    speed = math.sqrt(1.0 / (soft * DENSITY))
    # a rigid grain is driven by its centre; below a flexible one half a contact is missing
    half = 0.5 / (soft * law["normal_stiffness"])
    origin = half if model == "flexible" else 0.5 * size
    if dimension == 2:
        square = size * np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
        cells = [square + size * np.array((0.0, number)) for number in range(count)]
        specimen = flexpm.Specimen.from_polygons(cells, 0.01)
    else:
        spheres = [size * np.array((0.5, 0.5, number + 0.5, 0.5)) for number in range(count)]
        edges = {"width": size, "depth": size, "height": count * size}
        specimen = flexpm.Specimen.from_spheres(spheres, **edges)
    return bar_of(specimen, model, size, speed, free=free, origin=origin)


def packing(model: str, *, free: bool, dimension: int = 2) -> Bar:
    """Grains of a packing, 80 of them along the bar, in 3D 60 of them and three across."""
    if dimension == 2:
        specimen = flexpm.Specimen.rectangle(0.005, 0.06, 0.01, diameters=(5e-4, 1e-3), seed=1)
        found = flexpm.elastic(specimen, model=model)
        modulus = waves.modulus("p", found["youngs_modulus"], found["poissons_ratio"])
    else:
        specimen = flexpm.Specimen.box(0.003, 0.003, 0.06, diameters=(8e-4, 1.2e-3), seed=1)
        modulus = pressed_modulus(specimen, model)
    speed = math.sqrt(modulus / DENSITY)
    return bar_of(specimen, model, specimen.mean_diameter, speed, free=free)


def pressed_modulus(specimen: flexpm.Specimen, model: str) -> float:
    """Stress over strain of a bar whose sides and ends are held, by its static solution [Pa].

    With few grains across it is not that of a large specimen.
    """
    bar = bar_of(specimen, model, specimen.mean_diameter, 1.0, free=False)
    state = bar.rig.elastic(displacement=PLATEAU)
    place, moved = state.reference[:, -1], (state.positions - state.reference)[:, -1]
    inner = np.abs(place - 0.5 * bar.length) < 0.4 * bar.length
    strain = -np.polyfit(place[inner], moved[inner], 1)[0]
    return state.load / (bar.section * strain)


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
            rows.append((yade.O.time, (state.positions - state.reference)[:, -1] / PLATEAU))

    places = bar.rig.built.snapshot().reference[:, -1]
    bar.rig.watch = look
    bar.rig.follow([*times, until], [*PLATEAU * rise(times, duration), PLATEAU], by="displacement")
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
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_a_followed_displacement_is_the_wave_of_dalembert(dimension, model, free):
    bar = column(model, 20, free=free, dimension=dimension)
    shape, late, ahead = errors(bar, bar.length / 3.0)
    assert shape < 0.02 and late < 0.01 and ahead < 1e-3
    # books close, and all energy comes through the driven end
    energies = bar.rig.built.solver.energies()
    stored = energies["kinetic_energy"] + energies["elastic_energy"]
    assert stored == pytest.approx(energies["boundary_work"], rel=1e-3)
    assert abs(bar.rig.motion_energy) < 1e-9 * stored
    assert bar.driven.work == pytest.approx(stored, rel=1e-3)
    # nearly all of the wave is within the bar: density times speed, section and plateau
    carried = DENSITY * bar.speed * bar.section * PLATEAU
    assert bar.momentum == pytest.approx(carried, rel=5e-3)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_its_errors_halve_with_the_grains(dimension, model):
    coarse, fine = (
        errors(column(model, count, free=True, dimension=dimension), 0.02) for count in (20, 40)
    )
    assert fine[0] < 0.5 * coarse[0]
    assert fine[1] < max(0.5 * coarse[1], 2e-4)  # a hundredth of a step is none


@pytest.mark.parametrize(("model", "free"), [("flexible", True), ("rigid", False)])
@pytest.mark.parametrize("dimension", [2, pytest.param(3, marks=pytest.mark.long)])
def test_it_is_one_through_a_packing_of_grains(dimension, model, free):
    bar = packing(model, free=free, dimension=dimension)
    shape, late, ahead = errors(bar, bar.length / 3.0)  # 27 grains, in 3D 20
    assert shape < 0.02 and late < 0.01
    assert ahead < (1e-3 if dimension == 2 else 2e-3)


@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_the_far_end_sends_it_back(dimension, free):
    """A free end moves twice as far as the wave; a held one stays and is pushed twice as hard."""
    bar = column("flexible", 20, free=free, dimension=dimension, grains=2.0)
    pulse = 0.5 * bar.length
    if bar.held is None:
        seen = followed(bar, pulse, 1.6 * bar.length / bar.speed)
        assert seen.mean(bar.length, bar)[-1] == pytest.approx(2.0, rel=0.02)
        return
    pushed = [0.0]
    duration = pulse / bar.speed
    times = np.linspace(0.0, duration, LINES + 1)
    bar.rig.watch = lambda rig: pushed.append(bar.held.force[-1])
    end, values = 1.6 * bar.length / bar.speed, PLATEAU * rise(times, duration)
    bar.rig.follow([*times, end], [*values, PLATEAU])
    largest = 2.0 * DENSITY * bar.speed * 2.0 * PLATEAU / duration * bar.section
    assert -min(pushed) == pytest.approx(largest, rel=0.02)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize(("dimension", "seed"), [(2, 1), (2, 3), (2, 5), (3, 1)])
def test_a_bar_with_a_free_end_is_followed_and_saved(dimension, model, seed, tmp_path):
    specimen = flexpm.Specimen.rectangle(0.008, 0.016, 0.01, diameters=(2e-3, 4e-3), seed=seed)
    if dimension == 3:
        specimen = flexpm.Specimen.box(0.008, 0.008, 0.016, diameters=(2e-3, 4e-3), seed=seed)
    built = fresh(specimen, model=model, dynamic=True)
    rig = flexpm.PartRig(built, out=tmp_path, frames=2, report=False)
    low = rig.hold(where=lambda *at: at[-1] < 2e-3)
    rig.drive(low, (0.0, 1.0) if dimension == 2 else (0.0, 0.0, 1.0))
    rig.follow([0.0, 2e-5, 4e-5], [0.0, 1e-9, 1e-9])
    work = rig.record["boundary_work"][-1]
    assert abs(rig.motion_energy) < 1e-9 * work and rig.warnings == []
    rig.relax()
    rig.finish()
    result = flexpm.Result.read(tmp_path)
    assert (result.status, result.tensile_cracks) == ("ok", 0)
    # what needs a rate has none: nothing resists
    along = "xyz"[dimension - 1]
    refusal(f"of the supports = 0 N, .* moves along {along}", rig.load)


def test_a_history_that_no_step_can_follow_is_refused_and_its_rows_may_share_steps():
    bar = column("rigid", 20, free=True, grains=0.5)
    step = yade.O.dt
    with pytest.raises(InputError, match=r"follow: times = .* s, must be >= one step of"):
        bar.rig.follow([0.0, 0.3 * step], [0.0, PLATEAU])
    times = np.linspace(0.0, 10.0 * step, 101)
    seen = []
    bar.rig.watch = lambda rig: seen.append(bar.driven.displacement[1])
    bar.rig.follow(times, PLATEAU * (times / times[-1]) ** 2)
    assert seen == pytest.approx(PLATEAU * (np.arange(1, 11) / 10.0) ** 2, rel=1e-9)


@pytest.mark.parametrize("model", ["flexible", "rigid"])
@pytest.mark.parametrize("kind", ["constant", "waiting"])
@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_a_loading_with_real_masses_gives_grains_no_velocity(dimension, model, kind):
    """Ends, plates and held nodes: after its first step what lies in the middle stands still."""
    for rig_of in (flexpm.rig, flexpm.PartRig):
        specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)
        if dimension == 3:
            specimen = flexpm.Specimen.box(0.012, 0.012, 0.024, seed=1)
        rig = rig_of(fresh(specimen, model=model, dynamic=True))
        if isinstance(rig, flexpm.PartRig):
            floor, top = rig.platen(0, friction=0.3), rig.platen(2, friction=0.3)
            rig.drive(top, (0.0, -1.0) if dimension == 2 else (0.0, 0.0, -1.0), against=floor)
        state = rig.built.snapshot()
        middle = np.abs(state.reference[:, -1] - 0.012) < 0.003

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
