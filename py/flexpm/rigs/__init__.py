# SPDX-License-Identifier: GPL-3.0-or-later
"""How a specimen is held, loaded and observed."""
