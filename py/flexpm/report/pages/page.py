# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports that open in a browser without a network: one file with tables, curves, maps, pictures.

The template has the layout, Chart.js of Debian's libjs-chart.js plots the curves, and three.js of
libjs-three shows 3D specimens; both are copied into the file. Nothing is downloaded: the report
forbids it to the browser.
"""

from __future__ import annotations

import base64
import io
import zlib
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...arrays import FloatArray, IntArray
from ...files import write_text
from ...text import printable
from ..joint_colours import MOST_NAMES

#: Where Debian has the library of the curves.
CHARTS = Path("/usr/share/javascript/chart.js/chart.min.js")
#: Where it has the library of solids that turn, and how the pointer turns them.
TURNING = (
    Path("/usr/share/javascript/three/three.min.js"),
    Path("/usr/share/javascript/three/examples/js/controls/OrbitControls.js"),
)
#: Name of the file in the folder of the results.
FILE = "report.html"
_TEMPLATES = Path(__file__).with_name("templates")
#: Significant digits of numbers in curves.
_DIGITS = 6
#: A picture of more bytes, as of ten thousand grains, is pressed at this quality: a sixth of them
#: remain.
_LARGE, _QUALITY = 200_000, 90


class Line(NamedTuple):
    """A line of a chart."""

    label: str
    x: Sequence[float | None]
    y: Sequence[float | None]
    colour: str
    axis: str = "y"  #: ``y`` to the left, ``y2`` to the right
    dashed: bool = False
    marks: Sequence[int] = ()  #: points that are drawn as such


class Chart(NamedTuple):
    """Lines over one quantity."""

    name: str  #: of the element, a word
    title: str
    x: str  #: quantity and unit
    y: str
    lines: Sequence[Line]
    y2: str = ""
    shared: bool = True  #: the points of all lines belong together by their number


class Rows(NamedTuple):
    """A table."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""


class Status(NamedTuple):
    """How a run ended, in words."""

    name: str
    good: bool
    meaning: str
    advice: str


class Picture(NamedTuple):
    """A picture that exists as a file."""

    title: str
    file: Path

    @property
    def source(self) -> str:
        """Return the image data as text, of a large file at a reduced quality."""
        content, kind = self.file.read_bytes(), "png"
        if len(content) > _LARGE:
            content, kind = _pressed(self.file), "webp"
        return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"


def _pressed(file: Path) -> bytes:
    from PIL import Image

    content = io.BytesIO()
    with Image.open(file) as picture:
        picture.convert("RGB").save(content, "WEBP", quality=_QUALITY)
    return content.getvalue()


@dataclass(frozen=True)
class View:
    """A 3D view of a specimen that can be rotated, at the positions of its map.

    Attributes:
        name: Name of the element, a word.
        map: Name of the map whose slider selects the position.
        counts: Numbers of vertices, faces, grains and positions.
        size: Sides of the bounding box [mm].
        stress: Least and largest stress along the load that has a colour [MPa]; empty: unknown.
        joints: Name and colour of each joint.
        colours: Colours of joints, which faces name by their index.
        data: The arrays, see page_solid.py, deflated, in base64.
        note: Parts that are left out.
    """

    name: str
    map: str
    counts: dict[str, int]
    size: Sequence[float]
    stress: Sequence[float]
    joints: Sequence[tuple[str, str]]
    colours: Sequence[str]
    data: str
    note: str


@dataclass
class Map:
    """Cracks and fragments on the undeformed grains, at several positions of a test.

    Coordinates are whole numbers, y downwards; paths are those of SVG.
    """

    name: str  #: of the element, a word
    title: str
    size: tuple[int, int]
    bar: tuple[int, str]  #: length of the scale bar and what it stands for
    rock: Sequence[tuple[str, str, str]]  #: mineral, colour, path of all its grains
    grains: Sequence[str]  #: path of each grain
    notches: str  #: path of what was cut open before the test
    joints: Sequence[tuple[str, str, str]]  #: name, colour, path of the contacts of each joint
    cracks: Sequence[tuple[str, int, str]]  #: mode, position from which on it is there, path
    fragments: Sequence[str]  #: at each position one letter a grain: its colour
    texts: Sequence[str]  #: what is said of each position
    rows: Sequence[int] = ()  #: point of the chart at each position
    chart: str = ""  #: chart on which the position is marked
    view: View | None = None  #: of a solid


@dataclass
class Page:
    """Content of a report; empty parts are left out."""

    title: str
    about: str
    versions: str
    status: Status | None = None
    results: Rows | None = None
    warnings: Sequence[str] = ()
    charts: Sequence[Chart] = ()
    maps: Sequence[Map] = ()
    tables: Sequence[Rows] = ()
    pictures: Sequence[Picture] = ()
    texts: Sequence[tuple[str, str]] = ()  #: title and text as it stands
    commands: Sequence[tuple[str, str]] = ()  #: what it does, and the command
    cite: Sequence[str] = field(default_factory=list)


def write(path: Path, page: Page) -> None:
    """Write a page as one file, whole or not at all."""
    views = [one.view for one in page.maps if one.view]
    drawn = {
        "charts": [_plain(chart) for chart in page.charts],
        "maps": [
            {
                "name": one.name,
                "texts": one.texts,
                "fragments": one.fragments,
                "rows": one.rows,
                "chart": one.chart,
            }
            for one in page.maps
        ],
        "views": [asdict(view) for view in views],
    }
    there = views and all(file.exists() for file in TURNING)
    scripts = ("page", *(("three_licence",) if there else ()), *(("solid",) if views else ()))
    text = rendered(
        "page.html",
        page=page,
        drawn=drawn,
        most_names=MOST_NAMES,
        library=CHARTS.read_text(encoding="utf-8") if page.charts and CHARTS.exists() else "",
        style=(_TEMPLATES / "page.css").read_text(encoding="utf-8"),
        turning=deflated(_joined(*TURNING).encode()) if there else "",
        script=_joined(*(_TEMPLATES / f"{name}.js" for name in scripts)),
    )
    write_text(path, text)


def deflated(content: bytes) -> str:
    """Bytes for the page's script to inflate, in base64."""
    return base64.b64encode(zlib.compress(content, 9)).decode()


def _joined(*scripts: Path) -> str:
    return "\n".join(file.read_text(encoding="utf-8") for file in scripts)


def rendered(name: str, **content: object) -> str:
    """Fill a template; inserted values are text, not HTML."""
    import jinja2  # only where a page is written

    room = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        autoescape=True,
        finalize=_shown,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return room.get_template(name).render(content)


def _shown(value: object) -> object:
    """Return a text without characters that are invalid in HTML; HTML is returned unchanged."""
    plain = isinstance(value, str) and not hasattr(value, "__html__")
    return printable(value, kept="\n\t") if plain else value


def rows_to_draw(places: FloatArray, most: int, kept: Sequence[int] = ()) -> IntArray:
    """Return about evenly spaced rows that represent a line as well as all rows.

    Args:
        places: Coordinates of the rows, (N, K) of any units.
        most: Approximate number of rows.
        kept: Rows that are always included, besides the first and the last.
    """
    if len(places) == 0:
        return np.zeros(0, dtype=int)
    known = np.nan_to_num(places, posinf=0.0, neginf=0.0)
    span = np.ptp(known, axis=0)
    ways = np.abs(np.diff(known, axis=0)) / np.where(span > 0.0, span, 1.0)
    along = np.concatenate([[0.0], np.cumsum(ways.sum(axis=1))])
    even = np.searchsorted(along, np.linspace(0.0, along[-1], most))
    found: IntArray = np.unique([0, *even, *kept, len(places) - 1])
    return found


def numbers(values: FloatArray, factor: float = 1.0) -> list[float | None]:
    """Return numbers for a report; None for numbers that are not finite."""
    return [
        float(f"{value:.{_DIGITS}g}") if np.isfinite(value) else None
        for value in (factor * np.asarray(values, dtype=float)).tolist()
    ]


def _plain(chart: Chart) -> dict[str, object]:
    return chart._asdict() | {"lines": [line._asdict() for line in chart.lines]}
