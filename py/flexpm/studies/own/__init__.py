# SPDX-License-Identifier: GPL-3.0-or-later
"""Own tests of scripts in calibrations."""
