# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes whose output is read as text."""

from __future__ import annotations

import contextlib
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

#: Time after which nothing is expected any more [s]; it only ends a test that hangs.
HUNG = 600.0


def captured(command: Sequence[Any], **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, with the options of `subprocess.run`; what it has printed."""
    return subprocess.run(command, capture_output=True, text=True, **options)


@contextlib.contextmanager
def running(command: Sequence[Any], **options: Any) -> Iterator[subprocess.Popen[str]]:
    """A process with the options of `subprocess.Popen`, which is killed at the end of the block."""
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, **options)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def wait_for(
    event: Callable[[], object], process: subprocess.Popen[str] | None = None, each: float = 0.01
) -> None:
    """Wait until something is so.

    Args:
        event: Function that returns whether it is so.
        process: It must not end before, as far as it can end by itself.
        each: Time between two calls of `event` [s].
    """
    latest = time.monotonic() + HUNG
    while not event():
        assert process is None or process.poll() is None, process.stderr and process.stderr.read()
        assert time.monotonic() < latest, "hangs"
        time.sleep(each)


def is_free(folder: Path) -> bool:
    """Whether no process uses a folder of a run."""
    from flexpm.errors import BusyError
    from flexpm.files import FolderLock

    try:
        FolderLock(folder)
    except BusyError:
        return False
    return True
