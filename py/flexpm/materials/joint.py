# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of a rock: the law of the contacts along a cut. SI units, strengths are magnitudes."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ..errors import InputError
from ..files import Table
from ..require import quoted, require_flag, require_known, require_number, require_table
from .keys import JOINT_BOUNDS, JOINT_UNITS, RESIDUAL_KEYS, check_residual

_REQUIRED = ("normal_stiffness", "shear_stiffness", "friction")
_STRENGTHS = {
    "tensile_strength": ("normal_stiffness", "tensile_fracture_energy"),
    "cohesion": ("shear_stiffness", "shear_fracture_energy"),
}
#: A fracture energy this far below the elastic energy [relative] is round-off.
_TOLERANCE = 1e-12


@dataclass(frozen=True)
class Joint:
    """Law of the contacts of a joint. Without strengths they are cracked from the start."""

    name: str
    normal_stiffness: float | None = None  #: [Pa/m]
    shear_stiffness: float | None = None  #: [Pa/m]
    friction: float | None = None  #: tangent of the friction angle [-]
    cohesion: float = 0.0  #: [Pa]
    tensile_strength: float = 0.0  #: [Pa]
    tensile_fracture_energy: float | None = None  #: [N/m]; None: brittle
    shear_fracture_energy: float | None = None  #: [N/m]; None: brittle
    dilation_angle: float = 0.0  #: opening per plastic slip, at most the friction angle [degrees]
    dilation_slip: float | None = None  #: plastic slip at which the dilation ends [m]
    residual_friction: float | None = None  #: of a cracked point; None: friction does not fall [-]
    slip_length: float | None = None  #: slip since the crack at which it is reached [m]
    open: bool = False  #: a notch: what is not given is that of the rock

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name or set(self.name) & set(". =,\"'"):
            raise InputError(
                f"joint = {quoted(self.name)}, must be a name without spaces, dots, commas, quotes "
                "and equals signs; rename it"
            )
        for key, value in self._values().items():
            object.__setattr__(self, key, self._checked(key, value))
        object.__setattr__(
            self, "open", require_flag(f"material [joint.{self.name}] open", self.open)
        )
        if self.open:
            self._refuse_strengths()
            return
        missing = [key for key in _REQUIRED if getattr(self, key) is None]
        if missing:
            keys = f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing"
            raise InputError(
                f"material [joint.{self.name}] {keys}; give all keys of a new joint together, or "
                "open = true for a notch"
            )

    @classmethod
    def from_dict(cls, name: str, data: object) -> Joint:
        """Make a joint from a table `[joint.NAME]`.

        Raises:
            InputError: naming the key that is unknown, missing or out of range.
        """
        values = require_table(f"material [joint.{name}]", data)
        for key in values:
            require_known(f"material [joint.{name}] key", key, list(JOINT_UNITS))
        return cls(name, **values)

    def law(self, rock: Mapping[str, object]) -> Table:
        """Return the parameters in effect.

        Args:
            rock: Law of the rock's own contacts, which provides all values that a notch does not
                set.

        Raises:
            InputError: if a fracture energy lies below the elastic energy.
        """
        found: Table = {"name": self.name, **self._values(), "open": self.open}
        if self.open:
            stiffness = float(rock["normal_stiffness"])  # type: ignore[arg-type]
            ratio = float(rock["shear_ratio"])  # type: ignore[arg-type]
            usual = {
                "normal_stiffness": stiffness,
                "shear_stiffness": ratio * stiffness,
                "friction": rock["friction"],
            }
            if found["friction"] is None and found["residual_friction"] is None:
                usual |= {key: rock.get(key) for key in RESIDUAL_KEYS}
            found |= {key: value for key, value in usual.items() if found[key] is None}
        for strength, (stiffness_key, energy) in _STRENGTHS.items():
            elastic = found[strength] ** 2 / (2.0 * found[stiffness_key])
            given = found[energy]
            if given is not None and given < elastic * (1.0 - _TOLERANCE):
                raise InputError(
                    f"material [joint.{self.name}] {energy} = {given!r} N/m, must not be below the "
                    f"elastic energy at the peak; the smallest allowed value is {elastic!r} N/m"
                )
            if given is None and elastic > 0.0:
                found[energy] = elastic
        self._check_dilation(float(found["friction"]))
        self._check_residual(found)
        return found

    def _values(self) -> Table:
        return {
            field.name: getattr(self, field.name)
            for field in dataclasses.fields(self)
            if field.name not in ("name", "open")
        }

    def _checked(self, key: str, value: object) -> float | None:
        if value is None:
            return None
        label = f"material [joint.{self.name}] {key}"
        return require_number(label, value, JOINT_BOUNDS[key], JOINT_UNITS[key] or "")

    def _check_dilation(self, friction: float) -> None:
        """Reject a dilation that supplies more energy than friction dissipates, or never ends."""
        if self.dilation_angle == 0.0:
            return
        label = f"material [joint.{self.name}]"
        largest = math.degrees(math.atan(friction))
        if self.dilation_angle > largest:
            raise InputError(
                f"{label} dilation_angle = {self.dilation_angle!r} degrees, must not exceed the "
                f"friction angle, {largest:.4g} degrees; lower it, or raise the friction"
            )
        if self.dilation_slip is None:
            raise InputError(
                f"{label} dilation_slip is missing; give the slip at which the dilation ends [m]"
            )

    def _check_residual(self, law: Mapping[str, object]) -> None:
        """Reject a residual friction above the friction or below the dilation."""
        label = f"material [joint.{self.name}]"
        check_residual(label, law)
        residual = law["residual_friction"]
        if not isinstance(residual, float):
            return
        least = math.tan(math.radians(self.dilation_angle))
        if residual < least:
            raise InputError(
                f"{label} residual_friction = {residual!r}, must be >= the tangent of the dilation "
                f"angle, {least:.4g}; raise it, or lower the dilation angle"
            )

    def _refuse_strengths(self) -> None:
        for key in ("tensile_strength", "cohesion"):
            if getattr(self, key) > 0.0:
                raise InputError(
                    f"material [joint.{self.name}] {key} = {getattr(self, key)!r} Pa, must be 0 "
                    "for an open joint; leave out this key or open"
                )


def checked(joints: object) -> tuple[Joint, ...]:
    """Return joints from tables by name, or from joints; each name occurs once."""
    if isinstance(joints, Mapping):
        return tuple(Joint.from_dict(name, values) for name, values in joints.items())
    if isinstance(joints, tuple | list) and all(isinstance(one, Joint) for one in joints):
        names = [joint.name for joint in joints]
        if len({*names}) == len(names):
            return tuple(joints)
    raise InputError(
        f"material joint = {quoted(joints)}, must be tables [joint.NAME]; give each joint a table"
    )


def with_values(joints: tuple[Joint, ...], values: Mapping[str, object]) -> tuple[Joint, ...]:
    """Joints with changed values, by ``joint.NAME.KEY``; a name that is new makes a joint."""
    tables: dict[str, Table] = {joint.name: _table(joint) for joint in joints}
    for label, value in values.items():
        name, key = split(label)
        tables.setdefault(name, {})[key] = value
    return checked(tables)


def require_joints(names: Iterable[str], known: Sequence[str]) -> None:
    """Reject a specimen with a joint that the material does not have."""
    for name in names:
        if not known:
            raise InputError(
                f"joint = {name!r}, has no law; add a table [joint.{name}] to the material"
            )
        require_known("joint", name, known)


def is_key(label: str) -> bool:
    """Whether a key reads ``joint.NAME.KEY``."""
    return label.startswith("joint.") and label.count(".") == 2


def split(label: str) -> tuple[str, str]:
    """Name and key of ``joint.NAME.KEY``, which a joint has."""
    _, name, key = label.split(".")
    require_known(f"set joint.{name}", key, list(JOINT_UNITS))
    return name, key


def parsed(label: str, text: str) -> float | bool:
    """Value of ``joint.NAME.KEY=TEXT``."""
    key = split(label)[1]
    if key == "open":
        if text not in ("true", "false"):
            raise InputError(f"set {label} = {text!r}, must be true or false; choose one")
        return text == "true"
    try:
        return float(text)
    except ValueError:
        unit = JOINT_UNITS[key] or ""
        raise InputError(
            f"set {label} = {text!r} {unit}".rstrip() + ", must be a number; write it without unit"
        ) from None


def _table(joint: Joint) -> Table:
    values = dataclasses.asdict(joint)
    del values["name"]
    return values
