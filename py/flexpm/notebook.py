# SPDX-License-Identifier: GPL-3.0-or-later
"""What a notebook shows of a thing: HTML, by functions that are registered for its class.

Things stand below what draws them, so they know this function alone.
"""

from __future__ import annotations

from functools import singledispatch


@singledispatch
def html_of(thing: object) -> str | None:
    """HTML of a thing; None where nothing is registered, then a notebook shows its ``repr``."""
    return None


class Shown:
    """What notebooks show by ``html_of``."""

    def _repr_html_(self) -> str | None:
        return html_of(self)
