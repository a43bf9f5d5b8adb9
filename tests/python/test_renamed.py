# SPDX-License-Identifier: GPL-3.0-or-later
"""Old public names: they work, warn at the caller's line, and files with them are read."""

from __future__ import annotations

import json
import signal
import warnings
from dataclasses import asdict

import numpy as np
import pytest
import yade
from killed_scripts import ended, started
from refusals import refusal
from scenes import fresh
from step_clock import STEP

import flexpm
from flexpm import renamed
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.results.record import COLUMNS, Curve
from flexpm.results.result import Result
from flexpm.rigs.outcome import kept
from flexpm.runs import checkpoint
from flexpm.studies import jobs, picture_spec
from flexpm.studies.jobs import known

SQUARE = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)


def old(call, new: str):
    """What a call with an old name gives; it warns once, in this file, and names the new name."""
    with pytest.warns(FutureWarning, match=f"is now called '?{new}.*goes with flexpm 0.4") as found:
        result = call()
    assert [one.filename for one in found] == [__file__]
    assert [one.lineno for one in found] == [call.__code__.co_firstlineno]
    return result


@pytest.fixture
def rig():
    return flexpm.PartRig(fresh(SQUARE, None, "rigid"))


def test_methods_and_attributes_of_a_rig(rig):
    base, top = rig.platen(0, seated=True), rig.platen(2)
    held = rig.hold(box=((0.005, 0.005), (0.007, 0.007)))
    old(lambda: rig.way_of("w", top, (0.0, -1.0)), "displacement_of")
    old(lambda: rig.angle_of("tilt", base), "rotation_of")
    old(lambda: rig.turn(held), "rotate")
    old(lambda: rig.also("q", "axial_stress"), "alias_column")
    assert old(lambda: rig.laid, "layout") == rig.layout
    assert old(lambda: top.place, "position") == top.position
    assert [one["gauge"] for one in rig.gauges] == ["w", "tilt"]


def test_the_contact_angle_of_a_jaw():
    disc = flexpm.Specimen.disc(0.012, 0.01, seed=1)
    rig = flexpm.PartRig(fresh(disc, None, "rigid"))
    x, y = disc.outline.x, disc.outline.y
    radius = disc.outline.radius
    jaw = old(lambda: rig.jaw(place=(x, y + radius), radius=1.5 * radius), "position")
    old(lambda: rig.contact_of("angle", jaw), "contact_angle_of")
    assert rig.gauges[0]["reads"] == "contact_angle"


def test_arguments_of_a_rig(rig):
    pin = old(lambda: rig.support(place=(0.006, 0.0), length=0.006), "position")
    assert pin.requested_position == (0.006, 0.0)
    top = rig.platen(2, friction=0.5)
    rig.drive(top, (0.0, -1.0), against=pin)
    state = old(lambda: rig.elastic(way=1e-7), "displacement")
    assert state.load == rig.elastic(displacement=1e-7).load
    rig.strain_to(1e-7)
    with pytest.warns(FutureWarning) as found:
        rig.dwell(crossings=3.0, by="way")
    assert [str(one.message).partition(";")[0] for one in found] == [
        "dwell: crossings= is now called transits=",
        "dwell: by='way' is now called 'displacement'",
    ]
    old(lambda: rig.cycle(2e-7, by="way"), "displacement")
    old(lambda: rig.relax(crossings=500.0), "transits")
    old(lambda: rig.unload(crossings=500.0), "transits")
    told = [{name: one.get(name) for name in ("by", "transits")} for one in rig.stages[1:3]]
    assert told == [
        {"by": "displacement", "transits": 3.0},
        {"by": "displacement", "transits": None},
    ]


def test_settle_takes_its_transits_by_the_old_name():
    rig = flexpm.PartRig(fresh(SQUARE, None, "rigid", dynamic=True, gravity=9.81))
    rig.platen(0)
    old(lambda: rig.settle(crossings=5, moving=True), "transits")


def test_the_ends_of_a_test_and_a_solid_take_old_names():
    ends = flexpm.rig(fresh(SQUARE, None, "rigid"))
    assert old(lambda: ends.elastic(way=1e-7), "displacement").load
    assert old(lambda: ends.laid, "layout") == ends.layout
    box = flexpm.Specimen.box(0.012, 0.012, 0.012, seed=1)
    rig = flexpm.PartRig(fresh(box, None, "rigid"))
    low, high = (rig.hold(box=((0, 0, z), (0.012, 0.012, z + 0.003))) for z in (0.0, 0.009))
    old(lambda: rig.turn(high, low), "rotate")
    assert old(lambda: rig.elastic(way=1e-3), "displacement").load
    old(lambda: rig.support(place=(0.0, 0.006, 0.006), length=0.003), "position")
    assert old(lambda: box.joint_bends(), "joint_deviations") == {}


@pytest.mark.parametrize(
    ("method", "given"),
    [
        ("support", {"place": (0.006, 0.0), "position": (0.006, 0.0)}),
        ("elastic", {"way": 1e-7, "displacement": 1e-7}),
        ("relax", {"crossings": 100.0, "transits": 100.0}),
    ],
)
def test_both_names_in_one_call_are_refused(rig, method, given):
    first, second = given
    message = f"{method}: {first}, {second} = both given, must be one of them"
    refusal(message, getattr(rig, method), **given)


def test_a_machine_has_its_column_by_both_names(rig):
    base, top = (rig.platen(side, friction=0.5) for side in (0, 2))
    rig.drive(top, (0.0, -1.0), against=base, machine=1e9)
    old(lambda: rig.alias_column("cross", "crosshead"), "crosshead_displacement")
    assert old(lambda: rig.reading("crosshead"), "crosshead_displacement") == 0.0
    control = flexpm.Loading(control="crosshead", max_strain=2e-8)
    old(lambda: rig.load(control), "crosshead_displacement")
    record = rig.record
    now = record["crosshead_displacement"]
    assert now[-1] > 0.0
    assert np.array_equal(old(lambda: record["crosshead"], "crosshead_displacement"), now)
    assert np.array_equal(record["cross"], now)
    assert "crosshead" not in record


def test_a_record_that_began_with_the_old_column_goes_on_with_the_new_one(rig):
    base, top = (rig.platen(side, friction=0.5) for side in (0, 2))
    rig.drive(top, (0.0, -1.0), against=base, machine=1e9)
    rig.strain_to(1e-7)
    before = rig.record["crosshead_displacement"]
    for gauge in rig._recorder.gauges:
        gauge.name = gauge.reads  # as a scene of an earlier version has it
    again = flexpm.PartRig(rig.built)
    base, top = (again.platen(side, friction=0.5) for side in (0, 2))
    again.drive(top, (0.0, -1.0), against=base, machine=1e9)
    again.strain_to(2e-7)
    record = again.record["crosshead_displacement"]
    assert np.array_equal(record[: len(before)], before)
    assert len(record) > len(before)


def test_a_gauge_that_a_script_calls_by_an_old_name_is_its_own(rig):
    base, top = (rig.platen(side, friction=0.5) for side in (0, 2))
    rig.gauge("crosshead", (0.006, 0.0), (0.006, 0.012))
    rig.drive(top, (0.0, -1.0), against=base)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert rig.reading("crosshead") == 0.0
        rig.strain_to(1e-7)
        assert len(rig.record["crosshead"])


def table(names: str, *rows: tuple[float, ...]) -> str:
    return "\n".join([names, *(",".join(map(str, row)) for row in rows), ""])


def test_curve_csv_has_the_column_by_both_names_and_is_read_by_either(tmp_path):
    names, file = ("crosshead_displacement", "machine_energy"), tmp_path / "curve.csv"
    curve = Curve(names)
    for step in range(3):
        curve.append(**dict.fromkeys(COLUMNS, 0.0) | {"step": step}, **dict.fromkeys(names, 1.5))
    text = curve.csv()
    head = text.splitlines()[0].split(",")
    assert head[-3:] == [*names, "crosshead"]
    for content in (
        text,
        text.replace("crosshead_displacement", "crosshead", 1).replace(",crosshead\n", ",f\n", 1),
    ):
        file.write_text(content)
        back = Curve.read(file)
        assert back.columns[: len(curve.columns)] == curve.columns
        assert np.array_equal(back["crosshead_displacement"], curve["crosshead_displacement"])
    # a gauge of a script beside no machine, and one that is not the machine's
    file.write_text(table("step,crosshead", (1, 2.0)))
    assert Curve.read(file).own == ("crosshead",)
    file.write_text(table("step,crosshead,crosshead_displacement", (1, 2.0, 3.0)))
    assert Curve.read(file).own == ("crosshead", "crosshead_displacement")


def sample() -> Result:
    result = Result("0.3", "y", "uniaxial", "rigid", {"name": "m"}, 1, 9, 9, None, None)
    result.tangent_modulus_ratio, result.joint_deviation = 0.9, 1e-4
    result.largest_separation = 0.1
    result.networks = {"a": {"target": 3.0, "generated": 2.0, "cut": 1.0}}
    return result


NAMES = {
    "late_modulus": "tangent_modulus_ratio",
    "joint_bend": "joint_deviation",
    "largest_parting": "largest_separation",
}


def test_result_json_has_both_keys_and_is_read_by_either(tmp_path):
    result = sample()
    result.write(tmp_path)
    content = json.loads((tmp_path / "result.json").read_text())
    for before, now in NAMES.items():
        assert content[before] == content[now] == getattr(result, now)
    both = {"target": 3.0, "generated": 2.0, "cut": 1.0, "asked": 3.0, "drawn": 2.0}
    assert content["networks"]["a"] == both
    assert Result.read(tmp_path).as_dict() == result.as_dict()
    earlier = {key: one for key, one in content.items() if key not in NAMES.values()}
    earlier["networks"] = {"a": {"asked": 3.0, "drawn": 2.0, "cut": 1.0}}
    (tmp_path / "result.json").write_text(json.dumps(earlier))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = Result.read(tmp_path)
        assert again.as_dict() == result.as_dict()
        assert known_measures(tmp_path)["tangent_modulus_ratio"] == 0.9
    assert old(lambda: again.networks["a"]["asked"], "target") == 3.0
    assert old(lambda: again.networks["a"]["drawn"], "generated") == 2.0


def known_measures(folder):
    return jobs._measures(folder / "result.json")


def test_attributes_of_a_result():
    result = sample()
    assert old(lambda: result.late_modulus, "tangent_modulus_ratio") == 0.9
    assert old(lambda: result.joint_bend, "joint_deviation") == 1e-4
    assert old(lambda: result.largest_parting, "largest_separation") == 0.1
    assert old(lambda: result.as_dict()["joint_bend"], "joint_deviation") == 1e-4
    assert old(lambda: result.as_dict()["networks"]["a"]["asked"], "target") == 3.0
    with pytest.warns(FutureWarning, match="now called joint_deviation"):
        result.joint_bend = 2e-4
    assert result.joint_deviation == 2e-4
    given = ("0.3", "y", "uniaxial", "rigid", {}, 1, 9, 9, None, None)
    made = old(lambda: Result(*given, late_modulus=0.5), "tangent_modulus_ratio")
    assert made.tangent_modulus_ratio == 0.5
    with pytest.raises(InputError, match="late_modulus, tangent_modulus_ratio = both given"):
        Result(*given, late_modulus=0.5, tangent_modulus_ratio=0.5)


def test_specimens_have_their_joint_deviations_and_networks_by_old_names():
    cut = SQUARE.with_joints({"weak": [((0.0, 0.006), (0.012, 0.006))]})
    assert old(lambda: cut.joint_bends(), "joint_deviations") == cut.joint_deviations()
    one = renamed.Renamed({"target": 1.0}, renamed.NETWORKS)
    assert old(lambda: one["asked"], "target") == 1.0
    assert old(lambda: one.get("asked"), "target") == 1.0
    assert one.get("drawn", 2.0) == 2.0
    with pytest.raises(KeyError):
        one["drawn"]


def test_a_model_has_its_joint_deviation_by_the_old_name():
    model = fresh(SQUARE, None, "rigid")
    assert old(lambda: model.joint_bend, "joint_deviation") is None


def test_a_result_with_networks_is_a_plain_table_of_a_dataclass():
    result = sample()
    assert result.networks is not None
    result.networks["a"] = renamed.Renamed(result.networks["a"], renamed.NETWORKS)
    assert asdict(result)["networks"] == {"a": {"target": 3.0, "generated": 2.0, "cut": 1.0}}


def test_a_picture_of_a_study_takes_the_old_column():
    entries = {"x": "seed", "y": "late_modulus", "by": ["model"], "where": {"joint_bend": 0.0}}
    with pytest.warns(FutureWarning, match="tangent_modulus_ratio|joint_deviation"):
        found = picture_spec.checked(entries, ["seed", "model"])
    assert found["y"] == "tangent_modulus_ratio"
    assert found["where"] == {"joint_deviation": 0.0}
    own = picture_spec.checked(entries | {"where": {}}, ["seed", "model", "late_modulus"])
    assert own["y"] == "late_modulus"  # an input of a script has this name


def test_the_outcome_of_an_earlier_run_of_a_study_has_the_present_measures(tmp_path):
    outcome = {"exit_code": 0, "message": "", "key": "k", "result": {"late_modulus": 0.9}}
    (tmp_path / "outcome.json").write_text(json.dumps(outcome))
    assert known(tmp_path)["result"] == {"tangent_modulus_ratio": 0.9}


#: A beam in a soft machine, by old names; it kills itself at a step if there is a file with one.
BEGUN = """
import pathlib, flexpm
from self_signals import at_steps
from step_clock import step_clock
step_clock(setattr, look=10)
last = int(pathlib.Path("last").read_text())
at_steps([(last, 9)] if last else [])
made = flexpm.Specimen.rectangle(0.012, 0.012, 0.01, seed=1)
built = flexpm.build(made, model="rigid")
rig = flexpm.PartRig(built, out="out", checkpoint_interval=INTERVAL, report=False)
base = rig.support(place=(0.006, 0.0), length=0.006)
top = rig.platen(2, friction=0.5, seated=True)
rig.drive(top, (0.0, -1.0), against=base, machine=4e8)
rig.angle_of("tilt", top)
rig.way_of("down", top, (0.0, -1.0))
rig.also("cross", "crosshead")
rig.strain_to(1e-7)
rig.dwell(crossings=3.0, by="way")
rig.relax(crossings=500.0)
"""
PRESENT = {
    **{"place=": "position=", "angle_of": "rotation_of", "way_of": "displacement_of"},
    **{"also": "alias_column", '"crosshead"': '"crosshead_displacement"'},
    **{"crossings=": "transits=", '"way"': '"displacement"'},
}


def translated(text: str, names: dict[str, str]) -> str:
    for one, other in names.items():
        text = text.replace(one, other)
    return text


@pytest.mark.parametrize("names", [{}, PRESENT], ids=["old", "new"])
def test_a_test_that_was_begun_under_old_names_goes_on(tmp_path, names):
    (tmp_path / "last").write_text("120")
    assert ended(started(tmp_path, BEGUN, interval=40 * STEP))[0] == -signal.SIGKILL
    file = tmp_path / "out" / "checkpoint.json"
    content = json.loads(file.read_text())
    calls = content["told"]["calls"]
    before = {new: one for one, new in renamed.ATTRIBUTES["PartRig"].items()}
    for call in calls:  # as an earlier version has written them
        call["call"] = before.get(call["call"], call["call"])
        given = {"position": "place", "transits": "crossings"}
        call["with"] = {given.get(key, key): one for key, one in call["with"].items()}
        if call["with"].get("by") == "displacement":
            call["with"]["by"] = "way"
    assert {"way_of", "angle_of", "also"} <= {call["call"] for call in calls}
    del content[checkpoint._CHECKSUM]
    scene = tmp_path / "out" / content["scene"]
    content[checkpoint._CHECKSUM] = checkpoint._checksum(content, scene)
    file.write_text(json.dumps(content))
    (tmp_path / "last").write_text("0")
    process = started(tmp_path, translated(BEGUN, names), interval=40 * STEP)
    code, line = ended(process)
    assert code == 0, line
    found = json.loads((tmp_path / "out" / "result.json").read_text())
    calls = found["inputs"]["calls"]
    assert not {"way_of", "angle_of", "also"} & {call["call"] for call in calls}
    assert [one["transits"] for one in found["inputs"]["stages"][1:]] == [3.0, 500.0]
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "last").write_text("0")
    code, line = ended(started(tmp_path / "other", translated(BEGUN, PRESENT)))
    assert (code, line) == (0, "")
    for name in ("curve.csv", "cracks.csv"):
        whole = tmp_path / "other" / "out" / name
        assert (tmp_path / "out" / name).read_bytes() == whole.read_bytes()


def test_calls_of_an_earlier_version_are_made_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    yade.O.reset()
    built = flexpm.build(SQUARE, model="rigid")
    rig = flexpm.PartRig(built, out=tmp_path / "out", report=False)
    base, top = (rig.platen(side, friction=0.5) for side in (0, 2))
    rig.drive(top, (0.0, -1.0), against=base)
    rig.displacement_of("down", top, (0.0, -1.0))
    rig.strain_to(1e-7)
    rig.dwell(3.0, by="displacement")
    kept.close_open()
    file = tmp_path / "out" / "result.json"
    text = file.read_text().replace('"displacement_of"', '"way_of"')
    text = text.replace('"by": "displacement"', '"by": "way"').replace("transits", "crossings")
    file.write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FutureWarning)
        assert cli.main(["rerun", str(file), "--out", "again", "--no-report"]) == 0
    for name in ("curve.csv", "cracks.csv"):
        again = tmp_path / "again" / name
        assert again.read_bytes() == (tmp_path / "out" / name).read_bytes()
