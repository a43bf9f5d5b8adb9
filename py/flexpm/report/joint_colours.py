# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of joints by their index, the same in all pictures, and their legend."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.lines import Line2D

from ..text import label_of
from .style import CYCLE

#: Colours of joints, none of which is the colour of a crack; after the last the first again.
JOINTS = (*CYCLE[2:], "#7b5cb8", "#9a8c1f")
#: Most joints that a legend names.
MOST_NAMES = 8


def joint_colour(number: int) -> str:
    """Return the colour of a joint."""
    return JOINTS[number % len(JOINTS)]


def joint_handles(names: Mapping[int, str]) -> list[Line2D]:
    """Return the handles of a legend, of many joints those of the first.

    Args:
        names: Name of each joint in the picture, by its index.
    """
    handles = [
        Line2D([], [], color=joint_colour(number), lw=2.2, label=label_of(f"joint {name}"))
        for number, name in [*names.items()][:MOST_NAMES]
    ]
    if (others := len(names) - MOST_NAMES) > 0:
        handles.append(Line2D([], [], lw=0.0, label=f"and {others} more joints"))
    return handles
