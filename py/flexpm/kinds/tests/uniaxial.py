# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression between frictionless ends. Paper Sec. 4.1."""

from ..option import END_FRICTION, control_of, end_friction_of
from ..rates import Rates
from ..test_kind import TestKind, Variant

_CONTROLS = {"axial": "", "lateral": "lateral_strain"}
_INNER = Rates(0.01, 0.005)
_SPHERES = Rates(0.0025, 0.02)

_RATES = {
    "flexible": Rates(
        0.005, 0.0015, (0.0025, 0.06), 0.002, likely_crossings=50, likely_softening=140
    ),
    "rigid": Rates(0.01, 0.004, (0.02, 0.15), 0.005, likely_crossings=150),
    **dict.fromkeys(("inner", "inner-un"), _INNER),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

_SOLID_RATES = {
    "flexible": Rates(0.01, 0.003, (0.008, 0.15), 0.002, 0.32, likely_crossings=58),
    "rigid": Rates(0.02, 0.008, (0.09, 0.5), 0.005, 0.32, likely_crossings=155),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

KIND = TestKind(
    name="uniaxial",
    order=1,
    about="compression of a rectangle, a box or a cylinder between frictionless ends, along its "
    "height",
    variants={
        "rectangle": Variant(
            rates=_RATES,
            static_models=("flexible",),
            results={
                **{"flexible": 5, "rigid": 6, "inner": 4, "inner-un": 3},
                **dict.fromkeys(("jcfpm", "cohfrict"), 2),
            },
        ),
        "box": Variant(_SOLID_RATES, static_models=("flexible", "rigid")),
        "cylinder": Variant(_SOLID_RATES, static_models=("flexible", "rigid")),
    },
    options=(control_of(*_CONTROLS), END_FRICTION),
    settle=end_friction_of,
    confine_hint="; use biaxial",
    controls=_CONTROLS,
    falls_freely=True,
    is_core=True,
    calibrates={
        "compressive_strength": "peak_stress",
        "crack_initiation": ("crack_initiation_stress", "peak_stress"),
        "crack_damage": ("crack_damage_stress", "peak_stress"),
    },
    envelope=True,
    scored="compressed",
)
