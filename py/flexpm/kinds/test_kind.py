# SPDX-License-Identifier: GPL-3.0-or-later
"""Definition of a test: shapes, options, models, stages, parts, measures, words and rates."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from ..dimensions import is_solid
from .layout import Frame, Layout, Lines
from .option import Asked, Option, Settle, Value
from .rates import Rates
from .words import Columns, Words

#: Part of its peak to which the stress falls before a test ends, unless told otherwise [-].
STOP_RATIO = 0.5
#: A test under a confining pressure ends by default once its deviator has been constant over this
#: axial strain [-]: its largest value exceeds its smallest by 2 % of the largest at most.
PLATEAU_STRAIN = 0.005


class Rig(Enum):
    """Type of rig that loads a specimen."""

    ENDS = "ends"  #: its lower and upper end, or two plates on a disc
    PARTS = "parts"  #: what a layout says
    WAVE = "wave"  #: nothing: a pulse goes through it
    NONE = "none"  #: it is solved, not stepped


class Stage(Enum):
    """Stage of a run; a test has a sequence of stages."""

    CONFINE = "confine"  #: presses on all sides with the confinement
    PRESS = "press"  #: presses on the layout's pressed part
    LOAD = "load"  #: drives until the stress has fallen from its peak
    SLIDE = "slide"  #: drives all the way, whatever the stress does
    SEND = "send"  #: lets a pulse go


def _as_given(asked: Asked) -> Mapping[str, Value]:
    return asked.values


def _above_the_notch(frame: Frame) -> float:
    return frame.height - frame.notch_depth


@dataclass(frozen=True)
class Variant:
    """Variant of a test for specimens of a shape."""

    rates: Mapping[str, Rates] = field(default_factory=dict)  #: by model
    only_models: tuple[str, ...] = ()  #: its models, if it has no rates
    sizes: Mapping[str, float] = field(default_factory=dict)  #: others than the shape's [m]
    static_models: tuple[str, ...] = ()  #: that may start at the elastic solution
    static_first: bool = False  #: they do by default
    #: Number of the results by model, 1 if it has none. A commit that changes a hash of a reference
    #: command (scripts/checks/reference.py) raises the number of its test and model; runs of these
    #: that were finished before get other keys and are done again.
    results: Mapping[str, int] = field(default_factory=dict)

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the models of this variant."""
        return tuple(self.rates) or self.only_models


@dataclass(frozen=True)
class TestKind:
    """Definition of a test; the defaults are the values of compression between the ends."""

    __test__ = False  # no test of pytest

    name: str
    order: int  #: its place in lists of all tests
    about: str  #: a sentence or two for the help and the manual

    # What is tested
    variants: Mapping[str, Variant]  #: by the shape of the specimen, the usual shape first
    other_hint: str = ""  #: advice for a user of the other dimension, if it takes none of that

    # What can be asked for
    options: tuple[Option, ...] = ()  #: that not all tests have
    without: tuple[str, ...] = ()  #: options of all tests that this one has no use for
    settle: Settle = _as_given  #: checks and completes its own options
    confined: bool = False  #: it takes a confinement
    confine_hint: str = ""  #: what serves a user who wants one, if it does not
    dynamic: bool = False  #: it has real masses and no damping, always
    #: What may grow at the loading rate and its column of the record, the way of what is driven
    #: first, which needs none.
    controls: Mapping[str, str] = field(default_factory=dict)

    # What happens
    rig: Rig = Rig.ENDS
    pulls: bool = False
    stages: tuple[Stage, ...] = (Stage.LOAD,)
    pressure: str = "confinement"  #: option with the pressure of a stage that presses
    cut: Callable[[Frame], Lines] | None = None  #: lines of the notches that it cuts
    notch_law: Mapping[str, object] = field(default_factory=lambda: {"open": True})
    takes_notch: bool = False  #: a specimen may bring its notch: open, up from the bottom's middle
    ligament: Callable[[Frame], float] = _above_the_notch  #: what notches leave of it [m]
    layout: Callable[[Frame], Layout] | None = None
    stop_ratio: float = STOP_RATIO
    #: It ends at this multiple of the reference strain unless told otherwise [-]: bonds that soften
    #: slowly, and the interlocking edges of inner particles, carry more than the reference.
    largest_strain: float = 8.0
    #: Its steps fall with this power of the rate [-]: twice the rate saves a third of them,
    #: roughly, as cracks take their time.
    likely_power: float = 0.5
    #: Its descent from the peak is free of damping, deviation D55, unless there are joints.
    falls_freely: bool = False
    slides: bool = False  #: friction is what it measures; what slides lets go in a wave's time

    # What it tells
    needs_peak: bool = True  #: one without a peak has failed
    quasi_static: bool = True
    regains: bool = False  #: stress that comes back once a specimen is broken does not count
    pulled: bool = False  #: cracks follow the tension all over the specimen
    splits: bool = False  #: its strength is one if a disc cracks from the middle
    is_core: bool = False  #: a laboratory reads off where its cracks begin, see ``results.core``
    no_constants: tuple[str, ...] = ()  #: slopes of its record that are none of the rock
    #: What it measures beside its peak: keys of result.json, from the record and the peak stress.
    measure: Callable[[Frame, Columns, float | None], Mapping[str, float | None]] | None = None
    title: str = ""  #: its name in headings; empty: its name with a capital
    words: Words = field(default_factory=Words)
    rows: tuple[str, ...] = ()  #: of the common rows of a table of its outcome; none: all
    #: Targets of calibrations by name: a key of result.json, or the two keys of a quotient.
    calibrates: Mapping[str, str | tuple[str, str]] = field(default_factory=dict)
    envelope: bool = False  #: its peaks make a strength envelope
    scored: str = ""  #: its role in a scorecard, see ``studies.scorecards``; empty: none

    def has(self, option: str) -> bool:
        """Whether the test has an option that not all tests have."""
        return any(one.name == option for one in self.options)

    @property
    def shapes(self) -> tuple[str, ...]:
        """Shapes of its specimens, the usual shape first."""
        return tuple(self.variants)

    @property
    def shape(self) -> str:
        """Usual shape of its specimens."""
        return self.shapes[0]

    @property
    def solids(self) -> tuple[str, ...]:
        """Shapes of its 3D specimens."""
        return tuple(filter(is_solid, self.variants))

    @property
    def usual(self) -> Variant:
        """Variant for the usual shape."""
        return self.variants[self.shape]

    @property
    def models(self) -> tuple[str, ...]:
        """Models for its usual shape."""
        return self.usual.models

    @property
    def rates(self) -> Mapping[str, Rates]:
        """Rates for its usual shape, by model."""
        return self.usual.rates

    @property
    def results(self) -> Mapping[str, int]:
        """Result versions for its usual shape, by model."""
        return self.usual.results

    @property
    def sizes(self) -> Mapping[str, float]:
        """Default sizes of its usual shape that differ from the defaults of the shape [m]."""
        return self.usual.sizes

    def variant_in(self, *, solid: bool) -> Variant | None:
        """Return the first variant in 2D or 3D, or None."""
        found = (one for shape, one in self.variants.items() if is_solid(shape) == solid)
        return next(found, None)

    def variant_of(self, shape: str) -> Variant:
        """Return the variant for a shape, or else the first variant of the same dimension."""
        return self.variants.get(shape) or self.variant_in(solid=is_solid(shape)) or self.usual

    def models_of(self, shape: str) -> tuple[str, ...]:
        """Return the models for a shape."""
        return self.variant_of(shape).models

    def sizes_of(self, shape: str) -> Mapping[str, float]:
        """Return the default sizes of a shape that differ from the defaults of the shape [m]."""
        return self.variant_of(shape).sizes

    @property
    def starts_static(self) -> bool:
        """Whether a variant may start from the elastic solution."""
        return any(one.static_models for one in self.variants.values())

    @property
    def is_solve(self) -> bool:
        """Whether the test is a direct solve without steps."""
        return self.rig is Rig.NONE

    @property
    def settles(self) -> bool:
        """Whether the specimen settles under a pressure before the loading."""
        return not {Stage.CONFINE, Stage.PRESS}.isdisjoint(self.stages)
