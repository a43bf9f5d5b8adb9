# SPDX-License-Identifier: GPL-3.0-or-later
"""Pulse length of a sonic test, and its smallest value in grains. SI units."""

from __future__ import annotations

from ..errors import InputError

#: Waves: along the height, and across it.
WAVES = ("p", "s")
#: What is done with the sides: across the motion of the wave they are held, or they are free, as of
#: a thin bar. The name of the option, and its words.
SIDES, HELD, FREE = "sides", "held", "free"
#: Length of a pulse over the height that it goes through [-], deviation D48.
PULSE = 0.4
#: Least length of a pulse in mean diameters of the grains [-].
_FEWEST_GRAINS = 20.0


def require_pulse(height: float, diameter: float) -> None:
    """Raise InputError for a specimen in which the pulse would be shorter than 20 grains.

    Args:
        height: Height of the specimen [m].
        diameter: Mean diameter of the grains [m].
    """
    grains = PULSE * height / diameter
    if not grains >= _FEWEST_GRAINS:
        raise InputError(
            f"run: wavelength = {grains:.3g} mean diameters of the grains, must be >= "
            f"{_FEWEST_GRAINS:g} (a wavelength is {PULSE:g} heights); use a height of "
            f"{_FEWEST_GRAINS / PULSE:g} diameters, or smaller grains"
        )
