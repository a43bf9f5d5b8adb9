# SPDX-License-Identifier: GPL-3.0-or-later
"""Compression of a disc between two plates, or two jaws. Paper Sec. 4.1, deviations D28, D95."""

from __future__ import annotations

from collections.abc import Mapping

from ...dimensions import refused
from ...errors import InputError
from ..model_names import BLOCK_MODELS
from ..option import JAW_RADIUS, Asked, Option, Value
from ..rates import Rates
from ..test_kind import TestKind, Variant
from ..words import Words, strain, stress

#: Largest radius of a jaw over that of the disc, beyond which it is flat [-].
_WIDEST = 1e4
_INNER = Rates(0.01, 0.005)
_SPHERES = Rates(0.0025, 0.02)


def _settle(asked: Asked) -> Mapping[str, Value]:
    name = JAW_RADIUS
    if asked.values.get(name) is None:
        return {}
    least = 0.5 * asked.sizes["diameter"]
    radius = asked.number(name, least)
    if "depth" not in asked.sizes:
        raise refused(f"run: {name} = {radius:g} m, must be left out for a disc", name)
    if not least < radius <= _WIDEST * least:
        raise InputError(
            f"run: {name} = {radius:g} m, must be > {least:g} m, the radius of the disc, and <= "
            f"{_WIDEST:g} times this radius; the ISRM suggests 1.5 times the radius"
        )
    return {name: radius}


_RATES = {
    "flexible": Rates(0.01, 0.008, (0.033, 0.028), 0.01, likely_crossings=85),
    "rigid": Rates(0.01, 0.012, (0.09, 0.06), 0.006, likely_crossings=180),
    **dict.fromkeys(("inner", "inner-un"), _INNER),
    **dict.fromkeys(("jcfpm", "cohfrict"), _SPHERES),
}

_SOLID_RATES = {
    "flexible": Rates(0.01, 0.008, (0.033, 0.028), 0.01, likely_crossings=140),
    "rigid": Rates(0.01, 0.012, (0.09, 0.06), 0.006, likely_crossings=550),
}

KIND = TestKind(
    name="brazilian",
    order=4,
    about="compression of a disc between two plates, whose axial stress is 2 P / (pi D t), P the "
    "force, D the diameter, t the thickness",
    variants={
        "disc": Variant(
            rates=_RATES,
            results={
                **dict.fromkeys(("flexible", "rigid"), 5),
                **dict.fromkeys(("inner", "inner-un"), 4),
                **dict.fromkeys(("jcfpm", "cohfrict"), 3),
            },
        ),
        "solid-disc": Variant(_SOLID_RATES),
    },
    options=(
        Option(
            JAW_RADIUS,
            "Radius of curved jaws that replace the flat plates of a 3D disc",
            "m",
            default="flat plates",
            open="flat plates",
            models=BLOCK_MODELS,
        ),
    ),
    settle=_settle,
    largest_strain=16.0,  # plates press into discs, which softening lets carry more
    falls_freely=True,
    regains=True,
    pulled=True,
    splits=True,
    # slopes of the plates' closure
    no_constants=("youngs_modulus", "poissons_ratio", "elastic_poissons_ratio"),
    words=Words(
        strain("closure of the plates / D"),
        stress("stress 2 P / (π D t)"),
        "peak of 2 P / (pi D t)",
    ),
    calibrates={"indirect_tensile_strength": "peak_stress"},
    scored="split",
)
