# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens from images of labels: regions of pixels, their lines, and smooth boundaries."""
