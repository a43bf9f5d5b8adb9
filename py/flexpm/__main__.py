# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `flexpm`, also as `python3 -m flexpm`."""

import sys

from . import _plugin
from .cli import signals

signals.end_in_time()  # also blocks them until main answers: not within an import

try:
    _plugin.require_debian()
except ImportError as error:
    sys.exit(str(error))  # another Python would not find what is imported now

from .cli.main import main  # noqa: E402

sys.exit(main())
