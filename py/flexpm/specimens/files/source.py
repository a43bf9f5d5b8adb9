# SPDX-License-Identifier: GPL-3.0-or-later
"""Source of the specimen of a command or a study.

Only light modules are loaded, except numpy and scipy if a fracture network is generated.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import InputError
from ...joints import geojson
from ...joints import lines as joint_lines
from ...progress import Progress
from ..space import file as solid_file
from ..space.any_spec import AnySpec
from ..space.spec import SolidSpec
from . import specimen_file

if TYPE_CHECKING:
    from ...joints.network import Network
    from ..space.specimen import SolidSpecimen
    from ..specimen import Specimen

    AnySpecimen = Specimen | SolidSpecimen


@dataclass(frozen=True)
class SpecimenSource:
    """A packing or a specimen file, joints that cut it, and then a fracture network.

    Attributes:
        plain: Spec of the specimen before these joints cut it.
        file: File of the specimen; None: the specimen is packed.
        lines: Lines of the joints; None: no joints. The file is read only once, since it may be a
            pipe.
        network: The fracture network; None: no network.
        traces: Generated traces of the network.
        origin: Point of a map of joints at the specimen's origin [m]; None: no map.
        notes: Notes of the reader of a map, one line each.
    """

    plain: AnySpec
    file: Path | None = None
    lines: joint_lines.Lines | None = None
    network: Network | None = None
    traces: joint_lines.Lines = field(default_factory=dict)
    origin: joint_lines.Point | None = None
    notes: tuple[str, ...] = ()

    @classmethod
    def read(
        cls,
        packed: AnySpec | None,
        file: Path | None = None,
        joints: Path | None = None,
        network: Path | None = None,
        network_seed: int | None = None,
        *,
        joint_name: str | None = None,
        joint_origin: joint_lines.Point | None = None,
    ) -> SpecimenSource:
        """Read the given files.

        Args:
            packed: Spec of a packing; None if there is a specimen file.
            file: Specimen file.
            joints: CSV file of joints, or a map of joints as GeoJSON.
            network: TOML file of a fracture network.
            network_seed: Seed that replaces the network's seed.
            joint_name: Property of the map that names joints, see ``geojson.read``.
            joint_origin: Point of the map at the specimen's origin [m], see ``geojson.read``.

        Returns:
            The source.

        Raises:
            InputError: for a file that cannot be read or has another content, or a network that
                cannot be generated.
        """
        outline = None
        if file is not None:
            if solid_file.is_one(file):
                packed = solid_file.read(file)["spec"]
            else:
                content = specimen_file.read(file)
                packed, outline = specimen_file.spec_of(content), content["outline"]
        assert packed is not None
        if isinstance(packed, SolidSpec):
            if joints is not None or network is not None:
                raise InputError(
                    f"joints = {joints or network}, must not be given for a {packed.kind}; leave "
                    "them out"
                )
            return cls(packed, file)
        lines, origin = None, None
        notes: tuple[str, ...] = ()
        if joints is not None and joints.suffix.lower() in geojson.SUFFIXES:
            found = geojson.read(joints, joint_name, joint_origin)
            lines, origin, notes = found.lines, found.origin, found.notes
        elif joint_name is not None or joint_origin is not None:
            given = joint_name if joint_origin is None else joint_origin
            raise InputError(
                f"name or origin = {given}, needs a map of joints; give a .geojson file or leave "
                "it out"
            )
        elif joints is not None:
            lines = joint_lines.read(joints)
        if network is None:
            if network_seed is not None:
                raise InputError(
                    f"network_seed = {network_seed}, needs a network; give its file or leave it out"
                )
            return cls(packed, file, lines, origin=origin, notes=notes)
        from ...joints.network import Network

        chosen = Network.read(network, network_seed)
        traces = chosen.lines(packed.window(outline))
        return cls(packed, file, lines, chosen, traces, origin, notes)

    @property
    def spec(self) -> AnySpec:
        """Spec of the specimen, joints included."""
        spec = self.plain
        if isinstance(spec, SolidSpec):
            return spec
        if self.lines is not None:
            spec = spec.with_joints(self.lines, self.origin)
        if self.network is None:
            return spec
        return spec.with_network(self.network.to_json(), self.traces)

    def make(self, progress: Progress | None = None) -> AnySpecimen:
        """Pack or load the specimen and cut it; YADE must be loaded.

        Args:
            progress: Called with (steps done, steps expected, text).

        Returns:
            The specimen.

        Raises:
            InputError: for discs that do not fit, or lines that do not cut anything.
        """
        if isinstance(self.plain, SolidSpec):
            from ..space.specimen import SolidSpecimen

            if self.file is not None:
                return SolidSpecimen.load(self.file)
            return SolidSpecimen.pack(self.plain, progress)
        from ..specimen import Specimen

        found = (
            Specimen.pack(self.plain, progress) if self.file is None else Specimen.load(self.file)
        )
        if self.lines is not None:
            found = found.with_joints(self.lines, progress, origin=self.origin)
        if self.network is not None:
            found = found.with_network(self.network.to_json(), None, progress)
        return found
