# SPDX-License-Identifier: GPL-3.0-or-later
"""How loadings of own tests end by default, and what is said of one that still rises. SI units."""

from __future__ import annotations

import numpy as np
import pytest
import yade
from refusals import failure, refusal
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.report.curves import peak_place
from flexpm.results import measures
from flexpm.results.record import COLUMNS, Curve
from flexpm.results.result import Result

WAITING = flexpm.Loading(kind="waiting")


def pressed(solid: bool, model: str, out: object, **drive: float) -> flexpm.PartRig:
    """A specimen between a floor and a platen, both rough."""
    yade.O.reset()
    if solid:
        box = flexpm.Specimen.box(0.006, 0.006, 0.009, diameters=(2e-3, 3e-3), seed=1)
        rig = flexpm.SolidPartRig(flexpm.build(box, model=model), out=out, report=False)
        floor, top = (rig.platen(side, friction=0.3) for side in (0, 2))
        rig.drive(top, (0.0, 0.0, -1.0), against=floor, **drive)
        return rig
    plate = flexpm.Specimen.rectangle(0.008, 0.012, 0.01, seed=1)
    rig = flexpm.PartRig(flexpm.build(plate, model=model), out=out, report=False)
    floor, top = (rig.platen(side, friction=0.3) for side in (0, 2))
    rig.drive(top, (0.0, -1.0), against=floor, **drive)
    return rig


@pytest.mark.parametrize("solid", [False, True])
def test_a_load_that_still_rises_at_the_default_end_is_no_peak(solid, tmp_path):
    rig = pressed(solid, "rigid", tmp_path, strength=20.0)  # far below what it bears
    rig.load(WAITING)
    reached = rig.record["displacement"][-1]
    line = f"status = no_peak, the load still rose at displacement = {reached:.3g} m"
    assert [one for one in rig.warnings if one.startswith(line)]
    rig.finish()
    result = Result.read(tmp_path)
    assert (result.status, result.peak_load, peak_place(result)) == ("no_peak", None, None)
    assert result.failed
    assert "give a larger Loading(max_strain=...)" in " ".join(result.warnings)
    # one that the script ends is no failure, but its last load is no peak either
    rig.load(flexpm.Loading(kind="waiting", max_strain=1.5 * reached))
    rig.finish()
    result = Result.read(tmp_path)
    assert (result.status, result.peak_load, peak_place(result)) == ("ok", None, None)
    assert not [one for one in result.warnings if "no_peak" in one]


def test_what_turns_and_what_has_a_length_tell_it_in_their_units(tmp_path):
    rig = pressed(False, "rigid", None, length=0.012, area=8e-5, strength=1e6)
    rig.load(WAITING)
    assert "still rose at axial strain = " in rig.warnings[-1]
    beam = flexpm.Specimen.rectangle(0.03, 0.008, 0.01, seed=1)
    rig = flexpm.PartRig(fresh(beam, model="rigid"))
    rig.hold(box=((0.0, 0.0), (0.006, 0.008)))
    rig.rotate(rig.hold(where=lambda x, y: x > 0.024), strength=1e-3)
    rig.load(WAITING)
    assert " rad, where a loading ends by default" in rig.warnings[-1]


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_an_indentation_comes_to_its_peak_by_default(model, tmp_path):
    block = flexpm.Specimen.rectangle(0.02, 0.012, 0.01, diameters=(1e-3, 2e-3), seed=1)
    rig = flexpm.PartRig(fresh(block, model=model), out=tmp_path, report=False)
    base, punch = rig.platen(0, friction=0.3), rig.support((0.01, 0.012), 0.003)
    rig.drive(punch, (0.0, -1.0), against=base)
    rig.load(WAITING)
    rig.finish()
    result = Result.read(tmp_path)
    assert result.status == "ok" and result.tensile_cracks > 10
    record = result.curve["load"]
    assert result.peak_load == record.max() and record[-1] < 0.9 * record.max()


@pytest.mark.long
def test_the_indentation_of_a_solid_comes_to_its_peak_by_default():
    box = flexpm.Specimen.box(0.012, 0.012, 0.008, seed=1)
    rig = flexpm.SolidPartRig(fresh(box, "augig3d-calibrated"))
    base = rig.platen(0)
    punch = rig.support((0.006, 0.006, 0.008), (0.003, 0.003, 0.002))
    rig.drive(punch, (0.0, 0.0, -1.0), against=base)
    rig.load(WAITING)
    assert measures.peak_row(rig.record) is not None
    assert rig.warnings == []


@pytest.mark.long
def test_a_point_load_across_a_core_comes_to_its_peak_by_default():
    core = flexpm.Specimen.cylinder(0.01, 0.012, diameters=(2e-3, 3e-3), seed=1)
    rig = flexpm.SolidPartRig(fresh(core, "augig3d-calibrated-rigid", "rigid"))
    tips = [
        rig.support(
            (x, 0.0, 0.006), (0.003, 0.003, 0.003), normal=(-x / abs(x), 0, 0), friction=0.3
        )
        for x in (-0.005, 0.005)
    ]
    rig.drive(tips[1], (-1.0, 0.0, 0.0), against=tips[0])
    rig.load(WAITING)
    assert measures.peak_row(rig.record) is not None
    assert rig.record["load"].max() > 0.0


def test_supports_that_let_a_core_turn_are_refused_with_the_motion():
    """A diametral point load of smooth supports: round-off resists it."""
    core = flexpm.Specimen.cylinder(0.01, 0.012, diameters=(2e-3, 3e-3), seed=1)
    rig = flexpm.SolidPartRig(fresh(core, model="rigid"))
    size = (0.003, 0.003, 0.003)
    one, two = (
        rig.support((x, 0.0, 0.006), size, normal=(-x / abs(x), 0, 0)) for x in (-0.005, 0.005)
    )
    rig.drive(two, (-1.0, 0.0, 0.0), against=one)
    line = "load: resistance of the supports = 0 N, must be > 0: the specimen rotates about y "
    with pytest.raises(InputError, match=line) as raised:
        rig.load(WAITING)
    assert str(raised.value).endswith("give a part friction or a pin, or fix nodes")


def curve_of(strain: np.ndarray, stress: np.ndarray) -> Curve:
    curve = Curve(())
    for row, (x, y) in enumerate(zip(strain, stress, strict=True)):
        values = dict.fromkeys(COLUMNS, 0.0) | {"step": row, "axial_strain": x, "axial_stress": y}
        curve.append(**values)
    return curve


def test_a_straight_line_rises_and_a_plateau_or_a_peak_does_not():
    strain = np.linspace(0.0, 1.0, 101)[1:]
    assert measures.still_rises(curve_of(strain, strain))
    assert not measures.still_rises(curve_of(strain, np.minimum(strain, 0.5)))
    assert not measures.still_rises(curve_of(strain, np.minimum(strain, 1.2 - strain)))
    assert measures.still_rises(curve_of(strain, 1.0 + 0.5 * strain))
    assert not measures.still_rises(curve_of(strain[:0], strain[:0]))
    assert not measures.still_rises(curve_of(strain, -strain))


def test_load_takes_a_loading_alone_and_a_watch_no_stage(tmp_path):
    for solid in (False, True):
        for out in (None, tmp_path / str(solid)):
            rig = pressed(solid, "rigid", out)
            refusal(r"load: loading = 5, must be a flexpm\.Loading", rig.load, 5)
            rig.watch = lambda rig: rig.strain_to(1e-6)
            failure("watch: the callback called strain_to", rig.strain_to, 1e-7)
            rig.watch = None


@pytest.mark.parametrize("solid", [False, True])
def test_a_gauge_is_read_before_the_record_begins(solid):
    rig = pressed(solid, "rigid", None)
    across = (0.003, 0.003) if solid else (0.004,)
    rig.gauge("sag", (*across, 0.003), (*across, 0.007))
    assert rig.reading("sag") == 0.0 and len(rig.record) == 0
    rig.strain_to(1e-7)
    assert rig.reading("sag") == pytest.approx(rig.record["sag"][-1], rel=1e-9)
    refusal("reading: gauge = 'sagg', unknown", rig.reading, "sagg")
