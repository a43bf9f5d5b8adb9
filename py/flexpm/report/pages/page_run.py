# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of one run, report.html in its folder. SI units; shown in GPa, MPa, mm and %."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.ticker import EngFormatter

from ...arrays import IntArray
from ...errors import InputError
from ...files import Table
from ...kinds.registry import kind_of
from ...results import measures
from ...results.cracks import MODES, SHEAR, TENSILE
from ...results.result import Result
from ...results.result_checks import FINISHED, SO_FAR
from ...results.solids.state import AnySnapshot, SolidSnapshot
from ...results.vtu import read_state
from ...text import name_of, words_of
from ..curves import fits_a_picture
from ..emission import emission_table
from ..style import COLOURS, CYCLE, MODE_NAMES
from ..tables import result_rows, scaled, size_text, test_text
from ..words import words_of_result
from .page import (
    FILE,
    Chart,
    Line,
    Map,
    Page,
    Picture,
    Rows,
    numbers,
    rows_to_draw,
    write,
)
from .page_core import volume_chart
from .page_map import crack_map
from .statuses import NOT_ENDED, OWN_STATUS, STATUS

#: Points of a curve.
_POINTS = 700
#: Energies that a page shows, in the order of their colours.
_ENERGIES = ("elastic", "damage", "friction", "damping", "kinetic", "potential")
#: Pictures that a page shows if a run has them.
_PICTURES = {
    "outside.png": "Surface and section",
    "network.png": "Fracture network",
    "events.png": "Acoustic emission",
}
#: Pictures of a custom test, which has no map.
_OWN_PICTURES = {"cracks.png": "Cracks", "fragments.png": "Fragments"}
#: Largest number of grains of a 3D specimen with a map; files of larger states have gigabytes.
LARGEST_SOLID = 100_000
#: Largest number of values of a list that are shown.
_LONGEST_LIST = 8
#: What to cite, without the version.
_PAPER = (
    "N. Monteiro Azevedo, M. L. Braga Farinha, S. Oliveira: A Flexible Particle Model for Rock "
    "Fracture: Validation and Assessment of the Influence of Deformability on the Macroscopic "
    "Response. Geotechnics 2 (2022), 523-549. doi:10.3390/geotechnics2030026"
)

#: An input: name, value, unit, source.
Input = tuple[str, object, str, str]


def write_page(
    folder: Path, result: Result, inputs: Iterable[Input], commands: Sequence[tuple[str, str]]
) -> Path:
    """Write the report of a run.

    Args:
        folder: Folder of the run, with specimen.vtu.
        result: The run.
        inputs: Requested inputs.
        commands: Commands that repeat it.

    Returns:
        The file.
    """
    chart, rows = stress_chart(result)
    maps, missing = maps_of(
        folder, result, "map", "Cracks and fragments", rows, chart.name, turns=True
    )
    page = Page(
        title=test_text(result),
        about=size_text(result),
        versions=versions(result),
        status=STATUS.get(result.status, NOT_ENDED),
        results=Rows("Result", ("quantity", "value"), result_rows(result)[:-1], _reading(result)),
        warnings=[*result.warnings, *missing],
        charts=[chart, *_volume(result), _energy_chart(result)] if len(rows) else [],
        maps=maps,
        tables=_tables(folder, result, inputs, _rates_table(result), _networks_table(result)),
        pictures=_pictures(folder, _PICTURES),
        commands=commands,
        cite=cite(result.flexpm),
    )
    write(folder / FILE, page)
    return folder / FILE


def write_own_page(
    folder: Path, result: Result, inputs: Iterable[Input], commands: Sequence[tuple[str, str]]
) -> Path:
    """Write the report of a custom test, which has no initial state.

    Args:
        folder: Folder of the test, with its pictures.
        result: The test.
        inputs: Description of specimen and model.
        commands: Commands that repeat it.

    Returns:
        The file.
    """
    chart, rows = stress_chart(result)
    known = [row for row in result_rows(result)[:-1] if any(map(str.isdigit, row[1]))]
    page = Page(
        title=f"Custom test: {test_text(result)}",
        about=size_text(result),
        versions=versions(result),
        status=OWN_STATUS.get(result.status),
        results=Rows("Result", ("quantity", "value"), known, _reading(result)),
        warnings=result.warnings,
        charts=[chart, _energy_chart(result)] if len(rows) else [],
        tables=_tables(folder, result, inputs, *_told_tables(result.inputs or {})),
        pictures=_pictures(folder, {**_OWN_PICTURES, **_PICTURES}),
        commands=commands,
        cite=cite(result.flexpm),
    )
    write(folder / FILE, page)
    return folder / FILE


def _tables(
    folder: Path, result: Result, inputs: Iterable[Input], *first: Rows | None
) -> list[Rows]:
    """Return all tables with rows: first the tables of this page, then the common tables."""
    file = FINISHED if (folder / FINISHED).is_file() else SO_FAR
    others = (
        *(_joints_table(result), _pairs_table(result)),
        *(emission_table(result), inputs_table(inputs, file=file)),
    )
    return [one for one in (*first, *others) if one]


def _pictures(folder: Path, titles: Mapping[str, str]) -> list[Picture]:
    """Pictures of a page: those that its folder has."""
    there = {folder / name: title for name, title in titles.items()}
    return [Picture(title, file) for file, title in there.items() if file.is_file()]


def _volume(result: Result) -> list[Chart]:
    found = volume_chart(result)
    return [] if found is None else [found]


def _told_tables(inputs: Table) -> Iterator[Rows]:
    """Yield tables of stages, parts and gauges of a custom test, with one row for each."""
    for title, name, word in (
        ("Stages", "stages", "stage"),
        ("Parts", "parts", "part"),
        ("Gauges", "gauges", "gauge"),
    ):
        rows = [
            (str(number), str(one.get(word, "")), _told(one, word))
            for number, one in enumerate(inputs.get(name, ()))
        ]
        if rows:
            yield Rows(title, ("number", word, "definition, SI"), rows)
    if drive := inputs.get("drive"):
        rows = [(key, _told_value(value), "") for key, value in drive.items()]
        yield Rows("Loading", ("quantity", "value, SI", ""), rows)


def _told(one: Table, word: str) -> str:
    """Return the definition of a stage, part or gauge without its name."""
    shown = {key: value for key, value in one.items() if key != word and value is not None}
    return ", ".join(
        f"{key.replace('_', ' ')} {_told_value(value)}" for key, value in shown.items()
    )


def _told_value(value: object) -> str:
    """A plain value in a few letters; long lists are counted."""
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_told_value(one)}" for key, one in value.items() if one) or "none"
    if isinstance(value, list):
        if len(value) > _LONGEST_LIST:
            return f"({len(value)} values)"
        return "(" + ", ".join(map(_told_value, value)) + ")"
    return f"{value:g}" if isinstance(value, float) else with_unit(value, "")


def versions(result: Result) -> str:
    """Return the versions of the programs that computed the run."""
    return f"Computed by flexpm {result.flexpm} with YADE {result.yade}."


def cite(version: str) -> list[str]:
    """Return the references that a publication with results of flexpm should cite."""
    code = f"The flexpm developers: flexpm, a flexible particle model of rock for YADE, {version}."
    return [code, _PAPER, "V. Smilauer et al.: Yade documentation. https://yade-dem.org"]


def stress_chart(result: Result) -> tuple[Chart, IntArray]:
    """Return the chart of stress and cracked points over strain, and the plotted rows."""
    record = result.curve
    if not fits_a_picture(record):
        record = type(record)()
    names = words_of_result(result)
    strain, stress = record[names.x.column], record[names.y.column]
    cracks = record["tensile_cracks"] + record["shear_cracks"]
    loading = measures.until_regained(record) if kind_of(result.test).regains else record
    peak = measures.peak_row(loading) if len(record) else None
    kept = [] if peak is None else [peak]
    rows = rows_to_draw(np.column_stack([strain, stress, cracks]), _POINTS, kept)
    x = numbers(strain[rows], names.x.factor)
    marks = [int(np.searchsorted(rows, row)) for row in kept]
    label = names.y.label
    lines = [Line(label, x, numbers(stress[rows], names.y.factor), "#1c1c1c", marks=marks)]
    for mode, column in ((TENSILE, "tensile_cracks"), (SHEAR, "shear_cracks")):
        counts = numbers(record[column][rows])
        lines.append(Line(MODE_NAMES[mode], x, counts, COLOURS[mode], "y2"))
    chart = Chart(
        "stress",
        names.title(" and cracks"),
        names.x.label,
        label,
        lines,
        "cracked contact points [-]",
    )
    return chart, rows


def run_map(
    folder: Path,
    result: Result,
    name: str,
    title: str,
    rows: IntArray | None,
    chart: str = "",
    *,
    turns: bool = False,
) -> Map | None:
    """Return the map of a run, with ``turns`` also a 3D view; None if its record has no row.

    Raises:
        InputError: if specimen.vtu cannot be read, or belongs to another run.
    """
    if not len(result.curve):
        return None
    drawing = replace(read_state(folder / "specimen.vtu"), joint_names=result.joint_names)
    shown = rows if rows is not None and len(rows) else None
    after = _state_after(folder, drawing) if turns else None
    try:
        return crack_map(name, title, drawing, result, shown, chart, after, turns=turns)
    except (LookupError, ValueError):
        raise InputError(
            "specimen.vtu and cracks.csv belong to different runs; rerun the test"
        ) from None


def _state_after(folder: Path, before: AnySnapshot) -> SolidSnapshot | None:
    """Return the last state of a 3D specimen; None if its file is missing, damaged or different."""
    if not isinstance(before, SolidSnapshot):
        return None
    try:
        after = read_state(folder / "final.vtu")
    except InputError:
        return None
    if isinstance(after, SolidSnapshot) and len(after.volumes) == len(before.volumes):
        return after
    return None


def maps_of(
    folder: Path,
    result: Result,
    name: str,
    title: str,
    rows: IntArray | None,
    chart: str = "",
    *,
    turns: bool = False,
) -> tuple[list[Map], list[str]]:
    """Return the map of a run, or the reason why it is missing; arguments as for ``run_map``."""
    if result.tetrahedra is not None and result.grains > LARGEST_SOLID:
        why = f"grains = {result.grains}, must be at most {LARGEST_SOLID} for a map"
        return [], [f"no map: {why}; open final.vtu in ParaView"]
    try:
        found = run_map(folder, result, name, title, rows, chart, turns=turns)
    except InputError as error:
        return [], [f"no map: {error}; repeat the run for a map"]
    return [] if found is None else [found], []


def inputs_table(inputs: Iterable[Input], title: str = "Inputs", file: str = FINISHED) -> Rows:
    """Return inputs with their units and sources; `file` has them with all digits."""
    rows = [
        (words_of(name), with_unit(value, unit), source) for name, value, unit, source in inputs
    ]
    note = f"All digits are in {file}, in SI units."
    return Rows(title, ("input", "value", "source"), rows, note)


def _reading(result: Result) -> str:
    """Return a sentence on the validity of the numbers for the rock."""
    if not kind_of(result.test).quasi_static:
        return ""
    lines = ["Fragments are counted at the end of the test, while they move; more may form."]
    if result.confinement:
        lines.append(
            "Under a confining pressure only the peak is valid: the curve after the peak also "
            "depends on the loading."
        )
    if result.material.get("joints") and result.model != "flexible" and result.youngs_modulus:
        lines.append(
            "Young's modulus is measured in the middle half of the specimen, with joints (D21)."
        )
    return " ".join(lines)


def _joints_table(result: Result) -> Rows | None:
    """Return slip, opening and damage of each joint at the end; None without joints."""
    if not result.joint_states:
        return None
    size, factor, unit = (
        ("length", 1e3, "mm") if result.tetrahedra is None else ("area", 1e6, "mm2")
    )
    columns = (
        (size, f"{size} [{unit}]", factor),
        ("cracked", "cracked [%]", 100.0),
        ("damage", "damage [-]", 1.0),
        ("slip", "slip [µm]", 1e6),
        ("largest_slip", "largest slip [µm]", 1e6),
        ("opening", "opening [µm]", 1e6),
        ("largest_opening", "largest opening [µm]", 1e6),
    )
    rows = [
        (name_of(joint), *(scaled(found.get(key), by, "") for key, _, by in columns))
        for joint, found in result.joint_states.items()
    ]
    note = (
        f"Damage, slip and opening are means over the {size} of the contacts of the joint. "
        "Cracked: without a bond, also from the start of the test. An opening is negative where "
        "the faces press on each other."
    )
    return Rows("Joints at the end", ("joint", *(title for _, title, _ in columns)), rows, note)


def _pairs_table(result: Result) -> Rows | None:
    """Return softened and cracked points of each pair of minerals; None without minerals."""
    cracked, softened = result.cracks_by_pair or {}, result.softened_by_pair or {}
    none = dict.fromkeys(MODES.values(), 0)
    rows = [
        (
            pair,
            *(str(cracked.get(pair, none)[mode]) for mode in MODES.values()),
            str(softened.get(pair, "-")),
        )
        for pair in sorted({*cracked, *softened})
    ]
    if not rows:
        return None
    note = "Softened: points that have started to soften, including cracked points."
    names = ("pair", *MODES.values(), "softened")
    return Rows("Cracked and softened points by pair of minerals", names, rows, note)


def _rates_table(result: Result) -> Rows | None:
    """Return the loadings of a test whose rate was halved; None for a single loading."""
    if not result.rates:
        return None
    rows, before = [], None
    for one in result.rates:
        peak = one["peak_stress"]
        change = "-" if not (peak and before) else f"{100.0 * (peak / before - 1.0):+.2g} %"
        cells = (scaled(peak, 1e-6, "MPa"), change, str(one["steps"]), f"{one['seconds']:.2g} s")
        rows.append((f"{one['rate']:g}", one["status"], *cells))
        before = peak
    note = "The rate is halved until the status is ok and the peak changes by less than 1 %. All "
    note += f"other results are from the last loading, with status {result.status}."
    heading = ("rate", "status", "peak", "change", "steps", "wall time")
    return Rows("Loadings", heading, rows, note)


def _networks_table(result: Result) -> Rows | None:
    """Return the intensity of each set of a fracture network; None without a network."""
    if not result.networks:
        return None
    keys = ("target", "generated", "cut")
    rows = [
        (name, *("none" if found[key] is None else f"{found[key]:.4g}" for key in keys))
        for name, found in result.networks.items()
    ]
    solid = any("p10_x" in found for found in result.networks.values())
    measure, shapes = ("P32", "planes") if solid else ("P21", "traces")
    note = f"Generated: {shapes} in the specimen; cut: contacts on the {shapes}."
    return Rows(f"Fracture network, {measure} [1/m]", ("joint", *keys), rows, note)


def _energy_chart(result: Result) -> Chart:
    record = result.curve
    columns = {f"{name} energy": record[f"{name}_energy"] for name in _ENERGIES}
    shown = {name: values for name, values in columns.items() if np.any(values != 0.0)}
    work = record["boundary_work"]
    words = words_of_result(result)
    over = words.x
    rows = rows_to_draw(np.column_stack([record[over.column], work, *shown.values()]), _POINTS)
    x = numbers(record[over.column][rows], over.factor)
    lines = [Line("boundary work", x, numbers(work[rows]), "#1c1c1c", dashed=True)]
    for number, (name, values) in enumerate(shown.items()):
        lines.append(Line(name, x, numbers(values[rows]), CYCLE[number % len(CYCLE)]))
    return Chart("energies", f"Energies over {words.over}", over.label, "energy [J]", lines)


def with_unit(value: object, unit: str) -> str:
    """Return a value as text, with a prefix of its unit."""
    if isinstance(value, list | tuple):
        names = any(isinstance(one, str) for one in value)
        return (", " if names else " to ").join(with_unit(one, unit) for one in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, float):
        return str(value)
    if unit in ("Pa", "m", "Pa/m"):
        return str(EngFormatter(unit)(value))
    return f"{value:g} {unit}".rstrip()
