# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexible particle model of rock for YADE: importing the package loads the plugin's classes."""

from __future__ import annotations

import importlib
import sys

from ._plugin import load

__version__ = "0.1.0"

#: What users call, and the module it is in; imported when first used.
_PUBLIC = {
    "InputError": "errors",
    "Material": "materials.material",
    "Model": "models.grains",
    "Result": "results.result",
    "SimulationError": "errors",
    "Specimen": "specimens.specimen",
    "build": "models.grains",
    "compare": "studies.comparison",
    "elastic": "models.grains",
    "run": "laboratory.protocols",
}
__all__: list[str] = list(_PUBLIC)


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


#: What scripts use as attributes of the package, and where it is.
_MODULES = {
    "export": "results.vtu",
    "materials": "materials",
    "plot": "report.curves",
    "strength": "results.strength",
    "study": "studies.study",
}


def __getattr__(name: str) -> object:
    if name in _MODULES:
        return importlib.import_module(f".{_MODULES[name]}", __name__)
    if name in _PUBLIC:
        _load_classes()
        value = getattr(importlib.import_module(f".{_PUBLIC[name]}", __name__), name)
        globals()[name] = value
        return value
    # As a command, the first use of a class of the plugin loads it; modules are not loaded here.
    if name[:1].isupper():
        _load_classes()
        if name in __all__:
            return globals()[name]
    raise AttributeError(f"module 'flexpm' has no attribute '{name}'")
