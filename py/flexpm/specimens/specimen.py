# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens of bonded grains: discs, their Laguerre cells, and figures of them, paper Sec. 3.1."""

from __future__ import annotations

import dataclasses
import hashlib
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ParamSpec, TypeVar

import numpy as np
import numpy.typing as npt

from .._flexpm import (
    GrainMeshes,
    Outline,
    Tessellation,
    disc_count,
    disc_radii,
    grain_meshes,
    tessellate,
)
from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..progress import Progress
from . import packing, statistics
from .checks import SHORT_EDGE, require_length, require_short_edge
from .spec import SpecimenSpec

_FEWEST_DISCS = 8

Parameters = ParamSpec("Parameters")
Returned = TypeVar("Returned")


@dataclass(frozen=True)
class Circle:
    """Circular outline.

    Attributes:
        x: Centre [m].
        y: Centre [m].
        radius: Radius [m].
    """

    x: float
    y: float
    radius: float


@dataclass(frozen=True, eq=False)
class Specimen:
    """Bonded grains that fill an outline. Make it by ``rectangle``, ``disc`` or ``from_discs``.

    Attributes:
        discs: Rows x, y, radius [m], one per grain.
        outline: Corners, counter-clockwise, (n, 2) [m], or a circle.
        tessellation: Cells of the grains; cell i belongs to disc i.
        spec: What it was made from.
        removed_discs: Generated discs that had no cell and were left out.
        minerals: Index of each grain's mineral in its material; None: drawn by area fractions.
    """

    discs: FloatArray
    outline: FloatArray | Circle
    tessellation: Tessellation
    spec: SpecimenSpec
    removed_discs: int = 0
    minerals: IntArray | None = None

    @classmethod
    def rectangle(
        cls,
        width: float,
        height: float,
        thickness: float,
        diameters: tuple[float, float] = (2e-3, 4e-3),
        porosity: float = 0.10,
        seed: int = 1,
        *,
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> Specimen:
        """Pack a rectangle with its lower left corner at the origin; y is the axial direction.

        Args:
            width: Along x [m].
            height: Along y [m].
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        spec = SpecimenSpec(
            "rectangle",
            width=width,
            height=height,
            thickness=thickness,
            diameters=diameters,
            porosity=porosity,
            seed=seed,
            short_edge=short_edge,
        )
        return cls.pack(spec, progress)

    @classmethod
    def disc(
        cls,
        diameter: float,
        thickness: float,
        diameters: tuple[float, float] = (2e-3, 4e-3),
        porosity: float = 0.10,
        seed: int = 1,
        *,
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> Specimen:
        """Pack a disc about the origin; its rim is one chord per boundary grain.

        Args:
            diameter: Of the specimen [m].
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        spec = SpecimenSpec(
            "disc",
            diameter=diameter,
            thickness=thickness,
            diameters=diameters,
            porosity=porosity,
            seed=seed,
            short_edge=short_edge,
        )
        return cls.pack(spec, progress)

    @classmethod
    def pack(cls, spec: SpecimenSpec, progress: Progress | None = None) -> Specimen:
        """Pack the specimen that `spec` describes, as ``rectangle`` and ``disc`` do.

        Raises:
            InputError: for discs that do not fit, or that were given instead of packed.
        """
        where = f"Specimen.{spec.kind}"
        if spec.diameters is None or spec.porosity is None or spec.seed is None:
            raise InputError(f"{where}: discs = {spec.discs}, cannot be packed; use from_discs")
        smallest, largest = spec.diameters
        frame, outline = _frame_of(spec), _outline_of(spec)
        area = math.pi * frame.radius**2 if frame.radius else frame.width * frame.height
        count = _call(disc_count, area, smallest, largest, spec.porosity)
        if count < _FEWEST_DISCS:
            raise InputError(
                f"{where}: discs = {count}, must be >= {_FEWEST_DISCS} to fill the specimen; "
                "choose smaller diameters"
            )
        radii = _call(disc_radii, count, smallest, largest, spec.seed)
        mean = 0.5 * (smallest + largest)
        centres, radii = _call(packing.pack, frame, radii, mean, spec.seed, progress)
        given = np.column_stack((centres, radii))
        discs, cells = _tessellated(given, outline, spec.short_edge, drop_hidden=True)
        return cls(discs, outline, cells, spec, removed_discs=len(given) - len(discs))

    @classmethod
    def from_discs(
        cls,
        centres: Sequence[Sequence[float]] | FloatArray,
        radii: Sequence[float] | FloatArray,
        outline: Sequence[Sequence[float]] | FloatArray | Circle,
        thickness: float,
        *,
        short_edge: float = SHORT_EDGE,
    ) -> Specimen:
        """Make a specimen of given discs; every disc must have a cell.

        Args:
            centres: Rows x, y [m], inside the outline.
            radii: One per centre [m].
            outline: Corners of a convex polygon, counter-clockwise [m], or a circle.
            thickness: Out of plane [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-]; 0: none.

        Returns:
            The specimen, grains in the order of the discs.

        Raises:
            InputError: for a value out of range, a disc outside the outline or hidden by others.
        """
        require_length("Specimen.from_discs", "thickness", thickness)
        require_short_edge(short_edge)
        discs = _disc_rows(centres, radii)
        if not isinstance(outline, Circle):
            outline = _rows("Specimen.from_discs: outline", outline)
        discs, cells = _tessellated(discs, outline, short_edge, drop_hidden=False)
        kind, sizes = _kind_of(outline)
        spec = SpecimenSpec(
            kind,
            width=sizes.get("width"),
            height=sizes.get("height"),
            diameter=sizes.get("diameter"),
            thickness=thickness,
            diameters=None,
            porosity=None,
            seed=None,
            short_edge=short_edge,
            discs=_checksum(discs),
            outline=_checksum(outline),
        )
        return cls(discs, outline, cells, spec)

    def with_minerals(self, minerals: Sequence[int] | IntArray) -> Specimen:
        """Return the same grains, each of a given mineral.

        Args:
            minerals: For each grain an index into the minerals of the material.

        Raises:
            InputError: if it is not one index for each grain.
        """
        given = np.asarray(minerals)
        if given.shape != (len(self.discs),) or given.dtype.kind not in "iu" or given.min() < 0:
            raise InputError(
                f"Specimen.with_minerals: minerals = {given.dtype} array of shape {given.shape}, "
                f"must be {len(self.discs)} indices from 0, one for each grain"
            )
        given = given.astype(np.int32)
        given.setflags(write=False)
        spec = dataclasses.replace(self.spec, minerals=_checksum(given))
        return dataclasses.replace(self, minerals=given, spec=spec)

    @property
    def kind(self) -> str:
        """``rectangle``, ``disc`` or ``polygon``."""
        return self.spec.kind

    @property
    def dimensions(self) -> dict[str, float]:
        """``width`` and ``height``, or ``diameter`` [m]; empty for a polygon."""
        return self.spec.sizes

    @property
    def thickness(self) -> float:
        """Out of plane [m]."""
        return self.spec.thickness

    @property
    def seed(self) -> int | None:
        """Seed of a packing, None for given discs."""
        return self.spec.seed

    @property
    def short_edge(self) -> float:
        """Edges of cells below this share of the mean diameter were collapsed [-]."""
        return self.spec.short_edge

    @property
    def centres(self) -> FloatArray:
        """Centres of the discs, (n, 2) [m]."""
        return self.discs[:, :2]

    @property
    def radii(self) -> FloatArray:
        """Radii of the discs [m]."""
        return self.discs[:, 2]

    @property
    def mean_diameter(self) -> float:
        """Mean diameter of the discs [m]."""
        return 2.0 * float(np.mean(self.discs[:, 2]))

    def meshes(self, mesh: str = "refined") -> GrainMeshes:
        """Mesh the grains.

        Args:
            mesh: ``refined`` or ``fan``.

        Returns:
            The kernel's meshes: nodes, triangles and their offsets per grain as arrays.

        Raises:
            InputError: for an unknown mesh.
        """
        centres, radii = _columns(self.discs)
        return _call(grain_meshes, self.tessellation, centres, radii, mesh)

    def statistics(self) -> dict[str, float | int | dict[str, float]]:
        """Count and measure grains, contacts, cells and meshes.

        Returns:
            Counts, areas [m^2], lengths [m], angles [degree]; see the keys.
        """
        meshes = self.meshes("refined"), self.meshes("fan")
        return {
            **statistics.of_cells(self.tessellation),
            **statistics.of_meshes(*meshes),
            "removed_discs": self.removed_discs,
            "mean_diameter": self.mean_diameter,
        }


def _frame_of(spec: SpecimenSpec) -> packing.Frame:
    sizes = spec.sizes
    if spec.kind == "disc":
        return packing.Frame(radius=0.5 * sizes["diameter"])
    return packing.Frame(width=sizes["width"], height=sizes["height"])


def _outline_of(spec: SpecimenSpec) -> FloatArray | Circle:
    """Outline of a packing: a rectangle from the origin, or a circle about it."""
    sizes = spec.sizes
    if spec.kind == "disc":
        return Circle(0.0, 0.0, 0.5 * sizes["diameter"])
    width, height = sizes["width"], sizes["height"]
    return np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])


def _tessellated(
    discs: FloatArray, outline: FloatArray | Circle, short_edge: float, *, drop_hidden: bool
) -> tuple[FloatArray, Tessellation]:
    """Discs and their cells; hidden discs, which have no cell, are dropped or refused."""
    if isinstance(outline, Circle):
        shape = _call(Outline.circle, outline.x, outline.y, outline.radius)
    else:
        shape = _call(Outline.polygon, outline)
    while True:
        length = short_edge * 2.0 * float(np.mean(discs[:, 2])) if len(discs) else 0.0
        cells = _call(tessellate, *_columns(discs), shape, length, drop_hidden)
        if len(cells.hidden_discs) == 0:
            break
        discs = np.delete(discs, cells.hidden_discs, axis=0)
    discs.setflags(write=False)
    return discs, cells


def _kind_of(outline: FloatArray | Circle) -> tuple[str, dict[str, float]]:
    """Shape and sizes; a rectangle starts at its lower left corner, with sides along x and y."""
    if isinstance(outline, Circle):
        return "disc", {"diameter": 2.0 * outline.radius}
    (x0, y0), (x1, y1) = outline.min(axis=0), outline.max(axis=0)
    box = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    if outline.shape == (4, 2) and np.array_equal(outline, box):
        return "rectangle", {"width": float(x1 - x0), "height": float(y1 - y0)}
    return "polygon", {}


def _checksum(given: FloatArray | IntArray | Circle) -> str:
    """Short hash of numbers, by which files name what is too long for them."""
    plain = dataclasses.astuple(given) if isinstance(given, Circle) else given
    values = np.ascontiguousarray(plain, dtype=float)
    return hashlib.sha256(values.tobytes()).hexdigest()[:16]


def _call(
    function: Callable[Parameters, Returned],
    *arguments: Parameters.args,
    **options: Parameters.kwargs,
) -> Returned:
    """Call the kernel; its complaint about a value becomes an InputError."""
    try:
        return function(*arguments, **options)
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(error)) from None


def _columns(discs: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.ascontiguousarray(discs[:, :2]), np.ascontiguousarray(discs[:, 2])


def _disc_rows(centres: npt.ArrayLike, radii: npt.ArrayLike) -> FloatArray:
    """Rows x, y, radius of discs given as centres and radii [m]."""
    points = _rows("Specimen.from_discs: centres", centres)
    try:
        sizes = np.array(radii, dtype=float)
    except (TypeError, ValueError):
        raise InputError("Specimen.from_discs: radii are no numbers; give one per centre") from None
    if sizes.shape != (len(points),):
        raise InputError(
            f"Specimen.from_discs: radii = array of shape {sizes.shape}, must be one per centre, "
            f"{len(points)}; complete them"
        )
    return np.column_stack((points, sizes))


def _rows(name: str, values: npt.ArrayLike) -> FloatArray:
    """Rows x, y of numbers; `name` is named in the message."""
    try:
        found = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{name}: not numbers, must be rows x, y; correct them") from None
    if found.ndim != 2 or found.shape[1] != 2:
        raise InputError(f"{name} = array of shape {found.shape}, must be rows x, y; correct it")
    return found
