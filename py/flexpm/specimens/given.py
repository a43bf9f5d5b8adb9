# SPDX-License-Identifier: GPL-3.0-or-later
"""File of what no packing gives: discs, outline and minerals that a script has made. SI units.

Checksums in the inputs of a run tell whether the file is still that of the run.
"""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import InputError
from ..files import whole_file
from ..progress import Progress
from .spec import SpecimenSpec
from .specimen import Circle, Specimen

#: Name of the file.
FILE = "specimen.npz"


def save(folder: Path, specimen: Specimen) -> None:
    """Save what a script has given; a specimen that was packed needs no file."""
    if not _is_given(specimen.spec):
        return
    outline = specimen.outline
    arrays: dict[str, npt.ArrayLike] = {
        "discs": specimen.discs,
        "outline": [outline.x, outline.y, outline.radius]
        if isinstance(outline, Circle)
        else outline,
    }
    if specimen.minerals is not None:
        arrays["minerals"] = specimen.minerals
    with whole_file(folder / FILE) as temporary:
        np.savez_compressed(temporary, **arrays)


def load(spec: SpecimenSpec, folder: Path, progress: Progress | None = None) -> Specimen:
    """Make the specimen of a run again: packed from its seed, or from its file.

    Args:
        spec: What the specimen was made from.
        folder: Where the file is.
        progress: Called with (steps done, steps expected, text).

    Raises:
        InputError: if the file is not there any more, or holds another specimen.
    """
    arrays = _read(folder / FILE) if _is_given(spec) else {}
    try:
        made = _packed(spec, progress) if spec.discs is None else _tessellated(spec, arrays)
        if spec.minerals is not None:
            made = made.with_minerals(arrays["minerals"].astype(int))
    except (KeyError, IndexError) as error:
        raise InputError(f"specimen = {str(folder / FILE)!r}, lacks {error}") from None
    if made.spec != spec:
        raise InputError(
            f"specimen = {str(folder / FILE)!r}, has another checksum than the run's; put the file "
            "of that run there"
        )
    return made


def _is_given(spec: SpecimenSpec) -> bool:
    return spec.discs is not None or spec.minerals is not None


def _packed(spec: SpecimenSpec, progress: Progress | None) -> Specimen:
    return Specimen.pack(replace(spec, minerals=None), progress)


def _tessellated(spec: SpecimenSpec, arrays: dict[str, npt.NDArray[np.generic]]) -> Specimen:
    discs, outline = arrays["discs"].astype(float), arrays["outline"].astype(float)
    return Specimen.from_discs(
        discs[:, :2],
        discs[:, 2],
        Circle(*outline.tolist()) if outline.ndim == 1 else outline,
        spec.thickness,
        short_edge=spec.short_edge,
    )


def _read(file: Path) -> dict[str, npt.NDArray[np.generic]]:
    try:
        with np.load(file, allow_pickle=False) as content:
            return {name: content[name] for name in content.files}
    except OSError as error:
        raise InputError(
            f"specimen = {str(file)!r}, cannot be read ({error.strerror}); a script gave the run "
            "its discs or minerals, put their file there"
        ) from None
    except (ValueError, AttributeError, zipfile.BadZipFile):
        raise InputError(
            f"specimen = {str(file)!r}, holds no arrays; put the file of that run there"
        ) from None
