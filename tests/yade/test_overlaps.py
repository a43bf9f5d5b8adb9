# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of a broken specimen lie on each other no deeper than the force between them says."""

from __future__ import annotations

import numpy as np
import pytest
import yade

import flexpm

#: Part of the smaller grain that increments of opening lose while faces slide by hundreds of
#: micrometres.
LOST = 2e-3
#: Overlap over what force and stiffness account for where one end of a face is closed, by the
#: weights of its points.
END = 1.5


@pytest.mark.parametrize(
    ("model", "confinement"), [("flexible", 0.0), ("flexible", 12e6), ("rigid", 0.0)]
)
def test_faces_that_were_bonded_do_not_pass_each_other(model, confinement):
    specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.08, seed=1)
    test, limit = ("biaxial", 0.016) if confinement else ("uniaxial", None)
    result = flexpm.run(
        test, specimen, model=model, confinement=confinement, max_strain=limit, report=False
    )
    solver = next(one for one in yade.O.engines if type(one).__name__ == "GrainSolver")
    found = solver.overlaps(1e-3)
    facing = found["facing"].astype(bool)
    grain = found["area"] / found["part"]
    beyond = (found["area"] - END * found["closed"]) / grain
    assert sum(solver.cracks()) > 200
    assert np.all(beyond[facing] < LOST)
    assert result.energy_error < 1e-4


def test_an_intact_specimen_has_no_overlaps():
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, thickness=0.08, seed=1)
    flexpm.run("uniaxial", specimen, max_strain=1e-4)
    solver = next(one for one in yade.O.engines if type(one).__name__ == "GrainSolver")
    assert all(len(column) == 0 for column in solver.overlaps(1e-3).values())
