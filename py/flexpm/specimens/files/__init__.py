# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of specimens: written, read and checked, and those of a run or of a command."""
