# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs that determine a run: made of options, written to files, named by a key. SI units.

No heavy library is imported here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, fields, replace

from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table
from ..kinds.registry import ELASTIC, TESTS, kind_of
from ..materials.material import Material
from ..materials.mixing import description, is_brittle
from ..models.options import DAMPING
from ..require import require_known
from ..specimens.space.any_spec import SIZES, AnySpec, field_names, spec_of, spec_type
from .groups import OWN_OPTIONS
from .input_names import PACKING, SIMULATION, paced, shape_of
from .run_checks import require_shape, settle
from .run_inputs import RunInputs

__all__ = ["ELASTIC", "TESTS", "RunSpec"]

#: Entries of a described material on which no result depends.
LABELS = ("name", "made_for")
#: Options that follow from the test unless they are given.
_OF_TEST = ("start", "loading", "stop_ratio")
#: Number of the way in which keys are made. A field that gets another default needs another number:
#: keys leave defaults out.
SCHEMA = 1
#: Part of the results number of runs with cells that are no whole Laguerre cells; 1: their bonds
#: have the normals of the shared edges (D104).
_EDGE_NORMALS = 1
#: Part of the results number of runs that ``--dynamic`` gives real masses; 1: their loading is a
#: boundary condition, and no quasi-static plan sets velocities of grains.
_REAL_MASSES = 1
#: Part of the results number of runs of several minerals; 1: the loading rate follows their weakest
#: contacts, which was that of their mean.
_MINERALS = 1
#: Part of the results number of runs of 3D specimens; 1: contacts of rigid grains read the motions
#: of the grains, not those of their nodes, and the elastic start has another preconditioner. Both
#: change the rounding. 2: contact forces act between unbonded grains.
_SOLIDS = 2


@dataclass(frozen=True)
class RunSpec(RunInputs):
    """The inputs of a run, see `RunInputs`, checked and complete. Equal inputs have the same key.

    Raises:
        InputError: for a value out of range, or an option that the test does not use.
    """

    def __post_init__(self) -> None:
        settle(self)

    @classmethod
    def from_options(
        cls,
        test: str,
        options: Table,
        material: Material,
        specimen: AnySpec | None = None,
    ) -> RunSpec:
        """Describe the run of a specimen by options of the command.

        Args:
            test: Name of the test.
            options: Values by the names of ``input_names.OPTIONS``; None: the default. Other names,
                and sizes of a shape that the test does not have, are ignored.
            material: The material, including the changes that the options request.
            specimen: Description of an existing specimen; None: packed as the options state.

        Raises:
            InputError: for a value out of range.
        """
        given = {name: value for name, value in options.items() if value is not None}
        specimen = cls.packed(test, given) if specimen is None else specimen
        others = {name: given[name] for name in SIMULATION if name in given}
        return cls.asked(test, specimen, material, others)

    @classmethod
    def asked(
        cls, test: str, specimen: AnySpec, material: Material, options: Mapping[str, object]
    ) -> RunSpec:
        """Describe a run by its options only.

        Args:
            test: Name of the test.
            specimen: Description of the specimen.
            material: The material, with all changes.
            options: Values by the names of ``input_names.SIMULATION``. A missing option has its
                default. If None, an option that follows from the test has its default, too.

        Raises:
            InputError: for another name, or a value out of range.
        """
        given = {
            name: value
            for name, value in options.items()
            if value is not None or name not in _OF_TEST
        }
        given.setdefault("stop_ratio", kind_of(test).stop_ratio)
        model = str(given.get("model", cls.model))
        return cls(test, specimen, described(material, model), **split(given))

    @staticmethod
    def packed(test: str, options: Table) -> AnySpec:
        """Return the packed specimen that options of the command describe for a test."""
        kind = kind_of(test)
        shape = shape_of(test, options.get("shape"), options.get("depth"))
        if is_solid(shape):
            require_shape(kind, shape)
        known = set(field_names(shape))
        packing = [name for name in PACKING if name in known]
        given = {name: options.get(name) for name in (*SIZES[shape], *packing)}
        given |= {
            one.size: options.get(one.name) or given[one.size] for one in kind.options if one.size
        }
        made = shape if is_solid(shape) else kind.shape
        spec = spec_type(shape)(made, **{**kind.sizes_of(made), **_named(given)})
        spec.require_memory()
        return spec

    @classmethod
    def from_json(cls, content: Table) -> RunSpec:
        """Read the content that ``to_json`` has written; a missing field has its default.

        Raises:
            InputError: for an unknown or missing field or a value out of range.
        """
        for name in ("test", "specimen", "material"):
            if name not in content:
                raise InputError(f"inputs {name} is missing; give result.json of the run")
        plain = _known([*_FIELDS, *OWN_OPTIONS], content)
        test = plain["test"]
        dynamic = isinstance(test, str) and kind_of(test).dynamic
        if plain.get("dynamic") and not dynamic:
            plain.setdefault("damping", DAMPING)  # of a run before it could be chosen
        given = plain["specimen"]
        parts = field_names(given.get("kind") if isinstance(given, Mapping) else None)
        plain["specimen"] = spec_of(_known(parts, given))
        return cls(**split(plain))

    @property
    def results(self) -> int:
        """Version number of the results, see ``results_number``."""
        return results_of(self)

    def key(self, results: int | None = None) -> str:
        """Return the name of the run: a short hash of all values that differ from the defaults.

        Two runs have the same key if their results must be equal. The version of flexpm does not
        count, and an option that did not exist yet does not count either.

        Args:
            results: Version number of the results; None: the present number.
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
        """Return the keys of the run under earlier numbers of the results, or earlier defaults.

        The default loading was adaptive at first. Later it was constant for brittle contacts.
        """
        keys = [self.key(number) for number in range(1, self.results)]
        if self.adapts and self.loading == self.default_loading:
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


def results_number(
    test: str,
    model: str,
    *,
    solid: bool = False,
    edge_normals: bool = False,
    dynamic: bool = False,
    minerals: bool = False,
) -> int:
    """Return the version number of the results of a test and model.

    It is the sum of the number of the test and model and of the numbers of optional features. The
    sum increases when any of these numbers increases.

    Args:
        test: Name of the test.
        model: Name of the model.
        solid: Whether the specimen is 3D.
        edge_normals: Whether its bonds have the normals of edges, see ``RunInputs``.
        dynamic: Whether ``--dynamic`` requests real masses.
        minerals: Whether its grains have several minerals, whose weakest contacts fix the rate.
    """
    kind = kind_of(test)
    variant = kind.variant_in(solid=solid)
    number = 1 if variant is None else variant.results.get(model, 1)
    number += _EDGE_NORMALS * edge_normals + _REAL_MASSES * dynamic + _MINERALS * minerals
    return number + _SOLIDS * solid


def results_of(run: RunInputs) -> int:
    """Return the version number of the results of a run, see ``results_number``."""
    return results_number(
        run.test,
        run.model,
        solid=run.is_solid,
        edge_normals=run.has_edge_normals,
        dynamic=run.dynamic and not run.kind.dynamic,
        minerals=bool(run.material.get("minerals")),
    )


def described(material: Material, model: str) -> Table:
    """Return name and calibration of a material and its parameters in effect for a model."""
    made_for = material.made_for
    calibrated = {} if made_for is None else {"made_for": made_for.to_dict()}
    return {"name": material.name, **calibrated, **description(material, model)}


def law_of(material: Table) -> Table:
    """Return the part of a described material that results depend on."""
    return {key: value for key, value in material.items() if key not in LABELS}


def _named(values: Table) -> Table:
    return {name: value for name, value in values.items() if value is not None}


def _changes(spec: RunSpec | AnySpec) -> Table:
    """Return the fields whose value differs from their default."""
    values = {field.name: (getattr(spec, field.name), field.default) for field in fields(spec)}
    nested = ("specimen", "material", "own", "source")  # a source names where grains come from
    own = spec.own if isinstance(spec, RunSpec) else {}
    if not isinstance(spec, RunSpec) and is_solid(spec.kind):
        own = {"kind": spec.kind}  # also the default one: no key of the plane's
    return {
        **own,
        **{
            name: value
            for name, (value, default) in values.items()
            if name not in nested and value is not None and value != default
        },
    }


def _material_changes(material: Table) -> Table:
    """Return the parameters whose value differs from a material's default; labels do not count."""
    defaults = {field.name: field.default for field in fields(Material)}
    found: Table = {}
    for key, value in law_of(material).items():
        if key == "minerals":
            found[key] = [_material_changes(mineral) for mineral in value]
        elif value is not None and value != defaults.get(key, MISSING):
            found[key] = value
    return found


def _known(names: Sequence[str], content: object) -> Table:
    if not isinstance(content, Mapping):
        raise InputError(f"inputs = {content!r}, must be a table; give result.json of a run")
    for name in content:
        require_known("inputs", name, names)
    return dict(content)


#: Names of the fields of a run, but that of options that are none.
_FIELDS = tuple(field.name for field in fields(RunSpec) if field.name != "own")


def split(values: Table) -> Table:
    """Return arguments of ``RunSpec`` from values by the names of fields and of tests' options."""
    if "rate" in values:
        rate, halvings = paced(values["rate"], values.get("halvings"))
        values = {**values, "rate": rate, "halvings": halvings}
    own = {name: value for name, value in values.items() if name not in (*_FIELDS, "own")}
    return {**{name: value for name, value in values.items() if name not in own}, "own": own}
