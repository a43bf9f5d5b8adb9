# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs of 3D specimens."""
