# SPDX-License-Identifier: GPL-3.0-or-later
"""Ways to make a solid specimen, which ``Specimen`` has beside those of plane ones. SI units."""

from __future__ import annotations

from pathlib import Path
from typing import Unpack

import numpy.typing as npt

from ...dimensions import refused
from ...files import Table
from ...require import quoted
from ..plane import Packing, packing_of
from .spec import SHORT_EDGE, SolidSpec
from .specimen import SolidSpecimen


class SolidShapes:
    """Makers of solid specimens; see doc/solids."""

    @staticmethod
    def box(width: float, depth: float, height: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack a box with a corner at the origin; z is the axial direction.

        Args:
            width: Along x [m].
            depth: Along y [m].
            height: Along z [m].
            packing: ``diameters``, ``porosity``, ``seed``, ``short_edge`` (0.10 if left out) and
                ``progress`` as for ``rectangle``, of spheres.

        Raises:
            InputError: for a value out of range, spheres that do not fit, or more grains than the
                machine has memory for.
        """
        return _packed("box", {"width": width, "depth": depth, "height": height}, packing)

    @staticmethod
    def cylinder(diameter: float, height: float, **packing: Unpack[Packing]) -> SolidSpecimen:
        """Pack an upright cylinder about the z axis, from z = 0: a prism of its section (D63).

        Args:
            diameter: Diameter of the specimen [m].
            height: Along z, the axial direction [m].
            packing: As for ``box``.

        Raises:
            InputError: as for ``box``.
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
        """Make a solid of given spheres: a box, a cylinder or, without `height`, a disc.

        Args:
            spheres: Rows x, y, z, radius [m], centres inside the outline, or a text file of such
                rows, between blanks or commas.
            height: That of a box or a cylinder, along z, from 0 [m].
            width: Width of a box, along x from 0 [m].
            depth: Depth of a box or a disc, along y from 0 [m].
            diameter: Diameter of a cylinder about the z axis, or of a disc about the y axis [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-]; 0: none.
            drop_hidden: Leave out spheres that others hide, and count them in ``removed_spheres``.

        Returns:
            The specimen, grains in the order of the spheres.

        Raises:
            InputError: for a size that is missing or out of range, a sphere outside, in the place
                of another or hidden by others, by its number.
        """
        sizes = {"height": height, "width": width, "depth": depth, "diameter": diameter}
        return SolidSpecimen.of_spheres(
            spheres, sizes, short_edge=short_edge, drop_hidden=drop_hidden
        )

    @staticmethod
    def from_tess_solid(
        path: Path | str, *, scale: float = 1.0, short_edge: float = SHORT_EDGE
    ) -> SolidSpecimen:
        """Make a solid of the cells of a tessellation of Neper in space, a ``.tess`` file.

        Where the cells are the Laguerre cells of the seeds in the file the seeds are the centres
        (D76); others are given cells about their centroids (D97). A box moves to the origin, and so
        does a cylinder, which has the diameter of its area and is turned about z.

        Args:
            path: The file, of format 2.0 or later, of convex cells with plane faces in a box along
                x, y and z or in an upright cylinder of 16 facets or more.
            scale: Length of the file's unit [m].
            short_edge: Collapse edges of cells below this share of the mean diameter [-]; 0: none.

        Returns:
            The specimen, grains in the order of the file.

        Raises:
            InputError: for a file that is none of cells in space or is broken, with its line; for
                cells that are not convex, closed or in such a solid and bent faces, by number.
        """
        from .tess import specimen_of

        return specimen_of(Path(path), scale, short_edge)

    @staticmethod
    def load_solid(path: Path | str) -> SolidSpecimen:
        """Read a solid that its ``save`` has written: the same grains to the bit.

        Raises:
            InputError: if the file cannot be read, is no solid specimen, or was changed.
        """
        return SolidSpecimen.load(path)


def _packed(kind: str, sizes: dict[str, float], packing: Packing) -> SolidSpecimen:
    given: Table = {**packing}
    if "holes" in given:
        asked = f"Specimen.{kind}: holes = {quoted(given['holes'])}, must be left out"
        raise refused(asked, "holes")
    fields: Table = {**sizes, **packing_of(kind, (), packing)}
    progress = fields.pop("progress", None)
    return SolidSpecimen.pack(SolidSpec(kind, **fields), progress)
