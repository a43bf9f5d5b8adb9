# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids under control of a measure: what the servo follows, peaks, the same bits. D51."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yade
from scenes import fresh

import flexpm
from flexpm.errors import InputError
from flexpm.materials.material import default_name

SIZE = 0.012


def follows(curve, column: str) -> float:
    """Part of the rows in which a column is within 2 % of its set point [-]."""
    assert np.all(np.diff(curve["set_point"]) > 0.0)
    return float(np.mean(np.abs(curve[column] / curve["set_point"] - 1.0) < 0.02))


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_an_elastic_box_is_loaded_as_without_control(model):
    box = flexpm.Specimen.box(SIZE, SIZE, SIZE, seed=1)
    rig = flexpm.SolidPartRig(fresh(box, "augig-table7", model))
    base, top = rig.platen(0), rig.platen(2)
    rig.gauge("across", (0.0, 0.5 * SIZE, 0.5 * SIZE), (SIZE, 0.5 * SIZE, 0.5 * SIZE))
    rig.displacement_of("way", top, (0, 0, -1))
    rig.drive(top, (0, 0, -1), against=base, area=SIZE**2, length=SIZE)
    with pytest.raises(InputError, match="must be one of load, across, way"):
        rig.load(flexpm.Loading(kind="waiting", control="stress"))
    rig.load(flexpm.Loading(0.1, kind="waiting", control="across", max_strain=1.5e-4))
    record = rig.record
    row = np.searchsorted(record["axial_strain"], 1e-4)
    assert record["set_point"][row] == pytest.approx(record["across"][row], rel=0.05)
    speeds = np.diff(record["displacement"][2:row])
    assert speeds.min() > 0.9 * speeds.max()


@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_core_under_lateral_control_has_the_same_peak(model):
    core = flexpm.Specimen.cylinder(SIZE, 2.0 * SIZE, seed=1)
    free = flexpm.run("uniaxial", core, "augig-table7", model)
    led = flexpm.run("uniaxial", core, "augig-table7", model, control="lateral")
    assert follows(led.curve, "lateral_strain") > 0.9
    assert led.peak_stress == pytest.approx(free.peak_stress, rel=0.03)
    assert led.energy_error < 1e-2


@pytest.mark.long
def test_a_notched_beam_under_control_of_its_mouth():
    beam = flexpm.Specimen.box(0.036, 0.009, 0.009, seed=1)
    free = flexpm.run("bending", beam, default_name("rigid"), "rigid", notch=0.003)
    led = flexpm.run("bending", beam, default_name("rigid"), "rigid", notch=0.003, control="cmod")
    assert follows(led.curve, "cmod") > 0.9
    assert led.peak_load == pytest.approx(free.peak_load, rel=0.03)


def test_other_threads_and_a_saved_scene_give_the_same_bits(tmp_path: Path):
    core = flexpm.Specimen.cylinder(SIZE, 2.0 * SIZE, seed=1)
    records = []
    for threads in (1, 2):
        rig = flexpm.rig(fresh(core, "augig-table7", "rigid", threads=threads))
        rig.start(flexpm.Loading(kind="waiting", control="lateral_strain"))
        for step in range(2500):
            if threads == 2 and step == 1700:
                yade.O.save(str(tmp_path / "scene.bin"), quiet=True)
                yade.O.load(str(tmp_path / "scene.bin"), quiet=True)
                rig.built.rebind()
                rig = flexpm.rig(rig.built)
            yade.O.step()
        records.append(rig.record.array)
    assert np.array_equal(*records, equal_nan=True)
