# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions of the package; each message is one line with quantity, value, rule and remedy."""

from __future__ import annotations


class InputError(ValueError):
    """A value given by the user is wrong; no computation has begun.

    Example:
        >>> try:
        ...     flexpm.Specimen.rectangle(-0.1, 0.2, 0.01)
        ... except flexpm.InputError as error:
        ...     print("width" in str(error))
        True
    """


class SimulationError(RuntimeError):
    """A simulation has failed before its end."""


class BusyError(OSError):
    """Another process uses the folder."""
