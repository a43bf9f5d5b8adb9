# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled module: what of it is no class of YADE. SI units."""

from collections.abc import Callable, Iterable
from enum import IntEnum
from typing import TypedDict

from yade import wrapper

from .arrays import FloatArray, IntArray

class BuildInfo(TypedDict):
    version: str
    yade_headers: str
    yade_library: str
    compiler: str
    glibc: str
    boost: str

class SceneAsSeen(TypedDict):
    bodies: list[tuple[object, tuple[float, float, float]]]

class Outline:
    @staticmethod
    def polygon(corners: FloatArray) -> Outline: ...
    @staticmethod
    def circle(x: float, y: float, radius: float) -> Outline: ...
    def contains(self, x: float, y: float) -> bool: ...

class Tessellation:
    @property
    def cells(self) -> int: ...
    @property
    def vertices(self) -> FloatArray: ...
    @property
    def cell_offsets(self) -> IntArray: ...
    @property
    def cell_vertices(self) -> IntArray: ...
    @property
    def disc_of_cell(self) -> IntArray: ...
    @property
    def shared_edges(self) -> IntArray: ...
    @property
    def boundary_edges(self) -> IntArray: ...
    @property
    def merged_vertices(self) -> IntArray: ...
    @property
    def hidden_discs(self) -> IntArray: ...
    @property
    def cell_areas(self) -> FloatArray: ...
    @property
    def uncollapsed_shared_edges(self) -> int: ...

class GrainMeshes:
    @property
    def nodes(self) -> FloatArray: ...
    @property
    def triangles(self) -> IntArray: ...
    @property
    def node_offsets(self) -> IntArray: ...
    @property
    def triangle_offsets(self) -> IntArray: ...
    @property
    def first_vertex(self) -> IntArray: ...
    @property
    def standard(self) -> IntArray: ...
    @property
    def fallback(self) -> IntArray: ...
    @property
    def moved_centre(self) -> IntArray: ...
    @property
    def smallest_angle(self) -> FloatArray: ...

class AssemblyInput:
    """What `GrainSolver.assemble` takes beside the materials; arrays are copied."""

    def __init__(
        self, tessellation: Tessellation, centres: FloatArray, radii: FloatArray, thickness: float
    ) -> None: ...
    rigid: bool
    mesh: str
    points: int
    centre_line: bool
    minerals: IntArray
    parent: IntArray
    outer: IntArray
    edge_normals: bool
    edge_strengths: FloatArray
    edge_joints: IntArray

class InnerCells:
    @property
    def tessellation(self) -> Tessellation: ...
    @property
    def discs(self) -> FloatArray: ...
    @property
    def grain(self) -> IntArray: ...
    @property
    def outer(self) -> IntArray: ...

class PolygonOutline:
    def __init__(self, corners: FloatArray, holes: list[FloatArray]) -> None: ...
    @property
    def rings(self) -> list[FloatArray]: ...
    @property
    def area(self) -> float: ...

class Tiling:
    @property
    def tessellation(self) -> Tessellation: ...
    @property
    def discs(self) -> FloatArray: ...
    @property
    def origin(self) -> IntArray: ...
    @property
    def edge_joints(self) -> IntArray: ...

class EnumClass_TestState(IntEnum):  # noqa: N801
    """The plugin puts it into the module yade."""

    running = 0
    past_peak = 1
    least_strain_reached = 2
    largest_strain_reached = 3

class StrainGauge:
    def __init__(
        self,
        bottom: float,
        height: float,
        mean_diameter: float,
        left: Iterable[tuple[int, float]],
        right: Iterable[tuple[int, float]],
    ) -> None: ...
    def strains(self, centres: FloatArray, displacements: FloatArray) -> tuple[float, float]: ...

build_info: BuildInfo
#: What saved scenes hold of all classes: its number, which rises with each change of it [-].
saved_state: int
#: On the masses of the stability bound [-].
mass_margin: float

def contact_modulus(normal_stiffness: float, mean_diameter: float) -> float: ...
def reference_strength(
    tension: bool, tensile_strength: float, cohesion: float, friction: float
) -> float: ...
def rectangle_scales(
    modulus: float,
    strength: float,
    mass: float,
    thickness: float,
    dt: float,
    width: float,
    height: float,
) -> dict[str, float]: ...
def disc_scales(
    modulus: float, strength: float, mass: float, thickness: float, dt: float, diameter: float
) -> dict[str, float]: ...
def axial_stress(bottom: float, top: float, area: float, tension: bool) -> float: ...
def end_mismatch(bottom: float, top: float) -> float: ...
def splitting_area(diameter: float, thickness: float) -> float: ...
def ramp_factor(step: int, ramp_steps: int) -> float: ...
def test_state(
    stress: float,
    peak: float,
    strain: float,
    stop_ratio: float,
    least_peak: float,
    min_strain: float,
    max_strain: float,
) -> EnumClass_TestState: ...
def disc_count(area: float, d_min: float, d_max: float, porosity: float) -> int: ...
def disc_radii(count: int, d_min: float, d_max: float, seed: int) -> FloatArray: ...
def insert_discs(radii: FloatArray, outline: Outline, shrink: float, seed: int) -> FloatArray: ...
def tessellate(
    centres: FloatArray, radii: FloatArray, outline: Outline, short_edge: float, allow_hidden: bool
) -> Tessellation: ...
def cells_in_outline(
    centres: FloatArray, radii: FloatArray, outline: PolygonOutline, short_edge: float
) -> Tiling: ...
def cells_of_polygons(
    polygons: list[FloatArray], with_holes: bool
) -> tuple[Tiling, list[FloatArray]]: ...
def cut_by_joints(
    tessellation: Tessellation,
    centres: FloatArray,
    radii: FloatArray,
    joints: IntArray,
    lines: list[FloatArray],
    numbers: IntArray,
    tell: Callable[[int], None],
) -> tuple[Tiling, FloatArray, IntArray]: ...
def cells_of_file(
    vertices: FloatArray,
    cells: list[IntArray],
    sides: IntArray,
    joints: IntArray,
    centres: FloatArray,
    radii: FloatArray,
) -> Tiling: ...
def grain_meshes(
    tessellation: Tessellation, centres: FloatArray, radii: FloatArray, kind: str
) -> GrainMeshes: ...
def inner_cells(tessellation: Tessellation, mean_count: float = ...) -> InnerCells: ...
def register_classes() -> list[str]: ...
def refresh_renderer(renderer: object) -> None: ...
def set_engines(engines: list[wrapper.Engine]) -> None: ...
def abi_report() -> list[tuple[str, str, bool, str]]: ...
def abi_scene() -> SceneAsSeen: ...
def abi_add_force(
    id: int, force: tuple[float, float, float], torque: tuple[float, float, float]
) -> None: ...
def abi_add_energy(name: str, value: float) -> None: ...
