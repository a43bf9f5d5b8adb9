# SPDX-License-Identifier: GPL-3.0-or-later
"""A rig of parts: supports, rollers, platens, held nodes and gauges, where a test wants them. SI.

A part is a rigid plate against a part of the outline, of deformable and of rigid grains alike, or a
set of nodes. A plate does not turn; it presses, pulls too if it is bonded, and resists sliding
within its friction. Nodes are held, moved or turned as one, wherever they lie.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple

import numpy as np
from yade import wrapper

from ..errors import InputError
from ..kinds.registry import OWN, kind_of
from ..models.grains import Model
from ..require import NOT_NEGATIVE, POSITIVE, require_flag, require_known, require_number
from ..results import doubts, measures
from ..results.record import COLUMNS, Curve
from ..runs.loading_rate import Scales, Schedule, rates_of
from ..runs.runner import Runner
from .grain_rig import GrainRig
from .layout import PartLayout
from .parts import (
    HeldNodes,
    Part,
    RigPart,
    numbers,
    require_apart,
    require_part,
    require_parts,
)
from .places import Place, require_column, require_direction, require_vector
from .statics.elastic_state import PartStatics

#: Least cosine between a plate's normal and its way at which it still pushes [-].
_PUSHES = 1e-9


class PartRig(PartStatics, GrainRig, PartLayout):
    """A specimen of any outline between parts.

    Lay parts with `support` and `platen`, hold nodes with `hold`, read with `gauge` and `way_of`,
    say with `drive` or `turn` which parts load, and then `load` or `strain_to`. In a run that is
    taken up from a checkpoint the same calls find what they have laid before.
    """

    def __init__(self, built: Model, *, kind: str = OWN.name, runner: Runner | None = None) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: The specimen.
            kind: Name of the test, whose loading rate is taken.
            runner: Steps, shows progress and saves checkpoints; None for one that only steps.

        Raises:
            InputError: for a test that is not one of the model's; ``"own"`` is one of deformable
                and of rigid grains.
        """
        rates_of(kind, built.name)
        super().__init__(built, runner=runner)
        self.disc = False
        self._kind = kind
        self._scales: Scales | None = None
        self._same: dict[str, str] = {}
        #: What ``confine`` presses on.
        self.pressed: Part | None = None
        self._begin_layout()

    def _new_frame(self) -> wrapper.PartFrame:
        return wrapper.PartFrame()

    @property
    def _frame(self) -> wrapper.PartFrame:
        """What tells the record which parts hold and load, and along which direction."""
        frame = self._recorder.frame
        if not isinstance(frame, wrapper.PartFrame):
            raise InputError(
                f"part rig: frame of the scene's record = {type(frame).__name__}, must be a "
                "PartFrame; build the specimen anew"
            )
        return frame

    @property
    def kind(self) -> str:
        """Name of the test."""
        return self._kind

    def gauge(
        self,
        name: str,
        first: Place,
        second: Place,
        *,
        along: Place | None = None,
        strain: bool = False,
    ) -> None:
        """Record how far two points move apart, in a column of this name.

        Args:
            name: Name of the column.
            first: x and y of a point; the nearest node of the grains on its side is taken [m].
            second: The other one.
            along: x and y of the direction in which the second one moves away from the first one;
                None for that from the first to the second place.
            strain: Record the strain between them [-] instead of the opening [m].
        """
        label = f"gauge {self._gauge_name(name)}"
        one, two = (
            require_vector(f"{label}: first", first),
            require_vector(f"{label}: second", second),
        )
        strain = require_flag(f"{label}: strain", strain)
        try:
            node, other, length = self.built.solver.gaugePoints(one, two)
        except ValueError as error:
            raise InputError(f"{label}: {error}") from None
        if strain and not length > 0.0:
            raise InputError(f"{label}: length = 0 m, must be above 0; take points further off")
        apart = (two[0] - one[0], two[1] - one[1])
        direction = require_direction(label, apart if along is None else along)
        base = length if strain else 0.0
        self._add_gauge(
            name,
            wrapper.Gauge(first=node, second=other, direction=direction, length=base),
        )

    def way_of(self, name: str, part: RigPart, direction: Place) -> None:
        """Record how far a part moves along a direction [m], in a column of this name.

        The way of held nodes is their mean.
        """
        label = f"gauge {self._gauge_name(name)}"
        part = require_part(f"{label}: part", self, part, RigPart)
        gauge = wrapper.Gauge(direction=require_direction(label, direction))
        if isinstance(part, HeldNodes):
            gauge.nodes = part.nodes
        else:
            gauge.plate = part.number
        self._add_gauge(name, gauge)

    def also(self, name: str, column: str) -> None:
        """Give a column of the record a second name, which the test is known by."""
        there = self._columns()
        require_known("also: column", column, there)
        self._same[require_column("also", name, (*there, "set_point"))] = column

    def drive(
        self,
        parts: RigPart | Sequence[RigPart],
        direction: Place,
        *,
        against: RigPart | Sequence[RigPart] = (),
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
    ) -> None:
        """Say which parts load the specimen, and what its stress and strain are.

        The record has the columns ``load`` and ``displacement`` of these parts. Its stress is the
        load over `area`, its strain the displacement over `length`: with the defaults they are the
        load and the displacement themselves. A part that is pressed is taken over as it is loaded:
        its pressure ends there, and its force goes on from there.

        Args:
            parts: They move alike.
            direction: x and y of the loading.
            against: Parts that hold the specimen against the load: the load is then the mean of
                both sides', and their difference is recorded.
            area: Load over stress [m2].
            length: Displacement over strain [m].
            strength: Stress that the specimen will bear, roughly [Pa], which sets the loading rate;
                0: twice that at which the first contact point softens.

        Raises:
            InputError: for what is no part of this rig or is there twice, nodes that are not held
                along the direction, or a size out of range; in a scene whose record has begun, for
                anything else than it began with.
        """
        unit = require_direction("drive", direction)
        moved = require_parts("drive: part", self, parts, RigPart)
        held = require_parts("drive: part against", self, against, RigPart)
        if not moved:
            raise InputError("drive: parts = none, must be at least 1")
        require_apart("drive: part", moved, held)
        for part in moved:
            if isinstance(part, HeldNodes):
                _require_along(part, unit)
        self._require_fixed("drive")
        self._load_by(
            "drive",
            driven=numbers(moved, Part),
            drivenSets=numbers(moved, HeldNodes),
            backSets=[],
            holding=numbers(held, Part),
            holdingSets=numbers(held, HeldNodes),
            direction=unit,
            area=require_number("drive: area", area, POSITIVE, "m2"),
            length=require_number("drive: length", length, POSITIVE, "m"),
            strength=require_number("drive: strength", strength, NOT_NEGATIVE, "Pa"),
        )

    def turn(
        self,
        parts: HeldNodes | Sequence[HeldNodes],
        back: HeldNodes | Sequence[HeldNodes] = (),
        *,
        about: Place | None = None,
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
    ) -> None:
        """Load the specimen by turning held nodes, each set like a rigid body.

        The record's ``load`` is the sum of their moments [N m], its ``displacement`` the angle of
        each [rad]; stress and strain are these over `area` and `length`, as with `drive`.

        Args:
            parts: Sets that turn counter-clockwise.
            back: Sets that turn clockwise by the same angle.
            about: x and y of the point that all turn about [m]. None: each turns about the mean of
                its places and is free to move with it, so that a moment alone acts (deviation D53).
            area: Load over stress [N m / Pa].
            length: Displacement over strain [-].
            strength: As for `drive`.

        Raises:
            InputError: as `drive`.
        """
        sets = require_parts("turn: part", self, parts, HeldNodes)
        others = require_parts("turn: part back", self, back, HeldNodes)
        if not sets:
            raise InputError("turn: parts = none, must be at least 1")
        require_apart("turn: part", sets, others)
        pivot = None if about is None else require_vector("turn: about", about)
        self._require_fixed("turn", () if about is not None else (*sets, *others))
        self._load_by(
            "turn",
            driven=[],
            drivenSets=numbers(sets, HeldNodes),
            backSets=numbers(others, HeldNodes),
            holding=[],
            holdingSets=[],
            direction=(0.0, 0.0, 1.0),
            area=require_number("turn: area", area, POSITIVE, "N m/Pa"),
            length=require_number("turn: length", length, POSITIVE),
            strength=require_number("turn: strength", strength, NOT_NEGATIVE, "Pa"),
        )
        for part in (*sets, *others):
            self._turn_about(part, pivot)

    def scales(self) -> Scales:
        """What the loading rate follows from: the elastic solution of the specimen before it.

        They are those that the first loading has found, whatever has broken since.

        Raises:
            InputError: where no part loads, nothing holds the specimen, or nothing resists.
        """
        frame = self._frame
        if not (frame.driven or frame.drivenSets):
            raise InputError("load: driven parts = none, must be at least 1; call drive or turn")
        if self._scales is None:
            kept = frame.loadingScales
            self._scales = Scales(*kept) if kept else super().scales()
        return self._scales

    @property
    def record(self) -> Curve:
        """The record so far, with the columns of the parts and gauges."""
        names, rows = list(self._recorder.names), self._recorder.rows
        for name, column in self._same.items():
            rows = np.column_stack([rows, rows[:, names.index(column)]])
            names.append(name)
        own = [name for name in names if name not in (*COLUMNS, "initial_energy")]
        return Curve.from_columns(names, rows, own)

    @property
    def motion_energy(self) -> float:
        """What has set the grains into the motion of the loading, at the last measured step [J].

        The elastic start gives it, and the loading takes it back as it slows. The boundary work of
        the record is the work of all parts and this.
        """
        solver = self.built.solver
        parts, energies = (*solver.plates(), *solver.nodeSets()), solver.energies()
        return energies["boundary_work"] - sum(float(part["work"]) for part in parts)

    @property
    def warnings(self) -> list[str]:
        """What makes the record doubtful, also a load that grew fast up to its peak."""
        if self._recorder.loading is None:
            return super().warnings
        growth = measures.growth_before_peak(self.record, self.scales().crossing_steps)
        return super().warnings + doubts.of_growth(growth)

    @property
    def may_fail_at_once(self) -> bool:
        """A test of one's own may have few contacts across; a notch alone is no weak plane."""
        if self.kind == OWN.name:
            return True
        there = self.built.specimen.spec.joint_names or ()
        return any(not one.open for one in self.built.material.joints if one.name in there)

    @property
    def confinement(self) -> float | None:
        """None: what presses on a part is no confinement of the record."""
        return None

    def press(self, part: Part, pressure: float) -> None:
        """Let a part move along its normal under a pressure [Pa] until the forces balance.

        It goes on to press. Displacements and gauges count from there on. Parts may be pressed one
        after the other, each with its own pressure.

        Raises:
            InputError: for what is no plate of this rig, or one that the loading drives already.
        """
        part = require_part("press: part", self, part, Part)
        if self._recorder.loading is not None and part.number in self._frame.driven:
            raise InputError(
                f"press: part = {part}, is driven, must not be; press it before `load`"
            )
        self.pressed = part
        self.confine(require_number("press: pressure", pressure, NOT_NEGATIVE, "Pa"))

    def confine(self, pressure: float) -> None:
        """Press on the part ``pressed`` until the forces balance, see `press`.

        Args:
            pressure: On the width of the part [Pa].

        Raises:
            SimulationError: if no part is named, or if the forces do not come to balance.
        """
        super().confine(pressure)
        self._scales = None  # joints that are closed now bear what they did not bear before

    @property
    def _begun(self) -> bool:
        """Whether the record has begun, here or in the scene that was taken up."""
        return self.built.engine(wrapper.AxialRecorder) is not None

    def _load_by(self, call: str, **asked: object) -> None:
        """Give the record's frame what loads, or compare it with what the record has begun with."""
        self._require_scene(call)
        frame = self._frame
        for name, value in asked.items():
            now = getattr(frame, name)
            same = [*now] == [*value] if isinstance(value, list | tuple) else now == value
            if self._begun and not same:
                raise InputError(
                    f"{call}: {name} = {value}, must be as the record has begun, {now}; make the "
                    "same calls, or a new rig"
                )
        if not self._begun:
            for name, value in asked.items():
                setattr(frame, name, value)

    def _require_fixed(self, call: str, free: Sequence[RigPart] = ()) -> None:
        """Refuse other loads once a set is free to move as it turns, for it holds nothing then."""
        sets = self.built.solver.nodeSets()
        floating = {number for number, one in enumerate(sets) if one["floats"]}
        if not self._begun and floating - {part.number for part in free}:
            raise InputError(
                f"{call}: parts = others after turn, must be given once; make a new rig"
            )

    def _turn_about(self, part: HeldNodes, pivot: tuple[float, float, float] | None) -> None:
        if not self._begun:
            self.built.solver.turnNodeSet(part.number, pivot)
            return
        now = self.built.solver.nodeSets()[part.number]
        place = np.subtract(now["place"], now["displacement"])
        if now["floats"] != (pivot is None) or not (pivot is None or np.allclose(place, pivot[:2])):
            raise InputError(f"turn: about = {pivot}, must be as the record has begun")

    def _columns(self) -> tuple[str, ...]:
        """All that a name of a column may not be, and that may have a second name."""
        names = (*COLUMNS, *self._recorder.names, "load", "displacement", *self._same)
        return tuple(name for name in dict.fromkeys(names) if name != "initial_energy")

    def _gauge_name(self, name: object) -> str:
        """Name that a new gauge may have, or that of one in a record that has begun."""
        there = [one.name for one in self._recorder.gauges]
        if self._begun and isinstance(name, str) and name in there:
            return name
        taken = (*self._columns(), "initial_energy", "set_point")
        text = require_column("gauge", name, taken)
        if self._begun:
            raise InputError(
                f"gauge = {text!r}, must be one with which the record has begun: {there}"
            )
        return text

    def _add_gauge(self, name: str, gauge: wrapper.Gauge) -> None:
        """Add a gauge, or find it in the record that has begun."""
        self._require_scene(f"gauge {name}")
        recorder = self._recorder
        if not self._begun:
            gauge.name = name
            recorder.addGauge(gauge)
            return
        there = next(one for one in recorder.gauges if one.name == name)
        for trait in ("first", "second", "plate", "nodes", "direction", "length"):
            now, asked = getattr(there, trait), getattr(gauge, trait)
            if now != asked and name not in recorder.lostGauges():
                raise InputError(
                    f"gauge {name}: {trait} = {asked}, must be as the record has begun, {now}"
                )

    def _measures(self) -> tuple[str, ...]:
        own = [name for name in self._recorder.names if name not in COLUMNS]
        return tuple(name for name in own if name not in ("initial_energy", "displacement"))

    def _press(self, pressure: float, ramp: int) -> None:
        if self.pressed is None:
            raise InputError("confine: part = None, must be one of the rig; call press")
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

    def _pressing_engines(self) -> list[wrapper.PressureController]:
        return [one for one in self.built.engines if isinstance(one, wrapper.PressureController)]

    def _pressure_on(self, plate: int) -> float:
        """Pressure that a plate has been given [Pa]."""
        return sum(one.pressure for one in self._pressing_engines() if plate in one.plates)

    def _let_go(self, plates: list[int]) -> None:
        """Take plates from the engines that press them."""
        for engine in self._pressing_engines():
            engine.plates = [plate for plate in engine.plates if plate not in plates]
            if not engine.plates:
                self.built.remove_engines(engine)

    def _pressing_force(self) -> float:
        pressing = self._pressing()
        if self.pressed is None or pressing is None:
            return 0.0
        return pressing.pressure * self.pressed.width * self.built.specimen.thickness

    def _crossing_steps(self) -> float:
        """Steps of a disc of the specimen's area: what is open before it is pressed has none."""
        return self.built.solver.crossingSteps(self.built.specimen.equal_diameter)

    def _begin_record(self) -> None:
        super()._begin_record()
        self._frame.loadingScales = list(astuple(self.scales()))

    def _drive(self, plan: Schedule) -> None:
        self._require_scene("load")
        if self._recorder.loading is None:
            self._require_push(plan.velocity)
        super()._drive(plan)

    def _require_push(self, velocity: float) -> None:
        """Refuse plates that all go away from the specimen, which nothing presses on them."""
        frame, plates = self._frame, self.built.solver.plates()
        if frame.drivenSets:
            return
        way = math.copysign(1.0, velocity) * np.array([frame.direction[0], frame.direction[1]])
        for number in frame.driven:
            plate = plates[number]
            if plate["bonded"] or plate["pressed"] or any(plate["force"]):
                return
            if np.dot(plate["normal"], way) > (-_PUSHES if plate["friction"] else _PUSHES):
                return
        part = Part(self, self.built.solver, "plate", frame.driven[0])
        raise InputError(
            f"load: driven part = {part}, pulls without bond, must push; turn the direction, or "
            "lay it with bonded=True"
        )

    def _take_hold(self) -> wrapper.LoadingController:
        frame = self._frame
        self._let_go(frame.driven)
        loading = wrapper.PlateController(
            plates=frame.driven,
            nodeSets=frame.drivenSets,
            backSets=frame.backSets,
            elasticStart=True,
            ofParts=True,
        )
        if kind_of(self.kind).slides:  # what slides lets go within the time of a wave
            loading.renewPeriod = math.ceil(self.scales().crossing_steps)
        self.built.add_engines(before=(loading,))
        return loading

    def _move(self, velocity: float, factor: float) -> None:
        loading, direction = self._recorder.loading, self._frame.direction
        assert isinstance(loading, wrapper.PlateController)
        speed = -velocity  # a rig that presses gives that of its upper end, upwards
        loading.velocity = (speed * direction[0], speed * direction[1], speed * direction[2])
        loading.velocityFactor = factor

    def _loaded_area(self) -> float:
        return self._frame.area


def _require_along(part: HeldNodes, direction: tuple[float, float, float]) -> None:
    """Refuse nodes that are free along a part of the way on which they are to be driven."""
    for axis, way in zip("xy", direction[:2], strict=True):
        if way != 0.0 and axis not in part.axes:
            raise InputError(
                f"drive: part = {part}, held along {part.axes} alone, must be held along {axis}; "
                "hold them so or turn the direction"
            )
