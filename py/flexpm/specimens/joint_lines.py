# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of joints: from arrays, or from a CSV file. Lengths in metres. Nothing heavy is loaded."""

from __future__ import annotations

import csv
import hashlib
import io
import itertools
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import Table, read_text
from ..require import quoted

#: Columns of a file of joints.
COLUMNS = ("x1", "y1", "x2", "y2", "name")
#: Most segments in a specimen.
MOST_SEGMENTS = 20_000
#: Sizes of the specimen within which a point may lie: beyond, round-off shows in its place.
_FARTHEST = 1e6
#: Share of a length that is round-off.
_NOTHING = 1e-9
_NOT_IN_NAMES = set(". =,\"'")
Point = tuple[float, float]
Line = list[Point]
#: Lines of each joint, by its name.
Lines = dict[str, list[Line]]


def read(path: Path) -> Lines:
    """Read the segments of a CSV file; those of one name that follow each other are one line.

    A row without length repeats a point of its line, which counts once.

    Raises:
        InputError: if it cannot be read, or a row is no segment.
    """
    name = f"joints = {str(path)!r}"
    found: Lines = {}
    first_rows: dict[str, list[int]] = {}
    for number, row in _rows(name, path):
        label = (row[4] if len(row) > 4 else "").strip()
        where = f"{name}, line {number}, joint {quoted(label)}"
        if len(row) > len(COLUMNS):
            raise InputError(
                f"{where}: cells = {len(row)}, must be {len(COLUMNS)}, one for each column; "
                "take out what is too much"
            )
        _check_name(label, f"{where}: name")
        start, end = _ends(where, row)
        lines = found.setdefault(label, [])
        if lines and lines[-1][-1] == start:
            lines[-1].append(end)
        else:
            lines.append([start, end])
            first_rows.setdefault(label, []).append(number)
    for label, lines in found.items():
        for line, number in zip(lines, first_rows[label], strict=True):
            if all(point == line[0] for point in line):
                raise InputError(
                    f"{name}, line {number}, joint {quoted(label)}: x2, y2 = {line[0]} m, must not "
                    "be the start; remove the line"
                )
    return checked(found)


def _rows(name: str, path: Path) -> Iterator[tuple[int, list[str]]]:
    """Line numbers and cells of rows, these in the order of ``COLUMNS``, then what is too much."""
    try:
        text = read_text(path)
        rows = csv.reader(io.StringIO(text, newline=""), skipinitialspace=True)
        columns = next(rows, [])
        if sorted(columns) != sorted(COLUMNS):
            raise InputError(
                f"{name}: columns = {quoted(','.join(columns))}, must have rows and the columns "
                f"{','.join(COLUMNS)}, each once; correct it"
            )
        places = [columns.index(column) for column in COLUMNS]
        begun = False
        for row in rows:
            if row:
                begun = True
                cells = [row[place] if place < len(row) else "" for place in places]
                yield rows.line_num, cells + row[len(COLUMNS) :]
        if not begun:
            raise InputError(
                f"{name}, must have rows and the columns {','.join(COLUMNS)}; correct it"
            )
    except OSError as error:
        raise InputError(f"{name}, cannot be read ({error.strerror}); give a CSV file") from None
    except InputError:
        raise
    except (ValueError, csv.Error) as error:  # also of a name that can be none
        raise InputError(f"{name}, is no CSV file: {error}") from None


def checked(joints: object) -> Lines:
    """Lines of joints by name; a joint may be one line, rows x, y, or a list of lines.

    Raises:
        InputError: for what is no line.
    """
    if not isinstance(joints, Mapping) or not joints:
        raise InputError(f"joints = {quoted(joints)}, must be lines by the name of their joint")
    found: Lines = {}
    for name, given in joints.items():
        _check_name(name, "joint")
        lines = _plain(given)
        if _is_line(lines):
            lines = [lines]
        if not isinstance(lines, list) or not lines or not all(map(_is_line, lines)):
            raise InputError(
                f"joint {name} = {quoted(given)}, must be a line of two points x, y or more, or a "
                "list of lines"
            )
        found[name] = [_without_repeats(name, line) for line in lines]
    return found


def _check_name(name: object, where: str) -> None:
    """Refuse what is no printable word."""
    if not isinstance(name, str) or not name.isprintable() or not name or set(name) & _NOT_IN_NAMES:
        raise InputError(
            f"{where} = {quoted(name)}, must be a name without spaces, dots, commas, quotes, "
            "equals signs and what cannot be printed"
        )


def _without_repeats(name: str, line: Sequence[Sequence[float]]) -> Line:
    """A line whose points that are there twice in a row count once."""
    points = [(float(x), float(y)) for x, y in line]
    found = points[:1] + [b for a, b in itertools.pairwise(points) if a != b]
    if len(found) < 2:
        raise InputError(
            f"joint {name}: point = {found[0]} m, must not be there twice in a line without "
            "length; remove the line"
        )
    return found


@dataclass(frozen=True)
class Cut:
    """What came of the lines of a joint.

    Attributes:
        lines: That were asked for.
        idle: Those of them that cut nothing.
        length: Length of all lines as they were asked for [m].
        cut: Where they have made contacts of the joint [m].
        taken: Where they lie on contacts that a joint had before [m].
        outside: Outside of the specimen [m]. What is left ends within grains.
        on: The joint on which most of `taken` lies; None: nothing was taken.

    Up to a tenth of a grain at the outline of what is cut may count as left.
    """

    lines: int
    idle: int
    length: float
    cut: float
    taken: float
    outside: float
    on: str | None = None

    @property
    def missing(self) -> float:
        """Length inside the specimen that is not cut [m]."""
        return max(self.length - self.outside - self.cut, 0.0)

    @property
    def reason(self) -> str:
        """Why not more of it is cut, by the largest part."""
        within = self.length - self.cut - self.taken - self.outside
        if self.taken > 0.0 and self.taken >= within:
            return f"lies on joint {self.on}, which was cut first"
        if within > _NOTHING * self.length:
            return "ends within grains"
        return "lies outside the specimen"

    def and_(self, more: Cut | None) -> Cut:
        """The same joint with more lines."""
        if more is None:
            return self
        sums = {key: getattr(self, key) + getattr(more, key) for key in _SUMS}
        return Cut(**sums, on=self.on if self.taken >= more.taken else more.on)

    def to_json(self) -> Table:
        """As plain values, with the reason."""
        return {**asdict(self), "reason": self.reason}

    @classmethod
    def from_json(cls, values: Table) -> Cut:
        """From plain values."""
        return cls(**{key: value for key, value in values.items() if key != "reason"})


_SUMS = ("lines", "idle", "length", "cut", "taken", "outside")


def require_within(lines: Lines, low: Point, high: Point) -> None:
    """Refuse lines that cannot be cut: far from a specimen's box, or too many of them within it.

    Raises:
        InputError: for a point further away than 1e6 sizes, or more than 20 000 segments.
    """
    size = math.hypot(high[0] - low[0], high[1] - low[1])
    inside = 0
    for name, given in lines.items():
        for number, line in enumerate(given):
            for x, y in line:
                if not math.hypot(x - low[0], y - low[1]) <= _FARTHEST * size:
                    raise InputError(
                        f"joint {name}: line {number} from {line[0]} m: point = ({x:.12g}, "
                        f"{y:.12g}) m, must lie within 1e6 sizes of the specimen; move it there"
                    )
            inside += sum(_meets(a, b, low, high) for a, b in itertools.pairwise(line))
    if inside > MOST_SEGMENTS:
        raise InputError(
            f"joints: segments in the specimen = {inside}, must be <= {MOST_SEGMENTS}; leave some "
            "out, or make longer ones"
        )


def require_any(cuts: Mapping[str, Cut], lines: Lines, low: Point, high: Point) -> None:
    """Refuse a set of lines none of which cuts anything.

    Args:
        cuts: What came of the lines.
        lines: The lines, by joint.
        low: Lower left corner of the specimen's box [m].
        high: Upper right one [m].
    """
    if any(one.cut > 0.0 for one in cuts.values()):
        return
    places = [point for given in lines.values() for line in given for point in line]
    x, y = zip(*places, strict=True)
    first, one = next(iter(cuts.items()))
    raise InputError(
        f"joints: lines that cut a cell = 0 of {sum(one.lines for one in cuts.values())}, must be "
        f">= 1 (joint {first} {one.reason}); they lie from {_place((min(x), min(y)))} to "
        f"{_place((max(x), max(y)))}, the specimen from {_place(low)} to {_place(high)}: move or "
        "lengthen them"
    )


def _place(point: Point) -> str:
    return f"({point[0]:.6g}, {point[1]:.6g}) m"


def _meets(a: Point, b: Point, low: Point, high: Point) -> bool:
    """Whether the box of a segment meets another box."""
    return all(
        max(a[axis], b[axis]) >= low[axis] and min(a[axis], b[axis]) <= high[axis]
        for axis in (0, 1)
    )


def checksum(lines: Lines, before: str | None = None) -> str:
    """Short hash of lines, and of those that a specimen has already."""
    text = json.dumps([before, sorted(lines.items())])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _ends(where: str, row: Sequence[str]) -> Line:
    values = []
    for key, cell in zip(COLUMNS[:4], row, strict=False):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise InputError(f"{where}: {key} = {quoted(cell)} m, must be a number; correct it")
        values.append(value)
    return [(values[0], values[1]), (values[2], values[3])]


def _plain(given: object) -> Any:
    """Arrays as lists."""
    if hasattr(given, "tolist"):
        return given.tolist()
    if isinstance(given, Sequence) and not isinstance(given, str):
        return [_plain(one) for one in given]
    return given


def _is_line(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= 2 and all(map(_is_point, value))


def _is_point(value: Any) -> bool:
    numbers = isinstance(value, list) and len(value) == 2
    return numbers and all(isinstance(x, int | float) and math.isfinite(x) for x in value)
