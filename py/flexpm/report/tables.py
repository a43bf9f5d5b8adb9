# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of text in the units of the laboratory: names and values, or columns with a header."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from ..files import Table
from ..kinds.registry import kind_of
from ..materials.references import Reference
from ..text import name_of, words_of
from .words import words_of_result

if TYPE_CHECKING:  # the command shows its help without numpy
    from ..results.result import Result
    from ..results.strength import Envelope

#: Ratio of the stress of crack initiation to the peak in 376 tests of granites [-], uniaxial and
#: under a confining pressure, and the authors of the collection.
_INITIATION = "Nicksiar and Martin 2013"
_GRANITES, _CONFINED_GRANITES = (0.42, 0.47), (0.50, 0.54)
#: Statistics of a specimen: text, factor to the unit, unit. Other statistics are counts.
_FIGURES = {
    "uncollapsed_contacts": ("contacts before short edges were removed", 1.0, ""),
    "boundary_edges": ("edges on the outline", 1.0, ""),
    "cell_vertices": ("corners of all grains", 1.0, ""),
    "cell_area": ("area of all grains", 1e6, "mm2"),
    "smallest_cell_area": ("area of the smallest grain", 1e6, "mm2"),
    "edge_length": ("contact length, {}", 1e3, "mm"),
    "coordination": ("contacts of a grain, mean", 1.0, ""),
    "refined_nodes": ("nodes, refined mesh", 1.0, ""),
    "refined_triangles": ("triangles, refined mesh", 1.0, ""),
    "fan_nodes": ("nodes, fan", 1.0, ""),
    "fan_triangles": ("triangles, fan", 1.0, ""),
    "refined_smallest_angle": ("smallest angle, refined mesh", 1.0, "degrees"),
    "fan_smallest_angle": ("smallest angle, fan", 1.0, "degrees"),
    "flipped_meshes": ("refined meshes with an edge flipped for a better angle", 1.0, ""),
    "fan_fallbacks": ("grains with a fan in place of a refined mesh", 1.0, ""),
    "moved_centres": (
        "grains with a centre node that is not the centre of the disc or sphere",
        1.0,
        "",
    ),
    "removed_discs": ("discs removed because others hide them", 1.0, ""),
    "mean_diameter": ("mean diameter of discs or spheres", 1e3, "mm"),
    "boundary_faces": ("faces on the outline", 1.0, ""),
    "contact_corners": ("corners of all contacts", 1.0, ""),
    "contact_points": ("points of all contacts", 1.0, ""),
    "contacts_of_equal_points": (
        "contacts with equal points in place of the points of the rule",
        1.0,
        "",
    ),
    "cell_volume": ("volume of all grains", 1e9, "mm3"),
    "smallest_cell_volume": ("volume of the smallest grain", 1e9, "mm3"),
    "smallest_tetrahedron_volume": ("volume of the smallest tetrahedron", 1e9, "mm3"),
    "short_edges_left": ("short edges that could not be removed", 1.0, ""),
    "removed_spheres": ("spheres removed because others hide them", 1.0, ""),
}


def table(rows: Iterable[tuple[str, str]], title: str = "") -> str:
    """Return two columns of text: names and values."""
    rows = list(rows)
    width = max((len(name) for name, _ in rows), default=0)
    lines = [f"  {name:<{width}}  {value}" for name, value in rows]
    return "\n".join([title, *lines] if title else lines)


def scaled(value: float | None, factor: float, unit: str, digits: int = 4) -> str:
    """Return `value` times `factor` with its unit, or a dash if it is missing or not finite."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{factor * value:#.{digits}g}".rstrip(".") + (f" {unit}" if unit else "")


def result_table(result: Result) -> str:
    """Return a short table of the results of a test."""
    name = name_of(result.material.get("name", ""))
    seed = "" if result.seed is None else f", seed {result.seed}"
    title = f"{result.test}, {result.model} model, {name}{seed}"
    return table(result_rows(result), title)


def result_rows(result: Result) -> list[tuple[str, str]]:
    """Return names and values of the results of a test; the status is the last row."""
    counts = f"{result.tensile_cracks} tensile, {result.shear_cracks} shear"
    rows = [
        ("grains, contacts", f"{result.grains}, {result.contacts}"),
        ("Young's modulus", scaled(result.youngs_modulus, 1e-9, "GPa")),
        ("Poisson's ratio", _poissons_ratio(result)),
        (words_of_result(result).peak, scaled(result.peak_stress, 1e-6, "MPa")),
        ("strain at peak", scaled(result.peak_strain, 100.0, "%")),
        *_splitting(result),
        *_core(result),
        ("softening slope", scaled(result.softening_slope, 1e-9, "GPa")),
        ("cracked points", counts),
        ("first tensile, shear crack", _first_cracks(result)),
        ("acoustic events", _events(result)),
        ("fragments", _fragments(result)),
        *_overlap(result),
        ("unbalanced-force ratio", scaled(result.unbalanced_ratio, 1.0, "", 2)),
        ("energy error", scaled(result.energy_error, 100.0, "%", 2)),
        ("steps", f"{result.steps} of {scaled(result.step_time, 1e3, 'ms', 3)}"),
        *_rates(result),
        ("status", result.status),
    ]
    if kept := kind_of(result.test).rows:
        rows = [row for row in rows if row[0] in kept]
    speeds = (("pressure", result.vp), ("shear", result.vs))
    rows[1:1] = [
        (f"speed of the {name} wave", scaled(value, 1.0, "m/s", 5))
        for name, value in speeds
        if value is not None
    ]
    if result.peak_load is not None:
        rows[5:5] = [
            ("peak load", scaled(result.peak_load, 1e-3, "kN")),
            ("notch depth", scaled(result.notch_depth, 1e3, "mm")),
            ("fracture toughness", scaled(result.fracture_toughness, 1e-6, "MPa m^0.5")),
            ("fracture energy", scaled(result.fracture_energy, 1.0, "J/m2")),
        ]
    if result.residual_strength is not None:
        rows.insert(5, ("residual strength", scaled(result.residual_strength, 1e-6, "MPa")))
    if confined := pressures_text(result, "#.4g"):
        rows.insert(1, ("confining pressure", confined))
    specimen = (result.inputs or {}).get("specimen") or {}
    if source := specimen.get("source"):
        rows.insert(1, ("source of the grains", source_text(source)))
    return rows


def pressures_text(result: Result, digits: str = "g") -> str:
    """Return the confining pressures of a test as text; two for a box under two pressures.

    Args:
        result: Result of the test.
        digits: Format of a pressure in MPa.
    """
    given = result.inputs or {}
    first = given.get("confinement", result.confinement)
    second = given.get("second_confinement", result.second_confinement)
    if not (first or second):
        return ""
    shown = [f"{1e-6 * one:{digits}}" for one in (first, second) if one is not None]
    return f"{' and '.join(shown)} MPa"


def source_text(source: Table) -> str:
    """Return the source of the grains, see ``specimens.grain_source``, as text."""
    parts = [name_of(source["file"])]
    if "grains" in source:
        parts.append(f"{source['grains']} grains")
    for name in ("voxel", "pixel"):
        if sizes := source.get(f"{name}_size"):
            shown = " x ".join(f"{1e3 * size:.4g}" for size in sizes)
            parts.append(f"{name} {shown} mm")
    if "agreement" in source:
        parts.append(
            f"{100.0 * source['agreement']:.2f} % of the voxels in the cell of their grain"
        )
    return ", ".join(parts)


def test_text(result: Result) -> str:
    """Return test, model and material in one line."""
    name = name_of(result.material.get("name", ""))
    pressures = pressures_text(result)
    confined = f" under {pressures}" if pressures else ""
    return f"{result.test}{confined}, {result.model} model, {name}"


def size_text(result: Result) -> str:
    """Return the size of a specimen, its grains and its seed in one line."""
    specimen = (result.inputs or {}).get("specimen") or {}
    parts = []
    half = "half a " if "half" in specimen.get("kind", "") else ""
    if specimen.get("kind") in ("solid-disc", "solid-half-disc"):
        sizes = (specimen[name] for name in ("diameter", "depth"))
        parts.append(f"{half}disc of " + " x ".join(f"{1e3 * size:g}" for size in sizes) + " mm")
    elif specimen.get("depth"):
        sizes = (specimen[name] for name in ("width", "depth", "height"))
        parts.append(" x ".join(f"{1e3 * size:.4g}" for size in sizes) + " mm")
    elif specimen.get("kind") == "cylinder":
        parts.append(
            f"{1e3 * specimen['diameter']:.4g} x {1e3 * specimen['height']:.4g} mm cylinder"
        )
    elif specimen.get("width") and specimen.get("height"):
        parts.append(f"{1e3 * specimen['width']:.4g} x {1e3 * specimen['height']:.4g} mm")
    elif specimen.get("diameter"):
        parts.append(f"{half}disc of {1e3 * specimen['diameter']:.4g} mm")
    cells = "cells" if specimen.get("cells") else "grains"  # a grain may be several cells
    parts += [f"{result.grains} {cells}", f"{result.contacts} contacts"]
    parts.append("given grains" if result.seed is None else f"seed {result.seed}")
    return ", ".join(parts)


def _splitting(result: Result) -> list[tuple[str, str]]:
    """Return stress and position of the first cracks of a Brazilian disc, or at a notch."""
    if result.first_crack_distance is None:
        return []
    notched = result.fracture_toughness is not None
    size, origin = ("ligament", "notch") if notched else ("radius", "middle")
    place = f" at {result.first_crack_distance:.2f} of the {size} from the {origin}"
    return [("stress at the first crack", scaled(result.first_crack_stress, 1e-6, "MPa") + place)]


def _core(result: Result) -> list[tuple[str, str]]:
    """Return the stresses of crack initiation and damage of a core, with data of granites."""
    if not kind_of(result.test).is_core:
        return []
    deviator = (result.peak_stress or 0.0) - (result.confinement or 0.0)

    def told(key: str, how: str = "") -> str:
        value = getattr(result, key)
        part = f" ({value / deviator:.2f} of the peak)" if value and deviator > 0.0 else ""
        why = (result.null_reasons or {}).get(key)
        return scaled(value, 1e-6, "MPa") + part + (f" ({why})" if why else "") + how

    low, high = _CONFINED_GRANITES if result.confinement else _GRANITES
    initiation = told("crack_initiation_stress", " by cracks, ")
    initiation += told("crack_initiation_stress_volumetric", " by volume; ")
    return [
        ("crack initiation", f"{initiation}granites {low:.2f} to {high:.2f}, {_INITIATION}"),
        ("crack damage", told("crack_damage_stress")),
    ]


def _overlap(result: Result) -> list[tuple[str, str]]:
    """Return the deepest overlap of 3D grains without a common contact."""
    if result.largest_overlap is None:
        return []
    share = scaled(result.largest_overlap, 100.0, "% of a diameter", 2)
    return [("deepest overlap at the end", share)]


def _rates(result: Result) -> list[tuple[str, str]]:
    """Return the rates of a test that was loaded several times, and the last two peaks."""
    if not result.rates:
        return []
    peaks = ", ".join(scaled(one["peak_stress"], 1e-6, "") for one in result.rates[-2:])
    told = ", ".join(f"{one['rate']:g}" for one in result.rates)
    last = f"; last peaks {peaks} MPa" if len(result.rates) > 1 else ""
    return [("rates", told + last)]


def _poissons_ratio(result: Result) -> str:
    text = scaled(result.poissons_ratio, 1.0, "", 3)
    elastic = scaled(result.elastic_poissons_ratio, 1.0, "", 3)
    return text if elastic in ("-", text) else f"{text}, elastic {elastic}"


def _first_cracks(result: Result) -> str:
    stresses = result.first_tensile_crack_stress, result.first_shear_crack_stress
    return "at " + ", ".join(scaled(stress, 1e-6, "MPa") for stress in stresses)


def _events(result: Result) -> str:
    if result.events is None or result.b_value is None:
        return "-" if result.events is None else str(result.events)
    b, error = scaled(result.b_value, 1.0, "", 3), scaled(result.b_value_error, 1.0, "", 1)
    return f"{result.events}, b = {b} ± {error}"


def _fragments(result: Result) -> str:
    if result.fragments is None:
        return "-"
    share = scaled(result.largest_fragment, 100.0, "%", 3)
    size = "area" if result.tetrahedra is None else "volume"
    return f"{result.fragments}, the largest with {share} of the {size}"


def columns(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Table with a header; the first column to the left, numbers to the right."""
    lines = [tuple(header), *map(tuple, rows)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  "
        + "  ".join(
            cell.rjust(width) if number else cell.ljust(width)
            for number, (cell, width) in enumerate(zip(line, widths, strict=True))
        )
        for line in lines
    )


def envelope_table(envelopes: Sequence[Envelope], rock: Reference | None) -> str:
    """Cohesion, friction angle and Hoek-Brown constants, each with its standard error."""
    header = ("criterion", "c [MPa]", "±", "phi [deg]", "±", "sigma_ci [MPa]", "±", "m_i", "±")
    factors = {"cohesion": 1e-6, "friction_angle": 1.0, "sigma_ci": 1e-6, "m_i": 1.0}
    rows = []
    for one in envelopes:
        found = one.constants()
        cells = [one.model]
        for name, factor in factors.items():
            cells.append(scaled(found[name], factor, ""))
            cells.append(scaled(found[f"{name}_error"], factor, "", 2))
        rows.append(cells)
    if rock is not None:
        measured = scaled(rock.cohesion, 1e-6, ""), scaled(rock.friction_angle, 1.0, "")
        rows.append([rock.name, measured[0], "-", measured[1], *["-"] * 5])
    return columns(header, rows)


def statistics_table(found: Table) -> str:
    """Return the table of the statistics of a specimen: lengths in mm, angles in degrees."""
    rows = []
    for name, value in found.items():
        words, factor, unit = _FIGURES.get(name, (words_of(name), 1.0, ""))
        if name == "joints":
            for joint, cut in value.items():
                if "planes" in cut:
                    planes = f"{cut['planes'] - cut['idle'] - cut['outside']} of {cut['planes']}"
                    area = f"{1e6 * cut['cut']:.4g} of {1e6 * cut['within']:.4g} mm2"
                    rows.append((f"joint {joint}: planes that cut, area", f"{planes}, {area}"))
                    continue
                lines = f"{cut['lines'] - cut['idle']} of {cut['lines']}"
                length = f"{1e3 * cut['cut']:.4g} of {1e3 * cut['length']:.4g} mm"
                rows.append((f"joint {joint}: lines that cut, length", f"{lines}, {length}"))
        elif name == "networks":
            for joint, one in value.items():
                if "p10_x" in one:
                    rows.append((f"joint {joint}: P32 target, generated, cut", intensities(one)))
                    continue
                numbers = ", ".join(f"{number:.4g}" for number in one.values())
                rows.append((f"joint {joint}: P21 {', '.join(one)}", f"{numbers} 1/m"))
        elif isinstance(value, Mapping):
            for share, number in value.items():
                rows.append((words.format(_share(float(share))), scaled(number, factor, unit)))
        elif isinstance(value, int):
            rows.append((words, str(value)))
        else:
            rows.append((words, scaled(value, factor, unit)))
    return table(rows)


def intensities(one: Table) -> str:
    """Return the P32 of a set of planes; a set may have no target."""
    keys = ("target", "generated", "cut")
    numbers = ("none" if one[key] is None else f"{one[key]:.4g}" for key in keys)
    return f"{', '.join(numbers)} 1/m"


def _share(share: float) -> str:
    """Return the name of a quantile."""
    names = {0.0: "shortest", 0.5: "median", 1.0: "longest"}
    return names.get(share, f"{100.0 * share:g} % are shorter than")


def elastic_table(found: dict[str, float]) -> str:
    """Return the table of the elastic constants of a static solution."""
    rows = [
        ("Young's modulus", scaled(found["youngs_modulus"], 1e-9, "GPa", 5)),
        ("Poisson's ratio", scaled(found["poissons_ratio"], 1.0, "", 4)),
    ]
    return table(rows)
