# SPDX-License-Identifier: GPL-3.0-or-later
"""Output of a test on a rig: its result, the calls of a custom test, its folder."""
