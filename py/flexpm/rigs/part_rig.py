# SPDX-License-Identifier: GPL-3.0-or-later
"""A rig of parts: supports, rollers, platens, fixed nodes and gauges at chosen positions. SI units.

A part is a rigid plate against a part of the outline, of deformable and of rigid grains, or a set
of nodes. A plate does not rotate. It presses, also pulls if it is bonded, and resists sliding
within its friction. Nodes are fixed, moved or rotated together, at any position.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import astuple, replace
from typing import ClassVar, Self, Unpack, cast

import numpy as np
from yade import wrapper

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table
from ..kinds.registry import OWN, kind_of
from ..models.grains import Model
from ..renamed import with_old_names
from ..require import NOT_NEGATIVE, require_number
from ..runs.loading_rate import Loading, Scales, Schedule, rates_of
from ..runs.runner import Runner
from .outcome.calls import recording
from .outcome.kept import KeptTest, Leaves
from .part_columns import PartColumns
from .parts import Part, require_part
from .stages.excavating import PartExcavation

#: Least cosine between a plate's normal and its way at which it still pushes [-].
_PUSHES = 1e-9


@with_old_names
@recording
class PartRig(PartColumns, PartExcavation):
    """A specimen of any outline, 2D or 3D, between parts.

    Add plates with `support` and `platen`, fix nodes with `hold`, and add gauges with `gauge`.
    Select the parts that load the specimen with `drive`, and then call `load` or `strain_to`. In a
    scene that was loaded, the same calls find the parts that they have added before.
    Positions and directions of a 3D specimen have three components.

    Example:
        >>> rig = flexpm.PartRig(flexpm.build(specimen))
        >>> low = rig.platen(0, friction=0.5)
        >>> top = rig.platen(2)
        >>> rig.drive(top, (0, -1), against=low, area=0.012 * 0.01, length=0.024)
        >>> rig.strain_to(1e-4, rate=6.0)
        >>> 1e6 < rig.stress < 5e6
        True
    """

    built: Model
    _finds_weakest = True
    #: What makes such a rig, and whether of solids.
    _call, _of_solids = "PartRig", False
    #: The class of a rig of a 3D specimen, which says so itself.
    _rig_of_solids: ClassVar[type[PartRig]]

    def __init_subclass__(cls) -> None:
        """Register the class of a 3D rig."""
        super().__init_subclass__()
        if cls._of_solids:
            PartRig._rig_of_solids = cls

    def __new__(cls, built: Model, *_: object, **__: object) -> Self:
        """Make a rig of the specimen's dimension."""
        if cls is PartRig and is_solid(built.specimen.kind):
            return cast(Self, super().__new__(PartRig._rig_of_solids))
        return super().__new__(cls)

    def __init__(
        self,
        built: Model,
        *,
        kind: str = OWN.name,
        runner: Runner | None = None,
        **leaves: Unpack[Leaves],
    ) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: The specimen and its model.
            kind: Name of the test, whose loading rate is used.
            runner: Object that steps, shows progress and saves checkpoints; None: it only steps.
            leaves: Output of the test, as for `flexpm.rig`: ``out``, ``frames``, ``film``,
                ``report``, ``checkpoint_interval``.

        Raises:
            InputError: for a test that the model does not have; ``"own"`` requires deformable or
                rigid grains; for a folder with other content.
        """
        if is_solid(built.specimen.kind) != self._of_solids:
            raise InputError(
                f"{self._call}: specimen = {built.specimen.kind}, must be 3D; use flexpm.PartRig "
                "for 2D and 3D"
            )
        rates_of(kind, built.name, solid=self._of_solids)
        kept = KeptTest.of(built, self._call, leaves, kind=kind)
        super().__init__(built, runner=runner if kept is None else kept.runner)
        self.disc = False
        self._kind = kind
        self._scales: Scales | None = None
        #: Largest displacement of a history that is prescribed in time [m]; 0: there is none.
        self._farthest = 0.0
        #: What ``confine`` presses on.
        self.pressed: Part | None = None
        self._begin_layout()
        if kept is not None:
            kept.attach(self)

    @property
    def kind(self) -> str:
        """Name of the test."""
        return self._kind

    @property
    def layout(self) -> Table:
        """Parts, driven parts and gauges as plain values."""
        return {"parts": self.parts, "drive": self.drives, "gauges": self.gauges}

    def scales(self) -> Scales:
        """Return the quantities that determine the loading rate, from the elastic solution.

        The first loading computes these quantities; later damage does not change them.

        Raises:
            InputError: if no part loads, no part fixes the specimen, or nothing resists the load.
        """
        self._require_driven("load:")
        if self._scales is None:
            self._require_push(1.0)
            kept = self._frame.loadingScales
            self._scales = Scales(*kept) if kept else super().scales()
            if self._begun and not kept:  # by motions that were prescribed
                self._keep_scales()
        return self._scales

    def _keep_scales(self) -> None:
        if self._scales is not None:
            self._frame.loadingScales = list(astuple(self._scales))

    @property
    def planned(self) -> bool:
        """Whether loading rates apply; False for prescribed motions with real masses (`follow`)."""
        return self._scales is not None or bool(self._frame.loadingScales)

    @property
    def reference_strain(self) -> float:
        """Approximate strain at failure, or the largest strain of a prescribed history [-]."""
        if self._farthest and not self.planned:
            return self._farthest / self._frame.length
        return super().reference_strain

    @property
    def motion_energy(self) -> float:
        """Energy supplied by the prescribed loading motion up to the last measured step [J].

        The elastic start supplies it, and a loading that slows down removes it. The boundary work
        of the record is the sum of this energy and of the work of all parts and fluids.
        """
        solver = self.built.solver
        parts, energies = (*solver.plates(), *solver.nodeSets()), solver.energies()
        return energies["boundary_work"] - sum(float(part["work"]) for part in parts)

    @property
    def _reached(self) -> str:
        if self._frame.length != 1.0:
            return super()._reached
        unit = "angle = {:.3g} rad" if self._turns else "displacement = {:.3g} m"
        return unit.format(self.strain)

    @property
    def has_scale(self) -> bool:
        """False until parts are driven; with real masses, False until the specimen is loaded."""
        if self.built.dynamic:
            return self.planned or self._farthest > 0.0
        return bool(self._frame.driven or self._frame.drivenSets)

    @property
    def may_fail_at_once(self) -> bool:
        """True: a specimen may have few contacts over its width; a notch is no weak plane."""
        if self.kind == OWN.name:
            return True
        there = self.built.specimen.spec.joint_names or ()
        return any(not one.open for one in self.built.material.joints if one.name in there)

    @property
    def confinement(self) -> float | None:
        """None: a pressure on a part is not a confining pressure of the record."""
        return None

    def press(self, part: Part | Mapping[Part, float], pressure: float | None = None) -> None:
        """Move parts along their normals under pressures [Pa] until the forces are in equilibrium.

        The pressures stay. Displacements and gauges are counted from this state. Parts may be
        pressed one after the other, each with its own pressure, or in one call:
        ``press({top: 2e6, right: 1e6})``. Each part then carries its pressure within 0.1 %.

        Raises:
            InputError: for a value that is not a plate of this rig, or a part that the loading
                drives.
            SimulationError: if the forces do not reach equilibrium.

        Example:
            >>> rig = flexpm.PartRig(flexpm.build(specimen))
            >>> low = rig.platen(0, friction=0.5)
            >>> top = rig.platen(2)
            >>> rig.press(top, 1e6)
            >>> print(f"{low.force[1]:.0f} N")
            120 N
        """
        if isinstance(part, Mapping):
            if pressure is not None:
                raise InputError(
                    "press: pressure and a table of pressures are given; leave out one of them"
                )
            self._press_all(part)
            return
        part = require_part("press: part", self, part, Part)
        self._require_free(part)
        value = require_number("press: pressure", pressure, NOT_NEGATIVE, "Pa")
        self.pressed = part
        if value:
            self.confine(value)
        else:
            self._press_all({part: value})

    def confine(self, pressure: float) -> None:
        """Press on the part ``pressed`` until the forces are in equilibrium, see `press`.

        Args:
            pressure: Pressure on the width of the part [Pa].

        Raises:
            SimulationError: if no part has this name, or if the forces do not reach equilibrium.
        """
        super().confine(pressure)
        self._scales = None  # joints that are closed now bear what they did not bear before

    def _press(self, pressure: float, ramp: int) -> None:
        if self.pressed is None:
            raise InputError("confine: part = None, must be a part of the rig; call press")
        self._require_scene("press")
        number = self.pressed.number
        engine = wrapper.PressureController(
            plates=[number],
            pressure=pressure,
            startPressure=self._pressure_on(number),
            rampSteps=ramp,
        )
        self._let_go([number])
        self.built.add_engines(before=(engine,))

    def _pressing_force(self) -> float:
        if self._asked_force is not None:
            return self._asked_force
        pressing = self._pressing()
        if self.pressed is None or pressing is None:
            return 0.0
        return pressing.pressure * self.pressed.area

    def _crossing_steps(self) -> float:
        """Transit time in a disc of the specimen's area [steps]; also before pressing."""
        return self.built.solver.crossingSteps(self.built.specimen.equal_diameter)

    @property
    def _pressed_part(self) -> Table:
        return {} if self.pressed is None else {"part": str(self.pressed)}

    def _begin_record(self) -> None:
        super()._begin_record()
        if self._from_now:
            self._recorder.fromNow = True
        self._keep_scales()

    def _set_row_period(self) -> None:
        if self.planned:
            super()._set_row_period()
        else:
            self._set_period_for(self._crossing_steps())

    @property
    def may_pull(self) -> bool:
        """Whether driven parts can pull: fixed nodes and bonded plates."""
        frame, plates = self._frame, self.built.solver.plates()
        return bool(frame.drivenSets) or all(plates[number]["bonded"] for number in frame.driven)

    @property
    def _stops_at_zero(self) -> bool:
        return False  # plates separate from the specimen and go on

    @property
    def _ahead(self) -> float:
        """The crosshead of a soft machine goes ahead of the part that loads."""
        if not (machine := self.machine):
            return 1.0
        return 1.0 + self.scales().modulus * self._frame.area / self._frame.length / machine

    def _schedule(self, loading: Loading) -> Schedule:
        """Return the plan with the velocity at which the parts produce the loading rate."""
        plan = super()._schedule(loading)
        return replace(plan, velocity=plan.velocity * self._ahead)

    def _drive(self, plan: Schedule) -> None:
        self._require_scene("load")
        if self._recorder.loading is None:
            self._require_push(plan.velocity)
        super()._drive(plan)

    def _require_push(self, velocity: float) -> None:
        """Reject plates that all move away from the specimen and are not pressed against it."""
        frame, plates = self._frame, self.built.solver.plates()
        if frame.drivenSets:
            return
        along = [frame.direction[axis] for axis in range(len(self._axes))]
        way = math.copysign(1.0, velocity) * np.array(along)
        for number in frame.driven:
            plate = plates[number]
            if plate["bonded"] or plate["pressed"] or any(plate["force"]):
                return
            if np.dot(plate["normal"], way) > (-_PUSHES if plate["friction"] else _PUSHES):
                return
        part = Part(self, self.built.solver, "plate", frame.driven[0])
        raise InputError(
            f"load: driven part = {part}, pulls without bond, must push; reverse the direction, or "
            "pass bonded=True to platen or support"
        )

    def _take_hold(self) -> wrapper.LoadingController:
        frame = self._frame
        self._let_go(frame.driven)
        loading = wrapper.PlateController(
            plates=frame.driven,
            nodeSets=frame.drivenSets,
            backSets=frame.backSets,
            elasticStart=not self.built.dynamic,
            ofParts=True,
        )
        if kind_of(self.kind).slides:  # what slides lets go within the time of a wave
            loading.renewPeriod = math.ceil(self.scales().crossing_steps)
        self.built.add_engines(before=(loading,))
        return loading

    def _move(self, velocity: float, factor: float) -> None:
        loading, direction = self._recorder.loading, self._frame.direction
        assert isinstance(loading, wrapper.PlateController)
        stood = loading.started and loading.velocity.norm() == 0.0
        if velocity and stood and not self.built.dynamic:
            loading = self._take_hold_again(loading)
            assert isinstance(loading, wrapper.PlateController)
        speed = -velocity  # a rig that presses gives that of its upper end, upwards
        loading.velocity = (speed * direction[0], speed * direction[1], speed * direction[2])
        loading.velocityFactor = factor

    def _take_hold_again(self, stood: wrapper.LoadingController) -> wrapper.LoadingController:
        """Restart along the elastic solution: the motion of a stopped loading is over."""
        self.built.remove_engines(stood)
        fresh = self._take_hold()
        fresh.undampedLoading = stood.undampedLoading
        self._recorder.loading = fresh
        return fresh

    def _loaded_area(self) -> float:
        return self._frame.area
