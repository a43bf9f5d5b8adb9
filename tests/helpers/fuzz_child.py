# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples of a fuzz test in a process of their own: a crash is a failure that names its example.

One child does many examples, one line of JSON each; one that crashed or hung is replaced. What an
example does is plain data, so that it can be kept as a test.
"""

from __future__ import annotations

import dataclasses
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

import hypothesis
from fuzz_script import Script

#: Time of the processor that an example may take [s].
LONGEST = 120.0
#: Wall time after which one that does nothing has hung [s]; the machine may be busy.
HUNG = 1200.0


#: Version of Hypothesis whose draws are those of the day; others draw others from the same test.
DRAWN_BY = "6.67.1"


def drawing(count: int, by_night: int = 100) -> hypothesis.settings:
    """Settings of a test of `count` examples, by night of `by_night` times as many.

    A version of Hypothesis that draws others is left by day with those that the test names: what
    is drawn by day is the same everywhere, so that a change is judged by what it has changed.
    """
    night = os.environ.get("HYPOTHESIS_PROFILE") == "night"
    as_known = night or hypothesis.__version__ == DRAWN_BY
    return hypothesis.settings(
        max_examples=count * (by_night if night else 1),
        phases=tuple(hypothesis.Phase) if as_known else (hypothesis.Phase.explicit,),
        deadline=None,
        suppress_health_check=list(hypothesis.HealthCheck),
    )


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
        first, begin = used(process.pid), time.monotonic()  # noqa: TID251
        while not selector.select(1.0):
            past = time.monotonic() - begin  # noqa: TID251
            if used(process.pid) - first > LONGEST or past > HUNG:
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


class Spheres:
    """Solids of any spheres, saved, loaded, built and stepped."""

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import numpy as np

        import flexpm  # first: it knows where YADE is
        import yade  # isort: skip

        yade.O.reset()
        try:
            specimen = flexpm.Specimen.from_spheres(
                example["spheres"],
                **example["sizes"],
                short_edge=example["short_edge"],
                drop_hidden=example["drop_hidden"],
            )
            rock = None
            if example["minerals"] is not None:
                rock = _of_two_minerals(flexpm.materials.load(None, example["model"]))
            if example["minerals"]:
                specimen = specimen.with_minerals(example["minerals"])
            wider = example["interaction_range"]
            built = flexpm.build(specimen, rock, example["model"], interaction_range=wider)
            if example["model"] in ("flexible", "rigid"):
                for side, axes in example["held"]:
                    built.solver.holdSide(side, **dict.fromkeys(axes, True))
        except (flexpm.InputError, ValueError) as raised:
            return f"InputError: {raised}"
        volume = float(np.sum(specimen.cells.volumes))
        if not abs(volume / specimen.outline().volume - 1.0) < 1e-9:
            return f"volume = {volume}"
        with tempfile.TemporaryDirectory() as folder:
            specimen.save(f"{folder}/it.json")
            again = flexpm.Specimen.load_solid(f"{folder}/it.json")
        if not np.array_equal(again.cells.volumes, specimen.cells.volumes):
            return "another specimen in its file"
        if not np.array_equal(again.minerals, specimen.minerals):
            return "other minerals in its file"
        built.run(20)
        if not np.all(np.isfinite(built.snapshot().positions)):
            return "places that are none"
        return "done"


def _of_two_minerals(rock: Any) -> Any:
    """The rock, of which half the volume has twice the cohesion."""
    from flexpm.materials.mineral import Mineral

    stronger = {"cohesion": 2.0 * rock.cohesion, "shear_fracture_energy": 4e3}
    kinds = (Mineral("one", 0.5, {}), Mineral("other", 0.5, stronger))
    return dataclasses.replace(rock, minerals=kinds)


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
        whole = [self.area_of(ring) for ring in (specimen.outline, *specimen.holes)]
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
    def area_of(ring: Any) -> float:
        following = ring[[*range(1, len(ring)), 0]]
        return float(0.5 * (ring[:, 0] @ following[:, 1] - ring[:, 1] @ following[:, 0]))


class Labels:
    """Specimens of any images of labels, saved, loaded, built and stepped."""

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import numpy as np

        import flexpm  # first: it knows where YADE is
        import yade  # isort: skip

        yade.O.reset()
        minerals = example["minerals"]
        labels = np.array(example["labels"])
        try:
            specimen = flexpm.Specimen.from_labels(
                labels,
                example["pixel"],
                0.01,
                minerals=None if minerals is None else dict(enumerate(minerals)),
                edge=example["edge"],
                smallest=example["smallest"],
            )
        except flexpm.InputError as raised:
            return f"InputError: {raised}"
        areas = specimen.tessellation.cell_areas
        whole = [Cells.area_of(ring) for ring in (specimen.outline, *specimen.holes)]
        if not (np.all(areas > 0.0) and abs(areas.sum() / sum(whole) - 1.0) < 1e-9):
            return f"areas = {areas.tolist()}, outline and holes = {whole}"
        rock = labels.size * example["pixel"] ** 2
        if minerals is None and abs(areas.sum() / rock - 1.0) > 1e-7:
            return f"area = {areas.sum()}, pixels = {rock}"
        with tempfile.TemporaryDirectory() as folder:
            specimen.save(f"{folder}/it.json")
            again = flexpm.Specimen.load(f"{folder}/it.json")
        for name in ("grains", "minerals"):
            if not np.array_equal(getattr(again, name), getattr(specimen, name)):
                return f"other {name} in its file"
        if specimen.minerals is not None and len(areas) > 1:
            rocks = _of_two_minerals(flexpm.materials.load(None, example["model"]))
            if specimen.minerals.max() > 1:
                return "done"
        else:
            rocks = None
        if len(areas) > 1:
            built = flexpm.build(specimen, rocks, example["model"])
            built.run(20)
            if not np.all(np.isfinite(built.snapshot().positions)):
                return "places that are none"
        return "done"


class Bodies:
    """Solids of given cells: bricks of any sizes or a prism in layers, turned files of Neper."""

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import numpy as np
        from neper_solids import bricks, prism, tess_text

        import flexpm  # first: it knows where YADE is
        import yade  # isort: skip

        yade.O.reset()
        if example["facets"]:
            vertices, faces, cells = prism(example["facets"], len(example["planes"][2]) + 1)
            places = np.array(vertices)
            places[:, 2] = self._at(example["planes"][2])[places[:, 2].astype(int)]
        else:
            shape = [len(planes) + 1 for planes in example["planes"]]
            vertices, faces, cells = bricks(shape)
            places = np.rint(np.array(vertices) * shape).astype(int)
            columns = zip(example["planes"], places.T, strict=True)
            places = np.column_stack([self._at(planes)[place] for planes, place in columns])
        places[example["moved"] % len(places)] += example["by"]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.tess")
            path.write_text(tess_text(places.tolist(), faces, cells))
            try:
                specimen = flexpm.Specimen.from_tess_solid(
                    path, scale=example["scale"], short_edge=example["short_edge"]
                )
            except flexpm.InputError as raised:
                return f"InputError: {raised}"
            volume = float(np.sum(specimen.cells.volumes))
            if not abs(volume / specimen.outline().volume - 1.0) < 1e-9:
                return f"volume = {volume}"
            specimen.save(f"{folder}/it.json")
            again = flexpm.Specimen.load_solid(f"{folder}/it.json")
        if not np.array_equal(again.cells.volumes, specimen.cells.volumes):
            return "another specimen in its file"
        if specimen.cells.cells > 1:
            built = flexpm.build(specimen, None, example["model"])
            built.run(20)
            if not np.all(np.isfinite(built.snapshot().positions)):
                return "places that are none"
        return "done"

    @staticmethod
    def _at(planes: list[float]) -> Any:
        import numpy as np

        return np.array([0.0, *sorted(planes), 1.0])


class Networks:
    """Specimens that any fracture network cuts, saved and loaded."""

    def __init__(self) -> None:
        import flexpm

        self._wholes = (
            flexpm.Specimen.rectangle(0.016, 0.02, 0.01),
            flexpm.Specimen.disc(0.02, 0.01),
        )

    def __call__(self, example: dict[str, Any]) -> str:
        """The error of an example, or what became of it."""
        import flexpm

        for whole in self._wholes:
            try:
                cut = whole.with_network(example)
            except flexpm.InputError as raised:
                return f"InputError: {raised}"
            with tempfile.TemporaryDirectory() as folder:
                cut.save(f"{folder}/it.json")
                again = flexpm.Specimen.load(f"{folder}/it.json")
            if again.spec != cut.spec:
                return "another specimen in its file"
            if again.network_intensities() != cut.network_intensities():
                return "another intensity in its file"
        return "done"


class Physics:
    """Runs with any material, specimen and test."""

    #: Steps after which a test is left: it would end, but nobody waits for it.
    LONGEST = 20_000
    #: The same of a solid, whose steps are longer.
    LONGEST_OF_SOLIDS = 8_000

    class LongError(Exception):
        """The test is long."""

    def __call__(self, example: dict[str, Any]) -> dict[str, Any]:
        """Status of a run, and what of its result is no number; or its error."""
        import flexpm
        from flexpm.dimensions import is_solid
        from flexpm.specimens.space.any_spec import spec_of
        from flexpm.specimens.space.specimen import SolidSpecimen

        solid = is_solid(example["specimen"]["kind"])
        longest = self.LONGEST_OF_SOLIDS if solid else self.LONGEST
        steps = 0.0

        def look(done: float, expected: float, text: str) -> None:
            nonlocal steps
            steps = done
            if done > longest:
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
            specimen = (SolidSpecimen if solid else flexpm.Specimen).pack(spec_of(sizes))
            if example["joints"]:
                specimen = specimen.with_joints(example["joints"])
            result = flexpm.run(
                example["test"], specimen, rock, model, progress=look, **example["options"]
            )
        except Exception as raised:
            return {"error": f"{type(raised).__name__}: {raised}", "steps": steps}
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
        if result.test not in ("uniaxial", "tension", "biaxial", "triaxial"):
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
    """Command lines, in this process one after the other, in a folder with a file of each kind."""

    def __init__(self) -> None:
        from good_files import FILES, OTHERS

        import flexpm

        self._files = FILES | OTHERS
        with tempfile.TemporaryDirectory() as folder:
            for name, one in (
                ("grains.json", flexpm.Specimen.rectangle(0.012, 0.016, 0.01)),
                ("solid.json", flexpm.Specimen.box(0.009, 0.009, 0.012)),
            ):
                one.save(f"{folder}/{name}")
                self._files[name] = Path(folder, name).read_bytes()

    def __call__(self, arguments: list[str]) -> list[Any]:
        """Exit code and what went to stderr."""
        import contextlib
        import io

        from flexpm.cli.main import main

        errors = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            for name, content in self._files.items():
                Path(name).write_bytes(content)
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
                code = main(arguments)
            outside = sorted({*os.listdir(".")} - {*self._files}) if code == 2 else []
        return [code, errors.getvalue(), outside]


def serve(kind: str, out: Any) -> None:
    """Answer each line of stdin by one line."""
    kinds: dict[str, Callable[[], Callable[[Any], Any]]] = {
        "script": Script,
        "discs": Discs,
        "cells": Cells,
        "labels": Labels,
        "bodies": Bodies,
        "spheres": Spheres,
        "networks": Networks,
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
