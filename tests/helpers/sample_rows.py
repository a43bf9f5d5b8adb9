# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a record for tests."""

from flexpm.results.record import COLUMNS


def row(**values):
    return dict.fromkeys(COLUMNS, 0.0) | values
