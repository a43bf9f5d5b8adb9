# SPDX-License-Identifier: GPL-3.0-or-later
"""Cracks of YADE's own bonded models, detected from the state of their bonds. SI units.

A bond that is neither broken nor present has been erased by a script, which is not a crack.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence

import numpy as np
import yade
from yade import wrapper

from ..arrays import BoolArray, FloatArray
from ..files import Table
from ..results.cracks import ERASED, SHEAR, TENSILE
from .sphere_bonds import Bonds, in_order
from .sphere_laws import SphereLaw

_FOUND = ("steps", "modes", "places")


def body_with(number: int) -> wrapper.Body | None:
    """Return the body with an ID, or None if it was erased."""
    bodies = yade.O.bodies
    return bodies[number] if number < len(bodies) else None


class CrackWatch:
    """Detection of broken and erased bonds, with step, mode and position."""

    def __init__(
        self,
        kind: SphereLaw,
        law: wrapper.Functor,
        interactions: Sequence[wrapper.Interaction | None],
        bonds: Bonds,
        bodies: Sequence[int],
    ) -> None:
        """Watch bonds from the present state on.

        Args:
            kind: Law with the criterion for broken bonds.
            law: Functor of the contact law.
            interactions: Interaction of each bond.
            bonds: Properties of the bonds.
            bodies: Body ID of each grain.
        """
        self._kind, self._bonds, self._bodies = kind, bonds, bodies
        self.rebind(law, interactions)
        self._axes = bonds.ends.shape[2]
        self.steps = np.full(len(bonds), -1)
        self.modes = np.zeros(len(bonds), dtype=int)
        self.places = bonds.ends.mean(axis=1)
        self._start = np.array([self._centre(grain) for grain in range(len(bodies))])

    def rebind(
        self, law: wrapper.Functor, interactions: Sequence[wrapper.Interaction | None]
    ) -> None:
        """Watch the same bonds in a loaded scene; None stands for a lost bond."""
        self._law, self.interactions = law, interactions
        # YADE drops both when the bond is lost; kept here, they still tell how that came
        self.contacts = [None if one is None else one.phys for one in interactions]
        self._shapes = [None if one is None else one.geom for one in interactions]

    def memory(self) -> Table:
        """Return steps, modes and positions found until now, as plain values."""
        self.look_for_erased()
        found = (self.steps, self.modes, self.places)
        return dict(zip(_FOUND, (array.tolist() for array in found), strict=True))

    def recall(self, memory: Table) -> None:
        """Restore the values that :meth:`memory` returned."""
        self.steps, self.modes, self.places = (np.array(memory[name]) for name in _FOUND)

    @property
    def counts(self) -> tuple[int, int]:
        """Numbers of tensile and shear cracks."""
        return int(np.sum(self.modes == TENSILE)), int(np.sum(self.modes == SHEAR))

    @property
    def alive(self) -> BoolArray:
        """Whether the body of each grain exists, (n,)."""
        return np.array([body_with(number) is not None for number in self._bodies])

    @property
    def erased(self) -> BoolArray:
        """Whether a script had erased each bond or a grain of it at the last look, (n,)."""
        gone: BoolArray = (self.modes == ERASED) | ~self.alive[self._bonds.grains].all(axis=1)
        return gone

    def look(self) -> None:
        """Record the bonds that have broken since the last call."""
        if not self._kind.may_have_broken(self._law, sum(self.counts)):
            return
        for row in np.flatnonzero(self.steps < 0).tolist():
            if self._has_broken(row):
                self._note(row, self._mode(self.contacts[row], row))

    def look_for_erased(self) -> None:
        """Record the bonds that a script has erased since the last call."""
        for row in np.flatnonzero(self.steps < 0).tolist():
            if self._has_broken(row):
                continue  # for the next look
            now = self.interactions[row]
            if now is None or not now.isReal or not self._kind.is_bond(now.phys):
                self._note(row, ERASED)

    @contextlib.contextmanager
    def forgetting(self) -> Iterator[None]:
        """Forget what is found until the end of the block, so that the next look finds it again."""
        before = self.steps.copy(), self.modes.copy(), self.places.copy()
        try:
            yield
        finally:
            self.steps, self.modes, self.places = before

    def _has_broken(self, row: int) -> bool:
        bond, shape = self.contacts[row], self._shapes[row]
        return bond is not None and shape is not None and self._kind.has_broken(bond, shape)

    def _note(self, row: int, mode: int) -> None:
        self.steps[row] = yade.O.iter
        self.modes[row] = mode
        self.places[row] += self._moved(row)

    def _mode(self, bond: wrapper.IPhys, row: int) -> int:
        tension = -self._normal_force(bond, row)
        return TENSILE if self._kind.is_tensile(bond, tension, self._bonds, row) else SHEAR

    def _normal_force(self, bond: wrapper.IPhys, row: int) -> float:
        """Return the force in the last step before the bond broke, compression positive [N]."""
        first, second = self._bonds.grains[row]
        force = bond.normalForce
        along = self._centre(second) - self._centre(first)
        product = in_order(force[axis] * along[axis] for axis in range(self._axes))
        return float(product) / float(np.hypot.reduce(along))

    def _moved(self, row: int) -> FloatArray:
        grains = self._bonds.grains[row]
        now = np.array([self._centre(grain) for grain in grains])
        moved: FloatArray = (now - self._start[grains]).mean(axis=0)
        return moved

    def _centre(self, grain: int) -> FloatArray:
        """Return the present centre of a grain, or the initial centre of an erased grain [m]."""
        body = body_with(self._bodies[grain])
        if body is None:
            start: FloatArray = self._start[grain]
            return start
        return np.array([body.state.pos[axis] for axis in range(self._axes)])
