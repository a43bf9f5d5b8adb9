# SPDX-License-Identifier: GPL-3.0-or-later
"""Finished runs of a calibration, found again where values differ in their last digits. SI units.

The key of a run is that of exact values. Another machine may compute the sets of a search with
other last digits, and must still find the runs that are finished.
"""

from __future__ import annotations

import json
from pathlib import Path

from ..files import Table
from . import jobs
from .jobs import Job

#: Digits of the values of a material by which a finished run is found: values of other machines
#: agree in more digits, and different sets of a search in fewer.
_DIGITS = 10
#: Inputs that name files: their content counts, not their place.
_FILES = ("material", "specimen", "joints", "network")


class FinishedRuns:
    """Runs of a folder that were finished when this object was made."""

    def __init__(self, folder: Path) -> None:
        """Read the outcomes of the runs in `folder`; other files of the runs are not needed."""
        self._found: dict[str, list[Table]] = {}
        self._keys: set[str] = set()
        for file in sorted(folder.glob(f"*/{jobs.OUTCOME}")):
            outcome = jobs.known(file.parent)
            if outcome is None or not isinstance(outcome.get("inputs"), dict):
                continue
            self._found.setdefault(_name(outcome["inputs"]), []).append(outcome)
            self._keys.add(str(outcome.get("key")))

    def job(self, inputs: Table, base: Path) -> Job:
        """Return the job of some inputs, or the finished job of nearly the same material.

        Args:
            inputs: Inputs of the run.
            base: Folder that the paths of files are relative to.

        Raises:
            InputError: as `jobs.make`.
        """
        job = jobs.make(inputs, base)
        if job.key in self._keys:
            return job
        for outcome in self._found.get(_name(job.inputs), []):
            values = {key: one for key, one in outcome["inputs"].items() if key.startswith("set.")}
            near = jobs.make({**inputs, **values}, base)
            if near.key == outcome.get("key"):
                return near
        return job


def _name(inputs: Table) -> str:
    """Inputs of a run as text, without files and with rounded values of the material."""
    shown = {
        key: f"{value:.{_DIGITS}g}"
        if key.startswith("set.") and isinstance(value, float)
        else value
        for key, value in inputs.items()
        if key not in _FILES
    }
    return json.dumps(shown, sort_keys=True)
