# SPDX-License-Identifier: GPL-3.0-or-later
"""The static solution of grains between two ends. SI units."""

from __future__ import annotations

from typing import ClassVar

from yade import wrapper

from ...renamed import with_old_names
from ...require import NOT_NEGATIVE, require_number
from ..grain_rig import GrainRig, NodeRig, PlateRig
from .elastic_state import ElasticState, required_loading, solved


@with_old_names
class EndStatics(GrainRig):
    """Base of a rig between two ends with a static solution."""

    #: Whether its ends are plates.
    _between_plates: ClassVar[bool]

    def elastic(
        self, pressure: float | None = None, *, displacement: float = 0.0, load: float | None = None
    ) -> ElasticState:
        """Return the equilibrium of the specimen without further damage: a static solution.

        As with ``PartRig.elastic``, the solution is linear about the present state, unbonded points
        open and close until the solution is consistent, and the scene is not changed (deviation
        D72). The ends are the ends that the test has or would have: nodes of deformable grains,
        plates for other grains. A specimen that is free to slide along smooth plates is fixed along
        them in the middle of the lower end.

        Args:
            pressure: Pressure on the sides, and on a top that is not driven [Pa]. None: the present
                pressure.
            displacement: Displacement of the upper end along the loading [m], relative to the state
                under the pressure. A plate moves further than the grains, since its contacts also
                deform.
            load: Final load on the specimen along the loading [N], instead of a displacement.

        Returns:
            A snapshot of the equilibrium.

        Raises:
            InputError: for a value out of range, a pressure on a disc, or a specimen of which a
                piece is free to move; the message names the motion.
        """
        displacement, load = required_loading(displacement, load)
        if pressure is not None:
            pressure = require_number("elastic: pressure", pressure, NOT_NEGATIVE, "Pa")
        frame = self._recorder.frame
        assert isinstance(frame, (wrapper.RectangleFrame, wrapper.DiscFrame))
        return solved(
            self,
            self.built,
            lambda: frame.elasticState(
                self._between_plates, self._pieces, pressure, displacement, load
            ),
        )

    @property
    def _pieces(self) -> int:
        """Number of plates of a membrane on each side."""
        return 1


class NodeEnds(EndStatics, NodeRig):
    """Deformable grains between their ends, by their boundary nodes and edges."""

    _between_plates = False


class PlateEnds(EndStatics, PlateRig):
    """Rigid grains between their ends, and discs, by plates."""

    _between_plates = True

    @property
    def _pieces(self) -> int:
        return 1 if self.disc else self._membrane_pieces
