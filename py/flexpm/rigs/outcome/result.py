# SPDX-License-Identifier: GPL-3.0-or-later
"""Result of a test on a rig, from its record, grains and cracks at the end. SI units."""

from __future__ import annotations

import yade
from yade import wrapper

from ..._version import __version__
from ...kinds.registry import kind_of
from ...models.grains import Model
from ...results.cracks import count_by_pair, count_softened_by_pair, cracks_from_snapshot
from ...results.emission import EventRule, event_rule
from ...results.joint_states import joint_states
from ...results.result import Result
from ...specimens.kernel_input import Circle
from ...specimens.specimen import AnySpecimen, Specimen
from ..readings import RigReadings


def result_of(rig: RigReadings, test: str, largest_unbalanced: float, *, waiting: bool) -> Result:
    """Measure the results of a test in its rig and its scene.

    Args:
        rig: Rig with the specimen.
        test: Name of the test, which defines the meaning of the record.
        largest_unbalanced: Largest ratio of a quasi-static test [-], see ``Result.measure``.
        waiting: Whether the loading was crack-controlled.
    """
    built = rig.built
    counts, snapshot = built.counts(), built.snapshot()
    result = Result(
        flexpm=__version__,
        yade=yade.config.version,
        test=test,
        model=built.name,
        material=built.describe_material(),
        seed=built.specimen.seed,
        grains=counts["grains"],
        contacts=counts["contacts"],
        nodes=counts.get("nodes"),
        triangles=counts.get("triangles"),
        particles=counts.get("particles"),
        inner_contacts=counts.get("inner_contacts"),
    )
    if kind_of(test).quasi_static:
        result.grains_across = grains_across(built.specimen)
    result.curve, result.ended_by = rig.record, rig.ended_by
    kinds = [kind["name"] for kind in result.material.get("minerals", ())]
    result.cracks = cracks_from_snapshot(snapshot, result.curve, kinds)
    result.cracks_by_pair = count_by_pair(result.cracks)
    result.softened_by_pair = count_softened_by_pair(snapshot, result.cracks, kinds)
    # before it is loaded, or where its motion was prescribed, a script's own test has no scales
    loaded = rig.planned and len(result.curve) > 0
    sudden = rig.may_fail_at_once and not rig.diverged and loaded
    result.measure(
        largest_unbalanced,
        waiting=waiting,
        crossing=rig.scales().crossing_steps if sudden else None,
        diverged=rig.diverged,
        initial_energy=rig.initial_energy,
    )
    if kind_of(test).is_core:
        result.measure_core(solid=rig.solid, dynamic=built.dynamic)
    if kind_of(test).splits:
        outline = getattr(built.specimen, "outline", None)
        centre = (outline.x, outline.y) if isinstance(outline, Circle) else (0.0, 0.0)
        result.measure_first_cracks(centre, 0.5 * built.specimen.dimensions["diameter"])
    result.contact_width = rig.contact_width
    result.measure_fragments(snapshot)
    result.tetrahedra = snapshot.elements
    if isinstance(built, Model):  # bonds of spheres tell no energy
        result.measure_emission(_event_rule(built.specimen, built.solver))
        result.joint_deviation = built.joint_deviation
        result.largest_overlap = built.largest_overlap
        result.largest_clearance = built.largest_clearance
        cuts = built.specimen.told_cuts.items()
        result.joint_cuts = {name: cut.to_json() for name, cut in cuts} or None
        result.joint_states = joint_states(snapshot)
        result.networks = built.specimen.network_intensities() or None
        result.loose_grains, result.largest_separation = built.parting(snapshot)
    return result


def grains_across(specimen: AnySpecimen) -> float:
    """Smallest size over the mean grain [-]; joints make smaller grains of those that they cut."""
    return specimen.smallest_size / specimen.mean_diameter


def _event_rule(specimen: Specimen, solver: wrapper.GrainSolver) -> EventRule:
    """Return the rule for events, from the wave speed in a disc of the specimen's area."""
    diameter = specimen.equal_diameter
    return event_rule(specimen.mean_diameter, diameter, solver.crossingSteps(diameter))
