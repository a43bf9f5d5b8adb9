# SPDX-License-Identifier: GPL-3.0-or-later
"""Constructors of 2D specimens. Lengths in metres."""

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
from .grain_source import traced
from .kernel_input import Circle
from .plane import Corners, Packing, packing_of
from .spec import SpecimenSpec


class PlaneShapes(ABC):
    """Constructors of a 2D specimen."""

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
            width: Size along x [m].
            height: Size along y [m].
            thickness: Thickness out of plane [m].
            in_order: Diameters, porosity and seed, if not by keyword.
            packing: ``diameters``, ``porosity``, ``seed``, ``short_edge`` and ``progress``, see
                `Packing`.

        Returns:
            The specimen.

        Raises:
            InputError: for a value out of range, or discs that do not fit.

        Example:
            >>> specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, porosity=0.1, seed=2)
            >>> specimen.seed, specimen.extent["height"]
            (2, 0.024)
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
            thickness: Thickness out of plane [m].
            in_order: As for ``rectangle``.
            packing: As for ``rectangle``.

        Example:
            >>> flexpm.Specimen.disc(0.02, 0.01).dimensions
            {'diameter': 0.02}
        """
        how = packing_of("disc", in_order, packing)
        return cls._packed("disc", {"diameter": diameter}, thickness, how)

    @classmethod
    def half_disc(
        cls, diameter: float, thickness: float, *in_order: object, **packing: Unpack[Packing]
    ) -> Self:
        """Cut the upper half of a disc out of a packed block, its lower left corner at the origin.

        The arc has one chord for each grain along it; one of the chords is at the top.

        Args:
            diameter: Diameter of the disc, along x [m].
            thickness: Thickness out of plane [m].
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
        """Cut an outline of any shape out of a packed block (D31 to D33).

        The block is the bounding box of the outline. Grains on the outline are cut; inner grains
        keep their cells. A rectangle along x and y, with or without holes, takes the tests of a
        rectangle.

        Args:
            corners: Simple polygon, convex or not, in any sense [m]; the first corner may be
                repeated at the end, here and in all other arguments with corners.
            thickness: Thickness out of plane [m].
            in_order: As for ``rectangle``.
            holes: Corners of each hole [m].
            packing: As for ``rectangle``.

        Raises:
            InputError: for a value out of range, or if polygon or holes intersect themselves or
                each other.

        Example:
            A square with a square hole:

            >>> hole = [(0.012, 0.012), (0.018, 0.012), (0.018, 0.018), (0.012, 0.018)]
            >>> plate = flexpm.Specimen.polygon(
            ...     [(0, 0), (0.03, 0), (0.03, 0.03), (0, 0.03)], 0.01, holes=[hole]
            ... )
            >>> len(plate.holes), f"{sum(plate.cell_sizes):.6f}"
            (1, '0.000864')
        """
        how = packing_of("polygon", in_order, packing)
        return cls._of(plane.polygon(corners, thickness, holes, how))

    @classmethod
    def pack(cls, spec: SpecimenSpec, progress: Progress | None = None) -> Self:
        """Pack the specimen that `spec` describes, as ``rectangle`` and ``disc`` do.

        Raises:
            InputError: for discs that do not fit, or for a `spec` of given discs.
        """
        return cls._of(plane.pack(spec, progress))

    @classmethod
    def from_polygons(
        cls, polygons: Sequence[Corners], thickness: float, *, holes: bool = False
    ) -> Self:
        """Make a specimen of given cells, which must tile their outline.

        Corners closer than 1e-6 mean diameters are merged. A corner that is as close to an edge
        divides the edge (D34). A cell is split if no point exists from which all of its edges are
        visible (D32).

        Args:
            polygons: Corners of each cell, (n, 2) [m], in any sense.
            thickness: Thickness out of plane [m].
            holes: Whether the cells may leave holes, of at least 2 % of a mean cell.

        Returns:
            The specimen; cells in the order given, second parts of split cells last.

        Raises:
            InputError: for cells that intersect themselves, overlap, or leave a gap.

        Example:
            >>> left = [(0, 0), (0.01, 0), (0.01, 0.01), (0, 0.01)]
            >>> right = [(0.01, 0), (0.02, 0), (0.02, 0.01), (0.01, 0.01)]
            >>> flexpm.Specimen.from_polygons([left, right], 0.01).statistics()["contacts"]
            1
        """
        return cls._of(plane.from_polygons(polygons, thickness, holes))

    @classmethod
    def from_labels(
        cls,
        labels: npt.ArrayLike,
        pixel: float,
        thickness: float,
        *,
        minerals: Mapping[int, int | None] | Path | str | None = None,
        edge: float | None = None,
        smallest: int = 4,
    ) -> Self:
        """Make a specimen of an image whose pixels have the labels of grains, or of phases.

        A grain is a region of equal labels that is connected by edges of pixels. Boundaries are
        smoothed by at most a pixel: neighbours share one line, and areas stay the areas of the
        pixels (D73). Grains that enclose others, or are far from convex, are cut into cells;
        ``grains`` has the index of the grain of each cell.

        Args:
            labels: Whole numbers, rows of pixels, the first row at the top.
            pixel: Side of a pixel [m].
            thickness: Thickness out of plane [m].
            minerals: For each label an index into the minerals of the material, None for a hole;
                default: no holes, and minerals are sampled. Or a file: a CSV table with the columns
                ``id`` (label) and ``mineral`` (name, or ``hole``), or a second image of the same
                size with the phase of each pixel. A grain has the phase of most of its pixels, and
                minerals are called ``phase 1`` and so on.
            edge: Distance between corners of a boundary [m], at least two pixels; default: a
                quarter of the mean diameter of the grains.
            smallest: Regions with fewer pixels join the neighbour with the longest shared line,
                of the same mineral first [-].

        Raises:
            InputError: for labels that are not whole numbers, a label without a mineral, an image
                that is one region or holes only, and more than 20 million pixels.

        Example:
            >>> labels = [[1] * 8 + [2] * 8] * 8
            >>> len(flexpm.Specimen.from_labels(labels, 1e-4, 0.01).discs)
            2
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

        Neighbouring points of a phase belong to one grain if their misorientation is below the
        limit. The misorientation is the smallest angle under the symmetry of the phase's Laue
        group. Further steps are the same as in ``from_labels``. A map of one phase names no
        minerals.

        Args:
            path: The file; its steps are in micrometres.
            thickness: Thickness out of plane [m].
            misorientation: Smallest misorientation between two grains [degree].
            unindexed: ``fill``: points that were not indexed join the majority of their neighbours;
                ``hole``: they are not rock.
            phases: TOML file of ``"phase" = "mineral"``, or ``"hole"``; default: each phase of
                the file, in its order, is a mineral.
            edge: As for ``from_labels`` [m].
            smallest: As for ``from_labels``, in points [-]; a point of a hexagonal grid counts
                twice.

        Raises:
            InputError: for a file that is broken or is not such a map, with the number of the line,
                and as ``from_labels``.
        """
        options = {"misorientation": misorientation, "unindexed": unindexed, "phases": phases}
        options |= {"edge": edge, "smallest": smallest}
        made = plane.from_ebsd(Path(path), thickness, options)
        return cls._of(traced(made, Path(path).name))

    @classmethod
    def from_tess(
        cls,
        path: Path | str,
        thickness: float,
        *,
        scale: float = 1.0,
        short_edge: float = SHORT_EDGE,
    ) -> Self:
        """Make a specimen of the cells of a 2D tessellation of Neper, a ``.tess`` file.

        If the cells are the Laguerre cells of the seeds in the file, the seeds are the centres
        (D76). Other cells are used as in ``from_polygons``.

        Args:
            path: The file, of format 2.0 or later; a slice of 3D cells is rotated into the xy
                plane.
            thickness: Thickness out of plane [m].
            scale: Length of the file's unit [m].
            short_edge: Ratio to the mean diameter below which edges of Laguerre cells are collapsed
                [-]; 0: none.

        Raises:
            InputError: for a file that has no 2D cells or is broken, with its line, and as
                ``from_polygons``.
        """
        made = plane.from_tess(Path(path), thickness, scale, short_edge)
        return cls._of(traced(made, Path(path).name))

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
            radii: Radius per centre [m].
            outline: Corners of a convex polygon, counter-clockwise [m], or a circle.
            thickness: Thickness out of plane [m].
            short_edge: Ratio to the mean diameter below which edges of cells are collapsed [-]; 0:
                none.
            drop_hidden: Leave out discs without a cell, and count them in ``removed_discs``.

        Returns:
            The specimen, grains in the order of the discs.

        Raises:
            InputError: for a value out of range, a disc outside the outline or without a cell.

        Example:
            >>> square = [(0, 0), (0.02, 0), (0.02, 0.02), (0, 0.02)]
            >>> centres = [(0.005, 0.01), (0.015, 0.01)]
            >>> two = flexpm.Specimen.from_discs(centres, [0.005, 0.005], square, 0.01)
            >>> two.cell_sizes.round(6).tolist()
            [0.0002, 0.0002]
        """
        made = plane.from_discs(centres, radii, outline, thickness, short_edge, drop_hidden)
        return cls._of(made)

    @classmethod
    def _packed(cls, kind: str, sizes: dict[str, float], thickness: float, how: Packing) -> Self:
        return cls.pack(plane.packed_spec(kind, sizes, thickness, how), how.get("progress"))

    @classmethod
    @abstractmethod
    def _of(cls, made: plane.Filling) -> Self:
        """Make a specimen of grains that fill an outline."""
