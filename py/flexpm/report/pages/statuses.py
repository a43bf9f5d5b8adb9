# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status of a run means and what to do then, in words."""

from __future__ import annotations

from .page import Status

#: What each status means and what to do then; the FAQ of the documentation says more.
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
        "The stress has not fallen by 10 % from its largest value, so there is no strength.",
        "If the curve still rises at its end, raise --max-strain. If the stress is constant there "
        "(ended_by is plateau), it is a residual strength. If the curve has bent over and creeps "
        "on, parts go on bearing: take more grains. Elastic constants can be used.",
    ),
    "not_quasistatic": Status(
        "not_quasistatic",
        False,
        "The loading was too fast: forces were not balanced up to the peak, or the energies do "
        "not balance. Strengths come out too high.",
        "Run it again with --rate auto: at half the rate, until the status is ok and the peak no "
        "longer changes; if auto was used, raise --halvings. With few grains a single crack "
        "unbalances the whole specimen: use more grains.",
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
#: The same of a run that has not ended.
NOT_ENDED = Status(
    "unfinished",
    False,
    "The run is in progress or was stopped: the curve ends where its files were last written, and "
    "all numbers are values up to there.",
    "Start the same command into the same folder: the run resumes from its checkpoint and ends "
    "with the same files as without the stop.",
)
#: The same of a script's own test, of which nobody knows when it is over, or how slow is slow.
OWN_STATUS = {
    "ok": Status(
        "ok",
        True,
        "Energies balance, and the load did not grow fast as its peak came.",
        "Run the script again at half the rate: differences are not a property of the rock.",
    ),
    "not_quasistatic": Status(
        "not_quasistatic",
        False,
        "The loading was too fast: the energies do not balance, or the load grew fast as its peak "
        "came. Strengths come out too high.",
        "Run the script again at half the rate until the peak no longer changes.",
    ),
    "no_peak": Status(
        "no_peak",
        False,
        "The load still rose where the loading ended by default, so there is no peak load.",
        "Give Loading(max_strain=...) in the script: a displacement [m] unless drive has a length.",
    ),
    "diverged": STATUS["diverged"],
    "unfinished": Status(
        "unfinished",
        False,
        "The script has not come to its end; a warning says how it stopped.",
        "Start the same script again: it resumes from here, with bit-identical results.",
    ),
}
