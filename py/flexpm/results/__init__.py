# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of a run: record, measures, cracks, fragments, strength criteria, VTU files."""
