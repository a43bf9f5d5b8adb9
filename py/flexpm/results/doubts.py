# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about a run, one line each: units other than SI units, too fast a loading.

A warning stops nothing: the numbers are computed as requested.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..files import Table
from ..kinds.registry import kind_of
from ..kinds.test_kind import Stage
from ..materials.grain_size import modulus_ratio
from ..materials.interface import ENERGY_OF
from ..materials.keys import is_used
from ..materials.made_for import MadeFor, dimension_of
from ..materials.material import default_name
from ..materials.mixing import long_softening
from ..materials.references import reference_of
from ..text import name_of

#: Ranges in which no rock or specimen is known to lie beyond, and what is probably meant.
_USUAL: dict[str, tuple[float, float, str]] = {
    "young": (1e7, 1e13, "Pa; 25.8 GPa is 25.8e9"),
    "normal_stiffness": (1e8, 1e18, "Pa/m"),
    "tensile_strength": (1e3, 1e11, "Pa; 8.5 MPa is 8.5e6"),
    "cohesion": (1e3, 1e11, "Pa; 30 MPa is 30e6"),
    "friction": (0.0, 5.0, "1, the tangent of an angle; tan(30 degrees) is 0.577"),
    "density": (100.0, 3e4, "kg/m3"),
    "confinement": (1e3, 1e11, "Pa; 4 MPa is 4e6"),
    "second_confinement": (1e3, 1e11, "Pa; 4 MPa is 4e6"),
    "normal_stress": (1e3, 1e11, "Pa; 1 MPa is 1e6"),
}
#: Inputs that are pressures on the specimen.
_PRESSURES = ("confinement", "second_confinement", "normal_stress")
#: Sizes of specimens of all shapes.
_SIZES = ("width", "depth", "height", "diameter", "thickness")
#: Range of the sizes of specimens and of the diameters of grains without a warning [m].
SPECIMEN_SIZES, GRAIN_SIZES = (1e-6, 2.0), (1e-6, 0.1)
#: Local damping that lets what moves under gravity be told from it [-].
LARGEST_DAMPING = 0.2
#: Difference of both ends' reactions that is none [-], the median up to the peak.
LARGEST_MISMATCH = 0.05
#: Growth of the load while a wave crosses the specimen before the peak, over it, that is none [-]:
#: one and a half times that of a loading that comes to a plane of weak points (D58).
LARGEST_GROWTH = 0.015
#: The same of runs with joints, by model, which come slowly through the peak, too [-]: above what
#: the rate in use gives where it errs by less than 2 %, below what faster ones give where they err
#: by more: 0.010 and 0.016, and 0.0064 and 0.0066.
LARGEST_GROWTH_OF_JOINTS = {"flexible": 0.012, "rigid": 0.0065}
#: Rate times the rock's strength over that of a joint above which the joint may bear too much: its
#: cracks come one after the other, and the load tells nothing. In the runs from which it was chosen
#: errors above 2 % that nothing else names began at 15; up to 5 they were 1.1 % at most.
LARGEST_RATE_OF_JOINTS = 5.0
#: Rows of the record from 5 % of the largest stress up to it that are not few. A wave
#: crosses the specimen in eight rows; at the rates in use the elastic loading takes three transits.
FEWEST_ROWS = 10
#: Difference of the peaks of two rates, one half of the other, that is none [-]: half of what the
#: limits of a single loading let pass (D75).
LARGEST_PEAK_CHANGE = 0.01
#: Error of the energy balance that is none [-]. Tests that are slow enough have below 0.003.
LARGEST_ENERGY_ERROR = 0.01
#: Share of the length of a joint's lines in the specimen that may lie on earlier joints [-].
LARGEST_TAKEN = 0.1
#: Discs of joints below this many mean diameters of the grains have areas that scatter [-].
SMALLEST_DISC = 1.5
#: P32 of all joints times the mean diameter, above which too few grains lie between planes [-].
LARGEST_CROWDING = 0.5
#: Ratio of a softening length to the length of the rock, or of the mixing rule, without a warning.
LARGEST_SOFTENING_RATIO = 2.0
#: Ratio of the mean diameter of grains to that of the calibration without a warning, or its inverse
#: [-].
LARGEST_SIZE_RATIO = 1.3
#: Number of joints that one warning names.
_NAMED_JOINTS = 5
#: Relative difference from a set point above which a row misses the set point [-].
SET_POINT_OFF = 0.02
#: Largest share of rows that miss their set point, without a warning [-].
MOST_MISSED = 0.1
#: Ratio of kinetic energy to work without a warning [-], by position in the test. Explicit
#: quasi-static solutions keep it below 0.05 to 0.1. Tests end while the stress drops: at ratios up
#: to 0.06 under a pressure, which would accelerate detached grains, and up to 0.07 without; halves
#: of a disc separate at ratios up to 0.14 of an elastic work. At a peak all are below 0.001.
LARGEST_KINETIC_SHARES = {
    "at the peak": 0.02,
    "at the end": 0.2,
    "at the end under a pressure": 0.1,
}
#: Increase of the distance between neighbours without a warning [mean diameters]. Specimens that
#: are crushed by 3 % under a confining pressure reach 1.6.
LARGEST_PARTING = 2.0
#: Number of mean grains across a specimen, or the ligament of a beam, without a warning [-].
#: Standards of rock testing require ten, or six for coarse grains.
FEWEST_GRAINS_ACROSS = 6.0
#: Relative difference of Poisson's ratio from the elastic ratio without a warning [-].
LARGEST_POISSON_CHANGE = 0.05
#: Ratio of the median distance of the first cracks from the middle of a disc to the radius, up to
#: which it splits by tension [-]. Discs of ten grains across reach 0.63; cracks at plates are at
#: 0.77 and above.
LARGEST_CRACK_DISTANCE = 0.7
#: Ratio of the median distance of the first cracks from the notch front to the ligament [-]. The
#: loading head is at 1, a roller of the half disc at 1.6.
LARGEST_NOTCH_DISTANCE = 0.5
#: Overlap of 3D grains without a common contact, without a warning [diameters].
LARGEST_CLEARANCE = 0.02
#: Warning of a pulse that has not passed both sections undivided.
NO_PULSE = (
    "a section still moves at the end of the test, or the upper section has barely moved: cracks "
    "or joints have scattered the pulse, whose speed cannot be measured"
)


def of_inputs(inputs: Table) -> list[str]:
    """Warn of inputs that are probably in other units, or for another dimension, model or size.

    Warn also of damping of motion under gravity.

    Args:
        inputs: Inputs as in result.json.
    """
    material = inputs["material"]
    specimen = inputs["specimen"]
    tables = [("", inputs), ("", material)]
    tables += [(f"{kind['name']} ", kind) for kind in material.get("minerals", ())]
    tables += [(f"joint {joint['name']} ", joint) for joint in material.get("joints", ())]
    lines = [line for where, values in tables for line in _of_values(where, values)]
    lines += of_softening(material)
    lines += of_slip_lengths(inputs)
    sizes = {name: specimen[name] for name in _SIZES if specimen.get(name) is not None}
    packed = specimen.get("diameters") or ()
    odd = of_lengths(sizes, packed)
    lines += odd
    solid = "thickness" not in specimen  # only 2D specimens have a thickness
    lines += of_material(material, inputs["model"], solid=solid)
    if packed and not odd:  # grains in another unit are of another size
        mean = 0.5 * sum(packed)
        lines += of_grain_size(material, inputs["model"], mean, solid=solid)
    lines += of_weak_joints(inputs)
    damping = inputs.get("damping")  # 0.7 in results without this option
    return lines + of_gravity(inputs.get("gravity") or 0.0, 0.7 if damping is None else damping)


def of_softening(material: Table) -> list[str]:
    """Warn of minerals and interfaces whose lower strength makes their softening long.

    Args:
        material: Effective parameters, as result.json has them.
    """
    return [
        f"{one.contact}: softening length 2 G / {one.strength} = {1e6 * one.length:.3g} um, "
        f"is {one.ratio:.3g} times the usual length (limit "
        f"{LARGEST_SOFTENING_RATIO:g}), because {one.strength} is lower and the fracture energy is "
        f"not: points soften early and crack late; lower {ENERGY_OF[one.strength]} by the square "
        f"of the ratio of strengths, as factor.{one.strength} of an interface does"
        for one in long_softening(material, LARGEST_SOFTENING_RATIO)
    ]


def of_slip_lengths(inputs: Table) -> list[str]:
    """Warn of friction that falls faster with slip than the contact unloads: it snaps back.

    Args:
        inputs: Inputs as in result.json.
    """
    material = inputs["material"]
    pressure = max(abs(inputs.get(name) or 0.0) for name in _PRESSURES)
    laws = [("", material)]
    laws += [(f"{kind['name']} ", kind) for kind in material.get("minerals", ())]
    laws += [(f"interface {'/'.join(one['pair'])} ", one) for one in material.get("interfaces", ())]
    laws += [(f"joint {joint['name']} ", joint) for joint in material.get("joints", ())]
    lines = []
    for where, law in laws:
        length = law.get("slip_length")
        if length is None or not is_used("slip_length", inputs["model"]):
            continue
        stiffness = law.get("shear_stiffness") or law["shear_ratio"] * law["normal_stiffness"]
        least = (law["friction"] - law["residual_friction"]) * pressure / stiffness
        if length < least:
            lines.append(
                f"{where}slip_length = {length:.3g} m, is below (friction - residual_friction) "
                f"pressure / shear stiffness = {least:.3g} m at {1e-6 * pressure:.4g} MPa: "
                "friction falls at once, and the difference becomes waves; give a larger "
                "slip_length"
            )
    return lines


def of_weak_joints(inputs: Table) -> list[str]:
    """Warn of joints that are too weak relative to the rock for any limit of the loading.

    Args:
        inputs: Inputs as in result.json.
    """
    if Stage.LOAD not in kind_of(inputs["test"]).stages:  # joints slide at any rate there
        return []
    lines = []
    for joint in inputs["material"].get("joints", ()):
        shares = [
            joint[key] / inputs["material"][key]
            for key in ("cohesion", "tensile_strength")
            if joint.get(key) and inputs["material"].get(key)
        ]
        if shares and inputs["rate"] > LARGEST_RATE_OF_JOINTS * min(shares):
            lines.append(
                f"joint {joint['name']}: strength = {100.0 * min(shares):.2g} % of the strength of "
                f"the rock; the load may be a few per cent too large at --rate "
                f"{inputs['rate']:g}; compare with --rate {0.25 * inputs['rate']:g}"
            )
    return lines


def of_gravity(gravity: float, damping: float) -> list[str]:
    """Warn of the effect of local damping on motion under gravity.

    Args:
        gravity: Acceleration [m/s2].
        damping: Local damping alpha [-].
    """
    if not gravity or not damping > LARGEST_DAMPING:
        return []
    return [
        f"damping = {damping:g}, is above {LARGEST_DAMPING:g} with gravity: falling or sliding "
        f"bodies have only {1.0 - damping:.3g} of their acceleration, and slopes are too stable; "
        "use 0 for motion"
    ]


def of_clearance(part: float) -> list[str]:
    """Warn of overlapping 3D grains that no force separates.

    Args:
        part: Ratio of the deepest overlap that no force resists to the mean diameter [-].
    """
    if not part > LARGEST_CLEARANCE:
        return []
    return [
        f"clearance = {100.0 * part:.3g} % of a diameter, the depth to which two grains overlap "
        f"without a force, is above {100.0 * LARGEST_CLEARANCE:g} %; results after the peak are "
        "not valid, lower the rate or stop at the peak (--stop-ratio)"
    ]


def of_lengths(sizes: Mapping[str, float], diameters: Sequence[float]) -> list[str]:
    """Warn of lengths that are probably in another unit, in one line.

    Args:
        sizes: Sizes of the specimen by their names [m].
        diameters: Diameters of grains [m]; none if they are unknown.
    """
    low, high = SPECIMEN_SIZES
    odd = [f"{name} = {size:g} m" for name, size in sizes.items() if not low <= size <= high]
    if odd:
        usual = f"specimens have {low:g} to {high:g} m"
    elif any(not GRAIN_SIZES[0] <= one <= GRAIN_SIZES[1] for one in diameters):
        odd = [f"diameters of grains = {' to '.join(f'{one:g}' for one in diameters)} m"]
        usual = f"grains have {GRAIN_SIZES[0]:g} to {GRAIN_SIZES[1]:g} m"
    else:
        return []
    return [f"{', '.join(odd)}, unusual: {usual}; the unit is m, 20 mm is 0.02"]


def of_material(material: Table, model: str, *, solid: bool) -> list[str]:
    """Warn of a material that was calibrated for another dimension or model.

    Args:
        material: Material as in result.json.
        model: Model of the run.
        solid: Whether its specimen is 3D.
    """
    given = material.get("made_for")
    if not given or MadeFor(**given).suits(model, solid=solid):
        return []
    name = material["name"]
    remedy = f"take {default_name(model, solid=solid)} or " if reference_of(name) else ""
    return [
        f"material = {name_of(name)}, was calibrated in {given['dimension']} for model "
        f"{given['model']}, the run is {dimension_of(solid=solid)} with model {model}: strength "
        f"and elastic constants may differ much from the rock; {remedy}calibrate for this run"
    ]


def of_grain_size(material: Table, model: str, mean_diameter: float, *, solid: bool) -> list[str]:
    """Warn of grains much larger or smaller than those of the material's calibration.

    Args:
        material: Material as in result.json.
        model: Model of the run.
        mean_diameter: Mean diameter of the grains [m].
        solid: Whether the specimen is 3D.
    """
    calibrated = (material.get("made_for") or {}).get("mean_diameter")
    if calibrated is None:
        return []
    ratio = mean_diameter / calibrated
    if 1.0 / LARGEST_SIZE_RATIO <= ratio <= LARGEST_SIZE_RATIO:
        return []
    change = modulus_ratio(material, model, mean_diameter, calibrated, solid=solid)
    return [
        f"mean diameter of the grains = {mean_diameter:.3g} m, is {ratio:.3g} times the "
        f"{calibrated:.3g} m of the calibration of {name_of(material['name'])} (limit "
        f"{LARGEST_SIZE_RATIO:g}): Young's modulus is about {change:.3g} times as large, and "
        f"strengths may differ; take Material.at_grain_size({mean_diameter:.3g}) or calibrate for "
        "these grains"
    ]


def of_result(
    status: str, energy_error: float | None, mismatch: float | None, rate: float | None
) -> list[str]:
    """Warn of a loading that was too fast or out of balance, from the results.

    Args:
        status: Status of the result.
        energy_error: Relative error of the energy balance [-].
        mismatch: Mismatch of both ends' reactions, median up to the peak [-].
        rate: Factor on the loading rate [-].
    """
    lines = []
    now = "" if rate is None else f" (--rate, now {rate:g})"
    if status == "not_quasistatic":
        lines.append(
            "status = not_quasistatic, the loading was too fast for a strength; lower the "
            f"rate{now}"
        )
    if energy_error is not None and energy_error > LARGEST_ENERGY_ERROR:
        limit = f"{100.0 * LARGEST_ENERGY_ERROR:g} %"
        lines.append(
            f"energy_error = {100.0 * energy_error:.3g} %, is above {limit}; lower the rate{now}"
        )
    if mismatch is not None and mismatch > LARGEST_MISMATCH:
        lines.append(
            f"load and reaction differ by {100.0 * mismatch:.3g} % (median up to the peak), more "
            f"than {100.0 * LARGEST_MISMATCH:g} %; lower the rate{now}"
        )
    return lines


def of_rise(reached: str) -> str:
    """Warn of a loading that ended by its default while the load still rose.

    Args:
        reached: Strain or displacement at its end, with its unit.
    """
    return (
        f"status = no_peak, the load still rose at {reached}, where a loading ends by default; "
        "give a larger Loading(max_strain=...)"
    )


def of_few_rows(rows: int, steps: int, rate: float | None) -> list[str]:
    """Warn of a loading that ended before its rate could be judged.

    Args:
        rows: Rows of the record from 5 % of the largest stress up to it.
        steps: Steps of the test.
        rate: Factor on the loading rate [-].
    """
    if rows >= FEWEST_ROWS:
        return []
    now = "" if rate is None else f" (--rate, now {rate:g})"
    return [
        f"rows while loaded = {rows} in {steps} steps, must be >= {FEWEST_ROWS} to judge the "
        f"loading rate; the stress may be caused by a wave; lower the rate{now}"
    ]


def peak_change(loadings: Sequence[Table]) -> float | None:
    """Return the relative change of the peak between the last two loadings [-]; None without."""
    peaks = [one["peak_stress"] for one in loadings[-2:]]
    if len(peaks) < 2 or not all(peaks):
        return None
    return float(abs(peaks[0] / peaks[1] - 1.0))


def of_rates(loadings: Sequence[Table], status: str) -> list[str]:
    """Warn of a test whose rate has been halved as often as requested, without success.

    Args:
        loadings: Loadings as in result.json.
        status: Status of the result.
    """
    if status != "not_quasistatic":
        return []
    peaks = [one["peak_stress"] for one in loadings[-2:]]
    both = " and ".join("none" if one is None else f"{1e-6 * one:.4g} MPa" for one in peaks)
    change = peak_change(loadings)
    differ = "" if change is None else f", which differ by {100.0 * change:.2g} %"
    limit = f"{100.0 * LARGEST_PEAK_CHANGE:g} %"
    return [
        f"rate = {loadings[-1]['rate']:g} after {len(loadings) - 1} halvings, the last peaks are "
        f"{both}{differ}: must be slow enough and within {limit}; raise --halvings"
    ]


def of_motion(kinetic_shares: Mapping[str, float], parting: float | None) -> list[str]:
    """Warn of motion that is too fast or too large for a quasi-static test.

    Args:
        kinetic_shares: Ratio of kinetic energy to work [-], by the positions of
            ``LARGEST_KINETIC_SHARES``.
        parting: Largest increase of the distance between bonded grains [mean diameters].
    """
    lines = []
    for place, share in kinetic_shares.items():
        if share > LARGEST_KINETIC_SHARES[place]:
            lines.append(
                f"kinetic energy = {100.0 * share:.3g} % of the work {place}, is above "
                f"{100.0 * LARGEST_KINETIC_SHARES[place]:g} %: not quasi-static there; lower the "
                "rate, or stop earlier (--stop-ratio)"
            )
    if parting is not None and parting > LARGEST_PARTING:
        lines.append(
            f"largest_separation = {parting:.3g} mean diameters between formerly bonded grains, is "
            f"above {LARGEST_PARTING:g}: grains have left the specimen; strains and figures are "
            "valid only before, stop earlier (--stop-ratio)"
        )
    return lines


def of_regained(first: float, largest: float) -> str:
    """Warn of a compression whose largest stress follows an earlier peak.

    Args:
        first: First peak from which the stress dropped and rose again [Pa], see
            ``measures.regained_peak``.
        largest: Largest stress [Pa].
    """
    return (
        f"largest stress = {1e-6 * largest:.4g} MPa, is above a first peak of {1e-6 * first:.4g} "
        "MPa, after which the stress dropped by 10 %: interlocked broken grains carry it; "
        "--stop-ratio 0.9 ends at the first peak"
    )


def of_growth(growth: float | None) -> list[str]:
    """Warn of a load that still grew fast at its peak.

    Args:
        growth: Ratio of the load increase during the last wave transit to the peak [-].
    """
    if growth is None or growth <= LARGEST_GROWTH:
        return []
    return [
        f"load at the peak = {100.0 * growth:.3g} % above the load one wave transit earlier, more "
        f"than {100.0 * LARGEST_GROWTH:g} %; the ends may carry more than the specimen; lower the "
        "rate"
    ]


def of_grains(across: float | None) -> list[str]:
    """Warn of a strength from few grains across.

    Args:
        across: Ratio of the smallest size of the specimen, or its ligament, to the mean grain [-].
    """
    if across is None or across >= FEWEST_GRAINS_ACROSS:
        return []
    return [
        f"grains_across = {across:.2g}, is below {FEWEST_GRAINS_ACROSS:g}: the strength depends on "
        "few contacts and scatters; use smaller grains or a larger specimen, and several seeds"
    ]


def of_poissons_ratio(ratio: float | None, elastic: float | None) -> list[str]:
    """Warn of a Poisson's ratio that early softening has changed.

    Args:
        ratio: Poisson's ratio between 5 and 25 % of the peak [-].
        elastic: Poisson's ratio before the first point softens [-].
    """
    if ratio is None or not elastic or abs(ratio / elastic - 1.0) <= LARGEST_POISSON_CHANGE:
        return []
    return [
        f"poissons_ratio = {ratio:.3g}, differs by {100.0 * abs(ratio / elastic - 1.0):.2g} % from "
        f"elastic_poissons_ratio = {elastic:.3g}: points soften below 25 % of the peak; use "
        "elastic_poissons_ratio for the elastic rock"
    ]


def of_first_cracks(
    distance: float | None, first: float | None, peak: float | None, *, notched: bool = False
) -> list[str]:
    """Warn of first cracks far from the position that the formula of the test assumes.

    Args:
        distance: Median distance of the first cracks from the middle of a disc, as a ratio to the
            radius, or from the front of a notch, as a ratio to the ligament [-].
        first: Axial stress at the first crack [Pa].
        peak: Axial stress at the peak [Pa].
        notched: The specimen has a notch.
    """
    largest = LARGEST_NOTCH_DISTANCE if notched else LARGEST_CRACK_DISTANCE
    if distance is None or not distance > largest:
        return []
    stresses = f"first crack at {1e-6 * (first or 0.0):.4g} MPa"
    if peak is not None:
        stresses += f", peak at {1e-6 * peak:.4g} MPa"
    if notched:
        return [
            f"first_crack_distance = {distance:.2g} of the ligament from the notch, is above "
            f"{largest:g}: the specimen breaks elsewhere first, and its fracture_toughness is not "
            f"a property of the rock ({stresses}); use a deeper notch, smaller grains or a higher "
            "cohesion"
        ]
    return [
        f"first_crack_distance = {distance:.2g} of the radius from the middle, is above "
        f"{largest:g}: the disc breaks at the plates first, and its stress is not a tensile "
        f"strength ({stresses}); use a higher cohesion, smaller grains or curved jaws"
    ]


def of_bend(bend: float, cuts: Table) -> str:
    """Warn of the effect on the strength of a joint that deviates from its line or plane (D35).

    Args:
        bend: Largest distance of the joint from its lines or planes [m].
        cuts: Result of the cuts of each joint, as in result.json.
    """
    shape = "plane" if any("planes" in cut for cut in cuts.values()) else "line"
    return (
        f"joint_deviation = {bend:.3g} m, a joint deviates from its {shape} and interlocks as it "
        "slides; use another seed or smaller grains"
    )


def of_cuts(cuts: Table) -> list[str]:
    """Warn of lines of joints that are not cut, in one line, and of planes that are too close.

    Args:
        cuts: Result of the cuts of each joint, as in result.json.
    """
    found = []
    for name, cut in cuts.items():
        if "planes" in cut:  # of a solid
            found += _of_planes(name, cut)
            continue
        inside = cut["length"] - cut["outside"]
        if cut["idle"] or cut["taken"] > LARGEST_TAKEN * inside:
            missing = max(inside - cut["cut"], 0.0)
            found.append(
                f"joint {name}: {cut['idle']} of {cut['lines']} lines cut nothing, "
                f"{1e3 * missing:.3g} of {1e3 * inside:.3g} mm in the specimen; {cut['reason']}"
            )
    if len(found) > _NAMED_JOINTS:
        rest = len(found) - _NAMED_JOINTS
        found = [*found[:_NAMED_JOINTS], f"and {rest} more joints, see joint_cuts"]
    return ([". ".join(found)] if found else []) + _of_small_planes(cuts)


def _of_small_planes(cuts: Table) -> list[str]:
    """Warn of discs that are small for the grains, and of planes that are close for them."""
    found = []
    discs = {
        name: size for name, cut in cuts.items() if (size := cut.get("smallest_disc")) is not None
    }
    name = min(discs, key=discs.__getitem__, default="")
    if discs and discs[name] < SMALLEST_DISC:
        found.append(
            f"joint {name}: smallest disc = {discs[name]:.3g} mean diameters, should be at least "
            f"{SMALLEST_DISC:g}: its area scatters; use larger discs or smaller grains"
        )
    crowding = sum(cut.get("crowding", 0.0) for cut in cuts.values())
    if crowding > LARGEST_CROWDING:
        found.append(
            f"P32 times mean diameter = {crowding:.3g}, should be at most {LARGEST_CROWDING:g}; "
            "use smaller grains or fewer joints"
        )
    return found


def _of_planes(name: str, cut: Table) -> list[str]:
    """Warn of planes of a joint that are not cut."""
    if cut["outside"] == cut["planes"]:
        return [f"joint {name}: all {cut['planes']} planes lie outside the specimen"]
    if not (cut["idle"] or cut["taken"] > LARGEST_TAKEN * cut["within"]):
        return []
    reason = "around small parts"
    if cut["taken"] > cut["bridged"]:
        reason = "on faces of joints that were cut first"
    elif cut["bridged"] > 0.0:
        reason = "within grains"
    missing = max(cut["within"] - cut["cut"], 0.0)
    return [
        f"joint {name}: {cut['idle']} of {cut['planes']} planes cut nothing, "
        f"{1e6 * missing:.3g} of {1e6 * cut['within']:.3g} mm2 in the specimen are not cut; most "
        f"of it lies {reason}"
    ]


def of_set_point(measure: str, missed: float) -> list[str]:
    """Warn of a missed set point, which indicates too high a rate.

    Args:
        measure: Controlled column.
        missed: Share of the rows that are off by more than `SET_POINT_OFF` [-].
    """
    if not missed > MOST_MISSED:
        return []
    return [
        f"set point of {measure} = missed by more than {100.0 * SET_POINT_OFF:g} % in "
        f"{100.0 * missed:.3g} % of the rows, more than {100.0 * MOST_MISSED:g} %; lower the rate"
    ]


def of_divergence(step: int, reason: str = "") -> str:
    """Warn of a test that could not continue, and state which rows are valid.

    Args:
        step: Last valid step.
        reason: Cause of the end, if it is known.
    """
    found = reason or (
        "a number was not finite or 3D faces were inverted; lower the rate or check the driven "
        "parts"
    )
    return f"the record ends before step {step}: {found}; earlier rows are valid"


def of_lost_gauge(name: str) -> str:
    """Warn of a gauge on an erased grain."""
    return (
        f"gauge {name} reads a node of an erased grain, which no longer moves; rows from there on "
        "are not valid, place another gauge"
    )


def _of_values(where: str, values: Mapping[str, object]) -> Iterator[str]:
    for name, (low, high, meant) in _USUAL.items():
        value = values.get(name)
        if isinstance(value, int | float) and value != 0.0 and not low <= value <= high:
            yield f"{where}{name} = {value:g}, is unusual; the unit is {meant}"
