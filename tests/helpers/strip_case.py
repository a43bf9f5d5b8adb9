# SPDX-License-Identifier: GPL-3.0-or-later
"""A strip that end moments open, or shear, along a line of contacts: the moment at which it cracks.

Both arms of a strip are turned at their ends, each with a moment alone; the other end is clamped.
A line of contacts goes on from where the arms meet, all other contacts are unbreakable. The energy
that a crack along it releases is M^2 / (t B) for arms that open, 0.75 M^2 / (t B) for arms that
turn alike, with B the flexural stiffness of an arm. While the ends turn, damping and inertia bear a
part of their moments, so the ends are held once the crack has grown, until all has come to rest.
SI units.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

import flexpm  # isort: skip  (first: it makes YADE importable)
import yade
from yade import wrapper

from flexpm.arrays import FloatArray
from flexpm.results.snapshot import Snapshot
from flexpm.rigs.part_rig import PartRig
from flexpm.rigs.parts import HeldNodes
from flexpm.runs.loading_rate import Loading

GRAIN, THICKNESS = 3e-3, 0.01  # mean diameter, and out of plane [m]
_STRENGTH = 5e6  # of the line [Pa]
_YOUNG = 25e9  # of the grains, roughly [Pa]
#: E G / sigma_t^2 of the line, in grains [-]: the process zone has some ten points then.
_CHARACTERISTIC = 32.0
#: Length of what is held of each end, in grains [-].
_END = 2.0
#: The moment has come to rest if it changes by less than this share over some crossings of a wave.
_REST, _CROSSINGS, _MOST_LOOKS = 3e-4, 10.0, 20


@dataclass(frozen=True)
class Sizes:
    """Sizes of a strip [m]."""

    arm: float  #: height of an arm
    free: float  #: length of the arms
    growth: float  #: way of the crack that is asked for
    energy: float  #: fracture energy of the line [J/m2]

    @property
    def length(self) -> float:
        """Length of the strip: what is left of the line is as long as the arms."""
        return 2.0 * self.free + self.growth


@dataclass(frozen=True)
class Opened:
    """What a strip gives."""

    moment: float  #: of an arm at rest after the crack has grown, over that of the formula [-]
    energy: float  #: damage energy over the cracked area, over that of the line [-]
    zone: float  #: largest length of the process zone, over that of the arms [-]
    grains: int


def sizes(mode: str, grains: int) -> Sizes:
    """A strip with arms of so many grains over their height, several process zones long.

    The zone of arms that turn alike comes out 1.7 times as long as that of arms that open.
    """
    arm, characteristic = grains * GRAIN, _CHARACTERISTIC * GRAIN
    # a process zone of a slender arm; it comes out as about 0.7 of this
    zone = (characteristic / arm) ** 0.25 * arm
    energy = characteristic * _STRENGTH**2 / _YOUNG
    zones = 3.0 if mode == "opened" else 5.0
    return Sizes(arm, zones * zone + _END * GRAIN, zone, energy)


def open_strip(mode: str, grains: int, seed: int) -> Opened:
    """Load a strip until the crack has grown, and hold it until it has come to rest.

    Args:
        mode: ``opened``, or ``sheared`` by arms that turn alike, without friction.
        grains: Over the height of an arm.
        seed: Seed of the packing.
    """
    size = sizes(mode, grains)
    share = 1.0 if mode == "opened" else 0.75
    rig, cut = _rig(mode, size, seed)
    upper, lower = _arm_ends(rig, size)
    clamp = rig.hold(where=lambda x, y: x > size.length - _END * GRAIN)
    stiffness = _YOUNG * THICKNESS * size.arm**3 / 12.0
    likely = math.sqrt(size.energy * THICKNESS * stiffness / share)
    _drive(rig, mode, upper, lower, 2.0 * likely)
    rig.load(Loading(kind="waiting", max_strain=0.2 * likely / rig.scales().modulus * 2.0))
    moment = 0.5 * rig.record["load"][-1]
    found = moment / _curvature(rig.built.snapshot(), size)
    critical = math.sqrt(size.energy * THICKNESS * found / share)
    # the arm is longer by the growth and half a zone; the ligament bends with arms alike
    reach = size.free + 1.5 * size.growth
    angle = critical / found * (reach + (0.0 if share == 1.0 else 0.25 * (size.length - reach)))
    rig.load(Loading(kind="waiting", max_strain=angle, stop_ratio=0.01))
    _come_to_rest(rig)
    assert abs(clamp.moment + upper.moment + lower.moment) < 0.05 * critical
    state = rig.built.snapshot()
    on = np.isin(state.contact, np.flatnonzero(cut.edge_joints == 1))
    return Opened(
        rig.record["load"][-1] / (2.0 * critical),
        _energy_of_area(state, cut, on) / size.energy,
        _zone(state, on) / size.free,
        len(cut.discs),
    )


def _rig(mode: str, size: Sizes, seed: int) -> tuple[PartRig, flexpm.Specimen]:
    yade.O.reset()
    middle, meet = size.arm, (size.free, size.arm)
    whole = flexpm.Specimen.rectangle(size.length, 2.0 * size.arm, thickness=THICKNESS, seed=seed)
    cut = whole.with_joints({"slit": [(0.0, middle), meet], "line": [meet, (size.length, middle)]})
    rock = flexpm.materials.load("augig-table7")
    stiffness = rock.law("flexible")["normal_stiffness"]
    smooth = {"normal_stiffness": stiffness, "shear_stiffness": 0.28 * stiffness, "friction": 0.0}
    strengths, energies = (
        ("tensile_strength", "cohesion"),
        ("tensile_fracture_energy", "shear_fracture_energy"),
    )
    never = {**dict.fromkeys(strengths, 1e9), **dict.fromkeys(energies, 1e6)}
    weak = 0 if mode == "opened" else 1
    line = never | {strengths[weak]: _STRENGTH, energies[weak]: size.energy} | smooth
    laws = {"slit": smooth, "line": line}
    rock = rock.with_set(never, "flexible").with_set(
        {f"joint.{name}.{key}": value for name, law in laws.items() for key, value in law.items()},
        "flexible",
    )
    rig = PartRig(flexpm.build(cut, rock))
    # arms that do not touch: the slit would bear what a first elastic solution presses on it
    slit = np.flatnonzero(cut.edge_joints == 0)
    for one in [one for one in yade.O.interactions if one.phys.contact in slit]:
        yade.O.interactions.erase(one.id1, one.id2)
    return rig, cut


def _arm_ends(rig: PartRig, size: Sizes) -> tuple[HeldNodes, HeldNodes]:
    """The ends of the upper and of the lower arm."""
    end, middle = _END * GRAIN, size.arm
    off = 1e-4 * GRAIN
    upper = rig.hold(where=lambda x, y: (x < end) & (y > middle + off))
    return upper, rig.hold(where=lambda x, y: (x < end) & (y < middle - off))


def _drive(rig: PartRig, mode: str, upper: HeldNodes, lower: HeldNodes, strength: float) -> None:
    if mode == "opened":
        rig.rotate([lower], [upper], strength=strength)
    else:
        rig.rotate([lower, upper], strength=strength)


def _come_to_rest(rig: PartRig) -> None:
    """Hold the driven ends until their moment stands still."""
    rig.built.required(wrapper.PlateController).velocity = (0.0, 0.0, 0.0)
    last = rig.record["load"][-1]
    for _ in range(_MOST_LOOKS):
        rig.built.run(round(_CROSSINGS * rig.scales().crossing_steps))
        before, last = last, rig.record["load"][-1]
        if abs(last - before) < _REST * last:
            return
    raise AssertionError(f"moment = {last} N m, does not come to rest")


def _curvature(state: Snapshot, size: Sizes) -> float:
    """Mean of both arms, by the angles of two sections [1/m]."""
    places = ((_END + 2.0) * GRAIN, size.free - 1.5 * size.arm)
    found = []
    off = 1e-4 * GRAIN  # nodes on the slit belong to both arms
    for across in ((-off, size.arm - off), (size.arm + off, 2.0 * size.arm + off)):
        first, second = (_angle(state, x, across) for x in places)
        found.append(abs(second - first) / (places[1] - places[0]))
    return float(np.mean(found))


def _angle(state: Snapshot, place: float, across: tuple[float, float]) -> float:
    """Angle of the section through an arm, two grains wide, by a least-squares fit [rad]."""
    x, y = state.reference.T
    inside = (np.abs(x - place) < GRAIN) & (y > across[0]) & (y < across[1])
    moved = (state.positions - state.reference)[inside, 0]
    terms = np.column_stack([np.ones(inside.sum()), y[inside], x[inside]])
    return -float(np.linalg.lstsq(terms, moved, rcond=None)[0][1])


def _energy_of_area(state: Snapshot, cut: flexpm.Specimen, on: FloatArray) -> float:
    """That damage took in points of the line that have cracked, over their area [J/m2].

    The area is that before they slid: faces that have cracked get new partners as they slide on.
    """
    cracked = on[state.point_contact] & (state.crack_step >= 0)
    cells = cut.tessellation
    bonds = state.contact[state.point_contact[cracked]]
    ends = cells.vertices[cells.shared_edges[bonds, 2:]]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    areas = THICKNESS * lengths * state.point_share[cracked]
    assert state.crack_energy is not None
    return float(state.crack_energy[cracked].sum() / areas.sum())


def _zone(state: Snapshot, on: FloatArray) -> float:
    """Length of what has softened and not cracked [m]."""
    softened = state.any_of((state.point_damage > 0.0) & (state.point_damage < 1.0))
    return float(np.ptp(state.contact_ends[on][softened[on]][:, :, 0]))
