# SPDX-License-Identifier: GPL-3.0-or-later
"""Ends of confined runs that go on past their peaks, so that their drop is recorded. SI units."""

from __future__ import annotations

import numpy as np

from ..files import Table

#: Confining pressures over the compressive strength of the rock [-].
_SHARES = (0.03, 0.1, 0.3, 0.5)
#: Largest axial strain of a run under these pressures [-], and the least ratio of it to the
#: compressive strength over Young's modulus of the rock: soft rocks have their peaks at larger
#: strains.
_STRAINS, _RATIOS = (0.015, 0.025, 0.03, 0.03), (3.0, 5.0, 6.0, 6.0)
#: Part of its peak below which the deviator of such a run never falls: it goes to its strain [-].
_NO_STOP = 0.01
#: Digits of a largest strain.
_DIGITS = 4


def ends(pressure: float, strength: float | None, young: float | None) -> Table:
    """Return the options with which a run goes on past its peak.

    Args:
        pressure: Confining pressure [Pa]; between the pressures of a scorecard the largest strain
            is interpolated.
        strength: Compressive strength of the rock [Pa]; None: the strain is that of the highest
            pressures.
        young: Young's modulus of the rock [Pa]; None: the rock is as stiff as granite.
    """
    share = _SHARES[-1] if strength is None else pressure / strength
    strain = float(np.interp(share, _SHARES, _STRAINS))
    if strength is not None and young is not None:
        strain = max(strain, float(np.interp(share, _SHARES, _RATIOS)) * strength / young)
    return {"max_strain": float(f"{strain:.{_DIGITS}g}"), "stop_ratio": _NO_STOP}
