# SPDX-License-Identifier: GPL-3.0-or-later
"""The rig of a solid, whose ends move along its axis, paper Sec. 4.1 in space. SI units."""

from __future__ import annotations

from yade import wrapper

from ...errors import InputError
from ...results import doubts
from ..grain_rig import GrainRig
from ..readings import Balance


class EndRig(GrainRig):
    """Both ends of a solid, along z: nodes of deformable grains, plates on rigid ones."""

    def _new_frame(self) -> wrapper.TestFrame:
        return wrapper.EndFrame(tension=self.tension)

    def _press(self, pressure: float, ramp: int) -> None:
        raise InputError(
            f"confine: pressure = {pressure:g} Pa, must not be put on a solid; triaxial, its test "
            "under pressure, is still to come"
        )

    def balance(self) -> Balance:
        """Refused: balance is asked of pressures, which solids are not under yet."""
        raise InputError("balance: specimen = a solid, must be plane; rig.unbalanced() is of both")

    def _take_hold(self) -> wrapper.LoadingController:
        solver = self.built.solver
        assert isinstance(solver, wrapper.SolidSolver)
        solver.holdEnds(self.tension)
        self.built.set_masses()
        ends = wrapper.SolidEndsController()
        self.built.add_engines(before=(ends,))
        return ends

    def _move(self, velocity: float, factor: float) -> None:
        ends = self.built.required(wrapper.SolidEndsController)
        ends.velocity, ends.velocityFactor = velocity, factor

    def _measures(self) -> tuple[str, ...]:
        return ()

    @property
    def warnings(self) -> list[str]:
        """What makes the record doubtful, see `GrainRig.warnings`; grains that lie on others."""
        solver = self.built.solver
        assert isinstance(solver, wrapper.SolidSolver)
        return super().warnings + doubts.of_overlap(solver.overlaps()["of_diameter"])
