# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that users give, fit for a terminal and for a picture."""

from __future__ import annotations

import unicodedata

#: Characters of a name that are shown.
LONGEST = 100
#: Kinds of characters that move the cursor, change colours or the direction of writing.
_CONTROL = ("Cc", "Cf", "Cs", "Zl", "Zp")


def printable(text: object, kept: str = "") -> str:
    """`text` without characters that a terminal obeys; those in `kept` stay."""
    return "".join(
        "?" if unicodedata.category(one) in _CONTROL and one not in kept else one
        for one in str(text)
    )


def name_of(text: object) -> str:
    """A name as one line of at most `LONGEST` characters."""
    line = printable(" ".join(str(text).split()))
    return line if len(line) <= LONGEST else line[: LONGEST - 3] + "..."


def words_of(quantity: str) -> str:
    """Name of a quantity as it is read: without underscores, people's names as they are."""
    words = quantity.replace("_", " ")
    return words.replace("youngs ", "Young's ").replace("poissons ", "Poisson's ")


def label_of(text: object) -> str:
    """A name as matplotlib shows it unchanged: a dollar sign begins no formula."""
    return name_of(text).replace("$", r"\$")
