# SPDX-License-Identifier: GPL-3.0-or-later
"""What a laboratory reads off a core, on curves that are drawn."""

import numpy as np
import pytest

from flexpm.results import core, measures
from flexpm.results.record import COLUMNS, Curve

E, NU = 50e9, 0.25
#: Deviators at which the drawn cracks begin to widen the specimen, and at the peak [Pa].
WIDENS, PEAK = 60e6, 120e6


def curve(*, solid, confinement=0.0, own_lateral=None, start=0.0, widening=2.0, rows=601):
    """A straight rise to the peak and a fall; from WIDENS on cracks widen by a parabola."""
    up = np.linspace(0.0, PEAK, rows)
    deviator = np.concatenate([up, np.linspace(PEAK, 0.4 * PEAK, 50)[1:]])
    axial = np.concatenate([up / E, PEAK / E * np.linspace(1.0, 1.3, 50)[1:]])
    over = np.maximum(deviator[:rows] - WIDENS, 0.0) / (PEAK - WIDENS)
    ways = 2.0 if solid else 1.0
    lateral = NU * axial
    lateral[:rows] += widening * PEAK / E * over**2 / ways
    lateral[rows:] += widening * PEAK / E / ways
    columns = dict.fromkeys(COLUMNS, np.zeros(len(axial)))
    columns |= {
        "step": np.arange(len(axial), dtype=float),
        "axial_strain": axial,
        "lateral_strain": lateral if own_lateral is None else own_lateral(axial),
        "axial_stress": deviator + confinement + start,
        "confinement": np.full(len(axial), confinement),
        # 200 at the peak, from a quarter of it on
        "tensile_cracks": np.round(200 * np.clip((deviator / PEAK - 0.25) / 0.75, 0.0, 1.0)),
    }
    return Curve.from_array(np.column_stack([columns[name] for name in COLUMNS]))


NAMES = ("crack_initiation_stress", "crack_initiation_stress_volumetric", "crack_damage_stress")


def thresholds(record, modulus=E, ratio=NU, *, solid=True):
    """Deviators of initiation by cracks and by volume, and of damage; None with a reason each."""
    found = core.crack_thresholds(record, modulus, ratio, solid=solid)
    assert tuple(found.stresses) == NAMES
    assert set(found.reasons) == {name for name, one in found.stresses.items() if one is None}
    assert all(found.reasons.values())
    return tuple(found.stresses.values())


@pytest.mark.parametrize("solid", [False, True])
@pytest.mark.parametrize(("confinement", "start"), [(0.0, 0.0), (8e6, 0.0), (8e6, 20e6)])
def test_readings_of_a_drawn_curve(solid, confinement, start):
    record = curve(solid=solid, confinement=confinement, start=start)
    row = PEAK / 600
    # the second of 200 cracks, of which 1 % counts, is there at 1.5 of 200
    expected = start + PEAK * (0.25 + 0.75 * 1.5 / 200)
    begun, found, dilates = thresholds(record, solid=solid)
    assert begun == pytest.approx(expected, abs=1.01 * row)
    # 2 (s - 60)^2 / 60^2 = 0.02 (1 - n nu) s / 120
    slope = 0.02 * (1.0 - (2.0 if solid else 1.0) * NU) / PEAK
    s = np.linspace(WIDENS, PEAK, 600001)
    passes = 2.0 * ((s - WIDENS) / (PEAK - WIDENS)) ** 2 > slope * s
    assert found == pytest.approx(start + s[np.argmax(passes)], abs=1.01 * row)
    # where the sum's slope is 0: 2 * 2 (s - 60) / 60^2 = (1 - n nu) / 120
    damage = WIDENS + (1.0 - (2.0 if solid else 1.0) * NU) / PEAK * (PEAK - WIDENS) ** 2 / 4.0
    assert dilates == pytest.approx(start + damage, abs=1.01 * row)
    assert begun <= found <= dilates


def test_the_volume_of_elasticity():
    record = curve(solid=True, widening=0.0)
    total = core.volumetric_strain(record, solid=True)
    elastic = core.elastic_volumetric_strain(record, E, NU, solid=True)
    assert np.allclose(total[:601], elastic[:601], rtol=1e-12, atol=1e-18)
    assert total[600] == pytest.approx((1 - 2 * NU) * PEAK / E)
    plane = core.volumetric_strain(record, solid=False)
    assert plane[600] == pytest.approx((1 - NU) * PEAK / E)
    with_it = core.with_volume(record, solid=True)
    assert with_it.own == ("volumetric_strain",)
    assert np.array_equal(with_it["volumetric_strain"], total)
    assert np.array_equal(with_it["axial_stress"], record["axial_stress"])


def test_the_moduli_of_the_start_are_those_of_the_first_rows():
    softens = curve(solid=True, start=2e6, own_lateral=lambda axial: NU * axial + 50.0 * axial**2)
    modulus, ratio = measures.start_moduli(softens)
    assert modulus == pytest.approx(E)
    assert ratio == pytest.approx(NU, rel=1e-3)
    assert measures.poissons_ratio(softens) > 1.04 * NU
    assert measures.start_moduli(softens.until(0)) == (None, None)


def test_what_a_curve_does_not_tell_is_none_with_a_reason():
    shrinks = curve(solid=True, widening=0.0)
    assert thresholds(shrinks)[1:] == (None, None)
    reasons = core.crack_thresholds(shrinks, E, NU, solid=True).reasons
    assert "shrinks up to the peak" in reasons["crack_damage_stress"]
    assert "do not widen" in reasons["crack_initiation_stress_volumetric"]
    assert thresholds(shrinks.until(500)) == (None, None, None)
    unknown = curve(solid=True, own_lateral=lambda axial: np.full(len(axial), np.nan))
    assert thresholds(unknown)[1:] == (None, None)
    assert thresholds(curve(solid=True), modulus=None)[1] is None
    whole = shrinks.array.copy()
    whole[:, COLUMNS.index("tensile_cracks")] = 0.0
    assert thresholds(Curve.from_array(whole))[0] is None
    empty = Curve()
    assert thresholds(empty, solid=False) == (None, None, None)
    assert len(core.elastic_volumetric_strain(empty, E, NU, solid=False)) == 0


@pytest.mark.parametrize("solid", [False, True])
def test_a_burst_of_cracks_has_its_thresholds_in_order(solid):
    """A specimen that dilates within one burst: cracks have widened it by then."""
    record = curve(solid=solid, widening=0.0)
    columns = {name: record[name].copy() for name in COLUMNS}
    row = 550  # below the peak: the stress falls by 5 MPa, then rises to the peak
    ways = 2.0 if solid else 1.0
    # first by 0.2 % of the elastic strain, then by more
    for before, widens in ((0, 3e-6), (1, 5e-5), (2, 1e-2)):
        columns["lateral_strain"][row + before :] += widens / ways
        columns["axial_stress"][row + before] -= 5e6 * before
    burst = Curve.from_array(np.column_stack([columns[name] for name in COLUMNS]))
    _, widens, dilates = thresholds(burst, solid=solid)
    assert widens is not None and dilates is not None
    assert widens <= dilates
    assert dilates == pytest.approx(PEAK * row / 600, rel=0.01)


def test_a_spike_that_passes_does_not_count():
    record = curve(solid=True)
    whole = record.array.copy()
    whole[100, COLUMNS.index("lateral_strain")] *= 1.5
    assert thresholds(Curve.from_array(whole))[1] == thresholds(record)[1]
