# SPDX-License-Identifier: GPL-3.0-or-later
"""States of solids, and files of them for ParaView. SI units."""
