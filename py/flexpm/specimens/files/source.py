# SPDX-License-Identifier: GPL-3.0-or-later
"""Source of the specimen of a command or a study.

Only light modules are loaded, except numpy and scipy if a fracture network is generated.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ...dimensions import refused
from ...errors import InputError
from ...joints import dfnworks, geojson, plane_files
from ...joints import lines as joint_lines
from ...joints.planes import JointPlane
from ...progress import Progress
from ..space import file as solid_file
from ..space.any_spec import AnySpec
from ..space.spec import SolidSpec
from . import specimen_file

if TYPE_CHECKING:
    from ...joints.disc_network import DiscNetwork
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
        planes: Planes of the joints of a 3D specimen.
        discs: Fracture network of a 3D specimen; None: no network.
        of_discs: Generated planes of this network.
    """

    plain: AnySpec
    file: Path | None = None
    lines: joint_lines.Lines | None = None
    network: Network | None = None
    traces: joint_lines.Lines = field(default_factory=dict)
    origin: joint_lines.Point | None = None
    notes: tuple[str, ...] = ()
    planes: tuple[JointPlane, ...] = ()
    discs: DiscNetwork | None = None
    of_discs: tuple[JointPlane, ...] = ()

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
        joint: str | None = None,
    ) -> SpecimenSource:
        """Read the given files.

        Args:
            packed: Spec of a packing; None if there is a specimen file.
            file: Specimen file.
            joints: CSV file of joints; in 2D a map of joints as GeoJSON, in 3D polygons of
                dfnWorks.
            network: TOML file of a fracture network.
            network_seed: Seed that replaces the network's seed.
            joint_name: Property of the map that names joints, see ``geojson.read``.
            joint_origin: Point of the map at the specimen's origin [m], see ``geojson.read``.
            joint: Name of the joint of the polygons of dfnWorks.

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
            if joint_name is None and joint_origin is None:
                planes = _planes(packed, joints, joint)
                return cls._of_solid(packed, file, planes, network, network_seed)
            given = joint_name if joint_origin is None else joint_origin
            asked = f"name or origin = {given}, must be left out for a {packed.kind}"
            raise refused(asked, "joint_maps")
        if joint is not None:
            raise refused(f"joint = {joint}, must be left out for a {packed.kind}", "dfnworks")
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
        _require_network(network, network_seed)
        if network is None:
            return cls(packed, file, lines, origin=origin, notes=notes)
        from ...joints.network import Network

        chosen = Network.read(network, network_seed)
        traces = chosen.lines(packed.window(outline))
        return cls(packed, file, lines, chosen, traces, origin, notes)

    @classmethod
    def _of_solid(
        cls,
        packed: SolidSpec,
        file: Path | None,
        planes: tuple[JointPlane, ...],
        network: Path | None,
        network_seed: int | None,
    ) -> SpecimenSource:
        """Read the network of a 3D specimen with given planes."""
        _require_network(network, network_seed)
        if network is None:
            return cls(packed, file, planes=planes)
        from ...joints.disc_network import Box, DiscNetwork

        chosen = DiscNetwork.read(network, network_seed)
        traces = tuple(chosen.planes(Box(*packed.corners)))
        return cls(packed, file, planes=planes, discs=chosen, of_discs=traces)

    @property
    def spec(self) -> AnySpec:
        """Spec of the specimen, joints included."""
        spec = self.plain
        if isinstance(spec, SolidSpec):
            if self.planes:
                spec = spec.with_joints(self.planes)
            if self.discs is not None:
                spec = spec.with_joints(self.of_discs, self.discs.to_json())
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
                solid = SolidSpecimen.load(self.file)
            else:
                solid = SolidSpecimen.pack(self.plain, progress)
            return solid.cut_by(
                self.planes, None if self.discs is None else self.discs.to_json(), self.of_discs
            )
        from ..specimen import Specimen

        found = (
            Specimen.pack(self.plain, progress) if self.file is None else Specimen.load(self.file)
        )
        if self.lines is not None:
            found = found.with_joints(self.lines, progress, origin=self.origin)
        if self.network is not None:
            found = found.with_network(self.network.to_json(), None, progress)
        return found


def _require_network(network: Path | None, seed: int | None) -> None:
    """Reject the seed of a network without a network."""
    if network is None and seed is not None:
        raise InputError(f"network_seed = {seed}, needs a network; give its file or leave it out")


def _planes(packed: SolidSpec, joints: Path | None, joint: str | None) -> tuple[JointPlane, ...]:
    """Read the planes of joints of a 3D specimen."""
    suffix = None if joints is None else joints.suffix.lower()
    if suffix in geojson.SUFFIXES:
        raise refused(f"joints = {joints}, must be left out for a {packed.kind}", "joint_maps")
    if joints is not None and suffix == dfnworks.SUFFIX:
        return tuple(dfnworks.read(joints, joint, packed.middle))
    if joint is not None:
        raise InputError(
            f"joint = {joint}, needs polygons of dfnWorks; give joints = a {dfnworks.SUFFIX} file, "
            "or leave it out"
        )
    return () if joints is None else tuple(plane_files.read(joints))
