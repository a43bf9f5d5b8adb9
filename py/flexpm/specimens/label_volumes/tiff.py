# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from TIFF files with several pages, or from folders of numbered slices.

Pages are in the order of z, rows in the order of y and columns in the order of x: the first row of
the first page is y = 0, z = 0.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...arrays import AnyArray
from ...errors import InputError
from ..labels import image_files
from .label_volume import Triple
from .volume_file import Content, VolumeFile, name_of, refused, require_file, require_size

if TYPE_CHECKING:
    from PIL.Image import Image as ImageFile

SUFFIXES = (".tif", ".tiff")
_SLICES = (*SUFFIXES, ".png")
#: Modes of Pillow that are labels: truth values, grey levels, indices of a palette.
_MODES = ("1", "L", "P", "I", "I;16", "I;16B", "I;16L", "F")
_DESCRIPTION, _RESOLUTION = 270, (282, 283)
_SAMPLE_FORMAT, _UNSIGNED, _PHOTOMETRIC, _WHITE_IS_0 = 339, 1, 262, 0
#: Lengths of the units of ImageJ [m].
_UNITS = {
    **{"m": 1.0, "meter": 1.0, "cm": 1e-2, "mm": 1e-3, "nm": 1e-9, "inch": 0.0254},
    **dict.fromkeys(("micron", "um", "\u00b5m", "\u03bcm", "\\u00B5m", "\\u00b5m"), 1e-6),
}


def read(path: Path) -> VolumeFile:
    """Return the head of a TIFF file with several pages.

    Raises:
        InputError: for a file that cannot be read, or has one page.
    """
    size = require_file(path)
    with _opened(path) as image:
        pages = getattr(image, "n_frames", 1)
        counts = (image.width, image.height, pages)
        text = _text_of(image)
        told = int(match[1]) if (match := re.search(r"^images=(\d{1,9})$", text, re.M)) else pages
        if told > pages == 1:
            raise refused(
                path,
                f"pages = {pages}, must be {told} by ImageJ's description",
                "save it as an image sequence",
            )
        form = _values(path, "page 1", image, head=True).dtype
        spacing, metres = _scale(image, text)
    require_size(path, counts, size, form.itemsize)

    def load() -> Content:
        values = np.empty(counts[::-1], dtype=form)
        with _opened(path) as image:
            for page in range(pages):
                image.seek(page)
                _take(path, f"page {page + 1}", image, values[page])
        return Content(values)

    return VolumeFile(counts, load, form.itemsize, spacing, metres=metres)


def read_folder(path: Path) -> VolumeFile:
    """Return the head of a folder of slices, in the order of the last numbers in their names.

    Raises:
        InputError: for a folder without slices, or a number that is missing or used twice.
    """
    slices = _slices(path)
    with _opened(slices[0]) as image:
        counts = (image.width, image.height, len(slices))
        form = _values(slices[0], "the slice", image, head=True).dtype
    require_size(path, counts, sum(map(require_file, slices)), form.itemsize)

    def load() -> Content:
        values = np.empty(counts[::-1], dtype=form)
        for row, one in enumerate(slices):
            with _opened(one) as image:
                _take(one, "the slice", image, values[row])
        return Content(values)

    return VolumeFile(counts, load, form.itemsize)


def _slices(folder: Path) -> list[Path]:
    """Return the slices of a folder in their order."""
    try:
        found = [one for one in folder.iterdir() if one.suffix.lower() in _SLICES]
    except OSError as error:
        raise InputError(
            f"{name_of(folder)}, cannot be read ({error.strerror}); give a folder of slices"
        ) from None
    numbered: dict[int, Path] = {}
    for one in sorted(found):
        digits = re.findall(r"[0-9]{1,18}", one.stem)
        if not digits:
            raise refused(one, "name of a slice has no number", "number the slices from below")
        other = numbered.setdefault(int(digits[-1]), one)
        if other != one:
            raise refused(
                folder,
                f"slice {int(digits[-1])} = {other.name} and {one.name}, must be one file",
                "move other images to another folder",
            )
    if not numbered:
        raise refused(folder, f"slices = 0 files with {', '.join(_SLICES)}", "give their folder")
    order = sorted(numbered)
    steps = np.diff(order)
    gaps = np.flatnonzero(steps != steps.min(initial=order[-1] + 1))
    if len(gaps):
        raise refused(
            folder,
            f"slice {order[gaps[0]] + int(steps.min())} is missing after "
            f"{numbered[order[gaps[0]]].name}",
            "put it there, or number the slices in equal steps",
        )
    return [numbered[number] for number in order]


def _opened(path: Path) -> Any:
    """Open an image, with errors that name the file."""

    def broken(reason: str) -> InputError:
        told = f"must be a TIFF stack or PNG slices of 8 to 32 bits: {reason}"
        return refused(path, told, "give a whole file")

    return image_files.opened(path, broken)


def _take(path: Path, what: str, image: ImageFile, into: AnyArray) -> None:
    """Read a page into a layer of the volume, of whose size and type it must be."""
    if (image.height, image.width) != into.shape:
        raise refused(
            path,
            f"size of {what} = {image.width} x {image.height} pixels along x, y, must be "
            f"{into.shape[1]} x {into.shape[0]} as of the first one",
            "save slices of one size",
        )
    found = _values(path, what, image)
    if found.dtype != into.dtype:
        raise refused(
            path,
            f"type of {what} = {found.dtype}, must be {into.dtype} as of the first one",
            "save slices of one type",
        )
    into[...] = found


def _values(path: Path, what: str, image: ImageFile, head: bool = False) -> AnyArray:
    """Return the labels of a page; for the head an array that has only their type."""
    if image.mode not in _MODES:
        raise refused(
            path,
            f"mode of {what} = {image.mode}, must be grey or a palette",
            "convert the colours to labels",
        )
    if head:
        from PIL import Image

        found = np.asarray(Image.new(image.mode, (1, 1)))
    else:
        found = np.asarray(image)
    tags = getattr(image, "tag_v2", {})
    if image.mode == "I" and tags.get(_SAMPLE_FORMAT, (_UNSIGNED,))[0] == _UNSIGNED:
        found = found.view(np.uint32) if tags else found
    if image.mode in ("1", "L") and tags.get(_PHOTOMETRIC) == _WHITE_IS_0:
        found = ~found  # the numbers of the file, which Pillow turns into grey levels
    return found


def _text_of(image: ImageFile) -> str:
    """Return the description in a TIFF file if ImageJ has written it, otherwise nothing."""
    found = getattr(image, "tag_v2", {}).get(_DESCRIPTION, "")
    return found if isinstance(found, str) and found.startswith("ImageJ=") else ""


def _scale(image: ImageFile, text: str) -> tuple[Triple | None, float | None]:
    """Return ImageJ's size of a voxel and the length of its unit; None if one of them is unknown.

    ImageJ writes the distance of pages only if it differs from one unit.
    """
    fields = dict(re.findall(r"^(unit|spacing)=(.*?)\s*$", text, re.M))
    metres = _UNITS.get(fields.get("unit", ""))
    if metres is None:
        return None, None
    tags: dict[int, Any] = getattr(image, "tag_v2", {})
    sizes = [_inverse(tags.get(tag)) for tag in _RESOLUTION]
    sizes.append(_number(fields.get("spacing", "1")))
    if not all(math.isfinite(size) and size > 0.0 for size in sizes):
        return None, None
    return (sizes[0], sizes[1], sizes[2]), metres


def _inverse(resolution: Any) -> float:
    value = _number(resolution)
    return 1.0 / value if value else math.nan


def _number(value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return math.nan
