# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexible particle model of rock for YADE: importing the package loads the plugin's classes.

The command `flexpm` sets FLEXPM_DEFER in its environment: the classes are then loaded with the
first use of one of them or of a public name, so that help and wrong input do not wait for YADE.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._plugin import load
from ._version import __version__ as __version__

if TYPE_CHECKING:
    from ._api import (
        InputError,
        Loading,
        Material,
        Model,
        PartRig,
        Result,
        SimulationError,
        SolidPartRig,
        Specimen,
        build,
        compare,
        elastic,
        rig,
        run,
    )
    from .studies.own.calibration import calibrate
    from .studies.scorecards.card import scorecard

#: What users call; imported when first used. The classes of the plugin are added as they load.
__all__ = [
    "InputError",
    "Loading",
    "Material",
    "Model",
    "PartRig",
    "Result",
    "SimulationError",
    "SolidPartRig",
    "Specimen",
    "build",
    "calibrate",
    "compare",
    "elastic",
    "load",
    "rig",
    "run",
    "scorecard",
]
#: Modules that scripts use as attributes of the package.
_MODULES = ("export", "materials", "plot", "strength", "study")


def _load_classes() -> None:
    names = load()
    import yade

    for name in names:
        globals()[name] = getattr(yade, name)
        if name not in __all__:
            __all__.append(name)


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used."""
    if name == "study":  # apart, since pandas takes long to load
        from .studies import study

        return study
    if name == "calibrate":  # likewise
        _load_classes()
        from .studies.own import calibration

        return calibration.calibrate
    if name == "scorecard":  # likewise
        _load_classes()
        from .studies.scorecards import card

        return card.scorecard
    if name in __all__ or name in _MODULES:
        _load_classes()
        from . import _api

        return getattr(_api, name)
    # if loading was deferred, the first use of a class of the plugin loads all of them
    if name[:1].isupper():
        _load_classes()
        if name in globals():
            return globals()[name]
    raise AttributeError(f"module 'flexpm' has no attribute '{name}'")


def __dir__() -> list[str]:
    """Names to be completed: only public names, including names that are imported later."""
    special = {name for name in globals() if name.startswith("__")}
    return sorted({*special, *__all__, *_MODULES})


# removed, so that programs started from here load the classes at once
if os.environ.pop("FLEXPM_DEFER", None) is None:
    _load_classes()
