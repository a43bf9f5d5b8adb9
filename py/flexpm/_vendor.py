# SPDX-License-Identifier: GPL-3.0-or-later
"""Packages of others, in flexpm's own folder ``vendor``: those that no release of Debian has."""

import sys
from pathlib import Path


def on_path() -> None:
    """Let them be imported, after all that the system has."""
    folder = str(Path(__file__).parent / "vendor")
    if folder not in sys.path:
        sys.path.append(folder)
