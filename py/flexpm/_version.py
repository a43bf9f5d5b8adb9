# SPDX-License-Identifier: GPL-3.0-or-later
"""Version of flexpm: its one home, from which CMake, the documentation and the plugin have it."""

__version__ = "0.3.0"
