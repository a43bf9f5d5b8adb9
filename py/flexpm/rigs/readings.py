# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of every rig: stress and strain, record, warnings, equilibrium. SI units.

Stress and axial strain are positive in the sense of the loading: compression, or tension if the
rig pulls. The lateral strain is positive as Poisson's effect.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import yade
from yade import wrapper

from ..dimensions import is_solid
from ..files import Table
from ..kinds.registry import of_ends
from ..materials.mixing import mineral_materials
from ..models.grains import Model
from ..models.spheres import SphereModel
from ..renamed import with_old_names
from ..results import doubts, measures
from ..results.record import COLUMNS, Curve
from ..runs.likely import BRITTLE, Softening
from ..runs.loading_rate import WAITING_MODELS, Loading, Scales, Schedule, schedule
from ..runs.run_spec import described


@dataclass(frozen=True)
class Balance:
    """Missing reactions of a specimen under a pressure, as ratios to the pressure, >= 0 [-].

    A wave that runs through many grains leaves each grain nearly in equilibrium, but shows here.
    """

    reaction: float  #: of a pressing force, in what bears it
    stress: float  #: of the mean stress that the pressing forces would give
    #: part of the stress, as waves swing: root of the kinetic energy over the elastic one. The mean
    #: stress of a wave passes through its place of rest; its motion is fastest there.
    motion: float

    @property
    def largest(self) -> float:
        """Largest of the ratios [-]; nan if any is nan."""
        return float(np.max([self.reaction, self.stress, self.motion]))


def balance_of(solver: wrapper.GrainSolver, pressing: float) -> Balance:
    """Return the missing reactions of grains at the last measured step.

    Args:
        solver: Solver of the grains.
        pressing: Least force of the pressure on an entire side [N].
    """
    now, energies = solver.balance(), solver.energies()
    mean, outside = (np.array(now[name]) for name in ("mean_stress", "outside_stress"))
    missing = part_of(np.hypot.reduce(now["missing_force"]), pressing)
    stress = part_of(np.abs(mean - outside).max(), np.abs(outside).max())
    # a product of two velocities is negative where a node turns within a step
    moving = abs(energies["kinetic_energy"])
    motion = np.sqrt(part_of(moving, energies["elastic_energy"]))
    return Balance(max(missing, now["plate_share"]), stress, float(motion))


def curve_of(recorder: wrapper.AxialRecorder, same: Mapping[str, str]) -> Curve:
    """Return the present record, with columns of gauges, and second names of some columns."""
    names, rows = list(recorder.names), recorder.rows
    for name, column in same.items():
        rows = np.column_stack([rows, rows[:, names.index(column)]])
        names.append(name)
    own = [name for name in names if name not in (*COLUMNS, "initial_energy")]
    return Curve.from_columns(names, rows, own)


def part_of(part: float, whole: float) -> float:
    """Return the ratio of two sizes >= 0; 0 for a zero part, infinity for a zero total."""
    if part == 0.0:
        return 0.0
    return float(part / whole) if whole != 0.0 else math.inf


def _softening_length(energies: Sequence[float], strengths: Sequence[float]) -> float:
    """Return the mean of twice an energy divided by its strength [m]; 0 without strength."""
    pairs = zip(energies, strengths, strict=True)
    return float(np.mean([2.0 * one / strength if strength else 0.0 for one, strength in pairs]))


class Readings(Protocol):
    """Values of the last row of a record."""

    @property
    def stress(self) -> float: ...  # noqa: D102
    @property
    def differential(self) -> float: ...  # noqa: D102
    @property
    def strain(self) -> float: ...  # noqa: D102
    @property
    def peak(self) -> float: ...  # noqa: D102
    @property
    def state(self) -> int: ...  # noqa: D102


def ended_rising(stages: Sequence[Table], record: Curve) -> bool:
    """Whether the last loading of a test ended by its default while the load still rose."""
    loadings = [stage for stage in stages if stage["stage"] == "load"]
    rose = bool(loadings) and loadings[-1].get("still_rises", False)
    return rose and measures.peak_row(record) is None


@with_old_names
class RigReadings(ABC):
    """Readings of a specimen between its loading ends.

    Attributes:
        built: The specimen and its model.
        tension: Whether the ends pull. False: they press.
        disc: Whether the specimen is a disc between two plates.
        solid: Whether the specimen is 3D.
    """

    def __init__(self, built: Model | SphereModel, *, tension: bool = False) -> None:
        """Take a specimen that has just been built, or whose scene has been loaded."""
        self.built, self.tension = built, tension
        self.disc = built.specimen.kind in ("disc", "solid-disc")
        self.solid = is_solid(built.specimen.kind)

    @property
    def kind(self) -> str:
        """Name of the test that has the same ends, and whose loading rate is used."""
        shape, confined = self.built.specimen.kind, self.confinement is not None
        return of_ends(shape, pulls=self.tension, confined=confined)

    @property
    def reference_strain(self) -> float:
        """Strain at the reference strength, near which a brittle specimen fails [-]."""
        return self._schedule(Loading()).reference_strain

    def likely_steps(self, loading: Loading) -> int:
        """Return the expected number of steps of a test with these ends under a loading."""
        return self._schedule(loading).likely_steps

    @property
    def stress(self) -> float:
        """Axial stress of the last row of the record [Pa]."""
        return self._readings.stress

    @property
    def strain(self) -> float:
        """Axial strain of the last row of the record [-]."""
        return self._readings.strain

    @property
    def _reached(self) -> str:
        """Strain of the last row of the record, in words."""
        return f"axial strain = {self.strain:.3g}"

    @property
    @abstractmethod
    def record(self) -> Curve:
        """The present record."""

    def to_yade_plot(self) -> None:
        """Copy the present record into ``yade.plot``, each column under its name."""
        from yade import plot  # takes long to load

        record = self.record
        plot.data.update({name: record[name].tolist() for name in record.columns})

    @property
    def warnings(self) -> list[str]:
        """Reasons why the record is questionable, one line each.

        Reasons are: load and reactions differ, the energy balance has a large error, numbers are
        not finite, sizes are probably in other units, or user-supplied grains have another size
        than the grains of the material's calibration. For grains there are further reasons: a joint
        deviates from its line, a set point is missed, or a gauge is on an erased grain.
        """
        record = self.record
        error = measures.energy_error(record, self.initial_energy)
        mismatch = measures.median_end_mismatch(record)
        specimen = self.built.specimen
        lines = [doubts.of_divergence(yade.O.iter, self._stop_reason)] if self.diverged else []
        plane = {} if self.solid else {"thickness": specimen.thickness}
        odd = doubts.of_lengths({**specimen.extent, **plane}, (specimen.mean_diameter,))
        lines += odd
        # inputs tell those of a packing, and pieces of grains beside joints are no grains
        if specimen.spec.diameters is None and specimen.grains is None and not odd:
            material = described(self.built.material, self.built.name)
            lines += doubts.of_grain_size(
                material, self.built.name, specimen.mean_diameter, solid=self.solid
            )
        return lines + doubts.of_result("", error, mismatch, None)

    @property
    @abstractmethod
    def confinement(self) -> float | None:
        """Requested confining pressure [Pa]; None without a pressure."""

    @property
    @abstractmethod
    def diverged(self) -> bool:
        """Whether a number is no longer finite."""

    @property
    def _stop_reason(self) -> str:
        """Cause that has stopped a simulation that diverged; empty if unknown."""
        return ""

    @property
    @abstractmethod
    def ended_by(self) -> str | None:
        """Event that has ended the last stage, see ``Result``; None if no event has ended it."""

    @property
    def may_fail_at_once(self) -> bool:
        """Whether the specimen may fail along a plane without earlier cracks."""
        return False

    @property
    def planned(self) -> bool:
        """Whether the specimen was loaded at a rate, which follows from its scales."""
        return True

    @property
    def initial_energy(self) -> float | None:
        """Energy when the work began to count [J]; None if unknown."""
        return None

    @property
    def contact_width(self) -> float | None:
        """Mean width on which the plates touch a disc [m]; None if unknown."""
        return None

    @abstractmethod
    def scales(self) -> Scales:
        """Return the quantities that determine the loading rate, for the present specimen."""

    @abstractmethod
    def unbalanced(self) -> float:
        """Return the ratio of the largest unbalanced force to the mean contact force [-]."""

    @abstractmethod
    def balance(self) -> Balance:
        """Return the missing reactions of the specimen under its present pressure."""

    @property
    def layout(self) -> Table:
        """Fixed and driven parts of the specimen as plain values."""
        return {"ends": {"test": self.kind, "pull": self.tension}}

    @property
    @abstractmethod
    def _readings(self) -> Readings: ...

    @property
    def _ahead(self) -> float:
        """Ratio of the driven velocity to the specimen's end velocity, in the elastic solution."""
        return 1.0

    def _schedule(self, loading: Loading) -> Schedule:
        pressure, dt = self.confinement or 0.0, yade.O.dt
        scales = self.scales()
        return schedule(
            *(self.kind, self.built.name, loading, scales),
            confinement=pressure,
            dt=dt,
            solid=self.solid,
            softening=self._softening(),
            dynamic=self.built.dynamic,
        )

    def _softening(self) -> Softening:
        """Return the softening of the contacts, means over the minerals."""
        if self.built.name not in WAITING_MODELS:
            return BRITTLE
        laws = [kind.law(self.built.name) for kind in mineral_materials(self.built.material)]
        tensile = [law["tensile_strength"] for law in laws]
        cohesion = [law["cohesion"] for law in laws]
        return Softening(
            _softening_length([law["tensile_fracture_energy"] for law in laws], tensile),
            _softening_length([law["shear_fracture_energy"] for law in laws], cohesion),
            float(np.mean(cohesion)),
        )
