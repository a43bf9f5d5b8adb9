# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and valid options of the models; only light modules are loaded here. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypedDict

from ..dimensions import refused
from ..errors import InputError
from ..kinds.model_names import BLOCK_MODELS as SOLID_MODELS
from ..kinds.model_names import GRAIN_MODELS, INNER_MODELS, MODELS, SPHERE_MODELS
from ..require import (
    NOT_NEGATIVE,
    Bounds,
    require_flag,
    require_number,
    require_one_of,
    require_whole,
)

__all__ = ["GRAIN_MODELS", "INNER_MODELS", "MODELS", "SOLID_MODELS", "SPHERE_MODELS"]

#: Triangles in each grain.
MESHES = ("refined", "fan")
#: Points in each contact.
POINTS = (1, 2, 3)
#: Local damping with scaled masses, unless told otherwise [-], paper Sec. 4.1.
DAMPING = 0.7
#: Distances up to which spheres are bonded, over the sum of their radii [-].
RANGE = Bounds(at_least=1.0, at_most=2.0)
_DAMPING = Bounds(at_least=0.0, below=1.0)


class Motion(TypedDict, total=False):
    """How grains move, as `build` takes it by these names; each may be left out."""

    damping: float | None  #: local damping alpha [-]; None: see `local_damping`
    dynamic: bool  #: real masses and time instead of scaled masses and unit steps
    gravity: float  #: acceleration downwards [m/s2]


def motion_of(given: Motion) -> tuple[float | None, bool, float]:
    """Damping, whether with real masses, and gravity, as given or by default.

    Raises:
        TypeError: for another name, as Python does for a keyword that a function has not.
    """
    for name in given:
        if name not in Motion.__annotations__:
            raise TypeError(f"build() got an unexpected keyword argument {name!r}")
    return given.get("damping"), given.get("dynamic", False), given.get("gravity", 0.0)


def local_damping(damping: float | None, *, dynamic: bool) -> float:
    """Local damping alpha that is in effect [-].

    Args:
        damping: Requested damping factor [-]; None: 0.7 with scaled masses, 0 with real masses,
            whose motion under gravity it would slow down.
        dynamic: Real masses and time.

    Raises:
        InputError: for a factor out of range.
    """
    if damping is None:
        return 0.0 if dynamic else DAMPING
    return require_number("build: damping", damping, _DAMPING)


def require_model(label: str, model: str, known: Sequence[str], *, solid: bool) -> None:
    """Refuse a model that is not one of a few.

    Args:
        label: Beginning of the message: function and argument.
        model: Its name.
        known: Names of the models that are available.
        solid: Whether the specimen is 3D.

    Raises:
        InputError: for another model.
    """
    try:
        require_one_of(label, model, known)
    except InputError as error:
        raise (refused(str(error), "inner") if solid and model in INNER_MODELS else error) from None


def check_options(
    model: str,
    *,
    points: int,
    mesh: str,
    dynamic: bool = False,
    gravity: float = 0.0,
    interaction_range: float | None = None,
    bonded: bool = True,
) -> None:
    """Raise InputError for an unknown model, or for an option that it cannot have.

    Args:
        model: Name of the model.
        points: Contact points per contact.
        mesh: Triangles in each grain.
        dynamic: Real masses and time.
        gravity: Acceleration downwards [m/s2].
        interaction_range: Distance up to which spheres are bonded over the sum of their radii [-].
        bonded: Whether the contacts are bonded at the start.
    """
    require_one_of("build: model", model, MODELS)
    require_whole("build: points", points)
    require_flag("build: dynamic", dynamic)
    require_flag("build: bonded", bonded)
    if not bonded and model not in SOLID_MODELS:
        raise InputError(
            f"build: bonded = False, must be True for model {model}; "
            f"use {' or '.join(SOLID_MODELS)}"
        )
    if interaction_range is not None:
        require_number("build: interaction_range", interaction_range, RANGE)
        if model not in SPHERE_MODELS:
            raise InputError(
                f"build: interaction_range = {interaction_range}, must not be given for model "
                f"{model}; it is for {' and '.join(SPHERE_MODELS)}"
            )
    if model in SPHERE_MODELS:
        require_one_of(f"build: points of model {model}", points, (POINTS[-1],))
        require_one_of(f"build: mesh of model {model}", mesh, (MESHES[0],))
        require_one_of(f"build: gravity of model {model}", gravity, (0.0,))
    else:
        require_one_of("build: points", points, POINTS)
        require_one_of("build: mesh", mesh, MESHES)
        _require_gravity(gravity, dynamic)


def _require_gravity(gravity: float, dynamic: bool) -> None:
    require_number("build: gravity", gravity, NOT_NEGATIVE, "m/s2")
    if gravity != 0.0 and not dynamic:
        raise InputError(
            f"build: gravity = {gravity} m/s2, must be 0 with scaled masses; use dynamic"
        )
