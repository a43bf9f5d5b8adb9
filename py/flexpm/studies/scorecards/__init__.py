# SPDX-License-Identifier: GPL-3.0-or-later
"""Scorecards: measures of a material beside those of a rock, with a verdict on each."""
