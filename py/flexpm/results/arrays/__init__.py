# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of .vtu files, written and read."""
