# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests, one file each, whose ``KIND`` says all that the others look up."""
