# SPDX-License-Identifier: GPL-3.0-or-later
"""All inputs that determine a run, as plain values, and their consequences. SI units."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass

from ..dimensions import is_solid
from ..files import Table
from ..kinds.model_names import BLOCK_MODELS
from ..kinds.option import Value
from ..kinds.registry import kind_of
from ..kinds.test_kind import TestKind
from ..materials.mixing import is_brittle
from ..models.options import DAMPING, GRAIN_MODELS, local_damping
from ..specimens.space.any_spec import AnySpec
from .groups import GrainOptions, LoadingOptions, TestOptions
from .loading_rate import WAITING_MODELS


@dataclass(frozen=True)
class Tested:
    """Test, specimen and material of a run.

    Attributes:
        test: Name from ``TESTS``, or ``ELASTIC``.
        specimen: Description of the specimen.
        material: Its ``name`` and the parameters in effect for the model, see ``described``.
    """

    test: str
    specimen: AnySpec
    material: Table


@dataclass(frozen=True)
class RunInputs(TestOptions, LoadingOptions, GrainOptions, Tested):
    """The inputs of a run as one flat list of fields, without threads and folders.

    If a field was added in a later version, earlier runs have its default, so that no key changes.
    By default, start and loading follow from test and model. If the rate is halved during a run,
    ``rate`` is the rate of the first loading. A damping of None is 0.7 with scaled masses and 0
    with real masses; a specimen under a confining pressure settles with at least 0.7.
    """

    def to_json(self) -> Table:
        """Return all fields and the test's own options as JSON stores them: no tuples."""
        plain = asdict(self)
        own = plain.pop("own")
        content: Table = json.loads(json.dumps({**plain, **own}, allow_nan=False))
        return content

    @property
    def kind(self) -> TestKind:
        """The test."""
        return kind_of(self.test)

    @property
    def is_solid(self) -> bool:
        """Whether the specimen is 3D."""
        return is_solid(self.specimen.kind)

    @property
    def has_edge_normals(self) -> bool:
        """Whether bonds have the normals of their edges: cells that are not Laguerre (D104)."""
        if self.is_solid or self.model not in BLOCK_MODELS:
            return False
        notched = self.kind.cut is not None and bool(self.options["notch"])
        return notched or not self.specimen.is_laguerre

    @property
    def options(self) -> dict[str, Value]:
        """Options that only some tests have, by name; None: not given."""
        return {
            one.name: self.own.get(one.name, getattr(self, one.name, None))
            for one in self.kind.options
            if not one.size
        }

    @property
    def pressure(self) -> float:
        """Pressure that a pressing stage applies [Pa]."""
        options = {"confinement": self.confinement, **self.options}
        value = options[self.kind.pressure]
        return float(value) if isinstance(value, float | int) else 0.0

    @property
    def local_damping(self) -> float:
        """Local damping of the loading [-]."""
        return local_damping(self.damping, dynamic=self.kind.dynamic)

    @property
    def settling_damping(self) -> float:
        """Local damping under which the specimen comes to rest before it is loaded [-]."""
        return max(self.local_damping, DAMPING if self.kind.settles else 0.0)

    @property
    def adapts(self) -> bool:
        """Whether the rate of the loading may vary."""
        return self.model in GRAIN_MODELS and not self.dynamic and not self.kind.is_solve

    @property
    def default_loading(self) -> str:
        """Type of the loading by default."""
        if not self.adapts:
            return "constant"
        if self.model in WAITING_MODELS:
            return "waiting"
        # brittle contacts crack before damage takes work: an adaptive rate would fall too late
        return "constant" if is_brittle(self.material) else "adaptive"
