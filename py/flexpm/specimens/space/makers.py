# SPDX-License-Identifier: GPL-3.0-or-later
"""Constructors of 3D specimens for ``Specimen``, in addition to the 2D constructors. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy.typing as npt

from ...errors import InputError
from ...files import Table
from ...progress import Progress
from ...require import quoted
from ..grain_source import traced
from ..plane import Packing, packing_of
from .spec import SHORT_EDGE, SolidSpec
from .specimen import SolidSpecimen

if TYPE_CHECKING:
    from ..label_volumes.label_volume import LabelVolume


class SolidShapes:
    """Constructors of 3D specimens; see doc/solids."""

    @staticmethod
    def box(width: float, depth: float, height: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack a box with a corner at the origin; z is the axial direction.

        Args:
            width: Size along x [m].
            depth: Size along y [m].
            height: Size along z [m].
            packing: ``diameters``, ``porosity``, ``seed``, ``short_edge`` (default: 0.10) and
                ``progress`` as for ``rectangle``, of spheres.

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, spheres that do not fit, or more grains than the
                machine has memory for.

        Example:
            >>> solid = flexpm.Specimen.box(0.008, 0.008, 0.012)
            >>> len(solid.spheres), solid.kind
            (44, 'box')
        """
        return _packed("box", {"width": width, "depth": depth, "height": height}, packing)

    @staticmethod
    def cylinder(diameter: float, height: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack an upright cylinder about the z axis, from z = 0: a prism of its section (D63).

        Args:
            diameter: Diameter of the specimen [m].
            height: Size along z, the axial direction [m].
            packing: As for ``box``.

        Raises:
            InputError: as for ``box``.

        Example:
            >>> flexpm.Specimen.cylinder(0.008, 0.012).dimensions
            {'diameter': 0.008, 'height': 0.012}
        """
        return _packed("cylinder", {"diameter": diameter, "height": height}, packing)

    @staticmethod
    def solid_disc(diameter: float, depth: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack a disc about the y axis, from y = 0, for Brazilian tests: a prism of its section.

        Args:
            diameter: Diameter of the specimen [m].
            depth: Along y [m]; the load is along z.
            packing: As for ``box``.

        Raises:
            InputError: as for ``box``.
        """
        return _packed("solid-disc", {"diameter": diameter, "depth": depth}, packing)

    @staticmethod
    def solid_half_disc(diameter: float, depth: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack the upper half of a disc about the y axis, from y = 0, flat below at z = 0.

        It is a prism of half the disc's area, with a facet on top.

        Args:
            diameter: Diameter of the disc [m].
            depth: Along y [m]; the load is along z.
            packing: As for ``box``.

        Raises:
            InputError: as for ``box``.
        """
        return _packed("solid-half-disc", {"diameter": diameter, "depth": depth}, packing)

    @staticmethod
    def from_spheres(
        spheres: npt.ArrayLike | Path | str,
        *,
        height: float | None = None,
        width: float | None = None,
        depth: float | None = None,
        diameter: float | None = None,
        short_edge: float = SHORT_EDGE,
        drop_hidden: bool = False,
    ) -> SolidSpecimen:
        """Make a 3D specimen of given spheres: a box, a cylinder or, without `height`, a disc.

        Args:
            spheres: Rows x, y, z, radius [m], centres inside the outline, or a text file of such
                rows, separated by blanks or commas.
            height: Height of a box or a cylinder, along z, from 0 [m].
            width: Width of a box, along x from 0 [m].
            depth: Depth of a box or a disc, along y from 0 [m].
            diameter: Diameter of a cylinder about the z axis, or of a disc about the y axis [m].
            short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-]; 0:
                none.
            drop_hidden: Leave out spheres without a cell, and count them in ``removed_spheres``.

        Returns:
            The specimen, grains in the order of the spheres.

        Raises:
            InputError: for a size that is missing or out of range, a sphere that is outside,
                coincides with another sphere or has no cell; the message has its index.

        Example:
            >>> spheres = [(0.002, 0.002, 0.002, 0.002), (0.002, 0.002, 0.006, 0.002)]
            >>> two = flexpm.Specimen.from_spheres(spheres, width=0.004, depth=0.004, height=0.008)
            >>> two.statistics()["contacts"]
            1
        """
        sizes = {"height": height, "width": width, "depth": depth, "diameter": diameter}
        return SolidSpecimen.of_spheres(
            spheres, sizes, short_edge=short_edge, drop_hidden=drop_hidden
        )

    @staticmethod
    def from_tess_solid(
        path: Path | str, *, scale: float = 1.0, short_edge: float = SHORT_EDGE
    ) -> SolidSpecimen:
        """Make a 3D specimen of the cells of a 3D tessellation of Neper, a ``.tess`` file.

        If the cells are the Laguerre cells of the seeds in the file, the seeds are the centres
        (D76). Other cells have their centroids as centres (D97). A box or a cylinder is moved to
        the origin. A cylinder gets the diameter of a circle of its area and is rotated about z.

        Args:
            path: The file, of format 2.0 or later, of convex cells with plane faces in a box along
                x, y and z or in an upright cylinder of at least 16 facets.
            scale: Length of the file's unit [m].
            short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-]; 0:
                none.

        Returns:
            The specimen, grains in the order of the file.

        Raises:
            InputError: for a file that has no 3D cells or is broken, with its line; for cells that
                are not convex, not closed, bent or outside of such a solid, with their indices.
        """
        from .tess import specimen_of

        return traced(specimen_of(Path(path), scale, short_edge), Path(path).name)

    @staticmethod
    def from_label_volume(
        source: LabelVolume | npt.ArrayLike | Path | str,
        *,
        voxel: float | tuple[float, float, float] | None = None,
        minerals: Mapping[int, int | None] | Path | str | None = None,
        least_voxels: int = 8,
        watershed: bool = False,
        shape: str = "box",
        diameter: float | None = None,
        volumes: str = "fitted",
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
        **reading: Any,
    ) -> SolidSpecimen:
        """Make a 3D specimen of the labels of voxels: one convex cell for each grain.

        Voxels of one label that are connected by their sides form a grain. The cells belong to a
        power diagram that agrees with as many voxels as possible (doc/volumes).

        Args:
            source: A file (doc/volumes), a ``LabelVolume``, or an array of whole numbers (z, y, x).
            voxel: Size of a voxel, or sizes along x, y and z [m]; for an array required.
            minerals: Index of the mineral of each label, None for a pore; or a table or a second
                volume, see ``--minerals`` in doc/volumes. If it is None or has pores only, the
                phases of the file are minerals, if it has any. Label 0 of ``.tesr`` and
                ``.dream3d`` files, the void, is a pore.
            least_voxels: Smallest number of voxels of a grain or pore; smaller regions are merged
                with a neighbour.
            watershed: Divide the regions of a label where they are narrow, for labels of phases.
            shape: ``box``: the whole volume. ``cylinder`` about z or ``disc`` about y, cut
                from the middle of the volume.
            diameter: Diameter of a cylinder or disc [m].
            volumes: ``exact``: in the box, before short edges are collapsed, cells have the
                volumes of their grains within 1e-7.
            short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-]; 0:
                none.
            progress: Receives the stages of the fit.
            reading: ``unit``, ``counts``, ``dtype``, ``array``, ``crop`` and ``coarsen`` of
                ``reading.read``, for files. ``minerals_dtype`` and ``minerals_array`` are
                ``dtype`` and ``array`` of a second volume.

        Returns:
            The specimen, grains in the order of their labels. ``fit`` compares it with the volume.

        Raises:
            InputError: for a file or a value that is rejected, a label without a mineral, or fewer
                than two grains.

        Example:
            >>> labels = [[[1, 1, 2, 2]] * 4] * 4  # z, y, x
            >>> two = flexpm.Specimen.from_label_volume(labels, voxel=1e-3)
            >>> two.statistics()["grains"], two.fit.totals["agreement"]
            (2, 1.0)
        """
        from ..volumes.specimen_of_volume import VolumeOptions, specimen_of, volume_of
        from ..volumes.volume_minerals import kinds_of, kinds_of_minerals

        options = VolumeOptions(least_voxels, watershed, shape, diameter, volumes, short_edge)
        second = {name: reading.pop(f"minerals_{name}", None) for name in ("dtype", "array")}
        volume = volume_of(source, voxel, reading)
        if isinstance(minerals, Path | str):
            kinds = kinds_of_minerals(Path(minerals), volume, reading, **second)
        else:
            kinds = kinds_of(volume, minerals)
        return specimen_of(volume, kinds, options, progress)

    @staticmethod
    def from_grain_table(
        path: Path | str,
        *,
        width: float,
        depth: float,
        height: float,
        unit: str = "m",
        short_edge: float = SHORT_EDGE,
        progress: Progress | None = None,
    ) -> SolidSpecimen:
        """Make a box of grains with given volumes and centroids: a Laguerre tessellation.

        Volumes are exact within 1e-7, before short edges are collapsed. An iteration moves the
        centroids towards the given centroids, as far as a Laguerre tessellation with these volumes
        allows.

        Args:
            path: A CSV file with the columns id, x, y, z, volume and, optionally, phase. Centroids
                are in the box, which has a corner at the origin.
            width: Size of the box along x [m].
            depth: Size along y [m].
            height: Size along z [m].
            unit: Unit of the lengths in the file: ``m``, ``mm`` or ``um``.
            short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-]; 0:
                none.
            progress: Receives the steps.

        Returns:
            The specimen, grains in the order of the file. Phases are minerals, in the order in
            which the file names them.

        Raises:
            InputError: for a file or value that is rejected, grains outside the box, or volumes
                whose sum differs from the volume of the box by more than 2 %. If the difference is
                smaller, the volumes are scaled.
        """
        from ..volumes.grain_table import read, specimen_of

        sizes = {"width": width, "depth": depth, "height": height}
        return specimen_of(read(Path(path), unit), sizes, short_edge, progress)

    @staticmethod
    def load_solid(path: Path | str) -> SolidSpecimen:
        """Read a 3D specimen that its ``save`` has written, with bit-identical grains.

        Raises:
            InputError: if the file cannot be read, is not a 3D specimen, or was changed.
        """
        return SolidSpecimen.load(path)


def _packed(kind: str, sizes: dict[str, float], packing: Packing) -> SolidSpecimen:
    given: Table = {**packing}
    if "holes" in given:
        raise InputError(
            f"Specimen.{kind}: holes = {quoted(given['holes'])}, must be left out; use with_holes "
            "of the specimen"
        )
    fields: Table = {**sizes, **packing_of(kind, (), packing)}
    progress = fields.pop("progress", None)
    return SolidSpecimen.pack(SolidSpec(kind, **fields), progress)
