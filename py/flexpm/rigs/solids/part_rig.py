# SPDX-License-Identifier: GPL-3.0-or-later
"""A rig of parts around a solid: plates before its sides, and lines across its depth. SI units."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import NoReturn, Unpack

import numpy as np
from yade import wrapper

from ...errors import InputError
from ...files import Table
from ...kinds.registry import OWN
from ...models.grains import Model
from ...require import NOT_NEGATIVE, quoted, require_flag, require_number, require_whole
from ...runs.runner import Runner, Span
from ...specimens.space.specimen import SolidSpecimen
from ..layout import NO_SLIDING, before
from ..outcome.calls import recording
from ..outcome.kept import Leaves
from ..part_rig import PartRig
from ..parts import HeldNodes, Part, RigPart
from ..places import SPACE, Place, Vector, require_direction, require_vector
from ..statics.solid_state import SolidPartStatics
from .patches import (
    BOTTOM,
    INWARDS,
    TOP,
    Patch,
    box_around,
    edges_of,
    inwards_at,
    patch_around,
    side_patch,
)
from .solid_grains import SolidGrains

#: Width that the stiffness of a line stands for, in mean diameters of the grains, as the length of
#: a support in the plane [-].
_WIDTH = 0.5
#: Least part of a line's normal along z [-].
_UPRIGHT = 0.5


@recording
class SolidPartRig(SolidGrains, SolidPartStatics, PartRig):
    """A solid between parts: plates before parts of its outside, and sets of nodes.

    Its calls are those of `PartRig`, places and directions with a third component: `support`,
    `platen`, `hold`, `gauge`, `way_of`, `drive`, `turn`, `elastic`, then `press`, `load`,
    `strain_to`, `stress_to`, `relax`, `unload`, `cycle`, `follow`. What is of the plane alone is
    refused. Deviation D101.
    """

    _axes = SPACE
    _call, _of_solids = "SolidPartRig", True

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
            built: The solid.
            kind: Name of the test, whose loading rate is taken.
            runner: Steps, shows progress and saves checkpoints; None for one that only steps.
            leaves: What the test leaves, as for `flexpm.rig`.

        Raises:
            InputError: as `PartRig`, and for real masses, with which parts would set off waves.
        """
        self._patches: dict[int, Patch] = {}
        super().__init__(built, kind=kind, runner=runner, **leaves)

    def support(
        self,
        place: Place,
        length: object = None,
        *,
        normal: Place = (0.0, 0.0, 0.0),
        pinned: bool = False,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Lay a plate against the part of the outside around a place.

        Args:
            place: x, y and z, on the outside [m].
            length: Edge of the cube around the place, or edges of a box along x, y and z, in which
                the outside lies before the plate [m]. None: a roller, which bears along a line
                across the depth through x and z of the place, on the bottom or from above.
            normal: x, y and z, into the specimen; zero: that of the nearest flat side.
            pinned: It does not slide as long as it presses.
            friction: Coefficient, of one that is not pinned [-]; no roller has one.
            bonded: It pulls, too, and slides freely; no roller does.
            strip: Must be None.
            seated: Must be False.

        Raises:
            InputError: for a place that is not on the outside, or a size out of range.
        """
        _refuse("support", strip=strip, seated=seated)
        specimen, at = self._specimen, require_vector("support: place", place, axes=SPACE)
        inwards = require_vector("support: normal", normal, "", SPACE)
        if any(inwards):
            inwards = require_direction("support: normal", inwards, SPACE)
        if require_flag("support: pinned", pinned):
            friction = NO_SLIDING
        friction = require_number("support: friction", friction, NOT_NEGATIVE)
        bonded = require_flag("support: bonded", bonded)
        if length is None:
            if bonded or friction not in (0.0, NO_SLIDING):
                raise InputError(
                    "support: length = None, must be given for one that is bonded or has friction; "
                    "a line is a roller or pinned"
                )
            return self._line(at, inwards, pinned)
        edges = edges_of(length)
        into = np.array(inwards) if any(inwards) else inwards_at(specimen, at)
        return self._patch("support", patch_around(specimen, at, edges, into), friction, bonded)

    def platen(
        self,
        side: int,
        *,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Lay a plate along a whole flat side.

        Args:
            side: 0 bottom, 1 right, 2 top, 3 left, 4 front, 5 back.
            friction: Coefficient [-].
            bonded: It pulls, too. It slides freely along itself.
            strip: Must be None.
            seated: Must be False.

        Raises:
            InputError: for a side that is not flat, or that there is not.
        """
        _refuse("platen", strip=strip, seated=seated)
        patch = side_patch(self._specimen, require_whole("platen: side", side))
        friction = require_number("platen: friction", friction, NOT_NEGATIVE)
        return self._patch("platen", patch, friction, require_flag("platen: bonded", bonded))

    def jaw(self, *_: object, **__: object) -> NoReturn:
        """Refuse it: of the plane alone. ``flexpm run brazilian --jaw-radius`` has it."""
        raise _of_the_plane(self.jaw)

    def contact_of(self, *_: object, **__: object) -> NoReturn:
        """Refuse it: of jaws, in the plane alone."""
        raise _of_the_plane(self.contact_of)

    def angle_of(self, *_: object, **__: object) -> NoReturn:
        """Refuse it: of seats, in the plane alone."""
        raise _of_the_plane(self.angle_of)

    def turn(
        self,
        parts: HeldNodes | Sequence[HeldNodes],
        back: HeldNodes | Sequence[HeldNodes] = (),
        *,
        about: Place | None = None,
        axis: Place = (0.0, 0.0, 1.0),
        area: float = 1.0,
        length: float = 1.0,
        strength: float = 0.0,
    ) -> None:
        """Load the specimen by turning held nodes about an axis, each set like a rigid body.

        The record's ``load`` is the sum of their moments about the axis [N m], its ``displacement``
        the angle of each [rad]; stress and strain are these over `area` and `length`.

        Args:
            parts: Sets that turn right-handed about the axis.
            back: Sets that turn the other way by the same angle.
            about: x, y and z of a point on the axis of all [m]. None: the axis of each goes through
                the mean of its places. Axes stay where they are (deviation D101).
            axis: x, y and z of its direction.
            area, length, strength: As of the plane.

        Raises:
            InputError: as `drive`.
        """
        sizes = {"area": area, "length": length, "strength": strength}
        self._turn((parts, back), about, require_direction("turn: axis", axis, SPACE), sizes)

    def fluid(self, *_: object, **__: object) -> NoReturn:
        """Refuse it: of the plane alone. ``flexpm.rig`` presses on the sides of a solid."""
        raise _of_the_plane(self.fluid)

    def excavate(self, *_: object, **__: object) -> NoReturn:
        """Refuse it: of the plane alone."""
        raise _of_the_plane(self.excavate)

    @property
    def drives(self) -> Table:
        """As of the plane, and whether the direction is the axis of a turn."""
        return {**super().drives, "turns": self._frame.turns}

    @property
    def machine(self) -> float:
        """0: no machine behind what loads a solid gives way [N/m]."""
        return 0.0

    @property
    def may_fail_at_once(self) -> bool:
        """A test of one's own may have few contacts across."""
        return self.kind == OWN.name

    @property
    def parts(self) -> list[Table]:
        """All parts as plain values: plates, then held nodes by their numbers.

        A place is that where the part was laid, or since when displacements count [m]; a face is
        the trace of a plate along x and z [m].
        """
        names = ("normal", "area", "friction", "bonded")
        plates = [
            {
                "part": "plate",
                **{name: one[name] for name in names},
                "place": before(one),
                "face": self._patches[number].trace if number in self._patches else [],
            }
            for number, one in enumerate(self._solid.plates())
        ]
        sets = [
            {
                "part": "held nodes",
                "nodes": [int(node) for node in one["nodes"]],
                "axes": one["axes"],
                "place": before(one),
            }
            for one in self._solid.nodeSets()
        ]
        return [*plates, *sets]

    def read_mouth(self, first: float, second: float) -> None:
        """Record how far two lines of the bottom at x move apart, across the depth, as ``cmod``.

        Args:
            first: x of the line on the left [m].
            second: x of the one on the right [m].
        """
        if not self._begun:
            self._frame.middle, self._frame.reach = 0.5 * (first + second), 0.5 * (second - first)

    def _line(self, at: Vector, inwards: Vector, pinned: bool) -> Part:
        """A roller or a head: deviation D99."""
        given, upwards = any(inwards), inwards[2]
        low, high = box_around(self._specimen)
        if given and not abs(upwards) > _UPRIGHT:
            raise InputError(
                "support: normal = one across z, must be along z without a length; give a length"
            )
        above = upwards if given else 0.5 * (low[2] + high[2]) - at[2]
        side = BOTTOM if above > 0.0 else TOP
        width = _WIDTH * self._specimen.mean_diameter
        values = (side, at[0], at[2], width, pinned)
        place = (at[0], 0.5 * (low[1] + high[1]), at[2])
        edges = np.array([width, high[1] - low[1], width])
        return self._lay(
            "support",
            lambda: self._solid.findLine(*values),
            lambda: self._solid.layLine(*values),
            patch_around(self._specimen, place, edges, np.array(INWARDS[side])),
        )

    def _patch(self, kind: str, patch: Patch, friction: float, bonded: bool) -> Part:
        values = (patch.normal, patch.low, patch.high, friction, bonded)
        return self._lay(
            kind,
            lambda: self._solid.findPatch(*values),
            lambda: self._solid.layPatch(*values),
            patch,
        )

    def _lay(
        self,
        kind: str,
        find: Callable[[], int],
        lay: Callable[[], int],
        patch: Patch,
    ) -> Part:
        """Lay a plate before a patch that no other one has."""
        for number, there in self._patches.items():
            if patch.overlaps(there):
                other = Part(self, self.built.solver, "plate", number)
                raise InputError(
                    f"{kind}: part = {other}, lies there already, must be apart; take another place"
                )
        part = self._plate(kind, find, lay)
        self._patches[part.number] = patch
        return part

    def _measures(self) -> tuple[str, ...]:
        return tuple(name for name in PartRig._measures(self) if name != "load")

    def _soften(
        self, moved: Sequence[RigPart], unit: tuple[float, float, float], soft: float | None
    ) -> None:
        _refuse("drive", machine=soft)

    def _load_by(self, call: str, **asked: object) -> None:
        super()._load_by(call, **asked, turns=call == "turn")

    def _turn_about(self, part: HeldNodes, pivot: Vector | None) -> None:
        if pivot is None:
            return
        if not self._begun:
            self.built.solver.turnNodeSet(part.number, pivot)
        elif not np.allclose(np.subtract(part.place, part.displacement), pivot):
            raise InputError(f"turn: about = {pivot}, must be as the record has begun")

    def _begin_pressures(self, numbers: list[int], values: list[float]) -> Span:
        self._free(numbers)
        return super()._begin_pressures(numbers, values)

    def _press(self, pressure: float, ramp: int) -> None:
        if self.pressed is not None:
            self._free([self.pressed.number])
        super()._press(pressure, ramp)

    def _free(self, plates: list[int]) -> None:
        """Let loads move plates, whose masses follow from what they touch."""
        for plate in plates:
            self._asked("press", partial(self._solid.freePlate, plate))
        self.built.set_masses()

    def _new_frame(self) -> wrapper.SolidPartFrame:
        return wrapper.SolidPartFrame()

    def _take_hold(self) -> wrapper.LoadingController:
        frame = self._frame
        self._let_go(frame.driven)
        loading = wrapper.SolidLoadingController(
            plates=frame.driven,
            nodeSets=frame.drivenSets,
            backSets=frame.backSets,
            direction=frame.direction,
            turns=frame.turns,
        )
        self.built.add_engines(before=(loading,))
        return loading

    def _move(self, velocity: float, factor: float) -> None:
        loading = self._recorder.loading
        assert isinstance(loading, wrapper.SolidLoadingController)
        if velocity and loading.gripped and loading.velocity == 0.0:
            loading = self._take_hold_again(loading)
            assert isinstance(loading, wrapper.SolidLoadingController)
        # a rig that presses gives the velocity of its upper end, upwards
        loading.velocity, loading.velocityFactor = -velocity, factor

    @property
    def _specimen(self) -> SolidSpecimen:
        specimen: object = self.built.specimen
        assert isinstance(specimen, SolidSpecimen)
        return specimen

    @property
    def _frame(self) -> wrapper.SolidPartFrame:
        frame = super()._frame
        assert isinstance(frame, wrapper.SolidPartFrame)
        return frame


def _of_the_plane(call: Callable[..., object]) -> InputError:
    """What says that solids do not have a call."""
    return InputError(
        f"{call.__name__}: specimen = a solid, must be plane; lay supports and platens"
    )


def _refuse(call: str, **given: object) -> None:
    """Refuse arguments of a call that solids do not have.

    Raises:
        InputError: for one that is given.
    """
    for name, value in given.items():
        if value:
            raise InputError(
                f"{call}: {name} = {quoted(value)}, must be left out for a solid, which has none"
            )
