# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid specimens: packed spheres, their polyhedral cells, files and figures of them."""
