# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests: their stages and results."""
