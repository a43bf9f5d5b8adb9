# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the inputs of a run, and the values of inputs that were left out. SI units."""

from __future__ import annotations

from dataclasses import fields
from numbers import Number
from typing import NoReturn

from ..dimensions import is_solid, refused
from ..errors import InputError
from ..kinds.option import Asked
from ..kinds.registry import KINDS, names
from ..kinds.test_kind import Stage, TestKind
from ..materials.joint import require_joints
from ..models.options import (
    DAMPING,
    INNER_MODELS,
    SPHERE_MODELS,
    check_options,
    local_damping,
    require_model,
)
from ..require import (
    Bounds,
    quoted,
    require_flag,
    require_known,
    require_number,
    require_one_of,
    require_whole,
)
from .groups import AUTO, OWN_OPTIONS, STARTS
from .input_names import OF_THE_PLANE, UNUSED, with_unit
from .loading_rate import HALVING_BOUNDS, LARGEST_STOP_RATIO, LOADINGS, RATE, WAITING_MODELS
from .run_inputs import RunInputs

#: Inputs that tests have all the same, or that have rules of their own.
_ALWAYS = ("start", "loading", "confinement")
#: Ranges beyond which sums are no numbers, or no test has a sense.
_STRAIN = Bounds(above=0.0, at_least=1e-12, at_most=1e6)
_PRESSURE = Bounds(at_least=0.0, at_most=1e15)
_GRAVITY = Bounds(at_least=0.0, at_most=1e12)


def settle(run: RunInputs) -> None:
    """Check the inputs of a run that has just been made, and complete them.

    Raises:
        InputError: for a value out of range, or an option that the test has no use for.
    """
    require_one_of("run: test", run.test, tuple(KINDS))
    _check_unused(run)
    if run.kind.dynamic:
        _set(run, "dynamic", True)
    _check_numbers(run)
    if run.is_solid:
        _check_solid(run)
    check_options(
        run.model,
        points=run.points,
        mesh=run.mesh,
        dynamic=run.dynamic,
        gravity=run.gravity,
        interaction_range=run.interaction_range,
    )
    _check_start(run)
    _check_loading(run)
    _check_test(run)
    _settle_own(run)
    _check_control(run)
    _check_damping(run)
    _set(run, "points", int(run.points))
    _set(run, "material", dict(run.material))


def _check_unused(run: RunInputs) -> None:
    """Refuse options that the test has no use for, unless they are as if not given."""
    for field in fields(run):
        name, value = field.name, getattr(run, field.name)
        if name in _ALWAYS or name not in UNUSED[run.test]:
            continue
        usual = value is None or (isinstance(value, Number | str) and value == field.default)
        if not usual and not (name == "dynamic" and run.kind.dynamic):
            _refuse(run, name, value)
    for name, value in run.own.items():
        require_known("run: option", name, OWN_OPTIONS)
        if value is not None and not run.kind.has(name):
            _refuse(run, name, value)


def _refuse(run: RunInputs, name: str, value: object) -> NoReturn:
    if name == "halvings":  # a rate that is found by halving it
        name, value = "rate", AUTO
    raise InputError(
        f"run: {with_unit(name, value)}, must not be given for {run.test}; leave it out"
    )


def _check_numbers(run: RunInputs) -> None:
    _set(run, "rate", require_number("run: rate", run.rate, RATE))
    if run.halvings is not None:
        halvings = require_whole("run: halvings", run.halvings, HALVING_BOUNDS)
        require_number("run: rate after all halvings", run.rate * 0.5**halvings, RATE)
        _set(run, "halvings", halvings)
    if run.max_strain is not None:
        largest = require_number("run: max_strain", run.max_strain, _STRAIN)
        _set(run, "max_strain", largest)
    bounds = Bounds(above=0.0, at_most=LARGEST_STOP_RATIO)
    _set(run, "stop_ratio", require_number("run: stop_ratio", run.stop_ratio, bounds))
    if isinstance(run.confinement, list | tuple):  # as the command takes them
        raise InputError(
            f"run: confinement = {quoted(run.confinement)} Pa, must be one number; give "
            "second_confinement for the pressure across y of a box"
        )
    confinement = require_number("run: confinement", run.confinement, _PRESSURE, "Pa")
    _set(run, "confinement", confinement)
    gravity = require_number("run: gravity", run.gravity, _GRAVITY, "m/s2")
    _set(run, "gravity", gravity)
    _set(run, "dynamic", require_flag("run: dynamic", run.dynamic))


def _check_start(run: RunInputs) -> None:
    variant = run.kind.variant_of(run.specimen.kind)
    if not run.start:
        first = variant.static_first and run.model in variant.static_models
        static = first and not run.dynamic and run.specimen.joints is None
        _set(run, "start", "static" if static else "rest")
    require_one_of("run: start", run.start, STARTS)
    if run.start == "static" and run.model not in variant.static_models:

        def starts(kind: TestKind) -> bool:
            of = kind.variant_in(solid=run.is_solid)
            return of is not None and bool(of.static_models)

        models = "flexible or rigid" if run.is_solid else "flexible"
        raise InputError(
            f"run: start = static, must be rest for {run.test} of model {run.model}; static "
            f"needs the {models} model and {' or '.join(names(starts))}"
        )
    if run.start == "static" and run.dynamic:
        raise InputError(
            "run: start = static, must be rest with real masses, which would move along the "
            "elastic solution; leave it out"
        )
    if run.start == "static" and run.specimen.joints is not None:
        raise InputError(
            "run: start = static, must be rest for a specimen with joints, which are not "
            "elastic; leave it out"
        )


def _check_loading(run: RunInputs) -> None:
    if not run.loading:
        _set(run, "loading", run.default_loading)
    require_one_of("run: loading", run.loading, LOADINGS)
    if run.loading != "constant" and not run.adapts:
        raise InputError(
            f"run: loading = {run.loading}, must be constant for model {run.model}"
            f"{' with real masses' if run.dynamic else ''}; {run.loading} needs grains and "
            "scaled masses"
        )
    if run.loading == "waiting":
        _check_waiting(run)


def _check_waiting(run: RunInputs) -> None:
    if run.model not in WAITING_MODELS:
        raise InputError(
            f"run: loading = waiting, must be adaptive or constant for model {run.model}; "
            f"waiting is for {' and '.join(WAITING_MODELS)} grains"
        )


def _check_test(run: RunInputs) -> None:
    label = "run: model" if run.kind.is_solve else f"run: model of {run.test}"
    known = run.kind.models_of(run.specimen.kind)
    require_model(label, run.model, known, solid=run.is_solid)
    if run.model in SPHERE_MODELS:
        run.specimen.require_discs(run.model)
    if run.model in INNER_MODELS:
        run.specimen.require_alike(run.model)
    laws = [joint["name"] for joint in run.material.get("joints", ())]
    require_joints(run.specimen.joints_with_law, laws)
    require_shape(run.kind, run.specimen.kind)
    if not run.kind.confined and run.confinement != 0.0:
        hint = run.kind.confine_hint
        if run.is_solid:
            shape = run.specimen.kind
            confined = names(lambda kind: Stage.CONFINE in kind.stages and shape in kind.solids)
            hint = f"; use {confined[0]}" if confined else ""
        raise InputError(
            f"run: confinement = {run.confinement} Pa, must be 0 for "
            f"{run.test}{hint or '; leave it out'}"
        )


def require_shape(kind: TestKind, shape: str) -> None:
    """Reject a shape that a test does not support.

    Raises:
        InputError: with the 2D shape and the 3D shapes of the test.
    """
    if shape not in kind.variants:
        hint = kind.other_hint if is_solid(shape) != is_solid(kind.shape) else ""
        others = [one for one in kind.solids if one != kind.shape]
        if is_solid(shape) and others:
            hint = f", or a {' or a '.join(others)}{hint}"
        raise InputError(
            f"run: specimen = {shape}, must be a {kind.shape} for "
            f"{kind.name}{hint or '; change the shape or the test'}"
        )


def _check_solid(run: RunInputs) -> None:
    """Refuse tests and options that are available in 2D only."""
    require_shape(run.kind, run.specimen.kind)
    for name in OF_THE_PLANE[1:]:
        value, usual = getattr(run, name), getattr(type(run), name, None)
        if value != usual:
            asked = f"run: {with_unit(name, value)}, must be left out for a {run.specimen.kind}"
            raise refused(asked, name)
    if run.dynamic and run.model in SPHERE_MODELS:
        raise InputError(
            f"run: dynamic = True, must be False for {run.model} grains in a {run.specimen.kind}; "
            "use flexible or rigid grains"
        )


def _settle_own(run: RunInputs) -> None:
    """Check and complete the options that not all tests have."""
    if not run.kind.options:
        return
    sizes, packed = run.specimen.sizes, run.specimen.diameters
    diameter = None if packed is None else float(sum(packed)) / 2.0
    given = run.options
    for option in run.kind.options:
        if option.models and run.model not in option.models and given.get(option.name) is not None:
            raise InputError(
                f"run: {with_unit(option.name, given[option.name])}, must be left out for model "
                f"{run.model}; it is for {' and '.join(option.models)}"
            )
    found = {**given, **run.kind.settle(Asked(run.test, sizes, given, diameter))}
    for name in given.keys() & {field.name for field in fields(run)}:
        _set(run, name, found.pop(name))
    _set(run, "own", {name: value for name, value in found.items() if value is not None})


def _check_control(run: RunInputs) -> None:
    if run.control is None:
        return
    controls = tuple(run.kind.controls)
    require_one_of("run: control", run.control, controls)
    first = controls[0]
    if run.control == first:
        _set(run, "control", None)
    elif run.model not in WAITING_MODELS or run.dynamic:
        raise InputError(
            f"run: control = {run.control}, must be {first} for model {run.model}"
            f"{' with real masses' if run.dynamic else ''}; it needs flexible or rigid grains "
            "and scaled masses"
        )
    elif run.start == "static":
        raise InputError(
            f"run: start = static, must be rest with control = {run.control}; leave it out"
        )


def _check_damping(run: RunInputs) -> None:
    if "damping" in UNUSED[run.test]:
        return
    damping = local_damping(run.damping, dynamic=run.dynamic)
    _set(run, "damping", None if damping == DAMPING and not run.dynamic else damping)


def _set(run: RunInputs, name: str, value: object) -> None:
    object.__setattr__(run, name, value)
