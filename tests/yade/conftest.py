# SPDX-License-Identifier: GPL-3.0-or-later
"""A small specimen, built and pulled, for the tests of what YADE sees of it."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scenes import fresh
from step_clock import step_clock

import flexpm

# importing flexpm has told Python where YADE is
wrapper = importlib.import_module("yade.wrapper")

#: Opening speed of the ends [m/step]: fast, so that contacts break within some thousand steps.
PULL = 5e-9
#: Of a box [m].
SOLID_SIZES = (0.008, 0.008, 0.014)


@pytest.fixture(scope="session")
def specimen() -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=1)


@pytest.fixture(scope="session")
def disc() -> flexpm.Specimen:
    return flexpm.Specimen.disc(0.02, 0.01, seed=1)


@pytest.fixture
def make(specimen: flexpm.Specimen) -> Callable[..., flexpm.Model]:
    """Build the specimen in an empty scene, its ends driven at `velocity` if that is given."""

    def made(velocity: float | None = None, **options: Any) -> flexpm.Model:
        wrapper.Omega().reset()
        model = flexpm.build(specimen, **options)
        if velocity is not None:
            model.add_engines(before=(wrapper.EndDisplacementController(velocity=velocity),))
        return model

    return made


@pytest.fixture(scope="session")
def box():
    return flexpm.Specimen.box(*SOLID_SIZES, seed=1)


@pytest.fixture
def solid(box):
    """Build the box in an empty scene, its top driven at `velocity` if that is given."""

    def made(model="flexible", velocity=None):
        built = fresh(box, model=model)
        if velocity is not None:
            built.solver.holdEnds(velocity > 0.0)
            built.set_masses()
            ends = wrapper.SolidLoadingController(velocity=velocity)
            built.add_engines(before=(ends,))
        return built

    return made


@pytest.fixture(params=["make", "solid"])
def either(request: pytest.FixtureRequest) -> Callable[..., flexpm.Model]:
    """Build a specimen of 2D or 3D in an empty scene."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def half_broken(make: Callable[..., flexpm.Model]) -> flexpm.Model:
    """A specimen in tension of which some points are damaged and some contacts broken in part."""
    model = make(PULL)
    while sum(model.solver.cracks()) < 3:
        model.run(100)
        assert wrapper.Omega().iter < 10000, "no contact broke"
    snapshot = model.snapshot()
    damage = snapshot.point_damage
    assert ((damage > 0.0) & (damage < 1.0)).any()
    assert (snapshot.any_of(damage == 1.0) & snapshot.any_of(damage < 1.0)).any()
    return model


@pytest.fixture
def look_each_tenth_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a test call its progress each tenth step, on a machine of any speed."""
    step_clock(monkeypatch.setattr, look=10)


def solver_of_scene() -> Any:
    """The solver of the present scene, which loading a file replaces."""
    return next(e for e in wrapper.Omega().engines if isinstance(e, wrapper.GrainSolver))


@pytest.fixture
def scene_solver() -> Callable[[], Any]:
    return solver_of_scene


@pytest.fixture
def bits() -> Callable[[], dict[str, bytes]]:
    """All arrays of the present scene, its energies and the bodies' positions, as bytes."""

    def read() -> dict[str, bytes]:
        solver = solver_of_scene()
        omega = wrapper.Omega()
        found = {name: values.tobytes() for name, values in solver.snapshot().items()}
        found["energies"] = np.array(list(solver.energies().values())).tobytes()
        states = [(*b.state.pos, *b.state.vel) for b in omega.bodies if b is not None]
        found["states"] = np.array(states).tobytes()
        found["step"] = str(omega.iter).encode()
        return found

    return read
