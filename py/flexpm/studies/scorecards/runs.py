# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a scorecard: specimens by size, and the jobs of each packing. SI units."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ...dimensions import is_solid
from ...errors import InputError
from ...files import Table
from ...kinds.option import JAW_RADIUS
from ...kinds.registry import KINDS, names
from ...kinds.test_kind import TestKind
from ...materials.made_for import dimension_of
from ...materials.material import Material
from ...models.options import MODELS
from ...require import require_known, require_one_of
from ...results.result import Result
from ...results.result_checks import FINISHED
from .. import jobs, past_peak
from ..jobs import Job
from . import measures
from .measures import Ended, Runs
from .rock import Entry, Rock

#: Shapes of the compressed specimens.
SHAPES = ("rectangle", "box", "cylinder")
_MODELS = ("flexible", "rigid")
#: Radius of jaws over the radius of the disc, as suggested by the ISRM [-].
JAWS = 1.5
#: Digits of a confining pressure.
_DIGITS = 4
_LATERAL = "lateral_strain"


@dataclass(frozen=True)
class Size:
    """Specimens of a scorecard.

    Attributes:
        name: Name of the size.
        full: Whether measures that depend on the size count.
        rate: Factor on the loading rate [-].
        sizes: Sizes of each shape [m].
        options: Further options of all runs.
    """

    name: str
    full: bool
    rate: float
    sizes: Mapping[str, Mapping[str, float]]
    options: Table = field(default_factory=dict)


SIZES = {
    one.name: one
    for one in (
        Size(
            "small",
            False,
            2.0,
            {
                "rectangle": {"width": 0.04, "height": 0.08},
                "disc": {"diameter": 0.06},
                "half-disc": {"diameter": 0.06},
                "box": {"width": 0.015, "depth": 0.015, "height": 0.03},
                "cylinder": {"diameter": 0.015, "height": 0.03},
                "solid-disc": {"diameter": 0.03, "depth": 0.015},
                "solid-half-disc": {"diameter": 0.03, "depth": 0.01},
            },
        ),
        Size(
            "full",
            True,
            1.0,
            {
                "rectangle": {"width": 0.08, "height": 0.16},
                "disc": {"diameter": 0.08},
                "half-disc": {"diameter": 0.08},
                "box": {"width": 0.025, "depth": 0.025, "height": 0.05},
                "cylinder": {"diameter": 0.025, "height": 0.05},
                "solid-disc": {"diameter": 0.05, "depth": 0.025},
                "solid-half-disc": {"diameter": 0.05, "depth": 0.015},
            },
        ),
    )
}


@dataclass(frozen=True)
class Plan:
    """A scorecard that was asked for, checked.

    Attributes:
        material: Name of a preset, or path of a material file.
        loaded: The material.
        model: Name of the model.
        shape: Shape of the compressed specimens.
        seeds: Seeds of the packings.
        size: Specimens.
        rock: Measures of the rock.
    """

    material: str
    loaded: Material
    model: str
    shape: str
    seeds: tuple[int, ...]
    size: Size
    rock: Rock

    @property
    def solid(self) -> bool:
        """Whether the specimens are 3D."""
        return is_solid(self.shape)

    @cached_property
    def jobs(self) -> dict[int, dict[str, Job]]:
        """Runs of each packing, by seed and by the name of the run.

        They are made once, because they read the material's file, which may change meanwhile.
        """
        base = Path.cwd()
        return {
            seed: {name: jobs.make(asked, base) for name, asked in self._asked(seed)}
            for seed in self.seeds
        }

    def _asked(self, seed: int) -> Iterator[tuple[str, Table]]:
        """Yield the name and the inputs of each run of a packing."""
        for name in (measures.SOLVED, measures.COMPRESSED):
            yield name, self._inputs(name, seed)
        controls = KINDS[self._test(measures.COMPRESSED)].controls
        control = next(word for word, column in controls.items() if column == _LATERAL)
        yield measures.CONTROLLED, self._inputs(measures.COMPRESSED, seed) | {"control": control}
        yield measures.PULLED, self._inputs(measures.PULLED, seed)
        split = self._inputs(measures.SPLIT, seed)
        if self.solid:
            split[JAW_RADIUS] = 0.5 * JAWS * split["diameter"]
        yield measures.SPLIT, split
        yield measures.NOTCHED, self._inputs(measures.NOTCHED, seed)
        strength = self.rock.compressive_strength
        young = self.rock.entries.get("youngs_modulus", Entry()).value
        for percent, share in measures.PRESSURES.items():
            pressure = float(f"{share * strength:.{_DIGITS}g}")
            # the share of a rounded pressure would be another
            ends = past_peak.ends(share * strength, strength, young)
            inputs = self._inputs("confined", seed) | {"confinement": pressure, **ends}
            yield measures.confined(percent), inputs

    def _inputs(self, role: str, seed: int) -> Table:
        """Return the inputs of a test on the specimen that it takes."""
        test = self._test(role)
        shape = self._shape(KINDS[test])
        common: Table = {
            **{"test": test, "model": self.model, "material": self.material, "seed": seed},
            **{"rate": self.size.rate, **self.size.options, **self.size.sizes[shape]},
        }
        return common | ({"shape": shape} if self.solid else {})

    def _test(self, role: str) -> str:
        """Return the name of the test with a role, in the dimension of the specimens."""

        def fits(kind: TestKind) -> bool:
            return kind.scored == role and kind.variant_in(solid=self.solid) is not None

        return names(fits)[0]

    def _shape(self, kind: TestKind) -> str:
        if self.shape in kind.variants:
            return self.shape
        return next(one for one in kind.shapes if is_solid(one) == self.solid)

    @property
    def grains(self) -> int:
        """Approximate number of grains of the compressed specimen, by its size and diameters."""
        return grains_of(next(iter(self.jobs.values()))[measures.COMPRESSED])


def grains_of(job: Job) -> int:
    """Return the approximate number of grains of a run, by the size of its specimen."""
    spec = job.spec.specimen
    low, high = spec.diameters or (1.0, 1.0)
    filled = 1.0 - (spec.porosity or 0.0)
    if is_solid(spec.kind):
        mean = (low + high) * (low * low + high * high) / 4.0
        return round(spec.volume * filled / (math.pi / 6.0 * mean))  # type: ignore[union-attr]
    mean = (low * low + low * high + high * high) / 3.0
    area = math.prod(spec.sizes.values())
    if "diameter" in spec.sizes:
        area = (0.25 if spec.kind == "disc" else 0.125) * math.pi * spec.sizes["diameter"] ** 2
    return round(area * filled / (0.25 * math.pi * mean))


def plan(
    material: Material,
    given: str,
    *,
    model: str | None,
    shape: str | None,
    seeds: Sequence[int],
    size: str | Size,
    rock: Rock,
) -> Plan:
    """Check what was asked for; model and shape follow from the material unless given.

    Args:
        material: The material.
        given: Its name or file, as runs take it.
        model: Name of the model; None: that of the material's calibration, else ``flexible``.
        shape: Shape of the compressed specimens; None: by the material's calibration.
        seeds: Seeds of the packings, each once.
        size: Name of a size, or specimens of other sizes.
        rock: Measures of the rock.

    Raises:
        InputError: for an unknown name, or seeds that are none or repeated.
    """
    made_for = material.made_for
    model = model or (made_for.model if made_for else "flexible")
    require_known("scorecard: model", model, MODELS)
    if model not in _MODELS:
        raise InputError(
            f"scorecard: model = {model}, must be {' or '.join(_MODELS)}, whose loading can follow "
            "the lateral strain; choose one of them"
        )
    solid = made_for is not None and made_for.dimension == dimension_of(solid=True)
    shape = shape or ("box" if solid else "rectangle")
    require_known("scorecard: shape", shape, SHAPES)
    if not isinstance(size, Size):
        require_one_of("scorecard: size", size, list(SIZES))
        size = SIZES[size]
    if not seeds or len(set(seeds)) < len(seeds):
        raise InputError(
            f"scorecard: seeds = {list(seeds)}, must be one or more, each once; correct them"
        )
    return Plan(given, material, model, shape, tuple(seeds), size, rock)


def ended(outcome: Table, folder: Path) -> Ended:
    """Return a run from its outcome and its folder.

    Args:
        outcome: Outcome of the job.
        folder: Folder of the run.
    """
    numbers = outcome["result"]
    curve = folder / "curve.csv"
    result = Result.read(folder) if curve.is_file() and (folder / FINISHED).is_file() else None
    message = str(outcome["message"])
    if result is None and numbers and outcome["exit_code"] == 0:
        message = ""  # a direct solve
    elif result is None:
        message = message or "no result"
    return Ended(result, numbers, message)


def values_of(runs: Runs, *, solid: bool) -> dict[str, measures.Value]:
    """Return all measures of a packing by name."""
    return {name: one.measured(runs, solid=solid) for name, one in measures.MEASURES.items()}


def pairs_of(packings: Sequence[Runs]) -> list[Table]:
    """Return the cracks of each pair of minerals in compression, as shares of all cracks [-].

    The shares are of the cracks of all packings together, up to the end of the test.
    """
    counts: dict[str, dict[str, int]] = {}
    for runs in packings:
        result = runs.get(measures.COMPRESSED, Ended()).result
        for pair, modes in ((result and result.cracks_by_pair) or {}).items():
            sums = counts.setdefault(pair, {})
            for mode, count in modes.items():
                sums[mode] = sums.get(mode, 0) + int(count)
    total = sum(sum(modes.values()) for modes in counts.values())
    return [
        {"pair": pair, **{mode: count / total for mode, count in modes.items()}}
        for pair, modes in counts.items()
        if total
    ]
