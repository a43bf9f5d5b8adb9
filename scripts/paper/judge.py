# SPDX-License-Identifier: GPL-3.0-or-later
"""How statements of the paper are judged: relative differences on the same packings.

The relative difference of two models, or of the ends of a sweep, has a mean and a standard error
over the seeds at each point of a study. It holds where the mean is above the error and is against
where it is below minus the error; a statement is reproduced if it holds at all points. Where it
is neither, the number of packings is told that would bring the error down to the mean. All judges
take a table with a row for each point and seed, and give a verdict with its numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import pandas

NOT_RUN = "not run"
#: What judges say; "not reproduced" stands before "reproduced", which is a part of it.
VERDICTS = ("not reproduced", "reproduced", "in part", "within scatter", "not judged", NOT_RUN)
#: Largest relative change that is called negligible, and largest bend of a straight line [-].
LITTLE, STRAIGHT = 0.05, 0.10
#: Numbers of packings beyond which it is not told how many would decide.
MOST = 1000
#: Factor and unit in which a measure is shown.
SHOWN = {
    **dict.fromkeys(("compressive_strength", "cohesion", "direct", "indirect"), (1e-6, "MPa")),
    **dict.fromkeys(("peak_stress", "tensile_onset_stress"), (1e-6, "MPa")),
    "friction_angle": (1.0, "degrees"),
}
Where = Mapping[str, Any]
Judge = Callable[..., str]


class Points(NamedTuple):
    """Relative differences at the points of a study: mean and standard error over the seeds."""

    mean: pandas.Series
    error: pandas.Series
    packings: pandas.Series

    @classmethod
    def of(cls, differences: pandas.Series) -> Points:
        """Take the statistics of one value for each (point, seed); one packing tells nothing."""
        levels = [name for name in differences.index.names if name != "seed"]
        groups = differences.groupby(level=levels) if levels else differences.groupby(lambda _: 0)
        several = groups.count() > 1
        return cls(groups.mean()[several], groups.sem()[several], groups.count()[several])

    def would_decide(self, what: str = "") -> str:
        """How many packings would bring the error down to the mean at each point left open."""
        left = self.mean.abs() <= self.error
        if not left.any():
            return ""
        needed = (self.packings * (self.error / self.mean) ** 2)[left].max()
        return f", {_about(needed)} packings would decide{what}"

    def verdict(self) -> str:
        """Whether the differences are positive."""
        count = len(self.mean)
        if count == 0:
            return "too few packings"
        holds = int((self.mean > self.error).sum())
        against = int((self.mean < -self.error).sum())
        if holds == count:
            return "reproduced"
        if against == count:
            return "not reproduced"
        if holds == against == 0:
            return f"within scatter{self.would_decide()}"
        part = f"in part: holds at {holds} and is against at {against} of {count} points"
        return part + self.would_decide(" the rest")

    def __str__(self) -> str:
        if self.mean.empty:
            return "no point with two packings"
        low, high, error = (
            100.0 * value for value in (self.mean.min(), self.mean.max(), self.error.mean())
        )
        if len(self.mean) == 1:
            return f"{low:+.1f} ± {error:.1f} %"
        return f"{low:+.0f} to {high:+.0f} % at {len(self.mean)} points, ± {error:.1f} %"


def _about(count: float) -> str:
    """A number rounded up to one digit."""
    if not count < MOST:
        return f"more than {MOST}"
    step = 10 ** max(0, math.floor(math.log10(count)))
    return f"about {step * math.ceil(count / step)}"


def values(table: pandas.DataFrame, measure: str, where: Where, at: Sequence[str]) -> pandas.Series:
    """A measure of the rows in which the columns of `where` have its values, by (point, seed)."""
    for column, value in where.items():
        table = table[table[column] == value]
    if measure not in table:  # none of the runs that tell it has been done
        table = table.iloc[:0].assign(**{measure: 0.0})
    return table.set_index([*at, "seed"])[measure].dropna().astype(float)


def shown(measure: str, value: float) -> str:
    """A measure with its unit."""
    factor, unit = SHOWN.get(measure, (1.0, ""))
    return f"{factor * value:.3g} {unit}".strip()


def overall(told: str) -> str:
    """Verdict on a statement from what is told of its cases: that of all, or in part."""
    found = set(re.findall("|".join(VERDICTS), told))
    return found.pop() if len(found) == 1 else "in part"


def each(table: pandas.DataFrame, judge: Judge, cases: Mapping[str, Where], **given: Any) -> str:
    """Judge some named cases one by one."""
    found = {name: judge(table, where=where, **given) for name, where in cases.items()}
    if set(found.values()) == {NOT_RUN}:
        return NOT_RUN
    return ". ".join(f"{name}: {verdict}" for name, verdict in found.items())


def above(
    table: pandas.DataFrame,
    measure: str,
    more: Where,
    less: Where,
    at: Sequence[str] = (),
    where: Where | None = None,
) -> str:
    """Judge that a measure is higher in the rows `more` than in the rows `less`."""
    points, means = _difference(table, measure, more, less, at, where)
    return NOT_RUN if points is None else f"{points.verdict()}; {means}, {points}"


def alike(
    table: pandas.DataFrame, measure: str, one: Where, other: Where, where: Where | None = None
) -> str:
    """Judge that a measure differs by no more than `LITTLE`, or than the scatter."""
    points, means = _difference(table, measure, one, other, (), where)
    return NOT_RUN if points is None else f"{_little(points)}; {means}, {points}"


def grows(table: pandas.DataFrame, measure: str, x: str, at: Sequence[str], where: Where) -> str:
    """Judge that a measure grows with `x`."""
    change = _change(table, measure, x, where, at)
    if change.empty:
        return NOT_RUN
    points = Points.of(change)
    return f"{points.verdict()}; {points}"


def falls(table: pandas.DataFrame, measure: str, x: str, at: Sequence[str], where: Where) -> str:
    """Judge that a measure falls with `x`."""
    change = _change(table, measure, x, where, at)
    if change.empty:
        return NOT_RUN
    return f"{Points.of(-change).verdict()}; {Points.of(change)}"


def negligible(
    table: pandas.DataFrame, measure: str, x: str, at: Sequence[str], where: Where
) -> str:
    """Judge that `x` changes a measure by no more than `LITTLE`, or than the scatter."""
    change = _change(table, measure, x, where, at)
    if change.empty:
        return NOT_RUN
    points = Points.of(change)
    return f"{_little(points)}; {points}"


def stronger(
    table: pandas.DataFrame, measure: str, x: str, more: Where, less: Where, at: Sequence[str]
) -> str:
    """Judge that `x` changes a measure more in the rows `more` than in the rows `less`."""
    high, low = (_change(table, measure, x, where, at).abs() for where in (more, less))
    both = high.index.intersection(low.index)
    if both.empty:
        return NOT_RUN
    means = " against ".join(f"{100.0 * change[both].mean():.0f} %" for change in (high, low))
    return f"{Points.of(high[both] - low[both]).verdict()}; changes by {means}"


def straight(table: pandas.DataFrame, measure: str, x: str, at: Sequence[str], where: Where) -> str:
    """Judge that a measure is linear in `x`, by how far middle values are off the chord."""
    found = values(table, measure, where, [x, *at])
    if found.empty:
        return NOT_RUN
    found = found.unstack(x)
    means = found.groupby(level=list(at)).mean() if at else found.mean().to_frame().T
    first, last = min(means.columns), max(means.columns)
    chord = (means.columns - first) / (last - first)
    rise = means[last] - means[first]
    bend = (means.sub(means[first], axis=0).div(rise, axis=0) - chord).abs().to_numpy().max()
    word = "reproduced" if bend <= STRAIGHT else "not reproduced"
    return f"{word}; off the chord by up to {100.0 * bend:.0f} % of the rise"


def below_one(table: pandas.DataFrame, measure: str, where: Where, at: Sequence[str] = ()) -> str:
    """Judge that a quotient is below 1."""
    return _beside_one(table, measure, where, at, -1)


def above_one(table: pandas.DataFrame, measure: str, where: Where, at: Sequence[str] = ()) -> str:
    """Judge that a quotient is above 1."""
    return _beside_one(table, measure, where, at, 1)


def between(
    table: pandas.DataFrame, measure: str, ends: Sequence[Where], middle: Where, where: Where
) -> str:
    """Judge that the mean of a measure lies between those of two others."""
    means = [
        values(table, measure, {**rows, **where}, ()).mean() for rows in (ends[0], middle, ends[1])
    ]
    if pandas.isna(sum(means)):
        return NOT_RUN
    word = "reproduced" if sorted(means)[1] == means[1] else "not reproduced"
    low, inside, high = (shown(measure, mean) for mean in means)
    return f"{word}; {inside} and the ends {low}, {high}"


def closer(table: pandas.DataFrame, measure: str, to: Where, than_to: Where, middle: Where) -> str:
    """Judge that the mean of a measure is closer to one other mean than to another."""
    near, mean, far = (values(table, measure, rows, ()).mean() for rows in (to, middle, than_to))
    if pandas.isna(near + mean + far):
        return NOT_RUN
    word = "reproduced" if abs(mean - near) < abs(mean - far) else "not reproduced"
    return f"{word}; {shown(measure, mean)} against {shown(measure, near)}, {shown(measure, far)}"


def meets(table: pandas.DataFrame, measure: str, value: float, where: Where) -> str:
    """Judge that a measure differs from a value by no more than `LITTLE`."""
    found = values(table, measure, where, ())
    if found.empty:
        return NOT_RUN
    points = Points.of(found / value - 1.0)
    word = "reproduced" if abs(points.mean.iloc[0]) <= LITTLE else "not reproduced"
    return f"{word}; {shown(measure, value * (1.0 + points.mean.iloc[0]))}, {points}"


def _difference(
    table: pandas.DataFrame,
    measure: str,
    more: Where,
    less: Where,
    at: Sequence[str],
    where: Where | None,
) -> tuple[Points | None, str]:
    high, low = (values(table, measure, {**rows, **(where or {})}, at) for rows in (more, less))
    both = high.index.intersection(low.index)
    if both.empty:
        return None, ""
    means = " against ".join(shown(measure, found[both].mean()) for found in (high, low))
    return Points.of(high[both] / low[both] - 1.0), means


def _change(
    table: pandas.DataFrame, measure: str, x: str, where: Where, at: Sequence[str]
) -> pandas.Series:
    """Relative change of a measure from the table's first to its last `x`, by (point, seed)."""
    found = values(table, measure, where, [x, *at]).unstack(x)
    if found.empty:
        return pandas.Series(dtype=float)
    # a value of x without any strength does not move the ends
    ends = found.reindex(columns=[table[x].min(), table[x].max()])
    return (ends.iloc[:, 1] / ends.iloc[:, 0] - 1.0).dropna()


def _little(points: Points) -> str:
    small = (points.mean.abs() <= LITTLE) | (points.mean.abs() <= points.error)
    if small.all():
        return "reproduced"
    return f"in part: at {small.sum()} of {len(small)} points" if small.any() else "not reproduced"


def _beside_one(
    table: pandas.DataFrame, measure: str, where: Where, at: Sequence[str], sign: int
) -> str:
    found = values(table, measure, where, at)
    if found.empty:
        return NOT_RUN
    means = Points.of(found).mean
    extent = f"{means.min():.2f}" + (f" to {means.max():.2f}" if len(means) > 1 else "")
    return f"{Points.of(sign * (found - 1.0)).verdict()}; {extent}"
