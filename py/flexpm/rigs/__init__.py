# SPDX-License-Identifier: GPL-3.0-or-later
"""Fix, load and observe a specimen."""
