# SPDX-License-Identifier: GPL-3.0-or-later
"""Static solutions of a rig, and how they look."""
