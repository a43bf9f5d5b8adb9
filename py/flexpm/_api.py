# SPDX-License-Identifier: GPL-3.0-or-later
"""Public names of the package, each imported from its home.

The package imports this module when the first of these names is used: it needs YADE, numpy, VTK and
matplotlib, which the classes of the plugin and the command's help do without.
"""

from . import materials
from .errors import InputError, SimulationError
from .laboratory.protocols import run
from .materials import Material
from .models.grains import Model, build, elastic
from .report import notebook as _notebook  # noqa: F401  # what notebooks show is registered there
from .report import plot
from .results import strength
from .results import vtu as export
from .results.result import Result
from .rigs.fitting import rig
from .rigs.part_rig import PartRig
from .rigs.solids.part_rig import SolidPartRig
from .runs.loading_rate import Loading
from .specimens.specimen import Specimen
from .studies.comparison import compare

__all__ = [
    "InputError",
    "Loading",
    "Material",
    "Model",
    "PartRig",
    "Result",
    "SimulationError",
    "SolidPartRig",
    "Specimen",
    "build",
    "compare",
    "elastic",
    "export",
    "materials",
    "plot",
    "rig",
    "run",
    "strength",
]
