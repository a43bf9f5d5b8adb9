# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens of bonded grains: discs, their Laguerre cells, and figures of them, paper Sec. 3.1."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .._flexpm import (
    GrainMeshes,
    PolygonOutline,
    Tessellation,
    Tiling,
    cells_in_outline,
    cells_of_polygons,
    cut_by_joints,
    grain_meshes,
)
from ..arrays import FloatArray, IntArray
from ..errors import InputError
from ..files import Table
from ..notebook import Shown
from ..progress import Progress
from ..require import require_flag
from . import joint_bend, joint_lines, packed, packing, specimen_file, statistics
from . import strengths as contact_strengths
from .checks import SHORT_EDGE, require_diameters, require_length, require_short_edge
from .kernel_input import Circle, call, cells_checksum, checksum, columns, disc_rows, ring
from .outlines import half_disc_corners, kind_of, polygon_outline
from .space.makers import SolidShapes
from .spec import SpecimenSpec

#: Below this share of the mean diameter a distance is round-off [-].
_STRAIGHT = 1e-9


@dataclass(frozen=True, eq=False)
class Specimen(SolidShapes, Shown):
    """Bonded grains that fill an outline; ``box`` and ``cylinder`` make a ``SolidSpecimen``.

    Make it by ``rectangle``, ``disc``, ``half_disc``, ``polygon``, ``from_discs``,
    ``from_polygons`` or ``load``.

    Attributes:
        discs: Rows x, y, radius [m], one per grain: centre of its disc, or the point from which
            all edges of a cell are seen that is no disc's, with the radius of a disc of its area.
        outline: Corners, counter-clockwise, (n, 2) [m], or a circle.
        tessellation: Cells of the grains; cell i belongs to disc i.
        spec: What it was made from.
        removed_discs: Discs that had no cell and were left out.
        minerals: Index of each grain's mineral in its material; None: drawn by area fractions.
        holes: Corners of each hole of the outline, clockwise, (n, 2) [m].
        edge_joints: Per shared edge an index into ``spec.joint_names``, -1: none; None: no joints.
        joints: Lines of each joint as they were asked for, by its name [m].
        joint_cuts: What came of the lines of each joint, by its name.
        grains: Per cell the grain before joints cut it; None: each cell is a grain.
        strengths: Factor of the strengths of each contact [-]; None: all 1.
    """

    discs: FloatArray
    outline: FloatArray | Circle
    tessellation: Tessellation
    spec: SpecimenSpec
    removed_discs: int = 0
    minerals: IntArray | None = None
    holes: tuple[FloatArray, ...] = ()
    edge_joints: IntArray | None = None
    grains: IntArray | None = None
    strengths: FloatArray | None = None
    joints: joint_lines.Lines = field(default_factory=dict)
    joint_cuts: dict[str, joint_lines.Cut] = field(default_factory=dict)

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
            diameter: Diameter of the specimen [m].
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
        if not spec.is_packed:
            what = spec.discs or spec.outline or spec.minerals or spec.joints or spec.strengths
            raise InputError(
                f"{where}: discs, outline, minerals, joints or strengths = {what}, were given and "
                "cannot be packed again; load the saved specimen"
            )
        if spec.kind == "half-disc":
            assert spec.diameters is not None
            corners = half_disc_corners(spec.sizes["diameter"], 0.5 * sum(spec.diameters))
            return cls._sawn(where, spec, polygon_outline(where, corners), progress)
        frame, outline = packed.frame_of(spec), packed.outline_of(spec)
        area = frame.area
        given = packed.packed_discs(where, spec, frame, area, progress)
        discs, cells = packed.tessellated(given, outline, spec.short_edge, drop_hidden=True)
        return cls(discs, outline, cells, spec, removed_discs=len(given) - len(discs))

    @classmethod
    def half_disc(
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
        """Saw the upper half of a disc out of a packed block, its lower left corner at the origin.

        Args:
            diameter: Diameter of the disc, along x [m].
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen; its arc has one chord for each grain along it, one of them on top.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        spec = SpecimenSpec(
            "half-disc",
            diameter=diameter,
            thickness=thickness,
            diameters=diameters,
            porosity=porosity,
            seed=seed,
            short_edge=short_edge,
        )
        return cls.pack(spec, progress)

    @classmethod
    def polygon(
        cls,
        corners: Sequence[Sequence[float]] | FloatArray,
        thickness: float,
        diameters: tuple[float, float] = (2e-3, 4e-3),
        porosity: float = 0.10,
        seed: int = 1,
        *,
        holes: Sequence[Sequence[Sequence[float]] | FloatArray] = (),
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> Specimen:
        """Saw an outline of any shape out of a packed block (D31 to D33).

        The block is the box around the outline. Grains on the outline are cut; those inside keep
        their cells. A rectangle along x and y, with holes or without, can be tested as such.

        Args:
            corners: Simple polygon, convex or not, in any sense [m]; the first one may come
                again at the end, here and wherever corners are given.
            thickness: Out of plane [m].
            diameters: Smallest and largest disc diameter [m].
            porosity: Sets the number of discs only [-]; the cells leave no pores.
            seed: Any integer from 0 to 2**64 - 1; the same seed gives the same specimen.
            holes: Corners of each hole [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-].
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or a polygon or holes that cross themselves or
                each other.
        """
        where = "Specimen.polygon"
        outline = polygon_outline(where, corners, holes)
        kind, sizes = kind_of(outline.rings[0])
        spec = SpecimenSpec(
            kind,
            width=sizes.get("width"),
            height=sizes.get("height"),
            thickness=thickness,
            diameters=diameters,
            porosity=porosity,
            seed=seed,
            short_edge=short_edge,
            outline=checksum(np.vstack(outline.rings)),
        )
        return cls._sawn(where, spec, outline, progress)

    @classmethod
    def _sawn(
        cls, where: str, spec: SpecimenSpec, outline: PolygonOutline, progress: Progress | None
    ) -> Specimen:
        """Saw an outline out of a packing of the box around it."""
        outer, *inner = outline.rings
        width, height = map(float, np.ptp(outer, axis=0))
        require_diameters(where, spec.diameters, min(width, height))
        frame = packing.Frame(width=width, height=height)
        block = packed.packed_discs(where, spec, frame, width * height, progress)
        length = spec.short_edge * 2.0 * float(np.mean(block[:, 2]))
        centres, radii = columns(block + np.append(outer.min(axis=0), 0.0))
        tiling = call(cells_in_outline, centres, radii, outline, length)
        return cls._of_tiling(tiling, outer, inner, spec)

    @classmethod
    def from_polygons(
        cls,
        polygons: Sequence[Sequence[Sequence[float]] | FloatArray],
        thickness: float,
        *,
        holes: bool = False,
    ) -> Specimen:
        """Make a specimen of given cells, which must tile their outline.

        Corners closer than 1e-6 mean diameters are one, and a corner as close to an edge divides it
        (D34). A cell whose edges are not all seen from one point is split (D32).

        Args:
            polygons: Corners of each cell, (n, 2) [m], in any sense.
            thickness: Out of plane [m].
            holes: Whether the cells may leave holes, of at least 2 % of a mean cell.

        Returns:
            The specimen; cells in the order given, second parts of split cells last.

        Raises:
            InputError: for cells that cross themselves, overlap, or leave a gap.
        """
        where = "Specimen.from_polygons"
        require_length(where, "thickness", thickness)
        require_flag(f"{where}: holes", holes)
        given = [ring(f"{where}: polygon {number}", one) for number, one in enumerate(polygons)]
        tiling, rings = call(cells_of_polygons, given, holes)
        kind, sizes = kind_of(rings[0])
        spec = SpecimenSpec(
            kind,
            width=sizes.get("width"),
            height=sizes.get("height"),
            thickness=thickness,
            diameters=None,
            porosity=None,
            seed=None,
            short_edge=0.0,
            discs=checksum(tiling.discs),
            outline=checksum(np.vstack(rings)),
            cells=cells_checksum(tiling.tessellation),
        )
        return cls._of_tiling(tiling, rings[0], rings[1:], spec)

    @classmethod
    def _of_tiling(
        cls,
        tiling: Tiling,
        outline: FloatArray,
        holes: Sequence[FloatArray],
        spec: SpecimenSpec,
    ) -> Specimen:
        discs = tiling.discs
        for array in (discs, outline, *holes):
            array.setflags(write=False)
        return cls(discs, outline, tiling.tessellation, spec, holes=tuple(holes))

    @classmethod
    def load(cls, path: Path | str) -> Specimen:
        """Read a specimen that ``save`` has written: the same grains to the bit.

        Raises:
            InputError: if the file cannot be read, is no specimen, or was changed.
        """
        stored = specimen_file.read(Path(path))
        return cls(**specimen_file.parts(stored))

    def save(self, path: Path | str) -> None:
        """Write the specimen as JSON; doc/files has the keys.

        Args:
            path: The file.
        """
        cells, outline = self.tessellation, self.outline
        corners, ends = cells.cell_vertices.tolist(), cells.cell_offsets.tolist()
        found = (
            np.full(len(cells.shared_edges), -1) if self.edge_joints is None else self.edge_joints
        )
        joints = np.column_stack((cells.shared_edges[:, 2:], found))
        fields = {
            "spec": dataclasses.asdict(self.spec),
            "outline": (
                dataclasses.asdict(outline) if isinstance(outline, Circle) else outline.tolist()
            ),
            "holes": [hole.tolist() for hole in self.holes],
            "removed_discs": self.removed_discs,
            "minerals": None if self.minerals is None else self.minerals.tolist(),
            "vertices": cells.vertices.tolist(),
            "cells": [corners[start:end] for start, end in itertools.pairwise(ends)],
            "discs": self.discs.tolist(),
            "sides": cells.boundary_edges[:, 1:].tolist(),
            "joints": joints[found >= 0].tolist(),
            "lines": self.joints,
            "cuts": {name: cut.to_json() for name, cut in self.joint_cuts.items()},
            "strengths": None if self.strengths is None else self.strengths.tolist(),
            "grains": None if self.grains is None else self.grains.tolist(),
        }
        specimen_file.write(Path(path), fields)

    @classmethod
    def from_discs(
        cls,
        centres: Sequence[Sequence[float]] | FloatArray,
        radii: Sequence[float] | FloatArray,
        outline: Sequence[Sequence[float]] | FloatArray | Circle,
        thickness: float,
        *,
        short_edge: float = SHORT_EDGE,
        drop_hidden: bool = False,
    ) -> Specimen:
        """Make a specimen of given discs; every disc must have a cell.

        Args:
            centres: Rows x, y [m], inside the outline.
            radii: One per centre [m].
            outline: Corners of a convex polygon, counter-clockwise [m], or a circle.
            thickness: Out of plane [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-]; 0: none.
            drop_hidden: Leave out discs that others hide, and count them in ``removed_discs``.

        Returns:
            The specimen, grains in the order of the discs.

        Raises:
            InputError: for a value out of range, a disc outside the outline or hidden by others.
        """
        require_length("Specimen.from_discs", "thickness", thickness)
        require_short_edge(short_edge)
        require_flag("Specimen.from_discs: drop_hidden", drop_hidden)
        given = disc_rows(centres, radii)
        if not isinstance(outline, Circle):
            outline = ring("Specimen.from_discs: outline", outline)
        discs, cells = packed.tessellated(given, outline, short_edge, drop_hidden=drop_hidden)
        kind, sizes = kind_of(outline)
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
            discs=checksum(discs),
            outline=checksum(outline),
        )
        return cls(discs, outline, cells, spec, removed_discs=len(given) - len(discs))

    def with_joints(self, joints: Mapping[str, Any], progress: Progress | None = None) -> Specimen:
        """Return the specimen cut by joints, whose laws the material has (D35 to D37).

        What lies outside, ends within a grain or lies on an earlier joint cuts nothing:
        ``joint_cuts`` says how much. A joint none of whose lines cuts has no contacts.

        Args:
            joints: By the name of the joint a line, rows x, y [m], or a list of lines.
            progress: Called with (lines done, lines, text).

        Returns:
            Cells in their order, second parts of cut cells last.

        Raises:
            InputError: if no line cuts anything, for a point that is not finite or further away
                than 1e6 sizes of the specimen, and for more than 20 000 segments within it.
        """
        lines = joint_lines.checked(joints)
        if self.strengths is not None:
            raise InputError(
                f"Specimen.with_joints: strengths = {len(self.strengths)}, belong to other "
                "contacts; cut first, then give strengths"
            )
        places = self.tessellation.vertices
        low, high = tuple(places.min(axis=0).tolist()), tuple(places.max(axis=0).tolist())
        joint_lines.require_within(lines, low, high)
        spec = self.spec.with_joints(lines)
        tiling, cuts = self._cut(lines, spec.joint_names or (), progress)
        joint_lines.require_any(cuts, lines, low, high)
        origin, discs, edge_joints = tiling.origin, tiling.discs, tiling.edge_joints
        minerals = None if self.minerals is None else self.minerals[origin]
        grains = origin if self.grains is None else self.grains[origin]
        for array in (discs, edge_joints, grains, minerals):
            if array is not None:
                array.setflags(write=False)
        return dataclasses.replace(
            self,
            discs=discs,
            tessellation=tiling.tessellation,
            spec=spec,
            minerals=minerals,
            edge_joints=edge_joints,
            grains=grains,
            joints={
                name: [*self.joints.get(name, ()), *lines.get(name, ())]
                for name in spec.joint_names or ()
            },
            joint_cuts=self.joint_cuts
            | {name: cut.and_(self.joint_cuts.get(name)) for name, cut in cuts.items()},
        )

    def _cut(
        self, lines: joint_lines.Lines, names: Sequence[str], progress: Progress | None
    ) -> tuple[Tiling, dict[str, joint_lines.Cut]]:
        """Cells cut by lines of joints, which are numbered by `names`, and what came of them."""
        numbers = {name: number for number, name in enumerate(names)}
        of_lines = [numbers[name] for name in lines for _ in lines[name]]
        before = np.full(len(self.tessellation.shared_edges), -1, dtype=np.int32)

        def tell(done: int) -> None:
            if progress is not None:
                progress(done, len(of_lines), "cutting joints")

        tiling, lengths, counts = call(
            cut_by_joints,
            self.tessellation,
            *columns(self.discs),
            before if self.edge_joints is None else self.edge_joints,
            [np.array(line) for given in lines.values() for line in given],
            np.array(of_lines, dtype=np.int32),
            tell,
        )
        cuts, first = {}, 0
        for name in lines:
            own = slice(first, first + len(lines[name]))
            first = own.stop
            length, cut, taken, outside = map(math.fsum, lengths[own].T)
            on = counts[own, 1][np.argmax(lengths[own, 2])] if taken > 0.0 else -1
            cuts[name] = joint_lines.Cut(
                lines=len(lines[name]),
                idle=int((counts[own, 0] == 0).sum()),
                length=length,
                cut=cut,
                taken=taken,
                outside=outside,
                on=None if on < 0 else names[on],
            )
        return tiling, cuts

    def with_strengths(self, factors: Sequence[float] | FloatArray) -> Specimen:
        """Return the specimen with contacts of different strength (D38).

        Args:
            factors: For each contact, in the order of ``tessellation.shared_edges``, the factor of
                cohesion and tensile strength [-]; the fracture energies have its square.

        Raises:
            InputError: if it is not one number above zero for each contact.
        """
        strengths = contact_strengths.checked(factors, len(self.tessellation.shared_edges))
        spec = dataclasses.replace(self.spec, strengths=checksum(strengths))
        return dataclasses.replace(self, strengths=strengths, spec=spec)

    def with_weibull_strengths(self, modulus: float, seed: int = 1) -> Specimen:
        """Return the specimen with strengths that follow Weibull's distribution, of mean 1.

        Args:
            modulus: Weibull's modulus m [-]; the smaller, the wider the scatter.
            seed: The same seed draws the same.

        Raises:
            InputError: for a modulus out of range.
        """
        contacts = len(self.tessellation.shared_edges)
        return self.with_strengths(contact_strengths.weibull(modulus, seed, contacts))

    def joint_lines(self) -> list[FloatArray]:
        """Ends (n, 2, 2) [m] of the contacts of each joint, in the order of their names."""
        cells, count = self.tessellation, len(self.spec.joint_names or ())
        ends = cells.vertices[cells.shared_edges[:, 2:]]
        return [ends[self.edge_joints == number] for number in range(count)]

    def joint_bends(self) -> dict[str, float]:
        """Largest distance of each joint's contacts from its lines, which bends to grains [m].

        Deviation D35; a joint of a file without its lines has none.
        """
        least, found = _STRAIGHT * self.mean_diameter, {}
        for name, ends in zip(self.spec.joint_names or (), self.joint_lines(), strict=True):
            if name in self.joints:
                bend = joint_bend.largest_bend(self.joints[name], ends)
                found[name] = bend if bend > least else 0.0
        return found

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
        spec = dataclasses.replace(self.spec, minerals=checksum(given))
        return dataclasses.replace(self, minerals=given, spec=spec)

    @property
    def kind(self) -> str:
        """``rectangle``, ``disc``, ``polygon`` or ``half-disc``."""
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

    @property
    def equal_diameter(self) -> float:
        """Diameter of a disc of the specimen's area [m]."""
        return math.sqrt(4.0 / math.pi * float(np.sum(self.tessellation.cell_areas)))

    def meshes(self, mesh: str = "refined") -> GrainMeshes:
        """Mesh the grains.

        Args:
            mesh: ``refined`` or ``fan``.

        Returns:
            The kernel's meshes: nodes, triangles and their offsets per grain as arrays.

        Raises:
            InputError: for an unknown mesh.
        """
        centres, radii = columns(self.discs)
        return call(grain_meshes, self.tessellation, centres, radii, mesh)

    def statistics(self) -> Table:
        """Count and measure grains, contacts, cells, meshes and joints.

        Returns:
            Counts, areas [m^2], lengths [m], angles [degree]; see the keys.
        """
        joints = {name: cut.to_json() for name, cut in self.joint_cuts.items()}
        meshes = self.meshes("refined"), self.meshes("fan")
        return {
            **statistics.of_cells(self.tessellation),
            **statistics.of_meshes(*meshes),
            "removed_discs": self.removed_discs,
            "mean_diameter": self.mean_diameter,
            **({"joints": joints} if joints else {}),
        }
