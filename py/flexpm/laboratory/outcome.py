# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run: what its rig, its grains and its cracks say at the end. SI units."""

from __future__ import annotations

import math

import yade
from yade import wrapper

from .._version import __version__
from ..materials.mixing import is_brittle
from ..models.grains import Model
from ..results.cracks import count_by_pair, cracks_from_snapshot
from ..results.emission import EventRule, event_rule
from ..results.result import Result
from ..rigs.part_rig import PartRig
from ..rigs.rig import TestRig
from ..rigs.wave_rig import WaveRig
from ..runs.loading_rate import quasistatic_ratio
from ..runs.run_spec import RunSpec
from ..specimens.specimen import Specimen
from .part_tests import grains_across, measure


def outcome(rig: TestRig, spec: RunSpec) -> Result:
    """Measure what a finished test has left in its rig and its scene."""
    counts, snapshot = rig.built.counts(), rig.built.snapshot()
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=spec.test,
        model=spec.model,
        material=rig.built.describe_material(),
        seed=rig.built.specimen.seed,
        grains=counts["grains"],
        contacts=counts["contacts"],
        nodes=counts.get("nodes"),
        triangles=counts.get("triangles"),
        particles=counts.get("particles"),
        inner_contacts=counts.get("inner_contacts"),
    )
    if spec.kind.quasi_static:
        result.grains_across = grains_across(rig.built.specimen)
    result.inputs = spec.to_json()
    result.curve = rig.record
    kinds = [kind["name"] for kind in result.material.get("minerals", ())]
    result.cracks = cracks_from_snapshot(snapshot, result.curve, kinds)
    result.cracks_by_pair = count_by_pair(result.cracks)
    sudden = rig.may_fail_at_once and not rig.diverged
    result.measure(
        _largest_unbalanced(spec),
        waiting=spec.loading == "waiting",
        crossing=rig.scales().crossing_steps if sudden else None,
        diverged=rig.diverged,
        initial_energy=rig.initial_energy,
    )
    if isinstance(rig, PartRig):
        measure(result, rig, spec)
    if isinstance(rig, WaveRig):
        result.measure_wave(spec.wave or "", rig.distance)
    for name in spec.kind.no_constants:
        setattr(result, name, None)
    result.contact_width = rig.contact_width
    result.measure_fragments(snapshot)
    if isinstance(rig.built, Model):  # bonds of spheres tell no energy
        result.measure_emission(_event_rule(rig.built.specimen, rig.built.solver))
        result.joint_bend = rig.built.joint_bend
        cuts = rig.built.specimen.joint_cuts.items()
        result.joint_cuts = {name: cut.to_json() for name, cut in cuts} or None
        result.loose_grains, result.largest_parting = rig.built.parting
    return result


def _largest_unbalanced(spec: RunSpec) -> float:
    """Largest unbalanced-force ratio of a test that is to be quasi-static [-]."""
    if not spec.kind.quasi_static:
        return math.inf
    waiting, brittle = spec.loading == "waiting", is_brittle(spec.material)
    return quasistatic_ratio(spec.test, spec.model, waiting=waiting, brittle=brittle)


def _event_rule(specimen: Specimen, solver: wrapper.GrainSolver) -> EventRule:
    """What makes an event, by the speed of a wave through a disc of the specimen's area."""
    diameter = specimen.equal_diameter
    return event_rule(specimen.mean_diameter, diameter, solver.crossingSteps(diameter))
