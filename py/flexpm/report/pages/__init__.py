# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages for a browser, each one file that fetches nothing: their parts, maps, and that of a run."""
