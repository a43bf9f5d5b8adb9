# SPDX-License-Identifier: GPL-3.0-or-later
"""Output of the command: results on stdout, progress and one-line errors on stderr."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import sys
import threading
import time
from types import TracebackType
from typing import TYPE_CHECKING, NoReturn

from ..text import printable

if TYPE_CHECKING:
    from tqdm import tqdm


def prepare() -> None:
    """Open streams that are closed to nowhere, and let them show any character somehow."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    if sys.stdout is None:
        sys.stdout = open(1, "w", closefd=False)  # noqa: SIM115
    if sys.stderr is None:
        sys.stderr = open(2, "w", closefd=False)  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def say(text: str) -> None:
    """Write lines to stdout; that nobody reads them is no error.

    Raises:
        OSError: if stdout is a file that cannot be written.
    """
    try:
        print(printable(text, kept="\n"), flush=True)
    except OSError as error:
        drop_output()
        if error.errno != errno.EPIPE:
            raise OSError(error.errno, error.strerror, "standard output") from None


def drop_output() -> None:
    """Discard all remaining output to stdout, also at the end of Python."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def error_line(text: str) -> None:
    """Write `text` as one line to stderr."""
    with contextlib.suppress(OSError):
        print("flexpm:", printable(" ".join(str(text).split())), file=sys.stderr, flush=True)


def duration(seconds: float) -> str:
    """A time with two digits, in the unit in which it is read."""
    for length, unit in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * length:
            return f"{float(f'{seconds / length:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


#: Wall time between two lines of progress where stderr is no terminal [s].
LINES_EVERY = 30.0


class Progress:
    """Progress on stderr: a bar on a terminal, else a line each half minute.

    A bar has the rate and the remaining time. Lines are written by a thread, because reports of
    progress may be rare: a study reports only at the end of a run.
    """

    _FORMAT = (
        "{desc} {percentage:3.0f} % |{bar}| {n:.0f}/{total:.0f} "
        "[{rate_noinv_fmt}, {remaining} left]"
    )

    def __init__(self, quiet: bool = False, unit: str = "steps") -> None:
        self._bar: tqdm[NoReturn] | None = None
        self._unit = f" {unit}"
        self._shown = sys.stderr.isatty() and not quiet
        self._lined = not (self._shown or quiet)
        self._last: tuple[float, float, str] | None = None
        self._begin, self._over = time.monotonic(), threading.Event()
        self._writer = threading.Thread(target=self._lines, daemon=True)

    def __call__(self, done: float, expected: float, text: str = "") -> None:
        """Show that `done` of about `expected` are done; `text` is the present activity.

        A smaller `done` than before starts a new activity.
        """
        self._last = (done, expected, text)
        if not self._shown:
            return
        bar = self._bar
        if bar is None or done < bar.n:
            bar = self._restarted(text, expected)
        bar.desc = text
        bar.total = max(done, expected)
        bar.update(done - bar.n)

    def foresee(self, steps: int, seconds: float) -> None:
        """Say how many steps a run will probably have and how much time is left [s]."""
        rounded = float(f"{steps:.2g}")
        self.tell(f"about {rounded:.0f} steps in all, {duration(seconds)} left at the present pace")

    def tell(self, line: str) -> None:
        """Say a line without the bar, which comes back below it."""
        self.close()
        say(line)

    def _restarted(self, text: str, expected: float) -> tqdm[NoReturn]:
        from tqdm import tqdm

        self.close()
        bar = self._bar = tqdm(
            desc=text,
            total=max(expected, 1),
            unit=self._unit,
            leave=False,
            bar_format=self._FORMAT,
            mininterval=0.2,
        )
        return bar

    def close(self) -> None:
        """Remove the bar from the terminal at the end of its activity."""
        self._last = None
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def _lines(self) -> None:
        """Write lines until the end."""
        while not self._over.wait(LINES_EVERY):
            with contextlib.suppress(OSError, ValueError):  # a closed stream
                print(printable(self._line()), file=sys.stderr, flush=True)

    def _line(self) -> str:
        """The time since the start, the amount that is done, and of about how much, in a line."""
        since = duration(time.monotonic() - self._begin)
        last = self._last  # of which the other thread may make None meanwhile
        if last is None:
            return f"progress after {since}: working"
        done, expected, text = last
        share = f", {100.0 * done / expected:.0f} %" if 0.0 <= done <= expected > 0.0 else ""
        amount = f"{done:.0f} of about {max(done, expected):.0f}{self._unit}{share}"
        return f"progress after {since}: {text}, {amount}"

    def __enter__(self) -> Progress:
        if self._lined:
            self._writer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over.set()
        if self._lined:
            # a line that is due now comes before the end, unless nobody reads it
            self._writer.join(timeout=1.0)
        self.close()
