# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a specimen comes from that commands and studies ask for. Nothing heavy is loaded for it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ...joints import lines as joint_lines
from ...progress import Progress
from ..spec import SpecimenSpec
from . import specimen_file

if TYPE_CHECKING:
    from ..specimen import Specimen


@dataclass(frozen=True)
class SpecimenSource:
    """A packing or a file of a specimen, and lines of joints that cut it.

    Attributes:
        plain: What the specimen is made from before these joints cut it.
        file: File of the specimen; None: it is packed.
        lines: Lines of the joints, which were read once: their file may be a pipe; None: no joints.
    """

    plain: SpecimenSpec
    file: Path | None = None
    lines: joint_lines.Lines | None = None

    @classmethod
    def read(
        cls, packed: SpecimenSpec | None, file: Path | None = None, joints: Path | None = None
    ) -> SpecimenSource:
        """Read what files there are.

        Args:
            packed: A packing, or None if there is a file of a specimen.
            file: The specimen's file.
            joints: A CSV file of joints.

        Raises:
            InputError: for a file that cannot be read, or that holds something else.
        """
        if file is not None:
            packed = specimen_file.spec_of(specimen_file.read(file))
        assert packed is not None
        return cls(packed, file, None if joints is None else joint_lines.read(joints))

    @property
    def spec(self) -> SpecimenSpec:
        """What the specimen is made from, joints included."""
        return self.plain if self.lines is None else self.plain.with_joints(self.lines)

    def make(self, progress: Progress | None = None) -> Specimen:
        """Pack or load the specimen and cut it; YADE must be loaded.

        Args:
            progress: Called with (steps done, steps expected, text).

        Raises:
            InputError: for discs that do not fit, and lines that cut nothing.
        """
        from ..specimen import Specimen

        found = (
            Specimen.pack(self.plain, progress) if self.file is None else Specimen.load(self.file)
        )
        return found if self.lines is None else found.with_joints(self.lines, progress)
