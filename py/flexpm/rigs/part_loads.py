# SPDX-License-Identifier: GPL-3.0-or-later
"""Selection of the parts that load the specimen, and definition of load and strain. SI units."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence

import numpy as np
from yade import wrapper

from ..errors import InputError
from ..files import Table
from ..require import NOT_NEGATIVE, POSITIVE, require_number
from .layout import PartLayout
from .parts import HeldNodes, Part, RigPart, in_words, numbers, require_apart, require_parts
from .places import SPACE, Place, Vector, require_direction, require_vector

#: Cosines of directions that differ by less than this from 1 are along each other [-].
_ALONG = 1e-6


class PartLoads(PartLayout):
    """Base of a rig of parts that selects driven parts and reacting parts."""

    def drive(
        self,
        parts: RigPart | Sequence[RigPart],
        direction: Place,
        *,
        against: RigPart | Sequence[RigPart] = (),
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
        machine: float | None = None,
    ) -> None:
        """Select the driven parts, and define the stress and the strain of the specimen.

        The record has the columns ``load`` and ``displacement`` of the driven parts. Its stress is
        load / `area`, and its strain is displacement / `length`. With the defaults, stress and
        strain are equal to the load and the displacement. If a part is under a pressure of `press`,
        the pressure ends, and the loading continues from the present force of the part.

        Args:
            parts: Driven parts, which all move with the same velocity.
            direction: Direction of the loading, x and y, in 3D also z.
            against: Parts that carry the reaction. The load is then the mean of both sides, and the
                difference of both sides is recorded.
            area: Ratio of load to stress [m2].
            length: Ratio of displacement to strain [m].
            strength: Approximate strength of the specimen [Pa], which sets the loading rate; 0:
                twice the stress at which the first contact point softens.
            machine: Stiffness of a soft machine [N/m]; None: the plate itself is driven. The
                machine is a spring between the single driven plate, which moves along its normal,
                and a crosshead. The loading moves the crosshead instead of the plate (deviation
                D95). The record also gets two columns: ``crosshead_displacement``, along the
                loading [m], and ``machine_energy``, the energy stored in the spring [J]. All other
                energies of the record belong to the specimen.

        Raises:
            InputError: for an object that is not a part of this rig, a part that occurs twice,
                nodes that are not fixed along the direction, or a size out of range. If the scene
                has a record that has begun, also for arguments that differ from the first call.
        """
        unit = require_direction("drive", direction, self._axes)
        moved = require_parts("drive: part", self, parts, RigPart)
        held = require_parts("drive: part against", self, against, RigPart)
        if not moved:
            raise InputError("drive: parts = none, must be >= 1; pass a part of the rig")
        require_apart("drive: part", moved, held)
        for part in moved:
            if isinstance(part, HeldNodes):
                _require_along(part, unit)
        self._require_fixed("drive")
        soft = None if machine is None else _require_soft(moved, unit, machine)
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
        self._soften(moved, unit, soft)

    def rotate(
        self,
        parts: HeldNodes | Sequence[HeldNodes],
        back: HeldNodes | Sequence[HeldNodes] = (),
        *,
        about: Place | None = None,
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
    ) -> None:
        """Load the specimen by rotating fixed nodes, each set like a rigid body.

        The column ``load`` of the record is the sum of the moments of all sets [N m], and
        ``displacement`` is the rotation of each set [rad]. Stress and strain are load / `area` and
        displacement / `length`, as with `drive`.

        Args:
            parts: Sets that rotate counter-clockwise.
            back: Sets that rotate clockwise by the same angle.
            about: x and y of the point about which all sets rotate [m]. None: each set rotates
                about the mean of its positions and is free to translate, so that only a moment acts
                (deviation D53).
            area: Ratio of load to stress [N m / Pa].
            length: Ratio of rotation to strain [-].
            strength: As for `drive` [Pa].

        Raises:
            InputError: as `drive`.
        """
        sizes = {"area": area, "length": length, "strength": strength}
        self._turn((parts, back), about, (0.0, 0.0, 1.0), sizes)

    def _turn(
        self,
        parts: tuple[HeldNodes | Sequence[HeldNodes], HeldNodes | Sequence[HeldNodes]],
        about: Place | None,
        axis: Vector,
        sizes: Mapping[str, float],
    ) -> None:
        """Rotate sets about an axis, the second sets in the opposite sense."""
        sets = require_parts("rotate: part", self, parts[0], HeldNodes)
        others = require_parts("rotate: part back", self, parts[1], HeldNodes)
        if not sets:
            raise InputError(
                "rotate: parts = none, must be at least 1; pass a set of nodes that hold() returned"
            )
        require_apart("rotate: part", sets, others)
        pivot = None if about is None else require_vector("rotate: about", about, axes=self._axes)
        self._require_fixed("rotate", () if about is not None else (*sets, *others))
        self._load_by(
            "rotate",
            driven=[],
            drivenSets=numbers(sets, HeldNodes),
            backSets=numbers(others, HeldNodes),
            holding=[],
            holdingSets=[],
            direction=axis,
            area=require_number("rotate: area", sizes["area"], POSITIVE, "N m/Pa"),
            length=require_number("rotate: length", sizes["length"], POSITIVE),
            strength=require_number("rotate: strength", sizes["strength"], NOT_NEGATIVE, "Pa"),
        )
        for part in (*sets, *others):
            self._turn_about(part, pivot)

    @property
    def drives(self) -> Table:
        """Driven and reacting parts by index, and the definition of stress and strain."""
        frame = self._frame
        return {
            "driven": {"plates": frame.driven, "held nodes": frame.drivenSets},
            "turned back": {"held nodes": frame.backSets},
            "against": {"plates": frame.holding, "held nodes": frame.holdingSets},
            "direction": [frame.direction[axis] for axis in range(3)],
            "area": frame.area,
            "length": frame.length,
            "strength": frame.strength,
            **({"machine": self.machine} if self.machine else {}),
        }

    @property
    def _turns(self) -> bool:
        """Whether parts are rotated, so that the load is a moment."""
        return self._frame.direction[2] != 0.0

    @property
    def machine(self) -> float:
        """Stiffness of the machine behind the driven plate [N/m]; 0: rigid."""
        plates = self.built.solver.plates()
        return max((float(plates[n]["machine"]) for n in self._frame.driven), default=0.0)

    def _soften(
        self, moved: Sequence[RigPart], unit: tuple[float, float, float], soft: float | None
    ) -> None:
        """Add the machine's spring behind the driven part, or find the spring of a loaded scene."""
        plates = self.built.solver.plates()
        behind = [n for n, one in enumerate(plates) if one["machine"]]
        if set(behind) - set(numbers(moved, Part)):
            raise InputError(
                "drive: the machine is behind a plate that does not load; make a new rig"
            )
        there = self.machine
        lays = there == 0.0 and soft is not None and not self._begun
        if not lays and there != (soft or 0.0):
            raise InputError(
                f"drive: machine = {soft}, must be as given before, {there or None}; make a new rig"
            )
        if soft is None:
            return
        try:
            if lays:
                self.built.solver.setMachine(moved[0].number, soft)
        except ValueError as error:
            raise InputError(f"drive: {error}") from None
        self._watch_machine(moved[0].number, unit)

    @abstractmethod
    def _watch_machine(self, plate: int, unit: tuple[float, float, float]) -> None:
        """Add the columns of a machine to the record."""

    def _new_frame(self) -> wrapper.PartFrame:
        return wrapper.PartFrame()

    @property
    def _frame(self) -> wrapper.PartFrame:
        """Frame from which the record takes reacting parts, driven parts and the direction."""
        frame = self._recorder.frame
        if not isinstance(frame, wrapper.PartFrame):
            raise InputError(
                f"part rig: frame of the scene's record = {type(frame).__name__}, must be a "
                "PartFrame; build the specimen again"
            )
        return frame

    def _load_by(self, call: str, **asked: object) -> None:
        """Set the load in the record's frame, or compare it with the first load of the record."""
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

    def _require_driven(self, stage: str) -> None:
        """Raise InputError with `stage` as its first word unless a part is driven."""
        if not (self._frame.driven or self._frame.drivenSets):
            raise InputError(
                f"{stage} driven parts = none, must be at least 1; call drive or rotate"
            )

    def _require_fixed(self, call: str, free: Sequence[RigPart] = ()) -> None:
        """Reject other loads while a rotating set is free to translate: it fixes nothing then."""
        sets = self.built.solver.nodeSets()
        floating = {number for number, one in enumerate(sets) if one["floats"]}
        if not self._begun and floating - {part.number for part in free}:
            raise InputError(
                f"{call}: other parts are loaded after rotate, which is not possible while a "
                "rotating set is free to translate; make a new rig"
            )

    def _turn_about(self, part: HeldNodes, pivot: tuple[float, float, float] | None) -> None:
        if not self._begun:
            self.built.solver.turnNodeSet(part.number, pivot)
            return
        now = self.built.solver.nodeSets()[part.number]
        place = np.subtract(now["place"], now["displacement"])
        apart = pivot is not None and not np.allclose(place, pivot[: len(place)])
        if apart or now["floats"] != (pivot is None):
            raise InputError(
                f"rotate: about = {pivot}, must be as the record has begun; repeat the first call, "
                "or make a new rig"
            )


def _require_soft(
    moved: Sequence[RigPart], unit: tuple[float, float, float], machine: float
) -> float:
    """Return the stiffness of a machine [N/m], which must move one plate along its normal."""
    stiffness = require_number("drive: machine", machine, POSITIVE, "N/m")
    if len(moved) != 1 or not isinstance(moved[0], Part):
        raise InputError("drive: a machine needs exactly one driven plate; drive one plate")
    normal = moved[0].normal
    way = unit[: len(normal)]
    if abs(abs(np.dot(normal, way)) - 1.0) > _ALONG:
        raise InputError(
            f"drive: machine: direction = {in_words(way)}, must be along the normal of "
            f"the {moved[0]}, {in_words(normal)}"
        )
    return stiffness


def _require_along(part: HeldNodes, direction: tuple[float, float, float]) -> None:
    """Reject nodes that are free along a component of the direction of the load."""
    for axis, way in zip(SPACE, direction, strict=True):  # z of the plane is 0
        if way != 0.0 and axis not in part.axes:
            raise InputError(
                f"drive: part = {part}, fixed only along {part.axes}, must be fixed along {axis}; "
                f"pass {axis} to hold, or change the direction"
            )
