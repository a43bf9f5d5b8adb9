# SPDX-License-Identifier: GPL-3.0-or-later
"""Cracks of YADE's own bonded models, found by looking at their bonds. SI units."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import yade
from yade import wrapper

from ..arrays import FloatArray
from ..files import Table
from ..results.cracks import SHEAR, TENSILE
from .sphere_bonds import Bonds
from .sphere_laws import SphereLaw

_FOUND = ("steps", "modes", "places")


class CrackWatch:
    """Finds bonds that have broken, with step, mode and place."""

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
            kind: What tells that a bond has broken.
            law: The contact law's functor.
            interactions: One for each bond.
            bonds: Their properties.
            bodies: Body of each grain.
        """
        self._kind, self._bonds, self._bodies = kind, bonds, bodies
        self.rebind(law, interactions)
        self.steps = np.full(len(bonds), -1)
        self.modes = np.zeros(len(bonds), dtype=int)
        self.places = bonds.ends.mean(axis=1)
        self._start = np.array([self._centre(grain) for grain in range(len(bodies))])

    def rebind(
        self, law: wrapper.Functor, interactions: Sequence[wrapper.Interaction | None]
    ) -> None:
        """Watch the same bonds in a scene that has been loaded; None stands for a lost one."""
        self._law, self.interactions = law, interactions
        # YADE drops this when the bond is lost; kept here, it still tells how that came
        self.contacts = [None if one is None else one.phys for one in interactions]

    def memory(self) -> Table:
        """What has been found, as plain values."""
        found = (self.steps, self.modes, self.places)
        return dict(zip(_FOUND, (array.tolist() for array in found), strict=True))

    def recall(self, memory: Table) -> None:
        """Take over what :meth:`memory` gave."""
        self.steps, self.modes, self.places = (np.array(memory[name]) for name in _FOUND)

    @property
    def counts(self) -> tuple[int, int]:
        """Numbers of tensile and of shear cracks."""
        return int(np.sum(self.modes == TENSILE)), int(np.sum(self.modes == SHEAR))

    def look(self) -> None:
        """Take note of the bonds that have broken since the last look."""
        if not self._kind.may_have_broken(self._law, int(np.sum(self.steps >= 0))):
            return
        for row in np.flatnonzero(self.steps < 0).tolist():
            bond = self.contacts[row]
            if bond is not None and self._kind.has_broken(self.interactions[row], bond):
                self.steps[row] = yade.O.iter
                self.modes[row] = self._mode(bond, row)
                self.places[row] += self._moved(row)

    def _mode(self, bond: wrapper.IPhys, row: int) -> int:
        tension = -self._normal_force(bond, row)
        return TENSILE if self._kind.is_tensile(bond, tension, self._bonds, row) else SHEAR

    def _normal_force(self, bond: wrapper.IPhys, row: int) -> float:
        """Of the last step before the bond broke, compression positive [N]."""
        first, second = self._bonds.grains[row]
        force = bond.normalForce
        along = self._centre(second) - self._centre(first)
        return float(force[0] * along[0] + force[1] * along[1]) / float(np.hypot(*along))

    def _moved(self, row: int) -> FloatArray:
        grains = self._bonds.grains[row]
        now = np.array([self._centre(grain) for grain in grains])
        moved: FloatArray = (now - self._start[grains]).mean(axis=0)
        return moved

    def _centre(self, grain: int) -> FloatArray:
        place = yade.O.bodies[self._bodies[grain]].state.pos
        return np.array([place[0], place[1]])
