# SPDX-License-Identifier: GPL-3.0-or-later
"""3D specimens of label volumes and of tables of grains."""
