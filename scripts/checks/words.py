#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""List old words in texts that users read, with the words of the field in their place.

Usage: scripts/checks/words.py [ROOT]. Prints one line per word found, then how often each occurs;
the exit code is always 0.

The texts are errors, warnings, help and words of reports and figures of the package, and errors and
class texts of the C++ sources. A text is a string literal of two words or more that is neither a
docstring nor in a comment. A word may be right where it is found: a reader decides.
"""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

#: Old word, the field's word, and the pattern where it is more than the old word.
WORDS: tuple[tuple[str, str, str], ...] = (
    ("way", "displacement, path", r"(?<!same )(?<!this )(?<!in a )(?<!other )ways?\b(?! to)"),
    ("turn", "rotate, rotation", r"turn(?:s|ed|ing)?\b(?! (?:on|off)|[:(])"),
    (
        "place",
        "position",
        r"(?<!in )places?\b(?! (?:an?|it|them|the|another|rigid|smooth|plates?|platens?|jaws?)\b)",
    ),
    ("of the plane, in space", "2D, 3D", r"(?:(?:of|in) the plane|(?:in|of) space)\b"),
    ("a solid", "3D, 3D specimen", r"(?:(?:an?|of|in) solid|solids)\b(?!-)"),
    ("confinement", "confining pressure", r"confinements?\b(?! =)"),
    ("mantle", "lateral surface", r"mantles?\b"),
    ("waist", "central third", r"waists?\b"),
    ("crossing", "wave transit", r"crossings?\b"),
    ("crosshead", "crosshead displacement", r"crosshead\b(?! displ)"),
    ("bears", "carries, resists", r"(?:bears?|bore|borne)\b"),
    ("told, tells", "reports, prints", r"(?:told|tells?)\b"),
    ("asks for", "requests, requires", r"(?:asks?|asked)\b"),
    ("drawn", "sampled, plotted", r"(?:draw|draws|drawn)\b"),
    ("refused", "rejected", r"refus(?:e|es|ed|al)\b"),
    ("goes on", "continues, resumes", r"(?:go|goes|gone|going) on\b"),
    ("taken up", "resumed, loaded", r"(?:take|taken|took) up\b"),
    ("anew", "again", r"anew\b"),
    ("lays, laid", "places, adds", r"(?:lay|lays|laid)\b"),
    ("holds", "fixes; has", r"(?:hold\b(?![:(])|holds\b|held\b(?! nodes))"),
    ("loose", "detached", r"loose\b"),
    ("parting", "separation", r"parting\b"),
    ("one's own", "custom, user-supplied", r"(?:of (?:its|one's|their) own|own (?:test|cells))\b"),
    ("lacks", "has no", r"lacks?\b"),
    ("so far, as far as", "until now; where", r"(?:so far|as far as)\b"),
    ("at once", "immediately, simultaneously", r"at once\b"),
    ("beside", "in addition to, next to", r"beside\b"),
    ("but for", "except", r"but for\b"),
    ("alike, likewise", "equal, also", r"(?:alike|likewise)\b"),
    ("is there, is gone", "exists, is missing", r"(?:is|are) (?:there|gone|none)\b"),
    ("any more", "no longer", r"any more\b"),
    ("hangs together", "is connected", r"(?:hang|hangs|hung)\b"),
    ("doubt", "warning", r"doubt(?:s|ful)?\b"),
    ("surroundings", "environment", r"surroundings\b"),
    ("what", "a noun", r"what(?:ever)?\b"),
    ("that of", "repeat the noun", r"(?:that|those) of\b"),
)
_PATTERNS = [(old, new, re.compile(rf"\b{pattern}", re.I)) for old, new, pattern in WORDS]
# Comments, which are left out, and literals, of which those that touch are one.
_CPP = re.compile(r'//[^\n]*|/\*.*?\*/|\'(?:\\.|[^\'\\\n])\'|"(?:\\.|[^"\\\n])*"', re.S)


def texts_python(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of each literal of a module; a value in an f-string is ``{}``."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    inside: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):  # a docstring
            inside.add(id(node.value))
        elif isinstance(node, ast.JoinedStr):
            inside.update(id(part) for part in node.values)
            shown = [str(p.value) if isinstance(p, ast.Constant) else "{}" for p in node.values]
            yield node.lineno, "".join(shown)
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and id(node) not in inside
        ):
            yield node.lineno, node.value


def texts_cpp(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of each literal of a C++ file."""
    source = path.read_text(encoding="utf-8")
    for found in _CPP.finditer(source):
        if found[0][0] == '"':
            yield source.count("\n", 0, found.start()) + 1, found[0][1:-1]


def old_words(root: Path) -> Iterator[tuple[Path, int, str, str]]:
    """File, line, old word and text of all that is found in the tree at `root`."""
    for folder, pattern, texts in (
        ("py/flexpm", "*.py", texts_python),
        ("pkg/flexpm", "*.[ch]pp", texts_cpp),
    ):
        for path in sorted((root / folder).rglob(pattern)):
            for line, text in texts(path):
                for old, _, word in _PATTERNS if " " in text.strip() else ():
                    if word.search(text):
                        yield path.relative_to(root), line, old, " ".join(text.split())


def main() -> None:
    """Print the words of the tree given as argument, or of this one."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    counts: Counter[str] = Counter()
    for path, line, old, text in old_words(root):
        counts[old] += 1
        print(f"{path}:{line}: {old}: {text[:120]}")
    for old, new, _ in sorted(_PATTERNS, key=lambda one: -counts[one[0]]):
        if counts[old]:
            print(f"words: {counts[old]:4} {old:<24} -> {new}")
    print(f"words: {sum(counts.values())} old words")


if __name__ == "__main__":
    main()
