# SPDX-License-Identifier: GPL-3.0-or-later
"""Several models, or one model under several confining pressures, on one packing. SI units.

Each run is a complete run in a folder of its own. The runs follow each other in this process: a run
resets YADE's scene, so nothing passes from one run to the next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar, Unpack

from ..dimensions import is_solid
from ..errors import InputError, SimulationError
from ..files import Table, csv_text, output_folder, write_text
from ..laboratory.carrying_out import carry_out
from ..laboratory.plan import plan_run
from ..materials.material import Material, default_name
from ..materials.material import load as load_material
from ..materials.references import Reference, reference_of
from ..progress import Progress
from ..report.comparison import cracks_picture, curves_picture, envelope_picture
from ..report.tables import columns, scaled
from ..report.words import Shown, words_of_test
from ..results.result import Result
from ..results.strength import Envelope
from ..runs.checkpoint import INTERVAL
from ..runs.groups import SharedOptions, options_of
from ..runs.input_names import ranges
from ..runs.output import Output
from ..runs.run_spec import RunSpec
from ..specimens.specimen import AnySpecimen, require_specimen
from ..text import name_of
from .jobs import place_of

#: Columns of compare.csv before the numbers of the result.
_FIRST = ("model", "material", "confinement", "folder")


Value = TypeVar("Value", str, float)


@dataclass
class Case:
    """One run of a comparison."""

    spec: RunSpec
    material: Material
    folder: Path | None = None
    result: Result | None = None  #: None if the run failed before it had one
    error: str = ""  #: why it failed

    @property
    def model(self) -> str:
        """Name of the model."""
        return self.spec.model

    @property
    def confinement(self) -> float:
        """Confining pressure [Pa]."""
        return self.spec.confinement

    @property
    def name(self) -> str:
        """Model, and the confining pressure of a biaxial test."""
        pressure = f" {1e-6 * self.confinement:g} MPa" if self.spec.kind.confined else ""
        return f"{self.model}{pressure}"

    @property
    def peak(self) -> float | None:
        """Largest axial stress [Pa]; None without a peak."""
        return None if self.result is None else self.result.peak_stress

    @property
    def status(self) -> str:
        """Status of the result; ``failed`` without a result."""
        return "failed" if self.result is None else self.result.status

    @property
    def failed(self) -> bool:
        """Whether the run has no strength."""
        return self.result is None or self.result.failed


@dataclass
class Comparison:
    """Outcome of a comparison, model by model, each in the order of the confining pressures."""

    test: str
    cases: list[Case]
    envelopes: list[Envelope] = field(default_factory=list)

    @property
    def reference(self) -> Reference | None:
        """Measured properties of the rock that the material is named after."""
        return reference_of(self.cases[0].material.name)

    @property
    def results(self) -> list[Result]:
        """Results of all runs that have a result."""
        return [case.result for case in self.cases if case.result is not None]

    def write(self, folder: Path | str) -> None:
        """Write tables and pictures into `folder`, each file completely or not at all."""
        folder = output_folder(folder)
        write_text(folder / "compare.csv", _table([_row(case) for case in self.cases]))
        shown = [(case.name, case.result) for case in self.cases if case.result]
        if shown:
            curves_picture(folder / "compare.png", shown)
            cracks_picture(folder / "cracks.png", shown)
        if self.envelopes:
            write_text(folder / "envelope.csv", _table([one.as_dict() for one in self.envelopes]))
            runs = [(one.confinement, one.peak, one.status) for one in self.cases]
            title = f"{self.test}, {name_of(self.cases[0].material.name)}, one packing"
            picture = folder / "envelope.png"
            envelope_picture(picture, self.envelopes, self.reference, title, runs)


def compare(
    test: str,
    specimen: AnySpecimen,
    models: Sequence[str] = ("flexible", "rigid"),
    material: Material | str | Mapping[str, Material | str] | None = None,
    *,
    confinements: Sequence[float] = (0.0,),
    out: Path | str | None = None,
    progress: Progress | None = None,
    threads: int = 1,
    checkpoint_interval: float = INTERVAL,
    **options: Unpack[SharedOptions],
) -> Comparison:
    """Run a test with several models, or under several confining pressures, on one packing.

    All inputs are checked before the first run. A run that fails does not stop the others. With
    `out`, finished runs in that folder are reused and interrupted runs resume, as with
    :func:`flexpm.run`.

    Args:
        test: Name of the test, as for :func:`flexpm.run`.
        specimen: The bonded grains.
        models: Names of models.
        material: Name of a preset, TOML file, or material; or a mapping from the name of a model to
            its material. A model without a material has the default of flexible grains:
            ``augig-table7`` in 2D, ``augig3d-calibrated`` in 3D.
        confinements: Confining pressures [Pa], for ``biaxial``, ``triaxial`` and ``punch``; an
            envelope needs two or more.
        out: Folder for tables and pictures, with a folder for each run; None writes no files.
        progress: Function that is called with (steps done, steps expected, text).
        threads: Number of threads of a step; results do not depend on it.
        checkpoint_interval: Wall time between two checkpoints [s], > 0.
        options: Keywords of :func:`flexpm.run`, for all runs.

    Returns:
        The results and the strength envelopes.

    Raises:
        InputError: for an argument that is wrong for any of the runs.

    Example:
        >>> found = flexpm.compare("tension", specimen, ["flexible", "rigid"], rate=6.0)
        >>> for case in found.cases:
        ...     print(f"{case.name}: {case.peak / 1e6:.1f} MPa")
        flexible: 9.3 MPa
        rigid: 7.4 MPa
    """
    require_specimen("compare", specimen)
    folder = None if out is None else output_folder(out)
    shared: Table = {name: value for name, value in options.items() if value is not None}
    report = bool(shared.pop("report", True))
    given = {name: shared.pop(name) for name in options_of(Output) if name in shared}
    output = Output(**{"report": False, **given})
    farthest = ranges(models, shared.pop("interaction_range", None))
    cases = [
        Case(
            RunSpec.asked(
                test,
                specimen.spec,
                chosen,
                {
                    "model": model,
                    "confinement": confinement,
                    "interaction_range": farthest[model],
                    **shared,
                },
            ),
            chosen,
        )
        for model, chosen in _materials(models, material, is_solid(specimen.spec.kind)).items()
        for confinement in _each_once("confinements", confinements)
    ]
    if folder is not None:
        _give_folders(cases, folder)
    plans = [
        plan_run(case.spec, specimen, case.material, case.folder, checkpoint_interval, output)
        for case in cases
    ]
    for number, (case, plan) in enumerate(zip(cases, plans, strict=True), 1):
        show = _named(progress, f"{number}/{len(cases)} {case.name}")
        try:
            case.result = carry_out(plan, threads=threads, progress=show)
        except SimulationError as error:
            case.error = str(error)
    found = Comparison(test, cases, _envelopes(cases))
    if folder is not None:
        found.write(folder)
        if report:
            from . import pages  # what draws them loads long

            pages.write(folder)
    return found


def table(cases: Sequence[Case]) -> str:
    """One line for each run of a comparison."""
    shown = words_of_test(cases[0].spec.test).shown
    header = ("run", *(one.heading for one in shown.values()), "fragments")
    rows: list[tuple[str, ...]] = []
    for case in cases:
        found = case.result
        if found is None:
            rows.append((case.name, *["-"] * (len(header) - 1), "failed"))
            continue
        numbers = (_cell(getattr(found, name), one) for name, one in shown.items())
        rows.append((case.name, *numbers, str(found.fragments), found.status))
    drawn = columns((*header, "status"), rows)
    farther = {case.model: case.spec.interaction_range for case in cases}
    for model, reach in farther.items():
        if reach is not None:
            drawn += (
                f"\n  {model} also bonds pairs within {reach:g} (R1 + R2), more pairs than the "
                "other models"
            )
    used = {case.model: name_of(case.material.name) for case in cases}
    if len(set(used.values())) == 1:
        return f"{drawn}\n  material of all: {next(iter(used.values()))}"
    each = ", ".join(f"{model} {name}" for model, name in used.items())
    return f"{drawn}\n  materials differ: {each}"


def _cell(value: float | None, one: Shown) -> str:
    return str(value) if isinstance(value, int) else scaled(value, one.factor, "", one.digits)


def _materials(
    models: Sequence[str],
    material: Material | str | Mapping[str, Material | str] | None,
    solid: bool,
) -> dict[str, Material]:
    """Material of each model, of 3D specimens if `solid`."""
    names = _each_once("models", models)
    shared = default_name(solid=solid)
    if isinstance(material, Mapping) and set(material) <= set(names):
        return {model: load_material(material.get(model, shared), model) for model in names}
    chosen = shared if material is None else material
    return {model: load_material(chosen, model) for model in names}


def _each_once(name: str, values: Sequence[Value]) -> list[Value]:
    found = list(values)
    if not found or len(set(found)) != len(found):
        raise InputError(f"compare: {name} = {found}, must be one or more, each once; correct them")
    return found


def _give_folders(cases: Sequence[Case], folder: Path) -> None:
    """Assign each run a folder below the folder of the comparison."""
    confinements = len({case.confinement for case in cases})
    for case in cases:
        case.folder = folder / place_of(case.model, case.confinement, confinements)


def _envelopes(cases: Sequence[Case]) -> list[Envelope]:
    found = []
    for model in dict.fromkeys(case.model for case in cases):
        peaks = {
            case.confinement: case.result.peak_stress
            for case in cases
            if case.model == model and case.result and case.result.peak_stress is not None
        }
        if len(peaks) > 1:
            found.append(Envelope.of(model, list(peaks), list(peaks.values())))
    return found


def _named(progress: Progress | None, name: str) -> Progress | None:
    if progress is None:
        return None
    return lambda done, expected, text: progress(done, expected, f"{name}: {text}")


def _row(case: Case) -> Table:
    """Inputs of a run, then all numbers of its result."""
    row: Table = {
        "model": case.model,
        "material": case.material.name,
        "confinement": case.confinement,
        "folder": str(case.folder or ""),
    }
    if case.result is None:
        return row | {"test": case.spec.test, "status": "failed"}
    numbers = case.result.as_dict()
    hidden = (*_FIRST, "inputs", "warnings", "rates", "null_reasons")
    return row | {key: value for key, value in numbers.items() if key not in hidden}


def _table(rows: Sequence[Table]) -> str:
    names = list(dict.fromkeys(name for row in rows for name in row))
    return csv_text(names, ([row.get(name) for name in names] for row in rows))
