# SPDX-License-Identifier: GPL-3.0-or-later
"""Reader of the words of Neper's text files, with their positions for messages."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from ...errors import InputError
from ...files import read_bytes, text_of
from ...require import quoted

#: Largest file [byte].
_LARGEST = 64 * 10**6
#: Largest number, far beyond any length in any unit.
_MOST = 1e30


class Words:
    """Words of a file that is made of ***, ** and * sections.

    Args:
        path: The file, at most 64 MB.
        what: Type of the file, for messages.
        content: Text of the file up to its data; None: the whole file is read.

    Attributes:
        path: The file.

    Raises:
        InputError: if it cannot be read.
    """

    def __init__(self, path: Path, what: str, content: bytes | None = None) -> None:
        self.path = path
        self._name = f"{what} = {quoted(str(path))}"
        try:
            text = text_of(read_bytes(path, _LARGEST) if content is None else content)
        except OSError as error:
            raise InputError(
                f"{self._name}, cannot be read ({error.strerror}); give a file of Neper"
            ) from None
        except ValueError as error:
            raise InputError(
                f"{self._name}, is not a text of Neper: {error}; give a file of Neper"
            ) from None
        self._words = _words(text)
        self._line, self._next = 1, ""
        self._go_on()

    def refused(self, why: str) -> InputError:
        """The error of the word that comes next."""
        return InputError(f"{self._name}, line {self._line}: {why}")

    @property
    def section(self) -> str:
        """The mark that comes next, such as ``**cell``; empty for another word."""
        return self._next if self._next.startswith("*") else ""

    @property
    def is_over(self) -> bool:
        """Whether no word is left."""
        return not self._next

    @property
    def is_zero(self) -> bool:
        """Whether a 0 comes next."""
        return self._next == "0"

    def word(self, what: str) -> str:
        """The next word, which is none of a mark."""
        found = self._next
        if not found or found.startswith("*"):
            shown = quoted(found) if found else "end of the file"
            raise self.refused(f"{what} = {shown}, must be a value; complete it")
        self._go_on()
        return found

    def number(self, what: str) -> float:
        """Return the next word as a number whose square is finite."""
        try:
            value = float(self._next)
        except ValueError:
            value = math.nan
        if not abs(value) <= _MOST:
            raise self.refused(
                f"{what} = {quoted(self._next)}, must be a number up to {_MOST:g}; correct it"
            )
        self._go_on()
        return value

    def whole(self, what: str, least: int, most: int) -> int:
        """The next word as a whole number."""
        try:
            value = int(self._next)
        except ValueError:
            value = least - 1
        if not least <= value <= most:
            raise self.refused(
                f"{what} = {quoted(self._next)}, must be a whole number from {least} to {most}; "
                "correct it"
            )
        self._go_on()
        return value

    def expect(self, mark: str) -> None:
        """Pass a mark, which must come next."""
        if self._next != mark:
            raise self.refused(f"section = {quoted(self._next)}, must be {mark}; complete the file")
        self._go_on()

    def skip_to(self, *marks: str) -> str:
        """Pass all words up to one of some marks, and this; returns it."""
        while self._next and self._next not in marks:
            self._go_on()
        found = self._next
        if not found:
            raise self.refused(
                f"section = end of the file, must be {' or '.join(marks)}; complete the file"
            )
        self._go_on()
        return found

    def _go_on(self) -> None:
        line, self._next = next(self._words, (0, ""))
        self._line = line or self._line


def tess_dimension(words: Words) -> int:
    """Dimension of a tessellation, whose beginning is passed.

    Raises:
        InputError: for a raster, an old format, or a file that is not a tessellation.
    """
    if words.section == "***tesr":
        raise words.refused("section = ***tesr, must be ***tess; flexpm specimen image reads it")
    words.expect("***tess")
    words.expect("**format")
    version = words.word("format")
    if not version.split(".")[0].isdigit() or version.startswith(("0.", "1.")):
        raise words.refused(f"format = {version}, must be 2.0 or later; write it by a newer Neper")
    words.expect("**general")
    return words.whole("dimension", 1, 3)


def _words(text: str) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(text.split("\n"), 1):
        for word in line.split():
            yield number, word
