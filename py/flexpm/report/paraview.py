# SPDX-License-Identifier: GPL-3.0-or-later
"""State for ParaView: the frames of a run, grains by their stress, cracks by their mode. SI units.

A state is XML, which any ParaView reads, also a ParaView without Python such as Debian's. This
state has only the values of a state of ParaView 5.11 that differ from ParaView's defaults.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
from matplotlib import colormaps, colors

from ..arrays import FloatArray
from ..files import write_text
from ..kinds.registry import kind_of
from ..results.arrays.vtu_arrays import GRAIN
from ..results.cracks import MODES
from ..results.result import Result
from ..results.solids.state import AnySnapshot
from ..results.vtu import read_state
from .style import COLOURS, MODE_NAMES, can_be_drawn
from .tables import size_text, test_text

#: Percentile of the largest stress of all, where the colours end that begin at zero [%].
_END = 98.0
#: Stops of the colours, and half the height of the window over the longer side [-].
_STOPS, _MARGIN = 17, 0.6
#: Numbers of ParaView: data of points and cells, colours in RGB, a view that turns and one that
#: does not, corners and top of a window.
_POINTS, _CELLS, _RGB, _TURNED, _FLAT = 0, 1, 0, 0, 1
_LOWER_LEFT, _LOWER_RIGHT, _TOP = 1, 2, 6
#: An animation goes from frame to frame.
_SNAP = 2
#: Parts of ParaView that hold an object: bits for data 1, pictures 4 + 16, the window 16.
_SERVERS = {
    **dict.fromkeys(("sources", "filters"), "1"),
    **dict.fromkeys(("lookup_tables", "representations", "views"), "21"),
    **dict.fromkeys(("misc", "animation"), "16"),
    "implicit_functions": "5",
}
#: Axes of space; to the viewer of a solid, in lengths of it: from the right, the front and above.
_SPACE, _FRONT = 3, (1.0, -2.5, 0.8)
_BLACK, _WHITE = (0, 0, 0), (1, 1, 1)


@dataclass(frozen=True)
class _Proxy:
    """An object of ParaView, as a value of a property of another object."""

    number: int


_Values = Sequence[object]


class _Colours(NamedTuple):
    """Colours of grains: an array over points or cells, and the range of its colours."""

    array: str
    place: int
    low: float
    high: float
    title: str


@dataclass(frozen=True)
class _Place:
    """Where a bonded specimen lies, and from where it is looked at.

    Attributes:
        low, high: Corners of the box around it [m].
    """

    low: FloatArray
    high: FloatArray

    @property
    def is_solid(self) -> bool:
        return len(self.low) == _SPACE

    @property
    def middle(self) -> list[float]:
        found = 0.5 * (self.low + self.high)
        return [*found] if self.is_solid else [*found, 0.0]

    @property
    def half_height(self) -> float:
        """Half the height of the window [m]."""
        return _MARGIN * float(np.max(self.high - self.low))

    @property
    def camera(self) -> list[float]:
        if not self.is_solid:
            return [*self.middle[:2], 1.0]
        return [*(self.middle + float(np.max(self.high - self.low)) * np.array(_FRONT))]

    @property
    def up(self) -> tuple[int, int, int]:
        return (0, 0, 1) if self.is_solid else (0, 1, 0)


class _State:
    """A state while it is written."""

    def __init__(self) -> None:
        self.root = ElementTree.Element("GenericParaViewApplication")
        self._all = ElementTree.SubElement(self.root, "ServerManagerState", version="5.11.0")
        self._named = dict[str, list[dict[str, str]]]()

    def add(self, kind: str, collection: str, name: str, properties: dict[str, _Values]) -> _Proxy:
        """Add an object.

        Args:
            kind: Its group and type.
            collection: In which it is listed.
            name: In the list.
            properties: Values by name, others are ParaView's.
        """
        group, kind = kind.split()
        made = _Proxy(100 + len(self._all))
        text = str(made.number)
        proxy = ElementTree.SubElement(self._all, "Proxy", group=group, type=kind, id=text)
        proxy.set("servers", _SERVERS[group])
        for key, values in properties.items():
            self._set(proxy, key, values)
        self._named.setdefault(collection, []).append({"id": text, "name": name})
        return made

    def lay_out(self, view: _Proxy) -> None:
        """Put a view into a tab of ParaView's window, which shows no other views."""
        self.add("misc ViewLayout", "layouts", "flexpm", {})
        layout = ElementTree.SubElement(self._all[-1], "Layout", number_of_elements="1")
        place = {"direction": "0", "fraction": "0.5", "view": str(view.number)}
        ElementTree.SubElement(layout, "Item", place)

    def _set(self, proxy: ElementTree.Element, key: str, values: _Values) -> None:
        entry = ElementTree.SubElement(proxy, "Property", name=key, id=f"{proxy.get('id')}.{key}")
        entry.set("number_of_elements", str(len(values)))
        for index, value in enumerate(values):
            if isinstance(value, _Proxy):
                ElementTree.SubElement(entry, "Proxy", value=str(value.number), output_port="0")
            else:
                ElementTree.SubElement(entry, "Element", index=str(index), value=str(value))

    def text(self) -> str:
        """The state."""
        for name, items in self._named.items():
            collection = ElementTree.SubElement(self._all, "ProxyCollection", name=name)
            for item in items:
                ElementTree.SubElement(collection, "Item", item)
        ElementTree.indent(self.root)
        return ElementTree.tostring(self.root, encoding="unicode")


def write_state(path: Path, result: Result, frames: Sequence[tuple[Path, int, float]]) -> None:
    """Write the state; no file if no frame can be plotted.

    Args:
        path: The state, next to ``frames.pvd``, which it names by its absolute path.
        result: The run.
        frames: File, step and axial stress [Pa] of each frame, in their order.
    """
    for file, _, _ in sorted(frames, key=lambda frame: -np.nan_to_num(frame[2])):
        snapshot = read_state(file)
        if can_be_drawn(snapshot.positions[:, [0, -1]]):  # across and along the load
            break
    else:
        return
    colours = _colours_of(snapshot, result.test)
    place = _Place(snapshot.reference.min(axis=0), snapshot.reference.max(axis=0))
    state = _State()
    data = path.with_name("frames.pvd").resolve()
    steps = [step for _, step, _ in frames]
    source: dict[str, _Values] = {"FileName": [data], "TimestepValues": steps}
    made = state.add("sources PVDReader", "sources", "frames", source)
    shown = _shown(state, made, colours, place)
    caption = f"{test_text(result)}\n{size_text(result)}"
    shown.append(_caption(state, caption))
    _view(state, made, shown, place, steps)
    write_text(path, state.text())


def _colours_of(snapshot: AnySnapshot, test: str) -> _Colours:
    """Return the colours of grains at the largest stress; rigid 2D grains have no stress."""
    smaller, larger = snapshot.extreme_stresses
    smallest = f"principal_stress_{len(snapshot.positions.T)}"
    moved = np.hypot.reduce(snapshot.positions - snapshot.reference, axis=1)
    if not (np.any(larger) or np.any(smaller)):
        end = float(np.percentile(moved, _END)) or 1.0
        return _Colours("displacement", _POINTS, 0.0, end, "displacement [m]")
    if kind_of(test).pulled:
        end = max(float(np.percentile(larger, _END)), 1.0)
        title = "larger principal stress, tension > 0 [Pa]"
        return _Colours("principal_stress_1", _CELLS, 0.0, end, title)
    end = min(-float(np.percentile(-smaller, _END)), -1.0)
    word = "smallest" if len(snapshot.positions.T) == _SPACE else "smaller"
    title = f"{word} principal stress, tension > 0 [Pa]"
    return _Colours(smallest, _CELLS, end, 0.0, title)


def _shown(state: _State, frames: _Proxy, colours: _Colours, place: _Place) -> list[_Proxy]:
    """Add the grains of the frames and their cracks with their scales; return the visible objects.

    In 3D these are the grains behind a plane through the axis, and the cracks in this plane.
    """
    low, high = colours.low, colours.high
    grains = _threshold(state, frames, "grains", "kind", (GRAIN, GRAIN))
    cracks = _threshold(state, frames, "cracks", "crack_mode", (min(MODES), max(MODES)))
    if place.is_solid:
        grains = _cut(state, "Clip", "section of grains", grains, place)
        cracks = _cut(state, "Cut", "section of cracks", cracks, place)
    stops = np.linspace(0.0, 1.0, _STOPS)
    ramp = colormaps["viridis" if low < 0.0 else "viridis_r"]  # pale where there is no stress
    points = [(low + at * (high - low), *ramp(at)[:3]) for at in stops]
    scale = _lookup(state, colours.array, {"RGBPoints": _joined(points)})
    modes = _lookup(
        state,
        "crack_mode",
        {
            "IndexedLookup": [1],
            "Annotations": _joined((mode, MODE_NAMES[mode]) for mode in MODES),
            "IndexedColors": _joined(colors.to_rgb(COLOURS[mode]) for mode in MODES),
        },
    )
    return [
        _surface(state, grains, (colours.place, colours.array), scale, 1.0),
        _surface(state, cracks, (_CELLS, "crack_mode"), modes, 3.0),
        _scale(state, scale, colours.title, _LOWER_RIGHT),
        _scale(state, modes, "", _LOWER_LEFT),
    ]


def _joined(rows: Iterable[Sequence[object]]) -> list[object]:
    return [value for row in rows for value in row]


def _threshold(
    state: _State, frames: _Proxy, name: str, array: str, between: tuple[int, int]
) -> _Proxy:
    properties: dict[str, _Values] = {
        "Input": [frames],
        "SelectInputScalars": ["", "", "", _CELLS, array],
        "LowerThreshold": [between[0]],
        "UpperThreshold": [between[1]],
    }
    return state.add("filters Threshold", "sources", name, properties)


def _cut(state: _State, kind: str, name: str, cells: _Proxy, place: _Place) -> _Proxy:
    """Return the part behind the plane of the axis and x (``Clip``), or in it (``Cut``)."""
    plane: dict[str, _Values] = {"Origin": place.middle, "Normal": (0, -1, 0)}
    made = state.add("implicit_functions Plane", "pq_helper_proxies", f"plane {kind}", plane)
    return state.add(
        f"filters {kind}", "sources", name, {"Input": [cells], f"{kind}Function": [made]}
    )


def _lookup(state: _State, name: str, properties: dict[str, _Values]) -> _Proxy:
    known = {"ColorSpace": [_RGB], "ScalarRangeInitialized": [1], **properties}
    return state.add("lookup_tables PVLookupTable", "lookup_tables", f"{name}.PVLookupTable", known)


def _surface(
    state: _State, cells: _Proxy, array: tuple[int, str], colours: _Proxy, width: float
) -> _Proxy:
    properties: dict[str, _Values] = {
        "Input": [cells],
        "Representation": ["Surface"],
        "Visibility": [1],
        "ColorArrayName": ["", "", "", *array],
        "LookupTable": [colours],
        "LineWidth": [width],
    }
    kind = "representations UnstructuredGridRepresentation"
    return state.add(kind, "representations", f"of {array[1]}", properties)


def _scale(state: _State, colours: _Proxy, title: str, place: int) -> _Proxy:
    properties: dict[str, _Values] = {
        "LookupTable": [colours],
        "Title": [title],
        "ComponentTitle": [""],
        "TitleColor": _BLACK,
        "LabelColor": _BLACK,
        "WindowLocation": [place],
        "Enabled": [1],
        "Visibility": [1],
    }
    kind = "representations ScalarBarWidgetRepresentation"
    return state.add(kind, "scalar_bars", f"scale {place}", properties)


def _caption(state: _State, text: str) -> _Proxy:
    source = state.add("sources TextSource", "sources", "caption", {"Text": [text]})
    properties: dict[str, _Values] = {
        "Input": [source],
        "Visibility": [1],
        "Color": _BLACK,
        "FontSize": [12],
        "WindowLocation": [_TOP],
    }
    kind = "representations TextSourceRepresentation"
    return state.add(kind, "representations", "of caption", properties)


def _view(
    state: _State,
    frames: _Proxy,
    shown: Sequence[_Proxy],
    place: _Place,
    steps: Sequence[int],
) -> None:
    """Add the window at the last frame, and the time of the frames."""
    view = state.add(
        "views RenderView",
        "views",
        "frames",
        {
            "Representations": shown,
            "ViewTime": [steps[-1]],
            "InteractionMode": [_TURNED if place.is_solid else _FLAT],
            "CameraParallelProjection": [1],
            "CameraParallelScale": [place.half_height],
            "CameraFocalPoint": place.middle,
            "CameraPosition": place.camera,
            "CameraViewUp": place.up,
            "UseColorPaletteForBackground": [0],
            "Background": _WHITE,
            "OrientationAxesVisibility": [0],
        },
    )
    state.lay_out(view)
    times = state.add(
        "misc TimeKeeper",
        "timekeeper",
        "TimeKeeper1",
        {"Time": [steps[-1]], "TimeSources": [frames], "Views": [view]},
    )
    state.add(
        "animation AnimationScene",
        "animation",
        "AnimationScene1",
        {
            "AnimationTime": [steps[-1]],
            "PlayMode": [_SNAP],
            "TimeKeeper": [times],
            "ViewModules": [view],
        },
    )
