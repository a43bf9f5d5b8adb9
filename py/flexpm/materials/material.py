# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials: contact strengths and one elastic set per model, paper Tables 1, 2 and 7. SI units.

Inside the contact law tension and opening are positive; all strengths here are magnitudes.
"""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NotRequired, TypedDict

from ..errors import InputError
from ..files import Table, load_toml
from ..notebook import Shown
from ..require import (
    LENGTH,
    nearest,
    quoted,
    require_known,
    require_number,
    require_table,
    require_text,
)
from . import interface, joint, made_for, mineral
from .interface import Interface
from .joint import Joint
from .keys import (
    CHOICES,
    COMMON_KEYS,
    ELASTIC_KEYS,
    ELASTIC_SET,
    ENERGY_KEYS,
    RESIDUAL_KEYS,
    UNITS,
    check_residual,
    checked,
    elastic_set_name,
    is_used,
    scaled,
)
from .made_for import MadeFor
from .mineral import Mineral

#: Keys that a material may leave out.
_OPTIONAL = (*ENERGY_KEYS, *RESIDUAL_KEYS, "weibull")
#: A fracture energy this close to the elastic energy [relative] counts as equal: brittle.
ENERGY_TOLERANCE = 1e-12

#: Default presets for flexible grains and for the other models, by whether the specimen is 3D.
_DEFAULTS = {
    False: ("augig-table7", "augig-table2-bilinear"),
    True: ("augig3d-calibrated", "augig3d-calibrated-rigid"),
}
_PRESETS = Path(__file__).with_name("presets")


class Law(TypedDict):
    """Effective parameters of a material for one model; keys as in the TOML files."""

    young: float | None  #: [Pa]
    poisson: float | None  #: [-]
    normal_stiffness: float  #: [Pa/m]
    shear_ratio: float  #: [-]
    density: float  #: [kg/m3]
    tensile_strength: float  #: [Pa]
    cohesion: float  #: [Pa]
    friction: float  #: [-]
    tensile_fracture_energy: float  #: [N/m]
    shear_fracture_energy: float  #: [N/m]
    residual_friction: NotRequired[float]  #: [-]; only if the material has it
    slip_length: NotRequired[float]  #: [m]; only if the material has it
    softening: str
    plane: str


@dataclass(frozen=True)
class ElasticSet:
    """Elastic properties of one model.

    The set ``flexible`` requires `young` and `poisson` of its triangles. In the set ``inner``,
    `young` and `poisson` are values of the rock: if they are given, the stiffness of the contacts
    is fitted to them.
    """

    normal_stiffness: float  #: K_n of the contacts [Pa/m]
    shear_ratio: float  #: eta = k_s / k_n of the contacts [-]
    young: float | None = None  #: Young's modulus of the triangles, or of the rock [Pa]
    poisson: float | None = None  #: Poisson's ratio of the triangles, or of the rock [-]


@dataclass(frozen=True)
class Material(Shown):
    """Contact strengths and elastic sets of a rock. All values are checked on construction.

    Example:
        >>> material = flexpm.Material.from_dict(
        ...     {
        ...         "tensile_strength": 8.5e6,
        ...         "cohesion": 29.75e6,
        ...         "friction": 0.5,
        ...         "density": 2650.0,
        ...         "softening": "brittle",
        ...         "elastic": {
        ...             "rigid": {"normal_stiffness": 20e12, "shear_ratio": 0.3},
        ...         },
        ...     },
        ...     "granite",
        ... )
        >>> material.law("rigid")["cohesion"]
        29750000.0
    """

    name: str
    elastic: Mapping[str, ElasticSet]  #: by name of the set: flexible, rigid, inner
    tensile_strength: float  #: sigma_t [Pa]
    cohesion: float  #: c [Pa]
    friction: float  #: mu, tangent of the friction angle [-]
    tensile_fracture_energy: float | None = None  #: G_fn [N/m], area under the whole curve
    shear_fracture_energy: float | None = None  #: G_fs [N/m]
    residual_friction: float | None = None  #: mu_r of a cracked point; None: mu does not fall [-]
    slip_length: float | None = None  #: slip since the crack at which mu_r is reached [m]
    softening: str = "bilinear"  #: bilinear or brittle
    density: float = 2650.0  #: [kg/m3], used by dynamic runs and by gravity
    plane: str = "stress"  #: plane stress or plane strain of the triangles
    weibull: float | None = None  #: modulus of the scatter of the strengths of contacts [-]
    minerals: tuple[Mineral, ...] = ()  #: kinds of grains; none: all grains alike
    joints: tuple[Joint, ...] = ()  #: laws of contacts along cuts
    interfaces: tuple[Interface, ...] = ()  #: what contacts of pairs of minerals have of their own
    made_for: MadeFor | None = None  #: specimens and model of its calibration; None: unknown

    def __post_init__(self) -> None:
        for key in COMMON_KEYS:
            value = getattr(self, key)
            if value is not None or key not in _OPTIONAL:
                object.__setattr__(self, key, checked(key, value))
        if not self.elastic:
            raise InputError(
                "material elastic = {}, has no set; add a table such as [elastic.flexible]"
            )
        sets = {name: _checked_set(name, chosen) for name, chosen in self.elastic.items()}
        object.__setattr__(self, "elastic", sets)
        if self.softening == "bilinear":
            for key in ENERGY_KEYS:
                if getattr(self, key) is None:
                    raise InputError(f"material {key} is missing; bilinear softening needs it")
        check_residual("material", vars(self))
        object.__setattr__(self, "minerals", mineral.checked(self.minerals))
        object.__setattr__(self, "joints", joint.checked(self.joints))
        names = [kind.name for kind in self.minerals]
        object.__setattr__(self, "interfaces", interface.checked(self.interfaces, names))
        object.__setattr__(self, "made_for", made_for.checked(self.made_for))

    @classmethod
    def from_dict(cls, data: Mapping[str, object], name: str = "custom") -> Material:
        """Build a material from nested keys as they are in a TOML file.

        Args:
            data: Common keys, a table `elastic` of sets, lists `mineral` and `interface` of tables
                if grains differ, and a table `joint` if there are joints; `name` and a table
                `made_for` are optional.
            name: Name if `data` has no name.

        Raises:
            InputError: for a key that is unknown, missing or out of range; the message names the
                key.
        """
        common: Table = require_table("material", data)
        label = require_text("material name", common.pop("name", name))
        sets = require_table("material elastic", common.pop("elastic", {}))
        kinds, cuts = common.pop("mineral", ()), common.pop("joint", {})
        pairs, calibrated = common.pop("interface", ()), common.pop("made_for", None)
        for key in common:
            tables = ("name", "elastic", "mineral", "interface", "joint", "made_for")
            require_known("material key", key, [*COMMON_KEYS, *tables])
        given = {set_name: _elastic_keys(set_name, values) for set_name, values in sets.items()}
        _refuse_missing(common, given)
        elastic = {set_name: ElasticSet(**values) for set_name, values in given.items()}
        laws = joint.checked(require_table("material joint", cuts))
        common |= {"minerals": kinds, "joints": laws, "interfaces": pairs, "made_for": calibrated}
        return cls(name=label, elastic=elastic, **common)

    def with_set(
        self,
        assignments: str | Iterable[str] | Mapping[str, object] = (),
        model: str = "flexible",
        **values: object,
    ) -> Material:
        """Return a copy with `KEY=VALUE` assignments applied; elastic keys change `model`'s set.

        Values may also be passed as a mapping or as keywords.

        ``MINERAL.KEY=VALUE`` changes a key of one mineral; a common key does not replace values
        that a mineral sets itself. ``joint.NAME.KEY=VALUE`` changes a key of a joint, or makes a
        joint. ``interface.MINERAL/MINERAL.KEY=VALUE`` and ``....factor.KEY=VALUE`` do the same for
        the contacts of a pair of minerals, in any order.

        Brittle softening removes fracture energies that came with the material, because the
        fracture energies of a brittle contact equal its elastic energies. If a stiffness or shear
        ratio of inner particles is set, the elastic constants to which it would be fitted are
        removed.

        A key that `model` does not use has no effect; a ``UserWarning`` names it.

        Raises:
            InputError: for a malformed assignment, an unknown key, or a value out of range.

        Example:
            >>> material = flexpm.materials.load("augig-table7").with_set("cohesion=20e6")
            >>> material.law()["cohesion"]
            20000000.0
        """
        changes: Table = {**_assigned(assignments), **_assigned(values)}
        for line in unused(changes, model):
            warnings.warn(line, stacklevel=2)
        changes = {key: value for key, value in changes.items() if _has_effect(key, model)}
        if not changes:
            return self
        name = elastic_set_name(model)
        of_joints = {key: changes.pop(key) for key in list(changes) if joint.is_key(key)}
        cuts = joint.with_values(self.joints, of_joints)
        of_pairs = {key: changes.pop(key) for key in list(changes) if interface.is_key(key)}
        names = [kind.name for kind in self.minerals]
        pairs = interface.with_values(self.interfaces, of_pairs, names)
        of_minerals = {key: changes.pop(key) for key in list(changes) if "." in key}
        kinds = mineral.with_values(self.minerals, of_minerals, name)
        elastic = dict(self.elastic)
        own: Table = {key: changes.pop(key) for key in ELASTIC_KEYS if key in changes}
        if name == "inner" and own.keys() & {"normal_stiffness", "shear_ratio"}:
            own = dict.fromkeys(("young", "poisson")) | own
        if own:
            elastic[name] = dataclasses.replace(self._elastic(model), **own)
        if changes.get("softening") == "brittle":
            changes = dict.fromkeys(ENERGY_KEYS) | changes
        changed = dataclasses.replace(
            self, elastic=elastic, minerals=kinds, joints=cuts, interfaces=pairs, **changes
        )
        changed.law(model)
        return changed

    def at_grain_size(self, mean_diameter: float) -> Material:
        """Return the material for grains of another mean diameter, by similarity.

        The ratio r is the mean diameter of ``made_for``, divided by the new mean diameter. The
        normal stiffness of all elastic sets, minerals and interfaces is multiplied by r, and their
        fracture energies and slip lengths are divided by r. Strengths, elastic constants of the
        grains, density and laws of joints do not change. If the lengths of a specimen change by the
        same factor as its grains, its elastic constants do not change, and neither do its stresses
        at the same strains. With real masses, times are proportional to the lengths. With gravity
        the stresses change. If the size of the specimen does not change, its elastic constants stay
        the same within the scatter of packings, but its strength may change, because the number of
        grains changes.

        Args:
            mean_diameter: Mean diameter of the grains [m].

        Raises:
            InputError: for a diameter that is not above 0, or a material without the mean diameter
                of its calibration.

        Example:
            >>> fine = flexpm.materials.load("augig-table7").at_grain_size(1.5e-3)
            >>> fine.law()["normal_stiffness"], fine.made_for.mean_diameter
            (360000000000000.0, 0.0015)
        """
        where = "Material.at_grain_size"
        diameter = require_number(f"{where}: mean_diameter", mean_diameter, LENGTH, "m")
        if self.made_for is None or self.made_for.mean_diameter is None:
            raise InputError(
                f"{where}: material {quoted(self.name)} has no mean grain diameter of its "
                "calibration, must have one; give made_for = {dimension, model, mean_diameter} in "
                "its file"
            )
        ratio = diameter / self.made_for.mean_diameter
        elastic = {
            name: ElasticSet(**scaled(vars(chosen), ratio)) for name, chosen in self.elastic.items()
        }
        lengths = {key: getattr(self, key) for key in (*ENERGY_KEYS, "slip_length")}
        return dataclasses.replace(
            self,
            elastic=elastic,
            minerals=tuple(one.scaled(ratio) for one in self.minerals),
            interfaces=tuple(one.scaled(ratio) for one in self.interfaces),
            made_for=dataclasses.replace(self.made_for, mean_diameter=diameter),
            **scaled(lengths, ratio),
        )

    def law(self, model: str = "flexible") -> Law:
        """Return the effective parameters of `model` as a flat dictionary, keys as in TOML files.

        For brittle softening the fracture energies are the elastic energies sigma_t^2 / (2 K_n)
        and c^2 / (2 eta K_n) [N/m] of the model's own elastic set.

        Raises:
            InputError: if the material has no set for `model` or no value that `model` requires, or
                if a fracture energy that `model` uses is below the elastic energy.
        """
        chosen = self._elastic(model)
        if model == "flexible":
            absent = [key for key in ("young", "poisson") if getattr(chosen, key) is None]
            if absent:
                raise InputError(
                    f"material [elastic.flexible] {' and '.join(absent)} is missing; triangles "
                    "need it"
                )
        tensile, shear = self.elastic_energies(model)
        law = Law(
            young=chosen.young,
            poisson=chosen.poisson,
            normal_stiffness=chosen.normal_stiffness,
            shear_ratio=chosen.shear_ratio,
            density=self.density,
            tensile_strength=self.tensile_strength,
            cohesion=self.cohesion,
            friction=self.friction,
            tensile_fracture_energy=self._energy("tensile_fracture_energy", tensile, model),
            shear_fracture_energy=self._energy("shear_fracture_energy", shear, model),
            softening=self.softening,
            plane=self.plane,
        )
        if self.residual_friction is not None and self.slip_length is not None:
            law["residual_friction"] = self.residual_friction
            law["slip_length"] = self.slip_length
        return law

    def joint_laws(self, model: str = "flexible") -> list[Table]:
        """Return the effective parameters of all joints for `model`, each with its name.

        Raises:
            InputError: as ``law``, or for a fracture energy below the elastic energy.
        """
        return [one.law({**self.law(model)}) for one in self.joints]

    def elastic_energies(self, model: str = "flexible") -> tuple[float, float]:
        """Return the energy of a contact point at its tensile and its shear strength [N/m]."""
        chosen = self._elastic(model)
        normal = chosen.normal_stiffness
        tensile = self.tensile_strength**2 / (2.0 * normal)
        return tensile, self.cohesion**2 / (2.0 * chosen.shear_ratio * normal)

    def _elastic(self, model: str) -> ElasticSet:
        name = elastic_set_name(model)
        if name not in self.elastic:
            raise InputError(
                f"material = {self.name!r} has no elastic set for model {model}; "
                f"add a table [elastic.{name}]"
            )
        return self.elastic[name]

    def _energy(self, key: str, elastic: float, model: str) -> float:
        given: float | None = getattr(self, key)
        if given is None:
            return elastic
        if not is_used(key, model):
            return given
        if self.softening == "brittle":
            if abs(given - elastic) > ENERGY_TOLERANCE * elastic:
                raise InputError(
                    f"material {key} = {given!r} N/m, brittle softening fixes it at the elastic "
                    f"energy {elastic!r} N/m; remove the key or use bilinear softening"
                )
        elif given < elastic * (1.0 - ENERGY_TOLERANCE):
            raise InputError(
                f"material {key} = {given!r} N/m, must not be below the elastic energy at the "
                f"peak; the smallest allowed value is {elastic!r} N/m"
            )
        return given


def default_name(model: str = "flexible", *, solid: bool = False) -> str:
    """Return the name of the preset that is used if no material is given.

    The preset of flexible grains has an elastic set for each model that takes such specimens.
    Models that are compared share this preset.

    Args:
        model: Name of the model.
        solid: Whether the specimen is 3D.
    """
    solid = solid and not model.startswith("inner")  # 2D only: a run of a solid rejects it
    return _DEFAULTS[solid][made_for.stand_in(model) != "flexible"]


def unused(keys: Iterable[str], model: str) -> list[str]:
    """Return a line for each key of an assignment that has no effect on a model."""
    return [
        f"set {key} has no effect, model {model} does not use it"
        for key in keys
        if not _has_effect(key, model)
    ]


def preset_names() -> list[str]:
    """Return the names of the presets that flexpm includes."""
    return sorted(path.stem for path in _PRESETS.glob("*.toml"))


def load(
    material: str | Path | Mapping[str, object] | Material | None = None,
    model: str = "flexible",
    *,
    solid: bool = False,
) -> Material:
    """Return a material from the name of a preset, a TOML file, a dictionary or a Material.

    Args:
        material: A text that ends in `.toml` or contains a path separator is a file; any other text
            is the name of a preset. None: the default preset of `model`.
        model: Model whose default is used.
        solid: Whether the default for 3D specimens is used.

    Raises:
        InputError: for an unknown preset, an unreadable file or a wrong value.

    Example:
        >>> material = flexpm.materials.load("augig-table7")
        >>> material.name, material.law()["tensile_strength"]
        ('augig-table7', 8500000.0)
    """
    if material is None:
        material = default_name(model, solid=solid)
    if isinstance(material, Material):
        return material
    if isinstance(material, Mapping):
        return Material.from_dict(material)
    if isinstance(material, Path) or str(material).endswith(".toml") or "/" in str(material):
        return _load_file(Path(material))
    known = preset_names()
    if material not in known:
        raise InputError(
            f"material = {quoted(material)}, unknown preset{nearest(str(material), known)}; "
            f"known are {', '.join(known)}, or give a .toml file"
        )
    return _load_file(_PRESETS / f"{material}.toml")


def _load_file(path: Path) -> Material:
    return Material.from_dict(load_toml(path, "material"), name=path.stem)


def _has_effect(key: str, model: str) -> bool:
    return joint.is_key(key) or is_used(key, model)


def _elastic_keys(name: str, values: object) -> Table:
    given = require_table(f"material [elastic.{name}]", values)
    for key in given:
        require_known(f"material [elastic.{name}] key", key, list(ELASTIC_KEYS))
    return given


def _refuse_missing(common: Table, sets: Mapping[str, Table]) -> None:
    """Name all keys that a material requires and does not have, in one line."""
    needed: tuple[str, ...] = ("tensile_strength", "cohesion", "friction")
    if common.get("softening", Material.softening) != "brittle":
        needed += ENERGY_KEYS
    missing = [(key, UNITS[key]) for key in needed if key not in common]
    for name, values in sets.items():
        missing += [
            (f"[elastic.{name}] {key}", UNITS[key])
            for key in ("normal_stiffness", "shear_ratio")
            if key not in values
        ]
    if missing:
        names = ", ".join(key for key, _ in missing)
        units = ", ".join(f"[{unit}]" for _, unit in missing)
        raise InputError(
            f"material {names} {'is' if len(missing) == 1 else 'are'} missing; give "
            f"{'it' if len(missing) == 1 else 'them'} in {units}"
        )


def _checked_set(name: str, chosen: ElasticSet) -> ElasticSet:
    require_known("material elastic set", name, sorted(set(ELASTIC_SET.values())))
    values: Table = {}
    for key in ELASTIC_KEYS:
        value = getattr(chosen, key)
        if value is not None or key not in ("young", "poisson"):
            values[key] = checked(key, value, f"[elastic.{name}] ")
    return ElasticSet(**values)


def _assigned(assignments: object) -> Table:
    """Values by key from texts ``KEY=VALUE`` or a mapping."""
    if isinstance(assignments, Mapping):
        for key in map(str, assignments):
            if joint.is_key(key):
                joint.split(key)
            else:
                require_known("set", key.rpartition(".")[2], list(UNITS))
        return {str(key): value for key, value in assignments.items()}
    if isinstance(assignments, str):
        assignments = [assignments]
    if not isinstance(assignments, Iterable):
        raise InputError(
            f"set = {quoted(assignments)}, must be texts KEY=VALUE or a mapping; write e.g. "
            "young=25.8e9"
        )
    return dict(map(_parse_assignment, assignments))


def _parse_assignment(text: object) -> tuple[str, float | str | bool | None]:
    if not isinstance(text, str):
        raise InputError(f"set = {quoted(text)}, must read KEY=VALUE; for example young=30e9")
    key, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not key or not value:
        raise InputError(f"set = {text!r}, must read KEY=VALUE; for example young=30e9")
    if joint.is_key(key):
        return key, joint.parsed(key, value)
    plain = key.rpartition(".")[2]
    require_known("set", plain, list(UNITS))
    if plain in CHOICES:
        return key, value
    if plain in _OPTIONAL and value == "none":
        return key, None
    try:
        return key, float(value)
    except ValueError:
        unit = f" {UNITS[plain]}".removesuffix(" -")
        raise InputError(
            f"set {key} = {value!r}{unit}, must be a number; write it without unit"
        ) from None
