# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 13 of the paper: influence of the contacts' friction, rigid and flexible."""

from common import macroscopic_pictures, options, results

KEYS = ["model", "set.cohesion", "set.friction"]

rows, folder = results("fig13", options(__doc__))
for path in macroscopic_pictures("fig13", rows, folder, KEYS, x="set.friction"):
    print(path)
