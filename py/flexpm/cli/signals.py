# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals that end the command: Ctrl-C and SIGTERM become exceptions."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Iterator
from types import FrameType

_SIGNALS = (signal.SIGINT, signal.SIGTERM)

#: Signals that have come; libraries may turn the exception into another one.
received: list[int] = []


class Terminated(BaseException):
    """The process was asked to end (SIGTERM)."""


def catch_signals() -> None:
    """Let Ctrl-C and SIGTERM raise KeyboardInterrupt and Terminated in the main thread.

    To be called again once YADE is loaded, which installs handlers of its own. Signals that were
    blocked come now.
    """

    def interrupt(number: int, frame: FrameType | None) -> None:
        received.append(number)
        raise KeyboardInterrupt

    def terminate(number: int, frame: FrameType | None) -> None:
        received.append(number)
        raise Terminated

    signal.signal(signal.SIGINT, interrupt)
    signal.signal(signal.SIGTERM, terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)


def block() -> None:
    """Let signals wait until they are caught."""
    signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)


@contextlib.contextmanager
def waiting() -> Iterator[None]:
    """Let signals wait for the end of the block, then catch them."""
    block()
    try:
        yield
    finally:
        catch_signals()
