# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets the tests of this folder import yade first: flexpm knows where it is."""

import flexpm  # noqa: F401
