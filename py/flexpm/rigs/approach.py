# SPDX-License-Identifier: GPL-3.0-or-later
"""How a stage comes to a stress, and ends where ends that only press would pull. SI units."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import yade

from ..results.record import Curve

#: Wave transits in which the distance to a stress falls by a factor of e, deviation D74 ...
TRANSITS = 4.0
#: ... and rows of the record in which it does so at least: the loading sees the stress at rows.
ROWS = 4
#: A stress is reached within this part of it, or within the second part of the largest stress until
#: then, whichever is more [-].
_OF_STRESS, _OF_LARGEST = 0.005, 0.001


class Loaded(Protocol):
    """The rig of a stage."""

    @property
    def record(self) -> Curve:
        """The record until now."""

    @property
    def stress(self) -> float:
        """Axial stress of the last row [Pa]."""

    @property
    def row_period(self) -> int:
        """Steps from one row of the record to the next."""

    def approach(self, stress: float, velocity: float) -> None:
        """Bring the stress closer to a value [Pa], at `velocity` at most for a factor of 1."""


class Approach:
    """A loading that slows down towards the stress that its stage comes to.

    Attributes:
        stopped: The stage has ended at zero stress, because the ends would pull from there on.
    """

    def __init__(
        self, rig: Loaded, velocity: float, stress: float | None, *, would_pull: bool
    ) -> None:
        """Look at a stage that has just begun, or is resumed.

        Args:
            rig: Loads the specimen.
            velocity: Velocity of the ends at a factor of 1 [m/step, or m/s with real masses].
            stress: To come to [Pa]; None: the stage goes to a strain.
            would_pull: The stage takes the load off, on to where ends would pull that only press.
        """
        self._rig, self._velocity = rig, velocity
        self._stress, self._would_pull = stress, would_pull
        self._largest = float(np.abs(rig.record["axial_stress"]).max(initial=0.0))
        self.stopped = False

    @property
    def is_there(self) -> bool:
        """Whether the stress of the last row has reached the target."""
        if self._stress is None:
            return False
        tolerance = max(_OF_STRESS * abs(self._stress), self.tolerance)
        return abs(self._rig.stress - self._stress) <= tolerance

    @property
    def tolerance(self) -> float:
        """Difference of two stresses that are equal, of any size [Pa]."""
        return _OF_LARGEST * self._largest

    def is_over(self, first_step: int) -> bool:
        """Adapt the velocity after a row; whether the stress is reached, or zero.

        Args:
            first_step: Value at the beginning of the stage.
        """
        step, stress, period = yade.O.iter, self._rig.stress, self._rig.row_period
        has_row = step - first_step >= period
        self.stopped = self._would_pull and has_row and stress <= 0.0
        if self.is_there or self.stopped:
            return True
        if step > first_step and step % period:
            return False
        self._largest = max(self._largest, abs(stress))
        if self._would_pull:
            # just below zero, which is then passed and not only approached
            self._rig.approach(-self.tolerance, self._velocity)
        elif self._stress is not None:
            self._rig.approach(self._stress, self._velocity)
        return False
