# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of the options of a run: only here each option has its name, unit, default and help.

``flexpm.run``, the command, studies and ``rerun`` use these groups. Options of single tests are
declared in ``kinds``. SI units.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TypedDict, TypeVar, Unpack

from ..kinds.option import Option, Value, told_of
from ..kinds.registry import KINDS, TESTS, names, options
from ..kinds.test_kind import PLATEAU_STRAIN, STOP_RATIO, TestKind
from ..models.options import MESHES, MODELS, POINTS, RANGE
from ..require import NOT_NEGATIVE, POSITIVE, Bounds
from .loading_rate import HALVING_BOUNDS, LOADINGS

#: ``rest``: unloaded, with the velocities of the elastic solution; ``static``: at that solution,
#: where the first contact point is about to leave its elastic branch.
STARTS = ("rest", "static")
#: Rate of a test that is to find one at which it is slow enough: 1, halved up to so many times.
AUTO, HALVINGS = "auto", 5
#: Kinds of films: a picture that moves, and a film that needs ffmpeg.
FILMS = ("gif", "mp4")
#: Frames of a film if no number is given; more than the most are a mistake.
FILM_FRAMES, MOST_FRAMES = 40, 1000

Usual = TypeVar("Usual")
Function = TypeVar("Function", bound=Callable[..., object])


class _Told(TypedDict, total=False):
    """Traits of an option, see `Option`."""

    unit: str
    bounds: Bounds
    choices: tuple[str, ...]
    default: str
    open: str
    whole: bool
    metavar: str


def declared(usual: Usual, told: str, **traits: Unpack[_Told]) -> Usual:
    """A field of a group.

    Args:
        usual: Its value unless it is given.
        told: Help, without unit and default.
        traits: Others of the option.
    """
    return field(default=usual, metadata={"option": Option("", told, **traits)})


def options_of(group: type) -> dict[str, Option]:
    """Return the options that the fields of a group declare, by name."""
    return {
        one.name: replace(one.metadata["option"], name=one.name)
        for one in fields(group)
        if "option" in one.metadata
    }


def _by_test(value: Callable[[TestKind], float], option: str) -> str:
    """Return a default and the tests with another default, as text."""
    found: dict[float, list[str]] = {}
    for name, kind in KINDS.items():
        if option not in kind.without:
            found.setdefault(value(kind), []).append(name)
    usual, *others = found.items()
    return "; ".join(
        [f"{usual[0]:g}", *(f"{', '.join(tests)}: {number:g}" for number, tests in others)]
    )


@dataclass(frozen=True)
class GrainOptions:
    """Options of the model of the grains."""

    model: str = declared("flexible", "Model of the grains", choices=MODELS)
    points: int = declared(
        POINTS[-1], "Points in each contact", choices=tuple(map(str, POINTS)), metavar="1|2|3"
    )
    mesh: str = declared(
        MESHES[0], "Triangles in each grain", choices=MESHES, metavar="fan|refined"
    )
    interaction_range: float | None = declared(
        None,
        "For jcfpm and cohfrict: bond also spheres whose distance is below this multiple of the "
        "sum of their radii, 1 to 2 [-]",
        bounds=RANGE,
        default="only neighbours",
        metavar="G",
    )


@dataclass(frozen=True)
class LoadingOptions:
    """Options of the loading and of the end of a test."""

    confinement: float = declared(
        0.0,
        f"Lateral pressure, for {' and '.join(names(lambda kind: kind.confined))}",
        unit="Pa",
        bounds=NOT_NEGATIVE,
    )
    rate: float = declared(
        1.0,
        "Factor on the loading rate [-]; auto: starts at 1 and halves the factor, up to "
        f"{HALVINGS} times, until the test is quasi-static",
        bounds=POSITIVE,
        metavar="F|auto",
    )
    halvings: int | None = declared(
        None,
        "Largest number of repetitions at half the rate. A test that ends not_quasistatic is "
        "repeated until it is ok and the peaks of two rates agree within 1 %",
        bounds=HALVING_BOUNDS,
        default=f"never; {HALVINGS} with --rate auto",
        open="none",
        whole=True,
        metavar="N",
    )
    max_strain: float | None = declared(
        None,
        "Axial strain at which the test ends [-]. Without it a test under a confining pressure "
        f"also ends on a plateau, when the deviator has been constant over "
        f"{100.0 * PLATEAU_STRAIN:g} % of strain",
        bounds=POSITIVE,
        default="strain at the reference strength, times "
        f"{_by_test(lambda kind: kind.largest_strain, 'max_strain')}",
        open="from the reference strength",
        metavar="E",
    )
    stop_ratio: float = declared(
        STOP_RATIO,
        "Ratio to its peak at which the deviator ends the test [-]; the deviator is the axial "
        "stress minus the smallest confining pressure",
        bounds=POSITIVE,
        default=_by_test(lambda kind: kind.stop_ratio, "stop_ratio"),
        metavar="F",
    )
    dynamic: bool = declared(False, "Use real masses and time instead of scaled masses")
    gravity: float = declared(
        0.0,
        "Gravitational acceleration, with --dynamic only",
        unit="m/s2",
        bounds=NOT_NEGATIVE,
        metavar="G",
    )
    damping: float | None = declared(
        None,
        "Local damping factor during the loading [-]; grains in free fall accelerate with "
        "(1 - damping) g",
        bounds=Bounds(at_least=0.0, below=1.0),
        default="0.7; 0 with --dynamic",
        metavar="A",
    )
    start: str = declared(
        "",
        "Start of the loading. static: from the elastic solution below the first crack, for the "
        "flexible model, in 3D also for the rigid model, in "
        f"{', '.join(names(lambda kind: kind.starts_static))}; in 2D it is the default of "
        f"{' and '.join(names(lambda kind: kind.usual.static_first))}",
        choices=STARTS,
        metavar="rest|static",
    )
    loading: str = declared(
        "",
        "Control of the loading rate. waiting: load fast, and nearly stop while cracks propagate; "
        "the default of flexible and rigid grains with scaled masses. adaptive: load faster while "
        "the specimen is elastic; the default of inner particles unless contacts are brittle",
        choices=LOADINGS,
        metavar="constant|adaptive|waiting",
    )


@dataclass(frozen=True)
class TestOptions:
    """Options of single tests, see ``kinds``; None for other tests."""

    __test__ = False  # no test of pytest

    span: float | None = None
    notch: float | None = None
    normal_stress: float | None = None
    max_displacement: float | None = None
    wave: str | None = None
    control: str | None = None
    own: Mapping[str, Value] = field(default_factory=dict)  #: options without a field, by name


@dataclass(frozen=True)
class OutputOptions:
    """Files that a run writes in addition to its results."""

    report: bool = declared(True, "Write report.html")
    frames: int = declared(
        0,
        "Number N of frames for ParaView: N states at equal strain intervals up to the strain of "
        "the reference strength, and states around the peak; fewer if the test ends before or has "
        "fewer rows",
        bounds=Bounds(at_least=0, at_most=MOST_FRAMES),
        whole=True,
        metavar="N",
    )
    film: str | None = declared(
        None,
        f"Write a film of the frames, {FILM_FRAMES} if their number is not given; mp4 needs ffmpeg",
        choices=FILMS,
        default="none",
        metavar="gif|mp4",
    )


#: Options of all tests, by name.
DECLARED = {**options_of(GrainOptions), **options_of(LoadingOptions)}
#: Options of single tests, except other names of a size.
OWN_OPTIONS = tuple(name for name, of in options().items() if not any(o.size for o in of.values()))


class SharedOptions(TypedDict, total=False):
    """Keywords of ``flexpm.run`` and ``flexpm.compare``, also the keywords of single tests."""

    points: int
    mesh: str
    interaction_range: float | None
    rate: float | str
    halvings: int | None
    max_strain: float | None
    stop_ratio: float | None
    dynamic: bool
    gravity: float
    damping: float | None
    start: str | None
    loading: str | None
    control: str | None
    end_friction: float | None
    jaw_radius: float | None
    span: float | None
    notch: float | None
    normal_stress: float | None
    max_displacement: float | None
    distance: float | None
    wave: str | None
    sides: str | None
    second_confinement: float | None
    report: bool
    frames: int
    film: str | None


class RunOptions(SharedOptions, total=False):
    """Additional keywords of ``flexpm.run``."""

    confinement: float


def documented(function: Function) -> Function:
    """Put the keywords of `RunOptions` with their units and defaults into a docstring."""
    lines: list[str] = []
    for name in (*DECLARED, *OWN_OPTIONS, *options_of(OutputOptions)):
        if name not in RunOptions.__annotations__:
            continue
        text, default = _TOLD[name] if name in _TOLD else told_of(options()[name])
        entry = f"{name}: {text}. Default: {default}."
        entry = re.sub(r"--([\w-]+)", lambda found: f"``{found[1].replace('-', '_')}``", entry)
        lines += _wrapped(entry)
    tests: list[str] = []
    for name in TESTS:
        kind = KINDS[name]
        tests += _wrapped(f"* ``{name}`` ({', '.join(kind.shapes)}): {kind.about}.", 2)
    told = (function.__doc__ or "").replace("        {keywords}", "\n".join(lines))
    function.__doc__ = told.replace("        {tests}", "\n".join(tests))
    return function


def _wrapped(entry: str, indent: int = 4) -> list[str]:
    """Return the lines of an entry of a list in a docstring."""
    later = " " * (8 + indent)
    return textwrap.wrap(entry, 96, initial_indent=" " * 8, subsequent_indent=later)


def _default_of(group: type, one: Option) -> str:
    """Default of an option of a group, as text."""
    value = getattr(group, one.name)
    return one.default or ("by test and model" if value in (None, "") else str(value))


#: Phrase and default of each option that runs of all tests have.
_TOLD = {
    name: (one.phrase, _default_of(group, one))
    for group in (GrainOptions, LoadingOptions, OutputOptions)
    for name, one in options_of(group).items()
}
