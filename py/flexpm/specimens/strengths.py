# SPDX-License-Identifier: GPL-3.0-or-later
"""Factors of the strengths of contacts (D38): given, or drawn from Weibull's distribution."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError
from ..materials.keys import MODULUS
from ..require import require_number
from .checks import require_seed

#: Keep the draws of strengths apart from each other and from other draws with the same seed.
_WEIBULL_STREAM = 38
_MATERIAL_STREAM = 138


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
    shape = require_number(f"{where}: modulus", modulus, MODULUS)
    return _drawn(_WEIBULL_STREAM, shape, require_seed(where, seed), count)


def of_material(modulus: float, seed: int, count: int) -> FloatArray:
    """Draw the factors [-] of a material with a modulus [-], apart from those of `weibull`."""
    return _drawn(_MATERIAL_STREAM, modulus, seed, count)


def _drawn(stream: int, modulus: float, seed: int, count: int) -> FloatArray:
    draw = np.random.default_rng([stream, seed])
    return draw.weibull(modulus, count) / math.gamma(1.0 + 1.0 / modulus)
