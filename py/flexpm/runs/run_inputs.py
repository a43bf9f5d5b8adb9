# SPDX-License-Identifier: GPL-3.0-or-later
"""All that determines a run, as plain values, and what follows from them. SI units."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

from ..dimensions import is_solid
from ..files import Table
from ..kinds.model_names import BLOCK_MODELS
from ..kinds.option import Value
from ..kinds.registry import kind_of
from ..kinds.test_kind import STOP_RATIO, TestKind
from ..materials.mixing import is_brittle
from ..models.options import DAMPING, GRAIN_MODELS, local_damping
from ..specimens.space.any_spec import AnySpec
from ..specimens.space.spec import SolidSpec
from .loading_rate import WAITING_MODELS


@dataclass(frozen=True)
class RunInputs:
    """The inputs of a run. What it runs on, threads and folders, is no part of it.

    A field that is added later has a default that stands for the runs of before; then no key
    changes. Start and loading follow from test and model unless they are given.

    Attributes:
        test: One of ``TESTS``, or ``ELASTIC``.
        specimen: What the specimen is made from.
        material: Its ``name`` and the parameters in effect for the model, see ``described``.
        model: Name of the model.
        points: Contact points per contact.
        mesh: Triangles in each grain, ``refined`` or ``fan``.
        confinement: Lateral pressure [Pa].
        rate: Factor on the default loading rate [-], of the first loading where it is halved.
        max_strain: Axial strain at which the test ends [-]; None for a multiple of that of the
            reference strength.
        stop_ratio: Part of its peak to which the deviator falls before the test ends [-].
        dynamic: Real masses and time instead of scaled masses and unit steps.
        gravity: Acceleration downwards [m/s2].
        start: How the loading begins, one of ``STARTS``; empty: ``static`` for tension of the
            flexible model with scaled masses, else ``rest``.
        loading: How the loading goes on, one of ``LOADINGS``; empty: ``waiting`` for flexible and
            rigid grains with scaled masses, ``adaptive`` for inner particles unless contacts are
            brittle, else ``constant``.
        span: As this and the next ones are of the tests that have them, see ``kinds``; None for
            other tests.
        notch: Depth [m].
        normal_stress: On the specimen [Pa].
        max_displacement: At which the test ends [m]; None for a multiple of that at its reference
            strength.
        wave: Name of the wave.
        control: What grows at the rate; None: the way of the ends.
        damping: Local damping alpha [-] of the loading; None: 0.7, as always before it could be
            chosen. With real masses it is 0 unless it is given; a specimen is settled under its
            confinement with 0.7 at least. None for tests that have none.
        interaction_range: Multiple of the sum of both radii up to which YADE's spheres are bonded
            [-]; None: only neighbours, and for other models.
        halvings: How often the rate may be halved until the test is slow enough, see
            ``laboratory.halving``; None: never, the test is done once.
        own: Options of the test that are no fields, by their names.
    """

    test: str
    specimen: AnySpec
    material: Table
    model: str = "flexible"
    points: int = 3
    mesh: str = "refined"
    confinement: float = 0.0
    rate: float = 1.0
    max_strain: float | None = None
    stop_ratio: float = STOP_RATIO
    dynamic: bool = False
    gravity: float = 0.0
    start: str = ""
    loading: str = ""
    span: float | None = None
    notch: float | None = None
    normal_stress: float | None = None
    max_displacement: float | None = None
    wave: str | None = None
    control: str | None = None
    damping: float | None = None
    interaction_range: float | None = None
    halvings: int | None = None
    own: Mapping[str, Value] = field(default_factory=dict)

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
        if isinstance(self.specimen, SolidSpec) or self.model not in BLOCK_MODELS:
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
