# SPDX-License-Identifier: GPL-3.0-or-later
"""What determines a run, as plain values: checked, written to files, named by a key. SI units.

Nothing heavy is loaded here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, asdict, dataclass, fields, replace
from numbers import Number

from ..errors import InputError
from ..files import Table
from ..materials.joint import require_joints
from ..materials.material import Material
from ..materials.mixing import description, is_brittle
from ..models.options import (
    DAMPING,
    GRAIN_MODELS,
    INNER_MODELS,
    MODELS,
    SPHERE_MODELS,
    check_options,
    local_damping,
)
from ..require import (
    Bounds,
    quoted,
    require_flag,
    require_known,
    require_number,
    require_one_of,
)
from ..results.toughness import require_half_disc, require_span
from ..specimens.space.spec import refuse_solid
from ..specimens.spec import SIZES, SpecimenSpec
from .loading_rate import (
    LARGEST_STOP_RATIO,
    LOADINGS,
    RATE,
    RUNNING_SHARE,
    STOP_RATIO,
    default_stop_ratio,
)

#: Number of the way in which keys are made. A field that gets another default needs another number:
#: keys leave defaults out.
SCHEMA = 1
#: Tests that are simulated.
_ENDS_TESTS = ("uniaxial", "tension", "biaxial", "brazilian")
#: Of these the ones held and loaded by parts: supports, boxes. They are for ``PART_MODELS``.
PART_TESTS = ("bending", "scb", "shear")
#: A pulse through a rectangle, with real masses and without damping; for ``PART_MODELS``.
SONIC = "sonic"
TESTS = (*_ENDS_TESTS, *PART_TESTS, SONIC)
#: Waves of ``sonic``: along the height, and across it.
WAVES = ("p", "s")
#: What may grow at the loading rate by test, the way of the ends first; the others make the ends go
#: as they must, and are for ``PART_MODELS`` with scaled masses.
CONTROLS = {
    "uniaxial": ("axial", "lateral"),
    "bending": ("displacement", "cmod"),
    "scb": ("displacement", "cmod"),
}
#: Column of the record that each of the others is.
MEASURES = {"lateral": "lateral_strain", "cmod": "cmod"}
#: Of these the ones between supports, with a notch.
_NOTCHED = ("bending", "scb")
#: Models that parts hold.
PART_MODELS = ("flexible", "rigid")
#: Numbers of the results by test and model; 1 for those that have never changed. A commit that
#: changes a hash of a reference command (scripts/checks/reference.py) raises the number of its test
#: and model; runs of these that were finished before get other keys and are done again.
RESULTS: dict[tuple[str, str], int] = {
    **{(test, model): 2 for test in _ENDS_TESTS for model in SPHERE_MODELS},
    # discs of other places, the same on all machines
    **{("brazilian", model): 2 for model in GRAIN_MODELS},
    **{("brazilian", model): 3 for model in SPHERE_MODELS},
    # 3: contacts keep their numbers, other ones in cracks.csv once discs have come to touch
    **{("biaxial", model): 3 for model in GRAIN_MODELS},
    ("uniaxial", "inner"): 2,
    # after the peak damping leaves alone what moves steadily
    **{(test, model): 3 for test in ("uniaxial", "tension") for model in ("flexible", "rigid")},
    ("uniaxial", "rigid"): 4,
    **{("biaxial", model): 5 for model in ("flexible", "rigid")},
    **{("brazilian", model): 3 for model in ("flexible", "rigid")},
    # cosines that are the same on all machines: of half a disc's arc, and of a pulse
    **{(test, model): 2 for test in ("scb", SONIC) for model in ("flexible", "rigid")},
    ("scb", "flexible"): 3,  # half the rate
    # a pressure is balanced once reactions and mean stress are; grains that come loose bear none
    **{("biaxial", model): 4 for model in INNER_MODELS},
    **{("biaxial", model): 3 for model in SPHERE_MODELS},
    **{("biaxial", model): 6 for model in ("flexible", "rigid")},
    **{("shear", model): 2 for model in ("flexible", "rigid")},
    # the free descent has a bound, damping's work has two columns, the elastic start is work
    **{(test, model): 4 for test in ("tension", "brazilian") for model in ("flexible", "rigid")},
    **{("uniaxial", "flexible"): 4, ("uniaxial", "rigid"): 5},
    **{("scb", "flexible"): 4, ("scb", "rigid"): 3},
    **{("bending", model): 2 for model in ("flexible", "rigid")},
    **{("tension", model): 2 for model in INNER_MODELS},
    **{("brazilian", model): 3 for model in INNER_MODELS},
    **{("uniaxial", "inner"): 3, ("uniaxial", "inner-un"): 2},
}

#: The direct solve of a rectangle, which is no simulation.
ELASTIC = "elastic"
#: ``rest``: unloaded, with the velocities of the elastic solution; ``static``: at that solution,
#: where the first contact point is about to leave its elastic branch.
STARTS = ("rest", "static")

#: Options that only some tests have, which need no default in others.
_OWN = {
    "length": ("bending",),
    **dict.fromkeys(("span", "notch"), _NOTCHED),
    **dict.fromkeys(("normal_stress", "max_displacement"), ("shear",)),
    "wave": (SONIC,),
    "control": tuple(CONTROLS),
}
_UNUSED: dict[str, tuple[str, ...]] = {
    "uniaxial": ("diameter", "confinement"),
    "tension": ("diameter", "confinement"),
    "biaxial": ("diameter", "start"),
    "brazilian": ("width", "height", "confinement", "start"),
    "bending": ("width", "diameter", "confinement", "start"),
    "shear": ("diameter", "confinement", "start", "stop_ratio", "max_strain"),
    "scb": ("width", "height", "confinement", "start"),
    **dict.fromkeys(
        (SONIC, ELASTIC),
        (
            *("diameter", "confinement", "rate", "max_strain", "stop_ratio"),
            *("dynamic", "gravity", "damping", "start", "loading"),
        ),
    ),
}
#: Options that a test has no use for.
UNUSED: dict[str, tuple[str, ...]] = {
    test: (*unused, *(name for name, tests in _OWN.items() if test not in tests))
    for test, unused in _UNUSED.items()
}
#: What serves a user who wants a confinement of other tests than biaxial.
PRESSED = {
    **dict.fromkeys(("uniaxial", "tension"), "; use biaxial"),
    "shear": "; give normal_stress, a run for each",
}
#: Units of inputs that have one.
INPUT_UNITS = {
    **dict.fromkeys(("width", "height", "length", "diameter", "thickness", "diameters"), "m"),
    **dict.fromkeys(("span", "notch", "max_displacement"), "m"),
    **dict.fromkeys(("confinement", "normal_stress"), "Pa"),
    "gravity": "m/s2",
}
#: Inputs that tests have all the same, or that have rules of their own.
_ALWAYS = ("start", "loading", "confinement")
#: Sizes of a test's specimen that are others than those of its shape [m].
_OTHER_SIZES: dict[str, dict[str, float]] = {
    "bending": {"width": 0.18, "height": 0.04},
    "shear": {"width": 0.08, "height": 0.04},
}
#: Span of a beam over its height, and at most over its length, unless it is given [-].
_SPAN, _LARGEST_SPAN = 4.0, 8.0 / 9.0
#: The same of half a disc over its diameter, and its notch over its radius [-].
_SCB_SPAN, _SCB_NOTCH = 0.6, 0.5
#: On the upper half in direct shear, unless it is given [Pa].
NORMAL_STRESS = 1e6
#: Length of a pulse over the height that it goes through [-], deviation D48.
PULSE = 0.4
#: Least length of a pulse in mean diameters of the grains [-].
_FEWEST_GRAINS = 20.0
#: Ranges beyond which sums are no numbers, or no test has a sense.
_STRAIN = Bounds(above=0.0, at_least=1e-12, at_most=1e6)
_PRESSURE = Bounds(at_least=0.0, at_most=1e15)
_GRAVITY = Bounds(at_least=0.0, at_most=1e12)
PACKING = ("thickness", "diameters", "porosity", "seed")
_SIMULATION = (
    *("model", "points", "mesh", "confinement", "rate", "max_strain", "stop_ratio"),
    *("dynamic", "gravity", "damping", "start", "loading", "span", "notch"),
    *("normal_stress", "max_displacement"),
    *("wave", "control", "interaction_range"),
)
#: Fields that options of the command set, by their names.
OPTIONS = (*SIZES["rectangle"], "length", *SIZES["disc"], *PACKING, *_SIMULATION)


@dataclass(frozen=True)
class RunSpec:
    """All that determines a run. What it runs on, threads and folders, is no part of it.

    A field that is added later has a default that stands for the runs of before; then no key
    changes. Start and loading follow from test and model unless they are given.

    Attributes:
        test: One of ``TESTS``, or ``ELASTIC``.
        specimen: What the specimen is made from.
        material: Its ``name`` and the parameters in effect for the model, see ``described``.
        model: Name of the model.
        points: Contact points per contact.
        mesh: Triangles in each grain, ``refined`` or ``fan``.
        confinement: Lateral pressure [Pa].
        rate: Factor on the default loading rate [-].
        max_strain: Axial strain at which the test ends [-]; None for a multiple of that of the
            reference strength.
        stop_ratio: Part of its peak to which the stress falls before the test ends [-].
        dynamic: Real masses and time instead of scaled masses and unit steps.
        gravity: Acceleration downwards [m/s2].
        start: How the loading begins, one of ``STARTS``; empty: ``static`` for tension of the
            flexible model with scaled masses, else ``rest``.
        loading: How the loading goes on, one of ``LOADINGS``; empty: ``waiting`` for flexible and
            rigid grains with scaled masses, ``adaptive`` for inner particles unless contacts are
            brittle, else ``constant``.
        span: Distance of the supports [m] of ``bending``; None: four times the height, or
            8/9 of the length if that is less; and of ``scb``; None: 0.6 of the diameter. None for
            other tests.
        notch: Depth of the notch in the middle [m] of a beam; 0: none; and of ``scb``; None: half
            of the radius. None for other tests.
        normal_stress: On the upper half of a ``shear`` test [Pa]; None: 1 MPa, and none for others.
        max_displacement: Of the lower half of a ``shear`` test, at which it ends [m]; None for a
            multiple of that at its reference strength, and for other tests.
        wave: Of ``sonic``, one of ``WAVES``; empty: ``p``. None for other tests.
        control: What grows at the rate, one of ``CONTROLS``; None: the way of the ends.
        damping: Local damping alpha [-] of the loading; None: 0.7, as always before it could be
            chosen. With real masses it is 0 unless it is given; a specimen is settled under its
            confinement with 0.7 at least. None for ``sonic``, which has none, and ``elastic``.
        interaction_range: Of YADE's spheres, up to which multiple of the sum of their radii they
            are bonded [-]; None: only neighbours, and for other models.
    """

    test: str
    specimen: SpecimenSpec
    material: Table
    model: str = "flexible"
    points: int = 3
    mesh: str = "refined"
    confinement: float = 0.0
    rate: float = 1.0
    max_strain: float | None = None
    stop_ratio: float = STOP_RATIO
    dynamic: bool = False
    gravity: float = 0.0
    start: str = ""
    loading: str = ""
    span: float | None = None
    notch: float | None = None
    normal_stress: float | None = None
    max_displacement: float | None = None
    wave: str | None = None
    control: str | None = None
    damping: float | None = None
    interaction_range: float | None = None

    def __post_init__(self) -> None:
        require_one_of("run: test", self.test, (*TESTS, ELASTIC))
        refuse_solid("run", self.specimen)
        self._check_unused()
        self._check_wave()
        self._check_numbers()
        check_options(
            self.model,
            points=self.points,
            mesh=self.mesh,
            dynamic=self.dynamic,
            gravity=self.gravity,
            interaction_range=self.interaction_range,
        )
        self._check_start()
        self._check_loading()
        self._check_test()
        self._check_beam()
        self._check_shear()
        self._check_control()
        self._check_damping()
        self._set("points", int(self.points))
        self._set("material", dict(self.material))

    @classmethod
    def from_options(
        cls,
        test: str,
        options: Table,
        material: Material,
        specimen: SpecimenSpec | None = None,
    ) -> RunSpec:
        """Describe the run of a specimen by options of the command.

        Args:
            test: Name of the test.
            options: Values by the names of ``OPTIONS``; None stands for the default. Other names,
                and sizes of another shape than that of the test, are not looked at.
            material: The material, with the changes that the options ask for.
            specimen: A specimen that is there already; None: packed as the options say.

        Raises:
            InputError: for a value out of range.
        """
        given = {name: value for name, value in options.items() if value is not None}
        specimen = cls.packed(test, given) if specimen is None else specimen
        others = {name: given[name] for name in _SIMULATION if name in given}
        others.setdefault("stop_ratio", default_stop_ratio(test))
        model = others.get("model", cls.model)
        return cls(test, specimen, described(material, model), **others)

    @staticmethod
    def packed(test: str, options: Table) -> SpecimenSpec:
        """The packed specimen that options of the command describe for a test."""
        shape = shape_of(test)
        given = {name: options.get(name) for name in (*SIZES[shape], *PACKING)}
        if test == "bending" and options.get("length") is not None:
            given["width"] = options["length"]
        named = {name: value for name, value in given.items() if value is not None}
        return SpecimenSpec(shape, **_OTHER_SIZES.get(test, {}) | named)

    @classmethod
    def from_json(cls, content: Table) -> RunSpec:
        """Read what ``to_json`` gave; a field that is missing has its default.

        Raises:
            InputError: for an unknown or missing field or a value out of range.
        """
        for name in ("test", "specimen", "material"):
            if name not in content:
                raise InputError(f"inputs {name} is missing; give that of the run")
        plain = _known(cls, content)
        if plain.get("dynamic") and plain.get("test") != SONIC:
            plain.setdefault("damping", DAMPING)  # of a run before it could be chosen
        return cls(**plain | {"specimen": SpecimenSpec(**_known(SpecimenSpec, plain["specimen"]))})

    def to_json(self) -> Table:
        """All fields as JSON has them: no tuples, finite numbers."""
        content: Table = json.loads(json.dumps(asdict(self), allow_nan=False))
        return content

    @property
    def results(self) -> int:
        """Number of the results, see ``results_number``."""
        return results_number(self.test, self.model)

    @property
    def local_damping(self) -> float:
        """Local damping of the loading [-]."""
        return local_damping(self.damping, dynamic=self.test == SONIC)

    @property
    def settling_damping(self) -> float:
        """Local damping under which the specimen comes to rest before it is loaded [-]."""
        settles = self.test in ("biaxial", "shear")
        return max(self.local_damping, DAMPING if settles else 0.0)

    def key(self, results: int | None = None) -> str:
        """Name of the run: a short hash of what differs from the defaults.

        Two runs have one key if they must have the same results. Neither the version of flexpm nor
        an option that did not exist counts.

        Args:
            results: Number of the results; None for the present one.
        """
        content = {
            "schema": SCHEMA,
            "results": self.results if results is None else results,
            **_changes(self),
            "specimen": _changes(self.specimen),
            "material": _material_changes(self.material),
        }
        text = json.dumps(content, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def older_keys(self) -> list[str]:
        """Keys that the run had under earlier numbers of the results, or by an earlier default.

        Grains were loaded adaptively before, then those with brittle contacts at a constant rate.
        """
        keys = [self.key(number) for number in range(1, self.results)]
        if self._adapts and self.loading == self._default_loading:
            earlier = ("adaptive", "constant") if is_brittle(self.material) else ("adaptive",)
            before = [replace(self, loading=loading) for loading in earlier]
            numbers = range(1, self.results + 1)
            keys = [
                spec.key(number)
                for spec in before
                if spec.loading != self.loading
                for number in numbers
            ] + keys
        return keys

    @property
    def _adapts(self) -> bool:
        """Whether the loading can be another than constant."""
        return self.model in GRAIN_MODELS and not self.dynamic and self.test != ELASTIC

    @property
    def _default_loading(self) -> str:
        if not self._adapts:
            return "constant"
        if self.model in RUNNING_SHARE:
            return "waiting"
        # brittle contacts crack before damage takes work: an adaptive rate would fall too late
        return "constant" if is_brittle(self.material) else "adaptive"

    def _check_unused(self) -> None:
        """Refuse options that the test has no use for, unless they are as if not given."""
        for field in fields(self):
            name, value = field.name, getattr(self, field.name)
            if name in _ALWAYS or name not in UNUSED[self.test]:
                continue
            usual = value is None or (isinstance(value, Number | str) and value == field.default)
            if not usual and (name, self.test) != ("dynamic", SONIC):
                raise InputError(
                    f"run: {with_unit(name, value)}, must not be given for {self.test}"
                )

    def _check_numbers(self) -> None:
        self._set("rate", require_number("run: rate", self.rate, RATE))
        if self.max_strain is not None:
            largest = require_number("run: max_strain", self.max_strain, _STRAIN)
            self._set("max_strain", largest)
        bounds = Bounds(above=0.0, at_most=LARGEST_STOP_RATIO)
        self._set("stop_ratio", require_number("run: stop_ratio", self.stop_ratio, bounds))
        confinement = require_number("run: confinement", self.confinement, _PRESSURE, "Pa")
        self._set("confinement", confinement)
        gravity = require_number("run: gravity", self.gravity, _GRAVITY, "m/s2")
        self._set("gravity", gravity)
        self._set("dynamic", require_flag("run: dynamic", self.dynamic))

    def _check_start(self) -> None:
        if not self.start:
            tension = (self.test, self.model, self.dynamic) == ("tension", "flexible", False)
            static = tension and self.specimen.joints is None
            self._set("start", "static" if static else "rest")
        require_one_of("run: start", self.start, STARTS)
        possible = self.model == "flexible" and self.test in ("uniaxial", "tension")
        if self.start == "static" and not possible:
            raise InputError(
                f"run: start = static, must be rest for {self.test} of model {self.model}; static "
                "needs the flexible model and uniaxial or tension"
            )
        if self.start == "static" and self.specimen.joints is not None:
            raise InputError(
                "run: start = static, must be rest for a specimen with joints, which are not "
                "elastic; leave it out"
            )

    def _check_loading(self) -> None:
        if not self.loading:
            self._set("loading", self._default_loading)
        require_one_of("run: loading", self.loading, LOADINGS)
        if self.loading != "constant" and not self._adapts:
            raise InputError(
                f"run: loading = {self.loading}, must be constant for model {self.model}"
                f"{' with real masses' if self.dynamic else ''}; {self.loading} needs grains and "
                "scaled masses"
            )
        if self.loading == "waiting":
            self._check_waiting()

    def _check_waiting(self) -> None:
        if self.model not in RUNNING_SHARE:
            raise InputError(
                f"run: loading = waiting, must be adaptive or constant for model {self.model}; "
                f"waiting is for {' and '.join(RUNNING_SHARE)} grains"
            )

    def _check_test(self) -> None:
        if self.test == ELASTIC:
            require_one_of("run: model", self.model, GRAIN_MODELS)
        if self.test in (*PART_TESTS, SONIC):
            require_one_of(f"run: model of {self.test}", self.model, models_of(self.test))
        if self.model in SPHERE_MODELS:
            self.specimen.require_discs(self.model)
        if self.model in INNER_MODELS:
            self.specimen.require_alike(self.model)
        laws = [joint["name"] for joint in self.material.get("joints", ())]
        require_joints(self.specimen.joint_names or (), laws)
        shape = shape_of(self.test)
        if self.specimen.kind != shape:
            raise InputError(
                f"run: specimen = {self.specimen.kind}, must be a {shape} for {self.test}"
            )
        if self.test != "biaxial" and self.confinement != 0.0:
            raise InputError(
                f"run: confinement = {self.confinement} Pa, must be 0 for {self.test}"
                f"{PRESSED.get(self.test, '')}"
            )

    def _check_beam(self) -> None:
        if self.test == "scb":
            self._check_half_disc()
        if self.test != "bending":
            return
        width, height = self.specimen.width or 0.0, self.specimen.height or 0.0
        usual = min(_SPAN * height, _LARGEST_SPAN * width)
        span = usual if self.span is None else self.span
        bounds = Bounds(above=0.0, below=width)
        self._set("span", require_number("run: span", span, bounds, "m"))
        bounds = Bounds(at_least=0.0, below=height)
        self._set("notch", require_number("run: notch", self.notch or 0.0, bounds, "m"))
        require_span(self.span or 0.0, height, self.notch or 0.0)

    def _check_half_disc(self) -> None:
        diameter = self.specimen.diameter or 0.0
        span = _SCB_SPAN * diameter if self.span is None else self.span
        bounds = Bounds(above=0.0, below=diameter)
        self._set("span", require_number("run: span", span, bounds, "m"))
        notch = 0.5 * _SCB_NOTCH * diameter if self.notch is None else self.notch
        bounds = Bounds(at_least=0.0, below=0.5 * diameter)
        self._set("notch", require_number("run: notch", notch, bounds, "m"))
        require_half_disc(self.span or 0.0, 0.5 * diameter, self.notch or 0.0)

    def _check_shear(self) -> None:
        if self.test != "shear":
            return
        stress = NORMAL_STRESS if self.normal_stress is None else self.normal_stress
        bounds = Bounds(above=0.0, at_most=1e15)
        self._set("normal_stress", require_number("run: normal_stress", stress, bounds, "Pa"))
        if self.max_displacement is not None:
            bounds = Bounds(above=0.0, below=self.specimen.width)
            largest = require_number("run: max_displacement", self.max_displacement, bounds, "m")
            self._set("max_displacement", largest)

    def _check_wave(self) -> None:
        if self.test != SONIC:
            return
        self._set("wave", self.wave or WAVES[0])
        require_one_of("run: wave", self.wave, WAVES)
        self._set("dynamic", True)  # a wave in scaled masses has another speed
        if self.specimen.diameters is not None:
            require_pulse(self.specimen.height or 0.0, float(sum(self.specimen.diameters)) / 2.0)

    def _check_control(self) -> None:
        if self.control is None:
            return
        require_one_of("run: control", self.control, CONTROLS[self.test])
        first = CONTROLS[self.test][0]
        if self.control == first:
            self._set("control", None)
        elif self.model not in PART_MODELS or self.dynamic:
            raise InputError(
                f"run: control = {self.control}, must be {first} for model {self.model}"
                f"{' with real masses' if self.dynamic else ''}; it needs flexible or rigid grains "
                "and scaled masses"
            )
        elif self.start == "static":
            raise InputError(
                f"run: start = static, must be rest with control = {self.control}; leave it out"
            )

    def _check_damping(self) -> None:
        if "damping" in UNUSED[self.test]:
            return
        damping = local_damping(self.damping, dynamic=self.dynamic)
        self._set("damping", None if damping == DAMPING and not self.dynamic else damping)

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)


def require_pulse(height: float, diameter: float) -> None:
    """Refuse a specimen in which the pulse of ``sonic`` would be shorter than 20 grains.

    Args:
        height: Of the specimen [m].
        diameter: Mean of the grains [m].
    """
    grains = PULSE * height / diameter
    if not grains >= _FEWEST_GRAINS:
        raise InputError(
            f"run: wavelength = {grains:.3g} mean diameters of the grains, must be >= "
            f"{_FEWEST_GRAINS:g}: it is {PULSE:g} heights; take a height of "
            f"{_FEWEST_GRAINS / PULSE:g} diameters, or smaller grains"
        )


def with_unit(name: str, value: object) -> str:
    """An input and its value with its unit, for a message."""
    shown = value if isinstance(value, str) and len(value) < 80 else quoted(value)
    return f"{name} = {shown} {INPUT_UNITS.get(name, '')}".rstrip()


def results_number(test: str, model: str) -> int:
    """Number that tells results of a test and model from those before they changed."""
    return RESULTS.get((test, model), 1)


def models_of(test: str) -> tuple[str, ...]:
    """Models that a test is for."""
    if test == ELASTIC:
        return GRAIN_MODELS
    return PART_MODELS if test in (*PART_TESTS, SONIC) else MODELS


def takes_range(model: object) -> bool:
    """Whether a model can have an interaction range."""
    return model in SPHERE_MODELS


def ranges(models: Sequence[str], interaction_range: float | None) -> dict[str, float | None]:
    """Interaction range of each model; only YADE's spheres have one.

    Raises:
        InputError: if it is given and none of the models can have it.
    """
    if interaction_range is not None and not any(map(takes_range, models)):
        raise InputError(
            f"compare: interaction_range = {interaction_range}, must not be given for "
            f"{', '.join(models)}; it is for YADE's spheres"
        )
    return {model: interaction_range if takes_range(model) else None for model in models}


def shape_of(test: str) -> str:
    """Shape of the specimen that a test needs."""
    return {"brazilian": "disc", "scb": "half-disc"}.get(test, "rectangle")


def described(material: Material, model: str) -> Table:
    """Name of a material and its parameters in effect for a model; those of minerals, too."""
    return {"name": material.name, **description(material, model)}


def _changes(spec: RunSpec | SpecimenSpec) -> Table:
    """Fields that have another value than their default."""
    values = {field.name: (getattr(spec, field.name), field.default) for field in fields(spec)}
    nested = ("specimen", "material")
    return {
        name: value
        for name, (value, default) in values.items()
        if name not in nested and value is not None and value != default
    }


def _material_changes(material: Table) -> Table:
    """Parameters that have another value than a material's default; names do not count."""
    defaults = {field.name: field.default for field in fields(Material)}
    found: Table = {}
    for key, value in material.items():
        if key == "minerals":
            found[key] = [_material_changes(mineral) for mineral in value]
        elif key != "name" and value is not None and value != defaults.get(key, MISSING):
            found[key] = value
    return found


def _known(cls: type, content: object) -> Table:
    if not isinstance(content, Mapping):
        raise InputError(f"inputs = {content!r}, must be fields by name")
    for name in content:
        require_known("inputs", name, [field.name for field in fields(cls)])
    return dict(content)
