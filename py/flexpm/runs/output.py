# SPDX-License-Identifier: GPL-3.0-or-later
"""Additional files of a run, and folders with other results; no result depends on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from ..files import read_json
from ..require import Bounds, require_one_of, require_whole
from ..results.result_checks import FINISHED, SO_FAR
from .groups import FILM_FRAMES, FILMS, MOST_FRAMES, OutputOptions
from .run_spec import RunSpec

#: Name of the picture of a fracture network.
ROSE = "network.png"
#: Name of the file with the numbers of a run.
RESULT = FINISHED
#: Files by which a folder is known, and what has left them.
KINDS = {
    RESULT: "run",
    SO_FAR: "run",
    "scorecard.json": "scorecard",
    "compare.csv": "compare",
    "means.csv": "packings",
    "table.csv": "study",
    "history.csv": "calibrate",
}
_SAID = {"packings": "several packings"}
#: A file of a run that has begun.
BEGUN = "checkpoint.json"


def kind_of(folder: Path) -> str | None:
    """Return the type of the results in a folder; None without results."""
    return next((kind for name, kind in KINDS.items() if (folder / name).is_file()), None)


def refuse_other_kind(folder: Path, kind: str) -> None:
    """Refuse a folder with results of another kind, whose pages and tables would be replaced.

    Raises:
        InputError: if it holds some.
    """
    found = kind_of(folder) or ("run" if (folder / BEGUN).is_file() else None)
    if found is not None and found != kind:
        raise InputError(
            f"out = {str(folder)!r}, has results of {_SAID.get(found, found)}, must be free for "
            f"results of {_SAID.get(kind, kind)}; choose another folder"
        )


def is_of_flexpm(result: Path) -> bool:
    """Return whether a result.json was written by flexpm, also if it is damaged."""
    try:
        content = read_json(result)
    except (OSError, ValueError, RecursionError):
        return True
    return isinstance(content, Mapping) and {"flexpm", "inputs"} <= content.keys()


def refuse_other_result(folder: Path, spec: RunSpec) -> None:
    """Reject a folder with the result.json of another run, or of another program.

    Raises:
        InputError: if the folder has such a file.
    """
    file = folder / RESULT
    if not file.exists():
        return
    try:
        same = RunSpec.from_json(read_json(file)["inputs"]).key() == spec.key()
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        same = False
    if not same:
        whose = "another run" if is_of_flexpm(file) else "another program"
        raise InputError(
            f"out = {str(folder)!r}, has a {RESULT} of {whose}, which would be replaced; choose "
            "another folder"
        )


@dataclass(frozen=True)
class Output(OutputOptions):
    """Files that a run writes in addition to its results, checked and complete."""

    def __post_init__(self) -> None:
        frames = require_whole("run: frames", self.frames, Bounds(at_least=0, at_most=MOST_FRAMES))
        if self.film is None:
            return
        require_one_of("run: film", self.film, FILMS)
        object.__setattr__(self, "frames", frames or FILM_FRAMES)
        if self.film == "mp4":
            from ..report.film import has_ffmpeg  # takes long to load

            if not has_ffmpeg():
                raise InputError("run: film = mp4, needs ffmpeg; install it or choose gif")
