# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of a long computation, and the functions that report it."""

from __future__ import annotations

from collections.abc import Callable

#: Takes the amount done, the amount expected and a text that says what is going on.
Progress = Callable[[float, float, str], None]
