# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of labels, read from files, and the phases of their labels."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import IntArray
from ...errors import InputError
from ...files import Table, load_toml
from ...require import quoted, require_name
from . import image_files, tesr
from .given import MOST_PIXELS, NO_VOLUMES, whole_labels

if TYPE_CHECKING:
    from PIL.Image import Image as ImageFile

#: What a phase is called that is no rock.
HOLE_NAME = "hole"
#: Endings of files that have volumes only.
_VOLUMES = (".raw", ".dream3d", ".vti", ".vtk")
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")


@dataclass(frozen=True)
class Picture:
    """Labels of pixels, the first row at the top."""

    labels: IntArray
    has_colours: bool = False  #: whether a label is a colour, red * 65536 + green * 256 + blue
    has_voids: bool = False  #: whether 0 stands for no rock

    def name_of(self, label: int) -> str:
        """Return a label in the notation of a phase file."""
        return f"#{label:06x}" if self.has_colours else str(label)


def read(path: Path) -> Picture:
    """Read labels from a PNG, TIFF, NPY or TESR file.

    A palette image is read as its indices; an opacity channel must be fully opaque.

    Args:
        path: The file.

    Returns:
        The labels.

    Raises:
        InputError: for a file that cannot be read, has several pages, more pixels than the limit,
            or values that are not integers.
    """
    if _is_volume(path):
        raise InputError(
            f"image = {quoted(str(path))}, must be a PNG, TIFF, NPY or TESR file: {NO_VOLUMES}; "
            "save one slice"
        )
    if path.suffix.lower() == ".npy":
        return _from_array(path)
    if path.suffix.lower() == ".tesr":
        labels = tesr.read(path)
        return Picture(labels, has_voids=bool((labels == 0).any()))

    def refused(reason: str) -> InputError:
        return InputError(
            f"image = {quoted(str(path))}, must be a PNG, TIFF, NPY or TESR file: {reason}; give "
            "a whole one"
        )

    with image_files.opened(path, refused) as image:
        return _from_open(image)


def _is_volume(path: Path) -> bool:
    """Whether a file has another format than images, or a path is a folder of slices."""
    with contextlib.suppress(OSError, ValueError):  # not the name of a file
        return path.suffix.lower() in _VOLUMES or path.is_dir()
    return False


def _from_open(image: ImageFile) -> Picture:
    """Return the labels of an image of which only the head has been read.

    Raises:
        InputError: for several pages, or more pixels than the limit.
    """
    if image.width * image.height > MOST_PIXELS:
        raise InputError(
            f"image = {image.width} x {image.height} pixels, must be <= {MOST_PIXELS} in all; crop "
            "it or use larger pixels"
        )
    pages = getattr(image, "n_frames", 1)
    if pages > 1:
        raise InputError(f"image = {pages} pages, must be 1: {NO_VOLUMES}; save one slice")
    return _from_image(image.mode, np.asarray(image))


def _from_array(path: Path) -> Picture:
    """Return the labels of an array; its size is checked from its head before the data are read."""
    try:
        image_files.require_short_head(path)
        found = np.load(path, mmap_mode="r", allow_pickle=False)
    except image_files.BROKEN as error:
        reason = image_files.short(error)
        raise InputError(
            f"image = {quoted(str(path))}, must be an array of numbers: {reason}; save it with "
            "numpy.save"
        ) from None
    if not isinstance(found, np.ndarray) or found.ndim not in (2, 3) or found.size > MOST_PIXELS:
        shape = getattr(found, "shape", "several arrays")
        raise InputError(
            f"image = {quoted(str(path))} of shape {shape}, must be rows of labels, at most "
            f"{MOST_PIXELS}; save one slice, or crop it"
        )
    if found.ndim == 3:
        raise InputError(
            f"image = array of shape {found.shape}, must be rows of one image: {NO_VOLUMES}; save "
            "one slice"
        )
    return Picture(whole_labels(found))


def _from_image(mode: str, values: IntArray) -> Picture:
    if mode in ("LA", "RGBA"):
        clear = values[..., -1] != 255
        if clear.any():
            row, column = np.argwhere(clear)[0].tolist()
            raise InputError(
                f"image opacity = {int(values[row, column, -1])} of 255 at row {row}, column "
                f"{column}, must be full; save it without transparency"
            )
        values = values[..., :-1]
        mode = mode[:-1]
        values = values[..., 0] if mode == "L" else values
    if mode == "RGB":
        red, green, blue = (values[..., k].astype(np.int64) for k in range(3))
        return Picture(65536 * red + 256 * green + blue, has_colours=True)
    if values.ndim != 2:
        raise InputError(f"image mode = {mode}, must be grey, a palette or RGB; convert it")
    return Picture(whole_labels(values))


def read_phases(path: Path, picture: Picture) -> dict[int, str]:
    """Read the name of the mineral, or ``hole``, of each label.

    Args:
        path: A TOML file: labels, or colours ``#rrggbb``, and the phase of each.
        picture: The labels.

    Returns:
        Mineral by label.

    Raises:
        InputError: for a key that is not a label, or a label without a key.
    """
    content: Table = load_toml(path, "phases")
    found: dict[int, str] = {}
    for key, name in content.items():
        found[label_of("phases key", key, picture)] = require_name(f"phases {quoted(key)}", name)
    if not found:
        raise InputError(f"phases = {quoted(str(path))}, is empty; give label = mineral")
    _require_all(found, picture, path)
    return found


def label_of(what: str, key: str, picture: Picture) -> int:
    """Return the label that a text stands for: a whole number, or a colour.

    Raises:
        InputError: for a text that is not in the notation of the image.
    """
    rule = "a colour #rrggbb" if picture.has_colours else "a whole number"
    if picture.has_colours and _COLOUR.fullmatch(key):
        return int(key[1:], 16)
    if not picture.has_colours and re.fullmatch(r"-?[0-9]{1,18}", key):
        return int(key)
    raise InputError(f"{what} = {quoted(key)}, must be {rule} as in the image; correct it")


def _require_all(found: Mapping[int, str], picture: Picture, path: Path) -> None:
    """Raise InputError for labels without a phase, with their number and the first label."""
    labels = picture.labels
    values, first, counts = np.unique(labels, return_index=True, return_counts=True)
    missing = [row for row, value in enumerate(values.tolist()) if value not in found]
    if missing:
        row, column = divmod(int(first[missing[0]]), labels.shape[1])
        name = picture.name_of(int(values[missing[0]]))
        others = f"; so are {len(missing) - 1} others" if len(missing) > 1 else ""
        raise InputError(
            f"image {'colour' if picture.has_colours else 'label'} = {name} of "
            f"{int(counts[missing[0]])} pixels, one at row {row}, column {column}, is missing in "
            f"{path}{others}; name it there"
        )


def indices(phases: Mapping[int, str]) -> tuple[list[str], dict[int, int | None]]:
    """Return the minerals in the order of the file, and the mineral index of each label."""
    names = [name for name in dict.fromkeys(phases.values()) if name != HOLE_NAME]
    return names, {
        label: None if name == HOLE_NAME else names.index(name) for label, name in phases.items()
    }
