# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a rig: plates and sets of nodes. A part belongs to one rig. SI units."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, TypeVar

from yade import wrapper

from ..errors import InputError
from ..files import Table
from ..renamed import with_old_names
from ..require import quoted, require_number
from .places import PLANE, SPACE, Place, require_vector


@with_old_names
@dataclass(frozen=True, eq=False)
class RigPart:
    """A part that a rig has added to its specimen. Its values belong to the last step."""

    _list: ClassVar[str]  # call of the solver that tells of all parts of this class

    rig: object = field(repr=False)  #: whose part it is
    solver: wrapper.GrainSolver = field(repr=False)
    kind: str  #: ``support``, ``platen``, ``jaw`` or ``held nodes``
    number: int  #: among the plates, or among the sets of nodes

    @property
    def force(self) -> tuple[float, ...]:
        """Force on the specimen, x and y, in 3D also z [N]."""
        return self._vector("force")

    @property
    def work(self) -> float:
        """Work done on the specimen up to the last step [J]."""
        return float(self._now["work"])

    @property
    def position(self) -> tuple[float, ...]:
        """Present position of the part, x and y, in 3D also z [m]."""
        return self._vector("place")

    @property
    def displacement(self) -> tuple[float, ...]:
        """Displacement since the part was added, x and y, in 3D also z [m]."""
        return self._vector("displacement")

    def __str__(self) -> str:
        """Type and position of the part."""
        return f"{self.kind} at {in_words(self.position)} m"

    @property
    def _now(self) -> Table:
        found: Table = getattr(self.solver, self._list)()[self.number]
        return found

    @property
    def _is_in_space(self) -> bool:
        return len(self._now["place"]) == len(SPACE)

    def _turn(self, name: str) -> float | tuple[float, ...]:
        return self._vector(name) if self._is_in_space else self._number(name)

    def _vector(self, name: str) -> tuple[float, ...]:
        return tuple(float(one) for one in self._now[name])

    def _number(self, name: str) -> float:
        """Return a property that only 2D parts have, or raise InputError."""
        now = self._now
        if name not in now:
            raise InputError(f"part: {name} of {self}, is available in 2D only; leave it out")
        return float(now[name])


@dataclass(frozen=True, eq=False)
class Part(RigPart):
    """A plate; its load acts at `position`, the area-weighted mean of its contacts."""

    _list = "plates"

    #: Position that was passed to `support` or `jaw`, x, y and in space z [m]; None for a platen.
    requested_position: tuple[float, ...] | None = None

    @property
    def width(self) -> float:
        """Width of the outline that a 2D plate covers [m].

        Raises:
            InputError: in 3D, where a plate has an area.
        """
        return self._number("width")

    @property
    def area(self) -> float:
        """Area of the surface that a plate covers [m2]; 0 for a line."""
        return float(self._now["area"])

    @property
    def normal(self) -> tuple[float, ...]:
        """Unit vector into the specimen."""
        return self._vector("normal")

    @property
    def contact_angle(self) -> float:
        """Contact angle of a jaw, about the disc's centre [rad]; 0 for any other plate."""
        return self._number("contact_angle")

    @property
    def angle(self) -> float | tuple[float, ...]:
        """Rotation of a seated plate, 0 if square to its normal [rad]; signs as in `HeldNodes`."""
        return self._turn("angle")

    @property
    def machine_energy(self) -> float:
        """Energy of the spring between the plate and its crosshead, see `PartRig.drive` [J]."""
        return 0.5 * self._number("machine") * self._number("machine_give") ** 2


@dataclass(frozen=True, eq=False)
class HeldNodes(RigPart):
    """Set of nodes that a rig fixes or moves like a rigid body.

    The set rotates about `position`, by default the mean of the nodes' positions. A rotation is
    counter-clockwise in 2D; in 3D it is a right-handed vector with three components.
    """

    _list = "nodeSets"

    @property
    def moment(self) -> float | tuple[float, ...]:
        """Moment on the specimen about `position` [N m]; in 3D x, y and z."""
        return self._turn("moment")

    @property
    def angle(self) -> float | tuple[float, ...]:
        """Rotation since the nodes were fixed [rad]."""
        return self._turn("angle")

    @property
    def nodes(self) -> list[int]:
        """Indices of the nodes in the solver, see `GrainSolver.nodePlaces`."""
        return [int(node) for node in self._now["nodes"]]

    @property
    def axes(self) -> str:
        """Fixed axes: ``x``, ``y``, ``z`` or several, as ``xy``."""
        return str(self._now["axes"])

    def move(self, velocity: Place | None = None, spin: float | Place = 0.0) -> None:
        """Prescribe the nodes' velocity from the next step on, independently of the loading.

        Args:
            velocity: x and y, in 3D also z, along fixed axes only [m/s; m per step with scaled
                masses]; None: zero.
            spin: Angular velocity about `position` [rad/s; rad per step with scaled masses]; in 3D
                x, y and z.

        Raises:
            InputError: for a velocity along an axis that is not fixed, or for nodes that rotate
                freely.
        """
        axes = SPACE if self._is_in_space else PLANE
        given = (0.0,) * len(axes) if velocity is None else velocity
        x, y, z = require_vector("move: velocity", given, "m/s", axes)
        if not self._is_in_space:
            about = (0.0, 0.0, require_number("move: spin", spin, unit="rad/s"))
        else:
            still = isinstance(spin, int | float) and spin == 0.0
            about = require_vector("move: spin", (0.0, 0.0, 0.0) if still else spin, "rad/s", axes)
        try:
            self.solver.moveNodeSet(self.number, (x, y, z), about)
        except ValueError as error:
            raise InputError(f"move: {error}") from None


Kind = TypeVar("Kind", bound=RigPart)


def in_words(vector: Iterable[float], digits: int = 6) -> str:
    """Return a vector in brackets, with `digits` significant digits of its components."""
    return f"({', '.join(f'{one:.{digits}g}' for one in vector)})"


def require_parts(label: str, rig: object, given: object, kind: type[Kind]) -> list[Kind]:
    """Return parts of a rig as a list, or raise InputError; a single part needs no brackets."""
    if isinstance(given, RigPart):
        given = [given]
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise InputError(
            f"{label} = {quoted(given)}, must be parts of the rig; pass a list of parts"
        )
    return [require_part(label, rig, part, kind) for part in given]


def require_part(label: str, rig: object, part: object, kind: type[Kind]) -> Kind:
    """Return a part of a rig, or raise InputError."""
    if not isinstance(part, RigPart):
        raise InputError(
            f"{label} = {quoted(part)}, must be a part; pass a result of support(), platen() or "
            "hold()"
        )
    if part.rig is not rig:
        raise InputError(
            f"{label} = {part} of another rig, must be a part of this rig; create it with this rig"
        )
    if not isinstance(part, kind):
        wanted = (
            "a set of held nodes, from hold()," if kind is HeldNodes else "a support or a platen"
        )
        raise InputError(f"{label} = {part}, must be {wanted} of this rig")
    return part


def require_apart(label: str, *lists: Sequence[RigPart]) -> None:
    """Raise InputError for a part that occurs twice."""
    seen: list[tuple[type, int]] = []
    for part in (part for parts in lists for part in parts):
        if (type(part), part.number) in seen:
            raise InputError(f"{label} = {part}, is given twice; give it once")
        seen.append((type(part), part.number))


def numbers(parts: Sequence[RigPart], kind: type[RigPart]) -> list[int]:
    """Return the indices of the parts of a type."""
    return [part.number for part in parts if isinstance(part, kind)]
