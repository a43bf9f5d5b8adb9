# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens of bonded polyhedral grains: spheres, Laguerre cells, and measures of them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..._flexpm import FanMeshes, Polyhedra, Solid, fan_meshes, weighted_cells
from ...arrays import BoolArray, FloatArray, IntArray
from ...errors import InputError
from ...files import Table
from ...joints import dfnworks, plane_files
from ...joints.planes import JointPlane, PlanesCut, checked, names_of, require_few, require_size
from ...progress import Progress
from ...renamed import with_old_names
from ...require import quoted, require_flag
from ..kernel_input import call, checksum, checksums_of_starts, mineral_indices
from ..one_dimension import PlaneOnly
from . import cells as of_spheres
from . import cuts, file
from . import holes as of_holes
from .own_cells import KINDS, OwnCells
from .spec import SHORT_EDGE, SIZES, SolidSpec

if TYPE_CHECKING:
    from ..volumes.volume_report import VolumeReport

#: Least volume of a tetrahedron, in cubes of the mean diameter [-].
_FLAT = 1e-12
#: Below this share of the volume of a specimen a volume is round-off [-].
_NO_VOLUME = 1e-9


@with_old_names
@dataclass(frozen=True, eq=False)
class SolidSpecimen(PlaneOnly):
    """Bonded polyhedral grains that fill a box, a cylinder, a disc or half a disc.

    Make a 3D specimen with ``Specimen.box``, ``cylinder``, ``solid_disc``, ``solid_half_disc``,
    ``from_spheres``, ``from_tess_solid`` or ``load_solid``.

    Attributes:
        spheres: Rows x, y, z, radius [m], one per grain: the sphere of a Laguerre cell. For a given
            cell, or a part of a cell that joints have cut, its centroid, and the radius of a ball
            of its volume.
        cells: Cells of the grains; cell i belongs to sphere i.
        spec: Inputs from which the specimen was made.
        removed_spheres: Spheres that had no cell and were left out.
        minerals: Index of each grain's mineral in its material; None: sampled by volume fractions.
        given: Given cells, before short edges were collapsed; None: cells of spheres.
        mineral_names: Names of the minerals of a label volume, in their order. If the material has
            a mineral of one of these names, it must have the same index.
        fit: Comparison of a label volume with the cells; None for other specimens, and not saved.
        uncut: Spheres of the cells before joints and holes cut them; None without these.
        planes: Planes of the joints, in the order in which they are cut.

    Example:
        >>> core = flexpm.Specimen.cylinder(0.008, 0.012)
        >>> len(core.spheres), core.kind
        (35, 'cylinder')
    """

    spheres: FloatArray
    cells: Polyhedra
    spec: SolidSpec
    removed_spheres: int = 0
    minerals: IntArray | None = None
    given: OwnCells | None = None
    mineral_names: tuple[str, ...] = ()
    fit: VolumeReport | None = None
    uncut: FloatArray | None = None
    planes: tuple[JointPlane, ...] = ()

    @classmethod
    def pack(cls, spec: SolidSpec, progress: Progress | None = None) -> SolidSpecimen:
        """Pack the specimen that `spec` describes.

        Raises:
            InputError: for spheres that do not fit, or for a `spec` of given spheres.
        """
        where = f"Specimen.{spec.kind}"
        if not spec.is_packed:
            what = spec.spheres or spec.minerals or spec.joints or spec.holes
            raise InputError(
                f"{where}: spheres, minerals, joints or holes = {what}, were given and cannot be "
                "packed again; load the saved specimen"
            )
        given = of_spheres.packed_spheres(where, spec, progress)
        spheres, cells = of_spheres.cells_of(given, spec, drop_hidden=True)
        return cls(spheres, cells, spec, len(given) - len(spheres))

    @classmethod
    def of_spheres(
        cls,
        spheres: npt.ArrayLike | Path | str,
        sizes: dict[str, float | None],
        *,
        short_edge: float = SHORT_EDGE,
        drop_hidden: bool = False,
    ) -> SolidSpecimen:
        """Make a specimen of given spheres; see ``Specimen.from_spheres``."""
        require_flag("Specimen.from_spheres: drop_hidden", drop_hidden)
        kind = "box"
        if sizes.get("diameter") is not None:
            kind = "solid-disc" if sizes.get("height") is None else "cylinder"
        for name in SIZES[kind]:
            if sizes.get(name) is None:
                raise InputError(
                    f"Specimen.from_spheres: {name} = None, must be given for a {kind}; pass "
                    "it, since given spheres have no default sizes"
                )
        given = of_spheres.sphere_rows(spheres)
        spec = SolidSpec(
            kind,
            sizes.get("width"),
            sizes.get("depth"),
            sizes.get("height"),
            sizes.get("diameter"),
            diameters=None,
            porosity=None,
            seed=None,
            short_edge=short_edge,
            spheres=checksum(given),
        )
        kept, cells = of_spheres.cells_of(given, spec, drop_hidden=drop_hidden)
        spec = dataclasses.replace(spec, spheres=checksum(kept))
        return cls(kept, cells, spec, len(given) - len(kept))

    @classmethod
    def of_cells(
        cls, given: OwnCells, kind: str, sizes: dict[str, float], short_edge: float = SHORT_EDGE
    ) -> SolidSpecimen:
        """Make a specimen of given cells that fill a box, a cylinder or a disc.

        Args:
            given: Cells in the place of the shape: a box has a corner at the origin.
            kind: ``box``, ``cylinder`` or ``solid-disc``.
            sizes: Sizes of the shape by their names [m].
            short_edge: Ratio to the mean diameter below which edges are collapsed [-].

        Raises:
            InputError: as ``Specimen.from_tess_solid``.
        """
        spheres = np.ascontiguousarray(given.spheres()[: given.grains])
        spec = SolidSpec(
            kind,
            sizes.get("width"),
            sizes.get("depth"),
            sizes.get("height"),
            sizes.get("diameter"),
            diameters=None,
            porosity=None,
            seed=None,
            short_edge=short_edge,
            spheres=checksum(spheres),
            cells=given.checksum(),
        )
        spheres.setflags(write=False)
        return cls(spheres, given.polyhedra(spheres, spec), spec, given=given)

    @classmethod
    def load(cls, path: Path | str) -> SolidSpecimen:
        """Read a specimen that ``save`` has written, with bit-identical grains.

        Raises:
            InputError: if the file cannot be read, is not a 3D specimen, or was changed, or if its
                spheres do not agree with its inputs.
        """
        content = file.read(Path(path))
        spec: SolidSpec = content["spec"]
        spheres = np.array(content["spheres"], dtype=float)
        of_spheres.require_made_from(spec, spheres, content["removed_spheres"])
        own = OwnCells.of_file(content)
        if spec.networks:
            from ...joints.disc_network import DiscNetwork

            [*map(DiscNetwork.of, spec.networks)]
        planes = tuple(map(JointPlane.from_json, content.get("planes", ())))
        if (None if not planes else names_of(planes)) != spec.joint_names:
            raise InputError(
                f"specimen = {str(path)!r}, has other joints than it names; save it again"
            )
        whole, spheres, cells = _cut(spheres, own, spec, planes)
        minerals = content.get("minerals")
        given = None if minerals is None else mineral_indices(minerals, len(spheres))
        # those of the grains before joints cut them, or of some of their parts
        named = [None] if given is None else checksums_of_starts(given, len(whole))
        if spec.minerals not in [*named]:
            raise InputError(
                f"specimen = {str(path)!r}, has other minerals than it names; save it again"
            )
        names = tuple(content.get("mineral_names", ()))
        return cls(
            *(spheres, cells, spec, content["removed_spheres"], given, own, names),
            uncut=whole if planes or spec.holes else None,
            planes=planes,
        )

    def save(self, path: Path | str) -> None:
        """Write the specimen as JSON: its inputs, its spheres, and given cells.

        Args:
            path: The file.
        """
        file.write(
            Path(path),
            {
                "spec": dataclasses.asdict(self.spec),
                "removed_spheres": self.removed_spheres,
                **({} if self.minerals is None else {"minerals": self.minerals.tolist()}),
                **({"mineral_names": list(self.mineral_names)} if self.mineral_names else {}),
                **({} if self.given is None else self.given.fields()),
                **({"planes": [one.to_json() for one in self.planes]} if self.planes else {}),
                "spheres": self.whole_spheres.tolist(),
            },
        )

    def with_joints(
        self, joints: Mapping[str, object], progress: Progress | None = None
    ) -> SolidSpecimen:
        """Return the specimen cut by joints, whose laws the material has (D107).

        All cuts are made again in their order, so a specimen that has joints may get more. A joint
        ends within the rock between grains: a grain is cut if at least half of its section lies
        within the disc or polygon.

        Args:
            joints: By the name of the joint a shape, or a list of shapes: a whole plane
                ``{"point": (x, y, z), "dip": ..., "dip_direction": ...}``; a disc, which also has a
                ``radius`` and has its ``centre`` for the point; or a convex polygon, rows x, y, z
                [m]. Dips are in degrees, dip directions clockwise from y, seen from above.
            progress: Not used: a cut takes milliseconds.

        Returns:
            The specimen; grains in their order, second parts of cut grains last.

        Raises:
            InputError: for a shape that is not plane, not convex or without area, a disc smaller
                than a grain, parts of a grain with different minerals, and if no plane cuts
                anything.

        Example:
            >>> cut = solid.with_joints(
            ...     {"fault": {"point": (0.004, 0.004, 0.006), "dip": 50, "dip_direction": 90}}
            ... )
            >>> len(cut.spheres) > len(solid.spheres)
            True
        """
        return self._cut_by(checked(joints))

    def joints_from_csv(self, path: Path | str, progress: Progress | None = None) -> SolidSpecimen:
        """Return the specimen cut by the joints of a CSV file, as ``--joints`` does.

        Args:
            path: A row for each polygon, columns name, x0, y0, z0, x1, ... [m]; or for each disc,
                columns x, y, z, dip, dip_direction, radius and name; without radius: whole planes.
            progress: Not used.

        Raises:
            InputError: if the file cannot be read or a row is no polygon, disc or plane, and as
                ``with_joints``.
        """
        return self._cut_by(plane_files.read(Path(path)))

    def joints_from_dfnworks(self, path: Path | str, joint: str) -> SolidSpecimen:
        """Return the specimen cut by the polygons of dfnWorks, as ``--joints`` does.

        The middle of the domain of dfnWorks is placed at the middle of the specimen.

        Args:
            path: ``polygons.dat`` of dfnWorks [m].
            joint: Name of the joint that all polygons get.

        Raises:
            InputError: if the file cannot be read or a line is no convex polygon, and as
                ``with_joints``.
        """
        return self._cut_by(dfnworks.read(Path(path), joint, self.spec.middle))

    def with_network(
        self,
        network: Path | str | Mapping[str, object],
        seed: int | None = None,
        progress: Progress | None = None,
    ) -> SolidSpecimen:
        """Return the specimen cut by the planes of a fracture network, as ``--network`` does.

        Each set of discs or planes is a joint, which needs a joint law in the material.

        Args:
            network: TOML file of the network, or its content as a table: the ``seed``, and for each
                joint under ``set`` a table of ``kind`` ``discs`` or ``planes``.
            seed: Seed that replaces the network's seed; equal seeds generate equal planes.
            progress: Not used.

        Returns:
            The cut specimen.

        Raises:
            InputError: for a value out of range, a network without planes or with more than 20 000
                planes, a set with the name of an existing joint, and as ``with_joints``.
        """
        from ...joints.disc_network import Box, DiscNetwork

        if isinstance(network, Path | str):
            chosen = DiscNetwork.read(network, seed)
        else:
            chosen = DiscNetwork.of(network, seed)
        return self._cut_by(chosen.planes(Box(*self.spec.corners)), chosen.to_json())

    def cut_by(
        self, planes: Sequence[JointPlane], network: Table | None, of_network: Sequence[JointPlane]
    ) -> SolidSpecimen:
        """Return the specimen cut by given planes, and then by those of a network.

        Args:
            planes: Checked planes; none: no cut.
            network: Table of the network; None: no network.
            of_network: Planes that it has generated.

        Raises:
            InputError: as ``with_joints``.
        """
        found = self._cut_by(planes) if planes else self
        return found if network is None else found._cut_by(of_network, network)

    def _cut_by(self, planes: Sequence[JointPlane], network: Table | None = None) -> SolidSpecimen:
        """Return the specimen cut by checked planes, the table of whose network may be given."""
        require_size(planes, self.mean_diameter)
        every = (*self.planes, *planes)
        require_few(every)
        found = self._cut_again(self.spec.with_joints(planes, network), every)
        told = found.told_cuts
        if all(told[one.name].cut <= 0.0 for one in planes):
            low, high = (end(self.cells.vertices, axis=0) for end in (np.min, np.max))
            raise InputError(
                f"joints: planes that cut a grain = 0 of {len(planes)}, must be >= 1; the specimen "
                f"extends from {_place(low)} to {_place(high)}: move or enlarge them"
            )
        return found

    def with_holes(self, holes: Sequence[Mapping[str, object]]) -> SolidSpecimen:
        """Return the specimen with holes: cylinders along any axis, and boxes (D108).

        Grains are cut along the wall of a hole, and their parts within it are removed. All cuts are
        made again: first of joints, then of holes in their order. A part that would be too small to
        stay is removed or left with its grain, see `told_holes`.

        Args:
            holes: For each hole a table: of a cylinder a ``point`` of its axis [m], the direction
                ``axis`` and the ``diameter`` [m]; of a box its corners ``low`` and ``high``, x, y
                and z [m]. A cylinder goes through the specimen; one with a ``length`` [m] begins at
                the point and ends at this length along the axis. It is a prism of the same section
                with a number of ``facets``: by default one for each grain around it, and at least
                16.

        Returns:
            The specimen; grains in their order, second parts of cut grains last.

        Raises:
            InputError: for a table that is no hole, a hole outside the specimen, smaller than a
                grain or given twice, holes that leave fewer than two grains, and parts of a grain
                with different minerals.

        Example:
            >>> cut = solid.with_holes(
            ...     [{"point": (0.004, 0.004, 0.006), "axis": (0, 1, 0), "diameter": 0.004}]
            ... )
            >>> f"{1e9 * cut.told_holes[0].volume:.2f} mm3"
            '100.53 mm3'
        """
        new = of_holes.checked(holes, self.mean_diameter, self.holes)
        spec = dataclasses.replace(self.spec, holes=(*self.holes, *new))
        found = self._cut_again(spec, self.planes)
        low, high = self.spec.corners
        for number, told in enumerate(found.told_holes):
            if not told.volume > _NO_VOLUME * self.spec.volume:
                raise InputError(
                    f"hole {number}: volume inside the rock = {told.volume:.3g} m3, must be above "
                    f"0; the specimen extends from {_place(low)} to {_place(high)}: move the hole"
                )
        if found.cells.cells < 2:
            raise InputError(
                f"holes: grains left = {found.cells.cells}, must be >= 2; make the holes smaller"
            )
        try:
            flattest = found.meshes().volumes.min() / self.mean_diameter**3
            of_spheres.contact_points(found.cells)
        except InputError:
            flattest = 0.0
        if not flattest > _FLAT:
            raise InputError(
                f"hole {len(found.holes) - 1}: its wall cuts a grain so that a face is too narrow; "
                "move the hole by a tenth of a grain, or choose other facets"
            )
        return found

    @property
    def holes(self) -> tuple[Table, ...]:
        """Holes as tables of plain values, in the order of `PartRig.fluid`."""
        return self.spec.holes or ()

    @property
    def told_holes(self) -> list[of_holes.HoleCut]:
        """Outcome of the cut of each hole: volume [m3], wall [m2] and its deviation [m]."""
        return cuts.hole_outcomes(self.cells, self.spec, self.mean_diameter)

    @property
    def hole_volume(self) -> float:
        """Volume that holes have removed [m3]: that of the outline minus the cells and pores."""
        if not self.holes:
            return 0.0
        whole, *_, cells = _cut(
            *(self.whole_spheres, self.given, dataclasses.replace(self.spec, holes=None)),
            self.planes,
        )
        return math.fsum(cells.volumes) - math.fsum(self.cells.volumes)

    def _cut_again(self, spec: SolidSpec, planes: tuple[JointPlane, ...]) -> SolidSpecimen:
        """Return the specimen with other joints or holes; parts have the minerals of grains."""
        before = self._whole_minerals()
        whole, spheres, cells = _cut(self.whole_spheres, self.given, spec, planes)
        minerals = None if before is None else before[cells.sphere_of_cell]
        if minerals is not None:
            minerals.setflags(write=False)
            if spec.holes:  # grains that have gone have none
                spec = dataclasses.replace(spec, minerals=checksum(minerals))
        return dataclasses.replace(
            self,
            spheres=spheres,
            cells=cells,
            spec=spec,
            minerals=minerals,
            uncut=whole,
            planes=planes,
        )

    def _whole_minerals(self) -> IntArray | None:
        """Mineral of each grain before joints and holes cut them, 0 if nothing of it is left.

        Raises:
            InputError: if parts of one grain have different minerals.
        """
        if self.minerals is None or self.grains is None:
            return self.minerals
        found: IntArray = np.zeros(len(self.whole_spheres), dtype=self.minerals.dtype)
        found[self.grains[::-1]] = self.minerals[::-1]  # of the first part of each grain
        mixed = np.flatnonzero(self.minerals != found[self.grains])
        if mixed.size:
            raise InputError(
                f"minerals: parts of grain {self.grains[mixed[0]]} have two, must be one before "
                "more joints; cut first, then with_minerals"
            )
        return found

    @property
    def whole_spheres(self) -> FloatArray:
        """Spheres of the grains before joints cut them, rows x, y, z, radius [m]."""
        return self.spheres if self.uncut is None else self.uncut

    def with_minerals(self, minerals: Sequence[int] | IntArray) -> SolidSpecimen:
        """Return the same grains with a given mineral each; see ``Specimen.with_minerals``."""
        given = mineral_indices(minerals, len(self.spheres))
        spec = dataclasses.replace(self.spec, minerals=checksum(given))
        return dataclasses.replace(self, minerals=given, spec=spec, mineral_names=())

    def without_grains(self, grains: Sequence[int] | IntArray | BoolArray) -> SolidSpecimen:
        """Return the specimen without some of its grains; the walls of their cells are free.

        Remove grains before joints cut the specimen.

        Args:
            grains: Indices of the grains, or for each grain whether it is removed, (n,) bools.

        Returns:
            The other grains, in their order.

        Raises:
            InputError: for a number out of range, for a specimen that is not a box, cylinder or
                disc of Laguerre cells without joints, and if fewer than two grains are left.

        Example:
            >>> low = solid.without_grains(solid.centres[:, 2] > 0.008)
            >>> 2 <= len(low.spheres) < len(solid.spheres)
            True
        """
        count = len(self.spheres)
        given = np.asarray(grains)
        if given.dtype == bool and given.shape != (count,):
            raise InputError(
                f"without_grains: flags = {given.size}, must be {count}; give one for each grain"
            )
        if given.size and given.dtype.kind not in "biu":
            raise InputError(
                f"without_grains: grains = {quoted(grains)}, must be integers or bools; give "
                "indices of grains, or one bool for each grain"
            )
        numbers = np.flatnonzero(given) if given.dtype == bool else given.astype(int).ravel()
        if len(numbers) and not 0 <= numbers.min() <= numbers.max() < count:
            wrong = numbers[(numbers < 0) | (numbers >= count)][0]
            raise InputError(
                f"without_grains: grain = {wrong}, must be 0 to {count - 1}; give indices of this "
                "specimen's grains"
            )
        if self.planes or self.holes or self.given is not None or self.kind not in KINDS:
            raise InputError(
                "without_grains: cells = cut or given, must be Laguerre cells of a box, cylinder "
                "or disc; remove grains before joints are cut"
            )
        removed = np.zeros(count, dtype=bool)
        removed[numbers] = True
        if count - removed.sum() < 2:
            raise InputError(
                f"without_grains: grains left = {count - removed.sum()}, must be >= 2; remove fewer"
            )
        spheres = self.spheres[np.argsort(removed, kind="stable")]
        points = np.ascontiguousarray(spheres[:, :3])
        cells = call(weighted_cells, points, spheres[:, 3] ** 2, self.outline())
        own = OwnCells.of_weighted(cells).with_pores(int(removed.sum()))
        made = SolidSpecimen.of_cells(own, self.kind, self.dimensions, self.spec.short_edge)
        return made if self.minerals is None else made.with_minerals(self.minerals[~removed])

    @property
    def kind(self) -> str:
        """``box``, ``cylinder``, ``solid-disc`` or ``solid-half-disc``."""
        return self.spec.kind

    @property
    def dimensions(self) -> dict[str, float]:
        """Sizes of the shape by their names [m]."""
        return self.spec.sizes

    @property
    def extent(self) -> dict[str, float]:
        """Sizes of the shape by their names [m]."""
        return self.dimensions

    @property
    def seed(self) -> int | None:
        """Seed of the packing; None for given spheres."""
        return self.spec.seed

    @property
    def thickness(self) -> float:
        """Depth of a disc or half a disc, else the square root of the area of the section [m].

        This value times the width of the scales is the area to which the stress refers.
        """
        if "height" not in self.dimensions:
            return self.dimensions["depth"]
        return math.sqrt(self.outline().volume / self.dimensions["height"])

    @property
    def equal_diameter(self) -> float:
        """Diameter of a ball of the specimen's volume [m]."""
        return float(np.cbrt(6.0 / math.pi * self.spec.volume))

    size_name = "volume"  #: what cells are measured by
    side_depth = 1.0  #: factor from the size of a side to its area

    @property
    def before(self) -> SolidSpecimen | None:
        """The 3D specimen before notches of a test have cut its cells; None without notches."""
        return None

    @property
    def parents(self) -> IntArray | None:
        """Index of each grain's grain before notches have cut cells; None without notches."""
        return None

    @property
    def grains(self) -> IntArray | None:
        """Index of the grain that each cell was a part of before it was cut; None: no cuts."""
        return self.cells.sphere_of_cell if self.planes or self.holes else None

    @property
    def depth(self) -> float | None:
        """Size along y of a box, a disc or half a disc [m]."""
        return self.dimensions.get("depth")

    @property
    def cell_sizes(self) -> FloatArray:
        """Volume of each cell [m3]."""
        return self.cells.volumes

    @property
    def smallest_size(self) -> float:
        """Smallest size of the shape [m]."""
        return min(self.dimensions.values())

    @property
    def corners(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lower left and upper right corner of the section along x and z [m]."""
        sizes = self.dimensions
        if self.kind == "solid-half-disc":
            radius = 0.5 * sizes["diameter"]
            return (-radius, 0.0), (radius, radius)
        return (0.0, 0.0), (sizes["width"], sizes["height"])

    @property
    def heights(self) -> tuple[float, float]:
        """Heights of the lower and the upper end [m]."""
        return 0.0, self.dimensions["height"]

    def wall_distances(self) -> FloatArray:
        """Return the distance of each centre from the nearest wall [m]."""
        x, y, z = self.centres.T
        walls = self.outline().walls.tolist()
        found: FloatArray = np.min([d - (a * x + b * y + c * z) for a, b, c, d in walls], axis=0)
        return found

    def lines_of(self, joint: str) -> FloatArray:
        """Return the ends (n, 2, 2) [m] of notches in the section along x and z: none."""
        return np.empty((0, 2, 2))

    def joint_lines(self) -> list[FloatArray]:
        """Return no lines: the joints of a 3D specimen are planes."""
        return [np.empty((0, 2, 2)) for _ in self.spec.joint_names or ()]

    def joint_traces(self) -> dict[str, IntArray]:
        """Return the edges (n, 2) at which each joint meets the surface, by name: vertices."""
        return cuts.traces(self.cells, self.planes)

    def joint_deviations(self) -> dict[str, float]:
        """Return the largest distance between each joint's contacts and its planes, by name [m].

        The cut deviates from the plane to follow grains (D107); 0 for a plane cut.
        """
        if not self.planes:
            return {}
        return cuts.deviations(self.cells, self.planes, self.mean_diameter)

    def network_intensities(self) -> dict[str, Table]:
        """Return the P32 of each set of a network [1/m], and more measures of it.

        ``target`` is the requested intensity; None if a number of discs or a spacing was requested.
        ``generated`` is the area of the planes in the specimen over its volume, ``cut`` that of the
        contacts on them, as seen along their normals. ``p10_x``, ``p10_y`` and ``p10_z`` are the
        mean numbers of generated planes that lines along the axes meet [1/m]. ``planes`` counts
        those in the specimen; ``dip``, ``dip_direction`` and ``concentration`` are of their mean
        pole; a concentration is too large below about 5.
        """
        return cuts.of_sets(self.cells, self.planes, self.spec.sets, self.spec.volume)

    @property
    def told_cuts(self) -> dict[str, PlanesCut]:
        """Outcome of the cuts of each joint, by its name: numbers of planes, and areas [m2]."""
        return cuts.outcomes(self.cells, self.planes, self.spec.volume, self.mean_diameter)

    @property
    def edge_joints(self) -> IntArray | None:
        """Joint of each contact, an index into ``spec.joint_names``, -1: none; None: no joints."""
        return cuts.contact_joints(self.cells, self.planes)

    @property
    def centres(self) -> FloatArray:
        """Centres of the spheres, (n, 3) [m]."""
        return self.spheres[:, :3]

    @property
    def radii(self) -> FloatArray:
        """Radii of the spheres [m]."""
        return self.spheres[:, 3]

    @property
    def mean_diameter(self) -> float:
        """Mean diameter of the spheres, before joints cut their cells [m]."""
        return 2.0 * float(np.mean(self.whole_spheres[:, 3]))

    def outline(self) -> Solid:
        """Return the region that the cells fill, with the walls that contain their outer faces."""
        if self.given is not None:
            return self.given.outline(self.spec)
        return of_spheres.outline_of(self.whole_spheres, self.spec)

    def meshes(self) -> FanMeshes:
        """Mesh the grains: tetrahedra between the triangles of each face and the grain's centre.

        Raises:
            InputError: if a tetrahedron has no volume.
        """
        return call(fan_meshes, self.cells)

    def tetrahedra(self) -> tuple[FloatArray, IntArray, IntArray]:
        """Return nodes (n, 3) [m] and tetrahedra (m, 4) of all grains, and their grains (m,)."""
        meshes, cells = self.meshes(), self.cells
        firsts, ends = meshes.node_offsets, meshes.element_offsets
        nodes = cells.vertices[meshes.node_vertices]  # the last one of each grain is its centre
        nodes[firsts[1:] - 1] = cells.centres
        grains = np.repeat(np.arange(cells.cells), np.diff(ends))
        return nodes, meshes.elements + firsts[grains][:, None], grains

    def contact_polygons(self) -> list[IntArray]:
        """Return the vertices of each contact, in the order of ``cells.faces``."""
        return of_spheres.polygons(self.cells, 0, self.cells.contacts)

    def outer_polygons(self) -> list[IntArray]:
        """Return the vertices of each outer face, counter-clockwise as seen from outside."""
        return of_spheres.polygons(self.cells, self.cells.contacts, len(self.cells.faces))

    def statistics(self) -> Table:
        """Count and measure grains, contacts, cells and tetrahedra.

        Returns:
            Counts, volumes [m3], lengths [m]; see the keys.

        Example:
            >>> found = solid.statistics()
            >>> found["grains"], found["contacts"], found["tetrahedra"]
            (44, 178, 1128)
        """
        joints = {name: cut.to_json() for name, cut in self.told_cuts.items()}
        networks = self.network_intensities()
        return {
            **of_spheres.figures(self.cells, self.meshes()),
            "removed_spheres": self.removed_spheres,
            "mean_diameter": self.mean_diameter,
            **({"joints": joints} if joints else {}),
            **({"networks": networks} if networks else {}),
            **({"holes": [one.to_json() for one in self.told_holes]} if self.holes else {}),
        }


def _cut(
    spheres: FloatArray, given: OwnCells | None, spec: SolidSpec, planes: Sequence[JointPlane]
) -> tuple[FloatArray, FloatArray, Polyhedra]:
    """Return the spheres of whole cells and of all parts, and the cells with all cuts."""
    if given is None:
        spheres, cells = of_spheres.cells_of(spheres, spec, drop_hidden=False, planes=planes)
    else:
        spheres.setflags(write=False)
        cells = given.polyhedra(spheres, spec, planes)
    if not planes and not spec.holes:
        return spheres, spheres, cells
    grains = cells.sphere_of_cell
    parts = spheres[grains]
    cut = np.bincount(grains)[grains] > 1
    cut[cells.faces[cells.faces[:, 2] >= cells.first_hole, 0]] = True
    parts[cut, :3] = cells.centres[cut]
    parts[cut, 3] = np.cbrt(0.75 / np.pi * cells.volumes[cut])
    parts.setflags(write=False)
    return spheres, parts, cells


def _place(point: FloatArray | tuple[float, ...]) -> str:
    return "({:.6g}, {:.6g}, {:.6g}) m".format(*point)
