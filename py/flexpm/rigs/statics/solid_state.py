# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of a 3D specimen between parts, as a state that can be plotted. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...arrays import FloatArray
from ...errors import InputError
from ...files import Table
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
    """Elastic equilibrium of a 3D specimen between parts, from the unloaded state.

    It is a snapshot like any other: displacements, stresses and sections are proportional to the
    loading. Plates without bond only press: their points open and close until the solution is
    consistent. Grains slide along smooth plates and stick to plates with friction (deviation D101).
    """

    way: float = 0.0  #: of the driven parts, or a crosshead, along the loading [m, or rad]
    load: float = 0.0  #: of the driven parts on the specimen, along the loading [N, or N m]
    solutions: int = 0  #: until points of plates were open or closed as the solution has them
    rig: object = field(default=None, repr=False)  #: whose parts have the forces
    plates: tuple[tuple[float, ...], ...] = ()  #: force, displacement and angle of each
    node_sets: tuple[tuple[float, ...], ...] = ()  #: the same, moment and angle

    def force(self, part: RigPart) -> tuple[float, ...]:
        """Return the force of a part on the specimen, x, y and z [N]."""
        return self._of(part)[:3]

    def displacement(self, part: RigPart) -> tuple[float, ...]:
        """Return the displacement of a part, x, y and z [m]; of driven nodes only."""
        return self._of(part)[3:6]

    def moment(self, part: HeldNodes) -> tuple[float, ...]:
        """Return the moment of fixed nodes on the specimen, x, y and z [N m].

        It refers to the point about which the nodes rotate, see `HeldNodes`.
        """
        return self._of(require_part("elastic: part", self.rig, part, HeldNodes))[6:9]

    def angle(self, part: RigPart) -> tuple[float, ...]:
        """Return the rotation of fixed nodes or of a seated plate, x, y and z [rad]."""
        return self._of(part)[9 if isinstance(part, HeldNodes) else 6 :]

    def _of(self, part: RigPart) -> tuple[float, ...]:
        part = require_part("elastic: part", self.rig, part, RigPart)
        return (self.node_sets if isinstance(part, HeldNodes) else self.plates)[part.number]


class SolidPartStatics(PartStatics):
    """Base of a rig of parts around a 3D specimen with a static solution."""

    def elastic(  # type: ignore[override]
        self,
        pressures: Mapping[Part, float] | None = None,
        *,
        displacement: float = 0.0,
        load: float | None = None,
    ) -> SolidElasticState:
        """Return the equilibrium of the unloaded 3D specimen if all of it stays elastic.

        Weights do not act. Unbonded plates carry compression only, as in 2D, on the points that
        they touch at the beginning.

        Args:
            pressures: Pressure on each part [Pa]; these parts are free to move along their normals.
            displacement: Displacement of the driven parts, or of the crosshead of a machine, along
                the loading [m], or their rotation [rad].
            load: Sum of the forces [N] or moments [N m] of the driven parts, instead of a
                displacement.

        Returns:
            A snapshot that also has the forces and displacements of the parts.

        Raises:
            InputError: as in 2D, and if the scene has been stepped.
        """
        displacement, asked = required_loading(displacement, load)
        frame = self._frame
        driven = bool(frame.driven or frame.drivenSets)
        if asked is not None or displacement != 0.0:
            self._require_driven("elastic:")
        pressed = self._pressed(frame, {} if pressures is None else pressures)
        if not (driven or pressed):
            raise InputError("elastic: nothing loads the specimen; pass pressures or call drive()")
        solid = self.built
        assert isinstance(solid, SolidModel)
        try:
            found = frame.elasticState(list(pressed), list(pressed.values()), displacement, asked)
        except (ValueError, RuntimeError) as error:
            raise InputError(f"elastic: {error}") from None
        sum_of = _Sum(solid)
        for share in found["shares"]:
            sum_of.add(share)
        return SolidElasticState(
            **sum_of.arrays,
            way=found["way"],
            load=found["load"],
            solutions=found["solutions"],
            rig=self,
            plates=_rows(sum_of.plates),
            node_sets=_rows(sum_of.node_sets),
        )


class _Sum:
    """Weighted sum of small linear solutions, added to the unloaded state."""

    def __init__(self, solid: SolidModel) -> None:
        self._solid, still = solid, solid.snapshot()
        self._still = {name: getattr(still, name) for name in SolidSnapshot.__dataclass_fields__}
        self.arrays = dict(self._still)
        # force, displacement and angle of each; of node sets moment, too
        self._laid = [[*np.zeros(6), *one["angle"]] for one in solid.solver.plates()]
        self.plates = np.reshape(self._laid, (-1, 9)).astype(float)
        self.node_sets = np.zeros((len(solid.solver.nodeSets()), 12))

    def add(self, found: Table) -> None:
        small, factor = self._solid.state_of(found["snapshot"]), found["factor"]
        for name in _LINEAR:
            grown = factor * (getattr(small, name) - self._still[name])
            self.arrays[name] = self.arrays[name] + grown
        plates = np.reshape(found["plates"], self.plates.shape)
        self.plates += factor * (plates - np.reshape(self._laid, self.plates.shape))
        self.node_sets += factor * np.reshape(found["node_sets"], self.node_sets.shape)


def _rows(values: FloatArray) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(one) for one in values.tolist())
