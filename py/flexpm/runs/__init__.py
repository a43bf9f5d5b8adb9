# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: inputs, loading rate, stepping, checkpoints and description."""
