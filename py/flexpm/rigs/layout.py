# SPDX-License-Identifier: GPL-3.0-or-later
"""How parts come onto a specimen: laid, or found in a scene that is taken up again. SI units."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
import yade
from yade import wrapper

from ..arrays import FloatArray
from ..errors import InputError
from ..files import Table
from ..models.grains import Model
from ..require import (
    NOT_NEGATIVE,
    POSITIVE,
    quoted,
    require_flag,
    require_number,
    require_whole,
)
from ..specimens.kernel_input import Circle
from .parts import HeldNodes, Part, RigPart
from .places import PLANE, SPACE, Jaw, Place, Where, in_region, require_vector

#: Length of a support unless told otherwise, in mean diameters of the grains [-]: a plate does not
#: turn with a beam, which would rest on the inner end of a long one.
_SUPPORT = 0.5
#: Traits of a plate that are told where it has them.
_EXTRA = ("strip", "radius", "machine", "seated")
#: Friction of a part that is pinned: it does not slide as long as it presses [-].
NO_SLIDING = 1e6


Answer = TypeVar("Answer")


class PartLayout:
    """Base of a rig that adds parts to its specimen.

    Attributes:
        built: The specimen and its model.
    """

    built: Model
    _recorder: wrapper.AxialRecorder
    #: Along which places and directions are given.
    _axes = PLANE

    def _begin_layout(self) -> None:
        """Find the parts that the scene already has: the calls of its script return them again."""
        self._solver = self.built.solver
        self._found: dict[type[RigPart], set[int]] = {
            Part: set(range(len(self._solver.plates()))),
            HeldNodes: set(range(len(self._solver.nodeSets()))),
        }

    def support(
        self,
        position: Place,
        length: float | None = None,
        *,
        normal: Place = (0.0, 0.0),
        pinned: bool = False,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Lay a plate against the part of the outline around a place.

        Args:
            position: x and y, on the outline [m].
            length: Along the outline [m]; None for half a mean diameter of the grains.
            normal: x and y, into the specimen; zero: that of the outline there.
            pinned: It does not slide along the outline as long as it presses; else it is a roller.
            friction: Coefficient, of one that is neither [-].
            bonded: It pulls, too.
            strip: Stiffness per area of a soft layer between it and the grains [Pa/m], E / h of one
                of thickness h; it comes in series with that of the contacts. None: no layer.
            seated: It turns freely about the middle of its face, as on a spherical seat, so that it
                bears no moment there (deviation D95); it is laid down on what is before it, as far
                from square to its normal as that is. Else it does not turn.

        Raises:
            InputError: for a place that is not on the outline or that another part has, or a length
                out of range.
        """
        length = _SUPPORT * self.built.specimen.mean_diameter if length is None else length
        friction = require_number("support: friction", friction, NOT_NEGATIVE)
        values = (
            require_vector("support: position", position),
            require_number("support: length", length, POSITIVE, "m"),
            require_vector("support: normal", normal, ""),
            NO_SLIDING if require_flag("support: pinned", pinned) else friction,
            require_flag("support: bonded", bonded),
            strip_of("support", strip),
            require_flag("support: seated", seated),
        )
        solver = self.built.solver
        return self._plate(
            "support",
            lambda: solver.findPatchPlate(*values),
            lambda: solver.addPatchPlate(*values),
            values[0],
        )

    def platen(
        self,
        side: int,
        *,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Add a plate along an entire side of the outline.

        Args:
            side: Index of the side; of a rectangle 0 bottom, 1 right, 2 top, 3 left.
            friction: Friction coefficient [-].
            bonded: Also transmit tension. A bonded plate without friction slides freely along
                itself.
            strip: As for `support` [Pa/m].
            seated: As for `support`.

        Returns:
            The plate.

        Raises:
            InputError: for a side that does not exist, or on which another part is.

        Example:
            >>> rig = flexpm.PartRig(flexpm.build(specimen))
            >>> top = rig.platen(2)
            >>> print(f"width {top.width * 1e3:.0f} mm, normal {top.normal[1]:.0f}")
            width 12 mm, normal -1
        """
        side = require_whole("platen: side", side)
        friction = require_number("platen: friction", friction, NOT_NEGATIVE)
        bonded = require_flag("platen: bonded", bonded)
        layer, turns = strip_of("platen", strip), require_flag("platen: seated", seated)
        solver = self.built.solver
        return self._plate(
            "platen",
            lambda: solver.findSidePlate(side, bonded, friction, layer, turns),
            lambda: solver.addSidePlates(side, 1, bonded, friction, layer, turns)[0],
        )

    def jaw(
        self,
        position: Place,
        radius: float,
        *,
        angle: float | None = None,
        friction: float = 0.0,
        strip: float | None = None,
    ) -> Part:
        """Lay an arc around the rim of a disc: the curved jaw of a splitting test.

        The disc lies against ever more of it as the load grows; `contact_angle_of` records the
        angle. A jaw of the disc's own radius touches all of its angle at once (deviation D95).

        Args:
            position: x and y of the jaw's middle, in whose direction from the disc's centre it lies
                [m].
            radius: Radius of the arc, at least the disc's; 1.5 times that by the ISRM [m].
            angle: Angle of the disc before it [rad], at most 2 pi / 3, which it has by default; one
                of the disc's own radius needs it.
            friction: Coefficient [-]. Between two smooth ones of its own radius a disc is free to
                turn, and no loading of it begins.
            strip: As for `support` [Pa/m].

        Raises:
            InputError: for a specimen that is no disc, a place off its rim by more than 5 % of its
                radius, a radius below the disc's, or an angle out of range or missing.
        """
        centre, rim = self._disc()
        x, y, _ = require_vector("jaw: position", position)
        jaw = Jaw.of((x, y), centre, rim, radius, angle)
        values = (
            (centre[0] + jaw.towards[0], centre[1] + jaw.towards[1], 0.0),
            (*centre, 0.0),
            jaw.radius,
            jaw.angle,
            require_number("jaw: friction", friction, NOT_NEGATIVE),
            strip_of("jaw", strip),
        )
        solver = self.built.solver
        return self._plate(
            "jaw",
            lambda: solver.findJawPlate(*values),
            lambda: solver.addJawPlate(*values),
            (x, y),
        )

    def _disc(self) -> tuple[tuple[float, float], float]:
        """Return centre and radius [m] of the specimen, which must be a disc."""
        outline = self.built.specimen.outline
        if not isinstance(outline, Circle):
            raise InputError("jaw: the specimen is not a disc; use support() for other shapes")
        return (outline.x, outline.y), outline.radius

    def hold(
        self,
        *,
        box: tuple[Place, Place] | None = None,
        disc: tuple[Place, float] | None = None,
        ball: tuple[Place, float] | None = None,
        where: Where | None = None,
        axes: str | None = None,
    ) -> HeldNodes:
        """Hold the nodes of a region at rest; `drive`, `rotate` or `HeldNodes.move` moves them.

        All nodes in the region of deformable grains are held, of rigid ones the centres, about
        which the grains are free to turn (deviation D52). What counts is where they were when
        bonded. The region is one of:

        Args:
            box: Two opposite corners [m]; what lies on its edges is in.
            disc: x and y of the centre, and the radius, in the plane [m].
            ball: x, y and z of the centre, and the radius, in space [m].
            where: Function of the places' x and y, and z in space, arrays [m], that says which ones
                are in.
            axes: Those along which they are held, as ``"x"`` or ``"xy"``; None: all.

        Raises:
            InputError: for a region without nodes, or with nodes that another part has.
        """
        axes = _require_axes(axes, self._axes)
        if (disc if self._axes == SPACE else ball) is not None:
            name, other = ("disc", "ball") if self._axes == SPACE else ("ball", "disc")
            raise InputError(f"hold: {name} = given, must not be given here; give a {other}")
        self._require_scene("hold")
        solver = self.built.solver
        nodes, places = solver.nodePlaces(bonded=True)
        round_one = ball if disc is None else disc
        chosen = nodes[in_region(places, box, round_one, where, self._axes)].tolist()
        if found := self._found[HeldNodes]:
            sets = solver.nodeSets()
            alike = [
                n for n in found if sets[n]["nodes"].tolist() == chosen and sets[n]["axes"] == axes
            ]
            number = self._take(HeldNodes, "hold", alike[0] if alike else -1)
        else:
            number = self._asked(
                "hold", lambda: solver.addNodeSet(chosen, *(axis in axes for axis in self._axes))
            )
        return HeldNodes(self, solver, "held nodes", number)

    def _plate(
        self,
        kind: str,
        find: Callable[[], int],
        lay: Callable[[], int],
        requested: Sequence[float] | None = None,
    ) -> Part:
        """Return a new plate, or the same plate in a scene that was loaded."""
        self._require_scene(kind)
        if self._found[Part]:
            number = self._take(Part, kind, self._asked(kind, find))
        else:
            number = self._asked(kind, lay)
            self.built.set_masses()
        position = None if requested is None else tuple(requested[: len(self._axes)])
        return Part(self, self.built.solver, kind, number, position)

    def _asked(self, kind: str, call: Callable[[], Answer]) -> Answer:
        """What the kernel says to a call, its refusal in the name of the kind."""
        try:
            return call()
        except ValueError as error:
            raise InputError(f"{kind}: {error}") from None

    def _take(self, part: type[RigPart], kind: str, number: int) -> int:
        """Take a part that the scene has had before the rig, unless it is not one of these."""
        found = self._found[part]
        if number not in found:
            solver = self.built.solver
            some = min(found)
            there = part(self, solver, "a plate" if part is Part else "held nodes", some)
            raise InputError(
                f"{kind}: the call places another part than the {len(found)} left in the scene, "
                f"e.g. {there}; repeat the calls with which the scene began, or call O.reset()"
            )
        found.remove(number)
        return number

    @property
    def parts(self) -> list[Table]:
        """All parts as plain values: plates, then held nodes by their numbers.

        A place is that where the part was laid, or since when displacements count [m]; a face is a
        line along a plate, or around held nodes, when bonded [m].
        """
        solver = self.built.solver
        plates = [
            {
                "part": "plate",
                **{name: one[name] for name in ("normal", "width", "friction", "bonded")},
                **{name: one[name] for name in _EXTRA if one[name]},
                "position": before(one),
                "face": _face_of(one),
            }
            for one in solver.plates()
        ]
        numbers, places = solver.nodePlaces(bonded=True)
        sets = [
            {
                "part": "held nodes",
                "nodes": [int(node) for node in one["nodes"]],
                "axes": one["axes"],
                "position": before(one),
                "face": _box_around(places[np.isin(numbers, one["nodes"])]),
            }
            for one in solver.nodeSets()
        ]
        return [*plates, *sets]

    @property
    def _begun(self) -> bool:
        """Whether the record has begun, here or in the scene that was loaded."""
        return self.built.engine(wrapper.AxialRecorder) is not None

    def _require_scene(self, what: str) -> None:
        """Raise an error unless the scene is the scene of the rig."""
        if self.built.solver is not self._solver or self._solver not in yade.O.engines:
            raise InputError(
                f"{what}: the scene is not the scene of the rig; make a new rig after O.reset() or "
                "O.load()"
            )


def _require_axes(axes: object, there: str) -> str:
    """Return the fixed axes in their order, or raise InputError; None: all axes."""
    if axes is None:
        return there
    if isinstance(axes, str) and axes and axes == "".join(one for one in there if one in axes):
        return axes
    rule = "x, y or xy" if there == PLANE else f"some of {there}, in this order"
    raise InputError(f"hold: axes = {quoted(axes)}, must be {rule}; correct them")


def strip_of(label: str, strip: float | None) -> float:
    """Return the stiffness per area of a soft layer [Pa/m]; 0: no layer."""
    return 0.0 if strip is None else require_number(f"{label}: strip", strip, POSITIVE, "Pa/m")


def _face_of(plate: Table) -> list[list[float]]:
    """Return the line along a plate, or the arc of a jaw, when bonded [m]."""
    inwards, radius, half = np.array(plate["normal"]), plate["radius"], 0.5 * plate["width"]
    along = np.array([inwards[1], -inwards[0]])
    at = half * np.linspace(-1.0, 1.0, 25 if radius else 2)
    rise = radius - np.sqrt(np.maximum(radius**2 - at**2, 0.0))
    # an arc is laid with its middle on the rim, beyond the mean of the points that face it
    middle = before(plate) if radius else plate["middle"]
    line: list[list[float]] = (middle + at[:, None] * along + rise[:, None] * inwards).tolist()
    return line


def _box_around(places: FloatArray) -> list[list[float]]:
    """Line around places [m]; none of a set whose grains are erased."""
    if len(places) == 0:
        return []
    (left, low), (right, high) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    return [[left, low], [right, low], [right, high], [left, high], [left, low]]


def before(part: Table) -> list[float]:
    """Return the position of a part before it was displaced [m]."""
    found: list[float] = np.subtract(part["place"], part["displacement"]).tolist()
    return found
