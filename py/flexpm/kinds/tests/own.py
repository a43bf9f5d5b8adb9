# SPDX-License-Identifier: GPL-3.0-or-later
"""Custom test of a script, between parts that the script adds."""

from ..model_names import BLOCK_MODELS
from ..rates import Rates
from ..test_kind import Rig, TestKind, Variant
from ..words import Drawn, Words

_RATES = Rates(0.01, running_share=0.01, likely_crossings=60)
#: All shapes of a dimension have it.
_VARIANT = Variant(dict.fromkeys(BLOCK_MODELS, _RATES))

KIND = TestKind(
    name="own",
    order=0,
    about="a custom test of a script",
    variants={
        "rectangle": _VARIANT,
        "box": _VARIANT,
    },
    rig=Rig.PARTS,
    stages=(),
    needs_peak=False,  # a script says when it is over
    words=Words(
        Drawn("axial_strain", "displacement over length", 1.0, "SI"),
        Drawn("axial_stress", "load over area", 1.0, "SI"),
    ),
)
