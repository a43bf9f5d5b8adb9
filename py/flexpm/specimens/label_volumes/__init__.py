# SPDX-License-Identifier: GPL-3.0-or-later
"""Label volumes: voxels of segmented scans, read from the files of other programs."""
