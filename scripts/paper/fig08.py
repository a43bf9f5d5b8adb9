# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 8 of the paper: stress over strain of flexible and inner-particle grains."""

from common import options, panels_of_laws

for path in panels_of_laws("fig08", options(__doc__)):
    print(path)
