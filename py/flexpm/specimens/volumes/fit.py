# SPDX-License-Identifier: GPL-3.0-or-later
"""Power cells that fit the labels of voxels. Lengths in metres."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..._flexpm import (
    Solid,
    WeightedCells,
    cells_of_voxels,
    fit_labels,
    raise_levels,
    weighted_cells,
    weights_of_volumes,
)
from ...arrays import FloatArray, IntArray
from ...errors import InputError
from ...progress import Progress
from ..kernel_input import call
from ..label_volumes.label_volume import Labels
from .grid import Grid

Scores = tuple[FloatArray, FloatArray]
#: Widths of the soft maximum, in the side of a voxel times the mean radius of a region [-].
_TEMPERATURES = (1.0, 0.25, 0.0625)
#: Most voxels of a region in the fit: at its boundary, and of every tenth one inside.
_MOST_AT_BOUNDARY, _MOST_INSIDE, _TENTH = 400, 100, 10
#: Most rounds of larger weights of regions that lost this share of their voxels against the start
#: [-], and the factor on their weights.
_ROUNDS, _LOST, _WEIGHT = 12, 0.01, 2.0
#: Rounds in a row without fewer such regions, after which no further round follows.
_PATIENCE = 3
#: Failed raises, and agreement below the best one [-], after which no further result is raised.
#: Results that are less behind are as good if they have more of the cells.
_FAILED, _BEHIND = 2, 0.01
#: Most raises of a level for each region in the mean; volumes of 60 to 90 grains need up to 16.
_RAISES = 20
#: Shares of the start in mixtures that are tried if no fit can be raised [-].
_MIXTURES = (0.25, 0.5, 0.75)
#: Largest relative error of exact volumes [-].
_EXACT = 1e-7


@dataclass(frozen=True, eq=False)
class Trial:
    """Power cells in a box from the origin, one for each region.

    Attributes:
        points: Rows x, y, z [m].
        weights: Weight of each point [m2].
        cells: The cells.
        found: Cell of each voxel, (z, y, x).
        stage: ``start``, the number of the stage of the fit, ``guard`` with the number of a round,
            or a mixture of one of them with the start.
        agreement: Share of the voxels that are in the cell of their region [-].
        own: The same share of each region [-].
        scores: Slopes and levels of the fit, see ``fit_labels``.
    """

    points: FloatArray
    weights: FloatArray
    cells: WeightedCells
    found: Labels
    stage: str
    agreement: float
    own: FloatArray
    scores: Scores


@dataclass(frozen=True, eq=False)
class Fitted:
    """The cells of a fit, and those it began with."""

    best: Trial
    start: Trial


def fit(grid: Grid, progress: Progress | None = None, *, exact: bool = False) -> Fitted:
    """Fit a power cell to each region of a grid.

    The start has the centroids and the radii of the regions. Three stages of a softer to a sharper
    fit follow. Then rounds follow in which regions that have fewer voxels than at the start, or
    none, get a larger and larger weight. Levels are raised until no region has fewer voxels in
    its cell than at the start. The result with most voxels in the cells of their regions is taken,
    the start included, or one with nearly as many in which fewer regions have no voxel.

    Args:
        grid: The regions, two or more.
        progress: Receives the stages.
        exact: Change the weights until each cell has the volume of its region; regions may then
            have fewer voxels than at the start.

    Returns:
        The cells.

    Raises:
        InputError: if a region loses its cell and volumes are to be exact.
    """
    problem = _Problem.of(grid)
    start = problem.start()
    trials = list(_trials(problem, start, progress))
    best = _best_raised(problem, start, trials)
    if best is start and max(trials, key=_agreement).agreement > start.agreement:
        mixtures = [problem.mixture(trials[-1], start, share) for share in _MIXTURES]
        best = _best_raised(problem, start, mixtures)
    if exact:
        best = _with_volumes(problem, best)
    return Fitted(best, start)


def _agreement(trial: Trial) -> float:
    return trial.agreement


def _trials(problem: _Problem, start: Trial, progress: Progress | None) -> Iterator[Trial]:
    """Fit in stages, then with more and more weight of the regions that lost their voxels."""
    cells = f"fit of {problem.grid.count} cells"
    steps = len(_TEMPERATURES) + 1
    here, scores = start, start.scores
    for stage, width in enumerate(_TEMPERATURES, start=1):
        if progress is not None:
            progress(stage - 1, steps, f"{cells}, stage {stage}")
        trial = problem.fitted(scores, width, str(stage))
        scores = trial.scores
        here = max(here, trial, key=_agreement)
        yield trial
    factors, fewest, vain = np.ones(problem.grid.count), problem.grid.count, 0
    for number in range(1, _ROUNDS + 1):
        lost = (start.own - here.own > _LOST) | (here.own == 0.0)
        vain = 0 if lost.sum() < fewest else vain + 1
        fewest = min(fewest, int(lost.sum()))
        if here is start or not lost.any() or vain == _PATIENCE:
            return
        if progress is not None:
            progress(steps - 1, steps, f"{cells}, {lost.sum()} worse than at first, round {number}")
        factors[lost] *= _WEIGHT
        here = problem.fitted(here.scores, _TEMPERATURES[-1], f"guard {number}", factors)
        yield here


def _best_raised(problem: _Problem, start: Trial, trials: list[Trial]) -> Trial:
    """Return the best of the trials once they are raised, or the start.

    Trials with fewest regions that are worse than at the start come first. The search ends when
    raises fail, which takes longest, or when trials are well behind the best one. Of trials that
    are not well behind, the one with fewest regions without a voxel is taken.
    """
    found, failed, most = [start], 0, start.agreement
    for trial in sorted(trials, key=lambda one: np.count_nonzero(one.own < start.own)):
        raised = problem.raised(trial, start)
        if raised is start:
            failed += 1
        elif raised.agreement < most - _BEHIND:
            break
        found.append(raised)
        most = max(most, raised.agreement)
        if failed == _FAILED:
            break
    near = [trial for trial in found if trial.agreement >= most - _BEHIND]
    return min(near, key=lambda trial: (np.count_nonzero(trial.own == 0.0), -trial.agreement))


@dataclass(frozen=True, eq=False)
class _Problem:
    """Voxels of the fit, and what they are fitted with."""

    grid: Grid
    solid: Solid
    centroids: FloatArray
    radii: FloatArray
    samples: tuple[FloatArray, IntArray, FloatArray]
    rivals: tuple[IntArray, IntArray]

    @classmethod
    def of(cls, grid: Grid) -> _Problem:
        radii = np.cbrt(0.75 / np.pi * grid.voxel * grid.voxels())
        solid = Solid.box(*grid.sizes.tolist())
        rivals = _rivals(grid.neighbours(), grid.count)
        centroids = _apart(grid.centroids(), 1e-3 * float(np.cbrt(grid.voxel)))
        return cls(grid, solid, centroids, radii, _samples(grid), rivals)

    def start(self) -> Trial:
        """Cells of the centroids, with the radii of balls of the regions' volumes.

        Distances are measured by the shape that the regions have in the mean, so that grains which
        are all elongated one way begin as well as round ones.
        """
        metric = self.grid.metric(self.centroids)
        # (x - c) M (x - c) - R^2, up to x M x, as a linear score seen from the centroid
        slopes = np.sum(self.centroids[:, :, None] * metric, axis=1)
        levels = np.sum(slopes * self.centroids, axis=1) + self.radii**2
        return self._measured((slopes, levels), "start")

    def fitted(
        self, scores: Scores, width: float, stage: str, factors: FloatArray | None = None
    ) -> Trial:
        """Fit from scores, with a factor on the weights of the voxels of each region."""
        points, labels, weights = self.samples
        if factors is not None:
            weights = weights * factors[labels]
        size = float(self.radii.mean())
        options = (width * float(np.cbrt(self.grid.voxel)) * size, size)
        start = (self.centroids, *scores)
        found = call(fit_labels, (points, labels, weights), self.rivals, start, options)
        return self._measured(found, stage)

    def raised(self, trial: Trial, start: Trial) -> Trial:
        """Raise levels until no region has fewer voxels than at the start; else return the start.

        A region whose level rises gets voxels from its neighbours, which gained most of them from
        it before.
        """
        if (trial.own >= start.own).all():
            return trial
        grid = self.grid
        box = np.vstack((grid.spacing, np.zeros(3)))
        voxels = (grid.counts, box, grid.regions.ravel(), grid.grains)
        least = np.rint(start.own * grid.voxels()).astype(np.int32)
        slopes, levels = trial.scores
        scores = (self.centroids, slopes, levels)
        levels, reached = call(raise_levels, voxels, self.rivals, scores, least, _RAISES)
        if not reached:
            return start
        # a region that is no rival may have taken a voxel
        found = self._measured((slopes, levels), trial.stage)
        return found if (found.own >= start.own).all() else start

    def mixture(self, trial: Trial, start: Trial, share: float) -> Trial:
        """Mix the scores of a trial with a share of those of the start."""
        (slopes, levels), (others, bases) = trial.scores, start.scores
        off, away = slopes - slopes.mean(axis=0), others - others.mean(axis=0)
        # scores may be multiplied by a number: those of the trial get the scale of the start
        factor = (1.0 - share) * float(np.sqrt(np.sum(away * away) / np.sum(off * off)))
        mixed = (factor * slopes + share * others, factor * levels + share * bases)
        return self._measured(mixed, f"{trial.stage} with {share:g} of start")

    def _measured(self, scores: Scores, stage: str) -> Trial:
        """Make the cells of scores."""
        slopes, levels = scores
        # scores may be multiplied by a number and get a linear function without a change of a
        # cell: points come near to the centroids, far from the points that close the cells
        middle = self.centroids.mean(axis=0)
        off, away = slopes - slopes.mean(axis=0), self.centroids - middle
        # a negative factor would turn the order of the scores
        factor = float(np.sum(off * away) / np.sum(off * off))
        if not factor > 0.0:
            factor = float(np.sqrt(np.sum(away * away) / np.sum(off * off)))
        points = factor * off + middle
        weights = factor * (levels - 2.0 * np.sum(slopes * self.centroids, axis=1))
        weights += np.sum(points**2, axis=1)
        return self.of_points(points, weights, scores, stage)

    def of_points(
        self, points: FloatArray, weights: FloatArray, scores: Scores, stage: str
    ) -> Trial:
        """Count the voxels in the cells of their regions."""
        grid = self.grid
        cells = call(weighted_cells, points, weights, self.solid)
        box = np.vstack((grid.spacing, np.zeros(3)))
        found = call(cells_of_voxels, points, weights, cells, grid.counts, box)
        found = found.reshape(grid.regions.shape)
        right = np.bincount(grid.regions[grid.agrees(found)], minlength=grid.count)
        whole = float(right.sum() / grid.regions.size)
        return Trial(points, weights, cells, found, stage, whole, right / grid.voxels(), scores)


def _with_volumes(problem: _Problem, best: Trial) -> Trial:
    lost = np.flatnonzero(best.cells.volumes <= 0.0)
    if len(lost):
        raise InputError(
            f"Specimen.from_label_volume: volumes = exact, {len(lost)} grains have no cell after "
            "the fit; raise least_voxels or use fitted volumes"
        )
    voxels = problem.grid.voxels()
    volumes = voxels * (problem.solid.volume / voxels.sum())
    weights = call(weights_of_volumes, best.points, best.weights, problem.solid, volumes, _EXACT)
    return problem.of_points(best.points, weights, best.scores, best.stage)


def _apart(points: FloatArray, distance: float) -> FloatArray:
    """Move points that are in one place, such as centroids of a grain and its shell, apart."""
    _, first, number = np.unique(points, axis=0, return_index=True, return_inverse=True)
    same = np.flatnonzero(first[number] != np.arange(len(points)))
    moved = points.copy()
    moved[same, 0] += distance * (1 + np.arange(len(same)))
    return moved


def _samples(grid: Grid) -> tuple[FloatArray, IntArray, FloatArray]:
    """Return the points, regions and weights of the voxels of the fit.

    Voxels of a region are taken at equal distances in their order. Those at the boundary stand for
    all of them, those inside for every tenth one.
    """
    boundary = grid.at_boundary().ravel()
    order = np.argsort(grid.regions.ravel(), kind="stable")
    chosen, weights = [], []
    for rows, most, share in (
        (order[boundary[order]], _MOST_AT_BOUNDARY, 1),
        (order[~boundary[order]], _MOST_INSIDE, _TENTH),
    ):
        regions = grid.regions.ravel()[rows]
        there = np.bincount(regions, minlength=grid.count)
        taken = np.minimum(-(-there // share), most)
        firsts = np.cumsum(there) - there
        owner = np.repeat(np.arange(grid.count), taken)
        place = np.arange(len(owner)) - np.repeat(np.cumsum(taken) - taken, taken)
        chosen.append(rows[firsts[owner] + place * there[owner] // taken[owner]])
        weights.append(there[owner] / (share * taken[owner]))
    voxels = np.concatenate(chosen)
    z, y, x = np.unravel_index(voxels, grid.regions.shape)
    points = (np.column_stack((x, y, z)) + 0.5) * grid.spacing
    labels = grid.regions.ravel()[voxels].astype(np.int32)
    return np.ascontiguousarray(points), labels, np.concatenate(weights)


def _rivals(pairs: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Return the regions within two rings of neighbours of each region, itself included."""
    from scipy.sparse import coo_array, identity

    ones = np.ones(len(pairs), dtype=np.int32)
    half = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    ring = (half + half.T + identity(count, dtype=np.int32)).tocsr()
    both = (ring @ ring).tocsr()
    both.sort_indices()
    return both.indptr.astype(np.int32), both.indices.astype(np.int32)


def edges_of(cells: WeightedCells) -> npt.NDArray[np.int32]:
    """Pairs of cells that share a face, rows of two, the lower one first."""
    pairs = cells.faces[0]
    found: npt.NDArray[np.int32] = np.unique(pairs[pairs[:, 1] >= 0], axis=0)
    return found
