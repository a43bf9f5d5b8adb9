# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane pulse through a 3D specimen along z: the test ``sonic``, deviation D98. SI units."""

from __future__ import annotations

from yade import wrapper

from ...results import waves
from ..rig import LEFT, RIGHT
from ..wave_rig import ACROSS, WaveRig, unit
from .end_rig import BACK, FRONT


class SolidWaveRig(WaveRig):
    """A box or a cylinder, whose height is along z; a shear wave moves it along x."""

    _along = 2

    def _new_frame(self) -> wrapper.TestFrame:
        return wrapper.EndFrame()

    def _lowest(self) -> float:
        return 0.0

    def _modulus(self, young: float, poisson: float) -> float:
        return young if self._free else waves.solid_modulus(self._wave, young, poisson)

    def _hold_sides(self) -> None:
        hold = self.built.solver.holdSide
        sheared = self._moved == ACROSS
        if self.built.specimen.kind != "box":  # a mantle, which faces all ways
            hold(RIGHT, x=not sheared, y=not sheared, z=sheared)
            return
        for side in (LEFT, RIGHT):
            hold(side, x=not sheared, z=sheared)
        for side in (FRONT, BACK):
            hold(side, y=True)

    def _set_motion(self, shape: wrapper.LaguerreCell, speed: float) -> None:
        x, y, z = unit(self._moved)
        shape.setMotion((speed * x, speed * y, speed * z), (0.0, 0.0, 0.0))
