# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests, one file each, whose ``KIND`` holds the complete definition."""
