# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture toughness of notched specimens by handbook functions. SI units.

Nothing heavy is loaded here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import math

from ..errors import InputError

#: Least span of a beam over its height for which its function holds [-].
LEAST_SPAN = 2.5


def require_span(span: float, height: float, notch: float) -> None:
    """Refuse a span for which no function gives the toughness of a notched beam.

    Raises:
        InputError: for a span below 2.5 times the height, if there is a notch.
    """
    if notch > 0.0 and not span >= LEAST_SPAN * height:
        raise InputError(
            f"run: span = {span:g} m, must be >= {LEAST_SPAN * height:g} m for a notched beam of "
            f"height {height:g} m: {LEAST_SPAN:g} times the height; the function of its toughness "
            "holds from there on"
        )


def bending_function(ratio: float, slenderness: float) -> float:
    """Stress intensity of a beam in three-point bending over its bending stress and sqrt(height).

    G. V. Guinea, J. Y. Pastor, J. Planas, M. Elices: Stress intensity factor, compliance and CMOD
    for a general three-point-bend beam. International Journal of Fracture 89 (1998) 103-116.

    Args:
        ratio: Notch over height, above 0 and below 1 [-].
        slenderness: Span over height, at least 2.5 [-].

    Returns:
        K_I / (sigma sqrt(height)), with sigma = 3 P span / (2 thickness height^2) [-].
    """
    left = 1.0 - ratio
    short = 1.900 - ratio * (-0.089 + 0.603 * left - 0.441 * left**2 + 1.223 * left**3)
    long = 1.989 - ratio * left * (0.448 - 0.458 * left + 1.226 * left**2)
    shape = long + 4.0 / slenderness * (short - long)
    return math.sqrt(ratio / left**3) / (1.0 + 2.0 * ratio) * shape


def bending_toughness(
    load: float, *, span: float, height: float, thickness: float, notch: float
) -> float:
    """Stress intensity K_I of a notched beam under a load in its middle [Pa m^0.5].

    Args:
        load: [N].
        span: Distance of the supports [m].
        height: Of the beam [m].
        thickness: Of the beam [m].
        notch: Depth from the side opposite to the load [m].
    """
    stress = 1.5 * load * span / (thickness * height**2)
    return stress * math.sqrt(height) * bending_function(notch / height, span / height)
