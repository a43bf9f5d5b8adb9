# SPDX-License-Identifier: GPL-3.0-or-later
"""Stresses of a state for users: at points, along lines, in polar components, means of grains."""
