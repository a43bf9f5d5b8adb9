# SPDX-License-Identifier: GPL-3.0-or-later
"""Checkpoints of a run in its folder: saved now and then, resumed to the same bits.

``checkpoint.json`` names the inputs of the run, its stage, and the file of YADE's scene that goes
with it. It is replaced after that file is whole, so a kill at any time leaves a pair that fits.
"""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yade

from .._version import __version__
from ..errors import InputError
from ..files import json_text, whole_file, write_text
from .run_spec import RunSpec

#: Wall time between two checkpoints [s].
INTERVAL = 30.0
_NAME = "checkpoint.json"
#: YADE's plain binary archive: compressing it takes longer than writing it.
_SCENE = "checkpoint-{step}.bin"


class Checkpoint:
    """What a run needs to go on from where it was, kept in memory and in its folder.

    Attributes:
        stage: Number of the stage that was prepared last, 0 before the first.
        stage_start: Step at which it was prepared.
        step_time: Median wall time of a step so far [s], or None.
        resumed_at: Step at which an earlier run was taken up, or None.
    """

    def __init__(self, folder: Path | None, spec: RunSpec, interval: float = INTERVAL) -> None:
        """Look for a checkpoint in `folder`; None keeps none.

        Args:
            folder: Folder of the run's files; it exists.
            spec: All that determines the run.
            interval: Wall time between two checkpoints [s], > 0.

        Raises:
            InputError: if the folder holds a checkpoint of other inputs.
        """
        if not interval > 0.0:
            raise InputError(f"run: checkpoint_interval = {interval} s, must be above 0")
        self._folder, self._interval = folder, interval
        self._made = _versions(spec) | {"inputs": spec.to_json()}
        self._saved = time.monotonic()
        self._scene: Path | None = None
        self.stage, self.stage_start = 0, 0
        self.step_time: float | None = None
        self.resumed_at: int | None = None
        if folder is not None and (folder / _NAME).exists():
            self._read(folder / _NAME)

    @property
    def found(self) -> bool:
        """Whether the folder holds a scene of this run to go on from."""
        return self._scene is not None

    @property
    def due(self) -> bool:
        """Whether it is time to save."""
        return self._folder is not None and time.monotonic() - self._saved > self._interval

    def restore(self) -> None:
        """Replace YADE's scene by the saved one."""
        try:
            yade.O.load(str(self._scene))
        except RuntimeError as error:
            raise InputError(
                f"run: checkpoint = {self._scene}, cannot be read ({error}); "
                f"remove {_NAME} to start again"
            ) from error
        self.resumed_at = yade.O.iter

    def save(self) -> None:
        """Save YADE's scene, which must not be running."""
        if self._folder is None:
            return
        scene = self._folder / _SCENE.format(step=yade.O.iter)
        with whole_file(scene) as temporary:
            yade.O.save(str(temporary), quiet=True)
        self._write(scene)
        self._scene, self._saved = scene, time.monotonic()
        self._remove_others(scene)

    def _write(self, scene: Path) -> None:
        content = {
            "scene": scene.name,
            "stage": self.stage,
            "stage_start": self.stage_start,
            "step_time": self.step_time,
            **self._made,
        }
        write_text(self._folder / _NAME, json_text(content))

    def _read(self, file: Path) -> None:
        try:
            content = json.loads(file.read_text(encoding="utf-8"))
            there = _flat({name: content[name] for name in self._made})
            scene = file.parent / content["scene"]
            stage, start, step_time = (
                content[key] for key in ("stage", "stage_start", "step_time")
            )
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise InputError(
                f"run: {file} = {type(error).__name__}, must be a checkpoint of flexpm; "
                "choose another folder"
            ) from None
        if not scene.exists():
            return  # someone has removed it: there is nothing to go on from, and nothing to lose
        _refuse_differences(file.parent, there, _flat(self._made))
        self._scene = scene
        self.stage, self.stage_start, self.step_time = stage, start, step_time

    def _remove_others(self, scene: Path) -> None:
        # also parts of files that a killed run has left
        for pattern in (_SCENE.format(step="*"), "." + _SCENE.format(step="*")):
            for other in self._folder.glob(pattern):
                if other != scene:
                    with contextlib.suppress(OSError):
                        other.unlink()


def _versions(spec: RunSpec) -> dict[str, Any]:
    """What a scene depends on beside the inputs of its run."""
    return {"flexpm": __version__, "yade": yade.config.version, "results": spec.results}


def _flat(made: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs by one name each: that of the field, or ``material`` and the name of the parameter."""
    plain = {name: value for name, value in made.items() if name != "inputs"}
    inputs = dict(made["inputs"])
    specimen, material = inputs.pop("specimen"), inputs.pop("material")
    # a name changes no result
    law = {f"material {key}": value for key, value in material.items() if key != "name"}
    return {**plain, **inputs, **specimen, **law}


def _refuse_differences(folder: Path, there: dict[str, Any], here: dict[str, Any]) -> None:
    for name in {**here, **there}:
        if there.get(name) != here.get(name):
            raise InputError(
                f"out = {str(folder)!r}, holds a checkpoint of another run "
                f"({name} = {there.get(name)} there, {here.get(name)} here); choose another folder"
            )
