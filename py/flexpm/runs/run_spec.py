# SPDX-License-Identifier: GPL-3.0-or-later
"""What determines a run, as plain values: checked, written to files, named by a key. SI units.

Nothing heavy is loaded here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, asdict, dataclass, fields, replace
from numbers import Number
from typing import NoReturn

from ..errors import InputError
from ..files import Table
from ..kinds.option import Asked, Value
from ..kinds.registry import ELASTIC, KINDS, TESTS, kind_of, names, options
from ..kinds.test_kind import STOP_RATIO, TestKind
from ..materials.joint import require_joints
from ..materials.material import Material
from ..materials.mixing import description, is_brittle
from ..models.options import (
    DAMPING,
    GRAIN_MODELS,
    INNER_MODELS,
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
from ..specimens.spec import SIZES, SpecimenSpec
from .loading_rate import LARGEST_STOP_RATIO, LOADINGS, RATE, WAITING_MODELS

__all__ = ["ELASTIC", "TESTS", "RunSpec"]

#: Number of the way in which keys are made. A field that gets another default needs another number:
#: keys leave defaults out.
SCHEMA = 1
#: ``rest``: unloaded, with the velocities of the elastic solution; ``static``: at that solution,
#: where the first contact point is about to leave its elastic branch.
STARTS = ("rest", "static")

#: Sizes of all shapes.
_SIZES = tuple(dict.fromkeys(name for sizes in SIZES.values() for name in sizes))


def _unused(kind: TestKind) -> tuple[str, ...]:
    """Options that a test has no use for."""
    others = [name for name in options() if not kind.has(name)]
    renamed = [one.size for one in kind.options if one.size]
    sizes = [name for name in _SIZES if name not in SIZES[kind.shape] or name in renamed]
    pressure = () if kind.confined else ("confinement",)
    start = () if kind.static_models else ("start",)
    return tuple(dict.fromkeys((*sizes, *pressure, *start, *kind.without, *others)))


#: Options that a test has no use for.
UNUSED = {name: _unused(kind) for name, kind in KINDS.items()}
#: Units of inputs that have one.
INPUT_UNITS = {
    **dict.fromkeys((*_SIZES, "thickness", "diameters"), "m"),
    **{name: one.unit for name, of in options().items() for one in of.values() if one.unit},
    "confinement": "Pa",
    "gravity": "m/s2",
}
#: Inputs that tests have all the same, or that have rules of their own.
_ALWAYS = ("start", "loading", "confinement")
#: Ranges beyond which sums are no numbers, or no test has a sense.
_STRAIN = Bounds(above=0.0, at_least=1e-12, at_most=1e6)
_PRESSURE = Bounds(at_least=0.0, at_most=1e15)
_GRAVITY = Bounds(at_least=0.0, at_most=1e12)
PACKING = ("thickness", "diameters", "porosity", "seed")
#: Options of a run that not all tests have, and those that are other names of sizes.
OWN_OPTIONS = tuple(name for name, of in options().items() if not any(o.size for o in of.values()))
_OTHER_NAMES = tuple(name for name in options() if name not in OWN_OPTIONS)
_SIMULATION = (
    *("model", "points", "mesh", "confinement", "rate", "max_strain", "stop_ratio"),
    *("dynamic", "gravity", "damping", "start", "loading"),
    *OWN_OPTIONS,
    "interaction_range",
)
#: Options that are sizes of the specimen.
SIZE_NAMES = (*_SIZES, *_OTHER_NAMES)
#: Options of the command by their names.
OPTIONS = (*SIZE_NAMES, *PACKING, *_SIMULATION)


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
        span: As this and the next ones are of the tests that have them, see ``kinds``; None for
            other tests.
        notch: Depth [m].
        normal_stress: On the specimen [Pa].
        max_displacement: At which the test ends [m]; None for a multiple of that at its reference
            strength.
        wave: Name of the wave.
        control: What grows at the rate; None: the way of the ends.
        damping: Local damping alpha [-] of the loading; None: 0.7, as always before it could be
            chosen. With real masses it is 0 unless it is given; a specimen is settled under its
            confinement with 0.7 at least. None for tests that have none.
        interaction_range: Multiple of the sum of both radii up to which YADE's spheres are bonded
            [-]; None: only neighbours, and for other models.
        own: Options of the test that are no fields, by their names.
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
    own: Mapping[str, Value] = dataclasses.field(default_factory=dict)

    def __post_init__(self) -> None:
        require_one_of("run: test", self.test, tuple(KINDS))
        self._check_unused()
        if self.kind.dynamic:
            self._set("dynamic", True)
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
        self._settle_own()
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
        others.setdefault("stop_ratio", kind_of(test).stop_ratio)
        model = others.get("model", cls.model)
        return cls(test, specimen, described(material, model), **split(others))

    @staticmethod
    def packed(test: str, options: Table) -> SpecimenSpec:
        """The packed specimen that options of the command describe for a test."""
        kind = kind_of(test)
        given = {name: options.get(name) for name in (*SIZES[kind.shape], *PACKING)}
        given |= {
            one.size: options.get(one.name) or given[one.size] for one in kind.options if one.size
        }
        named = {name: value for name, value in given.items() if value is not None}
        return SpecimenSpec(kind.shape, **{**kind.sizes, **named})

    @classmethod
    def from_json(cls, content: Table) -> RunSpec:
        """Read what ``to_json`` gave; a field that is missing has its default.

        Raises:
            InputError: for an unknown or missing field or a value out of range.
        """
        for name in ("test", "specimen", "material"):
            if name not in content:
                raise InputError(f"inputs {name} is missing; give that of the run")
        plain = _known([*_FIELDS, *OWN_OPTIONS], content)
        test = plain["test"]
        dynamic = isinstance(test, str) and kind_of(test).dynamic
        if plain.get("dynamic") and not dynamic:
            plain.setdefault("damping", DAMPING)  # of a run before it could be chosen
        parts = [field.name for field in fields(SpecimenSpec)]
        plain["specimen"] = SpecimenSpec(**_known(parts, plain["specimen"]))
        return cls(**split(plain))

    def to_json(self) -> Table:
        """All fields as JSON has them, the test's own options beside them: no tuples."""
        plain = asdict(self)
        own = plain.pop("own")
        content: Table = json.loads(json.dumps({**plain, **own}, allow_nan=False))
        return content

    @property
    def kind(self) -> TestKind:
        """The test."""
        return kind_of(self.test)

    @property
    def options(self) -> dict[str, Value]:
        """Options that not all tests have, by name; None for what is not given."""
        return {
            one.name: self.own.get(one.name, getattr(self, one.name, None))
            for one in self.kind.options
            if not one.size
        }

    @property
    def pressure(self) -> float:
        """What a stage that presses puts on [Pa]."""
        options = {"confinement": self.confinement, **self.options}
        value = options[self.kind.pressure]
        return float(value) if isinstance(value, float | int) else 0.0

    @property
    def results(self) -> int:
        """Number of the results, see ``results_number``."""
        return results_number(self.test, self.model)

    @property
    def local_damping(self) -> float:
        """Local damping of the loading [-]."""
        return local_damping(self.damping, dynamic=self.kind.dynamic)

    @property
    def settling_damping(self) -> float:
        """Local damping under which the specimen comes to rest before it is loaded [-]."""
        return max(self.local_damping, DAMPING if self.kind.settles else 0.0)

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
        return self.model in GRAIN_MODELS and not self.dynamic and not self.kind.is_solve

    @property
    def _default_loading(self) -> str:
        if not self._adapts:
            return "constant"
        if self.model in WAITING_MODELS:
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
            if not usual and not (name == "dynamic" and self.kind.dynamic):
                self._refuse(name, value)
        for name, value in self.own.items():
            require_known("run: option", name, OWN_OPTIONS)
            if value is not None and not self.kind.has(name):
                self._refuse(name, value)

    def _refuse(self, name: str, value: object) -> NoReturn:
        raise InputError(f"run: {with_unit(name, value)}, must not be given for {self.test}")

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
            first = self.kind.static_first and self.model in self.kind.static_models
            static = first and not self.dynamic and self.specimen.joints is None
            self._set("start", "static" if static else "rest")
        require_one_of("run: start", self.start, STARTS)
        if self.start == "static" and self.model not in self.kind.static_models:
            tests = names(lambda kind: bool(kind.static_models))
            raise InputError(
                f"run: start = static, must be rest for {self.test} of model {self.model}; static "
                f"needs the flexible model and {' or '.join(tests)}"
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
        if self.model not in WAITING_MODELS:
            raise InputError(
                f"run: loading = waiting, must be adaptive or constant for model {self.model}; "
                f"waiting is for {' and '.join(WAITING_MODELS)} grains"
            )

    def _check_test(self) -> None:
        label = "run: model" if self.kind.is_solve else f"run: model of {self.test}"
        require_one_of(label, self.model, self.kind.models)
        if self.model in SPHERE_MODELS:
            self.specimen.require_discs(self.model)
        if self.model in INNER_MODELS:
            self.specimen.require_alike(self.model)
        laws = [joint["name"] for joint in self.material.get("joints", ())]
        require_joints(self.specimen.joint_names or (), laws)
        shape = self.kind.shape
        if self.specimen.kind != shape:
            raise InputError(
                f"run: specimen = {self.specimen.kind}, must be a {shape} for {self.test}"
            )
        if not self.kind.confined and self.confinement != 0.0:
            raise InputError(
                f"run: confinement = {self.confinement} Pa, must be 0 for {self.test}"
                f"{self.kind.confine_hint}"
            )

    def _settle_own(self) -> None:
        """Check and complete the options that not all tests have."""
        if not self.kind.options:
            return
        sizes, packed = self.specimen.sizes, self.specimen.diameters
        diameter = None if packed is None else float(sum(packed)) / 2.0
        given = self.options
        found = {**given, **self.kind.settle(Asked(self.test, sizes, given, diameter))}
        for name in given.keys() & _FIELDS:
            self._set(name, found.pop(name))
        self._set("own", {name: value for name, value in found.items() if value is not None})

    def _check_control(self) -> None:
        if self.control is None:
            return
        controls = tuple(self.kind.controls)
        require_one_of("run: control", self.control, controls)
        first = controls[0]
        if self.control == first:
            self._set("control", None)
        elif self.model not in WAITING_MODELS or self.dynamic:
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


def with_unit(name: str, value: object) -> str:
    """An input and its value with its unit, for a message."""
    shown = value if isinstance(value, str) and len(value) < 80 else quoted(value)
    return f"{name} = {shown} {INPUT_UNITS.get(name, '')}".rstrip()


def results_number(test: str, model: str) -> int:
    """Number that tells results of a test and model from those before they changed."""
    return kind_of(test).results.get(model, 1)


def models_of(test: str) -> tuple[str, ...]:
    """Models that a test is for."""
    return kind_of(test).models


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
    return kind_of(test).shape


def described(material: Material, model: str) -> Table:
    """Name of a material and its parameters in effect for a model; those of minerals, too."""
    return {"name": material.name, **description(material, model)}


def _changes(spec: RunSpec | SpecimenSpec) -> Table:
    """Fields that have another value than their default."""
    values = {field.name: (getattr(spec, field.name), field.default) for field in fields(spec)}
    nested = ("specimen", "material", "own")
    own = spec.own if isinstance(spec, RunSpec) else {}
    return {
        **own,
        **{
            name: value
            for name, (value, default) in values.items()
            if name not in nested and value is not None and value != default
        },
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


def _known(names: Sequence[str], content: object) -> Table:
    if not isinstance(content, Mapping):
        raise InputError(f"inputs = {content!r}, must be fields by name")
    for name in content:
        require_known("inputs", name, names)
    return dict(content)


#: Names of the fields of a run, but that of options that are none.
_FIELDS = tuple(field.name for field in fields(RunSpec) if field.name != "own")


def split(values: Table) -> Table:
    """Arguments of ``RunSpec`` from values by the names of its fields and of tests' options."""
    own = {name: value for name, value in values.items() if name not in (*_FIELDS, "own")}
    return {**{name: value for name, value in values.items() if name not in own}, "own": own}
