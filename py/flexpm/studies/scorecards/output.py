# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and texts of a scorecard: text, JSON, CSV and figure. SI units in files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ..._version import __version__
from ...files import Table, csv_text, json_text, write_text
from ...materials.made_for import dimension_of
from ...report.style import CYCLE, Axes, drawing
from ...report.tables import columns, scaled
from ...results.cracks import MODES
from ...text import label_of, name_of
from . import exponents
from .measures import Measure
from .rock import Band, text_of
from .runs import Plan
from .verdict import MET, NOT_KNOWN, NOT_MET, Row

FILE, TABLE, PICTURE = "scorecard.json", "scorecard.csv", "scorecard.png"
HEADER = ("measure", "rock", "band", "mean", "±", "within", "verdict")
#: Last column, if exponents of a row are known that is not met.
KEYS = "exponents of keys"
NOTE = (
    "*: decides; in parentheses: band of similar rocks, not judged; no value: none in the rock file"
)
#: Units in which measures are shown, by their own; moduli are shown in GPa.
_SHOWN = {
    "Pa": (1e-6, "MPa"),
    "Pa m^0.5": (1e-6, "MPa m^0.5"),
    "degrees": (1.0, "degrees"),
    "-": (1.0, "-"),
}
_GPA = ("youngs_modulus",)
_COLOURS = {MET: CYCLE[2], NOT_MET: CYCLE[1], NOT_KNOWN: "0.5"}
#: Largest distance from the middle of a band that is drawn, in half widths of the band.
_FARTHEST = 4.0
#: Half width of a band that is open at an end, over its bound [-].
_OPEN = 0.5


def shown(measure: Measure) -> tuple[float, str]:
    """Factor and unit in which a measure is shown."""
    return (1e-9, "GPa") if measure.name in _GPA else _SHOWN[measure.unit]


def keys_of(plan: Plan, rows: Sequence[Row]) -> list[str]:
    """Return for each row that is not met the keys that change it most, with their exponents.

    A row has an empty text if it is not known or met, or if no exponents were measured near the
    material, for the model in the dimension of the specimens.
    """
    known = exponents.load(plan.model, dimension_of(solid=plan.solid))
    if known is None or not known.holds_for(plan.loaded):
        return [""] * len(rows)
    return [known.text(row.measure.name) if row.verdict == NOT_MET else "" for row in rows]


def header_of(cells: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Return the header of the rows with or without a column of exponents."""
    return (*HEADER, KEYS) if any(len(one) > len(HEADER) for one in cells) else HEADER


def lines(rows: Sequence[Row], keys: Sequence[str]) -> list[tuple[str, ...]]:
    """Return the cells of the rows; a band in parentheses is of similar rocks and not judged.

    Args:
        rows: The rows.
        keys: Keys that change each row; the column is left out if it is empty.
    """
    found: list[tuple[str, ...]] = []
    for row, moving in zip(rows, keys, strict=True):
        factor, unit = shown(row.measure)
        entry = row.entry
        bands = [] if entry.value is None else [text_of(entry.band, factor)]
        bands += [] if entry.general is None else [f"({text_of(entry.general, factor)})"]
        within = "-" if row.within is None else f"{row.within} of {len(row.values)}"
        found.append(
            (
                f"{row.measure.words} [{unit}]{' *' if entry.decides else ''}",
                scaled(entry.value, factor, ""),
                " ".join(bands) or "-",
                _cell(row.mean, factor, 4),
                _cell(row.error, factor, 2),
                within,
                verdict_text(row),
                *((moving or "-",) if any(keys) else ()),
            )
        )
    return found


def _cell(value: float | None, factor: float, digits: int) -> str:
    """Return a number in the unit that is shown; 0 is no value without digits."""
    return "0" if value == 0.0 else scaled(value, factor, "", digits)


def verdict_text(row: Row) -> str:
    """Return the verdict, with the reason if it is not known."""
    return ": ".join(filter(None, (row.verdict, "; ".join(row.reasons))))


def table(plan: Plan, rows: Sequence[Row], pairs: Sequence[Table]) -> str:
    """Return the scorecard as text."""
    packings = f"{len(plan.seeds)} packing{'s' if len(plan.seeds) > 1 else ''}"
    title = (
        f"{name_of(plan.material)}, {plan.model} model, {plan.shape}, {packings}, size "
        f"{plan.size.name}; rock: {name_of(plan.rock.name)}"
    )
    cells = lines(rows, keys_of(plan, rows))
    text = f"{title}\n{columns(header_of(cells), cells)}"
    text += f"\n  {NOTE}"
    return f"{text}\n{columns(PAIRS, pair_lines(pairs))}" if pairs else text


#: Columns of the table of minerals.
PAIRS = ("cracks in compression", *(f"{mode} [%]" for mode in MODES.values()))


def pair_lines(pairs: Sequence[Mapping[str, object]]) -> list[tuple[str, ...]]:
    """Return the cells of the cracks by pair of minerals, in percent of all cracks."""
    return [
        (
            name_of(str(one["pair"])),
            *(f"{100.0 * float(str(one[mode])):.1f}" for mode in MODES.values()),
        )
        for one in pairs
    ]


def write(folder: Path, plan: Plan, rows: Sequence[Row], pairs: Sequence[Table]) -> None:
    """Write figure and tables; scorecard.json, by which the folder is known, is the last."""
    picture(folder / PICTURE, plan, rows)
    keys = keys_of(plan, rows)
    write_text(folder / TABLE, _csv(rows, keys))
    jobs = {
        str(seed): {name: job.folder for name, job in runs.items()}
        for seed, runs in plan.jobs.items()
    }
    content = {
        "flexpm": __version__,
        **{"material": plan.material, "model": plan.model, "shape": plan.shape},
        "size": {"name": plan.size.name, "full": plan.size.full, "rate": plan.size.rate},
        "seeds": list(plan.seeds),
        "rock": {name: getattr(plan.rock, name) for name in ("name", "note", "source")},
        **{"not_met": names_of(rows, NOT_MET), "not_known": names_of(rows, NOT_KNOWN)},
        "failed": failed(rows, full=plan.size.full),
        "rows": [{**row.as_dict(), "exponents": one} for row, one in zip(rows, keys, strict=True)],
        "table": [list(line) for line in lines(rows, keys)],
        "cracks_by_pair": list(pairs),
        "runs": jobs,
    }
    write_text(folder / FILE, json_text(content))


def names_of(rows: Sequence[Row], verdict: str) -> list[str]:
    """Return the names of the measures that decide and have a verdict."""
    return [row.measure.name for row in rows if row.decides and row.verdict == verdict]


def failed(rows: Sequence[Row], *, full: bool) -> list[str]:
    """Return the names of the measures by which a scorecard fails.

    Args:
        rows: Its rows.
        full: Whether the specimens are full.
    """
    return [row.measure.name for row in rows if row.fails(full=full)]


def _csv(rows: Sequence[Row], keys: Sequence[str]) -> str:
    """One line a measure, SI units."""
    names = (
        *("measure", "unit", "value", "spread", "lower", "upper"),
        *("general_lower", "general_upper", "decides", "mean", "error", "within", "packings"),
        *("verdict", "reasons", "exponents"),
    )
    cells = []
    for row, moving in zip(rows, keys, strict=True):
        entry, general = row.entry, row.entry.general or Band()
        cells.append(
            (
                *(row.measure.name, row.measure.unit, entry.value, entry.spread),
                *(entry.band.lower, entry.band.upper, general.lower, general.upper),
                *(str(entry.decides).lower(), row.mean, row.error, row.within, len(row.values)),
                *(row.verdict, "; ".join(row.reasons), moving),
            )
        )
    return csv_text(names, cells)


def picture(path: Path, plan: Plan, rows: Sequence[Row]) -> None:
    """Draw a bar for each row that has a band: packings and mean against the band."""
    drawn = [row for row in rows if row.entry.value is not None or row.entry.general is not None]
    with drawing(path, (7.4, 1.1 + 0.27 * max(len(drawn), 1))) as axes:
        for number, row in enumerate(drawn):
            _bar(axes, number, row)
        axes.axvline(0.0, color="0.6", lw=0.6)
        axes.set_xlim(-_FARTHEST - 0.3, _FARTHEST + 0.3)
        labels = [f"{row.measure.words}{' *' if row.entry.decides else ''}" for row in drawn]
        axes.set_yticks(range(len(drawn)), labels)
        axes.set_ylim(len(drawn) - 0.4, -0.6)
        axes.set_xlabel(
            "distance from the middle of the band, in its half widths [-]\n"
            "diamonds: means; circles: packings; *: decides\n"
            "green: met; orange: not met; grey: not known\n"
            "light: twice the band; hatched: similar rocks, not judged"
        )
        title = f"{plan.material} ({plan.model}, {plan.size.name}) and {plan.rock.name}"
        axes.set_title(label_of(title), fontsize=9.5, loc="left")


def _bar(axes: Axes, number: int, row: Row) -> None:
    """Draw one row: band, twice the band, packings and mean with their number."""
    entry, colour = row.entry, _COLOURS[row.verdict]
    band = entry.band if entry.value is not None else entry.general or Band()
    middle, half = _scale(band, entry.value)

    def at(value: float) -> float:
        return float(np.clip((value - middle) / half, -_FARTHEST, _FARTHEST))

    def span(one: Band) -> tuple[float, float]:
        low = -_FARTHEST if one.lower is None else at(one.lower)
        return low, (_FARTHEST if one.upper is None else at(one.upper)) - low

    if entry.value is not None:
        low, width = span(band.widened(entry.value))
        axes.barh(number, width, left=low, height=0.62, color="#eef3f7")
        low, width = span(band)
        axes.barh(number, width, left=low, height=0.62, color="#c3d5e2")
    if entry.general is not None:
        low, width = span(entry.general)
        axes.barh(
            *(number, width), left=low, height=0.62, color="none", edgecolor="0.65", hatch="////"
        )
    places = [at(one.number) for one in row.values if one.number is not None]
    axes.plot(places, [number] * len(places), "o", ms=3.5, mfc="none", mec=colour)
    if row.mean is None:
        return
    beyond = abs((row.mean - middle) / half) > _FARTHEST
    marker = "D" if not beyond else (">" if row.mean > middle else "<")
    axes.plot(at(row.mean), number, marker, ms=5.0, color=colour)


def _scale(band: Band, value: float | None) -> tuple[float, float]:
    """Return middle and half width of a band; of an open band the bound lies at -1 or 1."""
    if band.lower is not None and band.upper is not None:
        return 0.5 * (band.lower + band.upper), 0.5 * (band.upper - band.lower)
    bound = band.lower if band.lower is not None else band.upper or 0.0
    half = abs((value if value is not None else bound) - bound) or _OPEN * abs(bound) or 1.0
    return (bound + half if band.lower is not None else bound - half), half
