# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression of a disc between two plates. Paper Sec. 4.1."""

from ..rates import Rates
from ..test_kind import TestKind
from ..words import Words, strain, stress

_INNER = Rates(0.01, 0.005)
_SPHERES = Rates(0.0025, 0.02)

KIND = TestKind(
    name="brazilian",
    order=4,
    about="compression of a disc between two plates, whose axial stress is 2 P / (pi D t), P the "
    "force, D the diameter, t the thickness",
    shape="disc",
    solids=("solid-disc",),
    results={
        **dict.fromkeys(("flexible", "rigid"), 5),
        **dict.fromkeys(("inner", "inner-un"), 4),
        **dict.fromkeys(("jcfpm", "cohfrict"), 3),
    },
    rates={
        "flexible": Rates(0.01, 0.008, (0.033, 0.028), 0.01, likely_crossings=42),
        "rigid": Rates(0.01, 0.012, (0.09, 0.06), 0.006, likely_crossings=100),
        **dict.fromkeys(("inner", "inner-un"), _INNER),
        **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
    },
    solid_rates={
        "flexible": Rates(0.01, 0.008, (0.033, 0.028), 0.01, likely_crossings=42),
        "rigid": Rates(0.01, 0.012, (0.09, 0.06), 0.006, likely_crossings=100),
    },
    largest_strain=16.0,  # plates press into discs, which softening lets carry more
    falls_freely=True,
    regains=True,
    pulled=True,
    # slopes of the plates' closure
    no_constants=("youngs_modulus", "poissons_ratio", "elastic_poissons_ratio"),
    words=Words(
        strain("closure of the plates / D"),
        stress("stress 2 P / (π D t)"),
        "peak of 2 P / (pi D t)",
    ),
    calibrates={"indirect_tensile_strength": "peak_stress"},
)
