# SPDX-License-Identifier: GPL-3.0-or-later
"""Laboratory tests: how a model is held, loaded, observed, saved and taken up again."""
