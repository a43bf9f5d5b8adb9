# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples of a fuzz test in a process of their own: a crash is a failure that names its example.

One child does many examples, one line of JSON each; one that crashed or hung is replaced. What an
example does is plain data, so that it can be kept as a test.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import selectors
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
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
#: Time of the processor that an example may take [s].
LONGEST = 120.0
#: Wall time after which one that does nothing has hung [s]; the machine may be busy.
HUNG = 1200.0


def examples(count: int) -> int:
    """Number of examples of a test: `count`, by night a hundred times as many."""
    return count * (100 if os.environ.get("HYPOTHESIS_PROFILE") == "night" else 1)


def used(process: int) -> float:
    """Time that a process has had of the processor [s]."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Child:
    """A process that does examples of one kind."""

    def __init__(self, kind: str) -> None:
        self._kind, self._process = kind, None

    def run(self, example: Any) -> Any:
        """Answer of the child; fails if it has ended or does not answer."""
        if self._process is None:
            self._start()
        process = self._process
        text = json.dumps(example)
        process.stdin.write(text + "\n")
        process.stdin.flush()
        answered = self._has_answered(process)
        line = process.stdout.readline() if answered else ""
        if line:
            return json.loads(line)
        how = (
            f"ended with {process.wait()}"
            if answered
            else f"did not end in {LONGEST} s of the processor"
        )
        self.close()
        self._errors.seek(0)
        raise AssertionError(f"the process {how} in {text}: {self._errors.read()[-2000:]}")

    @staticmethod
    def _has_answered(process: subprocess.Popen[str]) -> bool:
        """Wait for an answer or the end of a process, as long as it may take."""
        selector = selectors.DefaultSelector()
        selector.register(process.stdout, selectors.EVENT_READ)
        first, begin = used(process.pid), time.monotonic()
        while not selector.select(1.0):
            if used(process.pid) - first > LONGEST or time.monotonic() - begin > HUNG:
                return False
        return True

    def close(self) -> None:
        """End the child."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process.stdin.close()
            self._process.stdout.close()
            self._process = None

    def _start(self) -> None:
        import flexpm

        here, package = Path(__file__).parent, Path(flexpm.__file__).parent.parent
        self._errors = tempfile.TemporaryFile("w+")  # noqa: SIM115
        self._process = subprocess.Popen(
            [sys.executable, __file__, self._kind],
            env={**os.environ, "PYTHONPATH": f"{package}:{here}", "OMP_NUM_THREADS": "1"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            text=True,
        )


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
        self._solver: Any = None
        self._views: list[Any] = []
        self._held: list[Any] = []
        self._erased = False  # something, since the last step

    def __call__(self, calls: list[list[Any]]) -> list[dict[str, Any]]:
        """Make the calls; what each raised, and what the scene then is."""
        self._begin()
        Path(self._folder.name, "scene.bin").unlink(missing_ok=True)
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
        self._rig = None
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
        self._rig = None
        self._built = self._flexpm.build(cut, rock, model)
        self._solver = self._built.solver

    def _specimen(self, seed: int) -> Any:
        if seed not in self._specimens:
            made = self._flexpm.Specimen.rectangle(0.012, 0.016, 0.01, seed=seed)
            self._specimens[seed] = made
        return self._specimens[seed]

    def _parts(self) -> Any:
        """The specimen between parts, once something is built."""
        if self._rig is None and self._built is not None:
            self._rig = self._flexpm.PartRig(self._built)
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
            self._held.append(rig.support((x, y), length, bonded=bonded))

    def do_platen(self, side: int, bonded: bool) -> None:
        if rig := self._parts():
            self._held.append(rig.platen(side, bonded=bonded))

    def do_hold(self, x: float, y: float, radius: float, axes: str) -> None:
        if rig := self._parts():
            self._held.append(rig.hold(disc=((x, y), radius), axes=axes))

    def do_drive(self, way: list[Any], parts: list[Any], against: list[Any]) -> None:
        if rig := self._parts():
            rig.drive(self._picked(parts), way, against=self._picked(against))

    def do_turn(self, about: Any, parts: list[Any], back: list[Any]) -> None:
        if rig := self._parts():
            rig.turn(self._picked(parts), self._picked(back), about=about)

    def do_press(self, part: list[Any], pressure: float) -> None:
        if rig := self._parts():
            rig.press(self._picked(part), pressure)

    def do_move(self, part: list[Any], along: float, across: float) -> None:
        if hasattr(held := self._picked(part), "move"):
            held.move((across, along))

    def do_again(self) -> None:
        self._rig = None  # the next call takes the scene up

    def do_names(self, name: Any, column: Any, part: list[Any]) -> None:
        if rig := self._parts():
            rig.also(name, column)
            rig.way_of(name, self._picked(part), (0.0, 1.0))

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
            rig.gauge(name, (x, y), (y, x))

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
            self._rig = None
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


class Discs:
    """Specimens of any discs in any outline, built and stepped."""

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import flexpm  # first: it knows where YADE is
        from flexpm.specimens.specimen import Circle
        import yade  # isort: skip

        yade.O.reset()
        outline = example["outline"]
        if isinstance(outline, list) and outline and example["closed"]:
            outline = [*outline, outline[0]]
        try:
            specimen = flexpm.Specimen.from_discs(
                example["centres"],
                example["radii"],
                outline if isinstance(outline, list) else Circle(*outline.values()),
                example["thickness"],
                short_edge=example["short_edge"],
                drop_hidden=example["drop_hidden"],
            )
            built = flexpm.build(specimen, None, example["model"])
            built.run(20)
            built.snapshot()
        except Exception as raised:
            return f"{type(raised).__name__}: {raised}"
        return "done"


class Cells:
    """Specimens of any cells, with grains within grains, built, saved, loaded and stepped."""

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import numpy as np

        import flexpm  # first: it knows where YADE is
        import yade  # isort: skip

        yade.O.reset()
        rings = example["rings"][:: -1 if example["order"] else 1]
        rings = [1e-3 * np.array(ring, dtype=float) for ring in rings]
        try:
            specimen = flexpm.Specimen.from_polygons(rings, 0.01, holes=example["holes"])
        except flexpm.InputError as raised:
            return f"InputError: {raised}"
        areas = specimen.tessellation.cell_areas
        whole = [self._area(ring) for ring in (specimen.outline, *specimen.holes)]
        if not (np.all(areas > 0.0) and abs(areas.sum() / sum(whole) - 1.0) < 1e-9):
            return f"areas = {areas.tolist()}, outline and holes = {whole}"
        with tempfile.TemporaryDirectory() as folder:
            specimen.save(f"{folder}/it.json")
            again = flexpm.Specimen.load(f"{folder}/it.json")
        if not np.array_equal(again.tessellation.cell_areas, areas):
            return "another specimen in its file"
        if len(areas) > 1:
            built = flexpm.build(specimen, None, example["model"])
            built.run(20)
            if not np.all(np.isfinite(built.snapshot().positions)):
                return "places that are none"
        return "done"

    @staticmethod
    def _area(ring: Any) -> float:
        following = ring[[*range(1, len(ring)), 0]]
        return float(0.5 * (ring[:, 0] @ following[:, 1] - ring[:, 1] @ following[:, 0]))


class Physics:
    """Runs with any material, specimen and test."""

    #: Steps after which a test is left: it would end, but nobody waits for it.
    LONGEST = 20_000

    class LongError(Exception):
        """The test is long."""

    def __call__(self, example: dict[str, Any]) -> dict[str, Any]:
        """Status of a run, and what of its result is no number; or its error."""
        import flexpm
        from flexpm.specimens.spec import SpecimenSpec

        def look(done: float, expected: float, text: str) -> None:
            if done > self.LONGEST:
                raise self.LongError(f"{done} steps of {expected:.3g}")

        sizes = dict(example["specimen"])
        sizes["diameters"] = tuple(sizes["diameters"])
        model = example["model"]
        try:
            rock = flexpm.materials.load(None, model)
            if example["minerals"]:
                kinds = [{"name": name, "fraction": 0.5} for name in ("hard", "soft")]
                rock = dataclasses.replace(rock, minerals=kinds)
            rock = rock.with_set(example["material"], model)
            specimen = flexpm.Specimen.pack(SpecimenSpec(**sizes))
            if example["joints"]:
                specimen = specimen.with_joints(example["joints"])
            result = flexpm.run(
                example["test"], specimen, rock, model, progress=look, **example["options"]
            )
        except Exception as raised:
            return {"error": f"{type(raised).__name__}: {raised}"}
        return {
            "status": result.status,
            "energy_error": result.energy_error,
            "warnings": result.warnings,
            "infinite": self._infinite(result),
        }

    @staticmethod
    def _infinite(result: Any) -> list[str]:
        """Names of measures, and of columns that the model has, with a number that is none."""
        import numpy as np

        from flexpm.models.options import SPHERE_MODELS
        from flexpm.results.record import COLUMNS

        found = [
            name
            for name, value in result.as_dict().items()
            if isinstance(value, float) and not np.isfinite(value)
        ]
        if result.status == "diverged":
            return found
        absent = COLUMNS if result.model in SPHERE_MODELS else ()
        if result.test not in ("uniaxial", "tension", "biaxial"):
            absent = (*absent, "lateral_strain")
        if result.test == "sonic":  # one end is free
            absent = (*absent, "end_mismatch")
        for name in COLUMNS:
            column = result.curve[name]
            if not np.all(np.isfinite(column)) and not (
                name in absent and np.all(np.isnan(column))
            ):
                found.append(name)
        return found


class Command:
    """Command lines, in this process one after the other."""

    def __call__(self, arguments: list[str]) -> list[Any]:
        """Exit code and what went to stderr."""
        import contextlib
        import io

        from flexpm.cli.main import main

        errors = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
                code = main(arguments)
            outside = sorted(os.listdir(".")) if code == 2 else []
        return [code, errors.getvalue(), outside]


def serve(kind: str, out: Any) -> None:
    """Answer each line of stdin by one line."""
    kinds: dict[str, Callable[[], Callable[[Any], Any]]] = {
        "script": Script,
        "discs": Discs,
        "cells": Cells,
        "command": Command,
        "physics": Physics,
    }
    answer = kinds[kind]()
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), file=out, flush=True)


if __name__ == "__main__":
    # what libraries print must not be taken for an answer
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    serve(sys.argv[1], answers)
