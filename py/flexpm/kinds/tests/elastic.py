# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic constants of a rectangle by one direct solve, which is no simulation."""

from ..model_names import GRAIN_MODELS
from ..test_kind import Rig, TestKind

KIND = TestKind(
    name="elastic",
    order=99,
    about="elastic constants of a rectangle by one direct solve",
    models=GRAIN_MODELS,
    without=(
        *("rate", "max_strain", "stop_ratio", "dynamic", "gravity", "damping", "start", "loading"),
    ),
    rig=Rig.NONE,
    stages=(),
    calibrates={name: name for name in ("youngs_modulus", "poissons_ratio")},
)
