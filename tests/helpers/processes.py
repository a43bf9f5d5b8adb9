# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes whose output is read as text."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from typing import Any


def captured(command: Sequence[Any], **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, with the options of `subprocess.run`; what it has printed."""
    return subprocess.run(command, capture_output=True, text=True, **options)
