# SPDX-License-Identifier: GPL-3.0-or-later
"""A rig of parts around a 3D specimen: plates on its sides, lines across its depth. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NoReturn, Unpack

from yade import wrapper

from ...dimensions import refused
from ...errors import InputError
from ...files import Table
from ...kinds.registry import OWN
from ...models.grains import Model
from ...renamed import with_old_names
from ...runs.runner import Runner, Span
from ..layout import before
from ..outcome.calls import recording
from ..outcome.kept import Leaves
from ..part_rig import PartRig
from ..parts import HeldNodes
from ..places import SPACE, Place, require_direction
from ..statics.solid_state import SolidPartStatics
from .part_layout import SolidPartLayout
from .patches import sides_under


@with_old_names
@recording
class SolidPartRig(SolidPartLayout, SolidPartStatics, PartRig):
    """A 3D specimen between parts: plates on its surface, and sets of nodes.

    `PartRig` of a 3D specimen makes this rig; the name ends with version 0.4. Its calls are the
    calls of `PartRig`, with a third component of positions and directions. Features that are
    available in 2D only raise an error. Deviation D101.

    Example:
        >>> rig = flexpm.PartRig(flexpm.build(solid))
        >>> low = rig.hold(where=lambda x, y, z: z < 1e-4)
        >>> top = rig.hold(where=lambda x, y, z: z > 0.0119)
        >>> rig.drive(top, (0, 0, 1), against=low)
        >>> [round(force) for force in rig.elastic(load=100.0).force(top)]
        [0, 0, 100]
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
            built: The 3D specimen and its model.
            kind: Name of the test, whose loading rate is used.
            runner: Object that steps, shows progress and saves checkpoints; None: it only steps.
            leaves: Output of the test, as for `flexpm.rig`.

        Raises:
            InputError: as `PartRig`.
        """
        self._patches, self._traces = {}, {}
        super().__init__(built, kind=kind, runner=runner, **leaves)

    def rotate(
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
        """Load the specimen by rotating fixed nodes about an axis, each set like a rigid body.

        The column ``load`` of the record is the sum of the moments of all sets about the axis [N
        m], and ``displacement`` is the rotation of each set [rad]. Stress and strain are load /
        `area` and displacement / `length`.

        Args:
            parts: Sets that rotate right-handed about the axis.
            back: Sets that rotate by the same angle in the opposite sense.
            about: x, y and z of a point on the common axis of all sets, which does not move [m].
                None: each set rotates about the mean of its positions and is free to translate, so
                that only a moment acts (deviation D53).
            axis: x, y and z of the direction of the axis.
            area, length, strength: As in 2D.

        Raises:
            InputError: as `drive`.
        """
        sizes = {"area": area, "length": length, "strength": strength}
        self._turn((parts, back), about, require_direction("rotate: axis", axis, SPACE), sizes)

    def excavate(self, *_: object, **__: object) -> NoReturn:
        """Raise InputError: available in 2D only."""
        raise refused(f"excavate: specimen = {self.built.specimen.kind}, must be 2D", "excavation")

    @property
    def drives(self) -> Table:
        """As in 2D, and whether the direction is the axis of a rotation."""
        return {**super().drives, "turns": self._frame.turns}

    @property
    def _turns(self) -> bool:
        return bool(self._frame.turns)

    @property
    def may_fail_at_once(self) -> bool:
        """True: a custom test may have few contacts across."""
        return self.kind == OWN.name

    @property
    def parts(self) -> list[Table]:
        """All parts as plain values: plates, then sets of fixed nodes, by index.

        ``position`` is the position at zero displacement [m]: where the part was added, or where it
        was when displacements began to count. ``face`` is the trace of a plate along x and z [m].
        """
        names = ("normal", "area", "friction", "bonded")
        plates = [
            {
                "part": "plate",
                **{name: one[name] for name in names},
                "position": before(one),
                **{
                    name: one[name]
                    for name in ("strip", "radius", "machine", "seated")
                    if one[name]
                },
                "face": self._traces.get(number, []),
            }
            for number, one in enumerate(self._solid.plates())
        ]
        sets = [
            {
                "part": "held nodes",
                "nodes": [int(node) for node in one["nodes"]],
                "axes": one["axes"],
                "position": before(one),
            }
            for one in self._solid.nodeSets()
        ]
        return [*plates, *sets]

    def read_mouth(self, first: float, second: float) -> None:
        """Record the opening between two lines of the bottom at x, across the depth, as ``cmod``.

        Args:
            first: x of the line on the left [m].
            second: x of the line on the right [m].
        """
        if not self._begun:
            self._frame.middle, self._frame.reach = 0.5 * (first + second), 0.5 * (second - first)

    def _measures(self) -> tuple[str, ...]:
        names = super()._measures()
        return names if self._load_is_of_plates else tuple(one for one in names if one != "load")

    @property
    def _load_is_of_plates(self) -> bool:
        """Whether plates carry the load, which then grows with the forces of their contacts."""
        frame = self._frame
        return not frame.drivenSets or (bool(frame.holding) and not frame.holdingSets)

    def _load_by(self, call: str, **asked: object) -> None:
        super()._load_by(call, **asked, turns=call == "rotate")

    def _begin_pressures(self, numbers: list[int], values: list[float]) -> Span:
        self._free(numbers)
        return super()._begin_pressures(numbers, values)

    def _sides_under(self, side: object, hole: object) -> list[int]:
        return sides_under(self._specimen, side, hole)

    def _press(self, pressure: float, ramp: int) -> None:
        if self.pressed is not None:
            self._free([self.pressed.number])
        super()._press(pressure, ramp)

    def _free(self, plates: list[int]) -> None:
        """Let loads move plates, whose masses follow from the nodes in contact with them."""
        for plate in plates:
            self._asked("press", partial(self._solid.freePlate, plate))
        self.built.set_masses()

    def _require_push(self, velocity: float) -> None:
        """Also reject seated plates alone: the specimen tips over unless two have friction."""
        super()._require_push(velocity)
        plates = self._solid.plates()
        holds = any(not one["seated"] for one in plates) or self._solid.nodeSets()
        if not holds and sum(one["friction"] > 0.0 for one in plates) < 2:
            raise InputError(
                "load: the specimen can tip over because all parts are seated; use one part "
                "without a seat, or give two parts friction"
            )

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
        stood = loading.gripped and loading.velocity == 0.0
        if velocity and stood and not self.built.dynamic:
            loading = self._take_hold_again(loading)
            assert isinstance(loading, wrapper.SolidLoadingController)
        # a rig that presses gives the velocity of its upper end, upwards
        loading.velocity, loading.velocityFactor = -velocity, factor
