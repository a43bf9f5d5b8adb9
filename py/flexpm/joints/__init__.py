# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of a specimen: their lines, what these cut, and how far they bend to the grains."""
