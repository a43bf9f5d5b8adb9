# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibration files that flexpm writes for a rock."""
