# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals that end the command: Ctrl-C, SIGTERM and SIGHUP become exceptions."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import time
from collections.abc import Iterator
from types import FrameType

#: Signals that ask the process to end.
_ENDS = (signal.SIGTERM, signal.SIGHUP)
_SIGNALS = (signal.SIGINT, *_ENDS)
#: Whether the process outlives its terminal: started by nohup.
_KEPT = signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
#: Time that the process has to end when it is asked to [s]; batch systems allow 10 and more.
_GRACE = 8.0

#: Signals that have come; libraries may turn the exception into another one.
received: list[int] = []


class Terminated(BaseException):
    """SIGTERM, or SIGHUP from a closed terminal, has ended the process."""


def catch_signals() -> None:
    """Make Ctrl-C raise KeyboardInterrupt, SIGTERM and SIGHUP Terminated in the main thread.

    A SIGHUP that is ignored at the start stays ignored. Call it again after YADE is loaded, because
    YADE installs its own handlers. Signals that were blocked arrive now.
    """

    def interrupt(number: int, frame: FrameType | None) -> None:
        received.append(number)
        raise KeyboardInterrupt

    def terminate(number: int, frame: FrameType | None) -> None:
        received.append(number)
        raise Terminated

    signal.signal(signal.SIGINT, interrupt)
    for number in _ENDS:
        kept = _KEPT and number == signal.SIGHUP
        signal.signal(number, signal.SIG_IGN if kept else terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)


def block() -> None:
    """Block signals until they are caught."""
    signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)


@contextlib.contextmanager
def waiting() -> Iterator[None]:
    """Block signals until the end of the block, then catch them."""
    block()
    try:
        yield
    finally:
        catch_signals()


def end_in_time() -> None:
    """Start a second process that kills this process if it does not end on request.

    While a library loops or allocates memory, Python code does not run, so no exception is raised.
    Python still writes each signal to a pipe immediately. Signals wait until they are caught.
    """
    block()
    reading, writing = os.pipe()
    watched = os.getpid()
    try:
        child = os.fork()
    except OSError:  # no more processes; nobody watches
        os.close(reading)
        os.close(writing)
        return
    if child == 0:
        # all other files belong to the watched one, whose end others wait for
        os.closerange(0, reading)
        os.closerange(reading + 1, os.sysconf("SC_OPEN_MAX"))
        _watch(reading, watched)
        os._exit(0)
    os.close(reading)
    os.set_blocking(writing, False)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)


def _watch(reading: int, watched: int) -> None:
    """Wait for the end of a process; kill it some time after it was requested to end."""
    latest = None
    while True:
        left = None if latest is None else max(0.0, latest - time.monotonic())
        if not select.select([reading], [], [], left)[0]:
            break
        number = os.read(reading, 1)
        if not number:
            return  # it has ended
        if latest is None and number[0] in _ENDS:
            latest = time.monotonic() + _GRACE
    if os.getppid() == watched:
        os.kill(watched, signal.SIGKILL)
