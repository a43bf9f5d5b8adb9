# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures around and after the peak, on records with known answers."""

import math

import numpy as np
import pytest
from sample_rows import row

from flexpm.results import descent
from flexpm.results.record import Curve

PEAK, AT_PEAK = 100e6, 0.004


def record(after, *, lateral=lambda strain: 0.2 * strain, confinement=0.0, end=0.012, **columns):
    """Linear to PEAK at AT_PEAK, then `after` of the strain past the peak, as a part of PEAK."""
    made = Curve()
    for strain in np.linspace(0.0, end, round(end / 1e-5) + 1):
        past = strain - AT_PEAK
        deviator = PEAK * (strain / AT_PEAK if past <= 0.0 else after(past))
        values = {name: of(strain) for name, of in columns.items()}
        made.append(
            **row(
                axial_strain=strain,
                lateral_strain=lateral(strain),
                axial_stress=deviator + confinement,
                confinement=confinement,
                **values,
            )
        )
    return made


@pytest.mark.parametrize("confinement", [0.0, 30e6])
def test_the_drop_is_the_largest_loss_within_the_window(confinement):
    falling = record(lambda past: 1.0 - 50.0 * past, confinement=confinement)
    assert descent.drop_after_peak(falling) == pytest.approx(0.25, rel=1e-9)
    assert descent.drop_after_peak(falling, 0.002) == pytest.approx(0.1, rel=1e-9)
    # a dip that recovers counts, a later one does not
    dip = record(lambda past: 0.7 if 0.001 < past < 0.002 else 0.99, confinement=confinement)
    assert descent.drop_after_peak(dip) == pytest.approx(0.3, rel=1e-9)
    late = record(lambda past: 0.2 if past > 0.0051 else 0.97, confinement=confinement)
    assert descent.drop_after_peak(late) == pytest.approx(0.03, rel=1e-9)


def test_a_window_that_is_cut_short_tells_a_drop_only_if_a_tenth_is_lost():
    def short(part):
        return record(lambda past: 1.0 - part * past / 0.003, end=AT_PEAK + 0.003)

    assert descent.drop_after_peak(short(0.5)) == pytest.approx(0.5, rel=1e-9)
    assert descent.drop_after_peak(short(0.05)) is None
    assert descent.dilation_after_peak(short(0.5), solid=True) is None
    assert descent.drop_after_peak(record(lambda past: 1.0 + past)) is None  # it rises to its end


@pytest.mark.parametrize("solid", [False, True])
@pytest.mark.parametrize("dilation", [0.5, 1.0, 3.0, 6.0])
def test_dilation_is_the_slope_of_the_volume_after_the_peak(solid, dilation):
    sides = 2.0 if solid else 1.0

    def lateral(strain):  # beyond the window it is another
        past = min(max(strain - AT_PEAK, 0.0), 0.005)
        return 0.2 * min(strain, AT_PEAK) + (dilation * past + 99.0 * max(strain - 0.009, 0.0)) / (
            sides
        )

    made = record(lambda past: 0.8, lateral=lateral)
    found = descent.dilation_after_peak(made, solid=solid)
    assert found == pytest.approx(dilation, rel=1e-6)
    sine = math.sin(math.radians(descent.dilation_angle(found)))
    assert sine == pytest.approx((dilation - 1.0) / (dilation + 1.0), rel=1e-6)


def test_an_unknown_lateral_strain_tells_no_dilation():
    made = record(lambda past: 0.8, lateral=lambda strain: math.nan)
    assert descent.dilation_after_peak(made, solid=True) is None
    assert descent.secant_poissons_ratio(made, 0.5) is None


@pytest.mark.parametrize("share", [0.25, 0.5, 0.9])
def test_the_secant_is_read_where_the_stress_first_reaches_its_share(share):
    made = record(lambda past: 0.5, lateral=lambda strain: 40.0 * strain**2)
    assert descent.secant_poissons_ratio(made, share) == pytest.approx(40.0 * AT_PEAK * share)
    assert descent.secant_poissons_ratio(record(lambda past: 1.0 + past), share) is None


def test_cracks_after_the_peak_do_not_count_in_their_shares():
    made = record(
        lambda past: 0.5,
        tensile_cracks=lambda strain: 30 if strain <= AT_PEAK else 31,
        shear_cracks=lambda strain: 10 if strain <= AT_PEAK else 900,
    )
    assert descent.tensile_share(made) == 0.75
    assert descent.tensile_share(record(lambda past: 0.5)) is None
