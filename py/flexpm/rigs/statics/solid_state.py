# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of a solid between parts, as a state that can be looked at. SI units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from yade import wrapper

from ...errors import InputError
from ...models.grains import SolidModel
from ...results.solids.state import SolidSnapshot
from ..parts import HeldNodes, Part, RigPart, require_part
from .elastic_state import PartStatics, required_loading

#: Arrays of a state that a linear solution changes.
_LINEAR = (
    *("positions", "forces", "centres", "tetrahedron_stress", "corners"),
    *("point_position", "point_opening", "point_slip", "point_traction"),
)


@dataclass(frozen=True, eq=False)
class SolidElasticState(SolidSnapshot):
    """Where an unloaded solid between parts would come to rest, if all of it stayed elastic.

    It is a snapshot as any other: displacements, stresses and sections grow in proportion with the
    way. What touches a plate stays with it, pulled or pressed; smooth plates let it slide, those
    with friction hold it (deviation D101).
    """

    way: float = 0.0  #: of the driven parts along the loading [m, or rad]
    load: float = 0.0  #: of the driven parts on the specimen, along the loading [N, or N m]
    rig: object = field(default=None, repr=False)  #: whose parts have the forces
    plates: tuple[tuple[float, ...], ...] = ()  #: force and displacement of each
    node_sets: tuple[tuple[float, ...], ...] = ()  #: the same, moment and angle

    def force(self, part: RigPart) -> tuple[float, ...]:
        """Force of a part on the specimen, x, y and z [N]."""
        return self._of(part)[:3]

    def displacement(self, part: RigPart) -> tuple[float, ...]:
        """Displacement of a part, x, y and z [m]; of nodes that are driven alone."""
        return self._of(part)[3:6]

    def moment(self, part: HeldNodes) -> tuple[float, ...]:
        """Moment of held nodes on the specimen about their place, x, y and z [N m]."""
        return self._of(require_part("elastic: part", self.rig, part, HeldNodes))[6:9]

    def angle(self, part: HeldNodes) -> tuple[float, ...]:
        """Angle by which held nodes have turned, x, y and z [rad]."""
        return self._of(require_part("elastic: part", self.rig, part, HeldNodes))[9:]

    def _of(self, part: RigPart) -> tuple[float, ...]:
        part = require_part("elastic: part", self.rig, part, RigPart)
        return (self.node_sets if isinstance(part, HeldNodes) else self.plates)[part.number]


class SolidPartStatics(PartStatics):
    """Base of a rig of parts around a solid that answers without a step."""

    def elastic(  # type: ignore[override]
        self,
        pressures: Mapping[Part, float] | None = None,
        *,
        way: float = 0.0,
        load: float | None = None,
    ) -> SolidElasticState:
        """Where the unloaded solid would come to rest, if all of it stayed elastic.

        Args:
            pressures: Must be left out.
            way: How far the driven parts go along the loading [m], or turn [rad].
            load: Sum of what they push [N], or of their moments [N m], in place of a way.

        Raises:
            InputError: as of the plane, for pressures, and once a step has been done.
        """
        if pressures:
            raise InputError("elastic: pressures = given, must be left out for a solid")
        way, asked = required_loading(way, load)
        frame = self._frame
        assert isinstance(frame, wrapper.SolidPartFrame)
        if not (frame.driven or frame.drivenSets):
            raise InputError("elastic: driven parts = none, must be at least 1; call drive or turn")
        try:
            found = frame.elasticState()
        except (ValueError, RuntimeError) as error:
            raise InputError(f"elastic: {error}") from None
        if asked is not None and not found["load"]:
            raise InputError(f"elastic: load = {asked:g}, must be left out: nothing resists")
        factor = way / found["way"] if asked is None else asked / found["load"]
        solid = self.built
        assert isinstance(solid, SolidModel)
        still, small = solid.snapshot(), solid.state_of(found["snapshot"])
        arrays = {name: getattr(still, name) for name in SolidSnapshot.__dataclass_fields__}
        for name in _LINEAR:
            arrays[name] = arrays[name] + factor * (getattr(small, name) - arrays[name])
        return SolidElasticState(
            **arrays,
            way=factor * found["way"],
            load=factor * found["load"],
            rig=self,
            plates=_times(factor, found["plates"]),
            node_sets=_times(factor, found["node_sets"]),
        )


def _times(factor: float, parts: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(factor * value for value in one) for one in parts)
