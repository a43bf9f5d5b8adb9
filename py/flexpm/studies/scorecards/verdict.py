# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a scorecard and their verdicts, from the values of the packings. SI units, degrees.

A row is met if the mean of the packings lies in the band, and at least four fifths of the packings
lie within twice the band.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from ...files import Table
from .measures import MEASURES, Measure, Value
from .rock import Entry

MET, NOT_MET, NOT_KNOWN = "met", "not met", "not known"
NO_VALUE, SIZE = "no value", "size"
#: Share of the packings that must count, and that must lie within twice the band [-].
LEAST_SHARE = 0.8
#: Rounding of a share of whole packings [-].
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Row:
    """Verdict on a measure."""

    measure: Measure
    entry: Entry
    values: tuple[Value, ...]  #: one a packing
    mean: float | None
    error: float | None  #: standard error of the mean
    within: int | None  #: packings within twice the band; None without a band
    verdict: str
    reasons: tuple[str, ...] = ()  #: why it is not known

    @property
    def decides(self) -> bool:
        """Whether the verdict on the scorecard depends on the row."""
        return self.entry.decides and self.entry.value is not None

    def fails(self, *, full: bool) -> bool:
        """Whether the scorecard fails by this row.

        A row that decides fails if it is not met, and with full specimens also if it is not known.

        Args:
            full: Whether the specimens are full.
        """
        return self.decides and (self.verdict == NOT_MET or (full and self.verdict == NOT_KNOWN))

    def as_dict(self) -> Table:
        """Return the row for scorecard.json."""
        return {
            "measure": self.measure.name,
            "unit": self.measure.unit,
            "rock": asdict(self.entry),
            "values": [asdict(one) for one in self.values],
            "mean": self.mean,
            "error": self.error,
            "within": self.within,
            "packings": len(self.values),
            "verdict": self.verdict,
            "reasons": list(self.reasons),
        }


def judge(measure: Measure, values: Sequence[Value], entry: Entry | None, *, full: bool) -> Row:
    """Judge a measure.

    Args:
        measure: The measure.
        values: Its values, one a packing.
        entry: The rock's; None: the rock file has none.
        full: Whether the specimens are full.
    """
    entry = entry or Entry()
    counted = [one.number for one in values if not one.reason and one.number is not None]
    known = [one.number for one in values if one.number is not None]
    shown = counted or known
    mean = float(np.mean(shown)) if shown else None
    error = float(np.std(shown, ddof=1)) / math.sqrt(len(shown)) if len(shown) > 1 else None
    least = LEAST_SHARE * len(values) - _ROUNDING
    reasons = list[str]()
    if len(counted) < least:
        reasons += _reasons(values)
    if measure.needs_size and not full:
        reasons.append(SIZE)
    if entry.value is None:
        return Row(
            measure, entry, tuple(values), mean, error, None, NOT_KNOWN, (NO_VALUE, *reasons)
        )
    wide = entry.band.widened(entry.value)
    within = sum(wide.has(number) for number in counted)
    if reasons:
        return Row(measure, entry, tuple(values), mean, error, within, NOT_KNOWN, tuple(reasons))
    assert mean is not None
    verdict = MET if entry.band.has(mean) and within >= least else NOT_MET
    return Row(measure, entry, tuple(values), mean, error, within, verdict)


def judge_all(
    packings: Sequence[Mapping[str, Value]], entries: Mapping[str, Entry], *, full: bool
) -> list[Row]:
    """Judge all measures.

    Args:
        packings: Values by measure, of each packing.
        entries: Measures of the rock.
        full: Whether the specimens are full.
    """
    return [
        judge(measure, [one[name] for one in packings], entries.get(name), full=full)
        for name, measure in MEASURES.items()
    ]


def _reasons(values: Sequence[Value]) -> list[str]:
    """Return the reasons of packings that do not count, the most frequent first, with numbers."""
    reasons = Counter(one.reason for one in values if one.reason)
    if not reasons:
        return ["no packings"]
    if len(reasons) == 1 and reasons.total() == len(values):
        return [*reasons]
    return [f"{reason} in {count} of {len(values)}" for reason, count in reasons.most_common()]
