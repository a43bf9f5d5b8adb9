# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact laws of YADE's own bonded models: differences of the bond rule. SI units.

``Jcfpm`` and ``Cohfrict`` differ in their classes, in how the strength of a bond is set, and in how
a broken bond is detected. All other parts of the models are equal, see ``spheres``.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from yade import log, wrapper

from ..arrays import FloatArray
from ..materials.material import Law
from ..specimens.specimen import AnySpecimen
from .sphere_bonds import Bonds, in_order, separate_radii

#: Plates are this much stiffer than spheres, so that a sphere's own stiffness rules [-].
_PLATE_STIFFNESS = 1e3


@dataclass(frozen=True)
class Functors:
    """Functors of an interaction loop."""

    spheres: wrapper.Functor  #: geometry of two spheres
    plates: wrapper.Functor  #: geometry of a plate and a sphere
    physics: wrapper.Functor
    law: wrapper.Functor


class SphereLaw(ABC):
    """Differences between the models of bonded spheres."""

    name: ClassVar[str]
    bending: ClassVar[bool]  #: whether bonds resist bending

    @abstractmethod
    def radii(self, specimen: AnySpecimen) -> FloatArray:
        """Radii of the spheres [m]."""

    @abstractmethod
    def functors(self) -> Functors:
        """New functors for an interaction loop."""

    @abstractmethod
    def materials(self, law: Law, young: float) -> tuple[wrapper.Material, wrapper.Material]:
        """Materials of spheres and of plates.

        Args:
            law: Effective parameters of the material.
            young: Stiffness of new contacts over the mean radius [Pa].
        """

    @abstractmethod
    def set_bonding(self, physics: wrapper.Functor, on: bool) -> None:
        """Set whether contacts that appear from now on are bonds."""

    @abstractmethod
    def set_strength(self, bond: wrapper.IPhys, bonds: Bonds, row: int) -> None:
        """Give a bond the strength of its row."""

    @abstractmethod
    def set_rest(self, contact: wrapper.Interaction, overlap: float) -> None:
        """Set the overlap at which a contact carries no force [m]."""

    @abstractmethod
    def may_have_broken(self, law: wrapper.Functor, known: int) -> bool:
        """Return whether there may be more broken bonds than the `known` bonds."""

    @abstractmethod
    def has_broken(self, bond: wrapper.IPhys, place: wrapper.IGeom) -> bool:
        """Tell whether the law has broken a bond.

        Args:
            bond: Properties of the contact, kept since its creation.
            place: Geometry of the contact at its last step.
        """

    @abstractmethod
    def is_bond(self, contact: wrapper.IPhys) -> bool:
        """Return whether the properties of a contact belong to an intact bond."""

    @abstractmethod
    def is_tensile(self, bond: wrapper.IPhys, tension: float, bonds: Bonds, row: int) -> bool:
        """Return whether a broken bond broke in tension rather than in shear.

        Args:
            bond: Its properties.
            tension: Last force of the bond, positive in tension [N].
            bonds: Properties of all bonds.
            row: Row of the bond.
        """

    @abstractmethod
    def elastic_energy(
        self,
        law: wrapper.Functor,
        bonds: Sequence[wrapper.IPhys],
        touching: Sequence[wrapper.IPhys],
    ) -> float:
        """Elastic energy [J].

        Args:
            law: Functor of the law.
            bonds: Properties of the contacts that bonded pairs have.
            touching: Properties of the contacts with plates.
        """


class Jcfpm(SphereLaw):
    """JCFpm: whole bonds count in the energy; the law counts its cracks itself."""

    name = "jcfpm"
    bending = False

    def radii(self, specimen: AnySpecimen) -> FloatArray:
        """Radii of the discs [m]."""
        return specimen.radii

    def functors(self) -> Functors:
        """New functors for an interaction loop."""
        return Functors(
            wrapper.Ig2_Sphere_Sphere_ScGeom(),
            wrapper.Ig2_Box_Sphere_ScGeom(),
            wrapper.Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(),
            wrapper.Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(),
        )

    def materials(self, law: Law, young: float) -> tuple[wrapper.Material, wrapper.Material]:
        """Materials of spheres and of plates."""
        sphere, plate = _common(law, young)
        strengths = {"tensileStrength": law["tensile_strength"], "cohesion": law["cohesion"]}
        return (
            wrapper.JCFpmMat(type=0, label="flexpm-jcfpm", **sphere, **strengths),
            wrapper.JCFpmMat(type=1, label="flexpm-jcfpm-plate", **plate),
        )

    def set_bonding(self, physics: wrapper.Functor, on: bool) -> None:
        """Set whether contacts that appear from now on are bonds."""
        physics.cohesiveTresholdIteration = -1 if on else 0

    def set_strength(self, bond: wrapper.IPhys, bonds: Bonds, row: int) -> None:
        """Give a bond the strength of its row."""
        bond.crossSection = float(bonds.areas[row])
        bond.FnMax = float(bonds.tensile_strength[row])
        bond.FsMax = float(bonds.shear_strength[row])
        bond.tanFrictionAngle = _friction(bonds, row)

    def set_rest(self, contact: wrapper.Interaction, overlap: float) -> None:
        """Set the overlap at which a contact carries no force [m]."""
        contact.phys.initD = overlap

    def may_have_broken(self, law: wrapper.Functor, known: int) -> bool:
        """Compare with the cracks that the law has counted."""
        return bool(law.nbTensCracks + law.nbShearCracks != known)

    def has_broken(self, bond: wrapper.IPhys, place: wrapper.IGeom) -> bool:
        """Return whether the law has broken a bond."""
        return bool(bond.isBroken)

    def is_bond(self, contact: wrapper.IPhys) -> bool:
        """Return whether a contact is bonded."""
        return bool(contact.isCohesive)

    def is_tensile(self, bond: wrapper.IPhys, tension: float, bonds: Bonds, row: int) -> bool:
        """Return whether the bond was opened beyond its tensile limit."""
        limit = bonds.tensile_strength[row] / bonds.normal_stiffness[row]
        return bool(bond.crackJointAperture > limit)

    def elastic_energy(
        self,
        law: wrapper.Functor,
        bonds: Sequence[wrapper.IPhys],
        touching: Sequence[wrapper.IPhys],
    ) -> float:
        """Elastic energy of unbroken bonds and of contacts with plates [J]."""
        whole = [bond for bond in bonds if bond.isCohesive]
        return in_order(bond.strainEnergy for bond in (*whole, *touching))


class Cohfrict(SphereLaw):
    """CohFrict: bonds that also bend; discs are shrunk until none overlap."""

    name = "cohfrict"
    bending = True

    def radii(self, specimen: AnySpecimen) -> FloatArray:
        """Radii of the discs, shrunk until no two overlap [m]."""
        return separate_radii(specimen)

    def functors(self) -> Functors:
        """New functors for an interaction loop."""
        # newer releases of YADE warn of bonds that break in shear and have elastic moments
        log.setLevel("Law2_ScGeom6D_CohFrictPhys_CohesionMoment", log.ERROR)
        return Functors(
            wrapper.Ig2_Sphere_Sphere_ScGeom6D(),
            wrapper.Ig2_Box_Sphere_ScGeom6D(),
            wrapper.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(),
            wrapper.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(),
        )

    def materials(self, law: Law, young: float) -> tuple[wrapper.Material, wrapper.Material]:
        """Materials of spheres and of plates."""
        sphere, plate = _common(law, young)
        strengths = {"normalCohesion": law["tensile_strength"], "shearCohesion": law["cohesion"]}
        moments = {"momentRotationLaw": True, "etaRoll": -1.0, "etaTwist": -1.0}
        return (
            wrapper.CohFrictMat(label="flexpm-cohfrict", **sphere, **strengths, **moments),
            wrapper.CohFrictMat(label="flexpm-cohfrict-plate", isCohesive=False, **plate),
        )

    def set_bonding(self, physics: wrapper.Functor, on: bool) -> None:
        """Set whether contacts that appear from now on are bonds."""
        physics.setCohesionOnNewContacts = on

    def set_strength(self, bond: wrapper.IPhys, bonds: Bonds, row: int) -> None:
        """Give a bond the strength of its row."""
        bond.kr = float(bonds.bending_stiffness[row])
        bond.ktw = float(bonds.twisting_stiffness[row])
        bond.normalAdhesion = float(bonds.tensile_strength[row])
        bond.shearAdhesion = float(bonds.shear_strength[row])
        bond.tangensOfFrictionAngle = _friction(bonds, row)
        # newer releases of YADE also break bonds by moments; limits below zero: elastic ones
        for limit in ("rollingAdhesion", "twistingAdhesion"):
            if hasattr(bond, limit):
                setattr(bond, limit, -1.0)

    def set_rest(self, contact: wrapper.Interaction, overlap: float) -> None:
        """Set the overlap at which a contact carries no force [m]."""
        contact.phys.unp = overlap

    def may_have_broken(self, law: wrapper.Functor, known: int) -> bool:
        """Always true: the law does not count."""
        return True

    def has_broken(self, bond: wrapper.IPhys, place: wrapper.IGeom) -> bool:
        """Return whether the law has broken a bond."""
        # some versions of the law drop a bond in tension and leave only its geometry to tell
        tension = -bond.kn * (place.penetrationDepth - bond.unp)
        return bool(bond.cohesionBroken or tension > bond.normalAdhesion)

    def is_bond(self, contact: wrapper.IPhys) -> bool:
        """Return whether a contact is bonded."""
        return not contact.cohesionBroken  # new contacts have no cohesion to break

    def is_tensile(self, bond: wrapper.IPhys, tension: float, bonds: Bonds, row: int) -> bool:
        """Return whether the tension was closer to its limit than the shear force."""
        limit = bonds.shear_strength[row] - bond.tangensOfFrictionAngle * tension
        shear = bond.shearForce.norm() * bonds.tensile_strength[row]
        return bool(tension * max(limit, 0.0) > shear)

    def elastic_energy(
        self,
        law: wrapper.Functor,
        bonds: Sequence[wrapper.IPhys],
        touching: Sequence[wrapper.IPhys],
    ) -> float:
        """Elastic energy of all contacts [J]."""
        return float(law.elasticEnergy())


#: The laws by name of the model.
LAWS: dict[str, SphereLaw] = {law.name: law for law in (Jcfpm(), Cohfrict())}


def _friction(bonds: Bonds, row: int) -> float:
    """Friction of a bond to the bits that YADE takes from the angles of its spheres [-]."""
    return math.tan(math.atan(bonds.friction[row]))


def _common(law: Law, young: float) -> tuple[dict[str, float], dict[str, float]]:
    """Arguments of the materials of spheres and of plates, which have no friction."""
    common = {"young": young, "poisson": law["shear_ratio"], "density": law["density"]}
    plate = common | {"young": _PLATE_STIFFNESS * young, "frictionAngle": 0.0}
    return common | {"frictionAngle": math.atan(law["friction"])}, plate
