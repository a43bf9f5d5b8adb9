# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions of the package; each message is one line with quantity, value, rule and remedy."""

from __future__ import annotations


class InputError(ValueError):
    """A value given by the user is wrong; nothing was computed with it."""


class SimulationError(RuntimeError):
    """A simulation could not be carried to its end."""


class BusyError(OSError):
    """Another process uses the folder."""
