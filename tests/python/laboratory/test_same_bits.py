# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of all tests, in 2D and 3D: two threads, a stop and a folder that is read change no bit."""

from __future__ import annotations

import functools

import pytest
from stopped_runs import same, taken_up

import flexpm
from flexpm import Specimen

MIDDLE, WEAK = 0.008, {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": 0.5}
#: Small specimens, each packed once.
SPECIMENS = {
    "plane bar": lambda: Specimen.rectangle(0.01, 0.02, 0.08, seed=1),
    "plane beam": lambda: Specimen.rectangle(0.056, 0.012, thickness=0.01, seed=1),
    "slab": lambda: Specimen.rectangle(0.02, 0.04, 0.01, diameters=(5e-4, 1e-3), seed=1),
    "joint": lambda: Specimen.rectangle(0.024, 2.0 * MIDDLE, thickness=0.01, seed=1).with_joints(
        {"plane": [(0.0, MIDDLE), (0.024, MIDDLE)]}
    ),
    "core": lambda: Specimen.cylinder(0.01, 0.016, seed=1),
    "box": lambda: Specimen.box(0.009, 0.008, 0.014, seed=2),
    "beam": lambda: Specimen.box(0.036, 0.008, 0.008, seed=1),
    "disc": lambda: Specimen.solid_disc(0.014, 0.008, seed=1),
    "half disc": lambda: Specimen.solid_half_disc(0.024, 0.008, seed=1),
    "punched": lambda: Specimen.box(0.03, 0.008, 0.02, seed=1),
    "sheared": lambda: Specimen.box(0.016, 0.009, 0.012, seed=1),
    "bar": lambda: Specimen.box(0.0066, 0.0066, 0.16, diameters=(2.8e-3, 3.2e-3), seed=1),
}
made = functools.cache(lambda name: SPECIMENS[name]())


def half(whole):
    return [whole.steps // 2]


def late(whole):
    """A step in the loading, half of the run behind its first hundred steps."""
    return [whole.steps // 2 + 100]


def amid_cracks(whole):
    assert whole.cracks[0].step < whole.cracks[len(whole.cracks) // 2].step - 20
    return [whole.cracks[len(whole.cracks) // 2].step]


def under_pressure_and_load(whole):
    settled = int(whole.curve["step"][0])
    return [settled // 2, settled + 30]


def plane_shear(stops, **options):
    return ("shear", "joint", "rigid", stops, {"normal_stress": 2e6, **options})


PUNCH = {"max_displacement": 1e-5, "rate": 4.0, "notch": 0.003, "distance": 0.0115}
PRESSURES = {"max_strain": 8e-4, "confinement": 4e6, "second_confinement": 9e6, "rate": 0.1}
CRACKING = {"report": False, "rate": 4.0}
SHORT = [
    ("uniaxial", "plane bar", "rigid", late, {"loading": "waiting", "rate": 4.0}),
    ("bending", "plane beam", "rigid", [3000], {"span": 0.048, "notch": 0.0048, "rate": 4.0}),
    ("sonic", "slab", "rigid", [50], {"wave": "s"}),
    plane_shear([100]),
    plane_shear(late),
    plane_shear(late, rate=20.0, max_displacement=1.5e-3),  # faces get new partners
    ("sonic", "bar", "rigid", [60], {"wave": "s"}),
]
LONG = [
    ("uniaxial", "core", "flexible", [60], {"max_strain": 8e-4, "rate": 0.1}),
    ("uniaxial", "core", "rigid", [60], {"max_strain": 8e-4, "rate": 0.1}),
    ("uniaxial", "core", "flexible", half, {"max_strain": 4e-3, "rate": 4.0}),
    ("uniaxial", "core", "rigid", half, {"max_strain": 4e-3, "rate": 4.0}),
    ("tension", "core", "flexible", amid_cracks, CRACKING),
    ("tension", "core", "rigid", amid_cracks, CRACKING),
    ("triaxial", "box", "flexible", under_pressure_and_load, PRESSURES),
    ("triaxial", "box", "rigid", under_pressure_and_load, PRESSURES),
    ("bending", "beam", "flexible", half, {"max_strain": 4e-4, "rate": 8.0}),
    ("bending", "beam", "rigid", half, {"max_strain": 4e-4, "rate": 8.0, "notch": 0.003}),
    ("brazilian", "disc", "flexible", half, {"max_strain": 2e-3, "rate": 4.0}),
    ("brazilian", "disc", "rigid", half, {"max_strain": 2e-3, "rate": 4.0}),
    ("scb", "half disc", "flexible", half, {"max_strain": 4e-4, "rate": 4.0}),
    ("punch", "punched", "flexible", [60], {"confinement": 0.0, **PUNCH}),
    ("punch", "punched", "rigid", [60], {"confinement": 5e6, **PUNCH}),
    ("shear", "sheared", "flexible", [40, 140], {"max_displacement": 1e-5, "rate": 4.0}),
    ("shear", "sheared", "rigid", [40, 140], {"max_displacement": 1e-5, "rate": 4.0}),
    ("sonic", "bar", "flexible", [300], {"wave": "p"}),
]


@pytest.mark.parametrize(
    ("test", "name", "model", "stops", "options"),
    [*SHORT, *(pytest.param(*case, marks=pytest.mark.long) for case in LONG)],
)
def test_threads_and_a_stop_change_no_bit(test, name, model, stops, options, tmp_path, monkeypatch):
    asked = {"model": model, **options}
    if name == "joint":
        law = {f"joint.plane.{key}": value for key, value in WEAK.items()}
        asked["material"] = flexpm.materials.load("augig-table7").with_set(law)
    whole = flexpm.run(test, made(name), threads=2, **asked)
    for number, last in enumerate(stops if isinstance(stops, list) else stops(whole)):
        out = tmp_path / str(number)
        again = taken_up(monkeypatch, out, last, test, made(name), **asked)
        assert last - 20 <= again.resumed_at <= last + 1000
        assert again.resumed_at < whole.steps
        assert same(again, whole)
        assert again.cracks == whole.cracks
        assert flexpm.run(test, made(name), out=out, **asked).steps == whole.steps
