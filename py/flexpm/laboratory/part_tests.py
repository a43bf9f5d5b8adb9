# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whose specimen is fixed and loaded by parts: cuts, parts and measures of their kind. SI.

A kind has plain numbers only; this module applies them to specimen, material and rig.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..errors import InputError
from ..kinds.layout import Frame, Lines, Plate
from ..materials.material import Law, Material
from ..materials.mixing import mineral_materials
from ..models.grains import Model
from ..results.result import Result
from ..rigs.part_rig import PartRig
from ..rigs.parts import Part
from ..rigs.places import Place
from ..rigs.solids.part_rig import SolidPartRig
from ..runs.run_spec import RunSpec
from ..runs.runner import Runner
from ..specimens.space.notch import notched
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import AnySpecimen, Specimen

#: Joint that notches are, in these tests.
_NOTCH = "notch"
#: Opening of a notch at the bottom; of a solid that of two lines across the depth.
_MOUTH = "cmod"
#: Share of the height that is round-off.
_TOUCHES = 1e-9


def prepared(
    spec: RunSpec, specimen: AnySpecimen, material: Material
) -> tuple[AnySpecimen, Material]:
    """The specimen and the material of a test, with its notches if it has some.

    Raises:
        InputError: for a notch that cuts the specimen through, or a joint of the specimen that has
            its name and is none.
    """
    kind = spec.kind
    if kind.cut is None:
        return specimen, material
    lines = kind.cut(_frame(spec, specimen, material))
    if isinstance(specimen, SolidSpecimen):
        return _notched(spec, specimen, material, lines), material
    if _NOTCH in (specimen.spec.joint_names or ()):
        _require_notch(spec, specimen, material, bool(lines))
    if not lines:
        return specimen, material
    cut = specimen.with_joints({_NOTCH: lines})
    law = {f"joint.{_NOTCH}.{key}": value for key, value in kind.notch_law.items()}
    _require_ligament(spec, cut, material)
    return cut, material.with_set(law, spec.model)


def _notched(
    spec: RunSpec, specimen: SolidSpecimen, material: Material, lines: Lines
) -> SolidSpecimen:
    """The solid with the notches of its test, if that has some."""
    if not lines:
        return specimen
    # a line goes from the outside to the front, up or down
    cut = notched(specimen, [(x, front, front < edge) for (x, edge), (_, front) in lines])
    if min(cut.depths()) == 0.0:
        raise InputError(
            f"run: notch = {spec.options['notch']:g} m, ends within the first grains, must be "
            "longer than half a grain; use a longer notch or smaller grains"
        )
    _require_ligament(spec, cut, material)
    return cut


def _require_ligament(spec: RunSpec, cut: AnySpecimen, material: Material) -> None:
    frame = _frame(spec, cut, material)
    if not spec.kind.ligament(frame) > _TOUCHES * frame.height:
        raise InputError(
            f"run: notch = {frame.number('notch'):g} m, extends to the end of the last grain "
            "(D35), must leave a ligament; use a shorter notch or smaller grains"
        )


def part_rig(built: Model, spec: RunSpec, runner: Runner | None) -> PartRig:
    """A built specimen between the parts of its test."""
    assert spec.kind.layout is not None, spec.test
    layout = spec.kind.layout(_frame_of(spec, built))
    rig = (SolidPartRig if spec.is_solid else PartRig)(built, kind=spec.test, runner=runner)
    depth = built.specimen.dimensions["depth"] if spec.is_solid else None
    parts = {name: _lay(rig, plate, depth) for name, plate in layout.plates.items()}
    if layout.pressed:
        rig.pressed = parts[layout.pressed]
    rig.drive(
        [parts[name] for name in layout.driven],
        _along(layout.direction, depth),
        against=[parts[name] for name in layout.against],
        area=layout.area,
        length=layout.length,
        strength=layout.strength,
    )
    for name, column in layout.also.items():
        rig.alias_column(name, column)
    for name, one in layout.openings.items():
        if isinstance(rig, SolidPartRig) and name == _MOUTH:
            rig.read_mouth(one.first[0], one.second[0])
            continue
        first, second = (_at(place, depth) for place in (one.first, one.second))
        rig.gauge(name, first, second, along=one.along and _along(one.along, depth))
    for name, (part, direction) in layout.ways.items():
        rig.displacement_of(name, parts[part], _along(direction, depth))
    return rig


def measure(result: Result, rig: PartRig, spec: RunSpec) -> None:
    """Fill the additional measures of the test."""
    if spec.kind.measure is None:
        return
    frame = _frame_of(spec, rig.built)
    across = min(frame.width, spec.kind.ligament(frame))
    # the thickness of the plane is no row of grains
    result.grains_across = min([across, *_depths(rig.built)]) / frame.grain
    for name, value in spec.kind.measure(frame, result.curve, result.peak_stress).items():
        setattr(result, name, value)
    if result.fracture_toughness is not None:
        front = (frame.middle, frame.bottom + frame.notch_depth)
        result.measure_first_cracks(front, frame.height - frame.notch_depth)


def notch_depth(specimen: Specimen) -> float:
    """Return the depth of the notch from the bottom [m]; 0 without a notch. Deviation D35."""
    bottom = specimen.corners[0][1]
    return float(np.max(specimen.lines_of(_NOTCH)[..., 1], initial=bottom)) - bottom


def _lay(rig: PartRig, plate: Plate, depth: float | None) -> Part:
    if plate.side is not None:
        return rig.platen(plate.side, bonded=plate.bonded)
    place, normal = _at(plate.place, depth), _along(plate.normal, depth)
    if isinstance(rig, SolidPartRig) and plate.length is not None and depth is not None:
        edges = (plate.length, depth, plate.length)
        return rig.support(place, edges, normal=normal, pinned=plate.pinned, bonded=plate.bonded)
    return rig.support(
        place,
        plate.length,
        normal=normal,
        pinned=plate.pinned,
        bonded=plate.bonded,
    )


def _at(place: Place, depth: float | None) -> Place:
    """A place of a layout; of a solid, whose x and z it has, in the middle of the depth [m]."""
    return place if depth is None else (place[0], 0.5 * depth, place[1])


def _along(direction: Place, depth: float | None) -> Place:
    """A direction of a layout; of a solid, whose x and z it has."""
    return direction if depth is None else (direction[0], 0.0, direction[1])


def _frame_of(spec: RunSpec, built: Model) -> Frame:
    return _frame(spec, built.specimen, built.material)


def _depths(built: Model) -> list[float]:
    """Depth of a solid [m]; of the plane none."""
    specimen: AnySpecimen = built.specimen
    return [] if specimen.depth is None else [specimen.depth]


def _frame(spec: RunSpec, specimen: AnySpecimen, material: Material) -> Frame:
    (left, bottom), (right, top) = specimen.corners
    return Frame(
        *(left, bottom, right, top),
        thickness=specimen.thickness if specimen.depth is None else specimen.depth,
        grain=specimen.mean_diameter,
        values={"confinement": spec.confinement, **spec.options},
        notch=specimen.lines_of(_NOTCH),
        tensile_strength=_mean(material, spec.model, lambda law: law["tensile_strength"]),
        shear_strength=lambda pressure: _shear_strength(
            specimen, material, spec.model, pressure, () if spec.kind.cut is None else (_NOTCH,)
        ),
    )


def _require_notch(spec: RunSpec, specimen: Specimen, material: Material, cuts: bool) -> None:
    """Refuse a joint named as the notch that is none: strong, or elsewhere."""
    (left, bottom), (right, top) = specimen.corners
    ends = specimen.lines_of(_NOTCH)
    law = next(law for law in material.joint_laws(spec.model) if law["name"] == _NOTCH)
    strength = max(law["cohesion"], law["tensile_strength"])
    x, y = (np.array(ends[..., axis]) for axis in (0, 1))
    aside = float(np.max(np.abs(x - 0.5 * (left + right)), initial=0.0))
    above = float(np.min(y, initial=top)) - bottom
    if cuts:
        what = f"is given in addition to the notch of {spec.notch:g} m that the run cuts"
    elif strength > 0.0:
        what = f"strength = {strength:g} Pa"
    elif above > _TOUCHES * (top - bottom):
        what = f"begins {above:.3g} m above the bottom"
    elif aside > specimen.mean_diameter:
        what = f"is {aside:.3g} m away from the middle"
    else:
        return
    raise InputError(
        f"joint notch: {what}, must be open and go up from the bottom in the middle to be the "
        f"notch of {spec.test}, and the only one; give it another name"
    )


def _shear_strength(
    specimen: AnySpecimen,
    material: Material,
    model: str,
    pressure: float,
    notches: tuple[str, ...],
) -> float:
    """The least c + mu sigma_n [Pa] of the rock and of the specimen's joints but its notches."""
    rock = _mean(material, model, lambda law: law["cohesion"] + law["friction"] * pressure)
    joints = zip(specimen.spec.joint_names or (), specimen.joint_lines(), strict=True)
    there = [name for name, contacts in joints if len(contacts) and name not in notches]
    laws = material.joint_laws(model)
    weak = [law["cohesion"] + law["friction"] * pressure for law in laws if law["name"] in there]
    return float(min([rock, *weak]))


def _mean(material: Material, model: str, value: Callable[[Law], float]) -> float:
    """Mean over the minerals of a value of their laws."""
    return float(np.mean([value(kind.law(model)) for kind in mineral_materials(material)]))
