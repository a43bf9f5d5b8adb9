# SPDX-License-Identifier: GPL-3.0-or-later
"""Checkpoints of a run in its folder: saved at intervals, resumed to the same bits.

``checkpoint.json`` names the inputs of the run, its stage, and the file of YADE's scene. It is
replaced after the scene's file is complete, so that a kill at any time leaves a consistent pair. It
has a checksum of both files: a file that a disk or an editor has changed is rejected. The folder is
locked against other processes as long as the checkpoint is in use.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import math
import re
import shutil
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Protocol, TypeGuard

import yade

from .. import _plugin
from .._flexpm import saved_state
from .._version import __version__
from ..errors import InputError
from ..files import FolderLock, Table, json_text, read_json, whole_file, write_text
from ..require import POSITIVE, require_number
from .kept_packing import ENTRY
from .output import RESULT, is_of_flexpm, refuse_other_result
from .run_spec import RunSpec, law_of

#: Wall time between two checkpoints [s].
INTERVAL = 30.0
#: The same over the time that one takes beyond a second, if that is longer: of large specimens
#: they are gigabytes.
PAUSE = 20.0
_NAME = "checkpoint.json"
#: YADE's plain binary archive: compressing it takes longer than writing it.
_SCENE = "checkpoint-{step}.bin"
_SCENE_PATTERN = re.compile(r"checkpoint-[0-9]{1,18}(\.1)?\.bin")
_CHECKSUM = "sha256"
#: Engines of YADE that models have beside those of flexpm; others could run any code.
_ENGINES = ("ForceResetter", "InsertionSortCollider", "InteractionLoop", "NewtonIntegrator")
#: Entries that not all runs have.
_HALVED = ("start", "tried")
_OPTIONAL = (*_HALVED, ENTRY)
_START = {"stage", "step", "sha256"}
#: More stages than any test has; a script's own may have many cycles.
_MOST_STAGES = 10**6
#: More loadings than a run can have, by the bounds of its halvings.
_MOST_TRIED = 20


class Determined(Protocol):
    """All that determines a run."""

    @property
    def results(self) -> int:
        """Number of the results."""

    def to_json(self) -> Table:
        """The inputs as plain values."""


@dataclass
class Position:
    """How far a run has come."""

    stage: int = 0  #: number of the stage that was prepared last, 0 before the first
    stage_start: int = 0  #: step at which it was prepared
    stage_end: int = 0  #: step at which it ends in any case
    stage_likely: int = 0  #: step at which it probably ends
    step_time: float | None = None  #: median wall time of a step so far [s]
    #: scene at the start of the loading, see ``LoadingStart``; empty: none is kept
    start: Table = field(default_factory=dict)
    tried: list[Table] = field(default_factory=list)  #: what faster loadings of the run gave

    def to_json(self) -> Table:
        """All of it but what only runs have whose rate is halved, and these once there is some."""
        content = asdict(self)
        return {key: value for key, value in content.items() if key not in _HALVED or value}


class Checkpoint:
    """State that a run needs to resume, in its folder.

    Attributes:
        position: Progress of the run.
        interval: Wall time between two checkpoints [s].
        resumed_at: Step at which an earlier run was resumed, or None.
        packing: Checksum of the specimen's file in the folder; empty without a file.
        told: Additional content: state of the frames, and the calls of a custom test.
        telling: Function that returns this content when the checkpoint is saved; None: no content.
    """

    def __init__(self, folder: Path, spec: Determined, interval: float = INTERVAL) -> None:
        """Look for a checkpoint in `folder`.

        Args:
            folder: Folder of the run's files; it exists.
            spec: All inputs that determine the run.
            interval: Wall time between two checkpoints [s], > 0.

        Raises:
            InputError: if the folder has a checkpoint of other inputs or a damaged checkpoint.
            BusyError: if another process uses the folder.
        """
        require_number("run: checkpoint_interval", interval, POSITIVE, "s")
        self._folder, self.interval = folder, interval
        self._build, self._inputs = _build(spec), spec.to_json()
        self._saved, self._took = time.monotonic(), 0.0
        self._scene: Path | None = None
        self.position = Position()
        self.resumed_at: int | None = None
        self.packing = ""
        self.told: Table = {}
        self.telling: Callable[[], Table] | None = None
        self._lock = FolderLock(folder)
        if (folder / _NAME).exists():
            self._read(folder / _NAME)

    @property
    def found(self) -> bool:
        """Whether the folder has a scene from which this run can resume."""
        return self._scene is not None

    @property
    def due(self) -> bool:
        """Whether it is time to save."""
        return time.monotonic() - self._saved > max(self.interval, PAUSE * (self._took - 1.0))

    def restore(self) -> None:
        """Replace YADE's scene by the saved scene.

        Raises:
            InputError: if another build has written it, or an engine does not belong to a test.
        """
        assert self._scene is not None
        load_scene(self._scene)
        self.resumed_at = yade.O.iter

    def save(self) -> None:
        """Save YADE's scene, which must not be running.

        Raises:
            OSError: if the disk does not take it; an earlier checkpoint is left as it was.
        """
        if self.telling is not None:
            self.told = json.loads(json.dumps(self.telling()))
        begin = time.monotonic()
        scene = self._folder / _SCENE.format(step=yade.O.iter)
        if scene == self._scene:  # the file that checkpoint.json names must stay as it is
            scene = scene.with_suffix(".1.bin")
        with whole_file(scene) as temporary:
            try:
                yade.O.save(str(temporary), quiet=True)
            except RuntimeError as error:  # of the archive, which does not know the reason
                free = shutil.disk_usage(self._folder).free
                raise OSError(
                    f"checkpoint = {str(scene)!r}, cannot be written ({error}); its disk has "
                    f"{free / 1e6:.1f} MB left, make room and start the same command again"
                ) from None
            about = self._about(scene)
            about[_CHECKSUM] = _checksum(about, temporary)
        write_text(self._folder / _NAME, json_text(about))
        self._scene, self._saved = scene, time.monotonic()
        self._took = self._saved - begin
        self._remove_others(scene)

    def release(self) -> None:
        """Unlock the folder for other processes."""
        self._lock.release()

    def _about(self, scene: Path) -> Table:
        about = {"scene": scene.name, **self.position.to_json(), **self._build}
        if self.packing:
            about[ENTRY] = self.packing
        return about | {"inputs": self._inputs, **({"told": self.told} if self.told else {})}

    def _read(self, file: Path) -> None:
        content = _content(file)
        if _is_scene(content.get("scene")) and not self._scenes():
            return  # someone has removed it: there is nothing to go on from, and nothing to lose
        inputs = content.get("inputs")
        if isinstance(inputs, dict) and "test" in inputs and "flexpm" in content:
            _refuse_differences(
                file.parent, *({"test": one["test"]} for one in (inputs, self._inputs))
            )
        _refuse_other_build(file, content, self._build)
        _require_entries(file, content)
        scene = file.parent / content["scene"]
        given = content.pop(_CHECKSUM)
        try:
            same = given == _checksum(content, scene)
            there = _flat(content["inputs"])
        except (OSError, LookupError, TypeError, ValueError) as error:
            raise _no_checkpoint(file, error) from None
        if not same:
            raise InputError(
                f"run: checkpoint = {scene}, is damaged: {file.name} has another checksum; remove "
                f"{file.name} to start again"
            )
        _refuse_differences(file.parent, there, _flat(self._inputs))
        self._scene = scene
        names = [name for name in asdict(self.position) if name in content]
        self.position = Position(**{name: content[name] for name in names})
        self.told = content.get("told", {})

    def _scenes(self) -> list[Path]:
        return list(self._folder.glob(_SCENE.format(step="*")))

    def _remove_others(self, scene: Path) -> None:
        for other in self._scenes():
            if other != scene:
                with contextlib.suppress(OSError):
                    other.unlink()


def load_scene(scene: Path) -> None:
    """Replace YADE's scene by a saved scene whose checksum has been verified.

    Raises:
        InputError: if another build has written it, or an engine does not belong to a test.
    """
    try:
        yade.O.load(str(scene))
    except (RuntimeError, MemoryError) as error:
        # by its checksum it is what was written, so what wrote it writes otherwise
        yade.O.reset()
        reason = " ".join(str(error).split()) or "reading it takes more memory than there is"
        raise _other_build(scene.parent / _NAME, reason) from error
    known = {*_ENGINES, *_plugin.load()}
    for engine in yade.O.engines:
        if type(engine).__name__ not in known:
            yade.O.reset()
            raise InputError(
                f"run: checkpoint = {scene}, has an engine {type(engine).__name__} that "
                f"no test of flexpm has; remove {_NAME} to start again"
            )


def discard_unusable(folder: Path, spec: RunSpec) -> str:
    """Remove a checkpoint that a run cannot resume: damaged, of other inputs or another build.

    Results of another run are also removed; results of another program stay.

    YADE's scene is empty afterwards if the checkpoint was usable.

    Returns:
        Why it could not be used, or an empty text.

    Raises:
        BusyError: if another process uses the folder.
    """
    why = ""
    try:
        there = Checkpoint(folder, spec)
        if there.found:  # only who reads the scene knows whether it can
            there.restore()
            yade.O.reset()
    except InputError as error:
        (folder / _NAME).unlink(missing_ok=True)
        why = str(error)
    try:
        refuse_other_result(folder, spec)
    except InputError as error:
        if is_of_flexpm(folder / RESULT):
            (folder / RESULT).unlink()
            why = why or str(error)
    return why


def _content(file: Path) -> Table:
    """Return the content of checkpoint.json."""
    try:
        content = read_json(file)
    except (OSError, ValueError, RecursionError) as error:
        raise _no_checkpoint(file, error) from None
    if not isinstance(content, dict):
        raise _no_checkpoint(file, TypeError())
    return content


def _require_entries(file: Path, content: Table) -> None:
    """Check that each entry exists, with the right type and range."""
    rules: dict[str, Callable[[object], bool]] = {
        "scene": _is_scene,
        "stage": lambda stage: _is_count(stage) and stage <= _MOST_STAGES,
        "stage_start": _is_count,
        "stage_end": _is_count,
        "stage_likely": _is_count,
        "step_time": lambda time: time is None
        or (isinstance(time, float) and math.isfinite(time) and time > 0.0),
        "inputs": lambda inputs: isinstance(inputs, dict),
        "start": lambda start: isinstance(start, dict)
        and (not start or (start.keys() == _START and _is_count(start["stage"]))),
        "tried": lambda tried: isinstance(tried, list) and len(tried) <= _MOST_TRIED,
        ENTRY: lambda checksum: isinstance(checksum, str),
        _CHECKSUM: lambda checksum: isinstance(checksum, str),
    }
    for name, holds in rules.items():
        if name not in content and name in _OPTIONAL:
            continue
        if name not in content:
            raise _no_checkpoint(file, KeyError())
        if not holds(content[name]):
            raise InputError(
                f"run: {file} {name} = {str(content[name])[:80]!r}, must be a checkpoint of "
                "flexpm; remove the file to start again"
            )


def _is_scene(name: object) -> bool:
    return isinstance(name, str) and bool(_SCENE_PATTERN.fullmatch(name))


def _is_count(value: object) -> TypeGuard[int]:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**63


def _no_checkpoint(file: Path, error: Exception) -> InputError:
    return InputError(
        f"run: {file} = {type(error).__name__}, must be a checkpoint of flexpm; choose another "
        "folder or remove the file"
    )


def _checksum(about: Mapping[str, object], scene: Path) -> str:
    """Return the checksum of a scene and of its description in checkpoint.json."""
    with scene.open("rb") as file:
        digest = hashlib.file_digest(file, "sha256")
    digest.update(json.dumps(about, sort_keys=True).encode())
    return digest.hexdigest()


def _build(spec: Determined) -> Table:
    """Return the properties of the build on which a scene depends, besides the run's inputs."""
    return {
        "flexpm": __version__,
        "yade": yade.config.version,
        "results": spec.results,
        "state": saved_state,
    }


def _flat(inputs: Table) -> Table:
    """Return inputs by one name each: the field, or ``material`` and the name of the parameter."""
    inputs = dict(inputs)
    specimen, material = inputs.pop("specimen"), inputs.pop("material")
    law = {f"material {key}": value for key, value in law_of(material).items()}
    # what others follow from comes first: the default of the loading follows from the material
    return {**law, **specimen, **inputs}


def _refuse_other_build(file: Path, there: Table, here: Table) -> None:
    if "flexpm" not in there:
        return  # what no build has written
    for name, value in here.items():
        if there.get(name) != value:
            told = f"{name} = {str(there.get(name))[:80]} there, {value} here"
            raise _other_build(file, told)


def _other_build(file: Path, reason: str) -> InputError:
    return InputError(
        f"run: {file} was written by another build of flexpm ({reason}); choose another folder, "
        "resume with that build, or remove the file to start again"
    )


def _refuse_differences(folder: Path, there: Table, here: Table) -> None:
    for name in {**here, **there}:
        if there.get(name) != here.get(name):
            raise InputError(
                f"out = {str(folder)!r}, has a checkpoint of another run ({name} = "
                f"{str(there.get(name))[:80]} there, {here.get(name)} here); choose another folder"
            )
