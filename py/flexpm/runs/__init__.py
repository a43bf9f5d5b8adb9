# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is: what determines it, how fast it goes, how it is stepped, saved and told."""
