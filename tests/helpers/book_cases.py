# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of the verification book that are measured on packings: what flexpm finds over the formula.

Each case is one function of a fineness, the grains across a length or one over the loading rate,
and of a number, the seed of the packing or a pressure; ``book.py`` runs all of them. SI units.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade
from strip_case import open_strip

from flexpm.arrays import FloatArray
from flexpm.kinds import toughness
from flexpm.laboratory.part_tests import notch_depth
from flexpm.results import waves
from flexpm.results.cracks import TENSILE
from flexpm.results.record import Curve
from flexpm.results.snapshot import Snapshot
from flexpm.rigs.part_rig import PartRig
from flexpm.rigs.rig import BOTTOM, TOP
from flexpm.runs.loading_rate import Loading

THICKNESS = 0.08
#: Diameters of the grains over their mean [-], as the paper's.
_SPREAD = (2.0 / 3.0, 4.0 / 3.0)


@dataclass(frozen=True)
class Measured:
    """What flexpm gives, over what the formula says."""

    ratio: float  #: [-]
    grains: int  #: of the specimen


def diameters(mean: float) -> tuple[float, float]:
    """Smallest and largest diameter of the grains [m]."""
    low, high = _SPREAD
    return low * mean, high * mean


def speed(model: str, wave: str, across: int, seed: int) -> Measured:
    """Speed of a plane wave over that of a continuum with E and nu of the same packing.

    Args:
        model: ``flexible`` or ``rigid``.
        wave: ``p`` or ``s``.
        across: Grains over the width of the specimen, whose height is twice that.
        seed: Seed of the packing.
    """
    width = 0.08
    specimen = flexpm.Specimen.rectangle(
        width, 2.0 * width, THICKNESS, diameters=diameters(width / across), seed=seed
    )
    result = flexpm.run("sonic", specimen, model=model, wave=wave, report=False)
    found = result.vp if wave == "p" else result.vs
    elastic = flexpm.elastic(specimen, model=model)
    modulus = waves.modulus(wave, elastic["youngs_modulus"], elastic["poissons_ratio"])
    density = flexpm.materials.load(None, model).law(model)["density"]
    assert found is not None
    return Measured(found / math.sqrt(modulus / density), len(specimen.discs))


def intensity(shape: str, across: int, seed: int) -> Measured:
    """K_I by the compliance over seven lengths of a notch, over the handbook's.

    Contacts are a hundred times stiffer than the rock's, and nothing breaks. The compliance is that
    of the elastic solution; its growth with the notch, fitted to that by the handbook's K_I and by
    E of the same packing, is the square of the ratio.

    Args:
        shape: ``beam``, of a span of 2.5 heights, or ``half-disc``, of one of 0.6 diameters.
        across: Grains over the height of the beam, or over the radius.
        seed: Seed of the packing.
    """
    case = _SHAPES[shape]
    grains = diameters(_HEIGHT / across)
    specimen = case.specimen(grains, seed)
    block = flexpm.Specimen.rectangle(case.width, _HEIGHT, THICKNESS, diameters=grains, seed=seed)
    depths, compliances = [], []
    for ratio in np.linspace(*case.ratios, 7):
        line = [[case.width / 2, 0.0], [case.width / 2, ratio * _HEIGHT]]
        cut = specimen.with_joints({"notch": line})
        depths.append(notch_depth(cut))
        compliances.append(1.0 / _stiffness(cut, case))
    young = flexpm.elastic(block, _stiff_rock())["youngs_modulus"]
    theory = _compliance(np.array(depths), case.squared, young)
    slope, _ = np.polyfit(theory, compliances, 1)
    return Measured(math.sqrt(slope), len(specimen.discs))


@dataclass(frozen=True)
class _Shape:
    """A notched specimen between supports, whose height is ``_HEIGHT``."""

    specimen: Callable[[tuple[float, float], int], flexpm.Specimen]
    width: float  #: [m]
    span: float  #: [m]
    ratios: tuple[float, float]  #: of the notch over the height [-]
    squared: Callable[[float], float]  #: K_I squared under a unit load by the notch [Pa2 m / N2]


_HEIGHT = 0.04
_BEAM_SPAN, _DISC_SPAN = 2.5 * _HEIGHT, 0.6 * 2.0 * _HEIGHT


def _beam(grains: tuple[float, float], seed: int) -> flexpm.Specimen:
    return flexpm.Specimen.rectangle(2.8 * _HEIGHT, _HEIGHT, THICKNESS, diameters=grains, seed=seed)


def _half_disc(grains: tuple[float, float], seed: int) -> flexpm.Specimen:
    return flexpm.Specimen.half_disc(2.0 * _HEIGHT, THICKNESS, diameters=grains, seed=seed)


def _beam_squared(notch: float) -> float:
    if not notch > 0.0:
        return 0.0
    shape = {"span": _BEAM_SPAN, "height": _HEIGHT, "thickness": THICKNESS}
    return toughness.bending_toughness(1.0, notch=notch, **shape) ** 2


def _half_disc_squared(notch: float) -> float:
    # also below the range of the function: that part is the same for all notches
    stress = 0.5 / (_HEIGHT * THICKNESS)
    function = toughness.half_disc_function(notch / _HEIGHT, 0.5 * _DISC_SPAN / _HEIGHT)
    return stress**2 * math.pi * notch * function**2


_SHAPES = {
    "beam": _Shape(_beam, 2.8 * _HEIGHT, _BEAM_SPAN, (0.2, 0.6), _beam_squared),
    "half-disc": _Shape(_half_disc, 2.0 * _HEIGHT, _DISC_SPAN, (0.4, 0.6), _half_disc_squared),
}


def _stiff_rock() -> flexpm.Material:
    rock = flexpm.materials.load("augig-table7")
    return rock.with_set(
        {
            "normal_stiffness": 100.0 * rock.law("flexible")["normal_stiffness"],
            **dict.fromkeys(("tensile_strength", "cohesion"), 1e12),
            **dict.fromkeys(("tensile_fracture_energy", "shear_fracture_energy"), 1e9),
        },
        "flexible",
    )


def _stiffness(cut: flexpm.Specimen, case: _Shape) -> float:
    """Load over displacement of a notched specimen by its elastic solution [N/m]."""
    yade.O.reset()
    built = flexpm.build(cut, _stiff_rock().with_set({"joint.notch.open": True}, "flexible"))
    # the contacts of the notch would bear what the first elastic solution presses on them
    on = np.flatnonzero(cut.edge_joints >= 0)
    for one in [one for one in yade.O.interactions if one.phys.contact in on]:
        yade.O.interactions.erase(one.id1, one.id2)
    rig, middle = PartRig(built), case.width / 2
    top = float(cut.outline[:, 1].max())
    rollers = [rig.support((middle + side * case.span / 2, 0.0), normal=(0, 1)) for side in (-1, 1)]
    head = rig.support((middle, top), normal=(0, -1), pinned=True)
    rig.drive([head], (0.0, -1.0), against=rollers)
    return rig.scales().modulus


def _compliance(notches: FloatArray, squared: Callable[[float], float], young: float) -> FloatArray:
    """What notches add to the compliance [m/N]: 2 t / E times the integral of K_I^2 / P^2."""
    grid = np.linspace(0.0, 1.001 * notches.max(), 2000)
    values = np.array([squared(float(notch)) for notch in grid])
    sums = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(grid))])
    found: FloatArray = 2.0 * THICKNESS / young * np.interp(notches, grid, sums)
    return found


def onset(model: str, fineness: float, pressure: int) -> Measured:
    """Largest shear stress of two blocks with one contact over c + mu sigma_n.

    Args:
        model: ``flexible`` or ``rigid``.
        fineness: One over the factor on the loading rate.
        pressure: sigma_n [MPa].
    """
    width, height, friction, cohesion = 0.02, 0.01, 0.6, 2e6
    lower = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
    blocks = flexpm.Specimen.from_polygons([lower, lower + np.array([0.0, height])], THICKNESS)
    law = {"cohesion": cohesion, "friction": friction, "tensile_strength": 1e6}
    rock = flexpm.materials.load("augig-table7", model).with_set(law, model)
    strength = cohesion + friction * 1e6 * pressure
    yade.O.reset()
    rig = PartRig(flexpm.build(blocks, rock, model), kind="shear")
    boxes = [
        [
            rig.support((x, y), 0.9 * height, normal=(inwards, 0.0), bonded=True)
            for x, inwards in ((0.0, 1.0), (width, -1.0))
        ]
        for y in (0.5 * height, 1.5 * height)
    ]
    rig.platen(BOTTOM, bonded=True)
    lid = rig.platen(TOP)
    rig.drive(
        boxes[0],
        (1.0, 0.0),
        against=boxes[1],
        area=width * THICKNESS,
        length=2.0 * height,
        strength=strength,
    )
    rig.press(lid, 1e6 * pressure)
    rig.load(Loading(1.0 / fineness))
    return Measured(float(rig.record["axial_stress"].max()) / strength, 2)


def _sheared(
    model: str, fineness: float, seed: int, *, width: float, grains: float | None = None
) -> tuple[flexpm.Specimen, Curve, FloatArray]:
    """Shear test of a joint without cohesion: specimen, record and its stress over mu sigma_n.

    Args:
        model: ``flexible`` or ``rigid``.
        fineness: One over the factor on the loading rate.
        seed: Seed of the packing.
        width: Width of the specimen [m].
        grains: Displacement over the mean diameter; None for that of the test.
    """
    height, friction, pressure = 0.016, 0.5, 2e6
    law = {"normal_stiffness": 1.8e13, "shear_stiffness": 5e12, "friction": friction}
    rock = flexpm.materials.load("augig-table7", model).with_set(
        {f"joint.plane.{key}": value for key, value in law.items()}, model
    )
    whole = flexpm.Specimen.rectangle(width, height, 0.01, seed=seed)
    cut = whole.with_joints({"plane": [(0.0, height / 2), (width, height / 2)]})
    result = flexpm.run(
        *("shear", cut, rock, model),
        rate=1.0 / fineness,
        normal_stress=pressure,
        max_displacement=None if grains is None else grains * _mean_diameter(cut),
        report=False,
    )
    return cut, result.curve, result.curve["shear_stress"] / (friction * pressure)


def _mean_diameter(specimen: flexpm.Specimen) -> float:
    return 2.0 * float(specimen.discs[:, 2].mean())


def sliding(model: str, fineness: float, seed: int) -> Measured:
    """Largest stress of a shear test of a joint without cohesion over mu sigma_n.

    Args:
        model: ``flexible`` or ``rigid``.
        fineness: One over the factor on the loading rate.
        seed: Seed of the packing.
    """
    specimen, _, stress = _sheared(model, fineness, seed, width=0.024)
    return Measured(float(stress.max()), len(specimen.discs))


def sliding_far(model: str, fineness: float, seed: int) -> Measured:
    """Mean stress over mu sigma_n of such a test, from a slip of a tenth to three mean diameters.

    Args:
        model: ``flexible`` or ``rigid``.
        fineness: One over the factor on the loading rate.
        seed: Seed of the packing.
    """
    specimen, curve, stress = _sheared(model, fineness, seed, width=0.036, grains=3.0)
    slides = curve["shear_displacement"] > 0.1 * _mean_diameter(specimen)
    return Measured(float(np.mean(stress[slides])), len(specimen.discs))


#: Half the length of a closed crack, and the side of the square that it lies in [m].
_HALF_CRACK, _PLATE = 0.01, 0.1
#: Compression at which cracks have left both tips, and none has crossed the plate [-].
_KINK_STRAIN = 4.8e-4


def closed_crack(fineness: float, seed: int) -> Measured:
    """Slip of a closed crack without friction under compression, over that of a continuum.

    The elastic solution tells it: contacts are a hundred times stiffer than the rock's.

    Args:
        fineness: Mean grains in half the length.
        seed: Seed of the packing.
    """
    rock = _stiff_rock()
    plate, cut = _cracked_plate(fineness, seed)
    rig = flexpm.rig(flexpm.build(cut, _with_crack(rock, {"shear_stiffness": 1e3})))
    modulus = rig.scales().modulus
    rig.start(Loading())
    yade.O.step()  # with the velocities of the elastic solution
    state = rig.built.snapshot()
    top = state.reference[:, 1] > (1.0 - 1e-6) * _PLATE
    strain = -float(np.mean((state.positions - state.reference)[top, 1])) / _PLATE
    ratio = _slip_ratio(cut, state, 0.5 * modulus * strain, flexpm.elastic(plate, rock))
    return Measured(ratio, len(plate.discs))


def rubbing_crack(fineness: float, seed: int) -> Measured:
    """The same of a crack with friction, at the end of a slow compression that breaks nothing.

    Args:
        fineness: Mean grains in half the length.
        seed: Seed of the packing.
    """
    friction = 0.3
    # strengths that are never reached, of which the strain at the end follows
    rock = _stiff_rock().with_set(dict.fromkeys(("tensile_strength", "cohesion"), 1e6), "flexible")
    plate, cut = _cracked_plate(fineness, seed)
    rig = flexpm.rig(flexpm.build(cut, _with_crack(rock, {"friction": friction})))
    # small strains, so that no grains but the bonded ones come to touch
    rig.load(Loading(0.05, "waiting", max_strain=0.1 * rig.reference_strain, stop_ratio=0.01))
    driving = 0.5 * (1.0 - friction) * rig.stress
    ratio = _slip_ratio(cut, rig.built.snapshot(), driving, flexpm.elastic(plate, rock))
    return Measured(ratio, len(plate.discs))


#: Direction of the largest hoop stress at the tip of a crack that slides, to its plane.
_KINK = math.degrees(math.acos(1.0 / 3.0))


def kink(fineness: float, seed: int) -> Measured:
    """Angle at which cracks leave a closed crack without friction, over that of a continuum.

    Contacts of the rock are brittle. The angle is that between the crack and the line from its tip,
    where the cut ended, to the mean place of all points within three mean grains of the tip that
    crack in tension up to a given strain; it is the mean of both tips.

    Args:
        fineness: Mean grains in half the length.
        seed: Seed of the packing.
    """
    _, cut = _cracked_plate(fineness, seed, side=0.5 * _PLATE)
    rock = flexpm.materials.load("augig-table2-brittle")
    material = _with_crack(rock, {"shear_stiffness": 1e3})
    result = flexpm.run("uniaxial", cut, material, max_strain=_KINK_STRAIN, report=False)
    cracks = np.array([(crack.x, crack.y) for crack in result.cracks if crack.mode == TENSILE])
    ends = cut.joint_lines()[0].reshape(-1, 2)
    angles = []
    for outwards, tip in ((-1.0, ends[_along(ends).argmin()]), (1.0, ends[_along(ends).argmax()])):
        ways = cracks - tip
        x, y = ways[np.hypot(*ways.T) <= 3.0 * cut.mean_diameter].mean(axis=0)
        angles.append(math.acos(outwards * _along(np.array([x, y])) / math.hypot(x, y)))
    return Measured(math.degrees(np.mean(angles)) / _KINK, len(cut.discs))


def _cracked_plate(
    fineness: float, seed: int, side: float = _PLATE
) -> tuple[flexpm.Specimen, flexpm.Specimen]:
    """A square plate, and the same with a crack at 45 degrees in its middle."""
    yade.O.reset()
    grains = diameters(_HALF_CRACK / fineness)
    plate = flexpm.Specimen.rectangle(side, side, THICKNESS, diameters=grains, seed=seed)
    reach = _HALF_CRACK / math.sqrt(2.0)
    ends = [[side / 2 + sign * reach] * 2 for sign in (-1.0, 1.0)]
    return plate, plate.with_joints({"crack": ends})


def _with_crack(rock: flexpm.Material, law: dict[str, float]) -> flexpm.Material:
    stiffness = rock.law("flexible")["normal_stiffness"]
    law = {
        **dict.fromkeys(("normal_stiffness", "shear_stiffness"), stiffness),
        "friction": 0.0,
    } | law
    return rock.with_set({f"joint.crack.{key}": value for key, value in law.items()}, "flexible")


def _slip_ratio(
    cut: flexpm.Specimen, state: Snapshot, driving: float, elastic: dict[str, float]
) -> float:
    """Least-squares fit of 4 tau sqrt(a^2 - x^2) / E to the slip of a crack's points.

    The crack is that which was cut; E is that of the same packing.

    Args:
        cut: The specimen.
        state: Its state.
        driving: Shear stress beyond friction [Pa].
        elastic: Elastic constants of the plate without the crack.
    """
    rows = np.flatnonzero(np.isin(state.contact, np.flatnonzero(cut.edge_joints >= 0)))
    on = np.isin(state.point_contact, rows)
    corners, slip = state.contact_ends[state.point_contact[on]], np.abs(state.point_slip[on])
    shares = state.point_number[on] / state.point_number.max()
    places = _along(corners[:, 0] * (1.0 - shares[:, None]) + corners[:, 1] * shares[:, None])
    cuts = _along(cut.joint_lines()[0])
    root = np.sqrt(np.maximum((places - cuts.min()) * (cuts.max() - places), 0.0))
    theory = 4.0 * driving * root / elastic["youngs_modulus"]
    weights = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1) * state.point_share[on]
    return float(np.sum(weights * slip * theory) / np.sum(weights * theory**2))


def _along(places: FloatArray) -> FloatArray:
    """Places along a line at 45 degrees [m]."""
    found: FloatArray = places.sum(axis=-1) / math.sqrt(2.0)
    return found


def strip(mode: str, grains: int, seed: int) -> Measured:
    """Moment at which a crack grows between the arms of a strip, over that of its fracture energy.

    Args:
        mode: ``opened``, or ``sheared`` by arms that turn alike.
        grains: Over the height of an arm.
        seed: Seed of the packing.
    """
    found = open_strip(mode, grains, seed)
    assert abs(found.energy - 1.0) < 1e-3, found
    assert found.zone < 0.27, found
    return Measured(found.moment, found.grains)


MODELS = ("flexible", "rigid")
CASES: dict[str, Callable[[float, int], Measured]] = {
    **{f"v{wave} {model}": partial(speed, model, wave) for model in MODELS for wave in ("p", "s")},
    **{f"onset {model}": partial(onset, model) for model in MODELS},
    **{f"sliding {model}": partial(sliding, model) for model in MODELS},
    **{f"sliding far {model}": partial(sliding_far, model) for model in MODELS},
    **{f"K_I {shape}": partial(intensity, shape) for shape in _SHAPES},
    "closed crack": closed_crack,
    "rubbing crack": rubbing_crack,
    "kink": kink,
    **{f"strip {mode}": partial(strip, mode) for mode in ("opened", "sheared")},
}
