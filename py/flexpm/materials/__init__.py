# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials: laws by name, presets, mixtures of minerals, published measurements."""

from .made_for import MadeFor
from .material import Material, default_name, load, preset_names

__all__ = ["MadeFor", "Material", "default_name", "load", "preset_names"]
