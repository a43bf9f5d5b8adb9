# SPDX-License-Identifier: GPL-3.0-or-later
"""Rig of a 3D specimen whose ends move along its axis, paper Sec. 4.1. SI units."""

from __future__ import annotations

import math

from yade import wrapper

from ...errors import InputError
from ...files import Table
from ...kinds.option import END_FRICTION
from ...require import NOT_NEGATIVE, require_number
from ..rig import LEFT, RIGHT, TOP
from .solid_grains import SolidGrains

FRONT, BACK = 4, 5


class EndRig(SolidGrains):
    """Both ends of a 3D specimen along z: nodes of deformable grains, plates on rigid grains.

    Pressures act on the surface triangles of both grain types, and on the top until it is driven.
    """

    #: Friction coefficient of the ends from the loading on [-]; 0: they are smooth.
    _friction: float = 0.0
    #: Pressure on front and back of a box [Pa]; None: that on the other sides.
    _second: float | None = None

    def roughen(self, friction: float) -> None:
        """Add friction at the ends, from the loading on; call it before the first stage.

        Ends stick to the plates where friction carries the shear force. Deviation D80.

        Args:
            friction: Friction coefficient [-]; 0: smooth.

        Raises:
            InputError: for a friction out of range, or ends in tension.
        """
        friction = require_number("roughen: friction", friction, END_FRICTION.bounds)
        if friction > 0.0 and self.tension:
            raise InputError(
                f"roughen: friction = {friction:g}, must be 0 for ends that pull; leave it out"
            )
        self._friction = friction

    def confine(self, pressure: float, second: float | None = None) -> None:
        """Press on sides and top, with the bottom fixed, until the forces are in equilibrium.

        In equilibrium the reactions and the mean stress of the specimen differ from the pressures
        by less than 0.1 %, and so do the remaining waves. Strains are counted from this state. The
        larger pressure acts on the top.

        Args:
            pressure: Pressure on the lateral surface of a cylinder, or on all sides of a box [Pa].
            second: Pressure on front and back of a box, across y, instead of `pressure` [Pa].

        Raises:
            InputError: for a second pressure on a cylinder.
            SimulationError: if the forces do not reach equilibrium.
        """
        if second is not None:
            second = require_number("confine: second", second, NOT_NEGATIVE, "Pa")
            if self.built.specimen.kind != "box":
                raise InputError(
                    f"confine: second = {second:g} Pa, must be left out for a "
                    f"{self.built.specimen.kind}, whose lateral surface is one side; leave it out"
                )
        self._second = second
        frame = self._recorder.frame
        # Not in _press(), which a resumed stage passes over: its checkpoint has no record yet. One
        # that has rows keeps its columns.
        begun = self._recorder.loading is not None
        if second is not None and not begun and isinstance(frame, wrapper.EndFrame):
            frame.twoPressures = True
        super().confine(pressure)

    @property
    def confinement(self) -> float | None:
        """Smallest requested pressure on the sides [Pa]; None without pressure."""
        found = [one.pressure for one in self._presses() if TOP not in one.sides]
        return min(found, default=None)

    @property
    def _pressed_part(self) -> Table:
        return {} if self._second is None else {"second": self._second}

    def _new_frame(self) -> wrapper.TestFrame:
        return wrapper.EndFrame(tension=self.tension)

    def _presses(self) -> list[wrapper.ConfinementController]:
        """Pressures on the sides, and on the top until it is driven."""
        kind = wrapper.ConfinementController
        return [one for one in self.built.engines if isinstance(one, kind)]

    def _press(self, pressure: float, ramp: int) -> None:
        second = pressure if self._second is None else self._second
        asked: dict[tuple[int, ...], float] = {(RIGHT,): pressure, (TOP,): max(pressure, second)}
        if self.built.specimen.kind == "box":
            asked = {(RIGHT, LEFT): pressure, (FRONT, BACK): second, (TOP,): max(pressure, second)}
        if self._recorder.loading is not None:
            raise InputError(
                f"confine: pressure = {pressure:g} Pa, must come before the load; the top is driven"
            )
        there = {tuple(one.sides): one for one in self._presses()}
        if not there:
            self._solid.holdBottom(plate=self._friction > 0.0)
            self.built.set_masses()
        for sides, value in asked.items():
            if one := there.get(sides):
                one.startPressure, one.pressure = one.pressure, value
                one.rampSteps, one.rampBegin = ramp, -1
                continue
            one = wrapper.ConfinementController(pressure=value, sides=list(sides), rampSteps=ramp)
            self.built.add_engines(before=(one,))

    def _pressing_force(self) -> float:
        """Smallest force of a pressure on an entire side [N]."""
        sizes = self.built.specimen.dimensions
        width = sizes.get("width", sizes.get("diameter", 0.0))
        across = {BACK: width, FRONT: width}
        lengths = {RIGHT: sizes.get("depth", width), **across}
        forces = [
            one.pressure * lengths[side] * sizes["height"]
            for one in self._presses()
            for side in one.sides
            if side in lengths
        ]
        area = width * lengths[RIGHT] * (1.0 if "depth" in sizes else 0.25 * math.pi)
        forces += [one.pressure * area for one in self._presses() if TOP in one.sides]
        return min((force for force in forces if force > 0.0), default=0.0)

    def _take_hold(self) -> wrapper.LoadingController:
        for one in self._presses():
            if TOP in one.sides:  # what is driven takes over there
                self.built.remove_engines(one)
                self._solid.clearPressure(TOP)
        self._solid.holdEnds(self.tension, self._friction)
        self.built.set_masses()
        ends = wrapper.SolidLoadingController()
        self.built.add_engines(before=(ends,))
        return ends

    def _preloadable(self) -> wrapper.LoadingController:
        return self.built.required(wrapper.SolidLoadingController)

    def _move(self, velocity: float, factor: float) -> None:
        ends = self.built.required(wrapper.SolidLoadingController)
        ends.velocity, ends.velocityFactor = velocity, factor
