# SPDX-License-Identifier: GPL-3.0-or-later
"""Work of a call in numbers that no other load of the machine changes."""

from __future__ import annotations

import sys
from collections.abc import Callable


def calls_of(action: Callable[[], object]) -> int:
    """Number of calls of Python and C functions within `action`, in this thread."""
    count = 0

    def counted(_frame: object, event: str, _what: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(counted)
    try:
        action()
    finally:
        sys.setprofile(before)
    return count


def growth_of(action: Callable[[int], object], few: int, many: int) -> float:
    """Calls within `action(many)` over those within `action(few)` [-]."""
    return calls_of(lambda: action(many)) / calls_of(lambda: action(few))
