# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of specimens: writing, reading and checks."""
