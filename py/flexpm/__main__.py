# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm`, also as `python3 -m flexpm`."""

import sys

from .cli import signals

signals.end_in_time()  # also blocks them until main answers: not within an import

from .cli.main import main  # noqa: E402

sys.exit(main())
