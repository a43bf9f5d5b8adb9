# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm`, also as `python3 -m flexpm`."""

import sys

from .cli.main import main

sys.exit(main())
