# SPDX-License-Identifier: GPL-3.0-or-later
"""From the command's options to what the library takes; loads YADE when it is needed. SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from .. import _plugin
from .._version import __version__
from ..errors import InputError
from ..materials.material import Material, load
from ..materials.mixing import description
from . import signals, terminal

if TYPE_CHECKING:
    from ..specimens.specimen import Specimen


def load_yade() -> None:
    """Load YADE and the plugin's classes."""
    _plugin.load()
    signals.catch_signals()


def require(what: str, name: str, available: Any) -> None:
    """Raise InputError if this version does not have a test or a model."""
    if name not in available:
        raise InputError(
            f"{what} = {name!r}, is not available in flexpm {__version__}; "
            f"available are {', '.join(available)}"
        )


def material(options: dict[str, Any], model: str | None = None) -> Material:
    """The material with its changes, checked for the model."""
    model = model or options["model"]
    chosen = load(options["material"], model).with_set(options["assignments"], model)
    description(chosen, model)
    return chosen


def specimen_for(test: str, options: dict[str, Any], progress: terminal.Progress) -> Specimen:
    """The specimen of a test."""
    return (disc if test == "brazilian" else rectangle)(options, progress)


def disc(options: dict[str, Any], progress: terminal.Progress) -> Specimen:
    """Pack a disc."""
    _refuse_other_shape("disc", "width", "height")
    load_yade()
    from ..specimens.specimen import Specimen

    return Specimen.disc(diameter=options["diameter"], progress=progress, **_packing(options))


def rectangle(options: dict[str, Any], progress: terminal.Progress) -> Specimen:
    """Pack a rectangle."""
    _refuse_other_shape("rectangle", "diameter")
    width, height = options["width"], options["height"]
    load_yade()
    from ..specimens.specimen import Specimen

    return Specimen.rectangle(width=width, height=height, progress=progress, **_packing(options))


def _packing(options: dict[str, Any]) -> dict[str, Any]:
    return {name: options[name] for name in ("thickness", "diameters", "porosity", "seed")}


def _refuse_other_shape(shape: str, *names: str) -> None:
    """Sizes that were given for another shape than the specimen's would be ignored silently."""
    context = click.get_current_context()
    for name in names:
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE:
            raise InputError(
                f"{name} = {context.params.get(name)} m, must not be given for a {shape}; "
                "leave it out"
            )
