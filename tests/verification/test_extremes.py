# SPDX-License-Identifier: GPL-3.0-or-later
"""Physics beyond sense: random materials, specimens and tests, each from a seed.

Whatever is asked for ends with a defined status or a refusal, no number of a result is nan, and an
energy error above 1 % is said. Ten cases of the plane and five of solids; by night
(HYPOTHESIS_PROFILE=night) three hundred and a hundred.
"""

from __future__ import annotations

import json
import math
import os
import random
from collections.abc import Callable
from pathlib import Path

import pytest
from fuzz_child import Child

from flexpm.dimensions import is_solid
from flexpm.kinds.model_names import BLOCK_MODELS
from flexpm.kinds.pulse import WAVES
from flexpm.kinds.registry import TESTS, kind_of

CASES, SOLID_CASES = (300, 100) if os.environ.get("HYPOTHESIS_PROFILE") == "night" else (10, 5)
STATUSES = ("ok", "no_peak", "not_quasistatic", "diverged")
#: Refusals and failures that the command answers by one line; "LongError" ends a long test.
ENDS = ("InputError", "SimulationError", "RuntimeError", "LongError")

#: Runs that were drawn once, kept as they were: what is drawn changes with the list of tests.
KEPT = json.loads(Path(__file__).with_name("extreme_runs.json").read_text())


def case(seed: int) -> dict:
    """A run of a small specimen, most of its numbers far from a rock's."""
    draw = random.Random(seed)

    power = _powers_of(draw)
    scale = draw.choice([1.0, 1.0, 1.0, 1e-4, 1e3, power(-3.0, 2.0)])
    test = draw.choice([name for name in TESTS if not is_solid(kind_of(name).shape)])
    others = ["inner-un", "jcfpm", "cohfrict"] if "jcfpm" in kind_of(test).rates else []
    model = draw.choice(["flexible"] * 5 + ["rigid"] * 4 + others)
    smallest = 1e-3 * draw.choice([1.0, 2.0])
    specimen = {
        "kind": {"brazilian": "disc", "scb": "half-disc"}.get(test, "rectangle"),
        "diameters": [scale * smallest, scale * smallest * draw.choice([1.0, 2.0, 4.0])],
        "porosity": draw.choice([0.01, 0.1, 0.4]),
        "thickness": scale * draw.choice([1e-2, power(-4.0, 0.0)]),
        "seed": draw.randrange(1000),
    }
    if specimen["kind"] != "rectangle":
        specimen["diameter"] = scale * draw.uniform(0.008, 0.016)
    else:
        slender = {"bending": [0.25, 0.5], "sonic": [2.0]}.get(test, [0.5, 1.0, 2.0, 3.0])
        specimen["width"] = scale * draw.uniform(0.008, 0.016)
        specimen["height"] = specimen["width"] * draw.choice(slender)
    side = min(specimen[name] for name in ("diameter", "width", "height") if name in specimen)
    largest = {"scb": 0.2, "sonic": 0.039}.get(test, 0.4) * side
    specimen["diameters"] = [min(one, largest) for one in specimen["diameters"]]
    material = _rock(draw, power, model)
    options = {"rate": power(0.5, 2.5), "stop_ratio": draw.choice([0.2, 0.5, 0.9])}
    if test == "biaxial":
        options["confinement"] = draw.choice([0.0, power(4.0, 9.0)])
    if test == "bending":
        options["notch"] = specimen["height"] * draw.choice([0.0, 0.3, 0.8])
    options = _of_test(draw, power, options, test, model)
    if test != "sonic" and model == "flexible" and draw.random() < 0.15:
        options |= {"dynamic": True, "gravity": draw.choice([0.0, 9.81, 1e6])}
    joints = {}
    if draw.random() < 0.25:
        across = specimen.get("width", specimen.get("diameter"))
        joints["cut"] = [[-across, power(-2.0, 0.0) * side], [2.0 * across, 0.5 * side]]
        material |= {f"joint.cut.{key}": value for key, value in _joint(draw, power).items()}
    # drawn last: what is above stays what it was of a seed
    if test != "sonic" and draw.random() < 0.2:
        options["damping"] = draw.choice([0.0, 0.2, 0.99])
    if model in ("jcfpm", "cohfrict") and draw.random() < 0.5:
        options["interaction_range"] = draw.choice([1.0, 1.3, 2.0])
    minerals = draw.random() < 0.2
    if minerals:
        pair = draw.choice(["hard/soft", "soft/soft"])
        for key in ("tensile_strength", "cohesion"):
            material[f"interface.{pair}.{draw.choice(['', 'factor.'])}{key}"] = 1.0
        for key in [one for one in material if one.startswith("interface.")]:
            usual = 1.0 if "factor" in key else material[key.rpartition(".")[2]]
            material[key] = usual * power(-2.0, 1.0)
    return {"test": test, "model": model, "specimen": specimen, "material": material} | {
        "options": options,
        "joints": joints,
        "minerals": minerals,
    }


def solid_case(seed: int) -> dict:
    """The same of a solid of some dozen to some hundred grains."""
    draw = random.Random(seed)
    power = _powers_of(draw)
    scale = draw.choice([1.0, 1.0, 1.0, 1e-4, 1e3, power(-3.0, 2.0)])
    # half of all on plain cores and discs, half on what any test takes
    plain = ("uniaxial", "tension", "triaxial", "brazilian")
    any_solid = [name for name in TESTS if kind_of(name).solids]
    test = draw.choice(plain if draw.random() < 0.5 else any_solid)
    kind = kind_of(test)
    shape = draw.choice(kind.solids)
    # a pulse in deformable grains takes more steps than anybody waits for
    blocks = ["flexible"] * 5 * (test != "sonic") + ["rigid"] * 4
    model = draw.choice(blocks + [one for one in kind.models_of(shape) if one not in BLOCK_MODELS])
    sizes = {
        "bending": {"width": (0.024, 0.03), "depth": (0.006, 0.008), "height": (0.007, 0.009)},
        "punch": {"width": (0.026, 0.032), "depth": (0.005, 0.007), "height": (0.016, 0.02)},
        "sonic": {"width": (0.005, 0.006), "depth": (0.005, 0.006), "height": (0.14, 0.16)},
        "scb": {"diameter": (0.02, 0.026), "depth": (0.005, 0.008)},
        "brazilian": {"diameter": (0.009, 0.013), "depth": (0.005, 0.01)},
    }.get(test, {"width": (0.006, 0.01), "depth": (0.006, 0.01), "height": (0.008, 0.016)})
    if shape == "cylinder":
        sizes = {"diameter": sizes["width"], "height": sizes["height"]}
    smallest = 2e-3 * draw.choice([1.0, 1.25])
    specimen = {"kind": shape} | {
        name: scale * draw.uniform(*bounds) for name, bounds in sizes.items()
    }
    largest = 0.5 * min(specimen[name] for name in sizes)
    graded = (smallest, smallest * draw.choice([1.0, 1.2, 1.8]))
    specimen |= {
        "diameters": [min(scale * one, largest) for one in graded],
        "porosity": draw.choice([0.05, 0.1, 0.4]),
        "seed": draw.randrange(1000),
    }
    material = _rock(draw, power, model)
    options: dict = {"rate": power(1.0, 2.5), "stop_ratio": draw.choice([0.2, 0.5, 0.9])}
    if kind.confined:
        options["confinement"] = draw.choice([0.0, power(4.0, 9.0)])
    if test == "triaxial" and shape == "box" and draw.random() < 0.5:
        options["second_confinement"] = power(4.0, 9.0)
    if kind.has("end_friction") and draw.random() < 0.4:
        options["end_friction"] = draw.choice([0.05, 0.6, 10.0])
    if kind.has("notch") and "height" in specimen:
        options["notch"] = specimen["height"] * draw.choice([0.0, 0.2, 0.6])
    if kind.has("jaw_radius") and draw.random() < 0.5:
        options["jaw_radius"] = specimen["diameter"] * draw.choice([0.55, 0.75, 3.0])
    options = _of_test(draw, power, options, test, model)
    if test != "sonic" and draw.random() < 0.2:
        options["damping"] = draw.choice([0.0, 0.2, 0.99])
    if model not in BLOCK_MODELS and draw.random() < 0.5:
        options["interaction_range"] = draw.choice([1.0, 1.3, 2.0])
    return {"test": test, "model": model, "specimen": specimen, "material": material} | {
        "options": options,
        "joints": {},
        "minerals": draw.random() < 0.2,
    }


def _powers_of(draw: random.Random) -> Callable[[float, float], float]:
    def power(low: float, high: float) -> float:
        return 10.0 ** draw.uniform(low, high)

    return power


def _of_test(
    draw: random.Random,
    power: Callable[[float, float], float],
    options: dict,
    test: str,
    model: str,
) -> dict:
    """The same options with what the test alone takes, and without what it does not."""
    if model in BLOCK_MODELS and kind_of(test).controls:
        options["control"] = draw.choice(tuple(kind_of(test).controls))
    if test in ("shear", "punch"):
        del options["stop_ratio"]
    if test == "shear":
        options["normal_stress"] = draw.choice([1e6, power(3.0, 10.0)])
    return {"wave": draw.choice(WAVES)} if test == "sonic" else options


def _rock(draw: random.Random, power: Callable[[float, float], float], model: str) -> dict:
    """Keys of a material of one mineral."""
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
    if model != "flexible":  # whose grains alone deform
        del material["young"], material["poisson"], material["plane"]
    if material["softening"] == "bilinear":
        stiffness = material["normal_stiffness"]
        ductile = power(0.0, 3.0)
        material["tensile_fracture_energy"] = (
            ductile * material["tensile_strength"] ** 2 / (2.0 * stiffness)
        )
        material["shear_fracture_energy"] = (
            ductile * material["cohesion"] ** 2 / (2.0 * stiffness * material["shear_ratio"])
        )
    return material


def _joint(draw: random.Random, power: Callable[[float, float], float]) -> dict:
    if draw.random() < 0.3:
        return {"open": True}
    dilating = {"friction": 0.5, "dilation_angle": 5.0, "dilation_slip": 1e-4 * power(-3.0, 1.0)}
    return {
        "normal_stiffness": 1e14 * power(-2.0, 2.0),
        "shear_stiffness": 3e13 * power(-2.0, 2.0),
        "cohesion": draw.choice([0.0, power(4.0, 8.0)]),
        "tensile_strength": draw.choice([0.0, power(4.0, 8.0)]),
        **draw.choice([{"friction": 0.0}, {"friction": 3.0}, dilating]),
    }


@pytest.fixture(scope="module")
def child():
    one = Child("physics")
    yield one
    one.close()


@pytest.mark.long
@pytest.mark.parametrize("seed", range(CASES))
def test_whatever_is_asked_for_ends_with_a_status_and_numbers(child, seed):
    _require_an_end(child, case(seed), f"case {seed}")


@pytest.mark.long
@pytest.mark.parametrize("seed", range(SOLID_CASES))
def test_whatever_is_asked_for_of_a_solid_ends_with_a_status_and_numbers(child, seed):
    _require_an_end(child, solid_case(seed), f"solid case {seed}")


def _require_an_end(child: Child, asked: dict, name: str) -> None:
    found = child.run(asked)
    where = f"{name}: {asked}: {found}"
    if "error" in found:
        assert found["error"].startswith(ENDS), where
        assert "\n" not in found["error"], where
        # what is wrong with an input is said before the first step
        assert not (found["error"].startswith("InputError") and found["steps"] > 0), where
        return
    assert found["status"] in STATUSES, where
    assert found["infinite"] == [], where
    error = found["energy_error"]
    if error is not None and not (math.isfinite(error) and error <= 0.01):
        assert found["status"] in ("not_quasistatic", "diverged"), where
        assert found["warnings"] or found["status"] == "diverged", where


@pytest.mark.long
def test_a_notch_that_cuts_a_beam_of_few_grains_through_is_refused(child):
    error = child.run(KEPT["cut-through"])["error"]
    assert error.startswith("InputError: run: notch = "), error


@pytest.mark.long
def test_half_a_disc_that_an_open_joint_cuts_is_loaded(child):
    """Its faces bear pressure, though points of the platen lift off in the elastic solution."""
    found = child.run(KEPT["on-a-joint"])
    assert found.get("status") in STATUSES or found["error"].startswith("LongError"), found


@pytest.mark.long
def test_a_specimen_with_a_joint_that_is_blown_apart_has_a_status(child):
    """Its platen presses with more than the rock bears; nothing is left that a joint could feel."""
    assert child.run(KEPT["blown-apart"])["status"] == "diverged"
