# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens: packings of discs, the cells made of them, minerals and particles inside grains."""
