# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of plane specimens: how users make them. Lengths in metres."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Self, Unpack

import numpy.typing as npt

from ..arrays import FloatArray
from ..progress import Progress
from . import plane
from .checks import SHORT_EDGE
from .kernel_input import Circle
from .plane import Corners, Packing, packing_of
from .spec import SpecimenSpec


class PlaneShapes(ABC):
    """What makes a plane specimen."""

    @classmethod
    def rectangle(
        cls,
        width: float,
        height: float,
        thickness: float,
        *in_order: object,
        **packing: Unpack[Packing],
    ) -> Self:
        """Pack a rectangle with its lower left corner at the origin; y is the axial direction.

        Args:
            width: Along x [m].
            height: Along y [m].
            thickness: Out of plane [m].
            in_order: Diameters, porosity and seed, if not by keyword.
            packing: ``diameters``, ``porosity``, ``seed``, ``short_edge`` and ``progress``, see
                `Packing`.

        Raises:
            InputError: for a value out of range, or discs that do not fit.
        """
        how = packing_of("rectangle", in_order, packing)
        return cls._packed("rectangle", {"width": width, "height": height}, thickness, how)

    @classmethod
    def disc(
        cls, diameter: float, thickness: float, *in_order: object, **packing: Unpack[Packing]
    ) -> Self:
        """Pack a disc about the origin, as ``rectangle`` does; its rim has a chord per grain.

        Args:
            diameter: Diameter of the specimen [m].
            thickness: Out of plane [m].
            in_order: As for ``rectangle``.
            packing: As for ``rectangle``.
        """
        how = packing_of("disc", in_order, packing)
        return cls._packed("disc", {"diameter": diameter}, thickness, how)

    @classmethod
    def half_disc(
        cls, diameter: float, thickness: float, *in_order: object, **packing: Unpack[Packing]
    ) -> Self:
        """Saw the upper half of a disc out of a packed block, its lower left corner at the origin.

        The arc has one chord for each grain along it, one of them on top.

        Args:
            diameter: Diameter of the disc, along x [m].
            thickness: Out of plane [m].
            in_order: As for ``rectangle``.
            packing: As for ``rectangle``.
        """
        how = packing_of("half_disc", in_order, packing)
        return cls._packed("half-disc", {"diameter": diameter}, thickness, how)

    @classmethod
    def polygon(
        cls,
        corners: Corners,
        thickness: float,
        *in_order: object,
        holes: Sequence[Corners] = (),
        **packing: Unpack[Packing],
    ) -> Self:
        """Saw an outline of any shape out of a packed block (D31 to D33).

        The block is the box around the outline. Grains on the outline are cut; those inside keep
        their cells. A rectangle along x and y, with holes or without, can be tested as such.

        Args:
            corners: Simple polygon, convex or not, in any sense [m]; the first one may come
                again at the end, here and wherever corners are given.
            thickness: Out of plane [m].
            in_order: As for ``rectangle``.
            holes: Corners of each hole [m].
            packing: As for ``rectangle``.

        Raises:
            InputError: for a value out of range, or a polygon or holes that cross themselves or
                each other.
        """
        how = packing_of("polygon", in_order, packing)
        return cls._of(plane.polygon(corners, thickness, holes, how))

    @classmethod
    def pack(cls, spec: SpecimenSpec, progress: Progress | None = None) -> Self:
        """Pack the specimen that `spec` describes, as ``rectangle`` and ``disc`` do.

        Raises:
            InputError: for discs that do not fit, or that were given instead of packed.
        """
        return cls._of(plane.pack(spec, progress))

    @classmethod
    def from_polygons(
        cls, polygons: Sequence[Corners], thickness: float, *, holes: bool = False
    ) -> Self:
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
        return cls._of(plane.from_polygons(polygons, thickness, holes))

    @classmethod
    def from_labels(
        cls,
        labels: npt.ArrayLike,
        pixel: float,
        thickness: float,
        *,
        minerals: Mapping[int, int | None] | None = None,
        edge: float | None = None,
        smallest: int = 4,
    ) -> Self:
        """Make a specimen of an image whose pixels have the labels of grains, or of phases.

        A grain is a region of equal labels that hangs together by edges of pixels. Boundaries are
        smoothed, both neighbours keeping one line, at most a pixel off; areas stay those of the
        pixels (D73). Grains that go round others, or are far from convex, are cut into cells,
        which know their grain (``grains``).

        Args:
            labels: Whole numbers, rows of pixels, the first row on top.
            pixel: Side of a pixel [m].
            thickness: Out of plane [m].
            minerals: For each label an index into the minerals of the material, None for a hole;
                left out: no holes, and minerals are drawn.
            edge: Way from corner to corner of a boundary [m], two pixels or more; a quarter of the
                mean diameter of the grains if left out.
            smallest: Regions with fewer pixels go to the neighbour with the longest shared line,
                of the same mineral first [-].

        Raises:
            InputError: for labels that are no whole numbers, a label without a mineral, an image
                of one region or of holes alone, and more than 20 million pixels.
        """
        options = {"pixel": pixel, "minerals": minerals, "edge": edge, "smallest": smallest}
        return cls._of(plane.from_labels(labels, thickness, options))

    @classmethod
    def from_ebsd(
        cls,
        path: Path | str,
        thickness: float,
        *,
        misorientation: float = 10.0,
        unindexed: str = "fill",
        phases: Path | str | None = None,
        edge: float | None = None,
        smallest: int = 4,
    ) -> Self:
        """Make a specimen of a map of crystal orientations, a ``.ctf`` or ``.ang`` file.

        Neighbours of one phase hang together below a misorientation, the smallest one under the
        symmetry of the phase's Laue group. The grains then go on as in ``from_labels``. A map of
        one phase names no minerals.

        Args:
            path: The file; its steps are micrometres.
            thickness: Out of plane [m].
            misorientation: From which on two neighbours are two grains [degree].
            unindexed: ``fill``: points that were not indexed go to most of their neighbours;
                ``hole``: they are no rock.
            phases: TOML file of ``"phase" = "mineral"``, or ``"hole"``; left out: each phase of
                the file, in its order, is a mineral.
            edge: As for ``from_labels`` [m].
            smallest: As for ``from_labels``, points [-]; a point of a hexagonal grid counts twice.

        Raises:
            InputError: for a file that is no such map or is broken, with its line, and as
                ``from_labels``.
        """
        options = {"misorientation": misorientation, "unindexed": unindexed, "phases": phases}
        options |= {"edge": edge, "smallest": smallest}
        return cls._of(plane.from_ebsd(Path(path), thickness, options))

    @classmethod
    def from_tess(
        cls,
        path: Path | str,
        thickness: float,
        *,
        scale: float = 1.0,
        short_edge: float = SHORT_EDGE,
    ) -> Self:
        """Make a specimen of the cells of a tessellation of Neper in the plane, a ``.tess`` file.

        Where the cells are the Laguerre cells of the seeds in the file the seeds are the centres
        (D76); others are given cells, as in ``from_polygons``.

        Args:
            path: The file, of format 2.0 or later; a slice of cells in space is laid flat.
            thickness: Out of plane [m].
            scale: Length of the file's unit [m].
            short_edge: Edges of Laguerre cells below this share of the mean diameter are
                collapsed [-]; 0: none.

        Raises:
            InputError: for a file that is none of cells in the plane or is broken, with its line,
                and as ``from_polygons``.
        """
        return cls._of(plane.from_tess(Path(path), thickness, scale, short_edge))

    @classmethod
    def from_discs(
        cls,
        centres: Corners,
        radii: Sequence[float] | FloatArray,
        outline: Corners | Circle,
        thickness: float,
        *,
        short_edge: float = SHORT_EDGE,
        drop_hidden: bool = False,
    ) -> Self:
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
        made = plane.from_discs(centres, radii, outline, thickness, short_edge, drop_hidden)
        return cls._of(made)

    @classmethod
    def _packed(cls, kind: str, sizes: dict[str, float], thickness: float, how: Packing) -> Self:
        return cls.pack(plane.packed_spec(kind, sizes, thickness, how), how.get("progress"))

    @classmethod
    @abstractmethod
    def _of(cls, made: plane.Filling) -> Self:
        """Make it of grains that fill an outline."""
