# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane pulse through a specimen of grains, and how fast it goes: the test ``sonic``. SI units.

Deviations D48 and D49.
"""

from __future__ import annotations

import math
from typing import NoReturn

import numpy as np
import yade
from yade import wrapper

from ..arrays import FloatArray
from ..errors import SimulationError
from ..kinds.pulse import PULSE
from ..kinds.registry import names
from ..kinds.test_kind import Rig
from ..materials.mixing import mineral_materials
from ..models.grains import Model
from ..results import waves
from ..results.record import Curve
from ..runs.runner import Runner, Span
from ..specimens import mineral_map
from .grain_rig import GrainRig
from .rig import LEFT, RIGHT

#: Heights of the two sections over that of the specimen [-].
_SECTIONS = (0.25, 0.75)
#: Width of the band of nodes that a section is, in mean diameters of the grains [-].
_BAND = 2.0
#: Strain of the pulse [-]: far below that at which a contact softens.
_STRAIN = 1e-7
#: Rows of the record, about.
_ROWS = 500
#: Component of the motion across the height.
ACROSS = 0


class WaveRig(GrainRig):
    """A specimen with free ends; its sides are free, or fixed across the motion of a wave."""

    #: Component of the motion along the height.
    _along = 1

    def __init__(
        self, built: Model, wave: str, *, free: bool = False, runner: Runner | None = None
    ) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: A specimen with real masses and without damping.
            wave: ``p``: grains move along the height; ``s``: across it.
            free: Whether sides are free, as in a thin bar.
            runner: Object that steps, shows progress and saves checkpoints; None: it only steps.
        """
        super().__init__(built, runner=runner)
        self._wave, self._free = wave, free
        self._moved = self._along if wave == "p" else ACROSS
        self._height = built.specimen.dimensions["height"]
        self._bottom = self._lowest()
        width = _BAND * built.specimen.mean_diameter
        self._sections = [
            built.solver.sectionNodes(self._bottom + part * self._height, unit(self._along), width)
            for part in _SECTIONS
        ]

    @property
    def kind(self) -> str:
        """Name of the test."""
        return names(lambda kind: kind.rig is Rig.WAVE)[0]

    @property
    def distance(self) -> float:
        """Distance of the two sections [m]."""
        near, far = (place for _, place in self._sections)
        return far - near

    @property
    def record(self) -> Curve:
        """The present record; its strain is taken between the sections; its ends carry no load."""
        names, rows = self._recorder.names, self._recorder.rows
        curve = Curve.from_columns(names, rows, waves.DISPLACEMENTS)
        near, far = (curve[name] for name in waves.DISPLACEMENTS)
        curve["axial_strain"][:] = (near - far) / self.distance
        curve["axial_stress"][:] = 0.0
        curve["lateral_strain"][:] = curve["end_mismatch"][:] = np.nan
        time = curve["step"] * yade.O.dt
        table = np.column_stack([curve.array, time])
        return Curve.from_array(table, (*waves.DISPLACEMENTS, waves.TIME))

    def send(self) -> None:
        """Send a pulse from the bottom until it has passed the upper section."""
        self._tell("send")
        self._stage(self._begin_wave, lambda: self.diverged)

    def expected_speed(self) -> float:
        """Speed of the wave in a continuum with the specimen's elastic constants [m/s]."""
        young, poisson = self.built.solver.elasticConstants()
        return math.sqrt(self._modulus(young, poisson) / self._density())

    def _begin_wave(self) -> Span:
        speed = self.expected_speed()  # what is held would change the constants of a solid
        crossing = self._height / speed
        if not self._free:
            self._hold_sides()
        self._move_bottom(speed)
        solver = self.built.solver
        solver.resetEnergyBalance()
        steps = math.ceil(crossing / yade.O.dt)
        period = max(1, steps // _ROWS)
        solver.measurePeriod, solver.mirrorPeriod = period, solver.checkPeriod
        recorder = self._recorder
        recorder.leastPeak = 1e300  # nothing ends the test but its time
        direction = unit(self._moved)
        for name, (nodes, _) in zip(waves.DISPLACEMENTS, self._sections, strict=True):
            recorder.addGauge(wrapper.Gauge(name=name, nodes=nodes, direction=direction))
        self.built.add_engines(after=(recorder,))
        rows = -(-steps // period)
        return Span(rows * period, rows * period)

    def _move_bottom(self, expected: float) -> None:
        """Give the lower end the velocities of a pulse. Deviation D48.

        By the free end's mirror half of them goes up as a pulse of twice their length.
        """
        reach = 0.5 * PULSE * self._height
        largest = 2.0 * _STRAIN * expected
        for grain in range(len(self.built.solver.bodyIds)):
            shape = self._shape(grain)
            places = shape.positions[:, self._along] - self._bottom
            velocity = largest * _pulse(places / reach)
            if shape.rigid:
                self._set_motion(shape, float(velocity[-1]))
            else:
                shape.velocities[:, self._moved] = velocity

    # What depends on the space that grains are in

    def _lowest(self) -> float:
        """Place of the bottom along the height [m]."""
        return float(np.asarray(self.built.specimen.outline)[:, 1].min())

    def _modulus(self, young: float, poisson: float) -> float:
        """Stress over strain in the wave [Pa]."""
        return young if self._free else waves.modulus(self._wave, young, poisson)

    def _hold_sides(self) -> None:
        """Hold the sides across the wave's motion, so that it is plane."""
        across = self._moved == ACROSS
        for side in (LEFT, RIGHT):
            self.built.solver.holdSide(side, x=not across, y=across)

    def _set_motion(self, shape: wrapper.LaguerreCell, speed: float) -> None:
        """Move a rigid grain with the wave, without rotation."""
        x, y, z = unit(self._moved)
        shape.setMotion((speed * x, speed * y, speed * z), 0.0)

    def _press(self, pressure: float, ramp: int) -> NoReturn:
        self._refuse("confine")

    def _take_hold(self) -> NoReturn:
        self._refuse("load")

    def _move(self, velocity: float, factor: float) -> NoReturn:
        self._refuse("load")

    def _refuse(self, stage: str) -> NoReturn:
        raise SimulationError(
            f"{stage}: test = {self.kind}, must be a test with a loading; call send"
        )

    def _shape(self, grain: int) -> wrapper.LaguerreCell:
        shape = yade.O.bodies[self.built.solver.bodyIds[grain]].shape
        assert isinstance(shape, wrapper.LaguerreCell)
        return shape

    def _density(self) -> float:
        """Mean over the minerals by their areas [kg/m3]."""
        kinds = mineral_materials(self.built.material)
        density = np.array([kind.law(self.built.name)["density"] for kind in kinds])
        if self.built.minerals is None:
            return float(density[0])
        areas = mineral_map.size_fractions(self.built.specimen, self.built.minerals, len(kinds))
        return float(density @ areas)

    def _standing(self) -> str:
        return f"{1e6 * yade.O.iter * yade.O.dt:.1f} us"


def unit(axis: int) -> tuple[float, float, float]:
    """Unit vector along an axis."""
    return (float(axis == 0), float(axis == 1), float(axis == 2))


def _pulse(place: FloatArray) -> FloatArray:
    """Return half a pulse, from 1 at a position of 0 down to 0 at 1 and beyond [-]."""
    # numpy has cosines of its own on some processors: results would differ between machines
    return np.array(
        [0.5 * (1.0 + math.cos(math.pi * one)) if one < 1.0 else 0.0 for one in place.tolist()]
    )
