# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in long texts, converted in parts, and content of files that stays on the disk."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...arrays import AnyArray, NumberType

Bytes = npt.NDArray[np.uint8]
#: Text that is converted at a time [byte].
_CHUNK = 2**22
_BLANK, _NEW_LINE = ord(" "), ord("\n")


class WrongTextError(ValueError):
    """A text that is not the expected list of numbers.

    Attributes:
        position: Position of the first wrong word [byte].
        word: This word; empty at the end of the text.
        is_longer: Whether the text has more numbers than expected.
    """

    def __init__(self, position: int, word: str, is_longer: bool = False) -> None:
        super().__init__(f"{word!r} is not the expected number")
        self.position, self.word, self.is_longer = position, word, is_longer


def mapped(path: Path) -> Bytes:
    """Return the content of a plain file, which stays on the disk until it is used.

    Raises:
        OSError, ValueError: if it is no plain file, or cannot be read.
    """
    if not path.is_file():  # no pipe, which might never end
        raise OSError("is not a file" if path.exists() else "is missing")
    if not path.stat().st_size:
        return np.zeros(0, dtype=np.uint8)
    return np.memmap(path, dtype=np.uint8, mode="r")


def numbers_of(content: Bytes, start: int, end: int, number: int, form: NumberType) -> AnyArray:
    """Return the numbers of a text.

    Args:
        content: The file.
        start: Begin of the text in `content` [byte].
        end: End of the text [byte].
        number: Expected number of numbers.
        form: Their type; the numbers must fit into it.

    Raises:
        WrongTextError: for another number of numbers, or a word that is not a number of this type.
    """
    if 2 * number - 1 > end - start:
        raise WrongTextError(end, _word_at(content, end))
    found = np.empty(number, dtype=form)
    wide: type = np.int64 if form.kind in "iu" else np.float64
    filled = 0
    for at, text in _chunks(content, start, end):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                part: AnyArray = np.fromstring(text, dtype=wide, sep=" ")
            except (ValueError, DeprecationWarning):
                raise _wrong(at, text, form) from None
        if form.kind in "iu":
            limits = np.iinfo(form)
            if part.min() < limits.min or part.max() > limits.max:
                raise _wrong(at, text, form)
        if filled + len(part) > number:
            raise WrongTextError(end, "", is_longer=True)
        found[filled : filled + len(part)] = part
        filled += len(part)
    if filled < number:
        raise WrongTextError(end, _word_at(content, end))
    return found


def end_of_words(content: Bytes, start: int, number: int) -> int:
    """Return the position behind the given number of words, or the end of the content."""
    inside, left = False, number
    for first in range(start, len(content), _CHUNK):
        letters = content[first : first + _CHUNK] > _BLANK
        ends = np.flatnonzero(np.concatenate(([inside], letters[:-1])) & ~letters)
        if len(ends) >= left:
            return first + int(ends[left - 1]) if left else start
        left -= len(ends)
        inside = bool(letters[-1])
    return len(content)


def first_of(content: Bytes, byte: int, start: int = 0) -> int:
    """Return the position of a byte from `start` on, or the end of the content."""
    for first in range(start, len(content), _CHUNK):
        found = np.flatnonzero(content[first : first + _CHUNK] == byte)
        if len(found):
            return first + int(found[0])
    return len(content)


def line_at(content: Bytes, position: int) -> int:
    """Return the number of the line with a position, from 1."""
    return 1 + sum(
        int(np.count_nonzero(content[first : min(first + _CHUNK, position)] == _NEW_LINE))
        for first in range(0, position, _CHUNK)
    )


def _chunks(content: Bytes, start: int, end: int) -> Iterator[tuple[int, bytes]]:
    """Yield position and text of parts that end between words."""
    while start < end:
        stop = min(start + _CHUNK, end)
        if stop < end:
            blanks = np.flatnonzero(content[start:stop] <= _BLANK)
            if not len(blanks):
                raise WrongTextError(start, _word_at(content, start))
            stop = start + int(blanks[-1]) + 1
        text = content[start:stop].tobytes()
        if text.strip():
            yield start, text
        start = stop


def _wrong(at: int, text: bytes, form: NumberType) -> WrongTextError:
    """Return the error of the first word that is not a number of a type."""
    for match in re.finditer(rb"\S+", text):
        if not _is_number(match[0], form):
            return WrongTextError(at + match.start(), match[0][:100].decode(errors="replace"))
    return WrongTextError(at, text[:20].decode(errors="replace"))


def _is_number(word: bytes, form: NumberType) -> bool:
    if form.kind in "iu":
        limits = np.iinfo(form)
        is_whole = re.fullmatch(rb"[+-]?[0-9]{1,19}", word) is not None
        return is_whole and int(limits.min) <= int(word) <= int(limits.max)
    try:
        float(word)
    except ValueError:
        return False
    return b"_" not in word


def _word_at(content: Bytes, position: int) -> str:
    match = re.match(rb"\s*(\S*)", content[position : position + 100].tobytes())
    return match[1].decode(errors="replace") if match else ""
