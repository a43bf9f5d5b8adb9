# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrations to the measures of a function of a script, which replaces flexpm's tests."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict, Unpack

from ...errors import InputError, SimulationError
from ...files import FolderLock, output_folder
from ...materials.keys import ELASTIC_SET
from ...materials.material import Material
from ...materials.material import load as load_material
from ...materials.mixing import value_of
from ...progress import Progress
from ...require import Bounds, quoted, require_known, require_whole
from ...runs.output import refuse_other_kind
from .. import calibration_report, calibration_verdict, pages
from ..calibration_problem import Calibration, Runs, Target, free_of, target_of
from ..calibration_search import (
    Measures,
    Outcome,
    Search,
    Values,
    history_table,
    judged,
    started,
)
from ..study import MOST_RUNS
from ..tables import write_table

#: Measures of a material, by their names.
Measure = Callable[[Material], Mapping[str, float]]
_NO_RUNS = Runs({}, (), ())


class CalibrationOptions(TypedDict, total=False):
    """Keywords of `calibrate`."""

    material: Material | str | None
    model: str
    evaluations: int
    report: bool
    progress: Progress | None


def calibrate(
    measure: Measure,
    free: Mapping[str, Sequence[float]],
    targets: Mapping[str, float | Mapping[str, float]],
    out: Path | str,
    **options: Unpack[CalibrationOptions],
) -> Outcome:
    """Find the material with which a user-supplied function returns the target values.

    Search, verdict and report are the same as with ``flexpm calibrate``. DFO-LS searches the
    logarithms of all keys, after a first guess from measures that have the names of flexpm's
    measures. The function is called once for each material. It makes its own packings, and returns
    the means over them.

    Args:
        measure: Function that takes a `Material`, runs tests with it, and returns numbers by name;
            numbers that are not targets are ignored. If the function raises ``SimulationError`` or
            returns None or nan, the material counts as not measured.
        free: Bounds of each key that may change, as in ``[free]`` of a file, SI units.
        targets: Per measure its value, or a table with ``value``, ``tolerance`` (0.05) and
            ``weight`` (1), as in ``[target]``. Values are > 0.
        out: Folder for ``history.csv``, the material as ``NAME.toml`` with the name of the folder,
            ``calibration.png``, ``verdict.json`` and ``report.html``.
        options: By these names:

            - ``material``: preset, file or material to start from; None: the default of the model.
            - ``model``: model whose law has the keys. Default: ``flexible``.
            - ``evaluations``: largest number of sets that are tried. Default: 40.
            - ``report``: whether to write the report. Default: True.
            - ``progress``: function that is called with (sets done, sets expected, text).

    Returns:
        ``best`` with ``values`` and ``mean(name)``, ``met`` by target, and the ``verdict``. A
        target that no set has measured is not met, and its ``mean`` is None.

    Raises:
        InputError: for a key or a value out of range, a function that does not return a target, or
            a folder with other results.

    Example:
        Young's modulus of a packing, from its static solution::

            def measure(material):
                found = flexpm.elastic(specimen, material)
                return {"youngs_modulus": found["youngs_modulus"]}

            found = flexpm.calibrate(
                measure, {"young": [10e9, 60e9]}, {"youngs_modulus": 26e9}, "fitted"
            )
            print(found.best.values["young"], found.met)
    """
    if not callable(measure):
        raise InputError(
            f"calibrate: measure = {quoted(measure)}, must be a function; pass it without ()"
        )
    for name, given in (("free", free), ("targets", targets)):
        if not isinstance(given, Mapping) or not given:
            raise InputError(
                f"calibrate: {name} = {quoted(given)}, must be a table with entries; give at least "
                "one"
            )
    folder = output_folder(out)
    model = options.get("model", "flexible")
    require_known("calibrate: model", model, list(ELASTIC_SET))
    most = Bounds(at_least=1, at_most=MOST_RUNS)
    plan = _OwnCalibration(
        name=folder.resolve().name,
        model=model,
        material=None,
        base=folder,
        targets=[target_of(name, entry) for name, entry in targets.items()],
        free=free_of({key: [*bounds] for key, bounds in free.items()}),
        ratios=(),
        screen=_NO_RUNS,
        verify=_NO_RUNS,
        evaluations=require_whole("calibrate: evaluations", options.get("evaluations", 40), most),
        rounds=1,
        candidates=1,
    )
    start = load_material(options.get("material"), model)
    found = {key: value_of(start, key, model) for key in plan.free}
    values = {key: started(plan, key, found) for key in plan.free}
    refuse_other_kind(folder, "calibrate")
    lock = FolderLock(folder)
    try:
        calibration_verdict.forget(folder)
        search = _OwnSearch(plan, measure, start, options.get("progress") or (lambda *_: None))
        try:
            best = search.strengths(values)
        finally:
            if search.history:
                write_table(history_table(search.history), folder / "history")
        verdict = judged(plan, best, search.history)
        met = {target.name: target.name not in verdict.missed for target in plan.targets}
        outcome = Outcome(best, met, search.history, verdict)
        calibration_report.write_preset(folder / f"{plan.name}.toml", start, plan, outcome)
        calibration_report.picture(folder / "calibration.png", plan, outcome)
        verdict.write(folder)
        if options.get("report", True):
            pages.write(folder)
    finally:
        lock.release()
    return outcome


@dataclass(frozen=True)
class _OwnCalibration(Calibration):
    """A calibration that searches for all measures in the same manner."""

    @property
    def made_for(self) -> None:
        """None: the function makes the packings, which are unknown here."""

    def of_kind(self, elastic: bool) -> tuple[list[Target], list[str]]:
        return ([], []) if elastic else ([*self.targets], [*self.free])


class _OwnSearch(Search):
    """A search whose measures come from a function."""

    def __init__(
        self, plan: Calibration, measure: Measure, start: Material, progress: Progress
    ) -> None:
        super().__init__(plan, None, progress)
        self._measure, self._start = measure, start
        self._known: dict[tuple[float, ...], tuple[Measures, dict[str, str]]] = {}

    def _measures(
        self, runs: Runs, values: Values, targets: Sequence[Target]
    ) -> tuple[Measures, dict[str, str]]:
        key = tuple(values.values())
        if key not in self._known:
            self._progress(len(self.history), self._expected(), "calibrating")
            self._known[key] = self._called(values, targets)
        return self._known[key]

    def _called(self, values: Values, targets: Sequence[Target]) -> tuple[Measures, dict[str, str]]:
        assignments = [f"{key}={value!r}" for key, value in values.items()]
        names = [target.name for target in targets]
        try:
            material = self._start.with_set(assignments, self._plan.model)
        except InputError as error:
            if not self.history:
                raise  # wrong from the start
            return {name: [None] for name in names}, dict.fromkeys(names, f"rejected: {error}")
        try:
            found = self._measure(material)
        except SimulationError as error:  # a specimen that bears nothing has no measures
            why = f"the function failed ({error}); change its test"
            return {name: [None] for name in names}, dict.fromkeys(names, why)
        if not isinstance(found, Mapping):
            raise InputError(
                f"calibrate: measures = {quoted(found)}, must be a table of numbers; return "
                f"{{name: value}}"
            )
        for name in names:
            require_known("calibrate: target", name, [*found])
        numbers = {name: _number(name, found) for name in names}
        lost = [name for name, number in numbers.items() if number is None]
        why = "the function gave none; change its test"
        return {name: [number] for name, number in numbers.items()}, dict.fromkeys(lost, why)


def _number(name: str, found: Mapping[str, object]) -> float | None:
    value = found[name]
    if value is None:  # as a result has a strength that was not reached
        return None
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(
            f"calibrate: {name} = {quoted(value)}, must be a number; return a float"
        ) from None
    return number if math.isfinite(number) else None
