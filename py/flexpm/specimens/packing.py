# SPDX-License-Identifier: GPL-3.0-or-later
"""Dense packings of discs, or of spheres, by YADE's engines, paper Sec. 3.1.

Discs are inserted at random with half their radius; then they take their radius and a cohesionless,
frictionless relaxation inside the outline shares the overlap out. Spheres do the same in space.
Lengths are scaled by the mean diameter, stiffness and mass are 1: a packing depends on shapes only,
not on the unit of length. YADE's collider finds pairs and its integrator moves discs; the forces
come from ``DiscLoop``, which gives the bits of YADE's interaction loop in a fraction of its time.

The relaxation has a scene of its own. YADE cannot delete a scene, so one (empty) scene is kept for
the next packing; bodies, engines, time and materials of the caller's ``O`` are not touched.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from yade import log, utils, wrapper

from .._flexpm import Outline, insert_discs, set_engines
from ..arrays import FloatArray, IntArray
from ..errors import SimulationError
from ..progress import Progress
from ..threads import limited

_SHRINK = 0.5  # radius at insertion, paper Sec. 3.1
_DAMPING = 0.4  # local damping [-]
_STIFFNESS = 0.5  # of every contact, so that large discs do not squeeze small ones out
_WALL_STIFFNESS = 1.0
_TIME_STEP = 0.6  # hexagonal packings of unit mass allow 2 / sqrt(6 k (1 + damping)) = 0.97
_START_TIME_STEP = 0.3  # while overlaps are large
_UNBALANCED = 0.01  # at rest: mean resultant over mean contact force [-]
_BATCH = 50  # steps between two checks
_EXPECTED_STEPS = 900
_MAX_STEPS = 50_000
_STRIP = 2.5  # height of the strips of the disc order, in mean diameters
_SCENE_TAG = "flexpm-packing"

_scene: int | None = None

F = TypeVar("F", bound="Container")


class Container(Protocol):
    """Container of a packing. Positions are rows x, y of discs, or x, y, z of spheres."""

    def scaled(self: F, factor: float) -> F:
        """Return the container with all lengths multiplied by ``factor``."""

    def insert(self, radii: FloatArray, shrink: float, seed: int) -> FloatArray:
        """Return random places at which shrunken discs or spheres do not overlap."""

    def walls(self, material: wrapper.Material) -> list[wrapper.Body]:
        """Make the bodies that hold discs or spheres inside."""

    def has_inside(self, place: FloatArray) -> bool:
        """Whether a place is inside."""


@dataclass(frozen=True)
class Frame:
    """Outline to fill: a rectangle from the origin, or a circle about it.

    Attributes:
        width: Width of the rectangle [m]; 0 for a circle.
        height: Height of the rectangle [m]; 0 for a circle.
        radius: Radius of the circle [m]; 0 for a rectangle.
    """

    width: float = 0.0
    height: float = 0.0
    radius: float = 0.0

    @property
    def area(self) -> float:
        """Within the outline [m2]."""
        return math.pi * self.radius**2 if self.radius else self.width * self.height

    def scaled(self, factor: float) -> Frame:
        """Return the frame with all lengths multiplied by ``factor``."""
        return Frame(self.width * factor, self.height * factor, self.radius * factor)

    def kernel_outline(self) -> Outline:
        """Return the outline as the kernel's object."""
        if self.radius > 0.0:
            return Outline.circle(0.0, 0.0, self.radius)
        w, h = self.width, self.height
        return Outline.polygon(np.array([[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]))

    def insert(self, radii: FloatArray, shrink: float, seed: int) -> FloatArray:
        """Return random places at which shrunken discs do not overlap, (n, 2) [m]."""
        return insert_discs(radii, self.kernel_outline(), shrink, seed)

    def walls(self, material: wrapper.Material) -> list[wrapper.Body]:
        """Make the bodies that hold discs inside."""
        if self.radius > 0.0:
            return _ring(self.radius, material)
        places = ((0.0, 0, 1), (self.width, 0, -1), (0.0, 1, 1), (self.height, 1, -1))
        return [
            utils.wall(place, axis, sense=sense, material=material) for place, axis, sense in places
        ]

    def has_inside(self, place: FloatArray) -> bool:
        """Whether a place x, y is inside."""
        return self.kernel_outline().contains(float(place[0]), float(place[1]))


def pack(
    frame: Container,
    radii: FloatArray,
    mean_diameter: float,
    seed: int,
    progress: Progress | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Pack discs or spheres into a frame; the same arguments give the same bits.

    Args:
        frame: Outline to fill.
        radii: Radii of the discs [m].
        mean_diameter: Unit of length of the relaxation [m].
        seed: Seed of the insertion.
        progress: Called with (steps done, steps expected, text).

    Returns:
        Centres, (n, 2) or (n, 3), and radii, (n,) [m], in an order in which neighbours in index are
        neighbours in space.

    Raises:
        InputError: if the discs do not fit at half radius.
        SimulationError: if the packing does not come to rest, or a disc leaves the frame.
    """
    unit_frame = frame.scaled(1.0 / mean_diameter)
    unit_radii = radii / mean_diameter
    centres = unit_frame.insert(unit_radii, _SHRINK, seed)
    order = spatial_order(centres, _STRIP)
    centres = _relax(unit_frame, centres[order], unit_radii[order], progress)
    radii = radii[order]
    order = spatial_order(centres, _STRIP)
    return centres[order] * mean_diameter, radii[order]


def spatial_order(centres: FloatArray, strip: float) -> IntArray:
    """Order points in horizontal strips, walked to the right and to the left in turn.

    In space, in horizontal layers of such strips.

    Args:
        centres: Points, (n, 2) or (n, 3) [m].
        strip: Height of a strip, and of a layer [m].

    Returns:
        Indices that sort the points.
    """
    row = np.floor((centres[:, 1] - centres[:, 1].min()) / strip).astype(int)
    along = np.where(row % 2 == 0, centres[:, 0], -centres[:, 0])
    keys = [centres[:, 1], along, row]
    if centres.shape[1] == 3:
        keys.append(np.floor((centres[:, 2] - centres[:, 2].min()) / strip).astype(int))
    order: IntArray = np.lexsort(keys)
    return order


def _relax(
    frame: Container, centres: FloatArray, radii: FloatArray, progress: Progress | None
) -> FloatArray:
    scene = wrapper.Omega()
    # with more threads contacts come in another order, and sums with them
    with limited(1), _private_scene(scene):
        loop = _fill_scene(scene, frame, centres, radii)
        _calm_start(scene)
        while True:
            _advance(scene, _BATCH - 1)
            loop.mirror = True  # for the look at the forces below
            _advance(scene, 1)
            loop.mirror = False
            if progress is not None:
                progress(scene.iter, max(_EXPECTED_STEPS, scene.iter), "packing")
            if _is_at_rest(scene):
                break
            if scene.iter > _MAX_STEPS:
                raise SimulationError(
                    f"packing: steps = {scene.iter}, must come to rest within {_MAX_STEPS}; "
                    "change the seed or raise the porosity"
                )
        relaxed = _positions(scene, len(radii))[:, : centres.shape[1]]
    _require_inside(frame, relaxed)
    return relaxed


@contextmanager
def _private_scene(scene: wrapper.Omega) -> Iterator[None]:
    """Switch to the scene for packings, and back at the end, also after an error."""
    if scene.running:
        raise SimulationError(
            "packing: O.running = True, must be stopped while a specimen is made; call O.pause()"
        )
    caller = scene.thisScene
    _enter_scene(scene, caller)
    try:
        scene.resetThisScene()
        yield
    finally:
        scene.resetThisScene()
        scene.tags[_SCENE_TAG] = "1"
        scene.switchToScene(caller)


def _enter_scene(scene: wrapper.Omega, caller: int) -> None:
    global _scene
    if _scene is not None and _scene != caller:
        _switch_quietly(scene, _scene)
        if scene.thisScene == _scene and scene.tags.has_key(_SCENE_TAG):
            return
        scene.switchToScene(caller)
    _scene = scene.addScene()
    scene.switchToScene(_scene)


def _switch_quietly(scene: wrapper.Omega, number: int) -> None:
    """Switch to a scene; if it is gone (the caller has reset all) YADE logs an error and stays."""
    before = log.getUsedLevels().get("Omega")
    log.setLevel("Omega", log.FATAL)
    try:
        scene.switchToScene(number)
    finally:
        if before is None:
            log.unsetLevel("Omega")
        else:
            log.setLevel("Omega", before)


def _fill_scene(
    scene: wrapper.Omega, frame: Container, centres: FloatArray, radii: FloatArray
) -> wrapper.DiscLoop:
    """Make bodies and engines for discs of unit mass; return the interaction loop."""
    grain, wall = (
        wrapper.FrictMat(young=1.0, poisson=0.3, frictionAngle=0.0, density=1.0) for _ in range(2)
    )
    grain_id, wall_id = scene.materials.append(grain), scene.materials.append(wall)
    places, fixed = centres, "XYZ"
    if centres.shape[1] == 2:
        places, fixed = np.column_stack((centres, np.zeros(len(centres)))), "zXYZ"
    for place, radius in zip(places, radii, strict=True):
        body = utils.sphere(tuple(place), radius, material=grain)
        body.state.blockedDOFs = fixed
        body.state.mass = 1.0
        scene.bodies.append(body)
    scene.bodies.append(frame.walls(wall))
    law = wrapper.Law2_ScGeom_FrictPhys_CundallStrack()
    bounds = [wrapper.Bo1_Sphere_Aabb(), wrapper.Bo1_Wall_Aabb(), wrapper.Bo1_Facet_Aabb()]
    geometries = [
        wrapper.Ig2_Sphere_Sphere_ScGeom(),
        wrapper.Ig2_Wall_Sphere_ScGeom(),
        wrapper.Ig2_Facet_Sphere_ScGeom(),
    ]
    stiff_walls = ((grain_id, wall_id, _WALL_STIFFNESS),)
    normal = wrapper.MatchMaker(matches=stiff_walls, algo="val", val=_STIFFNESS)
    shear = wrapper.MatchMaker(algo="val", val=0.0)
    physics = wrapper.Ip2_FrictMat_FrictMat_FrictPhys(kn=normal, ks=shear)
    loop = wrapper.DiscLoop(geometries, [physics], [law])
    loop.mirror = False
    set_engines(
        [
            wrapper.ForceResetter(),
            wrapper.InsertionSortCollider(bounds, verletDist=0.1),
            loop,
            wrapper.NewtonIntegrator(damping=_DAMPING),
        ]
    )
    return loop


def _ring(radius: float, material: wrapper.Material) -> list[wrapper.Body]:
    """Facets whose cuts with the plane z = 0 are the chords of a regular polygon."""
    count = max(24, math.ceil(2.0 * math.pi * radius / 0.5))
    angles = [2.0 * math.pi * k / count for k in range(count)]
    # numpy has cosines of its own on some processors: discs would differ between machines
    corners = radius * np.array([(math.cos(angle), math.sin(angle)) for angle in angles])
    facets = []
    for k in range(count):
        a, b = corners[k], corners[(k + 1) % count]
        middle, half = 0.5 * (a + b), b - a  # a triangle twice as wide at its base as half way up
        vertices = [(*(middle - half), -4.0), (*(middle + half), -4.0), (*middle, 4.0)]
        facets.append(utils.facet(vertices, material=material))
    return facets


def _advance(scene: wrapper.Omega, steps: int) -> None:
    for _ in range(steps):
        scene.step()  # O.run(..., wait=True) polls: 40 ms each time


def _calm_start(scene: wrapper.Omega) -> None:
    """Stop the discs every other step at first: large overlaps would fling them through walls."""
    scene.dt = _START_TIME_STEP
    for _ in range(30):
        _advance(scene, 2)
        utils.calm()
    scene.dt = _TIME_STEP


def _is_at_rest(scene: wrapper.Omega) -> bool:
    """Whether forces balance, or the packing is so loose that no discs touch."""
    return scene.interactions.countReal() == 0 or utils.unbalancedForce() < _UNBALANCED


def _positions(scene: wrapper.Omega, discs: int) -> FloatArray:
    places = (scene.bodies[k].state.pos for k in range(discs))
    return np.array([(place[0], place[1], place[2]) for place in places])


def _require_inside(frame: Container, centres: FloatArray) -> None:
    for place in centres:
        if not frame.has_inside(place):
            told = ", ".join(f"{value:.6g}" for value in place)
            raise SimulationError(
                f"packing: disc centre = ({told}) mean diameters, must stay inside the outline; "
                "change the seed or raise the porosity"
            )
