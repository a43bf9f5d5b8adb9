# SPDX-License-Identifier: GPL-3.0-or-later
"""The specimen of a run that no packing gives again, in a file beside the results. SI units."""

from __future__ import annotations

from pathlib import Path

from ...errors import InputError
from ...progress import Progress
from ..space.any_spec import AnySpec
from ..space.specimen import SolidSpecimen
from ..spec import GRAINS_FILE, SpecimenSpec
from ..specimen import AnySpecimen, Specimen

#: Name of the file.
FILE = GRAINS_FILE


def save(folder: Path, specimen: AnySpecimen) -> None:
    """Save a specimen of user-supplied cells, discs or spheres; packed specimens need no file."""
    if not specimen.spec.is_packed:
        specimen.save(folder / FILE)


def load(spec: AnySpec, folder: Path, progress: Progress | None = None) -> AnySpecimen:
    """Make the specimen of a run again: packed from its seed, or from its file.

    Args:
        spec: Inputs of the specimen.
        folder: Where the file is.
        progress: Called with (steps done, steps expected, text).

    Raises:
        InputError: if the file is not there any more, or holds another specimen.
    """
    made: AnySpecimen
    if isinstance(spec, SpecimenSpec):
        if spec.is_packed:
            return Specimen.pack(spec, progress)
        made = Specimen.load(folder / FILE)
    elif spec.is_packed:
        return SolidSpecimen.pack(spec, progress)
    else:
        made = SolidSpecimen.load(folder / FILE)
    if made.spec != spec:
        raise InputError(
            f"specimen = {str(folder / FILE)!r}, is not the specimen of the run; copy the file of "
            "the run there"
        )
    return made
