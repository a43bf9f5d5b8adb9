# SPDX-License-Identifier: GPL-3.0-or-later
"""A rig of parts: supports, rollers, platens, held nodes and gauges, where a test wants them. SI.

A part is a rigid plate against a part of the outline, of deformable and of rigid grains alike, or a
set of nodes. A plate does not turn; it presses, pulls too if it is bonded, and resists sliding
within its friction. Nodes are held, moved or turned as one, wherever they lie.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass

import numpy as np
from yade import wrapper

from ..arrays import BoolArray, FloatArray
from ..errors import InputError, SimulationError
from ..files import Table
from ..models.grains import Model
from ..require import POSITIVE, require_number
from ..results import doubts, measures
from ..results.record import COLUMNS, Curve
from .grain_rig import GrainRig
from .loading_rate import Scales, rate_constant
from .runner import Runner

#: Length of a support unless told otherwise, in mean diameters of the grains [-]: a plate does not
#: turn with a beam, which would rest on the inner end of a long one.
_SUPPORT = 0.5
#: Friction of a part that is pinned: it does not slide as long as it presses [-].
_NO_SLIDING = 1e6

#: Part of a pressing force that the other parts may fail to bear while a specimen swings, before
#: it has come to rest [-].
_SHORT = 0.5

_Place = Sequence[float]
#: Tells of places, by arrays of their x and y [m], which of them a region has.
_Where = Callable[[FloatArray, FloatArray], BoolArray]


@dataclass(frozen=True)
class Part:
    """A plate of a rig. What it says is of the last step."""

    solver: wrapper.GrainSolver
    number: int  #: of the plate

    @property
    def force(self) -> tuple[float, float]:
        """On the specimen, x and y [N]."""
        return _pair(self._now["force"])

    @property
    def work(self) -> float:
        """Done on the specimen so far [J]."""
        return float(self._now["work"])

    @property
    def place(self) -> tuple[float, float]:
        """Of a point of its face, x and y [m]."""
        return _pair(self._now["place"])

    @property
    def displacement(self) -> tuple[float, float]:
        """Since it was laid, x and y [m]."""
        return _pair(self._now["displacement"])

    @property
    def width(self) -> float:
        """Of the outline before it [m]."""
        return float(self._now["width"])

    @property
    def _now(self) -> Table:
        return self.solver.plates()[self.number]


@dataclass(frozen=True)
class HeldNodes:
    """Nodes that a rig holds or moves as one. What it says is of the last step."""

    solver: wrapper.GrainSolver
    number: int  #: of the set

    @property
    def force(self) -> tuple[float, float]:
        """On the specimen, x and y [N]."""
        return _pair(self._now["force"])

    @property
    def moment(self) -> float:
        """On the specimen about `place`, counter-clockwise [N m]."""
        return float(self._now["moment"])

    @property
    def work(self) -> float:
        """Done on the specimen so far [J]."""
        return float(self._now["work"])

    @property
    def place(self) -> tuple[float, float]:
        """About which they turn, x and y [m]: the mean of their places, unless told otherwise."""
        return _pair(self._now["place"])

    @property
    def displacement(self) -> tuple[float, float]:
        """Of that place since they were held, x and y [m]."""
        return _pair(self._now["displacement"])

    @property
    def angle(self) -> float:
        """Since they were held, counter-clockwise [rad]."""
        return float(self._now["angle"])

    @property
    def nodes(self) -> list[int]:
        """Of the solver, see `GrainSolver.nodePlaces`."""
        return [int(node) for node in self._now["nodes"]]

    def move(self, velocity: _Place = (0.0, 0.0), spin: float = 0.0) -> None:
        """Move them from the next step on, whatever the rig's loading does.

        Args:
            velocity: x and y [m/s, or m per step with scaled masses].
            spin: About `place`, counter-clockwise [rad/s, or rad per step].
        """
        x, y = velocity
        try:
            self.solver.moveNodeSet(self.number, (float(x), float(y), float(spin)))
        except ValueError as error:
            raise InputError(f"move: {error}") from None

    @property
    def _now(self) -> Table:
        return self.solver.nodeSets()[self.number]


class PartRig(GrainRig):
    """A specimen of any outline between parts.

    Lay parts with `support` and `platen`, hold nodes with `hold`, read with `gauge` and `way_of`,
    say with `drive` or `turn` which parts load, and then `load` or `strain_to`. In a run that is
    taken up from a checkpoint the same calls find what they have laid before.
    """

    def __init__(self, built: Model, *, kind: str = "own", runner: Runner | None = None) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: The specimen.
            kind: Name of the test, whose loading rate is taken.
            runner: Steps, shows progress and saves checkpoints; None for one that only steps.

        Raises:
            InputError: for a test that is not one of the model's; ``"own"`` is one of deformable
                and of rigid grains.
        """
        rate_constant(kind, built.name)
        super().__init__(built, runner=runner)
        self.disc = False
        self._kind, self._laid, self._held = kind, 0, 0
        self._scales: Scales | None = None
        self._same: dict[str, str] = {}
        #: What ``confine`` presses on.
        self.pressed: Part | None = None
        self._there = built.engine(wrapper.AxialRecorder) is not None

    @property
    def kind(self) -> str:
        """Name of the test."""
        return self._kind

    def support(
        self,
        place: _Place,
        length: float | None = None,
        *,
        normal: _Place = (0.0, 0.0),
        pinned: bool = False,
        friction: float = 0.0,
        bonded: bool = False,
    ) -> Part:
        """Lay a plate against the part of the outline around a place.

        Args:
            place: x and y, on the outline [m].
            length: Along the outline [m]; None for half a mean diameter of the grains.
            normal: x and y, into the specimen; zero: that of the outline there.
            pinned: It does not slide along the outline as long as it presses; else it is a roller.
            friction: Coefficient, of one that is neither [-].
            bonded: It pulls, too.

        Raises:
            InputError: for a place that is not on the outline, or a length out of range.
        """
        length = _SUPPORT * self.built.specimen.mean_diameter if length is None else length
        length = require_number("support: length", length, POSITIVE, "m")
        friction = _NO_SLIDING if pinned else friction
        try:
            return self._part(
                lambda: self.built.solver.addPatchPlate(
                    _vector(place), length, _vector(normal), friction, bonded
                )
            )
        except ValueError as error:
            raise InputError(f"support: {error}") from None

    def platen(self, side: int, *, friction: float = 0.0, bonded: bool = False) -> Part:
        """Lay a plate along a whole side of the outline.

        Args:
            side: Number of the side; of a rectangle 0 bottom, 1 right, 2 top, 3 left.
            friction: Coefficient [-].
            bonded: It pulls, too.
        """
        try:
            return self._part(
                lambda: self.built.solver.addSidePlates(side, bonded=bonded, friction=friction)[0]
            )
        except ValueError as error:
            raise InputError(f"platen: {error}") from None

    def hold(
        self,
        *,
        box: tuple[_Place, _Place] | None = None,
        disc: tuple[_Place, float] | None = None,
        where: _Where | None = None,
        axes: str = "xy",
    ) -> HeldNodes:
        """Hold the nodes of a region at rest; `drive`, `turn` or `HeldNodes.move` moves them.

        Of deformable grains all nodes in the region are held, of rigid ones the centres, about
        which the grains are free to turn (deviation D52). The region is one of:

        Args:
            box: Two opposite corners, x and y of each [m]; what lies on its edges is in.
            disc: x and y of the centre, and the radius [m].
            where: Function of the places' x and y, arrays [m], that says which ones are in.
            axes: ``"x"``, ``"y"`` or ``"xy"``: what is held.

        Raises:
            InputError: for a region without nodes, or with nodes that another part has.
        """
        if axes not in ("x", "y", "xy"):
            raise InputError(f"hold: axes = {axes!r}, must be x, y or xy")
        number, self._held = self._held, self._held + 1
        if number >= len(self.built.solver.nodeSets()):
            nodes, places = self.built.solver.nodePlaces()
            chosen = nodes[_in_region(places, box, disc, where)]
            try:
                self.built.solver.addNodeSet(chosen.tolist(), "x" in axes, "y" in axes)
            except ValueError as error:
                raise InputError(f"hold: {error}") from None
        return HeldNodes(self.built.solver, number)

    def gauge(
        self,
        name: str,
        first: _Place,
        second: _Place,
        *,
        along: _Place | None = None,
        strain: bool = False,
    ) -> None:
        """Record how far two points move apart, in a column of this name.

        Args:
            name: Of the column.
            first: x and y of a point; the nearest node of the grains on its side is taken [m].
            second: The other one.
            along: x and y of the direction in which the second one moves away from the first one;
                None for that from the first to the second place.
            strain: Record the strain between them [-] instead of the opening [m].
        """
        if self._has(name):
            return
        try:
            one, other, length = self.built.solver.gaugePoints(_vector(first), _vector(second))
        except ValueError as error:
            raise InputError(f"gauge {name}: {error}") from None
        if strain and not length > 0.0:
            raise InputError(
                f"gauge {name}: length = 0 m, must be above 0; take points further off"
            )
        direction = _unit(f"gauge {name}", along or (second[0] - first[0], second[1] - first[1]))
        base = length if strain else 0.0
        self._recorder.addGauge(
            wrapper.Gauge(name=name, first=one, second=other, direction=direction, length=base)
        )

    def way_of(self, name: str, part: Part | HeldNodes, direction: _Place) -> None:
        """Record how far a part moves along a direction [m], in a column of this name.

        Of held nodes it is the mean.
        """
        if self._has(name):
            return
        unit = _unit(name, direction)
        gauge = wrapper.Gauge(name=name, direction=unit)
        if isinstance(part, Part):
            gauge.plate = part.number
        else:
            gauge.nodes = part.nodes
        self._recorder.addGauge(gauge)

    def also(self, name: str, column: str) -> None:
        """Give a column of the record a second name, which the test is known by."""
        if name in (*COLUMNS, *self._recorder.names, *self._same):
            raise InputError(f"also = {name!r}, must not be the name of another column")
        self._same[name] = column

    def drive(
        self,
        parts: Sequence[Part | HeldNodes],
        direction: _Place,
        *,
        against: Sequence[Part | HeldNodes] = (),
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
    ) -> None:
        """Say which parts load the specimen, and what its stress and strain are.

        The record has the columns ``load`` and ``displacement`` of these parts. Its stress is the
        load over `area`, its strain the displacement over `length`: with the defaults they are the
        load and the displacement themselves.

        Args:
            parts: They move alike.
            direction: x and y of the loading.
            against: Parts that hold the specimen against the load: the load is then the mean of
                both sides', and their difference is recorded.
            area: Load over stress [m2].
            length: Displacement over strain [m].
            strength: Stress that the specimen will bear, roughly [Pa], which sets the loading rate;
                0: twice that at which the first contact point softens.
        """
        unit = _unit("drive", direction)
        if self._there:
            return
        recorder = self._recorder
        recorder.driven, recorder.drivenSets = _numbers(parts)
        recorder.holding, recorder.holdingSets = _numbers(against)
        recorder.direction = unit
        recorder.area, recorder.length, recorder.strength = area, length, strength

    def turn(
        self,
        parts: Sequence[HeldNodes],
        back: Sequence[HeldNodes] = (),
        *,
        about: _Place | None = None,
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
        """
        for part in (*parts, *back):
            if not isinstance(part, HeldNodes):
                raise InputError("turn: part = a plate, must be held nodes; call hold")
        if self._there:
            return
        recorder = self._recorder
        for part in (*parts, *back):
            self.built.solver.turnNodeSet(part.number, None if about is None else _vector(about))
        recorder.drivenSets = [part.number for part in parts]
        recorder.backSets = [part.number for part in back]
        recorder.direction = (0.0, 0.0, 1.0)
        recorder.area, recorder.length, recorder.strength = area, length, strength

    def scales(self) -> Scales:
        """What the loading rate follows from: the elastic solution of the specimen before it.

        They are those that the first loading has found, whatever has broken since.
        """
        if self._scales is None:
            kept = self._recorder.loadingScales
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

    def to_yade_plot(self) -> None:
        """Give ``yade.plot`` the record so far, each column under its name; call it again later."""
        from yade import plot  # takes long to load

        record = self.record
        plot.data.update({name: record[name].tolist() for name in record.columns})

    @property
    def warnings(self) -> list[str]:
        """What makes the record doubtful.

        Load and reactions that differ, a bad energy balance, a joint that bends, a load that grew
        fast up to a peak.
        """
        record = self.record
        error = measures.energy_error(record, self.initial_energy)
        bend = self.built.joint_bend
        growth = measures.growth_before_peak(record, self.scales().crossing_steps)
        return [
            *([doubts.of_bend(bend)] if bend else []),
            *doubts.of_result("", error, measures.median_end_mismatch(record), None),
            *doubts.of_growth(growth),
        ]

    @property
    def may_fail_at_once(self) -> bool:
        """A test of one's own may have few contacts across; a notch alone is no weak plane."""
        if self.kind == "own":
            return True
        there = self.built.specimen.spec.joint_names or ()
        return any(not one.open for one in self.built.material.joints if one.name in there)

    @property
    def confinement(self) -> float | None:
        """None: what presses on a part is no confinement of the record."""
        return None

    def press(self, part: Part, pressure: float) -> None:
        """Let a part move along its normal under a pressure [Pa] until the forces balance.

        It goes on to press. Displacements and gauges count from there on.
        """
        self.pressed = part
        self.confine(pressure)

    def confine(self, pressure: float) -> None:
        """Press on the part ``pressed`` until the forces balance, see `press`.

        Args:
            pressure: On the width of the part [Pa].

        Raises:
            SimulationError: if no part is named, or if the forces do not come to balance.
        """
        super().confine(pressure)
        self._scales = None  # joints that are closed now bear what they did not bear before

    def _part(self, lay: Callable[[], int]) -> Part:
        """The next plate: laid now, or found in the scene of a checkpoint."""
        number, self._laid = self._laid, self._laid + 1
        if number >= len(self.built.solver.plates()):
            lay()
            self.built.set_masses()
        return Part(self.built.solver, number)

    def _has(self, name: str) -> bool:
        taken = (*COLUMNS, "initial_energy", "load", "displacement")
        if name in taken or (name in self._recorder.names and not self._there):
            raise InputError(f"gauge = {name!r}, must not be the name of another column")
        return self._there

    def _measures(self) -> tuple[str, ...]:
        own = [name for name in self._recorder.names if name not in COLUMNS]
        return tuple(name for name in own if name not in ("initial_energy", "displacement"))

    def _pressing(self) -> wrapper.PlateController | None:
        plates = self.built.engine(wrapper.PlateController)
        return plates if plates and plates.loaded else None

    def _press(self, pressure: float, ramp: int) -> None:
        if self.pressed is None:
            raise SimulationError("confine: part = None, must be one of the rig; call press")
        engine = wrapper.PlateController(
            plates=[self.pressed.number], loaded=True, pressure=pressure, rampSteps=ramp
        )
        self.built.add_engines(before=(engine,))

    def _require_rest(self) -> None:
        """Refuse it, too, where the other parts do not bear what presses: all has fallen apart."""
        super()._require_rest()
        assert self.pressed is not None
        solver = self.built.solver
        if math.hypot(solver.gravity[0], solver.gravity[1]) > 0.0:
            return  # they bear the weight, too
        parts = [part["force"][:2] for part in (*solver.plates(), *solver.nodeSets())]
        pressing, missing = math.hypot(*self.pressed.force), math.hypot(*np.sum(parts, axis=0))
        if not missing <= _SHORT * pressing:
            raise SimulationError(
                f"confine: force on the other parts = {missing:.3g} N short of the "
                f"{pressing:.3g} N that press, must be within {_SHORT:.0%}; lower the pressure"
            )

    def _crossing_steps(self) -> float:
        """Of a disc of the specimen's area: what is open before it is pressed has no scales."""
        of_disc = wrapper.AxialRecorder(diameter=self.built.specimen.equal_diameter)
        return float(of_disc.scales()["crossing_steps"])

    def _begin_record(self) -> None:
        super()._begin_record()
        self._recorder.loadingScales = astuple(self.scales())

    def _take_hold(self) -> wrapper.LoadingController:
        loading = wrapper.PlateController(
            plates=self._recorder.driven,
            nodeSets=self._recorder.drivenSets,
            backSets=self._recorder.backSets,
            elasticStart=True,
            ofParts=True,
        )
        if self.kind == "shear":  # what slides lets go within the time of a wave
            loading.renewPeriod = math.ceil(self.scales().crossing_steps)
        self.built.add_engines(before=(loading,))
        return loading

    def _move(self, velocity: float, factor: float) -> None:
        loading, direction = self._recorder.loading, self._recorder.direction
        assert isinstance(loading, wrapper.PlateController)
        speed = -velocity  # a rig that presses gives that of its upper end, upwards
        loading.velocity = (speed * direction[0], speed * direction[1], speed * direction[2])
        loading.velocityFactor = factor

    def _loaded_area(self) -> float:
        return float(self._recorder.area)


def _numbers(parts: Sequence[Part | HeldNodes]) -> tuple[list[int], list[int]]:
    """Of plates, and of node sets."""
    plates = [part.number for part in parts if isinstance(part, Part)]
    return plates, [part.number for part in parts if isinstance(part, HeldNodes)]


def _in_region(
    places: FloatArray,
    box: tuple[_Place, _Place] | None,
    disc: tuple[_Place, float] | None,
    where: _Where | None,
) -> BoolArray:
    """Which of the places, (n, 2), lie in the one region that is given."""
    if sum(region is not None for region in (box, disc, where)) != 1:
        raise InputError("hold: region = none or several, must be one of box, disc and where")
    if box is not None:
        corners = np.array(box, dtype=float)
        low, high = corners.min(axis=0), corners.max(axis=0)
        found: BoolArray = np.all((places >= low) & (places <= high), axis=1)
    elif disc is not None:
        centre, radius = disc
        radius = require_number("hold: radius of the disc", radius, POSITIVE, "m")
        found = np.hypot(*(places - np.asarray(centre, dtype=float)).T) <= radius
    else:
        assert where is not None
        found = np.asarray(where(places[:, 0], places[:, 1]))
        if found.shape != places.shape[:1] or found.dtype != bool:
            raise InputError("hold: where = another array, must be one truth for each place")
    return found


def _pair(vector: Sequence[float]) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])


def _unit(what: str, direction: _Place) -> tuple[float, float, float]:
    size = math.hypot(*direction)
    require_number(f"{what}: length of its direction", size, POSITIVE)
    return direction[0] / size, direction[1] / size, 0.0


def _vector(place: _Place) -> tuple[float, float, float]:
    x, y = place
    return float(x), float(y), 0.0
