# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whose specimen is held and loaded by parts: how it is cut, held, loaded, measured. SI."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import SimulationError
from ..materials.material import Material
from ..materials.mixing import mineral_materials
from ..models.grains import Model
from ..results.result import Result
from ..results.toughness import bending_toughness
from ..specimens.specimen import Specimen
from .part_rig import PartRig
from .run_spec import RunSpec
from .runner import Runner

#: Joint that a notch is.
_NOTCH = "notch"


@dataclass(frozen=True)
class _Box:
    """The rectangle around a specimen [m]."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def middle(self) -> float:
        return 0.5 * (self.left + self.right)


def prepared(spec: RunSpec, specimen: Specimen, material: Material) -> tuple[Specimen, Material]:
    """The specimen and the material of a test, with its notch if it has one."""
    if not spec.notch:
        return specimen, material
    box = _box(specimen)
    line = [[box.middle, box.bottom], [box.middle, box.bottom + spec.notch]]
    law = {f"joint.{_NOTCH}.open": True}
    return specimen.with_joints({_NOTCH: line}), material.with_set(law, spec.model)


def part_rig(built: Model, spec: RunSpec, runner: Runner | None) -> PartRig:
    """A built specimen between the parts of its test."""
    rig = PartRig(built, kind=spec.test, runner=runner)
    _bend(rig, spec)
    return rig


def measure(result: Result, rig: PartRig, spec: RunSpec) -> None:
    """Fill what the test measures beside its peak."""
    specimen, box = rig.built.specimen, _box(rig.built.specimen)
    notch, height = notch_depth(specimen), box.top - box.bottom
    result.youngs_modulus = None  # the slope of a beam is no constant of the rock
    result.notch_depth = notch
    result.measure_fracture(specimen.thickness * (height - notch))
    if result.peak_load is not None and notch > 0.0 and spec.span is not None:
        result.fracture_toughness = bending_toughness(
            result.peak_load,
            span=spec.span,
            height=height,
            thickness=specimen.thickness,
            notch=notch,
        )


def notch_depth(specimen: Specimen) -> float:
    """How far the notch has been cut from the bottom [m]; 0 without one. Deviation D35."""
    names = specimen.spec.joint_names or ()
    if _NOTCH not in names:
        return 0.0
    ends = specimen.joint_lines()[names.index(_NOTCH)]
    return float(np.max(ends[..., 1])) - _box(specimen).bottom


def _bend(rig: PartRig, spec: RunSpec) -> None:
    """Lay a beam on two rollers and press on its middle. Deviation D39."""
    built, box = rig.built, _box(rig.built.specimen)
    assert spec.span is not None
    height = box.top - box.bottom
    ligament = height - notch_depth(built.specimen)
    supports = [
        rig.support((box.middle + side * 0.5 * spec.span, box.bottom), normal=(0.0, 1.0))
        for side in (-1.0, 1.0)
    ]
    head = rig.support((box.middle, box.top), normal=(0.0, -1.0), pinned=True)
    apart = built.specimen.mean_diameter
    rig.gauge("cmod", (box.middle - apart, box.bottom), (box.middle + apart, box.bottom))
    rig.drive(
        [head],
        (0.0, -1.0),
        against=supports,
        area=2.0 * built.specimen.thickness * ligament**2 / (3.0 * spec.span),
        length=spec.span**2 / (6.0 * height),
        strength=_tensile_strength(built),
    )


def _tensile_strength(built: Model) -> float:
    """Mean over the minerals [Pa]."""
    kinds = mineral_materials(built.material)
    return float(np.mean([kind.law(built.name)["tensile_strength"] for kind in kinds]))


def _box(specimen: Specimen) -> _Box:
    if not isinstance(specimen.outline, np.ndarray):
        raise SimulationError("outline = a circle, must be a polygon for a test between parts")
    (left, bottom), (right, top) = specimen.outline.min(axis=0), specimen.outline.max(axis=0)
    return _Box(left, bottom, right, top)
