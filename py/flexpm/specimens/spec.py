# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs from which a specimen is made, as plain values that files can hold. SI units.

No heavy library is imported here, so that inputs are checked before YADE starts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..errors import InputError
from ..files import Table
from ..joints.lines import EXCAVATION, Lines, checksum
from .checks import (
    DIAMETERS,
    SHORT_EDGE,
    require_diameters,
    require_length,
    require_memory,
    require_porosity,
    require_seed,
    require_short_edge,
)
from .grain_source import require_source

if TYPE_CHECKING:
    from ..arrays import FloatArray
    from ..joints.window import Window

#: Sizes of each shape and their defaults [m]: the paper's specimens, Sec. 4.1.
SIZES: dict[str, dict[str, float]] = {
    "rectangle": {"width": 0.08, "height": 0.16},
    "disc": {"diameter": 0.08},
    "polygon": {},
    "half-disc": {"diameter": 0.08},
}
#: File beside the results of a run on a specimen that no packing gives again.
GRAINS_FILE = "grains.json"
#: File of a packing, which spares a resumed run from packing again.
PACKING_FILE = "packing.json"
_ALL_SIZES = ("width", "height", "diameter")
#: Memory of packing, cells, file and picture [bytes a grain], measured on 15 915 grains.
_MEMORY = 3_000


@dataclass(frozen=True)
class SpecimenSpec:
    """Shape, size and packing of a specimen, or checksums of given discs or cells.

    Attributes:
        kind: ``rectangle``, ``disc``, ``polygon`` or ``half-disc``.
        width: Width of a rectangle [m]; if None its default, and None for another shape.
        height: Height of a rectangle, along the axis of the test [m]; None as for `width`.
        diameter: Diameter of a disc or half a disc [m]; None as for `width`.
        thickness: Thickness out of plane [m].
        diameters: Smallest and largest diameter of the packed discs [m]; None for given discs.
        porosity: Ratio that sets the number of packed discs [-]; None for given discs.
        seed: Seed of the packing; None for given discs.
        short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-].
        discs: Checksum of given discs; None for a packing.
        outline: Checksum of the outline of given discs or cells, or of an outline that was cut out
            of a packing; None for a packed rectangle or disc.
        cells: Checksum of given cells; None for cells of the discs.
        joints: Checksum of the lines of joints; None without joints.
        joint_names: Names of the joints; None without joints.
        strengths: Checksum of the strength factors of the contacts; None if all factors are 1.
        minerals: Checksum of given minerals of the grains; None without given minerals.
        networks: Fracture networks whose traces are among the joints, as tables that generate them
            again; None without networks.
        joint_origin: Point of a map of joints at the specimen's origin [m]; None without a map.
        source: File from which the grains were read, see ``grain_source``; None: none.
    """

    kind: str = "rectangle"
    width: float | None = None
    height: float | None = None
    diameter: float | None = None
    thickness: float = 0.08
    diameters: tuple[float, float] | None = DIAMETERS
    porosity: float | None = 0.10
    seed: int | None = 1
    short_edge: float = SHORT_EDGE
    discs: str | None = None
    outline: str | None = None
    minerals: str | None = None
    cells: str | None = None
    joints: str | None = None
    joint_names: tuple[str, ...] | None = None
    strengths: str | None = None
    networks: tuple[Table, ...] | None = None
    joint_origin: tuple[float, float] | None = None
    source: Table | None = None

    def __post_init__(self) -> None:
        if self.kind not in SIZES:
            raise InputError(
                f"specimen kind = {self.kind!r}, must be one of {', '.join(SIZES)}; choose one of "
                "them"
            )
        where = f"Specimen.{self.kind}"
        for name in _ALL_SIZES:
            self._set(name, self._size(where, name))
        self._set("thickness", require_length(where, "thickness", self.thickness))
        self._set("short_edge", require_short_edge(self.short_edge))
        self._set("source", require_source(where, self.source))
        if self.joint_names is not None:  # a list in a file
            self._set("joint_names", tuple(self.joint_names))
        if self.networks is not None:
            self._set("networks", tuple(self.networks))
        if self.joint_origin is not None:
            x, y = self.joint_origin
            self._set("joint_origin", (x, y))
        if self.discs is None:
            self._check_packing(where)
        elif not (self.diameters is None and self.porosity is None and self.seed is None):
            raise InputError(
                f"{where}: discs = {self.discs}, must not be given with diameters, porosity or a "
                "seed, which make a packing; leave these out"
            )

    @property
    def sizes(self) -> dict[str, float]:
        """``width`` and ``height``, or ``diameter`` [m]; none of a polygon."""
        return {name: getattr(self, name) for name in SIZES[self.kind]}

    @property
    def is_packed(self) -> bool:
        """Whether a packing of a rectangle or disc reproduces the specimen without a file."""
        given = (self.discs, self.outline, self.minerals, self.cells, self.joints, self.strengths)
        return all(one is None for one in given)

    @property
    def is_sawn(self) -> bool:
        """Whether its outline was cut out of a packing."""
        return (self.outline is not None and self.discs is None) or self.kind == "half-disc"

    @property
    def is_laguerre(self) -> bool:
        """Whether all cells are whole Laguerre cells of discs: none was given, sawn or cut."""
        return self.cells is None and self.joints is None and not self.is_sawn

    def require_memory(self, room: float | None = None) -> None:
        """Raise an error before the packing begins if the machine has too little memory.

        Args:
            room: Area that is packed [m2]; None: the area of the rectangle or disc, or of the block
                from which half a disc is cut.

        Raises:
            InputError: if the packing needs more memory than the machine has.
        """
        if self.diameters is None or self.porosity is None:
            return
        if room is None:
            room = self._packed_area()
        low, high = self.diameters
        mean_square = (low * low + low * high + high * high) / 3.0
        grains = room * (1.0 - self.porosity) / (0.25 * math.pi * mean_square)
        require_memory(f"Specimen.{self.kind}", grains, _MEMORY)

    def _packed_area(self) -> float:
        """Area of the packing [m2]; 0 for a polygon, whose corners are not stored here."""
        if self.kind == "rectangle":
            return math.prod(self.sizes.values())
        across = self.sizes.get("diameter", 0.0)
        return (0.5 if self.kind == "half-disc" else 0.25 * math.pi) * across * across

    def with_joints(self, lines: Lines, origin: tuple[float, float] | None = None) -> SpecimenSpec:
        """Return the same specimen with more joints, which belong to a map if an origin is given.

        Raises:
            InputError: for a joint with the name of a set of a network, whose traces it would join.
        """
        for name, _ in self.asked_intensities:
            if name in lines:
                raise InputError(
                    f"joint {name}: name = {name}, is the name of a set of the network; choose "
                    "another name"
                )
        names = [*(self.joint_names or ()), *lines]
        return replace(
            self,
            joints=checksum(lines, self.joints),
            joint_names=tuple(dict.fromkeys(names)),
            joint_origin=self.joint_origin if origin is None else origin,
        )

    def with_network(self, network: Table, lines: Lines) -> SpecimenSpec:
        """Return the spec of the same specimen, cut by the traces of a network.

        Args:
            network: Table of the network.
            lines: Generated traces of the network.

        Returns:
            The spec.

        Raises:
            InputError: for a set with the name of an existing joint.
        """
        earlier = [*(self.joint_names or ()), *(name for name, _ in self.asked_intensities)]
        for name in network["set"]:
            if name in earlier:
                raise InputError(
                    f"network set {name}: name = {name}, is the name of a joint of the specimen; "
                    "choose another name"
                )
        return replace(self.with_joints(lines), networks=(*(self.networks or ()), network))

    @property
    def joints_with_law(self) -> list[str]:
        """Names of the joints, without lines of excavations, which are rock until excavated."""
        return [name for name in self.joint_names or () if not name.startswith(EXCAVATION)]

    @property
    def asked_intensities(self) -> list[tuple[str, float]]:
        """Name and P21 [1/m] of each set of the networks."""
        return [
            (name, one["intensity"])
            for network in self.networks or ()
            for name, one in network["set"].items()
        ]

    def window(
        self, outline: Sequence[Sequence[float]] | FloatArray | Mapping[str, float] | None
    ) -> Window:
        """Return the window of generated traces: the bounding box of the specimen, or its circle.

        Args:
            outline: Corners, or x, y and radius of a circle [m]; None: the outline of a packing.
        """
        from ..joints.window import Window

        if self.kind == "half-disc" or outline is None:  # made from its sizes
            across = self.sizes.get("diameter", 0.0)
            if self.kind == "disc":
                return Window.circle(0.0, 0.0, 0.5 * across)
            if self.kind == "half-disc":
                return Window((0.0, 0.0), (across, 0.5 * across))
            return Window((0.0, 0.0), (self.sizes["width"], self.sizes["height"]))
        return Window.circle(**outline) if isinstance(outline, Mapping) else Window.about(outline)

    def require_alike(self, model: str) -> None:
        """Reject joints and strengths of contacts, for a model that makes its own contacts."""
        for what, one in (("joints", self.joints), ("strengths of contacts", self.strengths)):
            if one is not None:
                raise InputError(
                    f"model = {model}, must be flexible or rigid for a specimen with {what}; use "
                    "one of them"
                )

    def require_discs(self, model: str) -> None:
        """Reject grains that are not discs for a model of discs."""
        self.require_alike(model)
        kinds = {"given cells": self.cells, "sawn grains": self.is_sawn or None}
        what = next((kind for kind, one in kinds.items() if one is not None), "")
        if what:
            raise InputError(
                f"model = {model}, must be flexible or rigid for a specimen of {what}; use one of "
                "them"
            )

    def _check_packing(self, where: str) -> None:
        if self.kind == "polygon" and self.outline is None:
            raise InputError(f"{where}: outline is missing; only rectangles and discs need none")
        room = min(self.sizes.values(), default=math.inf)
        self._set("diameters", require_diameters(where, self.diameters, room))
        self._set("porosity", require_porosity(where, self.porosity))
        self._set("seed", require_seed(where, self.seed))

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
