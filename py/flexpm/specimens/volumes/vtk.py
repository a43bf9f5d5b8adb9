# SPDX-License-Identifier: GPL-3.0-or-later
"""Read label volumes from files of VTK: ``.vti`` and the legacy ``.vtk`` of structured points."""
