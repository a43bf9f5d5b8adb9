# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run writes beside its results; no result depends on it."""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import InputError
from ..require import Bounds, require_one_of, require_whole

#: Kinds of films: a picture that moves, and a film that needs ffmpeg.
FILMS = ("gif", "mp4")
#: Frames of a film if no number is given; more than the most are a mistake.
FILM_FRAMES, MOST_FRAMES = 40, 1000


@dataclass(frozen=True)
class Output:
    """What can be left out or asked for.

    Attributes:
        report: Write report.html.
        frames: Write the state at even strains, this many up to the strain of the reference
            strength, and around the peak; fewer if the test ends before or has fewer rows. 0: none.
        film: ``gif`` or ``mp4``, made of the frames; None for none.
    """

    report: bool = True
    frames: int = 0
    film: str | None = None

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
