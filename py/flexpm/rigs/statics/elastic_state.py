# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of a rig of parts, as a state that can be plotted and read. SI units."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from yade import wrapper

from ...arrays import FloatArray
from ...errors import InputError
from ...files import Table
from ...models.grains import Model
from ...require import NOT_NEGATIVE, quoted, require_number
from ...results.snapshot import Snapshot
from ..part_loads import PartLoads
from ..parts import HeldNodes, Part, RigPart, require_part


@dataclass(frozen=True, eq=False)
class ElasticState(Snapshot):
    """Equilibrium of a specimen between parts without further damage.

    It is a snapshot: displacements, stresses and maps work as for any other state. Deviation D72.
    """

    way: float = 0.0  #: of the driven parts along the loading [m, or rad]
    load: float = 0.0  #: of the driven parts on the specimen, along the loading [N, or N m]
    solutions: int = 0  #: linear ones until no point opened or closed any more
    #: Points of open cracks and joints that are closed here, stick, and bear more than friction.
    beyond_friction: int = 0
    rig: object = field(default=None, repr=False)  #: whose parts have the forces
    #: Force and displacement of each, x and y, angle of a seated one, contact angle of a jaw.
    plates: tuple[tuple[float, ...], ...] = ()
    node_sets: tuple[tuple[float, ...], ...] = ()  #: the same, and moment

    @property
    def displacements(self) -> FloatArray:
        """Displacement of each node since it was bonded, (N, 2) [m]."""
        return self.positions - self.reference

    def force(self, part: RigPart) -> tuple[float, float]:
        """Return the force of a part on the specimen, x and y [N]."""
        x, y = self._of(part)[:2]
        return x, y

    def displacement(self, part: RigPart) -> tuple[float, float]:
        """Return the displacement of a part, x and y [m]; of driven nodes only."""
        x, y = self._of(part)[2:4]
        return x, y

    def moment(self, part: HeldNodes) -> float:
        """Return the moment of fixed nodes on the specimen, counter-clockwise [N m].

        It refers to the point about which the nodes rotate, see `HeldNodes`.
        """
        return self._of(require_part("elastic: part", self.rig, part, HeldNodes))[4]

    def angle(self, part: Part) -> float:
        """Return the rotation of a seated part, see `Part.angle` [rad]."""
        return self._of(require_part("elastic: part", self.rig, part, Part))[4]

    def contact_angle(self, jaw: Part) -> float:
        """Return the contact angle of a jaw, about the disc's centre [rad]."""
        return self._of(require_part("elastic: part", self.rig, jaw, Part))[5]

    def _of(self, part: RigPart) -> tuple[float, ...]:
        part = require_part("elastic: part", self.rig, part, RigPart)
        return (self.node_sets if isinstance(part, HeldNodes) else self.plates)[part.number]


def required_loading(displacement: float, load: float | None) -> tuple[float, float | None]:
    """Return displacement [m, or rad] and load [N, or N m] of a static solution.

    Raises:
        InputError: for a value that is not finite, or if both are given.
    """
    displacement = require_number("elastic: displacement", displacement, unit="m")
    if load is None:
        return displacement, None
    load = require_number("elastic: load", load, unit="N")
    if displacement != 0.0:
        raise InputError(
            f"elastic: displacement = {displacement:g}, must be left out if a load is given; give "
            "one of them"
        )
    return displacement, load


def solved(rig: object, built: Model, solve: Callable[[], Table]) -> ElasticState:
    """Return the state that a frame's solution finds, or raise its message in one line."""
    try:
        found = solve()
    except (ValueError, RuntimeError) as error:
        raise InputError(f"elastic: {error}") from None
    arrays = found.pop("snapshot")
    return ElasticState(
        **arrays,
        **built.of_snapshots(arrays["contact"]),
        rig=rig,
        plates=tuple(found.pop("plates")),
        node_sets=tuple(found.pop("node_sets")),
        **found,
    )


class PartStatics(PartLoads):
    """Base of a rig of parts with a static solution."""

    def elastic(
        self,
        pressures: Mapping[Part, float] | None = None,
        *,
        displacement: float = 0.0,
        load: float | None = None,
    ) -> ElasticState:
        """Return the equilibrium of the specimen without further damage: a static solution.

        The solution is linear about the present state, so that displacements must be small compared
        with the grains. Cracks, notches and unbonded plates carry compression only: their points
        open and close until the solution is consistent. Unbonded points in compression stick from
        the position where they close. ``beyond_friction`` counts points that would slide, and the
        few points that would open if they stuck and carry no shear (deviation D72). Damage does not
        change. Gravity and all present pressures act. The scene is not changed.

        Args:
            pressures: Pressure on each part [Pa], in addition to the pressures of `press`; replaces
                the earlier pressure on the same part.
            displacement: Displacement of the driven parts along the loading, from the present state
                [m], or their rotation [rad]. The load for 1.0 is the stiffness if no point opens or
                closes.
            load: Sum of the forces [N] or moments [N m] of the driven parts, instead of a
                displacement.

        Returns:
            A snapshot that also has the forces and displacements of the parts.

        Raises:
            InputError: for an object that is not a part of this rig, or a value out of range. Also
                if the specimen, or a piece of it, is free to move between the parts: the message
                names the motion.
        """
        frame = self._frame
        displacement, load = required_loading(displacement, load)
        if load is not None or displacement != 0.0:
            self._require_driven("elastic:")
        pressed = self._pressed(frame, {} if pressures is None else pressures)
        return solved(
            self,
            self.built,
            lambda: frame.elasticState(list(pressed), list(pressed.values()), displacement, load),
        )

    def _pressed(self, frame: wrapper.PartFrame, pressures: object) -> dict[int, float]:
        """Return the pressure of each pressed plate."""
        if not isinstance(pressures, Mapping):
            raise InputError(
                f"elastic: pressures = {quoted(pressures)}, must be a table of parts and "
                f"pressures; give {{part: pressure}}"
            )
        pressed = {}
        for part, pressure in pressures.items():
            number = require_part("elastic: part under a pressure", self, part, Part).number
            if number in frame.driven:
                raise InputError(
                    f"elastic: pressures: part = {part}, is driven; leave it out of the pressures"
                )
            label = "elastic: pressure on a part"
            pressed[number] = require_number(label, pressure, NOT_NEGATIVE, "Pa")
        return pressed
