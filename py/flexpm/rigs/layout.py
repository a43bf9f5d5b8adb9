# SPDX-License-Identifier: GPL-3.0-or-later
"""Add parts to a specimen, or find the parts of a scene that has been loaded. SI units."""

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
        """Add a plate on the part of the outline around a position.

        Args:
            position: x and y of a point on the outline [m].
            length: Length of the plate along the outline [m]; None: half a mean grain diameter.
            normal: x and y of a direction into the specimen; zero: the normal of the outline there.
            pinned: Prevent sliding along the outline while the support is pressed. False: the
                support is a roller, or slides with `friction`.
            friction: Friction coefficient of a support that is not pinned [-]; 0: a roller.
            bonded: Also transmit tension.
            strip: Stiffness per area of a soft layer between the plate and the grains [Pa/m]: E / h
                for a layer of thickness h. It acts in series with the contact stiffness. None: no
                layer.
            seated: Allow free rotation about the middle of the plate's face, as on a spherical
                seat, so that the plate resists no moment there. The plate starts at the inclination
                of the outline that it covers, measured from the plane normal to `normal` (deviation
                D95). False: the plate does not rotate.

        Returns:
            The plate.

        Raises:
            InputError: for a position that is not on the outline or that another part occupies, or
                a length out of range.
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
        """Add an arc on the rim of a disc: the curved jaw of a splitting test.

        The contact between disc and jaw grows with the load; `contact_angle_of` records its angle.
        A jaw with the radius of the disc touches the disc over its full angle from the start
        (deviation D95).

        Args:
            position: x and y of a point [m], on the rim within 5 % of the disc's radius. The middle
                of the jaw is in the direction of this point from the centre of the disc.
            radius: Radius of the arc [m], at least the radius of the disc; the ISRM suggests 1.5
                times the radius of the disc.
            angle: Angle of the disc that the jaw can cover [rad], at most and by default 2 pi / 3.
                It is required for a jaw with the radius of the disc.
            friction: Friction coefficient [-]. Between two smooth jaws with its own radius, a disc
                is free to rotate, and no loading can begin.
            strip: As for `support` [Pa/m].

        Returns:
            The plate.

        Raises:
            InputError: for a specimen that is not a disc, a position off the rim, a radius below
                the radius of the disc, or an angle that is out of range or missing.
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
        """Fix the nodes of a region; `drive`, `rotate` and `HeldNodes.move` move them.

        Deformable grains are fixed at all nodes in the region. Rigid grains are fixed at their
        centres, about which they are free to rotate (deviation D52). The positions of the bonded
        state count. Give exactly one of `box`, `disc` (2D) or `ball` (3D), and `where`.

        Args:
            box: Two opposite corners [m]; the edges belong to the box.
            disc: x and y of the centre, and the radius, in 2D [m].
            ball: x, y and z of the centre, and the radius, in 3D [m].
            where: Function of the arrays x and y, in 3D also z, with n positions [m]; returns n
                bools: true for a position in the region.
            axes: Fixed axes, for example ``"x"`` or ``"xy"``; None: all axes.

        Returns:
            The set of fixed nodes.

        Raises:
            InputError: for a region without nodes, or with nodes that belong to another part.
        """
        axes = _require_axes(axes, self._axes)
        if (disc if self._axes == SPACE else ball) is not None:
            name, other = ("disc", "ball") if self._axes == SPACE else ("ball", "disc")
            raise InputError(
                f"hold: {name}, must not be given in {len(self._axes)}D; give a {other}"
            )
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
        """Return the result of a kernel call; its error becomes an InputError of this part type."""
        try:
            return call()
        except ValueError as error:
            raise InputError(f"{kind}: {error}") from None

    def _take(self, part: type[RigPart], kind: str, number: int) -> int:
        """Claim a part of a loaded scene, or raise InputError if the scene does not have it."""
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
        """All parts as plain values: plates, then sets of fixed nodes, by index.

        ``position`` is the position at zero displacement [m]: where the part was added, or where it
        was when displacements began to count. ``face`` is a line along a plate, or around fixed
        nodes, in the bonded state [m].
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
    """Return the rectangle around positions [m]; empty for a set whose grains are erased."""
    if len(places) == 0:
        return []
    (left, low), (right, high) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    return [[left, low], [right, low], [right, high], [left, high], [left, low]]


def before(part: Table) -> list[float]:
    """Return the position of a part before it was displaced [m]."""
    found: list[float] = np.subtract(part["place"], part["displacement"]).tolist()
    return found
