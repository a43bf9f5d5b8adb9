# SPDX-License-Identifier: GPL-3.0-or-later
"""Record of a test on YADE's bonded spheres: stress, strains and energies. SI units.

Axial stress and strain count positive in the sense of the loading, the lateral strain as Poisson's
effect. Quantities that YADE's models do not keep are nan: the energies lost in cracks and friction.
The elastic energy is that of unbroken bonds and plates (JCFpm) or of all contacts (CohFrict).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import astuple, dataclass, field

import numpy as np
import yade
from yade import utils

from ..errors import InputError
from ..models.sphere_bonds import tributary_lengths
from ..models.spheres import SphereModel
from ..results.record import Curve

#: Of a recorder, what the next row depends on besides the last sample.
_KEPT = ("peak", "over", "diverged", "work")


class Gauge:
    """Strains of a specimen from the centres of grains, extension positive.

    The axial strain is measured between bands at a quarter and three quarters of the height, so
    that contacts with plates do not count; the lateral one between the means of the sides.
    """

    def __init__(self, built: SphereModel) -> None:
        self._ids = built.ids
        specimen = built.specimen
        bottom, height = specimen.outline[:, 1].min(), specimen.dimensions["height"]
        above = specimen.centres[:, 1] - bottom
        self._axial = []
        for share in (0.25, 0.75):
            # a little more, so that round-off does not choose
            near = np.abs(above - share * height) <= 1.001 * specimen.mean_diameter
            if not near.any():
                raise InputError(
                    f"strain gauge: height = {share * height:.6g} m, has no grain near; "
                    "use smaller grains"
                )
            self._axial.append(dict.fromkeys(np.flatnonzero(near).tolist(), 1.0))
        self._lateral = [tributary_lengths(specimen, side) for side in (3, 1)]
        # strains count from the state in which the first gauge was laid
        self._lengths = built.memory.setdefault("gauge", self._spans())

    def strains(self) -> tuple[float, float]:
        """Axial and lateral strain [-]."""
        axial, lateral = (
            now / before - 1.0 for now, before in zip(self._spans(), self._lengths, strict=True)
        )
        return axial, lateral

    def _spans(self) -> tuple[float, float]:
        spans = []
        for axis, (low, high) in ((1, self._axial), (0, self._lateral)):
            ends = [
                np.average(
                    [yade.O.bodies[self._ids[grain]].state.pos[axis] for grain in group],
                    weights=list(group.values()),
                )
                for group in (low, high)
            ]
            spans.append(float(ends[1] - ends[0]))
        return spans[0], spans[1]


@dataclass
class Ending:
    """When a test has shown what it is made for."""

    least_peak: float  #: no fall counts before the stress has risen by this [Pa]
    max_strain: float  #: of the specimen between its ends; the test ends there [-]
    stop_ratio: float  #: ends once the stress has fallen below this part of its peak [-]


@dataclass
class Sample:
    """What only the loading of a test knows."""

    stress: float  #: axial, positive in the sense of the loading [Pa]
    mismatch: float  #: of both ends' reactions [-]
    travel: float  #: of the moving end, positive in the sense of the loading [m]
    axial_strain: float  #: [-]
    lateral_strain: float = math.nan  #: [-]
    confinement: float = 0.0  #: [Pa]
    other_work: float = 0.0  #: of other loads since the start [J]


@dataclass
class Recorder:
    """Builds the record of a test row by row and says when the test is over."""

    built: SphereModel
    area: float  #: loaded area [m2]
    height: float  #: between the ends [m]
    ending: Ending
    sample: Callable[[], Sample]
    curve: Curve = field(default_factory=Curve)
    peak: float = 0.0  #: largest stress above the confinement [Pa]
    over: bool = False
    diverged: bool = False
    work: float = 0.0
    _last: Sample = field(default_factory=lambda: Sample(0.0, 0.0, 0.0, 0.0))

    def __post_init__(self) -> None:
        known = self.built.memory.get("record")
        if known is not None:
            self.curve = Curve.from_array(known["rows"])
            self._last = Sample(*known["last"])
            for name in _KEPT:
                setattr(self, name, known[name])

    def remember(self) -> None:
        """Leave the record with the model, for one that goes on from its scene."""
        kept = {name: getattr(self, name) for name in _KEPT}
        rows, last = self.curve.array.tolist(), list(astuple(self._last))
        self.built.memory["record"] = {"rows": rows, "last": last, **kept}
        self.built.remember()

    def record(self) -> None:
        """Add a row for the present state."""
        now = self.sample()
        if not math.isfinite(now.stress + now.axial_strain):
            self.diverged = self.over = True
            return
        self.built.cracks.look()
        mean = 0.5 * (now.stress + self._last.stress)
        self.work += mean * self.area * (now.travel - self._last.travel)
        self._last = now
        tensile, shear = self.built.cracks.counts
        self.curve.append(
            step=yade.O.iter,
            axial_strain=now.axial_strain,
            lateral_strain=now.lateral_strain,
            axial_stress=now.stress,
            confinement=now.confinement,
            tensile_cracks=tensile,
            shear_cracks=shear,
            unbalanced_ratio=unbalanced_ratio(self.built),
            kinetic_energy=utils.kineticEnergy(),
            elastic_energy=self.built.elastic_energy(),
            damage_energy=math.nan,
            friction_energy=math.nan,
            damping_energy=_damping_energy(),
            potential_energy=0.0,
            boundary_work=self.work + now.other_work,
            end_mismatch=now.mismatch,
            velocity_factor=1.0,
        )
        above = now.stress - now.confinement
        self.peak = max(self.peak, above)
        fallen = above < self.ending.stop_ratio * self.peak
        self.over = (self.peak >= self.ending.least_peak and fallen) or (
            now.travel >= self.ending.max_strain * self.height
        )


def unbalanced_ratio(built: SphereModel) -> float:
    """Largest resultant on what is free to move over the mean contact force [-].

    YADE's own ratio counts the reactions of grips, too; it serves to get the mean contact force.
    """
    largest, free = 0.0, 0.0
    for body in built.ids:
        force, blocked = yade.O.forces.f(body), str(yade.O.bodies[body].state.blockedDOFs)
        largest = max(largest, math.hypot(force[0], force[1]))
        free = max(free, math.hypot(*(force[k] if "xy"[k] not in blocked else 0.0 for k in (0, 1))))
    return utils.unbalancedForce(useMaxForce=True) * free / largest if largest > 0.0 else math.nan


def _damping_energy() -> float:
    return float(dict(yade.O.energy.items()).get("nonviscDamp", 0.0))
