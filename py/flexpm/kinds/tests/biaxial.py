# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression under a lateral pressure, which first acts on all sides. Paper Sec. 4.1."""

from ..rates import Rates
from ..test_kind import Stage, TestKind, Variant

_INNER = Rates(0.01, 0.005)
_SPHERES = Rates(0.0025, 0.02)

_RATES = {
    "flexible": Rates(
        0.0025, 0.001, (0.0017, 0.045), 0.003, likely_crossings=85, likely_softening=180
    ),
    "rigid": Rates(0.01, 0.003, (0.022, 0.1), 0.0075, likely_crossings=145),
    **dict.fromkeys(("inner", "inner-un"), _INNER),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

KIND = TestKind(
    name="biaxial",
    other_hint="; use triaxial for 3D specimens",
    order=3,
    about="compression under a confining pressure, which acts on all sides first",
    confined=True,
    variants={
        "rectangle": Variant(
            rates=_RATES,
            # the last: plates of a membrane count by the grain in the unbalanced ratio (D103)
            results={
                "flexible": 7,
                "rigid": 8,
                **dict.fromkeys(("inner", "inner-un"), 6),
                **dict.fromkeys(("jcfpm", "cohfrict"), 3),
            },
        ),
    },
    stages=(Stage.CONFINE, Stage.LOAD),
    falls_freely=True,
    is_core=True,
    envelope=True,
    scored="confined",
)
