# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from arrays of numpy, ``.npy``, without unpickling."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..labels import image_files
from ..labels.whole import KINDS
from .label_volume import counts_of
from .volume_file import Content, VolumeFile, refused, require_file


def read(path: Path) -> VolumeFile:
    """Return the head of an array (z, y, x); its values stay in the file until they are used.

    Raises:
        InputError: for a file that is no array of three dimensions.
    """
    require_file(path)
    try:
        image_files.require_short_head(path)
        found = np.load(path, mmap_mode="r", allow_pickle=False)
    except image_files.BROKEN as error:
        reason = f"must be an array of numbers: {image_files.short(error)}"
        raise refused(path, reason, "save it with numpy.save") from None
    if not isinstance(found, np.ndarray) or found.ndim != 3 or found.dtype.kind not in KINDS:
        kind = (
            f"{found.dtype} array of shape {found.shape}"
            if isinstance(found, np.ndarray)
            else "several arrays"
        )
        remedy = "save one array of this shape"
        if isinstance(found, np.ndarray) and found.ndim == 2:
            remedy = "give a single slice to flexpm specimen image"
        raise refused(path, f"labels = {kind}, must be numbers along z, y and x", remedy)
    return VolumeFile(counts_of(found), lambda: Content(found))
