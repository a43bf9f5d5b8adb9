# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibration of a material to the measures of a rock. SI units, degrees.

Elastic keys are fitted first, by the elastic solution; keys that are tied to the elastic targets
are fitted again for each set of the other keys. Strength keys follow by DFO-LS, a trust-region
method for least squares without derivatives, on few packings of a small specimen. The best sets are
verified on other packings of the full specimen. The difference between small and full specimens
corrects the targets of the next round. Strength keys are searched as logarithms.

All runs are jobs of :mod:`flexpm.jobs`: a calibration that was stopped repeats the same search, but
finds the runs that were finished, also on another machine.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Unpack

import numpy as np
import pandas
from scipy.optimize import least_squares

from .._vendor import on_path
from ..arrays import FloatArray
from ..errors import InputError
from ..files import Table, output_folder
from ..kinds.registry import ELASTIC
from ..materials.keys import is_used
from ..progress import Progress
from . import jobs
from .calibration_losses import loss
from .calibration_measures import ELASTIC_MEASURES, Run
from .calibration_problem import Calibration, Runs, Target
from .calibration_verdict import Verdict, is_met, judge
from .finished_runs import FinishedRuns
from .jobs import Job
from .pool import Pool, PoolOptions
from .tables import write_table

#: Residual of a measure that a run has not given, in tolerances.
_MISSING = 20.0
#: First step of the strength search: change of a key by about this factor less one [-].
_FIRST_STEP = 0.10
#: The search ends when its step is below this [-].
_LAST_STEP = 0.005
#: The search ends when the root mean square of the residuals is below this, in tolerances.
_GOOD = 0.2
#: Relative step for the derivatives of the elastic solve; it is smooth.
_ELASTIC_STEP = 0.01
#: Slope of the elastic cost over factors of the keys, at which a modulus is off by less than a
#: hundredth of its tolerance.
_ELASTIC_SLOPE = 0.1

#: Steps of the elastic fit, each with a set for each key, as a calibration usually has.
ELASTIC_FITS = 3

Values = dict[str, float]
#: By measure one value a packing; None: it has none.
Measures = dict[str, list[float | None]]


@dataclass
class Evaluation:
    """Measures of one set of free keys."""

    round: int
    stage: str  #: elastic, tied, screen or verify
    values: Values
    measures: Measures
    targets: dict[str, float]  #: what the measures were compared with
    cost: float  #: half the sum of the squared residuals [-]
    #: by measure why packings have none, and what to change
    lost: dict[str, str] = field(default_factory=dict)

    def mean(self, name: str) -> float | None:
        """Return the mean of a measure over the packings; None if it is missing for a packing."""
        found = self._complete(name)
        return None if found is None else float(np.mean(found))

    def spread(self, name: str) -> float | None:
        """Standard deviation over the packings."""
        found = self._complete(name)
        return None if found is None or len(found) < 2 else float(np.std(found, ddof=1))

    def error(self, name: str) -> float | None:
        """Standard error of the mean."""
        spread = self.spread(name)
        return None if spread is None else spread / math.sqrt(len(self.measures[name]))

    def _complete(self, name: str) -> list[float] | None:
        found = [value for value in self.measures[name] if value is not None]
        return found if len(found) == len(self.measures[name]) else None


@dataclass
class Outcome:
    """The best verified set and the way to it."""

    best: Evaluation
    met: dict[str, bool]  #: whether the mean of each target is within its tolerance
    history: list[Evaluation] = field(default_factory=list)
    verdict: Verdict = field(default_factory=lambda: Verdict([], []))


def run(
    plan: Calibration,
    out: Path | str,
    *,
    start: Mapping[str, object],
    progress: Progress | None = None,
    **pool_options: Unpack[PoolOptions],
) -> Outcome:
    """Run a calibration.

    Args:
        plan: Targets, free keys and runs.
        out: Folder; ``runs`` has the runs, ``history.csv`` all sets that were tried.
        start: Present values of the free keys in the material; a value outside its bounds starts at
            the nearer bound.
        progress: Function that is called when a set has been evaluated.
        pool_options: ``workers``, ``scheduler``, ``cluster`` as for a study.

    Raises:
        InputError: if a key has no number to start from, and no target determines it.
    """
    folder = output_folder(out)
    values = {key: started(plan, key, start) for key in plan.free}
    for runs in (plan.screen, plan.verify):
        jobs_of(plan, runs, values, plan.targets)  # refuses what no run could do
    with Pool(folder / "runs", **pool_options) as pool:
        make = FinishedRuns(folder / "runs").job
        search = Search(plan, pool, progress or (lambda *_: None), make)
        try:
            values |= search.elastic(values)
            best = search.strengths(values)
        finally:
            if search.history:
                write_table(history_table(search.history), folder / "history")
    met = {t.name: is_met(t, best.mean(t.name)) for t in plan.targets}
    return Outcome(best, met, search.history, judged(plan, best, search.history))


def judged(plan: Calibration, best: Evaluation, history: Sequence[Evaluation]) -> Verdict:
    """Judge the set that was taken of all that were tried."""
    parts = []
    for elastic, stage in ((True, "elastic"), (False, "screen")):
        targets, keys = plan.of_kind(elastic=elastic)
        sets = [e for e in history if e.stage == stage]
        if elastic:  # other elastic keys stand still in a fit of the tied ones
            others = [key for key in plan.elastic_keys if key not in keys]
            sets = [e for e in sets if all(e.values[key] == best.values[key] for key in others)]
        parts.append((sets, keys, targets))
    tried = [e for e in history if (e.stage, e.round) == ("screen", history[-1].round)]
    return judge(plan.targets, plan.free, parts, best, used_up=len(tried) > plan.evaluations)


def history_table(history: Sequence[Evaluation]) -> pandas.DataFrame:
    """One row an evaluation: round, stage, cost, values, means and spreads of the measures."""
    return pandas.DataFrame(
        {
            "round": e.round,
            "stage": e.stage,
            "cost": e.cost,
            **e.values,
            **{f"{name} mean": e.mean(name) for name in e.measures},
            **{f"{name} spread": e.spread(name) for name in e.measures},
        }
        for e in history
    )


class Search:
    """State of a calibration: the round, all tried sets, the pool of runs if it has runs."""

    def __init__(
        self,
        plan: Calibration,
        pool: Pool | None,
        progress: Progress,
        make: Callable[[Table, Path], Job] = jobs.make,
    ) -> None:
        self._plan, self._pool, self._progress = plan, pool, progress
        self._make = make
        self._round = 1
        self._tied: Values = {}
        if plan.of_kind(elastic=False)[1]:
            _optimiser()  # before the first run: a search that could not go on would cost minutes
        self.history: list[Evaluation] = []

    def elastic(self, values: Values, stage: str = "elastic") -> Values:
        """Keys of the elastic fit that meet the elastic targets.

        Args:
            values: Values of all free keys; the fit starts from them.
            stage: ``elastic`` for the verification's packings, ``tied`` for those of the search.
        """
        targets, keys = self._plan.of_kind(elastic=True)
        if not keys:
            return {}
        if not targets:
            raise InputError(
                f"calibration [free] {keys[0]}: no elastic target determines it; remove it"
            )
        start = np.array([values[key] for key in keys])
        bounds = np.array([self._plan.free[key] for key in keys]).T

        def residuals(factors: FloatArray) -> FloatArray:
            tried = {**values, **dict(zip(keys, (factors * start).tolist(), strict=True))}
            return self._residuals(self._evaluate(stage, tried, targets), targets)

        found = least_squares(
            residuals,
            np.ones(len(keys)),
            bounds=tuple(bounds / start),
            diff_step=_ELASTIC_STEP,
            xtol=1e-4,
            ftol=1e-6,
            gtol=_ELASTIC_SLOPE,
        )
        return dict(zip(keys, (found.x * start).tolist(), strict=True))

    def strengths(self, values: Values) -> Evaluation:
        """Return the set with the least verified cost; sets with all measures come first."""
        targets, keys = self._plan.of_kind(elastic=False)
        if not keys or not targets:
            return self._verify(values)
        verified: list[Evaluation] = []
        aims = targets
        for number in range(1, self._plan.rounds + 1):
            self._round = number
            tried = self._screen(values, keys, aims)
            best = [self._verify(self._retied(e.values)) for e in tried[: self._plan.candidates]]
            verified += best
            if self._plan.rounds == 1 or all(is_met(t, best[0].mean(t.name)) for t in targets):
                break
            aims = [
                t
                if t.name in ELASTIC_MEASURES  # met on small and on full specimens
                else t.corrected(tried[0].mean(t.name), best[0].mean(t.name))
                for t in targets
            ]
            values = tried[0].values
        complete = [e for e in verified if all(e.mean(t.name) is not None for t in targets)]
        return min(complete or verified, key=lambda e: e.cost)

    def _screen(self, values: Values, keys: list[str], aims: list[Target]) -> list[Evaluation]:
        """Search on the small specimen; return all tried sets, the best set first."""
        # its restarts draw from here, and a second start must try the same sets
        np.random.seed(0)  # noqa: NPY002
        first = len(self.history)
        values = self._guess(values, keys, aims)
        bounds = np.log([self._plan.free[key] for key in keys]).T
        width = bounds[1] - bounds[0]

        def residuals(unit: FloatArray) -> FloatArray:
            logs = bounds[0] + width * unit
            tried = {**values, **dict(zip(keys, np.exp(logs).tolist(), strict=True))}
            tried = self._retied(tried, "tied")
            return self._residuals(self._evaluate("screen", tried, aims), aims)

        start = (np.log([values[key] for key in keys]) - bounds[0]) / width
        step = math.log1p(_FIRST_STEP) / float(np.median(width))
        with warnings.catch_warnings():
            # a start that breaks a ratio is moved, which is what is wanted
            warnings.filterwarnings("ignore", "x0 not feasible", RuntimeWarning)
            _optimiser().solve(
                residuals,
                np.clip(start, step, 1.0 - step),
                bounds=(np.zeros(len(keys)), np.ones(len(keys))),
                projections=self._projections(keys, bounds),
                rhobeg=step,
                rhoend=step * _LAST_STEP / _FIRST_STEP,
                maxfun=self._plan.evaluations,
                objfun_has_noise=True,  # strengths of a packing are no smooth functions of the keys
                user_params={"model.abs_tol": len(aims) * _GOOD**2},
                do_logging=False,
                print_progress=False,
            )
        tried = [e for e in self.history[first:] if e.stage == "screen"]
        return sorted(tried, key=lambda e: e.cost)

    def _retied(self, values: Values, stage: str = "elastic") -> Values:
        """Return the values with the tied keys that meet the elastic targets.

        A fit starts from the one before, of a set that is usually near.
        """
        if self._plan.tied:
            self._tied = self.elastic({**values, **self._tied}, stage)
        return {**values, **self._tied}

    def _guess(self, values: Values, keys: list[str], aims: list[Target]) -> Values:
        """Return the start of the search, from the measures that strengths and friction govern."""
        governed = {
            "tensile_strength": ("indirect_tensile_strength", "direct_tensile_strength"),
            "cohesion": ("compressive_strength", "hoek_brown_strength", "cohesion"),
            "friction": ("friction_angle",),
        }
        found = self._evaluate("screen", values, aims)
        guess = dict(values)
        for key, names in governed.items():
            name = next((n for n in names if n in found.measures), None)
            mean = None if name is None else found.mean(name)
            if key not in keys or name is None or mean is None:
                continue
            factor = found.targets[name] / mean
            low, high = self._plan.free[key]
            guess[key] = float(np.clip(values[key] * factor, low, high))
        return guess

    def _projections(
        self, keys: list[str], bounds: FloatArray
    ) -> list[Callable[[FloatArray], FloatArray]] | None:
        """Return projections of the unit box on the permitted ratios: half-spaces of logarithms."""
        width = bounds[1] - bounds[0]

        def projection(normal: FloatArray, limit: float) -> Callable[[FloatArray], FloatArray]:
            square = float(normal @ normal)
            return lambda x: x - max(float(normal @ x) - limit, 0.0) / square * normal

        made: list[Callable[[FloatArray], FloatArray]] = []
        for ratio in self._plan.ratios:
            if ratio.of not in keys or ratio.to not in keys:
                continue
            of, to = keys.index(ratio.of), keys.index(ratio.to)
            normal = np.zeros(len(keys))
            normal[of], normal[to] = width[of], -width[to]
            offset = bounds[0][of] - bounds[0][to]
            low, high = np.log(ratio.bounds) - offset
            made += [projection(normal, high), projection(-normal, -low)]
        return made or None

    def _verify(self, values: Values) -> Evaluation:
        return self._evaluate("verify", values, self._plan.targets)

    def _evaluate(self, stage: str, values: Values, targets: Sequence[Target]) -> Evaluation:
        """Run all tests that the targets need with a set of free keys."""
        plan = self._plan
        runs = plan.verify if stage in ("elastic", "verify") else plan.screen
        measures, lost = self._measures(runs, values, targets)
        aims = {t.name: t.value for t in targets}
        evaluation = Evaluation(self._round, stage, dict(values), measures, aims, 0.0, lost)
        evaluation.cost = 0.5 * float(np.sum(self._residuals(evaluation, targets) ** 2))
        self.history.append(evaluation)
        return evaluation

    def _measures(
        self, runs: Runs, values: Values, targets: Sequence[Target]
    ) -> tuple[Measures, dict[str, str]]:
        """Return values of each measure, one per packing, and reasons for missing values."""
        plan = self._plan
        try:
            wanted = jobs_of(plan, runs, values, targets, self._make)
        except InputError as error:
            if not self.history:
                raise  # wrong from the start
            # keys that do not go together
            nothing: Measures = {t.name: [None] * len(runs.seeds_of(t)) for t in targets}
            return nothing, {t.name: f"rejected: {error}" for t in targets}
        done = len(self.history)
        assert self._pool is not None
        outcomes = self._pool.run(
            [*wanted.values()],
            lambda d, n, text: self._progress(
                done + d / n, self._expected(), f"round {self._round}"
            ),
        )
        found: dict[int, dict[Run, Table]] = defaultdict(dict)
        ended: dict[int, dict[Run, Table]] = defaultdict(dict)
        for (seed, test), outcome in zip(wanted, outcomes, strict=True):
            found[seed][test], ended[seed][test] = outcome["result"], outcome
        measures = {t.name: [plan.measure(t, found[s]) for s in runs.seeds_of(t)] for t in targets}
        lost = [t for t in targets if None in measures[t.name]]
        return measures, {t.name: loss(plan, t, ended, runs.seeds_of(t)) for t in lost}

    def _expected(self) -> int:
        """Return the largest number of sets: sets of the elastic fit, then sets of all rounds.

        A round has its start, the search and the verified sets.
        """
        plan = self._plan
        targets, keys = plan.of_kind(elastic=False)
        if not (keys and targets):
            return self._elastic_sets() + 1
        tied = 1 + (ELASTIC_FITS * (1 + len(plan.tied)) if plan.tied else 0)
        sets = tied * (plan.evaluations + plan.candidates)
        return self._elastic_sets() + plan.rounds * (1 + sets)

    def _elastic_sets(self) -> int:
        """Sets of the elastic fit: those that were tried once it is over, before an estimate."""
        keys = self._plan.of_kind(elastic=True)[1]
        tried = sum(1 for _ in itertools.takewhile(lambda e: e.stage == "elastic", self.history))
        over = tried < len(self.history)
        return tried if over or not keys else max(tried + 1, ELASTIC_FITS * (len(keys) + 1))

    @staticmethod
    def _residuals(evaluation: Evaluation, targets: Sequence[Target]) -> FloatArray:
        means = [evaluation.mean(t.name) for t in targets]
        return np.array(
            [
                _MISSING if mean is None else t.residual(mean)
                for t, mean in zip(targets, means, strict=True)
            ]
        )


def jobs_of(
    plan: Calibration,
    runs: Runs,
    values: Values,
    targets: Sequence[Target],
    make: Callable[[Table, Path], Job] = jobs.make,
) -> dict[tuple[int, Run], Job]:
    """Return the runs that the targets need, by seed and test with its confining pressure [Pa]."""
    material = {} if plan.material is None else {"material": plan.material}
    common = {**runs.options, **material, "model": plan.model}

    def keys_of(test: str) -> Table:  # an elastic solve that is there serves other strengths
        used = plan.elastic_keys if test == ELASTIC else values
        return {f"set.{key}": values[key] for key in used}

    wanted = {
        (seed, test): None for t in targets for seed in runs.seeds_of(t) for test in plan.tests(t)
    }
    return {
        (seed, (test, confinement)): make(
            {
                **{**common, **keys_of(test), **plan.ends((test, confinement))},
                **runs.of_test.get(test, {}),
                **{"test": test, "confinement": confinement, "seed": seed},
            },
            plan.base,
        )
        for seed, (test, confinement) in wanted
    }


def _optimiser() -> ModuleType:
    on_path()
    try:
        import dfols
    except ImportError:
        raise ImportError(
            "calibrate: dfols is missing; run scripts/setup, or install DFO-LS from PyPI"
        ) from None
    module: ModuleType = dfols
    return module


def started(plan: Calibration, key: str, start: Mapping[str, object]) -> float:
    """Value of a key from which the search starts, within its bounds."""
    if not is_used(key, plan.model):
        raise InputError(f"calibration [free] {key}, is not used by model {plan.model}; remove it")
    low, high = plan.free[key]
    value = start.get(key)
    if not isinstance(value, int | float) or not math.isfinite(value):
        raise InputError(
            f"calibration [free] {key} = {value} at the start, must be a number; give the material "
            f"one between {low:g} and {high:g}"
        )
    return float(min(max(value, low), high))
