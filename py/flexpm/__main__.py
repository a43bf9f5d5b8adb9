# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm`, also as `python3 -m flexpm`."""

import sys

from .cli import signals

signals.block()  # until main answers them; an interrupted import gives a traceback

from .cli.main import main  # noqa: E402

sys.exit(main())
