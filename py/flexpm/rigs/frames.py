# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a run: its state at even strains and around the peak, as files for ParaView. SI units.

The largest strain of a test is unknown in advance. Frames begin close together, and every second
frame is removed when their number is twice the requested number.
"""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import yade

from ..errors import InputError
from ..files import Table, csv_text, load_csv, write_text
from ..require import quoted
from ..results.result import Result
from ..results.solids.state import AnySnapshot
from ..results.vtu import write_vtu
from .rig import TestRig

#: Files of a run with frames, and the folder of the frames.
TABLE, COLLECTION, STATE, FOLDER = "frames.csv", "frames.pvd", "frames.pvsm", "frames"
#: A state is kept as that of the peak until the stress exceeds its own by this factor [-].
_GROWTH = 1.01
#: Parts of the peak at which the falling stress gives a frame [-].
_FALLS = (0.95, 0.8)
#: Kinds of frames.
_EVEN, _PEAK = "even", "peak"
#: Name of the frames' memory in a checkpoint.
FRAMES = "frames"
#: Names of frames, below the folder of the run.
_FILE = re.compile(rf"{FOLDER}/frame-[0-9]+\.vtu")


class Frame(NamedTuple):
    """One state of a run that has been written."""

    step: int
    axial_strain: float  #: [-]
    axial_stress: float  #: [Pa]
    kind: str  #: ``even``, or ``peak`` for those around it
    file: str  #: below the folder of the run


class LastState(NamedTuple):
    """Last state of a test, for a frame that is written after the scene may have changed."""

    step: int
    axial_strain: float  #: [-]
    axial_stress: float  #: [Pa]
    snapshot: AnySnapshot | None  #: None: the test has diverged

    @classmethod
    def of(cls, rig: TestRig, snapshot: AnySnapshot | None = None) -> LastState:
        """Return the last state of a rig whose scene exists.

        Args:
            rig: The rig.
            snapshot: Its present state, if that is known.
        """
        state = None if rig.diverged else snapshot or rig.built.snapshot()
        return cls(yade.O.iter, rig.strain, rig.stress, state)


class FrameWriter:
    """Watches a rig and writes frames of it."""

    def __init__(
        self,
        folder: Path,
        wanted: int,
        about: Mapping[str, object],
        resumed_at: int | None,
        memory: Table | None = None,
    ) -> None:
        """Continue the frames of an earlier start, or remove frames of another run.

        Args:
            folder: Folder of the run.
            wanted: Number of frames at even strains up to the reference strain, > 0; twice this
                number is kept at most, fewer if the test ends before or has fewer rows.
            about: Description of the run in each file.
            resumed_at: Step from which an earlier start resumes; None: no earlier start.
            memory: Value that `remember` returned at that step; None: unknown.
        """
        self._folder, self._wanted, self._about = folder, wanted, about
        memory = memory or {}
        self.frames = _read(folder, resumed_at, memory)
        self._spacing: float = memory.get("spacing", 0.0)
        self._next: float = memory.get("next", -math.inf)
        self._confinement: float = memory.get("confinement", 0.0)
        #: frame below the peak, which is listed once the stress falls; its state, if not written
        self._peak: Frame | None = None
        self._peak_state: AnySnapshot | None = None
        if peak := memory.get("peak"):
            self._peak = _known([peak])[0]
        self._growing: float = memory.get("growing", 0.0)
        self._falls: list[float] = [*memory.get("falls", ())]
        (folder / FOLDER).mkdir(exist_ok=True)
        kept = {one.file for one in self.frames}
        if self._peak is not None:
            kept.add(self._peak.file)
        for file in (folder / FOLDER).glob("frame-*.vtu"):
            if f"{FOLDER}/{file.name}" not in kept:
                file.unlink()

    def remember(self) -> Table:
        """Write the state of the peak, and return the data from which a later start continues."""
        if not self._spacing:
            return {}
        self._write_peak_state()
        return {
            "frames": self.frames,
            "peak": self._peak,
            "spacing": self._spacing,
            "next": self._next,
            "confinement": self._confinement,
            "growing": self._growing,
            "falls": self._falls,
        }

    def __call__(self, rig: TestRig) -> None:
        """Record a frame of a rig after a step, if it is due."""
        strain, stress = rig.strain, rig.stress
        if strain >= self._next:
            self._take_even(rig, strain, stress)
        above = stress - self._confinement
        if above >= self._growing > 0.0:
            self._forget_peak()
            self._peak = self._frame(strain, stress, _PEAK)
            self._peak_state = rig.built.snapshot()
            self._growing, self._falls = _GROWTH * above, list(_FALLS)
        elif self._falls and above <= self._falls[0] * self._growing / _GROWTH:
            self._falls.pop(0)
            self._write_peak()
            self._write(self._frame(strain, stress, _PEAK), rig.built.snapshot())

    def finish(self, last: LastState) -> None:
        """Write the state of the peak, if it exists, and the last state, unless it diverged."""
        self._write_peak()
        if last.snapshot is not None:
            frame = self._frame(last.axial_strain, last.axial_stress, _EVEN, last.step)
            self._write(frame, last.snapshot)

    def _take_even(self, rig: TestRig, strain: float, stress: float) -> None:
        if not self._spacing:
            self._begin(rig, strain)
        self._write(self._frame(strain, stress, _EVEN), rig.built.snapshot())
        self._thin()
        self._next = strain + self._spacing

    def _begin(self, rig: TestRig, strain: float) -> None:
        """Choose the spacing at first."""
        self._next = strain  # a number from here on: it is saved if the first frame is interrupted
        self._spacing = rig.reference_strain / self._wanted
        self._confinement = rig.confinement or 0.0
        self._growing = 1e-3

    def _thin(self) -> None:
        even = [one for one in self.frames if one.kind == _EVEN]
        if len(even) <= 2 * self._wanted:
            return
        self._spacing *= 2.0
        for one in even[1::2]:
            self.frames.remove(one)
            with contextlib.suppress(OSError):
                (self._folder / one.file).unlink()
        self._list()

    def _frame(self, strain: float, stress: float, kind: str, step: int | None = None) -> Frame:
        step = yade.O.iter if step is None else step
        return Frame(step, strain, stress, kind, f"{FOLDER}/frame-{step:010d}.vtu")

    def _write_peak(self) -> None:
        if self._peak is None:
            return
        self._write_peak_state()
        self._add(self._peak)
        self._peak = None

    def _write_peak_state(self) -> None:
        if self._peak is None or self._peak_state is None:
            return
        if all(one.step != self._peak.step for one in self.frames):
            self._write_state(self._peak, self._peak_state)
            self._peak_state = None

    def _forget_peak(self) -> None:
        """Remove the state of an earlier, smaller peak."""
        peak = self._peak if self._peak_state is None else None  # else it was not written
        if peak is not None and all(one.step != peak.step for one in self.frames):
            (self._folder / peak.file).unlink(missing_ok=True)
        self._peak = self._peak_state = None

    def _write(self, frame: Frame, snapshot: AnySnapshot) -> None:
        if all(one.step != frame.step for one in self.frames):
            self._write_state(frame, snapshot)
            self._add(frame)

    def _write_state(self, frame: Frame, snapshot: AnySnapshot) -> None:
        about = {name: value for name, value in frame._asdict().items() if name != "file"}
        write_vtu(self._folder / frame.file, snapshot, {**self._about, **about})

    def _add(self, frame: Frame) -> None:
        if all(one.step != frame.step for one in self.frames):
            self.frames = sorted([*self.frames, frame])
            self._list()

    def _list(self) -> None:
        """Write the list of the frames, as a table and for ParaView."""
        # a later start knows frames that were removed after its checkpoint, until it removes them
        there = [one for one in self.frames if (self._folder / one.file).is_file()]
        write_text(self._folder / TABLE, csv_text(Frame._fields, there))
        root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
        collection = ElementTree.SubElement(root, "Collection")
        for one in there:
            ElementTree.SubElement(
                collection, "DataSet", timestep=str(one.step), part="0", file=one.file
            )
        ElementTree.indent(root)
        write_text(self._folder / COLLECTION, ElementTree.tostring(root, encoding="unicode"))


def read(folder: Path) -> list[Frame]:
    """Frames of a run in the order of its steps.

    Raises:
        InputError: if it has none, or their list cannot be read.
    """
    names, rows = load_csv(folder / TABLE, "frames")
    try:
        if tuple(names) != Frame._fields:
            raise ValueError(f"columns {', '.join(names)}")
        found = [
            Frame(int(step), float(strain), float(stress), kind, file)
            for step, strain, stress, kind, file in rows
        ]
        return _known(found)
    except ValueError as error:
        raise InputError(
            f"frames = {str(folder / TABLE)!r}, is not a list of frames: {error}; give the folder "
            "of a run with frames"
        ) from None


def _known(rows: Sequence[Sequence[object]]) -> list[Frame]:
    """Frames of rows, whose files are surely frames: a run removes files by these names."""
    found = [Frame(*row) for row in rows]  # type: ignore[arg-type]
    for one in found:
        if not _FILE.fullmatch(one.file):
            raise ValueError(f"file {quoted(one.file)} is no frame")
    return found


def show_frames(folder: Path, frames: Sequence[Frame], result: Result, film: str | None) -> None:
    """Write a ParaView state for the frames of a test, and a film if requested."""
    from ..report import film as films
    from ..report import paraview  # both take long to load

    files = [folder / one.file for one in frames]
    steps, stresses = [one.step for one in frames], [one.axial_stress for one in frames]
    paraview.write_state(folder / STATE, result, [*zip(files, steps, stresses, strict=True)])
    if film:
        strains = [one.axial_strain for one in frames]
        shown = [*zip(files, strains, stresses, strict=True)]
        films.write_film(folder / f"film.{film}", result, shown)


def _read(folder: Path, resumed_at: int | None, memory: Table) -> list[Frame]:
    """Return the frames of an earlier start, up to the step where it resumes."""
    if resumed_at is not None and "frames" in memory:
        return _known(memory["frames"])
    if resumed_at is None or not (folder / TABLE).is_file():
        return []
    return [one for one in read(folder) if one.step <= resumed_at and (folder / one.file).is_file()]
