# SPDX-License-Identifier: GPL-3.0-or-later
"""The rig of a solid between plates: lines across its depth and parts of its sides. SI units.

Places and directions of a layout are x and y of the plane: x and z of a solid. Deviation D99.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np
from yade import wrapper

from ...arrays import FloatArray
from ...errors import InputError
from ...files import Table
from ...kinds.layout import BOTTOM, LEFT, RIGHT, TOP, Layout, Place, Plate
from ...models.grains import Model
from ...runs.loading_rate import Scales
from ...runs.runner import Runner
from ..grain_rig import GrainRig
from .end_rig import EndRig

#: Width that the stiffness of a line stands for, in mean diameters of the grains, as the length of
#: a support in the plane; and what a part of a side reaches off its plane [-].
_WIDTH, _OFF = 0.5, 0.5
#: Normals of plates along whole sides.
_INWARDS = {BOTTOM: (0.0, 1.0), RIGHT: (-1.0, 0.0), TOP: (0.0, -1.0), LEFT: (1.0, 0.0)}


@dataclass(frozen=True)
class _Patch:
    """A part of a side before a plate."""

    normal: FloatArray
    low: FloatArray  #: corners of the box around it [m]
    high: FloatArray
    area: float  #: nominal [m2]


class SolidPartRig(EndRig):
    """A solid between plates, which hold, press and load it as a layout says."""

    def __init__(
        self, built: Model, layout: Layout, *, test: str, runner: Runner | None = None
    ) -> None:
        """Take grains that have just been built, or whose scene has been loaded.

        Args:
            built: The specimen.
            layout: Plates, and what the record refers to.
            test: Name of the test, whose loading rate is taken.
            runner: Steps, shows progress and saves checkpoints; None for one that only steps.
        """
        self._layout, self._test = layout, test
        self._numbers = {name: number for number, name in enumerate(layout.plates)}
        self._scales: Scales | None = None
        super().__init__(built, runner=runner)
        self._same = dict(layout.also)
        if not self._solid.pressedAreas():  # those of a scene that is taken up are there
            for name, plate in layout.plates.items():
                self._lay(plate, pressed=name == layout.pressed)
            self.built.set_masses()
        if not self._recorder.gauges:
            self._add_gauges()

    @property
    def kind(self) -> str:
        """Name of the test."""
        return self._test

    @property
    def laid(self) -> Table:
        """Plates that bear the specimen, as plain values."""
        plates = {
            name: list(plate.place) if plate.side is None else plate.side
            for name, plate in self._layout.plates.items()
        }
        return {"plates": plates, "width": self._width}

    def scales(self) -> Scales:
        """What the loading rate follows from: the elastic solution of the specimen before it."""
        if self._scales is None:
            kept = self._frame.loadingScales
            self._scales = Scales(*kept) if kept else super().scales()
        return self._scales

    @property
    def confinement(self) -> float | None:
        """None: what presses on a plate is no confinement of the record."""
        return None

    def roughen(self, friction: float) -> None:
        """Refuse friction: plates are smooth, but for a head that does not slide.

        Raises:
            InputError: always.
        """
        raise InputError(f"roughen: friction = {friction:g}, must be left out between plates")

    def confine(self, pressure: float, second: float | None = None) -> None:
        """Press on the plate that the layout names until the forces balance.

        Args:
            pressure: On its area [Pa].
            second: Must be None.

        Raises:
            InputError: for a layout without one.
            SimulationError: if the forces do not come to balance.
        """
        if not self._layout.pressed or second is not None:
            raise InputError(
                f"confine: pressure = {pressure:g} Pa, must be left out: no plate is pressed"
            )
        GrainRig.confine(self, pressure)
        self._scales = None  # of what it presses on now, also if a scene is taken up before

    def _press(self, pressure: float, ramp: int) -> None:
        plates = [self._numbers[self._layout.pressed]]
        engine = wrapper.PressureController(plates=plates, pressure=pressure, rampSteps=ramp)
        self.built.add_engines(before=(engine,))

    def _pressing_force(self) -> float:
        pressing = self._pressing()
        if pressing is None:
            return 0.0
        return pressing.pressure * self._patch(self._layout.plates[self._layout.pressed]).area

    def _new_frame(self) -> wrapper.TestFrame:
        layout = self._layout
        mouth = layout.openings.get("cmod")
        first, second = (mouth.first[0], mouth.second[0]) if mouth else (0.0, 0.0)
        return wrapper.SolidPartFrame(
            driven=[self._numbers[name] for name in layout.driven],
            holding=[self._numbers[name] for name in layout.against],
            direction=_in_space(layout.direction),
            area=layout.area,
            length=layout.length,
            strength=layout.strength,
            middle=0.5 * (first + second),
            reach=0.5 * (second - first),
        )

    def _add_gauges(self) -> None:
        """Record how far points move apart, a mouth aside, and how far plates go."""
        middle = 0.5 * self.built.specimen.dimensions["depth"]
        for name, one in self._layout.openings.items():
            if name == "cmod":
                continue
            first, second = (_in_space(place, middle) for place in (one.first, one.second))
            ends = self._solid.gaugePoints(first, second)
            way = one.along or (one.second[0] - one.first[0], one.second[1] - one.first[1])
            direction = np.array(way) / np.hypot(*way)
            self._recorder.addGauge(
                wrapper.Gauge(
                    name=name, first=ends[0], second=ends[1], direction=_in_space(tuple(direction))
                )
            )
        for name, (part, along) in self._layout.ways.items():
            number = self._numbers[part]
            gauge = wrapper.Gauge(name=name, plate=number, direction=_in_space(along))
            self._recorder.addGauge(gauge)

    def _begin_record(self) -> None:
        super()._begin_record()
        self._frame.loadingScales = list(astuple(self.scales()))

    def _take_hold(self) -> wrapper.LoadingController:
        frame = self._frame
        plates = wrapper.SolidEndsController(plates=frame.driven, direction=frame.direction)
        self.built.add_engines(before=(plates,))
        return plates

    def _move(self, velocity: float, factor: float) -> None:
        super()._move(-velocity, factor)  # a rig that presses gives that of its upper end, upwards

    def _loaded_area(self) -> float:
        return self._layout.area

    def _lay(self, plate: Plate, *, pressed: bool) -> None:
        try:
            if plate.side is None and plate.length is None:
                side = BOTTOM if plate.normal[1] > 0.0 else TOP
                self._solid.layLine(side, *plate.place, self._width, pinned=plate.pinned)
                return
            patch = self._patch(plate)
            self._solid.layPatch(
                tuple(patch.normal),
                tuple(patch.low),
                tuple(patch.high),
                bonded=plate.bonded,
                loaded=pressed,
                pinned=plate.pinned,
            )
        except ValueError as error:
            raise InputError(f"run: {error}") from None

    def _patch(self, plate: Plate) -> _Patch:
        """What of a box a plate lies before: a strip of a side across the depth."""
        sizes = self.built.specimen.dimensions
        whole = np.array([sizes["width"], sizes["depth"], sizes["height"]])
        inwards = plate.normal if plate.side is None else _INWARDS[plate.side]
        normal = np.array(_in_space(inwards))
        low, high = np.zeros(3), whole.copy()
        across = int(np.argmax(np.abs(normal)))
        if plate.length is not None:
            along = 2 - across
            place = _in_space(plate.place)[along]
            low[along] = max(low[along], place - 0.5 * plate.length)
            high[along] = min(high[along], place + 0.5 * plate.length)
        area = float(np.prod(np.delete(high - low, across)))
        off = _OFF * self.built.specimen.mean_diameter
        at = 0.0 if normal[across] > 0.0 else whole[across]
        low[across], high[across] = at - off, at + off
        low[1], high[1] = low[1] - off, high[1] + off  # all of the depth, whatever its round-off
        return _Patch(normal, low, high, area)

    @property
    def _width(self) -> float:
        return _WIDTH * self.built.specimen.mean_diameter

    @property
    def _frame(self) -> wrapper.SolidPartFrame:
        frame = self._recorder.frame
        assert isinstance(frame, wrapper.SolidPartFrame)
        return frame


def _in_space(place: Place, depth: float = 0.0) -> tuple[float, float, float]:
    """x, y and z of what is x and y of the plane."""
    return float(place[0]), depth, float(place[1])
