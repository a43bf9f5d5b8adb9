# SPDX-License-Identifier: GPL-3.0-or-later
"""Definitions of the laboratory tests as plain data: one file for each test, in folder tests."""
