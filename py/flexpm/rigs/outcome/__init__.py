# SPDX-License-Identifier: GPL-3.0-or-later
"""What a test on a rig leaves: its result, what a script's own test was, its folder."""
