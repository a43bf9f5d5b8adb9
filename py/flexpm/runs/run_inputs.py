# SPDX-License-Identifier: GPL-3.0-or-later
"""All that determines a run, as plain values, and what follows from them. SI units."""

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
    """What is tested.

    Attributes:
        test: One of ``TESTS``, or ``ELASTIC``.
        specimen: What the specimen is made from.
        material: Its ``name`` and the parameters in effect for the model, see ``described``.
    """

    test: str
    specimen: AnySpec
    material: Table


@dataclass(frozen=True)
class RunInputs(TestOptions, LoadingOptions, GrainOptions, Tested):
    """The inputs of a run: its groups, flat. Threads and folders are no part of it.

    A field that is added later has a default that stands for the runs of before; then no key
    changes. Start and loading follow from test and model unless they are given; the rate is that of
    the first loading where it is halved. A damping of None is 0.7, as always before it could be
    chosen; with real masses it is 0 unless it is given, and a specimen is settled under its
    confinement with 0.7 at least.
    """

    def to_json(self) -> Table:
        """All fields as JSON has them, the test's own options beside them: no tuples."""
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
        """Whether the specimen is one of space."""
        return is_solid(self.specimen.kind)

    @property
    def has_edge_normals(self) -> bool:
        """Whether bonds have the normals of their edges: of cells other than Laguerre's (D104)."""
        if self.is_solid or self.model not in BLOCK_MODELS:
            return False
        notched = self.kind.cut is not None and bool(self.options["notch"])
        return notched or not self.specimen.is_laguerre

    @property
    def options(self) -> dict[str, Value]:
        """Options that not all tests have, by name; None for what is not given."""
        return {
            one.name: self.own.get(one.name, getattr(self, one.name, None))
            for one in self.kind.options
            if not one.size
        }

    @property
    def pressure(self) -> float:
        """What a stage that presses puts on [Pa]."""
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
        """Whether the loading can be another than constant."""
        return self.model in GRAIN_MODELS and not self.dynamic and not self.kind.is_solve

    @property
    def default_loading(self) -> str:
        """How the loading goes on unless it is given."""
        if not self.adapts:
            return "constant"
        if self.model in WAITING_MODELS:
            return "waiting"
        # brittle contacts crack before damage takes work: an adaptive rate would fall too late
        return "constant" if is_brittle(self.material) else "adaptive"
