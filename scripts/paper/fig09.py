# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 9 of the paper: stress over strain of flexible and rigid grains."""

from common import options, panels_of_laws

for path in panels_of_laws("fig09", options(__doc__)):
    print(path)
