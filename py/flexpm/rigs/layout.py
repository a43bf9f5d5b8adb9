# SPDX-License-Identifier: GPL-3.0-or-later
"""How parts come onto a specimen: laid, or found in a scene that is taken up again. SI units."""

from __future__ import annotations

from collections.abc import Callable

import yade
from yade import wrapper

from ..errors import InputError
from ..models.grains import Model
from ..require import (
    NOT_NEGATIVE,
    POSITIVE,
    quoted,
    require_flag,
    require_number,
    require_whole,
)
from .parts import HeldNodes, Part, RigPart
from .places import Place, Where, in_region, require_vector

#: Length of a support unless told otherwise, in mean diameters of the grains [-]: a plate does not
#: turn with a beam, which would rest on the inner end of a long one.
_SUPPORT = 0.5
#: Friction of a part that is pinned: it does not slide as long as it presses [-].
_NO_SLIDING = 1e6


class PartLayout:
    """Base of a rig that lays parts on its specimen.

    Attributes:
        built: The specimen and its model.
    """

    built: Model
    _recorder: wrapper.AxialRecorder

    def _begin_layout(self) -> None:
        """See which parts the scene has already: the calls of its script find them again."""
        self._solver = self.built.solver
        self._found: dict[type[RigPart], set[int]] = {
            Part: set(range(len(self._solver.plates()))),
            HeldNodes: set(range(len(self._solver.nodeSets()))),
        }

    def support(
        self,
        place: Place,
        length: float | None = None,
        *,
        normal: Place = (0.0, 0.0),
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
            InputError: for a place that is not on the outline or that another part has, or a length
                out of range.
        """
        length = _SUPPORT * self.built.specimen.mean_diameter if length is None else length
        friction = require_number("support: friction", friction, NOT_NEGATIVE)
        values = (
            require_vector("support: place", place),
            require_number("support: length", length, POSITIVE, "m"),
            require_vector("support: normal", normal, ""),
            _NO_SLIDING if require_flag("support: pinned", pinned) else friction,
            require_flag("support: bonded", bonded),
        )
        solver = self.built.solver
        return self._plate(
            "support",
            lambda: solver.findPatchPlate(*values),
            lambda: solver.addPatchPlate(*values),
        )

    def platen(self, side: int, *, friction: float = 0.0, bonded: bool = False) -> Part:
        """Lay a plate along a whole side of the outline.

        Args:
            side: Number of the side; of a rectangle 0 bottom, 1 right, 2 top, 3 left.
            friction: Coefficient [-].
            bonded: It pulls, too. It slides freely along itself all the same, without friction.

        Raises:
            InputError: for a side that there is not, or on which another part lies.
        """
        side = require_whole("platen: side", side)
        friction = require_number("platen: friction", friction, NOT_NEGATIVE)
        bonded = require_flag("platen: bonded", bonded)
        solver = self.built.solver
        return self._plate(
            "platen",
            lambda: solver.findSidePlate(side, bonded, friction),
            lambda: solver.addSidePlates(side, bonded=bonded, friction=friction)[0],
        )

    def hold(
        self,
        *,
        box: tuple[Place, Place] | None = None,
        disc: tuple[Place, float] | None = None,
        where: Where | None = None,
        axes: str = "xy",
    ) -> HeldNodes:
        """Hold the nodes of a region at rest; `drive`, `turn` or `HeldNodes.move` moves them.

        All nodes in the region of deformable grains are held, of rigid ones the centres, about
        which the grains are free to turn (deviation D52). What counts is where they were when
        bonded. The region is one of:

        Args:
            box: Two opposite corners, x and y of each [m]; what lies on its edges is in.
            disc: x and y of the centre, and the radius [m].
            where: Function of the places' x and y, arrays [m], that says which ones are in.
            axes: ``"x"``, ``"y"`` or ``"xy"``: what is held.

        Raises:
            InputError: for a region without nodes, or with nodes that another part has.
        """
        if not (isinstance(axes, str) and axes in ("x", "y", "xy")):
            raise InputError(f"hold: axes = {quoted(axes)}, must be x, y or xy")
        self._require_scene("hold")
        solver = self.built.solver
        nodes, places = solver.nodePlaces(bonded=True)
        chosen = nodes[in_region(places, box, disc, where)].tolist()
        if found := self._found[HeldNodes]:
            sets = solver.nodeSets()
            alike = [
                n for n in found if sets[n]["nodes"].tolist() == chosen and sets[n]["axes"] == axes
            ]
            number = self._take(HeldNodes, "hold", alike[0] if alike else -1)
        else:
            number = self._asked(
                "hold", lambda: solver.addNodeSet(chosen, "x" in axes, "y" in axes)
            )
        return HeldNodes(self, solver, "held nodes", number)

    def _plate(self, kind: str, find: Callable[[], int], lay: Callable[[], int]) -> Part:
        """A plate: laid now, or found in a scene that is taken up again."""
        self._require_scene(kind)
        if self._found[Part]:
            number = self._take(Part, kind, self._asked(kind, find))
        else:
            number = self._asked(kind, lay)
            self.built.set_masses()
        return Part(self, self.built.solver, kind, number)

    def _asked(self, kind: str, call: Callable[[], int]) -> int:
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
                f"{kind}: part = another one than the {len(found)} that the scene has still, as "
                f"{there}; must be one of them: make the calls with which it began, or O.reset()"
            )
        found.remove(number)
        return number

    @property
    def _begun(self) -> bool:
        """Whether the record has begun, here or in the scene that was taken up."""
        return self.built.engine(wrapper.AxialRecorder) is not None

    def _require_scene(self, what: str) -> None:
        """Refuse to go on in another scene than that of the rig."""
        if self.built.solver is not self._solver or self._solver not in yade.O.engines:
            raise InputError(
                f"{what}: scene = another one than that of the rig, must be the same; after "
                "O.reset() or O.load() make a new rig"
            )
