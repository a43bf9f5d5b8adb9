# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts of the HTML report: meaning of each status of a run, and the advice."""

from __future__ import annotations

from .page import Status

#: Meaning of each status, and the advice; the FAQ of the documentation has details.
STATUS = {
    "ok": Status(
        "ok",
        True,
        "The stress has passed its peak and the loading was slow enough: the strength can be used.",
        "One packing says little about scatter: --seeds 1-5 tests five of them.",
    ),
    "no_peak": Status(
        "no_peak",
        False,
        "The stress has not dropped by 10 % from its largest value, so there is no strength.",
        "If the curve still rises at its end, raise --max-strain. If the stress is constant there "
        "(ended_by is plateau), it is a residual strength. If the curve has passed a bend and "
        "still rises slowly, some grains continue to carry load: use more grains. The elastic "
        "constants are valid.",
    ),
    "not_quasistatic": Status(
        "not_quasistatic",
        False,
        "The loading was too fast: forces were not in equilibrium up to the peak, or the energies "
        "do not balance. Strengths are too high.",
        "Run it again with --rate auto, which halves the rate until the status is ok and the peak "
        "no longer changes; if auto was used, raise --halvings. With few grains a single crack "
        "disturbs the equilibrium of the whole specimen: use more grains.",
    ),
    "diverged": Status(
        "diverged",
        False,
        "A number has become infinite, faces of 3D grains have inverted, or gravity has detached a "
        "3D grain; a warning says which. The curve has all earlier rows.",
        "Lower the --rate if it was raised. Look for inputs in other units (Pa, m) and for "
        "stiffnesses that differ by many orders.",
    ),
}
#: Status of a run that has not ended.
NOT_ENDED = Status(
    "unfinished",
    False,
    "The run is in progress or was stopped. The curve ends at the step at which the files were "
    "last written, and all numbers refer to this part.",
    "Start the same command with the same folder: the run resumes from its checkpoint and ends "
    "with the same files as without the stop.",
)
#: Statuses of a custom test, whose end and quasi-static rate flexpm does not know.
OWN_STATUS = {
    "ok": Status(
        "ok",
        True,
        "The energies balance, and the load did not grow fast just before its peak.",
        "Run the script again at half the rate: differences between both runs are not a property "
        "of the rock.",
    ),
    "not_quasistatic": Status(
        "not_quasistatic",
        False,
        "The loading was too fast: the energies do not balance, or the load grew fast just before "
        "its peak. Strengths are too high.",
        "Run the script again at half the rate until the peak no longer changes.",
    ),
    "no_peak": Status(
        "no_peak",
        False,
        "The load still rose at the default end of the loading, so there is no peak load.",
        "Pass Loading(max_strain=...) in the script: a displacement [m] unless drive has a length.",
    ),
    "diverged": STATUS["diverged"],
    "unfinished": Status(
        "unfinished",
        False,
        "The script has not reached its end; a warning says how it stopped.",
        "Start the same script again: it resumes from here, with bit-identical results.",
    ),
}
