# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a long computation has come: what it calls to tell its caller."""

from __future__ import annotations

from collections.abc import Callable

#: Takes the amount done, the amount expected and a text that says what is going on.
Progress = Callable[[float, float, str], None]
