# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of a specimen: their lines, cuts, and deviations from the lines."""
