# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's own bonded models, JCFpm and CohFrict, on the discs and bonds of a specimen. SI units.

In 2D, spheres at the disc centres move in the plane and rotate about z; in 3D they move freely.
Each edge, or face, that two cells share is a bond whose stiffness and strength follow the rule of
``sphere_bonds``. If an interaction range is requested, each pair within it is also bonded. Spheres
that meet later have friction only. As in the other models, masses are scaled for a time step of 1
unless the model is dynamic.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import yade
from yade import utils, wrapper

from .._flexpm import mass_margin, set_engines
from ..arrays import FloatArray, IntArray
from ..dimensions import is_solid
from ..errors import InputError
from ..files import Table
from ..materials.material import Material
from ..materials.material import load as load_material
from ..require import require_one_of
from ..results.solids.state import AnySnapshot
from ..specimens.mineral_map import describe
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import AnySpecimen
from ..threads import limited
from .collider import collider
from .options import SPHERE_MODELS
from .sphere_bonds import Bonds, Laws, bonds_of, laws_of, touched_bounds
from .sphere_cracks import CrackWatch, body_with
from .sphere_laws import LAWS, SphereLaw
from .sphere_snapshot import snapshot
from .sphere_solids import solid_snapshot

#: Tag of the scene that holds what YADE does not save.
_MEMORY = "flexpm"


@dataclass
class SphereModel:
    """A specimen of YADE's bonded spheres in YADE's scene.

    Attributes:
        specimen: The grains.
        material: Their material.
        kind: Differences of its contact law.
        laws: Effective parameters of its minerals and of their pairs.
        bonds: Properties of the bonds.
        law: The contact law's functor.
        engines: All engines of the model.
        plate_material: Id of the material of plates.
        ids: Body of each grain.
        cracks: Broken bonds.
        plates: Bodies of the plates.
        loads: Permanent force and moment on bodies, see :meth:`load`.
        memory: Plain values of a test that are saved with the scene.
        threads: Number of threads of a step, see :meth:`set_threads`.
        dynamic: Whether masses are real and the time step is in seconds.
    """

    specimen: AnySpecimen
    material: Material
    kind: SphereLaw
    laws: Laws
    bonds: Bonds
    law: wrapper.Functor
    engines: list[wrapper.Engine]
    plate_material: int
    ids: list[int]
    cracks: CrackWatch = field(init=False)
    plates: list[int] = field(default_factory=list)
    loads: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    memory: Table = field(default_factory=dict)
    threads: int = 1
    dynamic: bool = False

    def __post_init__(self) -> None:
        made = _make_bonds(self)
        self.cracks = CrackWatch(self.kind, self.law, made, self.bonds, self.ids)

    @property
    def name(self) -> str:
        """``jcfpm`` or ``cohfrict``."""
        return self.kind.name

    @property
    def minerals(self) -> IntArray | None:
        """Index of each grain's mineral; None without minerals."""
        return None if self.laws.are_alike else self.laws.minerals

    def run(self, steps: int) -> None:
        """Advance by `steps` and wait for the end."""
        with limited(self.threads):
            for _ in range(steps):
                yade.O.step()  # O.run steps in a thread of its own, which no limit reaches

    def load(self, body: int, x: float, y: float, moment: float) -> None:
        """Apply a force [N] and an in-plane moment [N m] to a body until they are set again."""
        self.loads[body] = (x, y, moment)
        yade.O.forces.setPermF(body, (x, y, 0.0))
        yade.O.forces.setPermT(body, (0.0, 0.0, moment))

    def remember(self) -> None:
        """Put all that YADE does not save into the scene, as one of its tags."""
        self.memory["loads"] = list(self.loads.items())
        self.memory["cracks"] = self.cracks.memory()
        yade.O.tags[_MEMORY] = json.dumps(self.memory)

    def rebind(self) -> None:
        """Take over a scene that has been loaded, which :meth:`remember` has prepared."""
        self.engines = list(yade.O.engines)
        self.law = _loop(self.engines).lawDispatcher.functors[0]
        bodies = yade.O.bodies
        self.plates = [body.id for body in bodies if isinstance(body.shape, wrapper.Box)]
        self.memory = json.loads(yade.O.tags[_MEMORY])
        for body, load in self.memory["loads"]:
            self.load(body, *load)
        self.cracks.rebind(self.law, _find_bonds(self))
        self.cracks.recall(self.memory["cracks"])

    @property
    def damping(self) -> float:
        """Local damping alpha [-]; at most the damping with which the specimen was built."""
        return float(_newton(self.engines).damping)

    @damping.setter
    def damping(self, value: float) -> None:
        _newton(self.engines).damping = value

    def set_threads(self, threads: int) -> None:
        """Threads of a step."""
        self.threads = threads
        for engine in self.engines:
            engine.ompThreads = threads

    def counts(self) -> dict[str, int]:
        """Numbers of grains and bonds that exist; there are no nodes and triangles."""
        self.cracks.look()
        self.cracks.look_for_erased()
        erased = self.cracks.erased
        return {"grains": int(self.cracks.alive.sum()), "contacts": int((~erased).sum())}

    def state_of(self, body: int) -> wrapper.State:
        """State of a grain's or a plate's body, for a test, which needs all of them.

        Raises:
            InputError: if a script has erased it.
        """
        found = body_with(body)
        if found is None:
            name = f"grain {self.ids.index(body)}" if body in self.ids else f"plate {body}"
            rule = "must exist for a test on YADE's spheres; erase bonds of grains instead"
            raise InputError(f"{name} = erased, {rule}")
        return found.state

    def states(self) -> list[wrapper.State]:
        """State of the body of each grain, see :meth:`state_of`."""
        return [self.state_of(body) for body in self.ids]

    def describe_material(self) -> Table:
        """Name and parameters of the material, of minerals also the area that they have."""
        found = describe(self.specimen, self.material, self.name, self.minerals)
        found.pop("joints", None)  # spheres have none
        return found

    @property
    def axis(self) -> int:
        """Index of the axis of the loading: y in 2D, z in 3D."""
        return self.specimen.centres.shape[1] - 1

    def snapshot(self) -> AnySnapshot:
        """The present state as plain arrays."""
        self.cracks.look()
        self.cracks.look_for_erased()
        # looked up anew: a pair that has parted and met again has another interaction
        state = (self.ids, self.bonds, self.cracks, _find_bonds(self), self.minerals)
        if isinstance(self.specimen, SolidSpecimen):
            return solid_snapshot(self.specimen, *state)
        return snapshot(self.specimen, *state)

    def add_plate(self, face: float, sense: int) -> int:
        """Put a fixed, frictionless plate across the axis next to the specimen.

        Args:
            face: Height of the face that touches the specimen [m].
            sense: 1 for a plate above the specimen, -1 for a plate below.

        Returns:
            Its body; set its velocity to move it.
        """
        across = self.specimen.centres.T[: self.axis]
        half_height = self.specimen.mean_diameter
        middle = [*(one.mean() for one in across), face + sense * half_height, 0.0]
        # twice the specimen's, for its bulging
        half = [*(np.ptp(one) for one in across), half_height, half_height]
        plate = utils.box(
            tuple(middle[:3]),
            tuple(half[:3]),
            material=yade.O.materials[self.plate_material],
            fixed=True,
        )
        plate.state.isDamped = False  # else YADE counts a part of its work as damped
        self.plates.append(yade.O.bodies.append(plate))
        return self.plates[-1]

    def touch(self, plate: int, tributary: Mapping[int, float]) -> None:
        """Make grains touch a plate without force from the start, at any distance.

        Args:
            plate: Body of the plate.
            tributary: Length [m], in 3D area [m2], of the specimen's side that each grain carries.
        """
        stiffness = self.laws.of_grains("normal_stiffness")
        stiffness = stiffness * self.specimen.side_depth
        for grain, length in tributary.items():
            contact = utils.createInteraction(plate, self.ids[grain])
            contact.phys.kn = float(stiffness[grain]) * length
            self.kind.set_rest(contact, contact.geom.penetrationDepth)

    def press(self, plate: int, pressure: float) -> None:
        """Shift rest positions of contacts so that a plate carries a pressure [Pa] immediately.

        A step must have been done since :meth:`touch`: in its first step JCFpm finds the rest
        position of a contact itself.
        """
        overlaps = pressure / self.laws.of_grains("normal_stiffness")
        grains = {body: grain for grain, body in enumerate(self.ids)}
        for contact in yade.O.interactions.withBody(plate):
            if contact.isReal:
                grain = next(grains[one] for one in (contact.id1, contact.id2) if one in grains)
                overlap = float(overlaps[grain])
                self.kind.set_rest(contact, contact.geom.penetrationDepth - overlap)

    def elastic_energy(self) -> float:
        """Elastic energy of unbroken bonds and plates (JCFpm) or of all contacts (CohFrict) [J]."""
        bonds = [one.phys for one in self.cracks.interactions if one is not None and one.isReal]
        touching = [
            contact.phys
            for plate in self.plates
            for contact in yade.O.interactions.withBody(plate)
            if contact.isReal
        ]
        return self.kind.elastic_energy(self.law, bonds, touching)


def build(
    specimen: AnySpecimen,
    material: Material | str | None,
    model: str,
    *,
    damping: float,
    dynamic: bool = False,
    interaction_range: float | None = None,
    threads: int = 1,
) -> SphereModel:
    """Put a specimen into YADE's scene as bonded spheres.

    Args:
        specimen: The grains.
        material: Preset, file, or material; its rigid elastic set and its strengths are used.
        model: ``jcfpm`` or ``cohfrict``.
        damping: Local damping alpha [-].
        dynamic: Real masses and a time step in seconds instead of scaled masses and unit steps.
        interaction_range: Largest ratio of distance to sum of radii at which discs are bonded [-];
            None: only discs whose cells share an edge.
        threads: Threads of YADE's engines.

    Returns:
        The model; ``yade.O`` holds its bodies and engines.

    Raises:
        InputError: for an unknown model, a material without a required value, or grains without
            bonds.
    """
    require_one_of("build: model", model, SPHERE_MODELS)
    chosen = load_material(material, model, solid=is_solid(specimen.kind))
    laws, kind = laws_of(specimen, chosen, model), LAWS[model]
    bonds, radii = bonds_of(specimen, laws, interaction_range), kind.radii(specimen)
    if not len(bonds.areas):
        raise InputError(
            f"bonds = none among {len(radii)} grains, {kind.name} takes its stiffness from bonds; "
            "use smaller grains or model 'flexible'"
        )
    spheres, plate_material = _add_materials(kind, laws, bonds, radii)
    rows = zip(specimen.centres.tolist(), radii.tolist(), laws.minerals.tolist(), strict=True)
    ids = [
        yade.O.bodies.append(utils.sphere((*place, 0.0)[:3], radius, material=spheres[mineral]))
        for place, radius, mineral in rows
    ]
    stiffness = laws.of_grains("normal_stiffness")
    bounds = touched_bounds(specimen, radii, bonds, stiffness, kind.bending)
    factor = mass_margin * (1.0 + damping) / 4.0
    masses, inertias = factor * bounds[0], factor * bounds[1]
    yade.O.dt = 1.0
    real_masses = False
    if dynamic:
        real_masses = True
        real = _real_masses(specimen, laws.of_grains("density"))
        yade.O.dt = math.sqrt(float(min(np.min(real[0] / masses), np.min(real[1] / inertias))))
        masses, inertias = real
    _set_masses(ids, masses, inertias, "" if is_solid(specimen.kind) else "zXY")
    functor, engines = _engines(specimen, kind, damping)
    set_engines(engines)
    built = SphereModel(specimen, chosen, kind, laws, bonds, functor, engines, plate_material, ids)
    built.dynamic = real_masses
    built.set_threads(threads)
    return built


def _add_materials(
    kind: SphereLaw, laws: Laws, bonds: Bonds, radii: FloatArray
) -> tuple[list[wrapper.Material], int]:
    """Add YADE's materials of new contacts, which are as stiff as the mean bond of their mineral.

    Returns:
        Material of the spheres of each mineral, and the id of the material of plates.
    """
    radius = float(np.mean(radii))
    made = [
        kind.materials(law, float(np.mean(law["normal_stiffness"] * bonds.areas)) / radius)
        for law in laws.grains
    ]
    spheres = [sphere for sphere, _ in made]
    if not laws.are_alike:
        for number, sphere in enumerate(spheres):
            sphere.label += f"-{number}"
    for sphere in spheres:
        yade.O.materials.append(sphere)
    plate = max((plate for _, plate in made), key=lambda one: one.young)
    return spheres, yade.O.materials.append(plate)


def _real_masses(specimen: AnySpecimen, density: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Masses [kg] of the cells, and moments of inertia [kg m2] of discs of the cells' areas."""
    areas = np.array(specimen.cell_sizes)
    masses = density * areas * specimen.thickness
    return masses, 0.5 * masses * areas / math.pi


def _set_masses(ids: list[int], masses: FloatArray, inertias: FloatArray, blocked: str) -> None:
    for body, mass, inertia in zip(ids, masses.tolist(), inertias.tolist(), strict=True):
        state = yade.O.bodies[body].state
        state.mass, state.inertia = mass, (inertia, inertia, inertia)
        state.blockedDOFs = blocked


def _engines(
    specimen: AnySpecimen, kind: SphereLaw, damping: float
) -> tuple[wrapper.Functor, list[wrapper.Engine]]:
    functors = kind.functors()
    # shear displacements then have the levers that the moments have; else YADE scales them by the
    # sum of the radii over the distance, and the bond's shear stiffness with them
    functors.spheres.avoidGranularRatcheting = False
    bounds = [wrapper.Bo1_Sphere_Aabb(), wrapper.Bo1_Box_Aabb()]
    geometries = [functors.spheres, functors.plates]
    loop = wrapper.InteractionLoop(geometries, [functors.physics], [functors.law])
    newton = wrapper.NewtonIntegrator(damping=damping)
    finder = collider(bounds, specimen.mean_diameter)
    return functors.law, [wrapper.ForceResetter(), finder, loop, newton]


def _loop(engines: list[wrapper.Engine]) -> wrapper.InteractionLoop:
    """The engine that holds the functors."""
    return next(engine for engine in engines if isinstance(engine, wrapper.InteractionLoop))


def _newton(engines: list[wrapper.Engine]) -> wrapper.NewtonIntegrator:
    """The engine that moves the spheres."""
    return next(engine for engine in engines if isinstance(engine, wrapper.NewtonIntegrator))


def _make_bonds(built: SphereModel) -> list[wrapper.Interaction]:
    """Make an interaction of each bond, also where its spheres do not touch."""
    made = []
    physics = _loop(built.engines).physDispatcher.functors[0]
    built.kind.set_bonding(physics, True)
    for row, (first, second) in enumerate(built.bonds.grains.tolist()):
        contact = utils.createInteraction(built.ids[first], built.ids[second])
        bond = contact.phys
        bond.kn = float(built.bonds.normal_stiffness[row])
        bond.ks = float(built.bonds.shear_stiffness[row])
        built.kind.set_strength(bond, built.bonds, row)
        built.kind.set_rest(contact, contact.geom.penetrationDepth)
        made.append(contact)
    built.kind.set_bonding(physics, False)
    return made


def _find_bonds(built: SphereModel) -> list[wrapper.Interaction | None]:
    """Return the present interaction of each bonded pair; None without an interaction."""
    found = {(one.id1, one.id2): one for one in yade.O.interactions}
    pairs = np.array(built.ids)[built.bonds.grains].tolist()
    return [found.get((a, b), found.get((b, a))) for a, b in pairs]
