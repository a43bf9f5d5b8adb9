# SPDX-License-Identifier: GPL-3.0-or-later
"""Factors of the strengths of contacts (D38): given, or drawn from Weibull's distribution."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError
from ..require import Bounds, require_number
from .checks import require_seed

#: Keeps the draw of strengths apart from other draws with the same seed.
_WEIBULL_STREAM = 38


def checked(factors: Sequence[float] | FloatArray, count: int) -> FloatArray:
    """Return factors of the strengths of `count` contacts [-], which must be above zero."""
    given = np.asarray(factors)
    numbers = given.shape == (count,) and given.dtype.kind in "iuf"
    if not numbers or not (np.isfinite(given).all() and given.min(initial=1.0) > 0.0):
        raise InputError(
            f"Specimen.with_strengths: factors = {given.dtype} array of shape {given.shape}, must "
            f"be {count} numbers > 0; give one per contact"
        )
    strengths = np.array(given, dtype=float)
    strengths.setflags(write=False)
    return strengths


def weibull(modulus: float, seed: int, count: int) -> FloatArray:
    """Draw factors [-] that follow Weibull's distribution of a modulus [-], with the mean 1."""
    where = "Specimen.with_weibull_strengths"
    shape = require_number(f"{where}: modulus", modulus, Bounds(at_least=1.0, at_most=1e6))
    draw = np.random.default_rng([_WEIBULL_STREAM, require_seed(where, seed)])
    return draw.weibull(shape, count) / math.gamma(1.0 + 1.0 / shape)
