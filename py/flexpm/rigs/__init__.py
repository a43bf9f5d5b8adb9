# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a rig, and the places where they go."""
