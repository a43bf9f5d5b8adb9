# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that are stopped under way and taken up again, and whether two runs have the same record."""

from __future__ import annotations

import numpy as np
import pytest
from step_clock import step_clock

import flexpm
from flexpm.runs.checkpoint import Checkpoint

import yade  # isort: skip  (flexpm makes YADE importable)


class StopError(Exception):
    """The run is stopped here."""


def taken_up(monkeypatch, out, last, test, specimen, **asked):
    """Result of a run that was stopped at a look after step `last` and then started again.

    Both look at each tenth step. The first saves its scene from fifty steps before the stop on.
    """
    step_clock(monkeypatch.setattr, look=10)

    def stop(done, expected, text):
        if done > last:
            raise StopError

    with monkeypatch.context() as patched:
        due = property(lambda _: yade.O.iter > last - 50)
        patched.setattr(Checkpoint, "due", due)
        with pytest.raises(StopError):
            flexpm.run(test, specimen, out=out, progress=stop, **asked)
    again = flexpm.run(test, specimen, out=out, **asked)
    assert again.resumed_at > 0
    return again


def same(one, other):
    """Whether two results have the same record, to the bit."""
    rows, others = ({name: of.curve[name] for name in of.curve.columns} for of in (one, other))
    return rows.keys() == others.keys() and all(
        np.array_equal(rows[name], others[name], equal_nan=True) for name in rows
    )
