# SPDX-License-Identifier: GPL-3.0-or-later
"""Physics beyond sense: random materials, specimens and tests, each from a seed.

Whatever is asked for ends with a defined status or a refusal, no number of a result is nan, and an
energy error above 1 % is said. Ten cases; by night (HYPOTHESIS_PROFILE=night) three hundred.
"""

from __future__ import annotations

import math
import os
import random

import pytest
from fuzz_child import Child

CASES = 300 if os.environ.get("HYPOTHESIS_PROFILE") == "night" else 10
STATUSES = ("ok", "no_peak", "not_quasistatic", "diverged")
#: Refusals and failures that the command answers by one line; "LongError" ends a long test.
ENDS = ("InputError", "SimulationError", "RuntimeError", "LongError")


def case(seed: int) -> dict:
    """A run of a small specimen, most of its numbers far from a rock's."""
    draw = random.Random(seed)

    def power(low: float, high: float) -> float:
        return 10.0 ** draw.uniform(low, high)

    scale = draw.choice([1.0, 1.0, 1.0, 1e-4, 1e3, power(-3.0, 2.0)])
    test = draw.choice(["uniaxial", "tension", "biaxial", "brazilian"])
    model = draw.choice(["flexible"] * 5 + ["rigid"] * 4 + ["inner-un", "jcfpm", "cohfrict"])
    smallest = 1e-3 * draw.choice([1.0, 2.0])
    specimen = {
        "kind": "disc" if test == "brazilian" else "rectangle",
        "diameters": [scale * smallest, scale * smallest * draw.choice([1.0, 2.0, 4.0])],
        "porosity": draw.choice([0.01, 0.1, 0.4]),
        "thickness": scale * draw.choice([1e-2, power(-4.0, 0.0)]),
        "seed": draw.randrange(1000),
    }
    if test == "brazilian":
        specimen["diameter"] = scale * draw.uniform(0.008, 0.016)
    else:
        specimen["width"] = scale * draw.uniform(0.008, 0.016)
        specimen["height"] = specimen["width"] * draw.choice([0.5, 1.0, 2.0, 3.0])
    side = min(specimen[name] for name in ("diameter", "width", "height") if name in specimen)
    specimen["diameters"] = [min(one, 0.4 * side) for one in specimen["diameters"]]
    material = {
        "young": 25.8e9 * power(-2.0, 2.0),
        "poisson": draw.choice([1e-6, 0.23, 0.45, 0.499]),
        "normal_stiffness": 1e13 * power(-2.0, 2.0),
        "shear_ratio": draw.choice([0.05, 0.28, 1.0, 2.0]),
        "tensile_strength": 1e7 * power(-3.0, 1.0),
        "cohesion": 3e7 * power(-3.0, 1.0),
        "friction": draw.choice([0.0, 0.4, 1.0, 3.0]),
        "plane": draw.choice(["stress", "strain"]),
        "softening": draw.choice(["brittle", "bilinear"]),
    }
    if material["softening"] == "bilinear":
        stiffness = material["normal_stiffness"]
        ductile = power(0.0, 3.0)
        material["tensile_fracture_energy"] = (
            ductile * material["tensile_strength"] ** 2 / (2.0 * stiffness)
        )
        material["shear_fracture_energy"] = (
            ductile * material["cohesion"] ** 2 / (2.0 * stiffness * material["shear_ratio"])
        )
    options = {"rate": power(0.5, 2.5), "stop_ratio": draw.choice([0.2, 0.5, 0.9])}
    if test == "biaxial":
        options["confinement"] = draw.choice([0.0, power(4.0, 9.0)])
    if model == "flexible" and draw.random() < 0.15:
        options |= {"dynamic": True, "gravity": draw.choice([0.0, 9.81, 1e6])}
    return {"test": test, "model": model, "specimen": specimen, "material": material} | {
        "options": options
    }


@pytest.fixture(scope="module")
def child():
    one = Child("physics")
    yield one
    one.close()


@pytest.mark.long
@pytest.mark.parametrize("seed", range(CASES))
def test_whatever_is_asked_for_ends_with_a_status_and_numbers(child, seed):
    asked = case(seed)
    found = child.run(asked)
    where = f"case {seed}: {asked}: {found}"
    if "error" in found:
        assert found["error"].startswith(ENDS), where
        assert "\n" not in found["error"], where
        return
    assert found["status"] in STATUSES, where
    assert found["infinite"] == [], where
    error = found["energy_error"]
    if error is not None and not (math.isfinite(error) and error <= 0.01):
        assert found["status"] in ("not_quasistatic", "diverged"), where
        assert found["warnings"] or found["status"] == "diverged", where
