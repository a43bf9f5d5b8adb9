#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Count what the kernel and its adapters have once for 2D and once more for 3D.

    scripts/checks/twins.py [--list] [ROOT]

It prints three counts, with --list their members, and never fails. Declarations are those that
universal-ctags finds (free functions, members and templates; lambdas belong to their function):

* names declared for both states: functions of one name, without the prefixes ``solid_``, ``space_``
  and ``plane_``, of which one has ``Assembly`` and another ``SolidState`` among its parameters, or
  is a member of that class;
* functions of like shape: of each function of 3D with at least five lines in all, the one of 2D
  that is most alike. Bodies are compared word by word (difflib), once the prefixes are off and the
  names of states, points and solvers are the same; from 0.6 on they are alike;
* headers that name a twin: a header of one dimension is in the @file text of one of the other.

A function is of 3D if its file or its signature has a word with ``solid`` or ``space``.
"""

from __future__ import annotations

import argparse
import difflib
import itertools
import json
import re
import shutil
import subprocess
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

FOLDERS = ("pkg/flexpm/kernel", "pkg/flexpm/yade")
LIKE, FEWEST_LINES, FEWEST_WORDS = 0.6, 5, 12
#: Share of common pairs of words from which two bodies are compared [-]: a bound on their ratio.
WORTH_COMPARING = 0.35
STATES = {"Assembly": "plane", "SolidState": "space"}
#: Names that mean the same in both dimensions.
SAME = {
    **{"SolidState": "Assembly", "Vector": "Point", "Vector3r": "Point", "SolidSolver": "Solver"},
    **{"GrainSolver": "Solver", "FaceContacts": "Contacts", "surface": "facets", "state": "a"},
    **{"s": "a", "triangle": "facet", "t": "e"},
}
PREFIX = re.compile(r"^(solid_|space_|plane_|Solid|Space|Plane)(?=\w)")
OF_SPACE = re.compile(r"solid|space", re.IGNORECASE)
WORD = re.compile(r"\w+|[^\w\s]")
HEADER = re.compile(r"[\w/]+\.hpp")


class Function(NamedTuple):
    """A function and the words of its body."""

    name: str  #: without prefix
    path: str
    signature: str
    scope: str
    words: list[str]

    @property
    def of_space(self) -> bool:
        """Whether it is of 3D."""
        return bool(OF_SPACE.search(f"{self.path} {self.signature} {self.scope}"))


def functions(root: Path) -> Iterator[Function]:
    """All functions that are declared or defined in the kernel and its adapters."""
    command = ["ctags", "-R", "--languages=C++", "--kinds-C++=fp", "--fields=+neSs", "-f", "-"]
    command += ["--output-format=json", *FOLDERS]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True)
    texts: dict[str, list[str]] = {}
    for tag in map(json.loads, done.stdout.splitlines()):
        if tag["name"].startswith("__anon"):
            continue
        path = tag["path"]
        if path not in texts:
            texts[path] = (root / path).read_text(encoding="utf-8").splitlines()
        lines = texts[path][tag["line"] : tag["end"]] if "end" in tag else []
        words = [w for line in lines for w in WORD.findall(line.split("//")[0])]
        words = (
            [SAME.get(w, PREFIX.sub("", w)) for w in words]
            if len(lines) >= FEWEST_LINES - 1
            else []
        )
        name = PREFIX.sub("", tag["name"])
        scope = tag.get("scope", "").rpartition("::")[2]
        yield Function(name, path, tag.get("signature", ""), scope, words)


def for_both_states(found: list[Function]) -> list[str]:
    """Names that are declared for the state of 2D and for that of 3D."""
    sides = defaultdict(set)
    for one in found:
        for state, side in STATES.items():
            if one.scope == state or re.search(rf"\b{state}\b", one.signature):
                sides[one.name].add(side)
    return sorted(name for name, there in sides.items() if len(there) == len(STATES))


def alike(found: list[Function]) -> list[tuple[float, Function, Function]]:
    """Functions of 3D with the one of 2D that is most like them, the most alike first."""
    bodies = [one for one in found if len(one.words) >= FEWEST_WORDS]
    pairs = {id(one): Counter(zip(one.words, one.words[1:], strict=False)) for one in bodies}
    plane = [one for one in bodies if not one.of_space]
    matches = []
    for one in bodies:
        if not one.of_space:
            continue
        best, other = 0.0, None
        for candidate in plane:
            common = (pairs[id(one)] & pairs[id(candidate)]).total()
            if 2 * common < WORTH_COMPARING * (len(one.words) + len(candidate.words)):
                continue
            compared = difflib.SequenceMatcher(None, one.words, candidate.words, autojunk=False)
            if (ratio := compared.ratio()) > best:
                best, other = ratio, candidate
        if other is not None and best >= LIKE:
            matches.append((best, one, other))
    return sorted(matches, key=lambda match: -match[0])


def twin_headers(root: Path) -> list[str]:
    """Headers whose first comment names one of the other dimension."""
    found = []
    for path in (one for folder in FOLDERS for one in sorted((root / folder).rglob("*.hpp"))):
        lines = path.read_text(encoding="utf-8").splitlines()
        about = itertools.takewhile(lambda line: line.startswith("//"), lines)
        name = str(path.relative_to(root))
        of_space = bool(OF_SPACE.search(name))
        named = HEADER.findall(" ".join(about))
        if any(bool(OF_SPACE.search(one)) != of_space for one in named):
            found.append(name)
    return found


def main() -> None:
    """Print the counts."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("root", nargs="?", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--list", action="store_true", help="name them, too")
    options = parser.parse_args()
    if shutil.which("ctags") is None:
        print("twins: ctags = not found, nothing is counted; install the package universal-ctags")
        return
    found = list(functions(options.root))
    names, like, headers = for_both_states(found), alike(found), twin_headers(options.root)
    of_space = sum(one.of_space and len(one.words) >= FEWEST_WORDS for one in found)
    shapes = [f"{r:.2f} {a.path} {a.name} ~ {b.path} {b.name}" for r, a, b in like]
    for text, members in (
        (f"{len(names)} names are declared for both states", names),
        (f"{len(like)} of {of_space} functions of 3D have the shape of one of 2D", shapes),
        (f"{len(headers)} headers name a twin", headers),
    ):
        print(f"twins: {text}")
        for line in members if options.list else ():
            print(f"  {line}")


if __name__ == "__main__":
    main()
