# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcome of a test: its numbers, its record, its cracks, and their files. SI units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path

import numpy as np

from ..files import Table, json_text, load_json, output_folder, write_text
from ..kinds.registry import OWN, kind_of
from ..kinds.test_kind import Rig
from ..notebook import Shown
from ..renamed import (
    ATTRIBUTES,
    NETWORKS,
    Renamed,
    current,
    with_old_keys,
    with_old_names,
)
from . import core, descent, doubts, measures, waves
from .cracks import MODES, AnyCrack, cracks_csv, read_cracks
from .emission import AnyEvent, EventRule, events_csv, find_events, frequencies, read_events
from .record import Curve
from .result_checks import FINISHED, require_sense
from .solids.state import AnySnapshot

#: Statuses that mean that a simulation has failed.
FAILED = ("no_peak", "diverged")
#: Cracks of a disc whose place says where it begins to split.
FIRST_CRACKS = 5
#: Models whose damage energy is that of the contacts between grains alone, and exactly 0 before.
_SOFTENING = ("flexible", "rigid")


#: Keys that only results of solids have.
OF_SOLIDS = ("tetrahedra", "largest_overlap", "largest_clearance", "second_confinement")


#: Column of the record of a box under two lateral pressures: the larger one [Pa].
_SECOND = "second_confinement"


@with_old_names
@dataclass
class Result(Shown):
    """Numbers of one test: the keys of result.json, then the record and the cracks.

    A quantity is None if the test has not reached it or does not define it.

    Example:
        >>> result = flexpm.run("tension", specimen, rate=6.0)
        >>> print(f"{result.peak_stress / 1e6:.1f} MPa, {len(result.cracks)} cracks")
        9.3 MPa, 14 cracks
        >>> result.failed
        False
    """

    flexpm: str  #: version of flexpm
    yade: str  #: version of YADE
    test: str  #: name of the test
    model: str  #: name of the model
    material: Table  #: name and effective parameters
    seed: int | None  #: of the packing
    grains: int
    contacts: int  #: between grains, bonded at the start
    nodes: int | None  #: of the meshes of grains
    triangles: int | None  #: of the meshes of grains
    tetrahedra: int | None = None  #: of a solid
    grains_across: float | None = None  #: smallest size, or ligament, over the mean grain [-]
    particles: int | None = None  #: what moves: grains, or inner particles
    inner_contacts: int | None = None  #: between particles of the same grain
    youngs_modulus: float | None = None  #: of the record's elastic part [Pa]
    poissons_ratio: float | None = None  #: of the record's elastic part [-]
    elastic_poissons_ratio: float | None = None  #: before the first contact point softens [-]
    peak_stress: float | None = None  #: largest axial stress, what the test calls so [Pa]
    peak_strain: float | None = None  #: axial strain at it [-]
    confinement: float | None = None  #: lateral pressure at the end, the least one [Pa]
    #: larger lateral pressure at the end of a box under two, see ``curve.csv`` [Pa]
    second_confinement: float | None = None
    steps: int = 0  #: of the whole test
    step_time: float | None = None  #: median wall time of a step [s]
    tensile_cracks: int = 0  #: cracked points
    shear_cracks: int = 0  #: cracked points
    cracks_by_pair: Table | None = None  #: tensile and shear ones of each pair of minerals
    #: points of each pair of minerals that have begun to soften, cracked ones included
    softened_by_pair: Table | None = None
    unbalanced_ratio: float | None = None  #: largest up to the peak [-]
    end_mismatch: float | None = None  #: of both ends' reactions, largest up to the peak [-]
    energy_error: float | None = None  #: relative to the largest work [-]
    contact_width: float | None = None  #: mean of the plates of a Brazilian test at its end [m]
    softening_slope: float | None = None  #: of stress over strain after the peak [Pa]
    #: part of a core's largest deviator that is lost within 0.5 % of axial strain after it [-]
    drop_after_peak: float | None = None
    tangent_modulus_ratio: float | None = None  #: at 80 % of the peak over that at 20 % [-]
    softening_onset: float | None = None  #: share of the peak at which a point first softens [-]
    first_tensile_crack_strain: float | None = None  #: axial strain at it [-]
    first_tensile_crack_stress: float | None = None  #: axial stress at it [Pa]
    first_shear_crack_strain: float | None = None  #: axial strain at it [-]
    first_shear_crack_stress: float | None = None  #: axial stress at it [Pa]
    tensile_onset_strain: float | None = None  #: once 5 % of the final tensile cracks are there [-]
    tensile_onset_stress: float | None = None  #: axial stress then [Pa]
    shear_onset_strain: float | None = None  #: the same of shear cracks [-]
    shear_onset_stress: float | None = None  #: axial stress then [Pa]
    #: deviator at which 1 % of the cracks at the peak of a compressed core are there [Pa]
    crack_initiation_stress: float | None = None
    #: deviator from which crack volumetric strain exceeds 2 % of the elastic one [Pa]
    crack_initiation_stress_volumetric: float | None = None
    crack_damage_stress: float | None = None  #: deviator at the extreme of volumetric strain [Pa]
    null_reasons: Table | None = None  #: why crack thresholds or the drop are missing, by names
    #: axial stress at the first crack of a split disc or a notched specimen [Pa]
    first_crack_stress: float | None = None
    #: median distance of its first cracks from the middle of the disc over the radius, or from the
    #: front of the notch over the ligament [-]
    first_crack_distance: float | None = None
    peak_load: float | None = None  #: largest load of a test between parts [N]
    notch_depth: float | None = None  #: depth of the notch as it was cut [m]
    joint_deviation: float | None = None  #: largest distance of a bearing joint from its lines [m]
    #: what came of the lines of each joint, by its name; lengths [m]
    joint_cuts: Table | None = None
    #: slip, opening and damage of each joint at the end, by its name
    joint_states: Table | None = None
    networks: Table | None = None  #: P21 requested, generated and cut of each set of traces [1/m]
    loose_grains: int | None = None  #: joined by no contact to what is held, at the end
    #: growth of a distance between grains once bonded, at the end, in mean diameters [-]
    largest_separation: float | None = None
    #: deepest overlap of grains of a solid without a common face, in mean diameters [-]
    largest_overlap: float | None = None
    #: deepest part of such an overlap that no force resists, in mean diameters [-]
    largest_clearance: float | None = None
    fracture_toughness: float | None = None  #: K_I at the peak load [Pa m^0.5]
    residual_strength: float | None = None  #: mean of the end of a shear test [Pa]
    fracture_energy: float | None = None  #: work of the load over the ligament [J/m2]
    vp: float | None = None  #: speed of a plane pressure wave [m/s]
    vs: float | None = None  #: speed of a plane shear wave [m/s]
    fragments: int | None = None  #: number of groups of connected grains at the end
    largest_fragment: float | None = None  #: its share of the area [-]
    events: int | None = None  #: events of acoustic emission
    completeness_magnitude: float | None = None  #: least magnitude that b_value counts [-]
    b_value: float | None = None  #: decades of the number of events for one of magnitude [-]
    b_value_error: float | None = None  #: standard error of b_value [-]
    #: factor on the loading rate of the last loading, of a test whose rate is halved [-]
    final_rate: float | None = None
    rates: list[Table] | None = None  #: its loadings: rate, status, peak, steps, wall time
    #: drop, plateau, largest_strain or equilibrium; None of a run that did not end so
    ended_by: str | None = None
    status: str = "ok"  #: ok, no_peak, not_quasistatic, diverged or unfinished
    inputs: Table | None = field(default=None, repr=False)  #: all that determined the run
    curve: Curve = field(default_factory=Curve, repr=False)
    cracks: list[AnyCrack] = field(default_factory=list, repr=False)
    emission: list[AnyEvent] | None = field(default=None, repr=False)  #: events, where known
    snapshot: AnySnapshot | None = field(default=None, repr=False)  #: final state
    resumed_at: int | None = field(default=None, repr=False)  #: step of the checkpoint used

    @property
    def failed(self) -> bool:
        """Whether the simulation failed: it diverged or had no peak."""
        without = self.status != "ok" and self.peak_stress is None
        return self.status in FAILED or (without and kind_of(self.test).needs_peak)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints of the specimen, in the order of their indices."""
        specimen = (self.inputs or {}).get("specimen") or {}
        return tuple(specimen.get("joint_names") or ())

    @property
    def notches(self) -> list[str]:
        """Names of the joints that are cut open before the test."""
        return [one["name"] for one in self.material.get("joints", ()) if one.get("open")]

    @property
    def without_peak(self) -> str:
        """Description of the state that a record without a peak has reached."""
        if self.ended_by != "plateau":
            return "no strength was found"
        stress = measures.plateau_stress(self.curve)
        return f"the axial stress is constant at {1e-6 * stress:.4g} MPa, no strength was found"

    @property
    def warnings(self) -> list[str]:
        """Reasons why the numbers are questionable, one line each; see ``doubts``.

        Example:
            >>> result = flexpm.run("tension", specimen, rate=6.0)
            >>> any("lower the rate" in line for line in result.warnings)
            True
        """
        record = measures.until_regained(self.curve) if kind_of(self.test).regains else self.curve
        mismatch = measures.median_end_mismatch(record)
        # a script's own test has no option of the command
        given = self.inputs or {}
        rate = given["rate"] if given and "repeatable" not in given else None
        if self.final_rate is not None:
            rate, given = self.final_rate, {**given, "rate": self.final_rate}
        found = doubts.of_inputs(given) if given else []
        if kind_of(self.test).rig is Rig.WAVE and self.vp is None and self.vs is None:
            found.append(doubts.NO_PULSE)
        if self.joint_deviation:
            found.append(doubts.of_bend(self.joint_deviation, self.joint_cuts or {}))
        found += doubts.of_cuts(self.joint_cuts or {})
        found += doubts.of_clearance(self.largest_clearance or 0.0)
        found += doubts.of_first_cracks(
            self.first_crack_distance,
            self.first_crack_stress,
            self.peak_stress,
            notched=self.fracture_toughness is not None,
        )
        found += doubts.of_grains(self.grains_across)
        found += doubts.of_poissons_ratio(self.poissons_ratio, self.elastic_poissons_ratio)
        found += doubts.of_result(self.status, self.energy_error, mismatch, rate)
        kind = kind_of(self.test)
        if kind.quasi_static and kind is not OWN and len(self.curve):
            rows = measures.rows_while_loaded(record)
            found += doubts.of_few_rows(rows, self.steps, rate)
        if self.rates:
            found += doubts.of_rates(self.rates, self.status)
        if kind_of(self.test).is_core and (first := measures.regained_peak(self.curve)):
            found.append(doubts.of_regained(first, float(np.max(self.curve["axial_stress"]))))
        if kind_of(self.test).quasi_static:
            found += doubts.of_motion(measures.kinetic_shares(self.curve), self.largest_separation)
        told = given.get("doubts", ())  # by a script's rig
        return found + [line for line in told if line not in found]

    def measure(
        self,
        max_unbalanced: float,
        *,
        waiting: bool = False,
        crossing: float | None = None,
        initial_energy: float | None = None,
        diverged: bool = False,
    ) -> None:
        """Compute the measured quantities and the status from `curve`.

        Args:
            max_unbalanced: Largest unbalanced-force ratio of a quasi-static test [-]; infinite for
                a test that is not quasi-static. It is compared with the median up to the peak, with
                `waiting` with the ratio that a fifth of the loading exceeds.
            waiting: Whether the loading was crack-controlled.
            crossing: Wave transit time of a specimen that may fail suddenly along a weak plane
                [steps]: its load must not grow fast just before the peak. None: no such check,
                since failure is announced earlier.
            initial_energy: Energy at which the work began to count [J]; None: energy of the first
                row.
            diverged: Whether the simulation met a number that is not finite.
        """
        whole = self.curve
        record = measures.until_regained(whole) if kind_of(self.test).regains else whole
        self.youngs_modulus = measures.youngs_modulus(record)
        self.poissons_ratio = measures.poissons_ratio(record)
        self.unbalanced_ratio = measures.unbalanced_ratio(record)
        self.end_mismatch = measures.end_mismatch(record)
        self.energy_error = measures.energy_error(whole, initial_energy)
        self.softening_slope = measures.softening_slope(record)
        self.tangent_modulus_ratio = measures.tangent_modulus_ratio(record)
        if self.model in _SOFTENING:
            self.softening_onset = measures.softening_onset(record)
            self.elastic_poissons_ratio = measures.elastic_poissons_ratio(record)
        self._measure_onset()
        if len(whole):
            self.steps = int(whole["step"][-1])
            self.confinement = float(whole["confinement"][-1])
            if _SECOND in whole:
                self.second_confinement = float(whole[_SECOND][-1])
            self.tensile_cracks = int(whole["tensile_cracks"][-1])
            self.shear_cracks = int(whole["shear_cracks"][-1])
        peak = measures.peak_row(record)
        if peak is not None:
            self.peak_stress = float(record["axial_stress"][peak])
            self.peak_strain = float(record["axial_strain"][peak])
        of_loading = measures.unbalanced_under_way if waiting else measures.median_unbalanced_ratio
        ratio = of_loading(record)
        unknown = ratio is None and math.isfinite(max_unbalanced)
        fast = unknown or (ratio is not None and ratio > max_unbalanced)
        growth = None if crossing is None else measures.growth_before_peak(record, crossing)
        largest = doubts.LARGEST_GROWTH_OF_JOINTS.get(self.model, math.inf)
        fast = fast or (growth is not None and growth > largest)
        self.status = self._status(diverged, peak, fast)

    def measure_core(self, *, solid: bool, dynamic: bool) -> None:
        """Compute the quantities that a laboratory measures on a core, and add its volume."""
        record = self.curve
        found = core.crack_thresholds(record, *self._moduli(dynamic=dynamic), solid=solid)
        for name, value in found.stresses.items():
            setattr(self, name, value)
        self.drop_after_peak = descent.drop_after_peak(record)
        reasons = dict(found.reasons)
        if self.drop_after_peak is None:
            reasons["drop_after_peak"] = descent.ENDS_EARLY
        self.null_reasons = reasons or None
        self.curve = core.with_volume(record, solid=solid)

    def measure_first_cracks(self, origin: tuple[float, float], length: float) -> None:
        """Compute the position of the first cracks, and the stress at which they appear.

        Args:
            origin: Position in the section at which the formula of the test assumes the first crack
                [m]: the centre of a disc, or the tip of a notch.
            length: Radius of the disc, or ligament [m].
        """
        cracks = [crack for crack in self.cracks if crack.mode in MODES]
        if not cracks:
            return
        _, self.first_crack_stress = measures.crack_onset(self.curve, [cracks[0].step])
        places = [(one.x, one.y if one.z is None else one.z) for one in cracks[:FIRST_CRACKS]]
        distances = np.linalg.norm(np.subtract(places, origin), axis=1)
        self.first_crack_distance = float(np.median(distances)) / length

    @property
    def start_moduli(self) -> tuple[float | None, float | None]:
        """Young's modulus [Pa] and Poisson's ratio [-] of the elastic start of the loading.

        Particles, spheres and real masses have no elastic start: the values then belong to the
        elastic part of the record.
        """
        return self._moduli(dynamic=(self.inputs or {}).get("dynamic", False))

    def _moduli(self, *, dynamic: bool) -> tuple[float | None, float | None]:
        if self.model in _SOFTENING and not dynamic:
            return measures.start_moduli(self.curve)
        return self.youngs_modulus, self.poissons_ratio

    def measure_wave(self, wave: str, distance: float) -> None:
        """Store the speed of a pulse.

        Args:
            wave: ``p`` or ``s``.
            distance: Distance between the two sections of the measurement [m].
        """
        setattr(self, waves.name_of(wave), waves.speed(self.curve, distance))

    def measure_fragments(self, snapshot: AnySnapshot) -> None:
        """Store the final state and count its fragments."""
        found = snapshot.fragments
        self.snapshot = snapshot
        self.fragments = len(found)
        self.largest_fragment = float(found.areas[0] / found.areas.sum()) if len(found) else 0.0

    def measure_emission(self, rule: EventRule) -> None:
        """Find the events among the cracks, and count the events of each magnitude."""
        self.emission = find_events(self.cracks, rule)
        self.events = len(self.emission)
        found = frequencies(np.array([one.magnitude for one in self.emission]))
        self.completeness_magnitude, self.b_value, self.b_value_error = found

    def _measure_onset(self) -> None:
        for mode, name in MODES.items():
            steps = [crack.step for crack in self.cracks if crack.mode == mode]
            labels = {f"first_{name}_crack": 0.0, f"{name}_onset": measures.ONSET_SHARE}
            for label, share in labels.items():
                strain, stress = measures.crack_onset(self.curve, steps, share)
                setattr(self, f"{label}_strain", strain)
                setattr(self, f"{label}_stress", stress)

    def _status(self, diverged: bool, peak: int | None, fast: bool) -> str:
        stress = self.curve["axial_stress"]
        if diverged or (len(stress) and not math.isfinite(stress[-1])):
            return "diverged"
        if self.energy_error is not None and self.energy_error > doubts.LARGEST_ENERGY_ERROR:
            return "not_quasistatic"
        if peak is None and kind_of(self.test).needs_peak:
            return "no_peak"
        return "not_quasistatic" if fast else "ok"

    def as_dict(self) -> Table:
        """Return the content of result.json; numbers that are not finite become None.

        Example:
            >>> content = flexpm.run("tension", specimen, rate=6.0).as_dict()
            >>> content["status"], content["inputs"]["test"]
            ('not_quasistatic', 'tension')
        """
        hidden = ("curve", "cracks", "emission", "snapshot", "resumed_at")
        content = {
            name: _plain(getattr(self, name))
            for name in self.__dataclass_fields__
            if name not in hidden
        }
        inputs = content.pop("inputs")
        for name in OF_SOLIDS:
            if content[name] is None:
                del content[name]
        if isinstance(sets := content["networks"], dict):
            content["networks"] = {name: Renamed(one, NETWORKS) for name, one in sets.items()}
        whole = content | {"warnings": self.warnings, "inputs": inputs}
        return Renamed(whole, ATTRIBUTES["Result"])

    @classmethod
    def read(cls, folder: Path | str, name: str = FINISHED) -> Result:
        """Read the files of a run: numbers, inputs, record and cracks; no final state.

        Args:
            folder: Folder of the run, with result.json, curve.csv and cracks.csv.
            name: File with the numbers: ``result.json``, or ``unfinished.json`` if the run has not
                ended.

        Raises:
            InputError: if a file cannot be read, or does not belong to a run.
        """
        folder = Path(folder)
        content = current(load_json(folder / name, "result"))
        given = {key: value for key, value in content.items() if key in cls.__dataclass_fields__}
        require_sense(folder / name, given, fields(cls))
        result = cls(**given)
        if result.networks is not None:
            result.networks = {k: Renamed(v, NETWORKS) for k, v in result.networks.items()}
        result.curve = Curve.read(folder / "curve.csv")
        result.cracks = read_cracks(folder / "cracks.csv")
        if result.events is not None:
            result.emission = read_events(folder / "events.csv")
        return result

    def write(self, folder: Path | str, name: str = FINISHED) -> None:
        """Write the tables and then the numbers into `folder`, each file completely or not at all.

        Args:
            folder: Folder of the files; made if it does not exist.
            name: File of the numbers, see `read`.

        Example:
            >>> import tempfile
            >>> folder = tempfile.mkdtemp()
            >>> result = flexpm.run("tension", specimen, rate=6.0)
            >>> result.write(folder)
            >>> flexpm.Result.read(folder).peak_stress == result.peak_stress
            True
        """
        folder = output_folder(folder)
        write_text(folder / "curve.csv", self.curve.csv())
        write_text(folder / "cracks.csv", cracks_csv(self.cracks))
        if self.emission is not None:
            write_text(folder / "events.csv", events_csv(self.emission))
        if self.snapshot is not None:
            write_text(
                folder / "fragments.csv", self.snapshot.fragments.csv(self.snapshot.size_name)
            )
        write_text(folder / name, json_text(with_old_keys(self.as_dict())))


def _plain(value: object) -> object:
    """Convert numpy numbers into Python's and numbers that are not finite into None."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
