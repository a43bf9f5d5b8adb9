# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic constants of a rectangle or a 3D specimen by a single static solve without steps."""

from ..model_names import BLOCK_MODELS, GRAIN_MODELS
from ..test_kind import Rig, TestKind, Variant

KIND = TestKind(
    name="elastic",
    order=99,
    about="elastic constants of a rectangle, a box or a cylinder by one static solution",
    variants={
        "rectangle": Variant(only_models=GRAIN_MODELS),
        "box": Variant(only_models=BLOCK_MODELS),
        "cylinder": Variant(only_models=BLOCK_MODELS),
    },
    without=(
        *("rate", "max_strain", "stop_ratio", "dynamic", "gravity", "damping", "start", "loading"),
    ),
    rig=Rig.NONE,
    stages=(),
    calibrates={name: name for name in ("youngs_modulus", "poissons_ratio")},
    scored="solved",
)
