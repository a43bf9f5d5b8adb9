# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command shows: progress, tables in the units of the laboratory, one-line errors."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterable, Sequence
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..materials.references import Reference
    from ..results.result import Result
    from ..studies.comparison import Case, Envelope


class Terminated(BaseException):
    """The process was asked to end (SIGTERM)."""


def catch_signals() -> None:
    """Let Ctrl-C and SIGTERM raise KeyboardInterrupt and Terminated in the main thread.

    To be called again once YADE is loaded, which installs handlers of its own.
    """

    def terminate(number: int, frame: FrameType | None) -> None:
        raise Terminated

    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, terminate)


def error_line(text: str) -> None:
    """Write `text` as one line to stderr."""
    print("flexpm:", " ".join(str(text).split()), file=sys.stderr)


class Progress:
    """Progress bar on stderr with rate and remaining time; silent unless stderr is a terminal."""

    _FORMAT = (
        "{desc} {percentage:3.0f} % |{bar}| {n:.0f}/{total:.0f} [{rate_fmt}, {remaining} left]"
    )

    def __init__(self, quiet: bool = False, unit: str = "steps") -> None:
        self._bar: Any = None
        self._unit = f" {unit}"
        self._shown = sys.stderr.isatty() and not quiet

    def __call__(self, done: float, expected: float, text: str = "") -> None:
        """Show that `done` of about `expected` are done; `text` says what is going on.

        Fewer done than before mean that something new has begun.
        """
        if not self._shown:
            return
        if self._bar is None or done < self._bar.n:
            self._restart(text, expected)
        self._bar.desc = text
        self._bar.total = max(done, expected)
        self._bar.update(done - self._bar.n)

    def _restart(self, text: str, expected: float) -> None:
        from tqdm import tqdm

        self.close()
        self._bar = tqdm(
            desc=text,
            total=max(expected, 1),
            unit=self._unit,
            leave=False,
            bar_format=self._FORMAT,
            mininterval=0.2,
        )

    def close(self) -> None:
        """Remove the bar from the terminal."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def table(rows: Iterable[tuple[str, str]], title: str = "") -> str:
    """Two columns of text: names and values."""
    rows = list(rows)
    width = max((len(name) for name, _ in rows), default=0)
    lines = [f"  {name:<{width}}  {value}" for name, value in rows]
    return "\n".join([title, *lines] if title else lines)


def scaled(value: float | None, factor: float, unit: str, digits: int = 4) -> str:
    """`value` times `factor` with its unit, or a dash for a missing value."""
    if value is None:
        return "-"
    return f"{factor * value:#.{digits}g}".rstrip(".") + (f" {unit}" if unit else "")


def result_table(result: Result) -> str:
    """Short table of the outcome of a test."""
    counts = f"{result.tensile_cracks} tensile, {result.shear_cracks} shear"
    rows = [
        ("grains, contacts", f"{result.grains}, {result.contacts}"),
        ("Young's modulus", scaled(result.youngs_modulus, 1e-9, "GPa")),
        ("Poisson's ratio", scaled(result.poissons_ratio, 1.0, "", 3)),
        ("peak stress", scaled(result.peak_stress, 1e-6, "MPa")),
        ("strain at peak", scaled(result.peak_strain, 100.0, "%")),
        ("softening slope", scaled(result.softening_slope, 1e-9, "GPa")),
        ("cracked points", counts),
        ("first tensile, shear crack", _first_cracks(result)),
        ("fragments", _fragments(result)),
        ("unbalanced-force ratio", scaled(result.unbalanced_ratio, 1.0, "", 2)),
        ("energy error", scaled(result.energy_error, 100.0, "%", 2)),
        ("steps", f"{result.steps} of {scaled(result.step_time, 1e3, 'ms', 3)}"),
        ("status", result.status),
    ]
    if result.confinement:
        rows.insert(1, ("confinement", scaled(result.confinement, 1e-6, "MPa")))
    name = result.material.get("name", "")
    return table(rows, f"{result.test}, {result.model} model, {name}, seed {result.seed}")


def _first_cracks(result: Result) -> str:
    stresses = result.first_tensile_crack_stress, result.first_shear_crack_stress
    return "at " + ", ".join(scaled(stress, 1e-6, "MPa") for stress in stresses)


def _fragments(result: Result) -> str:
    if result.fragments is None:
        return "-"
    share = scaled(result.largest_fragment, 100.0, "%", 3)
    return f"{result.fragments}, the largest with {share} of the area"


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


def comparison_table(cases: Sequence[Case]) -> str:
    """One line for each run of a comparison."""
    header = ("run", "E [GPa]", "nu", "peak [MPa]", "strain [%]", "tensile", "shear", "fragments")
    rows = []
    for case in cases:
        found = case.result
        if found is None:
            rows.append((case.name, *["-"] * (len(header) - 1), "failed"))
            continue
        numbers = (
            scaled(found.youngs_modulus, 1e-9, ""),
            scaled(found.poissons_ratio, 1.0, "", 3),
            scaled(found.peak_stress, 1e-6, ""),
            scaled(found.peak_strain, 100.0, "", 3),
            str(found.tensile_cracks),
            str(found.shear_cracks),
            str(found.fragments),
        )
        rows.append((case.name, *numbers, found.status))
    return columns((*header, "status"), rows)


def envelope_table(envelopes: Sequence[Envelope], rock: Reference | None) -> str:
    """Cohesion, friction angle and Hoek-Brown constants, each with its standard error."""
    header = ("criterion", "c [MPa]", "+-", "phi [deg]", "+-", "sigma_ci [MPa]", "+-", "m_i", "+-")
    factors = {"cohesion": 1e-6, "friction_angle": 1.0, "sigma_ci": 1e-6, "m_i": 1.0}
    rows = []
    for one in envelopes:
        found = one.as_dict()
        cells = [one.model]
        for name, factor in factors.items():
            cells.append(scaled(found[name], factor, ""))
            cells.append(scaled(found[f"{name}_error"], factor, "", 2))
        rows.append(cells)
    if rock is not None:
        measured = scaled(rock.cohesion, 1e-6, ""), scaled(rock.friction_angle, 1.0, "")
        rows.append((rock.name, measured[0], "-", measured[1], *["-"] * 5))
    return columns(header, rows)


def statistics_table(found: dict[str, Any]) -> str:
    """Table of what can be counted and measured in a specimen, SI units and degrees."""
    rows = []
    for name, value in found.items():
        if isinstance(value, dict):
            rows += [(f"{name} {key}", f"{number:.4g}") for key, number in value.items()]
        else:
            rows.append((name, str(value) if isinstance(value, int) else f"{value:.6g}"))
    return table((name.replace("_", " "), value) for name, value in rows)


def elastic_table(found: dict[str, float]) -> str:
    """Table of the elastic constants found by a direct solve."""
    rows = [
        ("Young's modulus", scaled(found["youngs_modulus"], 1e-9, "GPa", 5)),
        ("Poisson's ratio", scaled(found["poissons_ratio"], 1.0, "", 4)),
    ]
    return table(rows)
