# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct tension of the ends of a rectangle. Paper Sec. 4.1."""

from ..rates import Rates
from ..test_kind import Rig, TestKind, Variant

_INNER = Rates(0.01, 0.005)
_SPHERES = Rates(0.01, 0.02)

_RATES = {
    "flexible": Rates(0.01, 0.0045, (0.005, 0.6), 0.01, likely_crossings=6, likely_softening=140),
    "rigid": Rates(0.02, 0.005, (0.017, 0.1), 0.02, likely_crossings=18, likely_softening=150),
    **dict.fromkeys(("inner", "inner-un"), _INNER),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

_SOLID_RATES = {
    "flexible": Rates(
        0.02, 0.009, (0.018, 0.6), 0.01, 0.32, likely_crossings=14, likely_softening=190
    ),
    "rigid": Rates(0.04, 0.01, (0.07, 0.5), 0.02, 0.32, likely_crossings=32, likely_softening=150),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

KIND = TestKind(
    name="tension",
    order=2,
    about="direct tension of the same specimens between the same ends",
    variants={
        "rectangle": Variant(
            rates=_RATES,
            static_models=("flexible",),
            static_first=True,
            results={
                **dict.fromkeys(("flexible", "rigid"), 5),
                **dict.fromkeys(("inner", "inner-un"), 3),
                **dict.fromkeys(("jcfpm", "cohfrict"), 2),
            },
        ),
        "box": Variant(_SOLID_RATES, static_models=("flexible", "rigid")),
        "cylinder": Variant(_SOLID_RATES, static_models=("flexible", "rigid")),
    },
    confine_hint="; use biaxial",
    rig=Rig.ENDS,
    pulls=True,
    falls_freely=True,
    pulled=True,
    calibrates={"direct_tensile_strength": "peak_stress"},
    scored="pulled",
)
