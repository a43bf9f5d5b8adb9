# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whose specimen is held and loaded by parts: how it is cut, held, loaded, measured. SI."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError, SimulationError
from ..materials.material import Law, Material
from ..materials.mixing import mineral_materials
from ..models.grains import Model
from ..results.result import Result
from ..results.toughness import bending_toughness, half_disc_toughness
from ..rigs.parts import Part
from ..specimens.specimen import Specimen
from .part_rig import PartRig
from .rig import BOTTOM, TOP
from .run_spec import RunSpec
from .runner import Runner

#: Joint that a notch is, in these tests.
_NOTCH = "notch"
_BENDING = ("bending", "scb")
#: Share of the height that is round-off.
_TOUCHES = 1e-9


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
    """The specimen and the material of a test, with its notch if it has one.

    Raises:
        InputError: for a notch that cuts the specimen through, or a joint of the specimen that has
            its name and is none.
    """
    if spec.test in _BENDING and _NOTCH in (specimen.spec.joint_names or ()):
        _require_notch(spec, specimen, material)
    if not spec.notch:
        return specimen, material
    box = _box(specimen)
    line = [[box.middle, box.bottom], [box.middle, box.bottom + spec.notch]]
    law = {f"joint.{_NOTCH}.open": True}
    cut = specimen.with_joints({_NOTCH: line})
    if not notch_depth(cut) < box.top - box.bottom:
        raise InputError(
            f"run: notch = {spec.notch:g} m, goes on to the end of the last grain (D35), "
            "must leave a ligament; take a shorter notch or smaller grains"
        )
    return cut, material.with_set(law, spec.model)


def part_rig(built: Model, spec: RunSpec, runner: Runner | None) -> PartRig:
    """A built specimen between the parts of its test."""
    rig = PartRig(built, kind=spec.test, runner=runner)
    _LAYOUTS[spec.test](rig, spec)
    return rig


def measure(result: Result, rig: PartRig, spec: RunSpec) -> None:
    """Fill what the test measures beside its peak."""
    result.youngs_modulus = None  # the slope of a beam or a box is no constant of the rock
    if spec.test == "shear":
        result.measure_residual()
        return
    specimen, box = rig.built.specimen, _box(rig.built.specimen)
    notch, height = notch_depth(specimen), box.top - box.bottom
    result.notch_depth = notch
    result.grains_across = grains_across(specimen, notch)
    result.measure_fracture(specimen.thickness * (height - notch))
    if result.peak_load is None or not notch > 0.0 or spec.span is None:
        return
    shape = {"span": spec.span, "thickness": specimen.thickness, "notch": notch}
    if spec.test == "scb":
        radius = 0.5 * (box.right - box.left)
        result.fracture_toughness = half_disc_toughness(result.peak_load, radius=radius, **shape)
    else:
        result.fracture_toughness = bending_toughness(result.peak_load, height=height, **shape)


def grains_across(specimen: Specimen, notch: float = 0.0) -> float:
    """Smallest size over the mean grain [-].

    Args:
        specimen: Its joints make smaller grains of those that they cut.
        notch: Depth that the height lacks [m].
    """
    if not isinstance(specimen.outline, np.ndarray):
        return specimen.dimensions["diameter"] / specimen.mean_diameter
    box = _box(specimen)
    return min(box.right - box.left, box.top - box.bottom - notch) / specimen.mean_diameter


def notch_depth(specimen: Specimen) -> float:
    """How far the notch has been cut from the bottom [m]; 0 without one. Deviation D35."""
    bottom = _box(specimen).bottom
    return float(np.max(_notch(specimen)[..., 1], initial=bottom)) - bottom


def _notch(specimen: Specimen) -> FloatArray:
    """Ends (n, 2, 2) [m] of the contacts of the notch."""
    names = specimen.spec.joint_names or ()
    return specimen.joint_lines()[names.index(_NOTCH)] if _NOTCH in names else np.empty((0, 2, 2))


def _require_notch(spec: RunSpec, specimen: Specimen, material: Material) -> None:
    """Refuse a joint named as the notch that is none: strong, or elsewhere."""
    box, ends = _box(specimen), _notch(specimen)
    law = next(law for law in material.joint_laws(spec.model) if law["name"] == _NOTCH)
    strength = max(law["cohesion"], law["tensile_strength"])
    x, y = (np.array(ends[..., axis]) for axis in (0, 1))
    aside = float(np.max(np.abs(x - box.middle), initial=0.0))
    above = float(np.min(y, initial=box.top)) - box.bottom
    if spec.notch:
        what = f"comes beside the notch of {spec.notch:g} m that the run cuts"
    elif strength > 0.0:
        what = f"strength = {strength:g} Pa"
    elif above > _TOUCHES * (box.top - box.bottom):
        what = f"begins {above:.3g} m above the bottom"
    elif aside > specimen.mean_diameter:
        what = f"is {aside:.3g} m beside the middle"
    else:
        return
    raise InputError(
        f"joint notch: {what}, must be open and go up from the bottom in the middle to be the "
        f"notch of {spec.test}, and the only one; give it another name"
    )


def _bend(rig: PartRig, spec: RunSpec) -> None:
    """Lay a beam, or half a disc, on two rollers and press on its middle.

    Deviations D39 and D50.
    """
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
        strength=_mean(built, lambda law: law["tensile_strength"]),
    )


def _shear(rig: PartRig, spec: RunSpec) -> None:
    """Put the halves of a rectangle into two boxes, the lower one driven. Deviation D46."""
    built, box = rig.built, _box(rig.built.specimen)
    width, height = box.right - box.left, box.top - box.bottom
    gap = built.specimen.mean_diameter
    length, middle = 0.5 * (height - gap), 0.5 * (box.bottom + box.top)

    def ends(place: float) -> list[Part]:
        return [
            rig.support((x, place), length, normal=(inwards, 0.0), bonded=True)
            for x, inwards in ((box.left, 1.0), (box.right, -1.0))
        ]

    lower, upper = ends(box.bottom + 0.5 * length), ends(box.top - 0.5 * length)
    rig.platen(BOTTOM, bonded=True)
    rig.pressed = lid = rig.platen(TOP)
    rig.drive(
        lower,
        (1.0, 0.0),
        against=upper,
        area=width * built.specimen.thickness,
        length=height,
        strength=_shear_strength(built, spec.normal_stress or 0.0),
    )
    above, below = ((box.middle, middle + side * 0.5 * gap) for side in (1.0, -1.0))
    rig.also("shear_stress", "axial_stress")
    rig.gauge("shear_displacement", above, below, along=(1.0, 0.0))
    rig.way_of("dilation", lid, (0.0, 1.0))


def _shear_strength(built: Model, pressure: float) -> float:
    """The least c + mu sigma_n [Pa] of the rock and of the specimen's joints."""
    rock = _mean(built, lambda law: law["cohesion"] + law["friction"] * pressure)
    joints = zip(built.specimen.spec.joint_names or (), built.specimen.joint_lines(), strict=True)
    there = [name for name, contacts in joints if len(contacts)]
    laws = built.material.joint_laws(built.name)
    weak = [law["cohesion"] + law["friction"] * pressure for law in laws if law["name"] in there]
    return float(min([rock, *weak]))


def _mean(built: Model, value: Callable[[Law], float]) -> float:
    """Mean over the minerals of a value of their laws."""
    kinds = mineral_materials(built.material)
    return float(np.mean([value(kind.law(built.name)) for kind in kinds]))


_LAYOUTS: dict[str, Callable[[PartRig, RunSpec], None]] = {
    **dict.fromkeys(_BENDING, _bend),
    "shear": _shear,
}


def _box(specimen: Specimen) -> _Box:
    if not isinstance(specimen.outline, np.ndarray):
        raise SimulationError("outline = a circle, must be a polygon for a test between parts")
    (left, bottom), (right, top) = specimen.outline.min(axis=0), specimen.outline.max(axis=0)
    return _Box(left, bottom, right, top)
