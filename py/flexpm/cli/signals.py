# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals that end the command: Ctrl-C and SIGTERM become exceptions."""

from __future__ import annotations

import signal
from types import FrameType


class Terminated(BaseException):
    """The process was asked to end (SIGTERM)."""


def catch_signals() -> None:
    """Let Ctrl-C and SIGTERM raise KeyboardInterrupt and Terminated in the main thread.

    To be called again once YADE is loaded, which installs handlers of its own.
    """

    def terminate(number: int, frame: FrameType | None) -> None:
        raise Terminated

    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, terminate)
