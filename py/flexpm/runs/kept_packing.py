# SPDX-License-Identifier: GPL-3.0-or-later
"""Saved packing of a run, which saves a resumed run minutes. Lengths in metres.

The file is written by ``Specimen.save``, and ``checkpoint.json`` has its checksum. A file that is
missing, damaged or belongs to another run is not used: the run packs from its seed again.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError
from ..files import read_bytes, read_json
from ..specimens.files import given, specimen_file
from ..specimens.space import file as solid_file
from ..specimens.space.any_spec import AnySpec
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.spec import PACKING_FILE, SpecimenSpec
from ..specimens.specimen import AnySpecimen, Specimen
from .output import BEGUN

#: Name of the file.
FILE = PACKING_FILE
#: Entry of checkpoint.json with the checksum of the file.
ENTRY = "packing"


def keep(folder: Path, specimen: AnySpecimen) -> str:
    """Save the specimen of a run into its folder; return the checksum of its file.

    A specimen that no packing gives again is saved as ``grains.json`` alone.
    """
    given.save(folder, specimen)
    file = _file_of(folder, specimen.spec)
    if specimen.spec.is_packed:
        specimen.save(file)
    return _checksum(file)


def kept(folder: Path, spec: AnySpec) -> tuple[AnySpecimen | None, str]:
    """Load the specimen of a run that a checkpoint in `folder` resumes.

    Args:
        folder: Folder of the run.
        spec: Inputs of the specimen.

    Returns:
        The specimen, or None and a line that says why its file is not used. The line is empty
        where there is no checkpoint.
    """
    try:
        named = read_json(folder / BEGUN).get(ENTRY)
    except (OSError, ValueError, AttributeError, RecursionError):
        return None, ""  # what is no checkpoint is refused when the run looks for it
    file = _file_of(folder, spec)
    try:
        if _checksum(file) != named:
            return None, _told(file, "is damaged or of another run")
        made: AnySpecimen
        made = (Specimen if isinstance(spec, SpecimenSpec) else SolidSpecimen).load(file)
    except OSError as error:
        return None, _told(file, f"cannot be read ({error.strerror})")
    except ValueError as error:  # also an InputError
        return None, _told(file, f"cannot be used ({error})")
    if made.spec != spec:
        return None, _told(file, "is of another specimen")
    return made, ""


def difference(folder: Path, made: AnySpecimen) -> str:
    """Return one line on how a packing differs from the packing in a folder; empty if equal.

    Args:
        folder: Folder of an earlier run; without a packing there is nothing to compare.
        made: The packing of the same spec.
    """
    file = folder / FILE
    if not made.spec.is_packed or not file.is_file():
        return ""
    try:
        spec, there = _rows(file)
    except InputError as error:
        return f"packing is not compared: {error}"
    here = np.column_stack((made.centres, made.radii))
    if spec != made.spec:
        return f"packing is not compared: {file} is of another specimen"
    if there.shape != here.shape:
        return f"packing has {len(here)} grains, {len(there)} in {file}"
    others = np.any(there != here, axis=1)
    if not others.any():
        return ""
    return (
        f"packing differs in {np.count_nonzero(others)} of {len(here)} grains from {file}, by up "
        f"to {np.abs(there - here).max():.2g} m"
    )


def _file_of(folder: Path, spec: AnySpec) -> Path:
    return folder / (FILE if spec.is_packed else given.FILE)


def _rows(file: Path) -> tuple[AnySpec, FloatArray]:
    """Spec, and centre and radius of each disc or sphere of a file."""
    if solid_file.is_one(file):
        solid = solid_file.read(file)
        return solid["spec"], np.array(solid["spheres"], dtype=float)
    plane = specimen_file.read(file)
    return specimen_file.spec_of(plane), np.array(plane["discs"], dtype=float)


def _checksum(file: Path) -> str:
    return hashlib.sha256(read_bytes(file)).hexdigest()


def _told(file: Path, why: str) -> str:
    return f"packs from the seed again: {file} {why}"
