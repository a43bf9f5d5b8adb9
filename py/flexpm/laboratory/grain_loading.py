# SPDX-License-Identifier: GPL-3.0-or-later
"""How the ends and sides of a specimen are loaded, paper Sec. 4.1. SI units.

Deformable grains: boundary nodes are driven and boundary edges pressed directly. Rigid grains:
rigid plates with one-point contacts, sides pressed by a membrane of independent plates.
"""

from __future__ import annotations

from typing import Any, Protocol

from yade import wrapper

from ..models.grains import Model

BOTTOM, RIGHT, TOP, LEFT = range(4)

#: Plates of the membrane on each side, paper Sec. 4.1.
MEMBRANE_PLATES = 16


class Loading(Protocol):
    """Engines that load a built rectangle."""

    def drive(self, built: Model, velocity: float) -> Any:
        """Hold the bottom and move the top.

        Args:
            built: The specimen.
            velocity: Of the top, positive away from the bottom [m/s, or m per step].

        Returns:
            The engine that moves the top.
        """

    def confine(self, built: Model, pressure: float, ramp: int) -> None:
        """Press on the top and the sides, the bottom held.

        Args:
            built: The specimen.
            pressure: On all sides [Pa].
            ramp: Steps over which the pressure rises.
        """

    def ramp(self, built: Model) -> int:
        """Steps over which the pressure of ``confine`` rises."""

    def hold(self, built: Model) -> None:
        """Take the pressure off the top, which is to be driven next, and keep it on the sides."""


class NodeLoading:
    """Boundary nodes and edges, for deformable grains."""

    def drive(self, built: Model, velocity: float) -> Any:
        """Hold the bottom nodes and move the top ones."""
        engine = wrapper.EndDisplacementController(velocity=velocity)
        built.add_engines(before=(engine,))
        return engine

    def confine(self, built: Model, pressure: float, ramp: int) -> None:
        """Press on the boundary edges of top and sides."""
        edges = wrapper.ConfinementController(
            pressure=pressure, sides=[RIGHT, TOP, LEFT], rampSteps=ramp
        )
        built.add_engines(before=(edges, wrapper.EndDisplacementController(holdTop=False)))

    def ramp(self, built: Model) -> int:
        """Steps over which the pressure rises."""
        return int(built.engine("ConfinementController").rampSteps)

    def hold(self, built: Model) -> None:
        """Leave the pressure to the sides; the reaction of the top takes over there."""
        built.engine("ConfinementController").sides = [RIGHT, LEFT]
        built.solver.clearPressure(TOP)
        built.remove_engines(built.engine("EndDisplacementController"))


class PlateLoading:
    """Rigid plates, for rigid grains: the first is the lower one, the second the upper one."""

    def drive(self, built: Model, velocity: float) -> Any:
        """Hold the lower plate and move the upper one; in tension both are bonded."""
        if not built.solver.plates():
            self._lay_ends(built, bonded=velocity > 0.0)
        upper = wrapper.PlateController(
            plates=[1], velocity=(0.0, velocity, 0.0), elasticStart=True
        )
        built.add_engines(before=(upper,))
        return upper

    def confine(self, built: Model, pressure: float, ramp: int) -> None:
        """Press on the upper plate and on a membrane at each side."""
        self._lay_ends(built, bonded=False)
        pressed = [1, *self._lay_membranes(built)]
        built.set_masses()
        engine = wrapper.PlateController(
            plates=pressed, loaded=True, pressure=pressure, rampSteps=ramp
        )
        built.add_engines(before=(engine,))

    def ramp(self, built: Model) -> int:
        """Steps over which the pressure rises."""
        return int(built.engine("PlateController").rampSteps)

    def hold(self, built: Model) -> None:
        """Leave the pressure to the membranes."""
        engine = built.engine("PlateController")
        engine.plates = engine.plates[1:]

    @staticmethod
    def _lay_ends(built: Model, *, bonded: bool) -> None:
        for side in (BOTTOM, TOP):
            built.solver.addSidePlates(side, bonded=bonded)
        built.set_masses()

    @staticmethod
    def _lay_membranes(built: Model) -> list[int]:
        # a short specimen has fewer boundary grains than the paper's has plates
        pieces = min(MEMBRANE_PLATES, int(_height(built) / (2.0 * built.specimen.mean_diameter)))
        plates: list[int] = []
        for side in (LEFT, RIGHT):
            plates += built.solver.addSidePlates(side, pieces=max(pieces, 1))
        return plates


def loading_of(built: Model) -> Loading:
    """The way of loading that fits the model's grains."""
    return NodeLoading() if built.name == "flexible" else PlateLoading()


def squeeze_disc(built: Model, velocity: float) -> Any:
    """Lay a disc between two plates, hold the lower one and move the upper one down.

    Deviation D28: the points that touch first are kept from sliding, else the disc would roll.

    Args:
        built: A disc.
        velocity: Of the upper plate downwards [m/s, or m per step].

    Returns:
        The engine that moves the upper plate.
    """
    for normal in ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0)):
        built.solver.holdSideways(built.solver.addTouchingPlate(normal))
    built.set_masses()
    engine = wrapper.PlateController(plates=[1], velocity=(0.0, -velocity, 0.0))
    built.add_engines(before=(engine,))
    return engine


def _height(built: Model) -> float:
    return float(built.specimen.dimensions["height"])
