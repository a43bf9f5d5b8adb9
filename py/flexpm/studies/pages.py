# SPDX-License-Identifier: GPL-3.0-or-later
"""report.html of any folder with results. SI units; shown in GPa, MPa and %.

A report is made from files only, so it can be made again at any time.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from .._version import __version__
from ..errors import InputError
from ..files import Table, load_csv, load_json, read_text
from ..kinds.registry import OWN
from ..kinds.registry import kind_of as test_of
from ..report.pages.page import (
    FILE,
    Chart,
    Line,
    Page,
    Picture,
    Rows,
    Status,
    numbers,
    rows_to_draw,
)
from ..report.pages.page import write as write_page
from ..report.pages.page_run import cite, inputs_table, maps_of, versions
from ..report.pages.statuses import OWN_STATUS, STATUS
from ..report.style import CYCLE
from ..report.tables import scaled, size_text
from ..report.words import words_of_result, words_of_test
from ..results.result import Result
from ..results.result_checks import SO_FAR
from ..runs.asked import told_of, write_report
from ..runs.output import KINDS, RESULT, kind_of
from ..text import name_of, printable, words_of
from .calibration_report import unit_of
from .calibration_verdict import FILE as VERDICT
from .jobs import place_of
from .scorecards.output import FILE as SCORECARD
from .scorecards.output import NOTE, PAIRS, header_of, pair_lines
from .scorecards.output import PICTURE as BARS
from .scorecards.verdict import MET, NOT_KNOWN, NOT_MET

#: Maps of a comparison; each takes about a third of a megabyte for the paper's specimen.
_MOST_MAPS = 6
#: Runs whose curves a page shows, points of each, and rows of a table.
_MOST_CURVES, _POINTS, _MOST_ROWS = 30, 400, 300
#: Columns of a run that stand in each table of runs.
_MORE = ("fragments", "status")


def require_results(folder: Path) -> Path:
    """Reject a folder without results.

    Raises:
        InputError: if it is not a folder of run, compare, study, calibrate or scorecard.
    """
    if kind_of(folder) is None:
        raise InputError(
            f"report: folder = {str(folder)!r}, has none of {', '.join(KINDS)}; give the folder of "
            "a run, compare, study, calibrate or scorecard"
        )
    return folder


def has_ended(folder: Path) -> bool:
    """Whether a folder has no unfinished run; `flexpm report` locks only such a folder."""
    return kind_of(folder) != "run" or (folder / RESULT).is_file()


def write(folder: Path) -> Path:
    """Write report.html into the folder of a run, compare, study, calibrate or scorecard.

    Returns:
        The file.

    Raises:
        InputError: if the folder holds no such results.
    """
    kind = kind_of(require_results(folder))
    try:
        if kind == "run":
            name = RESULT if has_ended(folder) else SO_FAR
            return write_report(folder, Result.read(folder, name))
        page = {
            "compare": _comparison,
            "packings": _packings,
            "study": _study,
            "calibrate": _calibration,
            "scorecard": _scorecard,
        }[str(kind)](folder)
        write_page(folder / FILE, page)
    except InputError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        # each file is a table of a run; what they say does not fit together
        about = " ".join(str(error).split())[:80]
        raise InputError(
            f"report: folder = {str(folder)!r}, has files that were changed or belong to different "
            f"runs ({about}); repeat the run"
        ) from error
    return folder / FILE


def _comparison(folder: Path) -> Page:
    """Return the report of several models or confining pressures on one packing."""
    rows = _read(folder / "compare.csv")
    pressures = len({row["confinement"] for row in rows})
    places = [place_of(row["model"], float(row["confinement"]), pressures) for row in rows]
    found = _results(folder, places)
    names = {place: place.replace("/", " ") for place in places}
    first = next(iter(found.values()), None)
    maps, missing = [], list[str]()
    for number, (place, one) in enumerate([*found.items()][:_MOST_MAPS]):
        made, why = maps_of(folder / place, one, f"map-{number}", names[place], None)
        maps += made
        missing += [f"{place}: {line}" for line in why]
    return Page(
        title=f"{rows[0]['test']}, {len(rows)} runs compared",
        about="" if first is None else size_text(first),
        versions=_versions(found),
        results=_runs("Results", rows, [names[place] for place in places], ("material",)),
        warnings=[*_warnings(found), *missing],
        charts=_curves({names[place]: one for place, one in found.items()}),
        maps=maps,
        tables=[*_envelope(folder), *_about(found)],
        pictures=_pictures(folder, ("envelope.png",)),
        commands=[("Each run:", _again(found))],
        cite=cite(__version__),
    )


def _packings(folder: Path) -> Page:
    """Page of a test on several packings."""
    rows, means = _read(folder / "table.csv"), _read(folder / "means.csv")
    places = [row["folder"] for row in rows]
    found = _results(folder, places)
    first = next(iter(found.values()), None)
    about = "" if first is None else size_text(first).rpartition(", ")[0]
    return Page(
        title=f"{rows[0]['test']}, {len(rows)} packings",
        about=about,
        versions=_versions(found),
        results=_means(means),
        warnings=_warnings(found),
        charts=_curves(found),
        tables=[_runs("Runs", rows, places), *_envelope(folder), *_about(found)],
        pictures=_pictures(folder, ("envelope.png",)),
        commands=[("Each run:", _again(found))],
        cite=cite(__version__),
    )


def _study(folder: Path) -> Page:
    """Page of a study."""
    rows = _read(folder / "table.csv")
    places = [f"runs/{row['key']}" for row in rows]
    found = _results(folder, places[:_MOST_CURVES])
    names = list(rows[0])
    inputs = names[1 : names.index("exit_code")]  # after the key
    asked = [name for name in inputs if len({row[name] for row in rows}) > 1]
    return Page(
        title=f"Study {name_of(folder.resolve().name)}, {len(rows)} runs",
        about="",
        versions=_versions(found),
        warnings=_warnings(found),
        charts=_curves(_by_inputs(rows, found, asked)) if len(rows) <= _MOST_CURVES else [],
        tables=[_runs("Runs", rows, places, asked), *_about(found)],
        pictures=_pictures(folder),
        commands=[("A run of the table, by the name of its folder:", f"flexpm rerun {places[0]}")],
        cite=cite(__version__),
    )


def _by_inputs(
    rows: Sequence[Mapping[str, str]], found: Mapping[str, Result], asked: Sequence[str]
) -> dict[str, Result]:
    """Return the results of a study by its varying inputs, with a unique name for each run."""
    names = {
        f"runs/{row['key']}": ", ".join(f"{words_of(key)} {_plain(row[key])}" for key in asked)
        for row in rows
    }
    return {names[place] or place: one for place, one in found.items()}


def _calibration(folder: Path) -> Page:
    """Page of a calibration."""
    names, rows = load_csv(folder / "history.csv", "history")
    shown = [[_plain(cell) for cell in row] for row in rows[-_MOST_ROWS:]]
    box, told = _verdict(folder)
    return Page(
        title=f"Calibration {name_of(folder.resolve().name)}",
        about=f"{len(rows)} sets of values were tried",
        versions=f"Made by flexpm {__version__}.",
        status=box,
        tables=[
            *told,
            Rows("Sets of values", [words_of(name) for name in names], shown),
        ],
        pictures=_pictures(folder),
        texts=[
            (f"Material {name_of(file.name)}", text)
            for file in sorted(folder.glob("*.toml"))
            if (text := _text_of(file))
        ],
        cite=cite(__version__),
    )


def _scorecard(folder: Path) -> Page:
    """Page of a scorecard: its table, a bar for each measure, and the curves of the runs."""
    content = load_json(folder / SCORECARD, "scorecard")
    size, rock = content["size"], content["rock"]
    places = {
        f"seed {seed} {words_of(name)}": f"runs/{key}"
        for seed, runs in content["runs"].items()
        for name, key in runs.items()
    }
    known = _results(folder, places.values())
    found = {name: known[place] for name, place in places.items() if place in known}
    notes = [("rock", rock["name"]), ("note", rock["note"]), ("source", rock["source"])]
    tables = [Rows("Rock", ("", ""), [(name, printable(str(text))) for name, text in notes])]
    if pairs := content["cracks_by_pair"]:
        note = "Shares of all cracks in compression, up to the end of the tests."
        tables.insert(0, Rows("Cracks by pair of minerals", PAIRS, pair_lines(pairs), note))
    return Page(
        title=f"Scorecard of {name_of(content['material'])}, rock: {name_of(rock['name'])}",
        about=f"{content['model']} model, {content['shape']}, size {size['name']}, seeds "
        f"{', '.join(map(str, content['seeds']))}",
        versions=_versions(found),
        status=_box(content),
        results=Rows("Measures", header_of(content["table"]), content["table"], NOTE),
        warnings=_shared_warnings(found),
        charts=_curves_by_test(found),
        tables=[*tables, *_about(found)],
        pictures=_pictures(folder, (BARS,)),
        commands=[("A run, by the name of its folder:", _again([place])) for place in [*known][:1]],
        cite=cite(__version__),
    )


def _box(content: Table) -> Status:
    """Box with the verdict on a scorecard: met only if all measures that decide are met."""
    found = {
        verdict: ", ".join(words_of(str(name)) for name in content[key])
        for verdict, key in ((NOT_MET, "not_met"), (NOT_KNOWN, "not_known"))
    }
    told = [
        f"These decide and are {verdict}: {names}." for verdict, names in found.items() if names
    ]
    advice = "" if content["size"]["full"] else "Only full specimens decide on all measures."
    if told:
        return Status(NOT_MET if found[NOT_MET] else NOT_KNOWN, False, " ".join(told), advice)
    if not any(row["rock"]["decides"] for row in content["rows"]):
        return Status(NOT_KNOWN, False, "No measure decides.", "")
    return Status(MET, True, "All measures that decide are met.", advice)


def _shared_warnings(found: Mapping[str, Result]) -> list[str]:
    """Return each warning once, with the first run that has it and the number of the others."""
    by_line: dict[str, list[str]] = {}
    for place, one in found.items():
        for line in one.warnings:
            by_line.setdefault(line, []).append(place)
    return [
        f"{names[0]}{f' and {len(names) - 1} more' if len(names) > 1 else ''}: {line}"
        for line, names in by_line.items()
    ]


def _curves_by_test(found: Mapping[str, Result]) -> list[Chart]:
    """Return a chart for each test; tests of cores without control share one."""
    groups: dict[str, dict[str, Result]] = {}
    for name, one in found.items():
        controlled = (one.inputs or {}).get("control") is not None
        kind = test_of(one.test)
        cores = "Compression" if kind.is_core else kind.title or one.test.capitalize()
        title = "Controlled compression" if controlled else cores
        groups.setdefault(title, {})[name] = one
    return [
        chart._replace(name=f"stress{number}", title=f"{title}{_left_out(len(group))}")
        for number, (title, group) in enumerate(groups.items())
        for chart in _curves(group)
    ]


def _verdict(folder: Path) -> tuple[Status | None, list[Rows]]:
    """Return box and tables of the verdict of a calibration; none if it was not finished."""
    file = folder / VERDICT
    if not file.is_file():
        return None, []
    content = load_json(file, "verdict")
    missed = [words_of(str(name)) for name in content["missed"]]
    lines = [printable(str(line)) for line in content["advice"]]
    meaning = f"Missed: {', '.join(missed)}." if missed else "All targets are met."
    name = "not met" if missed else "met"
    told = " ".join(f"{line[:1].upper()}{line[1:]}." for line in lines)
    box = Status(name, not missed, meaning, told)
    shares = [(words_of(str(key)), f"{float(part):.2g}") for key, part in content["left"].items()]
    note = "Near 1: the targets do not determine the key within its bounds; near 0: they do."
    tables = [Rows("Uncertainty of the keys", ("key", "remaining scatter [-]"), shares, note)]
    if measures := content.get("measures"):
        header = ("measure", "result", "target", "tolerance [%]", "verdict", "advice")
        tables.insert(0, Rows("Targets", header, [_of_target(one) for one in measures]))
    return box, tables


def _of_target(one: Table) -> tuple[str, ...]:
    """Result and verdict of a target."""
    factor, unit = unit_of(str(one["name"]))
    mean, error = one["mean"], one["error"]
    result = "-" if mean is None else f"{factor * mean:.4g}"
    if error is not None:
        result += f" ± {factor * error:.2g}"
    verdict = "met" if one["met"] else "missed" if mean is not None else "not measured"
    advice = ". ".join(printable(str(line)) for line in one["advice"])
    least = "at least " if one.get("least") else ""
    target = f"{least}{factor * one['target']:.4g} {unit}".rstrip()
    tolerance = f"{100.0 * one['tolerance']:g}"
    return (words_of(str(one["name"])), result, target, tolerance, verdict, advice)


def _text_of(file: Path) -> str:
    """Return the text of a file without cursor movements; empty if it cannot be read."""
    try:
        return printable(read_text(file), kept="\n\t")
    except (OSError, ValueError):
        return ""


def _read(path: Path) -> list[dict[str, str]]:
    names, rows = load_csv(path, "table")
    if not rows:
        raise InputError(f"table = {str(path)!r}, has no runs; give the folder of finished runs")
    return [dict(zip(names, row, strict=True)) for row in rows]


def _results(folder: Path, places: Iterable[str]) -> dict[str, Result]:
    """Results of finished tests by their folder; an elastic solution has no curve and no page."""
    found = {}
    for place in places:
        if Path(place).is_absolute() or ".." in Path(place).parts:
            raise InputError(f"report: run = {place!r}, must lie in {folder}; correct its table")
        if all((folder / place / name).is_file() for name in (RESULT, "curve.csv")):
            found[place] = Result.read(folder / place)
    return found


def _runs(
    title: str,
    rows: Sequence[Mapping[str, str]],
    names: Sequence[str],
    inputs: Sequence[str] = (),
) -> Rows:
    """Return one row per run: inputs and outcome."""
    tests = dict.fromkeys(row.get("test", OWN.name) for row in rows)  # of a script: its own
    shown = {key: value for test in tests for key, value in words_of_test(test).shown.items()}
    header = ["run", *map(words_of, inputs), *(one.heading for one in shown.values()), *_MORE]
    lines = [
        [
            name,
            *(_plain(row.get(key, "")) for key in inputs),
            *(_cell(row.get(key, ""), *shown[key]) for key in shown),
            *(row.get(key, "") or "-" for key in _MORE),
        ]
        for name, row in zip(names, rows, strict=True)
    ]
    note = "" if len(lines) <= _MOST_ROWS else f"The first {_MOST_ROWS} of {len(lines)} runs."
    return Rows(title, header, lines[:_MOST_ROWS], note)


def _means(means: Sequence[Mapping[str, str]]) -> Rows:
    """Means over the packings with their standard deviations."""
    shown = words_of_test(means[0]["test"]).shown
    header = ["model", "confining pressure [MPa]", "runs", *(one.heading for one in shown.values())]
    lines = []
    for row in means:
        cells = []
        for key, (factor, _, digits) in shown.items():
            mean = _cell(row[key], factor, "", digits)
            scatter = _cell(row[f"{key}_deviation"], factor, "", 2)
            cells.append(f"{mean} ± {scatter}")
        pressure = _cell(row["confinement"], 1e-6, "", 3)
        counted = f"{int(row['runs']) - int(row['failed'])} of {row['runs']}"
        lines.append([row["model"], pressure, counted, *cells])
    note = "Mean and standard deviation of the packings; failed runs are not included."
    return Rows("Means", header, lines, note)


def _cell(text: str, factor: float, _: str, digits: int) -> str:
    if text.isdigit() and factor == 1.0:
        return text  # a count
    return scaled(float(text), factor, "", digits) if text else "-"


def _plain(text: str) -> str:
    """A cell as it is, a number with the digits that are read."""
    try:
        return f"{float(text):.5g}"
    except ValueError:
        return text or "-"


def _curves(found: Mapping[str, Result]) -> list[Chart]:
    """Stress over strain of all runs in one chart."""
    lines = []
    for number, (name, one) in enumerate([*found.items()][:_MOST_CURVES]):
        words = words_of_result(one)
        strain, stress = one.curve[words.x.column], one.curve[words.y.column]
        at_peak = one.curve["axial_stress"] == one.peak_stress
        kept = [] if one.peak_stress is None else [int(np.argmax(at_peak))]
        rows = rows_to_draw(np.column_stack([strain, stress]), _POINTS, kept)
        marks = [int(np.searchsorted(rows, row)) for row in kept]
        x, y = numbers(strain[rows], words.x.factor), numbers(stress[rows], words.y.factor)
        colour, dashed = CYCLE[number % len(CYCLE)], number // len(CYCLE) % 2 == 1
        lines.append(Line(name, x, y, colour, dashed=dashed, marks=marks))
    if not lines:
        return []
    names = words_of_result(next(iter(found.values())))
    axes = names.x.label, names.y.label
    title = f"{names.title()}{_left_out(len(found))}"
    return [Chart("stress", title, *axes, lines, shared=False)]


def _left_out(runs: int) -> str:
    """Part of the title of a chart that does not draw all runs."""
    return f", first {_MOST_CURVES} of {runs} runs" if runs > _MOST_CURVES else ""


def _about(found: Mapping[str, Result]) -> list[Rows]:
    """Return the meaning of all statuses other than ok, and the inputs of the first run."""
    ended = dict.fromkeys(one.status for one in found.values())
    known = {**OWN_STATUS, **STATUS}
    doubtful = [known[name] for name in ended if name in known and not known[name].good]
    tables = []
    if doubtful:
        rows = [(one.name, one.meaning, one.advice) for one in doubtful]
        tables.append(Rows("Meaning of the status", ("status", "meaning", "advice"), rows))
    for place, first in [*found.items()][:1]:
        asked = told_of(first.inputs or {})
        tables.append(inputs_table(asked, f"Inputs of {place}"))
    return tables


def _warnings(found: Mapping[str, Result]) -> list[str]:
    return [f"{place}: {line}" for place, one in found.items() for line in one.warnings]


def _versions(found: Mapping[str, Result]) -> str:
    return "; ".join(dict.fromkeys(map(versions, found.values()))) or f"flexpm {__version__}."


def _again(found: Iterable[str]) -> str:
    return "\n".join(f"flexpm rerun {place}/result.json" for place in found)


def _envelope(folder: Path) -> list[Rows]:
    file = folder / "envelope.csv"
    if not file.is_file():
        return []
    names, rows = load_csv(file, "envelope")
    note = "SI units and degrees, with the standard errors of the fits."
    lines = [[_plain(cell) for cell in row] for row in rows]
    return [Rows("Strength criteria", [words_of(name) for name in names], lines, note)]


def _pictures(folder: Path, names: Sequence[str] | None = None) -> list[Picture]:
    """Return the pictures of a folder, or all existing pictures with the given names."""
    files = sorted(folder.glob("*.png")) if names is None else [folder / name for name in names]
    return [Picture(words_of(file.stem), file) for file in files if file.is_file()]
