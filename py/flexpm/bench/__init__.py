# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of a step, compared with other codes."""
