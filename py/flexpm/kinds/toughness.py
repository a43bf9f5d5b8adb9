# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture toughness of notched specimens from handbook functions. SI units.

Only light modules are loaded, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import math

from ..errors import InputError

#: Least span of a beam over its height for which its function holds [-].
LEAST_SPAN = 2.5
#: Ranges of the notch over the radius and of the span over the diameter of half a disc in which its
#: function holds [-].
HALF_DISC_NOTCHES, HALF_DISC_SPANS = (0.4, 0.6), (0.5, 0.8)
#: By how much a ratio of two lengths may miss a range, as its last digits do [-].
_DIGITS = 1e-9


def require_span(span: float, height: float, notch: float) -> None:
    """Check that a function exists for the toughness of a notched beam with this span.

    Args:
        span: Distance between the supports [m].
        height: Height of the beam [m].
        notch: Depth of the notch [m]; 0: no notch, and any span is valid.

    Raises:
        InputError: for a span below 2.5 times the height if there is a notch.
    """
    if notch > 0.0 and not span >= LEAST_SPAN * height:
        raise InputError(
            f"run: span = {span:g} m, must be >= {LEAST_SPAN * height:g} m for a notched beam of "
            f"height {height:g} m: {LEAST_SPAN:g} times the height; use a longer span, since the "
            "formula of the toughness is not valid below"
        )


def require_half_disc(span: float, radius: float, notch: float) -> None:
    """Check that a function exists for the toughness of half a disc with this span and notch.

    Args:
        span: Distance between the supports [m].
        radius: Radius of the disc [m].
        notch: Depth of the notch [m].

    Raises:
        InputError: for a span or a notch out of the range of the function.
    """
    for name, value, whole, size, (low, high) in (
        ("span", span, "diameters", 2.0 * radius, HALF_DISC_SPANS),
        ("notch", notch, "radii", radius, HALF_DISC_NOTCHES),
    ):
        if not _is_within(value / size, (low, high)):
            raise InputError(
                f"run: {name} = {value:g} m, must be {low * size:g} to {high * size:g} m: {low:g} "
                f"to {high:g} {whole} of the disc; give such a value, since the formula of the "
                "toughness is valid only there"
            )


def half_disc_function(ratio: float, slenderness: float) -> float:
    """Return the ratio of K_I of half a disc in three-point bending to stress and sqrt(pi notch).

    M. D. Kuruppu, Y. Obara, M. R. Ayatollahi, K. P. Chong, T. Funatsu: ISRM-suggested method for
    determining the mode I static fracture toughness using semi-circular bend specimen. Rock
    Mechanics and Rock Engineering 47 (2014) 267-274.

    Args:
        ratio: Ratio of notch to radius, 0.4 to 0.6 [-].
        slenderness: Ratio of span to diameter, 0.5 to 0.8 [-].

    Returns:
        Y' = K_I / (sigma sqrt(pi notch)), with sigma = P / (2 radius thickness) [-].
    """
    constant = -1.297 + 9.516 * slenderness
    linear = 0.47 + 16.457 * slenderness
    square = 1.071 + 34.401 * slenderness
    return constant - linear * ratio + square * ratio**2


def half_disc_toughness(
    load: float, *, span: float, radius: float, thickness: float, notch: float
) -> float | None:
    """Return the stress intensity K_I of half a notched disc under a load on top [Pa m^0.5].

    None for a notch or a span out of the range of `half_disc_function`.

    Args:
        load: Load P [N].
        span: Distance between the supports [m].
        radius: Radius of the disc [m].
        thickness: Thickness of the disc [m].
        notch: Depth of the notch from the middle of the flat side [m].
    """
    ratio, slenderness = notch / radius, 0.5 * span / radius
    if not (_is_within(ratio, HALF_DISC_NOTCHES) and _is_within(slenderness, HALF_DISC_SPANS)):
        return None
    stress = 0.5 * load / (radius * thickness)
    return stress * math.sqrt(math.pi * notch) * half_disc_function(ratio, slenderness)


def _is_within(value: float, bounds: tuple[float, float]) -> bool:
    return bounds[0] - _DIGITS <= value <= bounds[1] + _DIGITS


def bending_function(ratio: float, slenderness: float) -> float:
    """Return the ratio of K_I of a beam in three-point bending to bending stress and sqrt(height).

    G. V. Guinea, J. Y. Pastor, J. Planas, M. Elices: Stress intensity factor, compliance and CMOD
    for a general three-point-bend beam. International Journal of Fracture 89 (1998) 103-116.

    Args:
        ratio: Ratio of notch to height, above 0 and below 1 [-].
        slenderness: Ratio of span to height, at least 2.5 [-].

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
    """Return the stress intensity K_I of a notched beam under a load in its middle [Pa m^0.5].

    Args:
        load: Load P [N].
        span: Distance between the supports [m].
        height: Height of the beam [m].
        thickness: Thickness of the beam [m].
        notch: Depth of the notch from the side opposite to the load [m].
    """
    stress = 1.5 * load * span / (thickness * height**2)
    return stress * math.sqrt(height) * bending_function(notch / height, span / height)
