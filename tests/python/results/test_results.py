# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of records with known answers, and the files of a result."""

import csv
import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from sample_rows import row
from sample_snapshot import HEIGHT, WIDTH, wall

from flexpm.renamed import current
from flexpm.results import descent, measures
from flexpm.results.cracks import Crack, SolidCrack
from flexpm.results.record import COLUMNS, Curve
from flexpm.results.result import Result

YOUNG, POISSON, PEAK, SOFTENING = 24.3e9, 0.23, 120e6, -80e9
QUASISTATIC = 1.5e-3  # largest median unbalanced-force ratio [-]
KEYS = [
    "flexpm",
    "yade",
    "test",
    "model",
    "material",
    "seed",
    "grains",
    "contacts",
    "nodes",
    "triangles",
    "grains_across",
    "particles",
    "inner_contacts",
    "youngs_modulus",
    "poissons_ratio",
    "elastic_poissons_ratio",
    "peak_stress",
    "peak_strain",
    "confinement",
    "steps",
    "step_time",
    "tensile_cracks",
    "shear_cracks",
    "cracks_by_pair",
    "softened_by_pair",
    "unbalanced_ratio",
    "end_mismatch",
    "energy_error",
    "contact_width",
    *("softening_slope", "drop_after_peak"),
    "tangent_modulus_ratio",
    "softening_onset",
    "first_tensile_crack_strain",
    "first_tensile_crack_stress",
    "first_shear_crack_strain",
    "first_shear_crack_stress",
    "tensile_onset_strain",
    "tensile_onset_stress",
    "shear_onset_strain",
    "shear_onset_stress",
    *("crack_initiation_stress", "crack_initiation_stress_volumetric", "crack_damage_stress"),
    *("null_reasons", "first_crack_stress", "first_crack_distance"),
    "peak_load",
    "notch_depth",
    "joint_deviation",
    "joint_cuts",
    "joint_states",
    "networks",
    "loose_grains",
    "largest_separation",
    "fracture_toughness",
    "residual_strength",
    "fracture_energy",
    "vp",
    "vs",
    "fragments",
    "largest_fragment",
    "events",
    "completeness_magnitude",
    "b_value",
    "b_value_error",
    "final_rate",
    "rates",
    "ended_by",
    "status",
    "warnings",
    "inputs",
]


def triangular_record(confinement=0.0, last_stress=0.4 * PEAK):
    """Linear loading to PEAK, then linear softening to `last_stress`."""
    strain_at_peak = PEAK / YOUNG
    record = Curve()
    rising = np.linspace(0.0, strain_at_peak, 401)
    falling = strain_at_peak + np.linspace(0.0, (last_stress - PEAK) / SOFTENING, 101)[1:]
    for step, strain in enumerate([*rising, *falling]):
        past = max(strain - strain_at_peak, 0.0)
        stress = YOUNG * min(strain, strain_at_peak) + SOFTENING * past
        record.append(
            **row(
                step=10 * step,
                axial_strain=strain,
                lateral_strain=POISSON * strain,
                axial_stress=stress + confinement,
                confinement=confinement,
                unbalanced_ratio=0.5 if past or strain < 1e-6 else 1e-3,
                end_mismatch=0.3 if past or strain < 1e-6 else 0.02,
                boundary_work=strain,
                velocity_factor=1.0,
                elastic_energy=0.25 * strain + 7.0,
                damping_energy=0.75 * strain,
            )
        )
    return record


def result_of(record, **values):
    basic = {
        "flexpm": "0.1",
        "yade": "2023.02a",
        "test": "uniaxial",
        "model": "flexible",
        "material": {"name": "m"},
        "seed": 1,
        "grains": 4,
        "contacts": 5,
        "nodes": 40,
        "triangles": 30,
        "curve": record,
    }
    return Result(**(basic | values))


def test_a_load_that_grows_fast_up_to_its_peak_is_doubtful_where_planes_may_fail():
    record = triangular_record()
    # 401 rows of 10 steps to the peak
    assert measures.growth_before_peak(record, 40.0) is None  # nothing softens: it was taken back
    record = Curve.from_columns(
        [*COLUMNS],
        np.where(
            np.array([name == "damage_energy" for name in COLUMNS]),
            1e-9 * np.maximum(np.arange(len(record)) - 399.0, 0.0)[:, None],
            np.column_stack([record[name] for name in COLUMNS]),
        ),
        [],
    )
    assert measures.growth_before_peak(record, 40.0) == pytest.approx(0.01)
    assert measures.growth_before_peak(record.until(400), 40.0) is None  # it still grows
    for crossing, status in ((None, "ok"), (40.0, "ok"), (60.0, "not_quasistatic")):
        result = result_of(record)
        result.measure(QUASISTATIC, crossing=crossing)
        assert result.status == status


@pytest.mark.parametrize("confinement", [0.0, 4e6])
def test_measures_of_a_triangular_record(confinement):
    result = result_of(triangular_record(confinement))
    result.measure(QUASISTATIC)
    assert result.status == "ok"
    assert result.youngs_modulus == pytest.approx(YOUNG, rel=1e-10)
    assert result.poissons_ratio == pytest.approx(POISSON, rel=1e-10)
    assert result.peak_stress == pytest.approx(PEAK + confinement, rel=1e-12)
    assert result.peak_strain == pytest.approx(PEAK / YOUNG, rel=1e-12)
    assert result.softening_slope == pytest.approx(SOFTENING, rel=1e-9)
    assert result.tangent_modulus_ratio == pytest.approx(1.0, rel=1e-9)
    # neither the first rows nor those after the peak
    assert (result.unbalanced_ratio, result.end_mismatch) == (1e-3, 0.02)
    assert result.energy_error == pytest.approx(0.0, abs=1e-12)
    assert (result.steps, result.confinement) == (5000, confinement)


def test_the_elastic_poissons_ratio_ends_where_points_soften():
    """Both numbers are given, and a warning where they differ by more than 5 %."""
    for bulging, warned in ((1.0, False), (1.02, False), (1.5, True)):
        record, reference = Curve(), triangular_record()
        for number in range(len(reference)):
            values = {name: reference[name][number] for name in COLUMNS}
            softened = max(values["axial_strain"] / (PEAK / YOUNG) - 0.03, 0.0)
            values["damage_energy"] = 1e-6 * softened
            values["lateral_strain"] *= 1.0 if softened == 0.0 else bulging
            record.append(**values)
        result = result_of(record)
        result.measure(QUASISTATIC)
        assert result.elastic_poissons_ratio == pytest.approx(POISSON, rel=1e-9)
        assert result.poissons_ratio == pytest.approx(bulging * POISSON, rel=1e-9)
        told = [line for line in result.warnings if line.startswith("poissons_ratio = 0.")]
        assert bool(told) == warned
        assert not warned or "50 % from elastic_poissons_ratio = 0.2" in told[0]
    for model in ("inner", "jcfpm"):
        result = result_of(reference, model=model)
        result.measure(QUASISTATIC)
        assert result.elastic_poissons_ratio is None


def record_through(*points):
    """Record whose stress is piecewise linear through (strain, stress) points."""
    record = Curve()
    strains, stresses = np.transpose(points)
    for strain in np.linspace(0.0, strains[-1], 2001):
        stress = np.interp(strain, strains, stresses)
        record.append(**row(axial_strain=strain, axial_stress=stress))
    return record


def test_kinks_outside_5_to_25_percent_of_the_peak_do_not_count():
    outside = record_through((0, 0), (0.02, 4), (0.24, 26), (0.5, 100), (0.9, 10))
    assert measures.youngs_modulus(outside) == pytest.approx(100.0, rel=1e-9)
    inside = record_through((0, 0), (0.02, 4), (0.18, 20), (0.5, 100), (0.9, 10))
    assert measures.youngs_modulus(inside) > 105.0


def test_two_slopes_give_their_quotient():
    kinked = record_through((0, 0), (0.4, 40), (1.6, 100), (2.0, 10))
    assert measures.tangent_modulus_ratio(kinked) == pytest.approx(0.5, rel=1e-9)
    assert measures.tangent_modulus_ratio(triangular_record(last_stress=0.95 * PEAK)) is None


@pytest.mark.parametrize("model", ["flexible", "rigid", "inner", "inner-un", "jcfpm", "cohfrict"])
@pytest.mark.parametrize("confinement", [0.0, 4e6])
def test_softening_begins_at_its_share_of_the_peak(confinement, model):
    record = triangular_record(confinement)
    record["damage_energy"][100:] = 1e-12  # rows 0 to 400 rise to the peak
    result = result_of(record, model=model)
    result.measure(QUASISTATIC)
    known = model in ("flexible", "rigid")
    assert result.softening_onset == (pytest.approx(0.25, rel=1e-9) if known else None)


def test_softening_before_the_loading_or_without_a_peak():
    record = triangular_record()
    assert measures.softening_onset(record) is None  # a peak without damage
    record["damage_energy"][401:] = 1.0
    assert measures.softening_onset(record) is None  # none until the peak
    record["damage_energy"][:] = 1.0
    assert measures.softening_onset(record) == 0.0
    record["axial_stress"][0] = -1.0
    assert measures.softening_onset(record) == 0.0
    assert measures.softening_onset(Curve.from_array(record.array[:401])) is None


@given(noise=st.integers(0, 2**31), factor=st.floats(1e-6, 1e6))
def test_youngs_modulus_scales_with_stress_and_resists_noise(noise, factor):
    record = triangular_record()
    record["axial_stress"][:] += 1e-3 * PEAK * np.random.default_rng(noise).normal(size=501)
    modulus = measures.youngs_modulus(record)
    assert modulus == pytest.approx(YOUNG, rel=0.02)
    record["axial_stress"][:] *= factor
    assert measures.youngs_modulus(record) == pytest.approx(factor * modulus, rel=1e-9)


def test_no_peak_while_the_stress_has_not_fallen():
    result = result_of(triangular_record(last_stress=0.95 * PEAK))
    result.measure(QUASISTATIC)
    assert (result.status, result.peak_stress, result.peak_strain) == ("no_peak", None, None)
    assert result.youngs_modulus == pytest.approx(YOUNG, rel=1e-10)
    assert result.failed


def of_stresses(stresses):
    record = Curve()
    for step, stress in enumerate(stresses):
        record.append(**row(step=step, axial_strain=1e-4 * step, axial_stress=stress))
    return record


@given(
    st.floats(0.25, 0.9),
    st.floats(0.2, 0.85),
    st.floats(1.1, 3.0),
    st.sampled_from(["brazilian", "uniaxial"]),
)
def test_a_disc_is_as_strong_as_when_it_split(first, valley, last, test):
    """Rise to a peak, fall, and rise to `last` times it, which a disc's halves may carry."""
    peak = last * first * 1e7
    up, down, again = np.linspace(0.0, first * 1e7, 40), valley * first * 1e7, peak
    record = of_stresses(
        [*up, *np.linspace(up[-1], down, 9)[1:], *np.linspace(down, again, 30)[1:]]
    )
    result = result_of(record, test=test)
    result.measure(QUASISTATIC)
    if test == "brazilian":
        assert (result.peak_stress, result.peak_strain) == (up[-1], pytest.approx(39e-4))
        assert result.steps == len(record) - 1  # counted to the end
    else:
        assert result.status == "no_peak"


@given(st.floats(0.5, 0.85), st.floats(1.05, 3.0))
def test_a_strength_that_broken_grains_bear_is_doubtful(valley, last):
    """A core falls by more than 10 %, and locks; a disc's first peak is its strength anyway."""
    peak = last * 10e6
    rows = [*np.linspace(0.0, 10e6, 40), valley * 10e6, peak, 0.8 * peak]
    result = result_of(of_stresses(rows), test="triaxial")
    result.measure(QUASISTATIC)
    told = [line for line in result.warnings if "broken grains" in line]
    assert len(told) == 1 and "first peak of 10 MPa" in told[0]
    assert told[0].startswith(f"largest stress = {1e-6 * peak:.4g} MPa")
    for test, record in [
        ("bending", rows),  # its head may slip
        ("triaxial", [*rows[:-2], 0.99 * 10e6]),  # the first peak is the largest stress
        ("triaxial", [*rows[:40], 0.95 * 10e6, *rows[-2:]]),  # no fall
        ("brazilian", rows),
    ]:
        result = result_of(of_stresses(record), test=test)
        result.measure(QUASISTATIC)
        assert not any("broken grains" in line for line in result.warnings)


def test_falls_while_the_plates_find_their_place_are_no_splitting():
    record = of_stresses([0.0, 1e6, 0.5e6, 4e6, 8e6, 2e6])
    result = result_of(record, test="brazilian")
    result.measure(QUASISTATIC)
    assert result.peak_stress == 8e6


def test_not_quasistatic_above_the_threshold():
    result = result_of(triangular_record())
    result.measure(0.9e-3)
    assert (result.status, result.failed) == ("not_quasistatic", False)


def test_diverged_by_flag_and_by_a_stress_that_is_no_number():
    record = triangular_record()
    result = result_of(record)
    result.measure(QUASISTATIC, diverged=True)
    assert result.status == "diverged"
    record["axial_stress"][-1] = np.nan
    result.measure(QUASISTATIC)
    assert result.status == "diverged"


def test_energy_error_is_the_share_of_the_work_that_is_missing():
    record = triangular_record()
    record["damping_energy"][:] *= 0.9  # loses 0.9 * 0.75 of the work
    assert measures.energy_error(record) == pytest.approx(0.075, rel=1e-9)
    assert measures.energy_error(Curve.from_array(record.array[:1])) is None


def test_energy_that_was_lost_before_the_first_row_counts_if_the_start_is_known():
    record = triangular_record()
    assert measures.energy_error(record, initial=7.0) == pytest.approx(0.0, abs=1e-12)
    largest = record["boundary_work"].max()
    found = measures.energy_error(record, initial=7.0 + 0.02 * largest)
    assert found == pytest.approx(0.02, rel=1e-9)


def test_columns_are_taken_by_name():
    record = triangular_record()
    names = ["another", *reversed(COLUMNS)]
    rows = np.column_stack([np.ones(len(record)), record.array[:, ::-1]])
    assert np.array_equal(Curve.from_columns(names, rows).array, record.array)


@pytest.mark.parametrize("rows", [0, 1, 2])
def test_short_records_give_none_and_not_zero(rows):
    result = result_of(Curve.from_array(triangular_record().array[:rows]))
    result.measure(QUASISTATIC)
    found = result.as_dict()
    for key in ("youngs_modulus", "poissons_ratio", "peak_stress", "peak_strain"):
        assert found[key] is None
    assert result.softening_slope is None
    assert result.tangent_modulus_ratio is None


def test_append_wants_every_column():
    with pytest.raises(TypeError, match="axial_stress"):
        Curve().append(**{name: 0.0 for name in COLUMNS if name != "axial_stress"})
    with pytest.raises(TypeError, match="stres"):
        Curve().append(**row(stres=1.0))


def test_rows_survive_growth():
    record = Curve()
    for step in range(1000):
        record.append(**row(step=step, axial_stress=step / 3))
    assert np.array_equal(record["step"], np.arange(1000))
    assert np.array_equal(record["axial_stress"], np.arange(1000) / 3)


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=9))
def test_csv_numbers_read_back_unchanged(values):
    record = Curve()
    for step, value in enumerate(values):
        record.append(**row(step=step, axial_strain=value, boundary_work=-value))
    rows = list(csv.DictReader(record.csv().splitlines()))
    assert list(rows[0]) == list(COLUMNS)
    assert [float(line["axial_strain"]) for line in rows] == values
    assert [int(line["step"]) for line in rows] == list(range(len(values)))


@pytest.mark.parametrize("rows", [1.0, 0.5])
def test_a_core_has_its_drop_or_the_reason_why_not(rows):
    record = triangular_record(2e6)
    result = result_of(record.until(int(rows * len(record))))
    result.measure(QUASISTATIC)
    result.measure_core(solid=False, dynamic=False)
    if rows == 1.0:
        assert result.drop_after_peak == descent.drop_after_peak(record) > 0.1
        assert "drop_after_peak" not in (result.null_reasons or {})
    else:
        assert result.drop_after_peak is None
        assert result.null_reasons["drop_after_peak"].startswith("the test ends soon")


def test_files_of_a_result(tmp_path):
    result = result_of(triangular_record(), step_time=float("nan"), grains=np.int64(4))
    result.cracks = [Crack(7, 0.1 / 3, 0.01, 0.02, 1, 3, 0), Crack(9, 0.2, -0.01, 0.0, 2, 0, 2)]
    result.measure(QUASISTATIC)
    result.write(tmp_path / "new" / "folder")
    folder = tmp_path / "new" / "folder"
    assert sorted(file.name for file in folder.iterdir()) == [
        "cracks.csv",
        "curve.csv",
        "result.json",
    ]
    found = json.loads((folder / "result.json").read_text())
    assert list(current(found)) == KEYS
    assert found["step_time"] is None
    assert found["youngs_modulus"] == result.youngs_modulus
    cracks = list(csv.DictReader((folder / "cracks.csv").read_text().splitlines()))
    assert list(cracks[0]) == list(Crack._fields[:-1])  # grains are alike
    assert [line["mode"] for line in cracks] == ["tensile", "shear"]
    assert float(cracks[0]["strain"]) == 0.1 / 3


@given(
    steps=st.lists(st.integers(0, 5000), min_size=1, max_size=60),
    share=st.floats(0.0, 1.0),
)
def test_onset_is_when_the_share_of_the_cracks_was_there(steps, share):
    record = triangular_record()
    strain, stress = measures.crack_onset(record, steps, share)
    step = np.interp(strain, record["axial_strain"], record["step"])
    assert np.count_nonzero(np.array(steps) <= step + 1e-6) >= share * len(steps)
    assert np.count_nonzero(np.array(steps) < step - 1e-6) < max(1, share * len(steps))
    assert stress == pytest.approx(
        np.interp(strain, record["axial_strain"], record["axial_stress"])
    )


def test_first_crack_and_onset_by_mode():
    result = result_of(triangular_record())
    tensile = [Crack(step, 0.0, 0.0, 0.0, 1, step, 0) for step in range(1000, 2000, 25)]
    result.cracks = [*tensile, Crack(3000, 0.0, 0.0, 0.0, 2, 0, 1)]
    result.measure(QUASISTATIC)
    at = result.curve["axial_stress"]
    assert result.first_tensile_crack_stress == pytest.approx(at[100])
    assert result.tensile_onset_stress == pytest.approx(0.5 * (at[102] + at[103]))  # 2 of 40
    assert result.first_shear_crack_stress == result.shear_onset_stress == pytest.approx(at[300])
    result.cracks = tensile
    result.measure(QUASISTATIC)
    assert result.first_shear_crack_strain is result.shear_onset_stress is None


def test_fragments_of_a_result_and_their_table(tmp_path):
    snapshot = wall()  # 3 x 4 equal grains
    result = result_of(triangular_record())
    result.measure_fragments(snapshot)
    assert (result.fragments, result.largest_fragment) == (1, pytest.approx(1.0))
    first_row = snapshot.contact_grains.min(axis=1) < 3
    apart = first_row & (snapshot.contact_grains.max(axis=1) >= 3)
    damage = np.where(apart[snapshot.point_contact], 1.0, snapshot.point_damage)
    result.measure_fragments(dataclasses.replace(snapshot, point_damage=damage))
    assert (result.fragments, result.largest_fragment) == (2, pytest.approx(0.75))
    result.write(tmp_path)
    rows = list(csv.DictReader((tmp_path / "fragments.csv").read_text().splitlines()))
    assert [int(line["grains"]) for line in rows] == [9, 3]
    assert sum(float(line["area"]) for line in rows) == pytest.approx(12 * WIDTH * HEIGHT)


def test_without_work_the_energy_error_is_the_share_of_the_initial_energy():
    record = Curve()
    for step, kinetic in enumerate((4.0, 3.0, 3.9)):
        record.append(**row(step=step, kinetic_energy=kinetic, elastic_energy=4.0 - kinetic))
    assert measures.energy_error(record, initial=4.0) == 0.0
    assert measures.energy_error(record, initial=4.4) == pytest.approx(0.4 / 4.4)
    assert measures.energy_error(record) is None


@pytest.mark.parametrize(
    ("name", "value"),
    [("peak_stress", "high"), ("steps", 1.5), ("grains", None), ("seed", True), ("material", [])],
)
def test_a_value_of_another_type_is_named(tmp_path, name, value):
    result_of(Curve()).write(tmp_path)
    assert Result.read(tmp_path).grains == 4
    content = json.loads((tmp_path / "result.json").read_text())
    (tmp_path / "result.json").write_text(json.dumps(content | {name: value}))
    refusal(f"result.json', has {name} = ", Result.read, tmp_path)


def test_the_kinetic_energy_is_looked_at_where_a_test_peaks_and_ends():
    record = triangular_record()
    assert measures.kinetic_shares(record) == {"at the peak": 0.0, "at the end": 0.0}
    record["kinetic_energy"][-1] = 0.3 * record["boundary_work"][-1]
    record["kinetic_energy"][400] = 0.1 * record["boundary_work"][400]
    assert measures.kinetic_shares(record) == pytest.approx({"at the peak": 0.1, "at the end": 0.3})
    result = result_of(record, inputs=None)
    assert sum("kinetic energy" in line for line in result.warnings) == 2
    confined = triangular_record(confinement=4e6, last_stress=0.95 * PEAK)
    assert set(measures.kinetic_shares(confined)) == {"at the end under a pressure"}
    assert measures.kinetic_shares(Curve()) == {}
    record["boundary_work"][:] = np.nan
    assert measures.kinetic_shares(record) == {}


@pytest.mark.parametrize("height", [None, 0.0])
def test_first_cracks_far_from_the_middle_of_a_split_disc_are_told(height):
    centre, radius = (0.03, 0.02), 0.01
    for share, told in ((0.2, False), (0.8, True)):
        result = result_of(triangular_record(), test="brazilian")
        steps = (50, 60, 61, 62, 63, 99)  # the last is not one of the first
        angles = np.linspace(0.0, 3.0, len(steps))
        far = np.append(np.full(len(steps) - 1, share), 0.1) * radius
        places = np.transpose(centre) + np.transpose([np.cos(angles), np.sin(angles)] * far)
        made = Crack if height is None else SolidCrack
        for step, (x, y) in zip(steps, places.tolist(), strict=True):
            along = (x, y) if height is None else (x, 0.004)
            more = () if height is None else (np.nan, "", y)
            result.cracks.append(made(step, 0.1, *along, 1, 0, 0, *more))
        result.measure(QUASISTATIC)
        result.measure_first_cracks(centre, radius)
        assert result.first_crack_distance == pytest.approx(share)
        stress = np.interp(steps[0], result.curve["step"], result.curve["axial_stress"])
        assert result.first_crack_stress == pytest.approx(stress)
        lines = [line for line in result.warnings if "first_crack_distance" in line]
        assert len(lines) == told
        assert all("not a tensile strength" in line and "peak at" in line for line in lines)
    empty = result_of(triangular_record(), test="brazilian")
    empty.measure_first_cracks(centre, radius)
    assert (empty.first_crack_distance, empty.first_crack_stress) == (None, None)


@pytest.mark.parametrize("toughness", [None, 1e6])
def test_first_cracks_far_from_a_notch_are_told(toughness):
    front, ligament = (0.0, 0.005), 0.01
    for share, told in ((0.3, False), (0.6, toughness is not None), (0.8, True)):
        result = result_of(triangular_record(), test="scb")
        result.fracture_toughness = toughness
        result.cracks = [Crack(50, 0.1, 0.0, front[1] + share * ligament, 1, 0, 0)]
        result.measure(QUASISTATIC)
        result.measure_first_cracks(front, ligament)
        assert result.first_crack_distance == pytest.approx(share)
        lines = [line for line in result.warnings if "first_crack_distance" in line]
        assert len(lines) == told
        assert all(("from the notch" in line) == (toughness is not None) for line in lines)


def test_a_test_without_a_peak_tells_the_stress_of_its_plateau():
    record = triangular_record(last_stress=0.95 * PEAK)
    rows = record.array.copy()
    strain, stress = (COLUMNS.index(name) for name in ("axial_strain", "axial_stress"))
    level = np.tile(rows[-1], (300, 1))
    level[:, strain] += 1e-4 * np.arange(1, 301)
    level[:, stress] = 123e6 + 1e6 * (np.arange(300) % 2)
    result = result_of(Curve.from_array(np.vstack([rows, level])))
    result.measure(QUASISTATIC)
    assert result.status == "no_peak"
    assert result.without_peak == "no strength was found"
    result.ended_by = "plateau"
    assert "constant at 123.5 MPa" in result.without_peak
