# SPDX-License-Identifier: GPL-3.0-or-later
"""The rig of a solid on rollers, which a head presses down: lines across its depth, along y. SI.

Places and directions of a layout are x and y of the plane: x and z of a solid. Deviation D99.
"""

from __future__ import annotations

from dataclasses import astuple

from yade import wrapper

from ...errors import InputError
from ...files import Table
from ...kinds.layout import Layout, Plate
from ...models.grains import Model
from ...results import doubts, measures
from ...runs.loading_rate import Scales
from ...runs.runner import Runner
from ..rig import BOTTOM, TOP
from .end_rig import EndRig

#: Width that the stiffness of a line stands for, in mean diameters of the grains, as the length of
#: a support in the plane [-].
_WIDTH = 0.5


class SolidBeamRig(EndRig):
    """A beam or half a disc between lines that bear it."""

    def __init__(
        self, built: Model, layout: Layout, *, test: str, runner: Runner | None = None
    ) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: The specimen.
            layout: Rollers and head, and what the record refers to.
            test: Name of the test, whose loading rate is taken.
            runner: Steps, shows progress and saves checkpoints; None for one that only steps.
        """
        self._layout, self._test = layout, test
        self._scales: Scales | None = None
        super().__init__(built, runner=runner)
        if not self._solid.pressedAreas():  # those of a scene that is taken up are there
            for plate in layout.plates.values():
                self._lay(plate)
            self.built.set_masses()

    @property
    def kind(self) -> str:
        """Name of the test."""
        return self._test

    @property
    def laid(self) -> Table:
        """Lines that bear the specimen, as plain values."""
        lines = {name: list(plate.place) for name, plate in self._layout.plates.items()}
        return {"lines": lines, "width": self._width}

    @property
    def warnings(self) -> list[str]:
        """What makes the record doubtful, also a load that grew fast up to its peak."""
        if self._recorder.loading is None:
            return super().warnings
        growth = measures.growth_before_peak(self.record, self.scales().crossing_steps)
        return super().warnings + doubts.of_growth(growth)

    def scales(self) -> Scales:
        """What the loading rate follows from: the elastic solution of the specimen before it."""
        if self._scales is None:
            kept = self._frame.loadingScales
            self._scales = Scales(*kept) if kept else super().scales()
        return self._scales

    def roughen(self, friction: float) -> None:
        """Refuse friction: rollers have none, and the head does not slide.

        Raises:
            InputError: always.
        """
        raise InputError(f"roughen: friction = {friction:g}, must be left out between rollers")

    def confine(self, pressure: float, second: float | None = None) -> None:
        """Refuse a pressure.

        Raises:
            InputError: always.
        """
        raise InputError(f"confine: pressure = {pressure:g} Pa, must be left out between rollers")

    def _new_frame(self) -> wrapper.TestFrame:
        layout = self._layout
        first, second = (layout.openings["cmod"].first[0], layout.openings["cmod"].second[0])
        return wrapper.SolidBeamFrame(
            area=layout.area,
            length=layout.length,
            strength=layout.strength,
            middle=0.5 * (first + second),
            reach=0.5 * (second - first),
        )

    def _begin_record(self) -> None:
        super()._begin_record()
        self._frame.loadingScales = list(astuple(self.scales()))

    def _take_hold(self) -> wrapper.LoadingController:
        head = wrapper.SolidEndsController()
        self.built.add_engines(before=(head,))
        return head

    def _loaded_area(self) -> float:
        return self._layout.area

    def _lay(self, plate: Plate) -> None:
        side = BOTTOM if plate.normal[1] > 0.0 else TOP
        try:
            self._solid.layLine(side, *plate.place, self._width, pinned=plate.pinned)
        except ValueError as error:
            raise InputError(f"run: {error}") from None

    @property
    def _width(self) -> float:
        return _WIDTH * self.built.specimen.mean_diameter

    @property
    def _frame(self) -> wrapper.SolidBeamFrame:
        frame = self._recorder.frame
        assert isinstance(frame, wrapper.SolidBeamFrame)
        return frame
