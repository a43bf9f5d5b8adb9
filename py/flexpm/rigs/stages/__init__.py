# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages of a script's own test that a rig of parts has beside confinement and loading."""
