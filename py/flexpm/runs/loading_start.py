# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene at the start of a loading, to which slower loadings of the same run go back.

It is kept in the folder of the run, or in memory of a run that has none. The checkpoint holds its
checksum: a file that was changed or has gone is not used, and the run begins anew, to the same
bits.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

import yade

from ..files import whole_file
from ..threads import for_scenes
from .checkpoint import Position, load_scene

#: Name of YADE's scene in memory, and of the file.
_MARK = "flexpm-start"
_NAME = "checkpoint.start.bin"


class LoadingStart:
    """Where slower loadings of a run begin."""

    def __init__(self, folder: Path | None) -> None:
        """Keep it in `folder`, or in memory if that is None."""
        self._file = None if folder is None else folder / _NAME
        self._in_memory = False

    def keep(self, position: Position) -> None:
        """Save YADE's scene, which must not be running, and note it in the position of the run.

        Raises:
            OSError: if the disk does not take it.
        """
        checksum = ""
        if self._file is None:
            yade.O.saveTmp(_MARK, quiet=True)
            self._in_memory = True
        else:
            with whole_file(self._file) as temporary:
                yade.O.save(str(temporary), quiet=True)
                checksum = _checksum(temporary)
        position.start = {"stage": position.stage, "step": yade.O.iter, "sha256": checksum}

    def after(self, position: Position) -> Position:
        """Position of a run that goes on from here, or from its very beginning."""
        if not self._is_usable(position):
            return Position(tried=position.tried)
        return replace(
            Position(),
            stage=position.start["stage"],
            stage_start=position.start["step"],
            stage_end=position.start["step"],
            stage_likely=position.start["step"],
            start=position.start,
            tried=position.tried,
        )

    def restore(self) -> None:
        """Replace YADE's scene by the saved scene."""
        if self._file is None:
            with for_scenes():
                yade.O.loadTmp(_MARK, quiet=True)
        else:
            load_scene(self._file)

    def forget(self) -> None:
        """Remove the file: the run is complete."""
        if self._file is not None:
            self._file.unlink(missing_ok=True)

    def _is_usable(self, position: Position) -> bool:
        if not position.start:
            return False
        if self._file is None:
            return self._in_memory
        try:
            return bool(_checksum(self._file) == position.start["sha256"])
        except OSError:
            return False


def _checksum(scene: Path) -> str:
    with scene.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
