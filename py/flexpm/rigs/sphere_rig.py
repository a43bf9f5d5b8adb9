# SPDX-License-Identifier: GPL-3.0-or-later
"""Rig for YADE's bonded spheres, paper Sec. 4. SI units.

Plates without friction (grips in tension) and the rules of the grains: scales, stresses, strains
and the end of a test are the kernel's. YADE's classes do every step; rows of the record are taken
between steps. Quantities that YADE's models do not keep are nan: the energies lost in cracks and
friction. The elastic energy is that of unbroken bonds and plates (JCFpm) or of all contacts
(CohFrict).
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import asdict, dataclass, field

import numpy as np
import yade
from yade import EnumClass_TestState as TestState
from yade import utils

from .._flexpm import (
    StrainGauge,
    axial_stress,
    bond_strengths,
    contact_modulus,
    disc_scales,
    end_mismatch,
    is_plateau,
    ramp_factor,
    rectangle_scales,
    reference_strength,
    splitting_area,
    test_state,
)
from ..errors import InputError
from ..models.sphere_bonds import in_order, tributary_sizes
from ..models.spheres import SphereModel
from ..results import measures
from ..results.record import Curve
from ..runs.loading_rate import SLOWEST_WAIT, Scales, Schedule
from ..runs.runner import Runner
from ..specimens.space.specimen import SolidSpecimen
from . import sphere_ends as ends
from .readings import Balance, Readings, part_of
from .rig import BOTTOM, LEFT, RIGHT, TOP, TestRig
from .solids.sphere_gauge import SphereGauge

#: Rows of the record up to the reference strain.
_ROWS = 200
#: Looks while a wave crosses the specimen under a rising pressure.
_LOOKS_A_CROSSING = 8
#: Looks from one checkpoint to the next; loading the scene there is a part of the run.
_LOOKS_KEPT = 50
#: Name of the rig's state in what goes with the scene.
_STATE = "rig"
_NO_PRESSURE = "no pressure acts on 3D spheres; use flexible or rigid grains"


@dataclass
class _State:
    """State of a test that YADE does not store: plain values that are saved with its scene."""

    period: int = 1  #: steps from one look to the next
    looks: int = 0
    confinement: float | None = None  #: [Pa]
    ramp: int = 0  #: steps over which it rises
    ramp_begin: int = 0  #: step from which these count
    sides: list[int] = field(default_factory=list)  #: on which it acts
    recording: bool = False
    end: list[float] = field(default_factory=list)  #: of the test, as the kernel takes it
    plateau: tuple[float, int] = (0.0, 0)  #: its strain, and the first row that may belong to it
    zero: tuple[float, float] = (0.0, 0.0)  #: axial and lateral strain that count as zero [-]
    stress: float = 0.0  #: of the last row [Pa]
    strain: float = 0.0  #: of the last row [-]
    travel: float = 0.0  #: of the moving end at the last row, in the sense of the loading [m]
    peak: float = 0.0  #: largest stress above the confinement [Pa]
    state: int = TestState.running
    diverged: bool = False
    work: float = 0.0  #: of the ends [J]
    speed: float = 0.0  #: of the moving end, away from the other [m/step, or m/s with real masses]
    factor: float = 1.0  #: on it, while it rises [-]
    growth: float = 1.0  #: of the factor in a step [-]
    rows: list[list[float]] = field(default_factory=list)  #: the record, as far as it was saved

    @property
    def differential(self) -> float:
        """Stress of the last row above the confinement [Pa]."""
        return self.stress - (self.confinement or 0.0)


class SphereRig(TestRig):
    """Plates, grips and pressure on spheres, updated every few steps."""

    built: SphereModel
    saves_anywhere = False

    def __init__(
        self, built: SphereModel, *, tension: bool = False, runner: Runner | None = None
    ) -> None:
        """Take spheres that have just been built, or whose scene has been loaded."""
        super().__init__(built, tension=tension, runner=runner)
        specimen, sizes = built.specimen, built.specimen.dimensions
        self._height = sizes["diameter"] if self.disc else sizes["height"]
        self._area = splitting_area(self._height, specimen.thickness)
        if isinstance(specimen, SolidSpecimen):
            self._area = ends.section(specimen)
            self._solid_gauge = SphereGauge(specimen)
        elif not self.disc:
            self._area = sizes["width"] * specimen.thickness
            sides = (tributary_sizes(specimen, side).items() for side in (LEFT, RIGHT))
            self._gauge = StrainGauge(
                specimen.heights[0], self._height, specimen.mean_diameter, *sides
            )
        self._take_up()

    def _take_up(self) -> None:
        """Load the state that belongs to the scene."""
        self._now = _State(**self.built.memory.get(_STATE, {}))
        self._curve = Curve.from_array(np.array(self._now.rows))
        if not self.solid:
            self._pressed = ends.Pressure(self.built, self._now.sides)
        if self._now.recording:
            self._ends = ends.grips_of(self.built) if self.tension else ends.plates_of(self.built)

    @property
    def record(self) -> Curve:
        """The present record."""
        return self._curve

    @property
    def confinement(self) -> float | None:
        """Requested confining pressure [Pa]; None without."""
        return self._now.confinement

    @property
    def diverged(self) -> bool:
        """Whether a number is no longer finite."""
        return self._now.diverged

    def scales(self) -> Scales:
        """Return the quantities that determine the loading rate, from the contacts only."""
        specimen, mean = self.built.specimen, self.built.laws.mean
        inputs = (
            contact_modulus(mean("normal_stiffness"), specimen.mean_diameter),
            self._strengths(),
            in_order(state.mass for state in self.built.states()),
            specimen.thickness,
            yade.O.dt,
        )
        if self.disc:
            return Scales(**disc_scales(*inputs, self._height))
        width = specimen.thickness if self.solid else specimen.dimensions["width"]
        return Scales(**rectangle_scales(*inputs, width, self._height))

    def _strengths(self) -> tuple[float, float]:
        """Reference strength of the weakest bonds, and of those that connect the spheres [Pa]."""
        laws, bonds = self.built.laws, self.built.bonds
        keys = ("tensile_strength", "cohesion", "friction")
        pulled = self.tension or self.disc
        if laws.are_alike or not len(bonds):
            strength = reference_strength(pulled, *map(laws.mean, keys))
            return strength, strength
        values = np.column_stack([laws.of_contacts(key, bonds.grains) for key in keys])
        strengths = np.array([reference_strength(pulled, *row) for row in values.tolist()])
        pairs = bonds.grains.astype(np.int32)
        return bond_strengths(strengths, bonds.areas, pairs, len(self.built.specimen.radii))

    def unbalanced(self) -> float:
        """Return the ratio of the largest resultant on free spheres to the mean contact force [-].

        YADE's own ratio also counts the reactions of grips; it is used for the mean contact force.
        """
        largest, free = 0.0, 0.0
        axes = list(enumerate("xyz"[: self.built.axis + 1]))
        for body, state in zip(self.built.ids, self.built.states(), strict=True):
            force, blocked = yade.O.forces.f(body), str(state.blockedDOFs)
            moving = (0.0 if name in blocked else force[k] for k, name in axes)
            largest = max(largest, math.hypot(*(force[k] for k, _ in axes)))
            free = max(free, math.hypot(*moving))
        return utils.unbalancedForce(useMaxForce=True) * free / largest if largest > 0.0 else 0.0

    def balance(self) -> Balance:
        """Return the imbalance between the spheres and the pressure on them, from all net forces.

        The pressure acts on the lower end also, since no part reacts there. The sum of net force
        times position is the difference between the stress of the pressure and the mean stress
        (contact forces times branch vectors).

        Raises:
            InputError: for a 3D specimen, which has no pressure.
        """
        if self.solid:
            raise InputError(f"balance: specimen = {self.built.specimen.kind}, {_NO_PRESSURE}")
        forces, places = [], []
        for body, state in zip(self.built.ids, self.built.states(), strict=True):
            force, blocked = yade.O.forces.f(body), str(state.blockedDOFs)
            forces.append([0.0 if "xy"[k] in blocked else force[k] for k in (0, 1)])
            places.append([state.pos[0], state.pos[1]])
        net, away = np.array(forces), np.array(places) - np.mean(places, axis=0)
        sizes, thickness = self.built.specimen.dimensions, self.built.specimen.thickness
        pressing = (self.confinement or 0.0) * thickness
        area = sizes["width"] * sizes["height"]
        short = part_of(np.abs(net.T @ away).max(), pressing * area)
        least = pressing * min(sizes["width"], sizes["height"])
        missing = part_of(np.hypot(*net.sum(axis=0)), least)
        motion = math.sqrt(part_of(utils.kineticEnergy(), self.built.elastic_energy()))
        return Balance(missing, short, motion)

    @property
    def _readings(self) -> Readings:
        return self._now

    @property
    def row_period(self) -> int:
        """Steps from one row of the record to the next."""
        return self._now.period

    def _limit_speed(self, speed: float, velocity: float) -> None:
        now = float(np.clip(speed / self._now.factor, -velocity, velocity))
        self._move(now if self.tension else -now)

    def _move(self, speed: float) -> None:
        self._now.speed = speed
        self._ends.move(self._now.factor * speed)

    def _press(self, pressure: float, ramp: int) -> None:
        if self.solid:
            raise InputError(f"confine: pressure = {pressure:g} Pa, {_NO_PRESSURE}")
        ends.hold_middle(self.built)
        self._now.confinement, self._now.ramp = pressure, ramp
        self._now.ramp_begin = yade.O.iter
        self._now.period = max(1, math.ceil(self.scales().crossing_steps / _LOOKS_A_CROSSING))
        self._press_on(BOTTOM, RIGHT, TOP, LEFT)

    def _press_on(self, *sides: int) -> None:
        self._now.sides, self._pressed = list(sides), ends.Pressure(self.built, sides)
        self._follow_sides()

    def _follow_sides(self) -> None:
        ramp = ramp_factor(yade.O.iter - self._now.ramp_begin, self._now.ramp)
        self._pressed.update(ramp * (self.confinement or 0.0))

    def _drive(self, plan: Schedule) -> None:
        now, way = self._now, plan.reference_strain * self._height
        now.end = [plan.stop_ratio, plan.least_peak, plan.min_strain, plan.max_strain]
        now.plateau = plan.plateau_strain, len(self._curve)
        now.state, now.peak = TestState.running, 0.0
        now.period = max(1, round(way / (abs(plan.velocity) * yade.O.dt * _ROWS)))
        if not now.recording:
            self._take_hold()
            now.recording = yade.O.trackEnergy = True
        outward = plan.velocity if self.tension else -plan.velocity
        if not (self.disc or self.built.dynamic):
            ends.strain_evenly(self.built, outward)
        part, now.factor = now.factor * now.speed / outward, 1.0
        if plan.rise_steps:  # see ``GrainRig``
            now.factor = float(np.clip(part, SLOWEST_WAIT, 1.0))
            now.growth = SLOWEST_WAIT ** (-1.0 / plan.rise_steps)
        self._move(outward)

    def _take_hold(self) -> None:
        if self.tension:
            ends.close_grips(self.built)
            self._ends = ends.grips_of(self.built)
            return
        if self.disc:
            ends.squeeze_disc(self.built)
        else:
            ends.squeeze_ends(self.built, self.confinement)
        self._ends = ends.plates_of(self.built)
        if self.confinement is not None:
            self._press_on(LEFT, RIGHT)
            self._now.zero = self._strains()

    def _step(self) -> None:
        now = self._now
        if now.factor < 1.0:
            now.factor = min(now.growth * now.factor, 1.0)
            self._move(now.speed)
        yade.O.step()
        if yade.O.iter % self._now.period != 0:
            return
        self._look()
        if self._now.looks % _LOOKS_KEPT == 0 and not self._is_over():
            self._synchronize()
            self._runner.reload()
            self.built.rebind()
            self._take_up()

    def looked_at(self) -> contextlib.AbstractContextManager[None]:
        """Cracks have the step at which they are found: only rows of the record find them."""
        return self.built.cracks.forgetting()

    def _synchronize(self) -> None:
        self._now.rows = self._curve.array.tolist()
        self.built.memory[_STATE] = asdict(self._now)
        self.built.remember()

    def _look(self) -> None:
        """Update the pressure on the sides and add a row to the record."""
        self._now.looks += 1
        lateral = 0.0
        if self.confinement is not None:
            travel = self._ends.travel() if self._now.recording else 0.0
            lateral = self._pressed.lateral_stress(self._height + travel)
            self._now.diverged = not math.isfinite(lateral)
            self._follow_sides()
        if self._now.recording and not self.diverged:
            self._add_row(lateral)

    def _add_row(self, confinement: float) -> None:
        now, forces = self._now, self._ends.forces()
        stress = axial_stress(*forces, self._area, self.tension)
        travel = self._ends.travel() * (1.0 if self.tension else -1.0)
        axial, lateral = (travel / self._height, math.nan) if self.disc else self._strains()
        axial, lateral = axial - now.zero[0], lateral - now.zero[1]
        now.diverged = not math.isfinite(stress + axial)
        if now.diverged:
            return
        now.work += 0.5 * (stress + now.stress) * self._area * (travel - now.travel)
        now.stress, now.strain, now.travel = stress, axial, travel
        now.peak = max(now.peak, stress - confinement)
        self.built.cracks.look()
        tensile, shear = self.built.cracks.counts
        self._curve.append(
            step=yade.O.iter,
            axial_strain=axial,
            lateral_strain=lateral,
            axial_stress=stress,
            confinement=confinement,
            tensile_cracks=tensile,
            shear_cracks=shear,
            unbalanced_ratio=self.unbalanced(),
            kinetic_energy=utils.kineticEnergy(),
            elastic_energy=self.built.elastic_energy(),
            damage_energy=math.nan,
            softened_energy=math.nan,
            friction_energy=math.nan,
            damping_energy=dict(yade.O.energy.items()).get("nonviscDamp", 0.0),
            drag_energy=0.0,
            potential_energy=0.0,
            # nobody counts that of the pressure
            boundary_work=now.work if self.confinement is None else math.nan,
            end_mismatch=end_mismatch(*forces),
            velocity_factor=now.factor,
        )
        deviator = stress - confinement
        now.state = int(test_state(deviator, now.peak, axial, now.end, self._has_plateau))

    @property
    def _has_plateau(self) -> bool:
        """Whether the deviator has been constant over the last rows of the loading."""
        strain, first = self._now.plateau
        columns = self._curve["axial_strain"], measures.differential_stress(self._curve)
        axial, deviator = (np.ascontiguousarray(column[first:]) for column in columns)
        return is_plateau(axial, deviator, strain)

    def _strains(self) -> tuple[float, float]:
        """Axial strain in the sense of the loading, lateral strain as Poisson's effect [-]."""
        centres = np.array(self.built.specimen.centres, dtype=float)
        axes = range(self.built.axis + 1)
        places = np.array([[state.pos[k] for k in axes] for state in self.built.states()])
        gauge = self._solid_gauge if self.solid else self._gauge
        axial, lateral = gauge.strains(centres, places - centres)
        return (axial, -lateral) if self.tension else (-axial, lateral)
