# SPDX-License-Identifier: GPL-3.0-or-later
"""HTML reports, each a single self-contained file: parts, maps, and the report of a run."""
