# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of the inputs of a run, their units, and the tests that use them.

Nothing heavy is loaded here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from ..dimensions import FEATURES
from ..errors import InputError
from ..kinds.registry import KINDS, kind_of, options
from ..kinds.test_kind import TestKind
from ..models.options import SPHERE_MODELS
from ..require import quoted
from ..specimens.space.any_spec import SIZES
from .groups import AUTO, DECLARED, HALVINGS, OWN_OPTIONS

#: Sizes of all shapes.
_SIZES = tuple(dict.fromkeys(name for sizes in SIZES.values() for name in sizes))


def _unused(kind: TestKind) -> tuple[str, ...]:
    """Options that a test has no use for."""
    others = [name for name in options() if not kind.has(name)]
    renamed = [one.size for one in kind.options if one.size]
    takes = [name for shape in kind.variants for name in SIZES[shape]]
    sizes = [name for name in _SIZES if name not in takes or name in renamed]
    pressure = () if kind.confined else ("confinement",)
    start = () if kind.starts_static else ("start",)
    halved = ("halvings",) if "rate" in kind.without else ()
    return tuple(dict.fromkeys((*sizes, *pressure, *start, *kind.without, *halved, *others)))


#: Options that a test has no use for.
UNUSED = {name: _unused(kind) for name, kind in KINDS.items()}
#: Options that no 3D specimen has; the first is one of its packing.
OF_THE_PLANE = tuple(name for name in ("thickness", *DECLARED) if name in FEATURES)


def unused(test: str, shape: object = None) -> tuple[str, ...]:
    """Return the options that a test does not use for a shape; None: the 2D shape of the test."""
    kind = KINDS[test]
    if shape not in kind.solids:
        shape = kind.shape
    others = OF_THE_PLANE if shape in kind.solids else ()
    own = (*SIZES[str(shape)], *(one.name for one in kind.options))
    sizes = [name for name in _SIZES if name not in own]
    return tuple(dict.fromkeys((*UNUSED[test], *sizes, *others)))


#: Units of inputs that have one.
INPUT_UNITS = {
    **dict.fromkeys((*_SIZES, "thickness", "diameters", "joint_origin"), "m"),
    **{name: one.unit for name, of in options().items() for one in of.values() if one.unit},
    **{name: one.unit for name, one in DECLARED.items() if one.unit},
}
#: Options of how a specimen is packed.
PACKING = ("thickness", "diameters", "porosity", "seed")
#: Options of tests that are other names of sizes.
_OTHER_NAMES = tuple(name for name in options() if name not in OWN_OPTIONS)
#: Options of what is done with it.
SIMULATION = (*DECLARED, *OWN_OPTIONS)
#: Options that are sizes of the specimen.
SIZE_NAMES = (*_SIZES, *_OTHER_NAMES)
#: Options of the command by their names.
OPTIONS = ("shape", *SIZE_NAMES, *PACKING, *SIMULATION)


def with_unit(name: str, value: object) -> str:
    """An input and its value with its unit, for a message."""
    shown = value if isinstance(value, str) and len(value) < 80 else quoted(value)
    return f"{name} = {shown} {INPUT_UNITS.get(name, '')}".rstrip()


def paced(rate: float | str, halvings: int | None = None) -> tuple[float, int | None]:
    """Return rate and halvings of a run from the requested rate; ``auto`` determines both.

    Other input than a rate is rejected by the checks of a run.
    """
    if rate != AUTO:
        return cast(float, rate), halvings
    return 1.0, HALVINGS if halvings is None else halvings


def models_of(test: str) -> tuple[str, ...]:
    """Models that a test is for."""
    return kind_of(test).models


def takes_range(model: object) -> bool:
    """Whether a model can have an interaction range."""
    return model in SPHERE_MODELS


def ranges(models: Sequence[str], interaction_range: float | None) -> dict[str, float | None]:
    """Return the interaction range of each model, which only YADE's spheres use.

    Raises:
        InputError: if it is given and none of the models can have it.
    """
    if interaction_range is not None and not any(map(takes_range, models)):
        raise InputError(
            f"compare: interaction_range = {interaction_range}, must not be given for "
            f"{', '.join(models)}; it is for YADE's spheres"
        )
    return {model: interaction_range if takes_range(model) else None for model in models}


def shape_of(test: str, shape: object = None, depth: object = None) -> str:
    """Return the shape of a specimen: the requested shape, or with a depth the only 3D shape."""
    kind = kind_of(test)
    if shape:
        return str(shape)
    by_depth = depth is not None and len(kind.solids) == 1
    return kind.solids[0] if by_depth else kind.shape
