# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from raster tessellations of Neper, ``.tesr`` in 3D. Label 0 is void."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..labels import tesr
from .volume_file import Content, VolumeFile, require_file, require_size, triple_of


def read(path: Path) -> VolumeFile:
    """Return the head of a raster in 3D.

    Raises:
        InputError: for a file that cannot be read or is in 2D.
    """
    require_file(path)
    raster = tesr.head(path, 3)
    x, y, z = raster.counts
    bytes_a_voxel = 4 if raster.form == "ascii" or raster.ids is not None else 0
    require_size(path, (x, y, z), require_file(raster.data), bytes_a_voxel)

    def load() -> Content:
        labels = raster.labels().reshape(z, y, x)
        phases = None
        if raster.phases is not None:
            numbers = np.arange(1, len(raster.phases) + 1)
            phases = (numbers if raster.ids is None else raster.ids, raster.phases)
        return Content(labels, phases, has_voids=True)

    spacing = triple_of(path, "size of a voxel", raster.spacing, 0.0)
    origin = triple_of(path, "origin", raster.origin, -np.inf)
    return VolumeFile((x, y, z), load, bytes_a_voxel, spacing, origin)
