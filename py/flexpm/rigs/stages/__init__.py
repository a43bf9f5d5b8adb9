# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages of a custom test between parts, in addition to confining pressure and loading."""
