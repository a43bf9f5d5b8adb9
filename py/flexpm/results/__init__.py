# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run leaves: record, measures, cracks, fragments, strength criteria, VTU files."""
