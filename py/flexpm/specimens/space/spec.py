# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs from which a 3D specimen is made, as plain values that files can hold. SI units.

No heavy library is imported here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from ...errors import InputError
from ...files import Table
from ...joints.planes import JointPlane, Vector, checksum, names_of
from ..checks import (
    DIAMETERS,
    require_diameters,
    require_length,
    require_memory,
    require_porosity,
    require_seed,
    require_short_edge,
)
from ..grain_source import require_source

#: Sizes of each shape and their defaults [m].
SIZES: dict[str, dict[str, float]] = {
    "box": {"width": 0.025, "depth": 0.025, "height": 0.05},
    "cylinder": {"diameter": 0.05, "height": 0.1},
    "solid-disc": {"diameter": 0.05, "depth": 0.025},
    "solid-half-disc": {"diameter": 0.05, "depth": 0.02},
}
#: Edges of cells below this share of the mean diameter are collapsed.
SHORT_EDGE = 0.10
_ALL_SIZES = ("width", "depth", "height", "diameter")
#: Memory of packing, cells, file and picture [bytes a grain], measured on 11 250 grains.
_MEMORY = 30_000


@dataclass(frozen=True)
class SolidSpec:
    """Shape, size and packing of a 3D specimen, or checksums of given spheres or cells.

    Attributes:
        kind: ``box``, ``cylinder``, ``solid-disc`` or ``solid-half-disc``.
        width: Width of a box, along x [m]; if None its default, and None for another shape.
        depth: Depth of a box, a disc or half a disc, along y [m]; None as for `width`.
        height: Height of a box or a cylinder, along z, the axis of tests [m]; None as for `width`.
        diameter: Diameter of a cylinder, a disc or half a disc [m]; None as for `width`.
        diameters: Smallest and largest diameter of the packed spheres [m]; None for given spheres.
        porosity: Ratio that sets the number of packed spheres [-]; None for given spheres.
        seed: Seed of the packing; None for given spheres.
        short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-].
        spheres: Checksum of given spheres; None for a packing.
        minerals: Checksum of given minerals of the grains; None without given minerals.
        cells: Checksum of given cells; None: cells of the spheres.
        source: File from which the grains were read, see ``grain_source``; None: none.
        joints: Checksum of the planes of joints; None without joints.
        joint_names: Names of the joints; None without joints.
        networks: Fracture networks whose planes are among the joints, as tables that generate them
            again; None without networks.
        holes: Holes, in the order in which they are cut; None without holes.
    """

    kind: str = "box"
    width: float | None = None
    depth: float | None = None
    height: float | None = None
    diameter: float | None = None
    diameters: tuple[float, float] | None = DIAMETERS
    porosity: float | None = 0.10
    seed: int | None = 1
    short_edge: float = SHORT_EDGE
    spheres: str | None = None
    minerals: str | None = None
    cells: str | None = None
    source: Table | None = None
    joints: str | None = None
    joint_names: tuple[str, ...] | None = None
    networks: tuple[Table, ...] | None = None
    holes: tuple[Table, ...] | None = None

    # what specimens of the plane may have, and solids do not
    strengths: ClassVar[None] = None

    def __post_init__(self) -> None:
        if self.kind not in SIZES:
            raise InputError(
                f"specimen kind = {self.kind!r}, must be one of {', '.join(SIZES)}; choose one of "
                "them"
            )
        where = f"Specimen.{self.kind}"
        for name in _ALL_SIZES:
            self._set(name, self._size(where, name))
        self._set("short_edge", require_short_edge(self.short_edge))
        self._set("source", require_source(where, self.source))
        for name in ("joint_names", "networks", "holes"):  # lists in a file
            if getattr(self, name) is not None:
                self._set(name, tuple(getattr(self, name)))
        if self.spheres is None:
            room = min(self.sizes.values())
            self._set("diameters", require_diameters(where, self.diameters, room))
            self._set("porosity", require_porosity(where, self.porosity))
            self._set("seed", require_seed(where, self.seed))
        elif not (self.diameters is None and self.porosity is None and self.seed is None):
            raise InputError(
                f"{where}: spheres = {self.spheres}, must not be given with diameters, porosity or "
                "a seed, which make a packing; leave these out"
            )

    @property
    def sizes(self) -> dict[str, float]:
        """Sizes of the shape by their names [m]."""
        return {name: getattr(self, name) for name in SIZES[self.kind]}

    @property
    def is_packed(self) -> bool:
        """Whether a packing reproduces the specimen without a file."""
        given = (self.spheres, self.minerals, self.joints, self.holes)
        return all(one is None for one in given)

    @property
    def is_laguerre(self) -> bool:
        """Whether all cells are whole Laguerre cells of spheres."""
        return self.cells is None and self.joints is None and self.holes is None

    def with_joints(self, planes: Sequence[JointPlane], network: Table | None = None) -> SolidSpec:
        """Return the same specimen with more joints.

        Args:
            planes: Planes of the joints.
            network: Table of the network that generated them; None: they were given.

        Raises:
            InputError: for a joint with the name of a set of a network, or the reverse.
        """
        sets = [*self.sets]
        names = names_of(planes)
        if network is None:
            label, taken, what = "joint", sets, "a set of the network"
        else:
            label, taken, what = "network set", [*(self.joint_names or ()), *sets], "a joint"
            names = tuple(network["set"])
        for name in names:
            if name in taken:
                raise InputError(
                    f"{label} {name}: name = {name}, is the name of {what} of the specimen; choose "
                    "another name"
                )
        every = [*(self.joint_names or ()), *names_of(planes)]
        return replace(
            self,
            joints=checksum(planes, self.joints),
            joint_names=tuple(dict.fromkeys(every)),
            networks=self.networks if network is None else (*(self.networks or ()), network),
        )

    @property
    def corners(self) -> tuple[Vector, Vector]:
        """Lower and upper corner of the box around the shape [m]."""
        sizes = self.sizes
        half = 0.5 * sizes.get("diameter", 0.0)
        if self.kind == "box":
            return (0.0, 0.0, 0.0), (sizes["width"], sizes["depth"], sizes["height"])
        if self.kind == "cylinder":
            return (-half, -half, 0.0), (half, half, sizes["height"])
        bottom = 0.0 if self.kind == "solid-half-disc" else -half
        return (-half, 0.0, bottom), (half, sizes["depth"], half)

    @property
    def middle(self) -> Vector:
        """Middle of the box around the shape [m]."""
        x, y, z = (0.5 * (low + high) for low, high in zip(*self.corners, strict=True))
        return x, y, z

    @property
    def joints_with_law(self) -> list[str]:
        """Names of the joints."""
        return [*(self.joint_names or ())]

    @property
    def sets(self) -> dict[str, Table]:
        """Table of each set of the networks, by its name."""
        tables = self.networks or ()
        return {name: one for network in tables for name, one in network["set"].items()}

    def require_alike(self, model: str) -> None:
        """Reject joints and holes, for a model that makes its own contacts."""
        if self.joints is not None or self.holes is not None:
            what = "joints" if self.holes is None else "holes"
            raise InputError(
                f"model = {model}, must be flexible or rigid for a specimen with {what}; use one "
                "of them"
            )

    def require_discs(self, model: str) -> None:
        """Reject given cells and joints for a model of spheres; cells of a packing have them."""
        self.require_alike(model)
        if self.cells is not None:
            raise InputError(
                f"model = {model}, must be flexible or rigid for user-supplied cells; use one of "
                "them"
            )

    @property
    def volume(self) -> float:
        """Volume of the outline [m3]."""
        sizes = self.sizes
        if self.kind == "box":
            return math.prod(sizes.values())
        diameter, length = sizes.values()
        whole = 0.25 * math.pi * diameter**2 * length
        return 0.5 * whole if self.kind == "solid-half-disc" else whole

    def require_memory(self) -> None:
        """Raise an error before the packing begins if the machine has too little memory."""
        if self.diameters is None or self.porosity is None:
            return
        low, high = self.diameters
        mean_cube = 0.25 * (low + high) * (low * low + high * high)
        grains = self.volume * (1.0 - self.porosity) / (math.pi / 6.0 * mean_cube)
        require_memory(f"Specimen.{self.kind}", grains, _MEMORY)

    def _size(self, where: str, name: str) -> float | None:
        """Return a size that the shape has, or None."""
        value = getattr(self, name)
        if name not in SIZES[self.kind]:
            if value is not None:
                raise InputError(
                    f"{name} = {value} m, must not be given for a {self.kind}; leave it out"
                )
            return None
        if value is None:
            value = SIZES[self.kind][name]
        return require_length(where, name, value)

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)
