# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens of bonded grains: discs, their Laguerre cells, and figures of them, paper Sec. 3.1."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from .._flexpm import GrainMeshes, Tessellation, grain_meshes
from ..arrays import FloatArray, IntArray
from ..errors import InputError, SimulationError
from ..files import Table
from ..joints import geojson
from ..joints.bend import largest_bend
from ..joints.cuts import Cut
from ..joints.lines import Lines, Point
from ..joints.lines import checked as checked_lines
from ..joints.lines import read as read_lines
from ..notebook import Shown
from ..progress import Progress
from ..renamed import with_old_names
from ..require import quoted
from . import statistics
from . import strengths as contact_strengths
from .checks import SHORT_EDGE as SHORT_EDGE
from .files import specimen_file
from .joint_cutting import Excavatable, cut_cells
from .kernel_input import Circle, call, checksum, columns, mineral_indices
from .one_dimension import SolidOnly
from .plane import Filling
from .shapes import PlaneShapes
from .space.makers import SolidShapes
from .space.specimen import SolidSpecimen
from .spec import SpecimenSpec

#: Below this share of the mean diameter a distance is round-off [-].
_STRAIGHT = 1e-9


@with_old_names
@dataclass(frozen=True, eq=False)
class Specimen(PlaneShapes, SolidShapes, SolidOnly, Excavatable, Shown):
    """Bonded grains that fill a 2D outline.

    Make a specimen with ``rectangle``, ``disc``, ``half_disc``, ``polygon``, ``from_discs``,
    ``from_polygons``, ``from_labels``, ``from_ebsd``, ``from_tess`` or ``load``.

    Attributes:
        discs: Rows x, y, radius [m], one per grain: the disc of a Laguerre cell. For any other
            cell, a point from which all edges are visible, and the radius of a disc of its area.
        outline: Corners, counter-clockwise, (n, 2) [m], or a circle.
        tessellation: Cells of the grains; cell i belongs to disc i.
        spec: Inputs from which the specimen was made.
        removed_discs: Discs that had no cell and were left out.
        minerals: Index of each grain's mineral in its material; None: sampled by area fractions.
        holes: Corners of each hole of the outline, clockwise, (n, 2) [m].
        edge_joints: Per shared edge an index into ``spec.joint_names``, -1: none; None: no joints.
        joints: Requested lines of each joint, by its name [m].
        joint_cuts: Outcome of cutting the lines of each joint, by its name.
        regions: Numbers of regions and pixels of an image that were merged, filled or left out, by
            cause, and figures of the ``source``; not saved.
        mineral_names: Names of the minerals in a map or image, in their order. If the material has
            one of these minerals, it has the same index there.
        grains: Per cell the index of the grain before it was cut, by joints or for meshing; None:
            each cell is a grain.
        strengths: Factor of the strengths of each contact [-]; None: all 1.

    Example:
        >>> specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
        >>> len(specimen.discs), specimen.kind, specimen.dimensions
        (37, 'rectangle', {'width': 0.012, 'height': 0.024})
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
    joints: Lines = field(default_factory=dict)
    joint_cuts: dict[str, Cut] = field(default_factory=dict)
    regions: Table = field(default_factory=dict)
    mineral_names: tuple[str, ...] = ()

    @classmethod
    def _of(cls, made: Filling) -> Specimen:
        return cls(
            made.discs,
            made.outline,
            made.tessellation,
            made.spec,
            removed_discs=made.removed_discs,
            holes=made.holes,
            grains=made.grains,
            minerals=made.minerals,
            regions=made.regions,
            mineral_names=made.mineral_names,
        )

    @classmethod
    def load(cls, path: Path | str) -> Specimen:
        """Read a specimen that ``save`` has written, with bit-identical grains.

        Args:
            path: The file.

        Raises:
            InputError: if the file cannot be read, is not a specimen, or was changed.
        """
        stored = specimen_file.read(Path(path))
        return cls(**specimen_file.parts(stored))

    def save(self, path: Path | str) -> None:
        """Write the specimen as JSON; the page on specimen files has the keys.

        Args:
            path: The file.
        """
        specimen_file.write(Path(path), specimen_file.fields_of(vars(self)))

    def with_joints(
        self,
        joints: Mapping[str, object],
        progress: Progress | None = None,
        *,
        origin: Point | None = None,
    ) -> Specimen:
        """Return the specimen cut by joints, whose laws the material has (D35 to D37).

        A part of a line cuts nothing if it is outside, ends within a grain or coincides with an
        earlier joint: ``joint_cuts`` reports its length. A joint none of whose lines cuts has no
        contacts.

        Args:
            joints: By the name of the joint a line, rows x, y [m], or a list of lines.
            progress: Function that is called with (lines done, lines, text).
            origin: Point of the map at the origin of the specimen, reported in results [m].

        Returns:
            The specimen; cells in their order, second parts of cut cells last.

        Raises:
            InputError: if no line cuts anything, for a point that is not finite or farther away
                than 1e6 sizes of the specimen, and for more than 20 000 segments within it.

        Example:
            >>> cut = specimen.with_joints({"bedding": [(-0.01, 0.004), (0.02, 0.02)]})
            >>> len(cut.discs) > len(specimen.discs)
            True
        """
        return self._cut_by(checked_lines(joints), progress, origin)

    def _cut_by(
        self, lines: Lines, progress: Progress | None = None, origin: Point | None = None
    ) -> Specimen:
        """Return the specimen cut by validated lines."""
        if self.strengths is not None:
            raise InputError(
                f"Specimen.with_joints: strengths = {len(self.strengths)}, belong to other "
                "contacts; cut first, then give strengths"
            )
        spec = self.spec.with_joints(lines, origin)
        tiling, cuts = cut_cells(
            self.tessellation,
            self.discs,
            self.edge_joints,
            lines,
            spec.joint_names or (),
            progress,
        )
        cut, discs, edge_joints = tiling.origin, tiling.discs, tiling.edge_joints
        minerals = None if self.minerals is None else self.minerals[cut]
        grains = cut if self.grains is None else self.grains[cut]
        for array in (discs, edge_joints, grains, minerals):
            if array is not None:
                array.setflags(write=False)
        return replace(
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
            | {name: one.and_(self.joint_cuts.get(name)) for name, one in cuts.items()},
        )

    def joints_from_csv(self, path: Path | str, progress: Progress | None = None) -> Specimen:
        """Return the specimen cut by the joints of a CSV file, as ``--joints`` does.

        Args:
            path: Segments, columns x1, y1, x2, y2 [m] and name. Consecutive segments with the same
                name form a line.
            progress: Function that is called with (lines done, lines, text).

        Raises:
            InputError: if the file cannot be read or a row is not a segment, and as
                ``with_joints``.
        """
        return self.with_joints(read_lines(Path(path)), progress)

    def joints_from_geojson(
        self, path: Path | str, *, name: str | None = None, origin: Point | None = None
    ) -> Specimen:
        """Return the specimen cut by the lines of a map, as ``--joints`` does.

        Args:
            path: GeoJSON in metres with LineString and MultiLineString; other geometries are
                ignored.
            name: Property that names the joint of a line; default: ``name``, if all lines have it.
            origin: Point of the map at the origin of the specimen [m]; default: the lower left
                corner of the lines.

        Raises:
            InputError: for coordinates in degrees, a map that is broken or has no lines, and as
                ``with_joints``.
        """
        found = geojson.read(Path(path), name, origin)
        return self.with_joints(found.lines, origin=found.origin)

    def with_network(
        self,
        network: Path | str | Mapping[str, object],
        seed: int | None = None,
        progress: Progress | None = None,
    ) -> Specimen:
        """Return the specimen cut by the traces of a fracture network, as ``--network`` does.

        Each set of traces is a joint, which needs a joint law in the material.

        Args:
            network: TOML file of the network, or its content as a table: the ``seed``, and for each
                joint under ``set`` its P21 ``intensity`` [1/m] and the laws ``length`` [m] and
                ``orientation`` [degree].
            seed: Seed that replaces the network's seed; equal seeds generate equal traces.
            progress: Called with (lines done, lines, text).

        Returns:
            The cut specimen.

        Raises:
            InputError: for a value out of range, a network without traces or with more than 20 000
                traces, a set with the name of an existing joint, and as ``with_joints``.
        """
        from ..joints.network import Network

        if isinstance(network, Path | str):
            chosen = Network.read(network, seed)
        else:
            chosen = Network.of(network, seed)
        outline = vars(self.outline) if isinstance(self.outline, Circle) else self.outline
        lines = chosen.lines(self.spec.window(outline))
        spec = self.spec.with_network(chosen.to_json(), lines)
        return replace(self.with_joints(lines, progress), spec=spec)

    def network_intensities(self) -> dict[str, dict[str, float]]:
        """Return the P21 of each set of a network [1/m], as ``target``, ``generated`` and ``cut``.

        ``target`` is the requested intensity. ``generated`` is the intensity of the generated
        traces in the specimen; it scatters about the target from seed to seed. ``cut`` is the
        intensity of the contacts on the traces, which deviate from the traces to follow grains
        (deviation D35).
        """
        ends = dict(zip(self.spec.joint_names or (), self.joint_lines(), strict=True))
        area, asked = float(np.sum(self.tessellation.cell_areas)), self.spec.asked_intensities
        return statistics.of_networks(asked, ends, self.joint_cuts, area)

    def with_strengths(self, factors: Sequence[float] | FloatArray) -> Specimen:
        """Return the specimen with contacts of different strength (D38).

        Args:
            factors: For each contact, in the order of ``tessellation.shared_edges``, the factor of
                cohesion and tensile strength [-]; the factor of the fracture energies is its
                square.

        Raises:
            InputError: unless there is one number > 0 for each contact.
        """
        strengths = contact_strengths.checked(factors, len(self.tessellation.shared_edges))
        spec = replace(self.spec, strengths=checksum(strengths))
        return replace(self, strengths=strengths, spec=spec)

    def with_weibull_strengths(self, modulus: float, seed: int = 1) -> Specimen:
        """Return the specimen with strengths that follow Weibull's distribution, of mean 1.

        Args:
            modulus: Weibull's modulus m [-]; the smaller, the wider the scatter.
            seed: The same seed generates the same strengths.

        Raises:
            InputError: for a modulus out of range.

        Example:
            >>> scattered = specimen.with_weibull_strengths(10.0)
            >>> len(scattered.strengths) == specimen.statistics()["contacts"]
            True
        """
        contacts = len(self.tessellation.shared_edges)
        return self.with_strengths(contact_strengths.weibull(modulus, seed, contacts))

    def joint_lines(self) -> list[FloatArray]:
        """Return the ends (n, 2, 2) [m] of the contacts of each joint, in the order of names."""
        cells, count = self.tessellation, len(self.spec.joint_names or ())
        ends = cells.vertices[cells.shared_edges[:, 2:]]
        return [ends[self.edge_joints == number] for number in range(count)]

    def joint_deviations(self) -> dict[str, float]:
        """Return the largest distance between each joint's contacts and its lines, by name [m].

        The cut deviates from the requested lines to follow grains (deviation D35); 0 for a straight
        cut. A joint from a file without its lines is left out.
        """
        least, found = _STRAIGHT * self.mean_diameter, {}
        for name, ends in zip(self.spec.joint_names or (), self.joint_lines(), strict=True):
            if name in self.joints:
                bend = largest_bend(self.joints[name], ends)
                found[name] = bend if bend > least else 0.0
        return found

    def with_minerals(self, minerals: Sequence[int] | IntArray) -> Specimen:
        """Return the same grains with a given mineral each.

        Args:
            minerals: For each grain an index into the minerals of the material.

        Raises:
            InputError: unless there is one index for each grain.
        """
        given = mineral_indices(minerals, len(self.discs))
        spec = replace(self.spec, minerals=checksum(given))
        return replace(self, minerals=given, spec=spec, mineral_names=())

    @property
    def kind(self) -> str:
        """``rectangle``, ``disc``, ``polygon`` or ``half-disc``."""
        return self.spec.kind

    @property
    def dimensions(self) -> dict[str, float]:
        """``width`` and ``height``, or ``diameter`` [m]; empty for a polygon."""
        return self.spec.sizes

    @property
    def extent(self) -> dict[str, float]:
        """Sizes of the shape by their names [m]; for a polygon the sizes of its bounding box."""
        if self.dimensions:
            return self.dimensions
        assert not isinstance(self.outline, Circle)  # a circle has a diameter
        width, height = np.ptp(self.outline, axis=0).tolist()
        return {"width": width, "height": height}

    @property
    def thickness(self) -> float:
        """Thickness out of plane [m]."""
        return self.spec.thickness

    @property
    def seed(self) -> int | None:
        """Seed of a packing, None for given discs."""
        return self.spec.seed

    @property
    def short_edge(self) -> float:
        """Ratio to the mean diameter below which edges of cells were collapsed [-]."""
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

    size_name = "area"  #: what cells are measured by
    #: The specimen before notches of a test have cut its cells; a cut along joints is none.
    before = None
    parents = None
    depth = None  #: along y [m], of a 3D specimen

    @property
    def cell_sizes(self) -> FloatArray:
        """Area of each cell [m2]."""
        return np.asarray(self.tessellation.cell_areas)

    @property
    def side_depth(self) -> float:
        """Ratio of the area of a side to its length [m]."""
        return self.thickness

    @property
    def smallest_size(self) -> float:
        """Smallest size of its bounding box, or the diameter of a disc [m]."""
        if isinstance(self.outline, Circle):
            return self.dimensions["diameter"]
        return float(np.min(np.ptp(self.outline, axis=0)))

    @property
    def corners(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lower left and upper right corner of the bounding rectangle [m].

        Raises:
            SimulationError: for a circle, which no test between parts accepts.
        """
        if isinstance(self.outline, Circle):
            raise SimulationError(
                "outline = circle, must be a polygon for a test between parts; use another shape"
            )
        (left, bottom), (right, top) = self.outline.min(axis=0), self.outline.max(axis=0)
        return (left, bottom), (right, top)

    @property
    def heights(self) -> tuple[float, float]:
        """Heights of the lower and the upper end [m]."""
        assert not isinstance(self.outline, Circle)
        return float(self.outline[:, 1].min()), float(self.outline[:, 1].max())

    def wall_distances(self) -> FloatArray:
        """Return the distance of each centre from the nearest side of a rectangle [m]; else inf."""
        if self.kind != "rectangle" or isinstance(self.outline, Circle):
            return np.full(len(self.discs), np.inf)
        low, high = self.outline.min(axis=0), self.outline.max(axis=0)
        found: FloatArray = np.minimum(self.centres - low, high - self.centres).min(axis=1)
        return found

    def lines_of(self, joint: str) -> FloatArray:
        """Return the ends (n, 2, 2) [m] of the contacts of a joint; none for an unknown name."""
        names = self.spec.joint_names or ()
        return self.joint_lines()[names.index(joint)] if joint in names else np.empty((0, 2, 2))

    def meshes(self, mesh: str = "refined") -> GrainMeshes:
        """Mesh the grains.

        Args:
            mesh: ``refined`` or ``fan``.

        Returns:
            The kernel's meshes: arrays of nodes and triangles, and their offsets per grain.

        Raises:
            InputError: for an unknown mesh.
        """
        centres, radii = columns(self.discs)
        return call(grain_meshes, self.tessellation, centres, radii, mesh)

    def statistics(self) -> Table:
        """Count and measure grains, contacts, cells, meshes and joints.

        Returns:
            Counts, areas [m2], lengths [m], angles [degree]; see the keys.

        Example:
            >>> found = specimen.statistics()
            >>> found["grains"], found["contacts"], round(found["mean_diameter"] * 1e3, 2)
            (37, 85, 2.84)
        """
        joints = {name: cut.to_json() for name, cut in self.joint_cuts.items()}
        networks = self.network_intensities()
        meshes = self.meshes("refined"), self.meshes("fan")
        return {
            **statistics.of_cells(self.tessellation),
            **statistics.of_meshes(*meshes),
            "removed_discs": self.removed_discs,
            "mean_diameter": self.mean_diameter,
            **({"joints": joints} if joints else {}),
            **({"networks": networks} if networks else {}),
        }


#: Specimens of both dimensions.
AnySpecimen = Specimen | SolidSpecimen


def require_specimen(where: str, given: object) -> None:
    """Raise an error unless the value is a specimen.

    Raises:
        InputError: for any other value.
    """
    if not isinstance(given, AnySpecimen):
        raise InputError(
            f"{where}: specimen = {quoted(given)}, must be a Specimen; pass e.g. "
            "Specimen.rectangle(...)"
        )
