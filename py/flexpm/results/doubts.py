# SPDX-License-Identifier: GPL-3.0-or-later
"""Doubts about a run, one line each: other units than SI's, too fast a loading.

A doubt stops nothing: the numbers are computed as they were asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..files import Table

#: Ranges in which no rock or specimen is known to lie beyond, and what is probably meant.
_USUAL: dict[str, tuple[float, float, str]] = {
    "young": (1e7, 1e13, "Pa; 25.8 GPa is 25.8e9"),
    "normal_stiffness": (1e8, 1e18, "Pa/m"),
    "tensile_strength": (1e3, 1e11, "Pa; 8.5 MPa is 8.5e6"),
    "cohesion": (1e3, 1e11, "Pa; 30 MPa is 30e6"),
    "friction": (0.0, 5.0, "1, the tangent of an angle; that of 30 degrees is 0.577"),
    "density": (100.0, 3e4, "kg/m3"),
    "confinement": (1e3, 1e11, "Pa; 4 MPa is 4e6"),
    "normal_stress": (1e3, 1e11, "Pa; 1 MPa is 1e6"),
    "width": (1e-6, 5.0, "m; 20 mm is 0.02"),
    "height": (1e-6, 5.0, "m; 40 mm is 0.04"),
    "diameter": (1e-6, 5.0, "m; 80 mm is 0.08"),
    "thickness": (1e-6, 5.0, "m; 80 mm is 0.08"),
}
#: Difference of both ends' reactions that is none [-], the median up to the peak.
LARGEST_MISMATCH = 0.05
#: Error of the energy balance that is none [-]. Tests that are slow enough have below 0.003.
LARGEST_ENERGY_ERROR = 0.01
#: Kinetic energy over the work that is none [-], by place: explicit solutions that are to be
#: quasi-static keep it below 0.05 to 0.1. Tests end in mid-fall: with up to 0.06 under a pressure,
#: which would feed a flight, and up to 0.07 without; halves of a disc part with up to 0.14 of a
#: work that was elastic. At a peak all have less than 0.001.
LARGEST_KINETIC_SHARES = {
    "at the peak": 0.02,
    "at the end": 0.2,
    "at the end under a pressure": 0.1,
}
#: Growth of a distance between neighbours that is none, in mean diameters [-]. Specimens that are
#: crushed by 3 % under a confinement have up to 1.6.
LARGEST_PARTING = 2.0
#: Of a pulse that has not passed both sections in one piece.
NO_PULSE = (
    "a section still moves at the end of the test: cracks or joints have scattered the pulse, "
    "which has no speed"
)


def of_inputs(inputs: Table) -> list[str]:
    """Inputs of a run that are surely in other units.

    Args:
        inputs: As result.json has them.
    """
    material = inputs["material"]
    tables = [("", {**inputs, **inputs["specimen"]}), ("", material)]
    tables += [(f"{kind['name']} ", kind) for kind in material.get("minerals", ())]
    tables += [(f"joint {joint['name']} ", joint) for joint in material.get("joints", ())]
    return [line for where, values in tables for line in _of_values(where, values)]


def of_result(
    status: str, energy_error: float | None, mismatch: float | None, rate: float | None
) -> list[str]:
    """What the results say about the loading.

    Args:
        status: Of the result.
        energy_error: Relative error of the energy balance [-].
        mismatch: Of both ends' reactions, median up to the peak [-].
        rate: Factor on the loading rate [-].
    """
    lines = []
    now = "" if rate is None else f" (--rate, now {rate:g})"
    if status == "not_quasistatic":
        lines.append(f"status = not_quasistatic, too fast to tell a strength; lower the rate{now}")
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


def of_motion(kinetic_shares: Mapping[str, float], parting: float | None) -> list[str]:
    """What moves too fast or too far for a test that is to be quasi-static.

    Args:
        kinetic_shares: Kinetic energy over the work [-], by the places of
            ``LARGEST_KINETIC_SHARES``.
        parting: Largest growth of the distance between grains once bonded, in mean diameters [-].
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
            f"largest_parting = {parting:.3g} mean diameters between grains once bonded, is above "
            f"{LARGEST_PARTING:g}: grains have flown off; read strains and pictures up to there, "
            "or stop earlier (--stop-ratio)"
        )
    return lines


def of_bend(bend: float) -> str:
    """What a joint that bends to the grains (D35) says about the strength.

    Args:
        bend: Its largest distance from its lines [m].
    """
    return (
        f"joint_bend = {bend:.3g} m, a joint bends to the grains and catches as it slides; take "
        "another seed or smaller grains"
    )


def _of_values(where: str, values: Mapping[str, object]) -> Iterator[str]:
    for name, (low, high, meant) in _USUAL.items():
        value = values.get(name)
        if isinstance(value, int | float) and value != 0.0 and not low <= value <= high:
            yield f"{where}{name} = {value:g}, is unusual; the unit is {meant}"
