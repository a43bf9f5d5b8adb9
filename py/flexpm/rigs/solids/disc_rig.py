# SPDX-License-Identifier: GPL-3.0-or-later
"""Rig of a 3D disc between two plates, paper Sec. 4.1. SI units."""

from __future__ import annotations

import numpy as np
from yade import wrapper

from ...errors import InputError
from ...models.grains import Model
from ...require import Bounds, require_number
from ...runs.runner import Runner
from .end_rig import EndRig


class SolidDiscRig(EndRig):
    """A disc about the y axis between smooth plates; the upper plate moves down along z."""

    #: Radius of the jaws [m]; 0: plates are flat.
    _radius: float = 0.0

    def __init__(
        self, built: Model, *, tension: bool = False, runner: Runner | None = None
    ) -> None:
        """Take grains as `EndRig` does.

        Raises:
            InputError: for tension, which plates that touch do not give.
        """
        if tension:
            raise InputError("rig: tension = True, must be False for a disc; plates press it")
        super().__init__(built, tension=tension, runner=runner)

    def bend(self, radius: float) -> None:
        """Replace the flat plates by curved jaws, before the loading.

        Gaps and normals follow from two circles (deviation D95).

        Args:
            radius: Radius of the jaws, above the radius of the disc; the ISRM suggests 1.5 times
                the radius of the disc [m].

        Raises:
            InputError: for a radius that is not above the radius of the disc.
        """
        least = 0.5 * self.built.specimen.dimensions["diameter"]
        self._radius = require_number("bend: radius", radius, Bounds(above=least), "m")

    def roughen(self, friction: float) -> None:
        """Reject friction: the first contacts of the plates do not slide.

        Raises:
            InputError: always.
        """
        raise InputError(
            f"roughen: friction = {friction:g}, must not be given for a disc; leave it out"
        )

    def confine(self, pressure: float, second: float | None = None) -> None:
        """Refuse a pressure.

        Raises:
            InputError: always.
        """
        raise InputError(
            f"confine: pressure = {pressure:g} Pa, must not be given for a disc; leave it out"
        )

    @property
    def contact_width(self) -> float:
        """Mean width on which the plates touch the disc, over its depth [m]."""
        areas = [plate["pressed_area"] for plate in self._solid.plates()]
        return float(np.mean(areas)) / self.built.specimen.dimensions["depth"]

    def _measures(self) -> tuple[str, ...]:
        return ()

    def _new_frame(self) -> wrapper.TestFrame:
        sizes = self.built.specimen.dimensions
        return wrapper.DiscFrame(diameter=sizes["diameter"], depth=sizes["depth"])

    def _preloadable(self) -> wrapper.LoadingController:
        self._refuse_preload()  # plates press into what they touch

    def _take_hold(self) -> wrapper.LoadingController:
        self._solid.holdDisc(self._radius)
        self.built.set_masses()
        upper = wrapper.SolidLoadingController()
        self.built.add_engines(before=(upper,))
        return upper
