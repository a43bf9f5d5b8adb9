# SPDX-License-Identifier: GPL-3.0-or-later
"""What each test calls its stress, its strain and its measures, in tables and pictures.

Nothing heavy is loaded here: the command writes tables.
"""

from __future__ import annotations

from ..kinds.registry import kind_of
from ..kinds.words import Drawn, Shown, Words

__all__ = ["Drawn", "Shown", "Words", "words_of_test"]


def words_of_test(test: str) -> Words:
    """Words of a test, by its name."""
    return kind_of(test).words
