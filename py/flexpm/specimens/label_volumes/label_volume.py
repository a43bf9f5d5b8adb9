# SPDX-License-Identifier: GPL-3.0-or-later
"""Label volumes: the label of each voxel of a box, with the sizes of the voxels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from ...arrays import AnyArray, BoolArray, IntArray
from ...errors import InputError
from ...require import Bounds, quoted, require_list, require_whole
from ..checks import require_length
from ..labels.whole import KINDS, whole_numbers

#: Values along x, y and z.
Triple = tuple[float, float, float]
Counts = tuple[int, int, int]
#: First voxel, and the voxel after the last one, along x, y and z.
Crop = Sequence[tuple[int, int]]
Labels = npt.NDArray[np.int32]
AXES = ("x", "y", "z")
#: Least number of voxels along each axis.
LEAST = 2
#: Different labels of a volume.
MOST_LABELS = 1_000_000
#: Voxels that are converted at a time, each into 8 bytes.
_BLOCK = 2**22
#: Range of labels that a table may have in any case; larger ones need this many voxels a number.
_SMALL_RANGE, _VOXELS_A_NUMBER = 2**20, 2


@dataclass(frozen=True, eq=False)
class LabelVolume:
    """Labels of voxels.

    Attributes:
        labels: Index in `ids` of each voxel's label, (z, y, x) in C order, so that x is fastest.
        ids: Labels in ascending order. Each label has at least one voxel.
        spacing: Size of a voxel along x, y, z [m].
        origin: Corner of the first voxel, x, y, z [m].
        phases: Index of each label's phase from the file; None without phases.
        phase_names: Names of phases from the file, by index.
        has_voids: Whether some voxels have label 0, which stands for no rock.
        source: Name of the file without its folder.
        file_counts: Number of voxels along x, y, z in the file, before it was cropped; None: no
            file.
    """

    labels: Labels
    ids: IntArray
    spacing: Triple
    origin: Triple = (0.0, 0.0, 0.0)
    phases: IntArray | None = None
    phase_names: Mapping[int, str] = field(default_factory=dict)
    has_voids: bool = False
    source: str = ""
    file_counts: Counts | None = None

    @classmethod
    def of(
        cls,
        values: AnyArray,
        spacing: float | Sequence[float],
        origin: Triple = (0.0, 0.0, 0.0),
        *,
        source: str = "array",
    ) -> LabelVolume:
        """Return the volume of an array of labels.

        In addition to the array this takes 4 bytes per voxel, 2.5 bytes per voxel for tables, and
        a fixed size for parts that are converted at a time.

        Args:
            values: Whole numbers, (z, y, x), of 8 to 64 bits in any byte order. Floats must be
                whole numbers.
            spacing: Size of a voxel, or sizes along x, y, z [m].
            origin: Corner of the first voxel [m].
            source: Name of the labels, for messages and reports.

        Raises:
            InputError: for an array of another shape or kind, too many different labels, or a size
                that is not a length.
        """
        what = f"volume {quoted(source)}"
        if values.ndim != 3 or values.dtype.kind not in KINDS:
            raise InputError(
                f"{what}: labels = {values.dtype} array of shape {values.shape}, must be whole "
                "numbers along z, y and x; correct it"
            )
        require_counts(what, counts_of(values))
        sizes = voxel_sizes(spacing)
        labels, ids = _indexed(f"{what}: labels", values)
        return cls(labels, ids, sizes, origin, source=source)

    @property
    def counts(self) -> Counts:
        """Number of voxels along x, y, z."""
        return counts_of(self.labels)

    @property
    def voxels(self) -> IntArray:
        """Number of voxels of each label."""
        counts: IntArray = np.zeros(len(self.ids), dtype=np.int64)
        for at in _blocks(self.labels.shape):
            counts += np.bincount(self.labels[at].ravel(), minlength=len(self.ids))
        return counts

    def crop(self, crop: Crop) -> LabelVolume:
        """Return a part of the volume; the corner of its first voxel is the new origin.

        Args:
            crop: First voxel, and the voxel after the last one, along x, y and z.

        Raises:
            InputError: for a part beyond the volume, or of less than two voxels along an axis.
        """
        return self._part(Window.of(f"volume {quoted(self.source)}", self.counts, crop))

    def coarsen(self, step: int) -> LabelVolume:
        """Return the volume of every `step`-th voxel along each axis.

        A block of ``step``^3 voxels becomes one voxel with the label of the voxel in its middle: of
        the voxel behind the middle if `step` is even. Voxels beyond the last whole block are left
        out. Labels of no such voxel vanish.

        Args:
            step: Number of voxels along each side of a block.

        Raises:
            InputError: if less than two blocks fit along an axis.
        """
        return self._part(Window.of(f"volume {quoted(self.source)}", self.counts, step=step))

    def _part(self, window: Window) -> LabelVolume:
        spacing, origin = window.frame(self.spacing, self.origin)
        cut: Labels = np.array(self.labels[window.slices], order="C")
        there: BoolArray = np.zeros(len(self.ids), dtype=bool)
        for at in _blocks(cut.shape):
            there[cut[at]] = True
        numbers = (np.cumsum(there) - 1).astype(np.int32)
        for at in _blocks(cut.shape):
            cut[at] = numbers[cut[at]]
        ids = self.ids[there]
        return replace(
            self,
            labels=cut,
            ids=ids,
            has_voids=self.has_voids and bool((ids == 0).any()),
            spacing=spacing,
            origin=origin,
            phases=None if self.phases is None else self.phases[there],
        )


@dataclass(frozen=True)
class Window:
    """A part of a volume, and the step between its voxels."""

    slices: tuple[slice, slice, slice]  #: along z, y, x
    counts: Counts  #: number of voxels along x, y, z
    first: Counts  #: first voxel of the volume that belongs to the part
    step: int

    @classmethod
    def of(cls, what: str, counts: Counts, crop: Crop | None = None, step: int = 1) -> Window:
        """Return a part of a volume.

        Args:
            what: Name of the volume, for messages.
            counts: Number of voxels along x, y, z.
            crop: First voxel and the voxel after the last one along each axis; None: all.
            step: As for `LabelVolume.coarsen`.

        Raises:
            InputError: for a part beyond the volume, or of less than two voxels along an axis.
        """
        ends = [(0, count) for count in counts]
        if crop is not None:
            ends = [
                tuple(require_list(f"{what}: crop", one))
                for one in require_list(f"{what}: crop", crop)
            ]
        if len(ends) != 3 or any(len(pair) != 2 for pair in ends):
            raise InputError(
                f"{what}: crop = {quoted(crop)}, must be two numbers along each of x, y and z; "
                "give first voxel and the voxel after the last one"
            )
        require_whole(f"{what}: coarsen", step, Bounds(at_least=1))
        parts, sizes = [], []
        for axis, count, (first, end) in zip(AXES, counts, ends, strict=True):
            label = f"{what}: crop along {axis}"
            require_whole(label, first, Bounds(at_least=0, at_most=count))
            require_whole(label, end, Bounds(at_least=0, at_most=count))
            blocks = max(end - first, 0) // step
            if blocks < LEAST:
                size = f"{first} to {end}" + (f" in steps of {step}" if step > 1 else "")
                raise InputError(
                    f"{what}: voxels along {axis} = {size}, must be {LEAST} voxels or more of "
                    f"{count}; take a larger part or a smaller step"
                )
            parts.append(slice(first + step // 2, first + step * blocks, step))
            sizes.append(blocks)
        slices, corner = (parts[2], parts[1], parts[0]), (ends[0][0], ends[1][0], ends[2][0])
        return cls(slices, (sizes[0], sizes[1], sizes[2]), corner, step)

    def frame(self, spacing: Triple, origin: Triple) -> tuple[Triple, Triple]:
        """Return spacing and origin of the part, in the unit of those of the volume."""
        corner = [o + n * d for o, n, d in zip(origin, self.first, spacing, strict=True)]
        x, y, z = (self.step * d for d in spacing)
        return (x, y, z), (corner[0], corner[1], corner[2])


def voxel_sizes(voxel: object) -> Triple:
    """Return the sizes of a voxel along x, y, z [m], from one number or three.

    Raises:
        InputError: for other values than lengths.
    """
    voxel = voxel.tolist() if isinstance(voxel, np.ndarray) else voxel
    given = require_list("voxel", voxel) if isinstance(voxel, list | tuple) else [voxel] * 3
    if len(given) != 3:
        raise InputError(
            f"voxel = {quoted(voxel)}, must be one number or three; give sizes along x, y, z in m"
        )
    x, y, z = (
        require_length("volume", f"voxel along {axis}", size)
        for axis, size in zip(AXES, given, strict=True)
    )
    return x, y, z


def counts_of(values: AnyArray) -> Counts:
    """Return the number of voxels along x, y, z of an array (z, y, x)."""
    z, y, x = values.shape
    return x, y, z


def require_counts(what: str, counts: Counts) -> None:
    """Check that a volume has at least two voxels along each axis.

    Raises:
        InputError: for a single page or slice, or an empty volume.
    """
    for axis, count in zip(AXES, counts, strict=True):
        if count < LEAST:
            raise InputError(
                f"{what}: voxels = {sized(counts)}, must be >= {LEAST} along {axis}; give a "
                "volume, or one slice to flexpm specimen image"
            )


def sized(counts: Counts) -> str:
    """Return numbers of voxels as a text with the names of the axes."""
    return " x ".join(map(str, counts)) + " along x, y, z"


def _blocks(shape: tuple[int, ...]) -> Iterator[tuple[slice, slice]]:
    """Yield the index of parts of an array (z, y, x) that have a bounded size."""
    layers, rows, width = shape
    high = min(rows, max(1, _BLOCK // width))
    deep = max(1, _BLOCK // (width * high)) if high == rows else 1
    for z in range(0, layers, deep):
        for y in range(0, rows, high):
            yield slice(z, z + deep), slice(y, y + high)


def _indexed(what: str, values: AnyArray) -> tuple[Labels, IntArray]:
    """Return the index of each voxel's label among the sorted labels, and these."""
    blocks = [*_blocks(values.shape)]

    def whole(at: tuple[slice, slice]) -> IntArray:
        first = [at[0].start, at[1].start, 0]

        def position(index: list[int]) -> str:
            z, y, x = (a + b for a, b in zip(first, index, strict=True))
            return f"x {x}, y {y}, z {z}"

        return whole_numbers(what, values[at], position)

    ends = [(int(part.min()), int(part.max())) for part in map(whole, blocks)]
    lowest = min(low for low, _ in ends)
    span = max(high for _, high in ends) - lowest + 1
    labels: Labels = np.empty(values.shape, dtype=np.int32)
    if span <= max(_SMALL_RANGE, values.size // _VOXELS_A_NUMBER):
        there: BoolArray = np.zeros(span, dtype=bool)
        for at in blocks:
            there[whole(at) - lowest] = True
        ids = np.flatnonzero(there) + lowest
        _require_few(what, len(ids))
        numbers = np.cumsum(there, dtype=np.int32) - np.int32(1)
        for at in blocks:
            labels[at] = numbers[whole(at) - lowest]
        return labels, ids
    ids = np.zeros(0, dtype=np.int64)
    for at in blocks:
        ids = np.union1d(ids, whole(at))
        _require_few(what, len(ids))
    for at in blocks:
        labels[at] = np.searchsorted(ids, whole(at))
    return labels, ids


def _require_few(what: str, number: int) -> None:
    if number > MOST_LABELS:
        raise InputError(
            f"{what} = {number} different ones, must be <= {MOST_LABELS}; give the labels of "
            "grains or phases, not the grey values of a scan"
        )
