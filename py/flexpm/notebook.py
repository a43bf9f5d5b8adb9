# SPDX-License-Identifier: GPL-3.0-or-later
"""HTML representations of objects in a notebook, by functions that are registered for a class.

The objects belong to lower layers than the functions, so they only use this module.
"""

from __future__ import annotations

from functools import singledispatch


@singledispatch
def html_of(thing: object) -> str | None:
    """HTML of a thing; None where nothing is registered, then a notebook shows its ``repr``."""
    return None


class Shown:
    """Base of objects that notebooks show by ``html_of``."""

    def _repr_html_(self) -> str | None:
        return html_of(self)
