# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls that a user's script makes in any order: what the fuzz test of scripts has its child do."""

from __future__ import annotations

import contextlib
import hashlib
import shutil
import tempfile
from pathlib import Path
from typing import Any

#: Calls of the solver without arguments.
QUERIES = (
    *("counts", "cracks", "energies", "unbalanced", "snapshot", "plates", "mirrorBodies"),
    *("resetEnergyBalance", "scaleMasses", "useRealMasses", "elasticConstants"),
    *("nodePlaces", "nodeSets"),
)
#: Attributes that a script may set to nonsense.
NUMBERS = ("damping", "measurePeriod", "checkPeriod", "mirrorPeriod")
#: What parts tell.
PART_READINGS = (
    *("force", "work", "position", "displacement", "width", "area", "normal", "contact_angle"),
    *("angle", "machine_energy", "moment", "nodes", "axes", "requested_position"),
)

#: Depth of solids [m].
SOLID_DEPTH = 0.008


class Script:
    """Calls that a user's script makes in any order, on one scene."""

    def __init__(self) -> None:
        import flexpm  # first: it knows where YADE is
        import yade  # isort: skip

        self._flexpm, self._yade, self._specimens = flexpm, yade, {}
        self._folder = tempfile.TemporaryDirectory()
        self._strange: list[Any] = []  # parts of rigs that are gone
        self._begin()

    def _begin(self) -> None:
        self._yade.O.reset()
        self._built: Any = None
        self._rig: Any = None
        self._ends: Any = None
        self._solver: Any = None
        self._views: list[Any] = []
        self._held: list[Any] = []
        self._erased = False  # something, since the last step

    def __call__(self, calls: list[list[Any]]) -> list[dict[str, Any]]:
        """Make the calls; what each raised, and what the scene then is."""
        self._begin()
        left = Path(self._folder.name, "scene.bin")
        if left.is_dir():  # of a rig that was left there
            shutil.rmtree(left)
        left.unlink(missing_ok=True)
        seen = []
        for name, *arguments in calls:
            error = ""
            try:
                getattr(self, f"do_{name}")(*arguments)
            except Exception as raised:
                error = f"{type(raised).__name__}: {raised}"
            seen.append({"error": error, **self._scene()})
        return seen

    def _scene(self) -> dict[str, Any]:
        scene = self._yade.O
        return {
            "step": scene.iter,
            "bodies": sum(1 for _ in scene.bodies),
            "bonds": sum(1 for one in scene.interactions if one.isReal),
            "state": self._state(),
        }

    def _state(self) -> str:
        """Hash of the grains' places, empty if they cannot be asked for."""
        try:
            places = self._solver.snapshot()["positions"]
        except Exception:
            return ""
        return hashlib.sha256(places.tobytes()).hexdigest()[:16]

    def do_build(self, model: str, seed: int, points: int, mesh: str) -> None:
        self._rig = self._ends = None
        self._built = self._flexpm.build(
            self._specimen(seed), None, model, points=points, mesh=mesh
        )
        self._solver = self._built.solver

    def do_build_cut(self, model: str, seed: int, slope: float, law: dict[str, Any]) -> None:
        middle, rise = 0.008, 0.006 * slope
        line = [[0.0, middle - rise], [0.012, middle + rise]]
        cut = self._specimen(seed).with_joints({"cut": line})
        rock = self._flexpm.materials.load(None, model)
        rock = rock.with_set({f"joint.cut.{key}": value for key, value in law.items()}, model)
        self._rig = self._ends = None
        self._built = self._flexpm.build(cut, rock, model)
        self._solver = self._built.solver

    def do_build_cave(self, model: str, seed: int, line: Any) -> None:
        self._rig = self._ends = None
        specimen = self._specimen(seed).with_excavations({"cave": line})
        self._built = self._flexpm.build(specimen, None, model)
        self._solver = self._built.solver

    def do_build_solid(self, model: str, seed: int) -> None:
        self._rig = self._ends = None
        if -seed not in self._specimens:
            made = self._flexpm.Specimen.box(0.012, SOLID_DEPTH, 0.016, seed=seed)
            self._specimens[-seed] = made
        self._built = self._flexpm.build(self._specimens[-seed], None, model)
        self._solver = self._built.solver

    def _is_solid(self) -> bool:
        return "depth" in self._built.specimen.dimensions

    def _at(self, x: Any, y: Any) -> tuple[Any, ...]:
        """A place of the plane; of a solid in the middle of its depth."""
        return (x, 0.5 * SOLID_DEPTH, y) if self._is_solid() else (x, y)

    def _along(self, way: list[Any]) -> tuple[Any, ...]:
        return (way[0], 0.0, way[1]) if self._is_solid() else tuple(way)

    def _specimen(self, seed: int) -> Any:
        if seed not in self._specimens:
            made = self._flexpm.Specimen.rectangle(0.012, 0.016, 0.01, seed=seed)
            self._specimens[seed] = made
        return self._specimens[seed]

    def _parts(self) -> Any:
        """The specimen between parts, once something is built."""
        if self._rig is None and self._built is not None:
            solid = self._is_solid()
            kind = self._flexpm.SolidPartRig if solid else self._flexpm.PartRig
            self._rig, self._ends = kind(self._built), None
            self._strange += self._held
            self._held = []
        return self._rig

    def _picked(self, picks: list[Any]) -> Any:
        """Parts by number; those of other rigs and scenes from 100 on; all else as it is."""
        found = []
        for pick in picks:
            own = isinstance(pick, int) and not isinstance(pick, bool)
            parts = self._strange if own and pick >= 100 else self._held
            found.append(parts[pick % 100 % len(parts)] if own and parts else pick)
        return found[0] if len(found) == 1 else found

    def do_support(self, x: float, y: float, length: float, bonded: bool) -> None:
        if rig := self._parts():
            self._held.append(rig.support(self._at(x, y), length, bonded=bonded))

    def do_roller(self, x: float, y: float, pinned: bool) -> None:
        if rig := self._parts():
            self._held.append(rig.support(self._at(x, y), pinned=pinned))

    def do_platen(self, side: int, bonded: bool) -> None:
        if rig := self._parts():
            self._held.append(rig.platen(side, bonded=bonded))

    def do_layer(self, side: int, strip: Any) -> None:
        if rig := self._parts():
            self._held.append(rig.platen(side, strip=strip))

    def do_seat(self, side: int, name: Any) -> None:
        if rig := self._parts():
            self._held.append(rig.platen(side, seated=True))
            rig.rotation_of(name, self._held[-1])

    def do_ends(self, pressure: Any, way: Any, load: Any) -> None:
        if self._built is not None:
            self._flexpm.rig(self._built).elastic(pressure, displacement=way, load=load)

    def do_end(self, name: str, arguments: list[Any], named: dict[str, Any]) -> None:
        """A call of the rig between ends."""
        if self._built is not None:
            if self._ends is None:
                self._ends, self._rig = self._flexpm.rig(self._built), None
            getattr(self._ends, name)(*arguments, **named)

    def do_fail(self, between_ends: bool, options: dict[str, Any]) -> None:
        """Load up to a small strain."""
        loading = self._flexpm.Loading(**options)
        if between_ends:
            self.do_end("load", [loading], {})
        elif rig := self._parts():
            rig.load(loading)

    def do_leave(self, name: str) -> None:
        if rig := self._parts():
            rig.save(f"{self._folder.name}/{name}")
            rig.to_yade_plot()

    def do_jaw(self, x: float, y: float, radius: float, angle: Any, name: Any) -> None:
        if rig := self._parts():
            self._held.append(rig.jaw(self._at(x, y), radius, angle=angle))
            rig.contact_angle_of(name, self._held[-1])

    def do_soft(self, way: list[Any], parts: list[Any], machine: float) -> None:
        if rig := self._parts():
            rig.drive(self._picked(parts), self._along(way), machine=machine)

    def do_hold(self, x: float, y: float, radius: float, axes: str) -> None:
        if rig := self._parts():
            region = {"ball" if self._is_solid() else "disc": (self._at(x, y), radius)}
            self._held.append(rig.hold(**region, axes=axes))

    def do_drive(self, way: list[Any], parts: list[Any], against: list[Any]) -> None:
        if rig := self._parts():
            rig.drive(self._picked(parts), self._along(way), against=self._picked(against))

    def do_turn(self, about: Any, parts: list[Any], back: list[Any]) -> None:
        if rig := self._parts():
            place = None if about is None else self._at(*about)
            rig.rotate(self._picked(parts), self._picked(back), about=place)

    def do_press(self, part: list[Any], pressure: float) -> None:
        if rig := self._parts():
            rig.press(self._picked(part), pressure)

    def do_elastic(self, part: list[Any], pressure: Any, way: Any, load: Any) -> None:
        if rig := self._parts():
            rig.elastic({self._picked(part): pressure}, displacement=way, load=load)

    def do_press_all(self, parts: list[Any], pressures: list[Any]) -> None:
        if rig := self._parts():
            picked = self._picked(parts)
            picked = picked if isinstance(picked, list) else [picked]
            rig.press(dict(zip(picked, pressures, strict=False)))

    def do_stage(self, name: str, arguments: list[Any], named: dict[str, Any]) -> None:
        """A stage; those that would take long are asked for a few crossings alone."""
        if rig := self._parts():
            getattr(rig, name)(*arguments, **named)

    def do_move(self, part: list[Any], along: float, across: float) -> None:
        if hasattr(held := self._picked(part), "move"):
            held.move(self._along([across, along]))

    def do_again(self) -> None:
        self._rig = self._ends = None  # the next call takes the scene up

    def do_part(self, part: list[Any]) -> None:
        """All that a part tells."""
        if hasattr(held := self._picked(part), "force"):
            for name in PART_READINGS:
                with contextlib.suppress(self._flexpm.InputError):  # not all parts have all
                    getattr(held, name, None)

    def do_names(self, name: Any, column: Any, part: list[Any]) -> None:
        if rig := self._parts():
            rig.alias_column(name, column)
            rig.displacement_of(name, self._picked(part), self._along([0.0, 1.0]))

    def do_read(self, column: Any) -> None:
        if rig := self._parts():
            assert all("\n" not in line for line in rig.warnings)
            rig.record[column]

    def do_start(self, rate: float) -> None:
        if rig := self._parts():
            rig.start(self._flexpm.Loading(rate=rate))

    def do_finish(self) -> None:
        if rig := self._parts():
            rig.finish()

    def do_gauge(self, name: Any, x: float, y: float) -> None:
        if rig := self._parts():
            rig.gauge(name, self._at(x, y), self._at(y, x))
            rig.reading(name)

    def do_set_nodes(self, first: int, count: int) -> None:
        nodes = self._solver.nodePlaces()[0][max(first, 0) :][:count].tolist()
        self._solver.addNodeSet(nodes if first >= 0 else [first], True, False)

    def do_turn_set(self, number: int, x: float) -> None:
        self._solver.turnNodeSet(number, None if x == 0.0 else (x, 0.0, 0.0))

    def do_move_set(self, number: int, speed: float) -> None:
        self._solver.moveNodeSet(number, (speed, 0.0, 0.0))

    def do_bare(self) -> None:
        self._solver = self._yade.wrapper.GrainSolver()

    def do_engines(self, kind: str) -> None:
        engines, scene = list(self._yade.O.engines), self._yade.O
        others = {
            "none": [],
            "solver": [self._solver] if self._solver is not None else [],
            "twice": [*engines, *engines],
            "reversed": engines[::-1],
            "recorder": [self._yade.wrapper.AxialRecorder(), *engines],
            "bare": [self._yade.wrapper.GrainSolver(), *engines],
        }
        scene.engines = others[kind]

    def do_step(self, count: int) -> None:
        for _ in range(count):
            self._yade.O.step()
            self._erased = False

    def do_reset(self) -> None:
        self._begin()

    def do_save(self) -> None:
        there = {body.id for body in self._yade.O.bodies}
        if any({one.id1, one.id2} - there for one in self._yade.O.interactions):
            # YADE cannot load such a scene, of its own spheres either
            raise RuntimeError("interactions of erased bodies, which YADE would not load")
        self._yade.O.save(f"{self._folder.name}/scene.bin", quiet=True)

    def do_load(self) -> None:
        if Path(self._folder.name, "scene.bin").exists():
            self._yade.O.load(f"{self._folder.name}/scene.bin", quiet=True)
            self._rig = self._ends = None
            if self._built is not None:
                self._built.rebind()
            kind = self._yade.wrapper.GrainSolver
            for engine in self._yade.O.engines:
                if isinstance(engine, kind):
                    self._solver = engine

    def do_erase_bond(self, number: int) -> None:
        bonds = list(self._yade.O.interactions)
        if bonds:
            one = bonds[number % len(bonds)]
            self._yade.O.interactions.erase(one.id1, one.id2)
            self._erased = True

    def do_erase_body(self, number: int) -> None:
        bodies = [body.id for body in self._yade.O.bodies]
        if bodies:
            self._yade.O.bodies.erase(bodies[number % len(bodies)])
            self._erased = True

    def do_clear(self) -> None:
        if self._erased:
            return  # YADE's collider looks the bodies up, with its own spheres, too
        self._yade.O.bodies.clear()

    def do_touch(self, side: int) -> None:
        self._solver.addSidePlates(side)

    def do_plate(self, x: float, y: float) -> None:
        self._solver.addTouchingPlate((x, y, 0.0))

    def do_wall(self, x: float, y: float) -> None:
        self._solver.addWall((x, y, 0.0), (0.0, 1.0, 0.0))

    def do_ask(self, name: str) -> None:
        getattr(self._solver, name)()

    def do_view(self, number: int) -> None:
        bodies = [body for body in self._yade.O.bodies if hasattr(body.shape, "velocities")]
        if bodies:
            shape = bodies[number % len(bodies)].shape
            self._views.append((shape.velocities, shape.held))

    def do_write(self, value: float) -> None:
        for velocities, _ in self._views:
            velocities[:] = value

    def do_set(self, name: str, value: float) -> None:
        setattr(self._solver, name, type(getattr(self._solver, name))(value))

    def do_dead(self, value: bool) -> None:
        self._solver.dead = value

    def do_time_step(self, value: float) -> None:
        self._yade.O.dt = value
