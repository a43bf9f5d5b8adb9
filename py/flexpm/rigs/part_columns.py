# SPDX-License-Identifier: GPL-3.0-or-later
"""Additional columns of the record of a rig of parts: gauges, displacements, names. SI units."""

from __future__ import annotations

from yade import wrapper

from ..errors import InputError
from ..files import Table
from ..renamed import COLUMNS as RENAMED
from ..renamed import present
from ..require import quoted, require_flag, require_known
from ..results.record import COLUMNS
from .layout import PartLayout
from .parts import HeldNodes, Part, RigPart, require_part
from .places import Place, require_column, require_direction, require_vector

#: What a gauge reads.
_TRAITS = ("first", "second", "plate", "nodes", "direction", "length")


class PartColumns(PartLayout):
    """Base of a rig of parts that records additional quantities."""

    _same: dict[str, str]

    def gauge(
        self,
        name: str,
        first: Place,
        second: Place,
        *,
        along: Place | None = None,
        strain: bool = False,
    ) -> None:
        """Record the relative displacement of two points, in a column of this name.

        Args:
            name: Name of the column.
            first: x, y, in 3D also z, of a point; the gauge takes the nearest node of the grains on
                its side [m].
            second: The second point, as `first`.
            along: Direction in which an opening moves the second point away from the first point;
                None: the direction from the first to the second point.
            strain: Record the strain between the points [-] instead of the opening [m].

        Raises:
            InputError: for a name that is taken, or a strain between equal points.

        Example:
            >>> rig = flexpm.PartRig(flexpm.build(specimen))
            >>> rig.gauge("widening", (0.0, 0.012), (0.012, 0.012))
            >>> rig.reading("widening")  # [m], nothing has moved yet
            0.0
        """
        label = f"gauge {self._gauge_name(name)}"
        one, two = (
            require_vector(f"{label}: first", first, axes=self._axes),
            require_vector(f"{label}: second", second, axes=self._axes),
        )
        strain = require_flag(f"{label}: strain", strain)
        try:
            node, other, length = self.built.solver.gaugePoints(one, two)
        except ValueError as error:
            raise InputError(f"{label}: {error}") from None
        if strain and not length > 0.0:
            raise InputError(f"{label}: length = 0 m, must be > 0; choose points further apart")
        apart = [two[axis] - one[axis] for axis in range(len(self._axes))]
        direction = require_direction(label, apart if along is None else along, self._axes)
        base = length if strain else 0.0
        self._add_gauge(
            name,
            wrapper.Gauge(first=node, second=other, direction=direction, length=base),
        )

    def displacement_of(self, name: str, part: RigPart, direction: Place) -> None:
        """Record the displacement of a part along a direction [m], in a column of this name.

        The displacement of fixed nodes is the mean over the nodes.

        Args:
            name: Name of the column.
            part: Part of this rig.
            direction: x and y, in 3D also z, of any length.

        Raises:
            InputError: for a name that is taken, a part of another rig, or a direction of length 0.
        """
        label = f"gauge {self._gauge_name(name)}"
        part = require_part(f"{label}: part", self, part, RigPart)
        gauge = wrapper.Gauge(direction=require_direction(label, direction, self._axes))
        if isinstance(part, HeldNodes):
            gauge.nodes = part.nodes
        else:
            gauge.plate = part.number
        self._add_gauge(name, gauge)

    def contact_angle_of(self, name: str, jaw: Part) -> None:
        """Record the contact angle between a disc and a jaw [rad], in a column of this name.

        The angle is measured at the centre of the disc between the outermost points in contact;
        each point contributes its tributary length.

        Args:
            name: Name of the column.
            jaw: Plate that `jaw` returned.

        Raises:
            InputError: for a name that is taken, or a part that is not a jaw of this rig.
        """
        label = f"gauge {self._gauge_name(name)}"
        jaw = require_part(f"{label}: part", self, jaw, Part)
        if not self.built.solver.plates()[jaw.number]["radius"]:
            raise InputError(
                f"{label}: part = {jaw}, must be a jaw; pass a part that jaw() returned"
            )
        self._add_gauge(name, wrapper.Gauge(plate=jaw.number, reads="contact_angle"))

    def rotation_of(self, name: str, part: Part) -> None:
        """Record the rotation of a seated part [rad], in a column of this name; see `Part.angle`.

        In 3D the column has the magnitude of the rotation.

        Args:
            name: Name of the column.
            part: Plate that was added with ``seated=True``.

        Raises:
            InputError: for a name that is taken, or a part that is not a seated part of this rig.
        """
        label = f"gauge {self._gauge_name(name)}"
        part = require_part(f"{label}: part", self, part, Part)
        if not self.built.solver.plates()[part.number]["seated"]:
            raise InputError(f"{label}: part = {part}, must be seated; place it with seated=True")
        self._add_gauge(name, wrapper.Gauge(plate=part.number, reads="angle"))

    def _watch_machine(self, plate: int, unit: tuple[float, float, float]) -> None:
        for reads in ("crosshead", "machine_energy"):
            name = RENAMED.get(reads, reads)
            there = [one for one in self._recorder.gauges if one.reads == reads]
            self._rename(there, name)
            if there and not self._begun:  # another call says what loads
                there[0].plate, there[0].direction = plate, unit
                continue
            label = self._gauge_name(name)
            self._add_gauge(label, wrapper.Gauge(plate=plate, direction=unit, reads=reads))

    def _rename(self, there: list[wrapper.Gauge], name: str) -> None:
        """Rename gauges of a record that began under an old name, also in the servo."""
        for one in there:
            if self._recorder.controlled == one.name:
                self._recorder.controlled = name
            one.name = name

    def reading(self, name: str) -> float:
        """Return the present reading of a gauge, in the unit of its column.

        It works before the record begins, for example after `settle` or `press`, and then counts
        from the bonded state. Later it counts from the same state as the record.

        Args:
            name: Name of the gauge.

        Raises:
            InputError: for an unknown gauge, or a gauge on an erased grain.
        """
        self._require_scene("reading")
        names = [one.name for one in self._recorder.gauges]
        name = present(name, RENAMED, names)
        require_known("reading: gauge", name, names)
        if name in self._recorder.lostGauges():
            raise InputError(
                f"reading: the grain of gauge {quoted(name)} has been erased; place another gauge"
            )
        return self._recorder.reading(name)

    def alias_column(self, name: str, column: str) -> None:
        """Add an alias to a column of the record, under which the test reports it.

        Args:
            name: The alias.
            column: Name of the column.

        Raises:
            InputError: for an unknown column, or an alias that is the name of another column.
        """
        there = self._columns()
        column = present(column, RENAMED, there)
        require_known("alias_column: column", column, there)
        self._same[require_column("alias_column", name, (*there, "set_point"))] = column

    @property
    def gauges(self) -> list[Table]:
        """All gauges as plain values: nodes, or the part that is recorded, and the direction."""
        found = []
        for one in self._recorder.gauges:
            traits = {name: getattr(one, name) for name in _TRAITS}
            traits["direction"] = list(traits["direction"])
            traits.update({"reads": one.reads} if one.reads else {})
            found.append({"gauge": one.name, **traits})
        return found

    def _columns(self) -> tuple[str, ...]:
        """Names that no new column may have, and that may have an alias."""
        names = (*COLUMNS, *self._recorder.names, "load", "displacement", *self._same)
        return tuple(name for name in dict.fromkeys(names) if name != "initial_energy")

    def _gauge_name(self, name: object) -> str:
        """Return a name that a new gauge may have, or the name of a gauge of a begun record."""
        there = [one.name for one in self._recorder.gauges]
        if self._begun and isinstance(name, str) and name in there:
            return name
        taken = (*self._columns(), "initial_energy", "set_point")
        text = require_column("gauge", name, taken)
        if self._begun:
            raise InputError(
                f"gauge = {text!r}, must be a gauge of the record, {there}; make a new rig to "
                "add gauges"
            )
        return text

    def _add_gauge(self, name: str, gauge: wrapper.Gauge) -> None:
        """Add a gauge, or find it in the record that has begun."""
        self._require_scene(f"gauge {name}")
        recorder = self._recorder
        if not self._begun:
            gauge.name = name
            recorder.addGauge(gauge)
            return
        there = next(one for one in recorder.gauges if one.name == name)
        for trait in (*_TRAITS, "reads"):
            now, asked = getattr(there, trait), getattr(gauge, trait)
            if now != asked and name not in recorder.lostGauges():
                raise InputError(
                    f"gauge {name}: {trait} = {asked}, must be {now} as in the record; make a new "
                    "rig to change it"
                )

    def _measures(self) -> tuple[str, ...]:
        own = [name for name in self._recorder.names if name not in COLUMNS]
        return tuple(name for name in own if name not in ("initial_energy", "displacement"))
