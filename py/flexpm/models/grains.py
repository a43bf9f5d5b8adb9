# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of a specimen: bodies and engines in YADE's scene, paper Sec. 2. SI units.

With scaled masses (the default) time is counted in steps: the time step is 1, and velocities are
metres per step. Only slow loading is meaningful then.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar, Unpack, cast

import numpy as np
import yade
from yade import wrapper

from .._flexpm import set_engines
from ..arrays import IntArray
from ..dimensions import is_solid, refused
from ..errors import InputError, SimulationError
from ..files import Table
from ..materials.material import Material
from ..materials.material import load as load_material
from ..renamed import with_old_names
from ..require import require_one_of, require_threads
from ..results.snapshot import Snapshot
from ..results.solids.pairs import PressingPairs
from ..results.solids.state import AnySnapshot, SolidSnapshot
from ..results.stress.point_stress import OF_GRAINS, OF_TRIANGLES
from ..specimens import mineral_map
from ..specimens.space.specimen import SolidSpecimen
from ..specimens.specimen import AnySpecimen, Specimen, require_specimen
from ..threads import limited
from . import spheres
from .assembly import assembled, constants, fitted, grains_of
from .collider import collider
from .options import (
    GRAIN_MODELS,
    MESHES,
    POINTS,
    SPHERE_MODELS,
    Motion,
    check_options,
    local_damping,
    motion_of,
)
from .solids import elastic_of_solid, snapshot_of, solver_of

Engine = TypeVar("Engine", bound=wrapper.Engine)


@with_old_names
@dataclass
class Model:
    """A specimen in YADE's scene; made by :func:`flexpm.build`.

    Attributes:
        specimen: The bonded grains.
        material: Material of the grains.
        name: Name of the model.
        solver: Engine that stores the grains and advances them.
        engines: All engines of the model, including ``solver``.
        dynamic: Whether masses are real and the time step is in seconds; False: scaled masses and
            unit steps.
        minerals: Index of each grain's mineral, (G,); None: all grains have the same material.
        gravity: Downward acceleration [m/s2]; with real masses only.
        points: Number of contact points per contact.
        mesh: Mesh of each grain, ``refined`` or ``fan``.

    Example:
        >>> model = flexpm.build(specimen)
        >>> model.run(10)
        >>> model.counts()["grains"], model.threads
        (37, 1)
    """

    specimen: Specimen
    material: Material
    name: str
    solver: wrapper.GrainSolver
    engines: list[wrapper.Engine]
    dynamic: bool = False
    minerals: IntArray | None = None
    gravity: float = 0.0
    points: int = POINTS[-1]
    mesh: str = MESHES[0]

    def set_masses(self) -> None:
        """Scale the masses, or set real masses and their stable time step, before the first step.

        Call it again after plates have been added or ends have been fixed.
        """
        if self.dynamic:
            yade.O.dt = self.solver.useRealMasses()
            self.pull_down()
        else:
            yade.O.dt = 1.0
            self.solver.scaleMasses()

    def pull_down(self, part: float = 1.0) -> None:
        """Apply a share of the weight [-], against the last axis."""
        pull = -part * self.gravity
        solid = is_solid(self.specimen.kind)
        self.solver.gravity = (0.0, 0.0, pull) if solid else (0.0, pull, 0.0)

    def run(self, steps: int) -> None:
        """Advance the scene by `steps`.

        Args:
            steps: Number of steps.

        Raises:
            RuntimeError: if a number is no longer finite, or the scene no longer has the model.
        """
        if self.solver not in yade.O.engines:
            raise SimulationError(
                "Model: its solver in O.engines = none, must be there; build the specimen again"
            )
        self.solver.stepsToCome = steps
        try:
            with limited(self.threads):
                for _ in range(steps):
                    yade.O.step()
        finally:
            self.solver.stepsToCome = 0

    def add_engines(
        self,
        *,
        before: tuple[wrapper.Engine, ...] = (),
        after: tuple[wrapper.Engine, ...] = (),
        last: tuple[wrapper.Engine, ...] = (),
    ) -> None:
        """Insert engines of a protocol immediately before or after the solver's step, or last."""
        place = self.engines.index(self.solver)
        self.engines[place : place + 1] = [*before, self.solver, *after]
        self.engines += last
        set_engines(self.engines)

    def remove_engines(self, *engines: wrapper.Engine | None) -> None:
        """Remove engines of a protocol from the scene."""
        self.engines = [engine for engine in self.engines if engine not in engines]
        set_engines(self.engines)

    def engine(self, kind: type[Engine]) -> Engine | None:
        """Return the first engine of a class, or None."""
        return next((engine for engine in self.engines if isinstance(engine, kind)), None)

    def required(self, kind: type[Engine]) -> Engine:
        """Return the first engine of a class, which the scene must have."""
        return next(engine for engine in self.engines if isinstance(engine, kind))

    @property
    def damping(self) -> float:
        """Local damping alpha [-]; at most the damping with which the specimen was built."""
        return self.solver.damping

    @damping.setter
    def damping(self, value: float) -> None:
        self.solver.damping = value

    def set_threads(self, threads: int) -> None:
        """Set the number of threads of a step; results do not depend on it."""
        self.solver.ompThreads = threads

    @property
    def threads(self) -> int:
        """Number of threads of a step."""
        return int(self.solver.ompThreads)

    def rebind(self) -> None:
        """Use the engines of a scene that has been loaded."""
        self.engines = list(yade.O.engines)
        self.solver = self.required(wrapper.GrainSolver)

    def counts(self) -> dict[str, int]:
        """Return the numbers of grains, particles, contacts, nodes and triangles, by name.

        Example:
            >>> counts = flexpm.build(specimen).counts()
            >>> counts["grains"], counts["contacts"], counts["nodes"], counts["triangles"]
            (37, 85, 388, 508)
        """
        return self.solver.counts()

    def snapshot(self) -> AnySnapshot:
        """Return the present state as plain arrays, see `Snapshot`.

        Example:
            >>> state = flexpm.build(solid).snapshot()
            >>> state.fragments.grains.tolist()  # one fragment of all 44 grains
            [44]
        """
        found: Table = self.solver.snapshot()
        return Snapshot(**found, **self.of_snapshots(found["contact"]))

    def of_snapshots(self, contacts: IntArray) -> Table:
        """Return the data of a snapshot besides the solver's arrays.

        Args:
            contacts: Index of each contact.

        Returns:
            Minerals, the source of stresses, and the joints of the contacts.
        """
        source = OF_TRIANGLES if self.name == "flexible" else OF_GRAINS
        found: Table = {"grain_mineral": self.minerals, "stress_source": source}
        joints, spec = self.specimen.edge_joints, self.specimen.spec
        if joints is None:
            return found
        names = spec.joint_names or ()
        # lines of excavations are rock; contacts that came later have no joint
        with_law = np.array([*(name in spec.joints_with_law for name in names), False])
        known = np.append(np.where(with_law[joints], joints, -1), -1)
        rows = np.minimum(contacts, len(joints))
        found |= {"contact_joint": known[rows], "joint_names": names}
        return found | self._bonded_sizes(rows)

    def _bonded_sizes(self, rows: IntArray) -> Table:
        """Return the lengths of contacts when bonded, 0 for those that came later."""
        assert isinstance(self.specimen, Specimen)
        cells = self.specimen.tessellation
        sides = np.diff(cells.vertices[cells.shared_edges[:, 2:]], axis=1)[:, 0]
        return {"bonded_length": np.append(np.hypot(*sides.T), 0.0)[rows]}

    def describe_material(self) -> Table:
        """Return name and parameters of the material, with the area fraction of each mineral."""
        return mineral_map.describe(self.specimen, self.material, self.name, self.minerals)

    def parting(self, state: AnySnapshot) -> tuple[int | None, float]:
        """Detached grains, and the largest separation of neighbours, see `GrainSolver.parting`.

        The separation is the increase of the distance between two centres [mean diameters]. The
        caller passes the present state, because the state of a large 3D specimen takes gigabytes.
        """
        apart = state.parting
        if apart is not None:  # of a solid, whose contacts never end: no grain is known to be loose
            return None, apart / self.specimen.mean_diameter
        found = self.solver.parting()
        return found["loose"], found["any"] / self.specimen.mean_diameter

    @property
    def largest_overlap(self) -> float | None:
        """Deepest overlap of 3D grains, divided by the mean diameter [-]; None in 2D."""
        return None

    @property
    def largest_clearance(self) -> float | None:
        """Deepest overlap of 3D grains that no force resists, likewise [-]; None in 2D."""
        return None

    @property
    def joint_deviation(self) -> float | None:
        """Largest deviation of a load-carrying joint [m], see `Specimen.joint_deviations`."""
        bearing = {joint.name for joint in self.material.joints if not joint.open}
        bends = self.specimen.joint_deviations().items()
        return max((bend for name, bend in bends if name in bearing), default=None)


class SolidModel(Model):
    """A 3D specimen in YADE's scene, with the members that rigs require of a specimen."""

    @property
    def largest_overlap(self) -> float | None:
        """Ratio of the deepest overlap of grains to the mean diameter [-]."""
        return float(self.solver.overlaps()["of_diameter"])

    @property
    def largest_clearance(self) -> float | None:
        """Ratio of the deepest overlap that no force resists to the mean diameter [-]."""
        return float(self.solver.overlaps()["clearance"])

    def snapshot(self) -> SolidSnapshot:
        """Return the present state as plain arrays."""
        pairs = PressingPairs.of(self.solver.pairs())
        return replace(self.state_of(self.solver.snapshot()), pairs=pairs)

    def state_of(self, found: Table) -> SolidSnapshot:
        """Return a state of this 3D specimen, from its arrays."""
        return snapshot_of(found, self.of_snapshots(np.arange(len(found["contact_grains"]))))

    def _bonded_sizes(self, rows: IntArray) -> Table:
        """Return nothing: the solver's arrays have the areas."""
        return {}


def _build_solid(
    specimen: SolidSpecimen,
    chosen: Material,
    model: str,
    damping: float,
    *,
    dynamic: bool,
    gravity: float,
    bonded: bool,
) -> Model:
    solver = solver_of(specimen, chosen, model)
    solver.damping = damping
    if not bonded:
        solver.takeBonds()
    engines = _in_scene(solver, specimen.mean_diameter)
    kinds = mineral_map.minerals_of(specimen, chosen)
    built = SolidModel(
        *(cast(Specimen, specimen), chosen, model, solver, engines, dynamic, kinds, gravity)
    )
    built.set_masses()
    return built


def build(
    specimen: AnySpecimen,
    material: Material | str | None = None,
    model: str = "flexible",
    *,
    points: int = 3,
    mesh: str = "refined",
    interaction_range: float | None = None,
    bonded: bool = True,
    threads: int = 1,
    **motion: Unpack[Motion],
) -> Model | spheres.SphereModel:
    """Put a specimen into YADE's scene: bodies of grains, interactions of bonds, and engines.

    Bodies that the scene already has are kept; its engines are replaced.

    Args:
        specimen: The grains. A 3D specimen takes ``flexible`` or ``rigid`` grains, or YADE's
            spheres.
        material: Name of a preset, TOML file, or material; None: the default of model and
            dimension.
        model: ``flexible``, ``rigid``, ``inner``, ``inner-un``, or YADE's own ``jcfpm`` or
            ``cohfrict``.
        points: Contact points per contact, 1, 2 or 3 (Lobatto); inner particles have 1.
        mesh: ``refined`` or ``fan`` (triangles of corners and centre only).
        interaction_range: For ``jcfpm`` and ``cohfrict``, the largest ratio of the distance of two
            disc centres to the sum of their radii at which the discs are bonded, 1 to 2 [-]
            (deviation D61). None: only discs whose cells share an edge are bonded.
        bonded: False: the grains fit together without bonds. They press on each other and slide
            with the friction of the material, as after cracking. ``flexible`` or ``rigid`` only.
        threads: Number of threads of a step; results do not depend on it.
        motion: Options of the motion, by these names:

            - ``damping``: local damping alpha [-], 0 <= alpha < 1; None, the default: 0.7 with
              scaled masses, 0 with real masses. A grain in free fall under gravity g accelerates
              with (1 - alpha) g.
            - ``dynamic``: real masses and a time step in seconds instead of scaled masses and unit
              steps. Default: False.
            - ``gravity``: downward acceleration [m/s2]. Default: 0; other values need ``dynamic``.

    Returns:
        The model; ``yade.O`` holds its bodies and engines.

    Raises:
        InputError: for an argument or a material property out of range.

    Example:
        >>> model = flexpm.build(specimen, model="rigid")
        >>> from yade import O
        >>> len(O.bodies) == model.counts()["grains"] == 37
        True
    """
    damping, dynamic, gravity = motion_of(motion)
    check_options(
        model,
        points=points,
        mesh=mesh,
        dynamic=dynamic,
        gravity=gravity,
        interaction_range=interaction_range,
        bonded=bonded,
    )
    points = int(points)  # numpy's integers are no integers for the kernel
    damping = local_damping(damping, dynamic=dynamic)
    threads = require_threads("build: threads", threads)
    require_specimen("build", specimen)
    if is_solid(specimen.kind):
        _refuse_plane("build", points=points, mesh=mesh)
        if dynamic and model in SPHERE_MODELS:
            raise InputError(
                f"build: dynamic = True, must be False for {model} grains in 3D; use flexible or "
                "rigid grains"
            )
    if model in SPHERE_MODELS:
        specimen.spec.require_discs(model)
        return spheres.build(
            specimen,
            material,
            model,
            damping=damping,
            dynamic=dynamic,
            interaction_range=interaction_range,
            threads=threads,
        )
    _refuse_second()
    if isinstance(specimen, SolidSpecimen):
        chosen = load_material(material, model, solid=True)
        built = _build_solid(
            specimen, chosen, model, damping, dynamic=dynamic, gravity=gravity, bonded=bonded
        )
        built.set_threads(threads)
        return built
    grains = grains_of(specimen, model, points, mesh)
    chosen = fitted(specimen, grains, load_material(material, model), model)
    solver = assembled(grains, chosen)
    solver.damping = damping
    if not bonded:
        solver.takeBonds()
    engines = _in_scene(solver, 2.0 * float(np.mean(grains.discs[:, 2])))
    kinds = mineral_map.minerals_of(specimen, chosen)
    built = Model(
        *(specimen, chosen, model, solver, engines, dynamic, kinds, gravity),
        points=grains.points,
        mesh=mesh,
    )
    built.set_threads(threads)
    built.set_masses()
    return built


def elastic(
    specimen: AnySpecimen,
    material: Material | str | None = None,
    model: str = "flexible",
    *,
    points: int = 3,
    mesh: str = "refined",
) -> dict[str, float]:
    """Compute the elastic constants of a specimen by one static solution, without a simulation.

    Args:
        specimen: A rectangle; or a box or a cylinder, which is pulled along z.
        material: Name of a preset, TOML file, or material; None: the default of model and
            dimension.
        model: ``flexible``, ``rigid``, ``inner`` or ``inner-un``; in 3D ``flexible`` or ``rigid``.
        points: Contact points per contact, 1, 2 or 3; inner particles have 1. In 2D only.
        mesh: ``refined`` or ``fan``. In 2D only.

    Returns:
        ``youngs_modulus`` [Pa], ``poissons_ratio`` [-] and the counts of the model.

    Raises:
        InputError: for an argument out of range, or a specimen that is not a rectangle, a box or a
            cylinder.
        SimulationError: if the forces of a 3D specimen do not reach equilibrium.

    Example:
        >>> found = flexpm.elastic(specimen)
        >>> print(f"E = {found['youngs_modulus'] / 1e9:.1f} GPa")
        E = 24.4 GPa
        >>> found = flexpm.elastic(solid)
        >>> print(f"nu = {found['poissons_ratio']:.2f}")
        nu = 0.23
    """
    require_one_of("build: model", model, GRAIN_MODELS)
    require_specimen("elastic", specimen)
    if isinstance(specimen, SolidSpecimen):
        _refuse_plane("elastic", points=points, mesh=mesh)
        return elastic_of_solid(specimen, load_material(material, model, solid=True), model)
    grains = grains_of(specimen, model, points, mesh)
    chosen = fitted(specimen, grains, load_material(material, model), model)
    solver = assembled(grains, chosen)
    modulus, ratio = constants(solver)
    return {"youngs_modulus": modulus, "poissons_ratio": ratio, **solver.counts()}


def _in_scene(solver: wrapper.GrainSolver, mean_diameter: float) -> list[wrapper.Engine]:
    """Add the bodies and bonds of a solver to the scene, and return its engines."""
    solver.addToScene()
    bounds = [wrapper.Bo1_LaguerreCell_Aabb()]
    engines = [collider(bounds, mean_diameter), solver, _idle_newton()]
    set_engines(engines)
    return engines


def _refuse_second() -> None:
    if any(isinstance(engine, wrapper.GrainSolver) for engine in yade.O.engines):
        raise InputError("build: the scene already has a GrainSolver; call O.reset()")


def _refuse_plane(call: str, **given: float | str) -> None:
    """Reject options that are available in 2D only for a 3D specimen."""
    usual = {"points": POINTS[-1], "mesh": MESHES[0]}
    for name, value in given.items():
        if value != usual[name]:
            shown = ", ".join(map(str, given.values()))
            asked = f"{call}: {', '.join(given)} = {shown}, must not be given for a 3D specimen"
            raise refused(asked, name)


def _idle_newton() -> wrapper.Engine:
    # The collider asks a NewtonIntegrator for the fastest motion. Grains are moved by the solver,
    # which calls the collider itself; a value between 0 and 1 keeps the collider idle until then.
    return wrapper.NewtonIntegrator(dead=True, maxVelocitySq=0.5, label="")
