# SPDX-License-Identifier: GPL-3.0-or-later
"""Files after a few changes at random, for Hypothesis."""

from __future__ import annotations

from hypothesis import strategies as st

WORDS = st.sampled_from(
    [
        *("0", "-1", "1e300", "-1e300", "nan", "inf", "1e-300", "99999999999999999999", "0.5", "2"),
        *(
            "",
            "a",
            "a b",
            "**vertex",
            "*seed",
            "*file",
            "binary16",
            "***end",
            "#",
            "\x00",
            "\u00e9",
        ),
        *(
            "[]",
            "{}",
            '"',
            "null",
            "true",
            "=",
            ",",
            "\t",
            "excavation:a",
            "\ufeff",
            "\r",
            "[set.a]",
        ),
    ]
)


@st.composite
def broken_text(draw, text):
    """A text after a few changes: words, lines, ends, or bytes that are no text."""
    lines = text.split("\n")
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(len(lines) - 1, 0)))
        how = draw(st.sampled_from(["word", "word", "word", "drop", "twice", "swap", "cut"]))
        if how == "word" and lines[at].split():
            mark = "," if "," in lines[at] and draw(st.booleans()) else " "
            words = lines[at].split(mark)
            words[draw(st.integers(0, len(words) - 1))] = draw(WORDS)
            lines[at] = mark.join(words)
        elif how == "drop" and len(lines) > 1:
            del lines[at]
        elif how == "twice":
            lines.insert(at, lines[at])
        elif how == "swap":
            other = draw(st.integers(0, len(lines) - 1))
            lines[at], lines[other] = lines[other], lines[at]
        elif how == "cut":
            lines = lines[: at + 1]
    content = draw(st.sampled_from(["\n", "\n", "\n", "\r\n"])).join(lines).encode()
    return draw(broken_bytes(content)) if draw(st.integers(0, 9)) == 0 else content


@st.composite
def broken_bytes(draw, content):
    """Bytes after a few changes."""
    text = bytearray(content)
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(len(text) - 1, 0)))
        how = draw(st.sampled_from(["byte", "byte", "head", "cut", "more"]))
        if how == "cut" and at:
            del text[at:]
        elif how == "more":
            text[at:at] = draw(st.binary(min_size=1, max_size=8))
        elif text:
            at = at % 40 if how == "head" else at
            text[min(at, len(text) - 1)] = draw(st.integers(0, 255))
    return bytes(text)
