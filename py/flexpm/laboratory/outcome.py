# SPDX-License-Identifier: GPL-3.0-or-later
"""Result of a run: the result of its rig, and the measures of its test. SI units."""

from __future__ import annotations

import math

from ..materials.mixing import is_brittle
from ..results.result import Result
from ..rigs.outcome.result import result_of
from ..rigs.part_rig import PartRig
from ..rigs.rig import TestRig
from ..rigs.wave_rig import WaveRig
from ..runs.loading_rate import quasistatic_ratio
from ..runs.run_spec import RunSpec
from .part_tests import measure


def outcome(rig: TestRig, spec: RunSpec) -> Result:
    """Compute the measures of a finished test from its rig and its scene."""
    waiting = spec.loading == "waiting"
    result = result_of(rig, spec.test, _largest_unbalanced(spec), waiting=waiting)
    result.inputs = spec.to_json()
    if isinstance(rig, PartRig):
        measure(result, rig, spec)
    if isinstance(rig, WaveRig):
        result.measure_wave(spec.wave or "", rig.distance)
    for name in spec.kind.no_constants:
        setattr(result, name, None)
    return result


def _largest_unbalanced(spec: RunSpec) -> float:
    """Largest unbalanced-force ratio of a test that is to be quasi-static [-]."""
    if not spec.kind.quasi_static:
        return math.inf
    waiting, brittle = spec.loading == "waiting", is_brittle(spec.material)
    return quasistatic_ratio(
        spec.test, spec.model, waiting=waiting, brittle=brittle, solid=spec.is_solid
    )
