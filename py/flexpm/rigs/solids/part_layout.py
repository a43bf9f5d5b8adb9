# SPDX-License-Identifier: GPL-3.0-or-later
"""Add plates to a 3D specimen: on a patch of its surface, or along a line. SI units."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...errors import InputError
from ...models.grains import Model
from ...require import NOT_NEGATIVE, require_flag, require_number, require_whole
from ...specimens.space.specimen import SolidSpecimen
from ..layout import NO_SLIDING, PartLayout, strip_of
from ..parts import Part
from ..places import SPACE, Jaw, Place, Vector, require_direction, require_vector
from .patches import (
    BOTTOM,
    INWARDS,
    TOP,
    Patch,
    box_around,
    edges_of,
    inwards_at,
    patch_around,
    side_patch,
)
from .solid_grains import SolidGrains

#: Width that the stiffness of a line stands for, in mean diameters of the grains, as the length of
#: a support in the plane [-].
_WIDTH = 0.5
#: Least part of a line's normal along z [-].
_UPRIGHT = 0.5


class SolidPartLayout(PartLayout, SolidGrains):
    """Base of a rig that adds parts to a 3D specimen."""

    built: Model
    #: Where plates lie, by their numbers; jaws have none.
    _patches: dict[int, Patch]
    #: Lines along plates in the section along x and z, by their numbers, for maps [m].
    _traces: dict[int, list[list[float]]]

    def support(
        self,
        position: Place,
        length: object = None,
        *,
        normal: Place = (0.0, 0.0, 0.0),
        pinned: bool = False,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Add a plate on the part of the surface around a position.

        Args:
            position: x, y and z of a point on the surface [m].
            length: Edge of a cube around the position, or edges of a box along x, y and z; the
                plate covers the surface within it [m]. None: a roller, which carries load along a
                line across the depth through x and z of the position, on the bottom or from above.
            normal: x, y and z of a direction into the specimen; zero: the normal of the nearest
                flat side.
            pinned: Prevent sliding while the support is pressed.
            friction: Friction coefficient of a support that is not pinned [-]; not available for
                rollers.
            bonded: Also transmit tension, and slide freely; not available for rollers.
            strip: Stiffness per area of a soft layer between plate and grains [Pa/m]: E / h for a
                layer of thickness h; None: no layer. Not available for rollers.
            seated: Allow free rotation about the middle of the plate's face, as on a spherical
                seat. The plate starts at the inclination of the covered surface, as in 2D
                (deviation D95). Not available for rollers.

        Returns:
            The plate.

        Raises:
            InputError: for a position that is not on the surface or that another part occupies, or
                a size out of range.
        """
        seated = require_flag("support: seated", seated)
        specimen, at = self._specimen, require_vector("support: position", position, axes=SPACE)
        inwards = require_vector("support: normal", normal, "", SPACE)
        if any(inwards):
            inwards = require_direction("support: normal", inwards, SPACE)
        if require_flag("support: pinned", pinned):
            friction = NO_SLIDING
        friction = require_number("support: friction", friction, NOT_NEGATIVE)
        bonded = require_flag("support: bonded", bonded)
        if length is None:
            more = bonded or seated or strip is not None
            if more or friction not in (0.0, NO_SLIDING):
                raise InputError(
                    "support: length = None, must be given for a bonded or seated support, or with "
                    "friction or a strip; give a length"
                )
            return self._line(at, inwards, pinned)
        edges = edges_of(length)
        into = np.array(inwards) if any(inwards) else inwards_at(specimen, at)
        layer = strip_of("support", strip)
        patch = patch_around(specimen, at, edges, into)
        return self._patch("support", patch, friction, bonded, layer, seated, at)

    def platen(
        self,
        side: int,
        *,
        friction: float = 0.0,
        bonded: bool = False,
        strip: float | None = None,
        seated: bool = False,
    ) -> Part:
        """Add a plate along an entire flat side.

        Args:
            side: Index of the side: 0 bottom, 1 right, 2 top, 3 left, 4 front, 5 back.
            friction: Friction coefficient [-].
            bonded: Also transmit tension. A bonded plate slides freely along itself.
            strip: As for `support` [Pa/m].
            seated: As for `support`.

        Returns:
            The plate.

        Raises:
            InputError: for a side that is not flat, does not exist, or has another part on it.
        """
        seated = require_flag("platen: seated", seated)
        patch = side_patch(self._specimen, require_whole("platen: side", side))
        friction = require_number("platen: friction", friction, NOT_NEGATIVE)
        bonded = require_flag("platen: bonded", bonded)
        return self._patch("platen", patch, friction, bonded, strip_of("platen", strip), seated)

    def jaw(
        self,
        position: Place,
        radius: float,
        *,
        angle: float | None = None,
        friction: float = 0.0,
        strip: float | None = None,
    ) -> Part:
        """Add a curved jaw across a disc's depth; `contact_angle_of` records its angle.

        Args:
            position: x, y and z of the middle of the jaw on the lateral surface, within 5 % of the
                disc's radius [m]; y is ignored.
            radius: Radius of the arc [m], at least the radius of the disc; the ISRM suggests 1.5
                times the radius of the disc.
            angle: Angle of the disc that the jaw can cover [rad], at most and by default 2 pi / 3.
                It is required for a jaw with the radius of the disc.
            friction: Friction coefficient [-]. Between two smooth jaws a disc is free to rotate,
                and no loading can begin.
            strip: As for `support` [Pa/m].

        Returns:
            The plate.

        Raises:
            InputError: for a specimen that is not a disc, a position off the rim or on
                another part, a radius below the radius of the disc, or an angle that is out of
                range or missing.
        """
        if self._specimen.kind != "solid-disc":
            raise InputError("jaw: the specimen is not a disc; use support() for other shapes")
        x, y, z = require_vector("jaw: position", position, axes=SPACE)
        rim = 0.5 * self._specimen.dimensions["diameter"]
        jaw = Jaw.of((x, z), (0.0, 0.0), rim, radius, angle)
        values = (
            (jaw.towards[0], 0.0, jaw.towards[1]),
            jaw.radius / rim,
            jaw.angle,
            require_number("jaw: friction", friction, NOT_NEGATIVE),
            strip_of("jaw", strip),
        )
        part = self._plate(
            "jaw",
            lambda: self._solid.findJaw(*values),
            lambda: self._solid.layJaw(*values),
            (x, y, z),
        )
        self._traces[part.number] = jaw.trace(rim)
        return part

    def _line(self, at: Vector, inwards: Vector, pinned: bool) -> Part:
        """Add a roller, or a line at the top: deviation D99."""
        given, upwards = any(inwards), inwards[2]
        low, high = box_around(self._specimen)
        if given and not abs(upwards) > _UPRIGHT:
            raise InputError(
                "support: normal is not along z, which a line support without length needs; give a "
                "length"
            )
        above = upwards if given else 0.5 * (low[2] + high[2]) - at[2]
        side = BOTTOM if above > 0.0 else TOP
        width = _WIDTH * self._specimen.mean_diameter
        values = (side, at[0], at[2], width, pinned)
        place = (at[0], 0.5 * (low[1] + high[1]), at[2])
        edges = np.array([width, high[1] - low[1], width])
        return self._lay(
            "support",
            lambda: self._solid.findLine(*values),
            lambda: self._solid.layLine(*values),
            patch_around(self._specimen, place, edges, np.array(INWARDS[side])),
            at,
        )

    def _patch(
        self,
        kind: str,
        patch: Patch,
        friction: float,
        bonded: bool,
        strip: float,
        seated: bool,
        requested: Vector | None = None,
    ) -> Part:
        values = (patch.normal, patch.low, patch.high, friction, bonded, strip, seated)
        return self._lay(
            kind,
            lambda: self._solid.findPatch(*values),
            lambda: self._solid.layPatch(*values),
            patch,
            requested,
        )

    def _lay(
        self,
        kind: str,
        find: Callable[[], int],
        lay: Callable[[], int],
        patch: Patch,
        requested: Vector | None,
    ) -> Part:
        """Add a plate on a patch that no other plate covers, or raise InputError."""
        for number, there in self._patches.items():
            if patch.overlaps(there):
                other = Part(self, self.built.solver, "plate", number)
                raise InputError(f"{kind}: overlaps {other}; choose another position")
        part = self._plate(kind, find, lay, requested)
        self._patches[part.number], self._traces[part.number] = patch, patch.trace
        return part

    @property
    def _specimen(self) -> SolidSpecimen:
        specimen: object = self.built.specimen
        assert isinstance(specimen, SolidSpecimen)
        return specimen
