# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE as far as flexpm uses it: types for the type checker alone."""

from flexpm._flexpm import EnumClass_TestState as EnumClass_TestState

from . import log as log
from . import utils as utils
from . import wrapper as wrapper
from .wrapper import Omega

class _Boot:
    @staticmethod
    def finalize() -> None: ...

class _Config:
    libDir: str
    version: str

__all__: list[str]
boot: _Boot
config: _Config
O: Omega
