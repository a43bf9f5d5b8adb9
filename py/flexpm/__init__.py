# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexible particle model of rock for YADE: importing the package loads the plugin's classes."""

from __future__ import annotations

import sys

from ._loading import load

__version__ = "0.1.0"
__all__: list[str] = []


def _load_classes() -> None:
    names = load()
    import yade

    for name in names:
        globals()[name] = getattr(yade, name)
        if name not in __all__:
            __all__.append(name)


def _is_command() -> bool:
    # `python -m flexpm`: help and wrong input are answered without waiting for YADE
    if sys.argv[:1] != ["-m"]:
        return False
    options = sys.orig_argv
    return "-m" in options and options[options.index("-m") + 1] == "flexpm"


if not _is_command():
    _load_classes()


def __getattr__(name: str) -> object:
    # As a command, the first use of a class of the plugin loads it; modules are not loaded here.
    if name[:1].isupper():
        _load_classes()
        if name in __all__:
            return globals()[name]
    raise AttributeError(f"module 'flexpm' has no attribute '{name}'")
