# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of a specimen in a YADE scene: grains of flexpm and YADE's bonded spheres."""
