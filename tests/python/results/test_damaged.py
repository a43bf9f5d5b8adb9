# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of a run that a disk or an editor has changed: refused in one line, or read as they are."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from fuzz_child import drawing
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sample_snapshot import read_vtu as read_by_vtk
from sample_snapshot import wall

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.results.arrays.vtu_reader import grid_of
from flexpm.results.result import Result
from flexpm.results.vtu import read_vtu, write_vtu

NUMBERS = ["0", "1", "-1", "5", "99999999999", "2147483648", "1e9", "a"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> bytes:
    """A state with a text, as a run writes it."""
    path = tmp_path_factory.mktemp("state") / "it.vtu"
    write_vtu(path, wall(), {"material": "granite"})
    return path.read_bytes()


@st.composite
def changes(draw):
    """How a file is changed: cut, overwritten, shortened, doubled, or by another number."""
    kind = draw(st.sampled_from(["cut", "bytes", "letters", "gap", "double", "number"]))
    places = st.floats(0.0, 1.0, exclude_max=True)
    values = st.lists(st.tuples(places, st.integers(0, 255)), min_size=1, max_size=12)
    return kind, draw(values), draw(st.integers(1, 400)), draw(st.sampled_from(NUMBERS))


def changed(content: bytes, change) -> bytes:
    kind, values, length, number = change
    one = bytearray(content)
    places = [int(place * len(one)) for place, _ in values]
    if kind == "cut":
        return bytes(one[: places[0]])
    if kind in ("bytes", "letters"):
        for place, (_, value) in zip(places, values, strict=True):
            one[place] = value if kind == "bytes" else b'ABCabc019/+="<>'[value % 15]
    elif kind == "gap":
        del one[places[0] : places[0] + length]
    elif kind == "double":
        one[places[0] : places[0] + length] = one[places[-1] : places[-1] + length]
    else:
        numbers = list(re.finditer(rb'(?<==")[0-9]+(?=")', content))
        found = numbers[places[0] % len(numbers)]
        one[found.start() : found.end()] = number.encode()
    return bytes(one)


@given(change=changes())
@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_state_that_was_changed_is_refused_or_read(whole, tmp_path_factory, capfd, change):
    """VTK's own reader ends the process for some of them, and never ends for others."""
    path = tmp_path_factory.getbasetemp() / "changed.vtu"
    path.write_bytes(changed(whole, change))
    try:
        assert len(read_vtu(path).triangles) > 0
    except InputError as error:
        assert "is damaged" in str(error)
    assert capfd.readouterr().err == ""


def test_arrays_are_those_that_vtk_reads(whole, tmp_path):
    (tmp_path / "it.vtu").write_bytes(whole)
    _, points, cells = read_by_vtk(tmp_path / "it.vtu")
    grid = grid_of(whole)
    for mine, theirs in ((grid.points, points), (grid.cells, cells)):
        assert mine.keys() == theirs.keys()
        for name, values in theirs.items():
            assert np.array_equal(mine[name], values, equal_nan=True), name


@pytest.mark.parametrize("name", ["a\0b", "a\nb", "\x1b[31m", "a" * 300])
def test_a_material_of_any_name_has_its_files(capfd, tmp_path, name):
    """VTK reads behind a text that a NUL ends too early."""
    rock = flexpm.materials.load("augig-table7")
    text = (tmp_path / "m.toml").write_text
    law = {**rock.law(), "name": name}
    keys = ("tensile_strength", "cohesion", "friction")
    escaped = "".join(f"\\u{ord(one):04x}" for one in name)
    text(
        f'name = "{escaped}"\nsoftening = "brittle"\n'
        + "".join(f"{key} = {law[key]!r}\n" for key in keys)
        + "[elastic.flexible]\n"
        + "".join(
            f"{key} = {law[key]!r}\n"
            for key in ("young", "poisson", "normal_stiffness", "shear_ratio")
        )
    )
    size = ["--width", "0.012", "--height", "0.016", "--quiet", "--max-strain", "1e-6"]
    run = ["run", "uniaxial", *size, "--rate", "50", "--material", str(tmp_path / "m.toml")]
    assert cli.main([*run, "--frames", "1", "--out", str(tmp_path / "out")]) == 3
    assert cli.main(["report", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "report.html").read_text()
    assert "no map" not in page
    assert not set("\0\x1b") & set(page)
    state = (tmp_path / "out" / "frames.pvsm").read_text()
    assert not set("\0\x1b") & set(state)
    # also VTK's own reader takes the file
    read_by_vtk(tmp_path / "out" / "specimen.vtu")
    assert capfd.readouterr().err.count("\n") == 1


def test_the_page_says_that_a_map_is_missing(capfd, tmp_path):
    size = ["--width", "0.012", "--height", "0.016", "--quiet", "--max-strain", "1e-6"]
    assert cli.main(["run", "tension", *size, "--rate", "50", "--out", str(tmp_path)]) == 3
    capfd.readouterr()
    whole = (tmp_path / "specimen.vtu").read_bytes()
    for content in (b"", whole[:2000], b"\x07" * 5000, None):
        if content is None:
            (tmp_path / "specimen.vtu").unlink()
        else:
            (tmp_path / "specimen.vtu").write_bytes(content)
        assert cli.main(["report", str(tmp_path)]) == 0
        assert "no map: state = " in (tmp_path / "report.html").read_text()
        assert capfd.readouterr().err == ""


@pytest.fixture(scope="module")
def finished(tmp_path_factory) -> dict[str, str]:
    """Files of a run by name, as texts."""
    folder = tmp_path_factory.mktemp("finished")
    size = ["--width", "0.012", "--height", "0.016", "--quiet", "--rate", "8"]
    assert cli.main(["run", "tension", *size, "--out", str(folder)]) == 0
    names = ("result.json", "curve.csv", "cracks.csv", "events.csv")
    return {name: (folder / name).read_text() for name in names}


def reported(capsys, folder, files) -> None:
    """`flexpm report` of files: done, or one line of wrong input."""
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text)
    capsys.readouterr()
    code = cli.main(["report", str(folder)])
    errors = capsys.readouterr().err
    assert code in (0, 2), errors
    assert errors.count("\n") == (code != 0), errors


MINERALS = [None, {}, [{}], [{"name": 1}], "a", [None]]


@pytest.mark.parametrize(
    ("way", "value"),
    [
        (("inputs", "rate"), "absent"),
        (("inputs", "material"), "absent"),
        (("inputs",), {}),
        (("inputs", "specimen"), []),
        *((("material", "minerals"), value) for value in MINERALS),
        *((("inputs", "material", "joints"), value) for value in MINERALS),
        (("status",), "fine"),
        (("test",), "nothing"),
        (("grains",), -1),
        (("largest_fragment",), 1.5),
        (("step_time",), -1.0),
        (("peak_stress",), [1.0]),
    ],
)
def test_a_result_of_no_run_is_one_line(capsys, tmp_path, finished, way, value):
    content = json.loads(finished["result.json"])
    table = content
    for name in way[:-1]:
        table = table[name]
    if value == "absent":
        del table[way[-1]]
    else:
        table[way[-1]] = value
    reported(capsys, tmp_path, {**finished, "result.json": json.dumps(content)})
    try:
        assert isinstance(Result.read(tmp_path).warnings, list)
    except InputError as error:
        assert "\n" not in str(error)


ODD = st.sampled_from([None, True, -1, 0, 5, 2**63, 1e300, "", "a", "nan", [], {}, [0], [{}]])
WAYS = st.lists(st.floats(0.0, 1.0, exclude_max=True), min_size=1, max_size=4)


@given(name=st.sampled_from(["curve.csv", "cracks.csv", "events.csv"]), change=changes())
@drawing(60)
def test_tables_that_were_changed_are_reported_or_refused(
    capsys, tmp_path_factory, finished, name, change
):
    text = changed(finished[name].encode(), (*change[:3], "1")) if change[0] != "number" else b""
    files = {**finished, name: text.decode(errors="replace")}
    reported(capsys, tmp_path_factory.getbasetemp() / "tables", files)


@given(way=WAYS, value=ODD)
@drawing(120)
def test_numbers_that_were_changed_are_reported_or_refused(
    capsys, tmp_path_factory, finished, way, value
):
    content = json.loads(finished["result.json"])
    here, place, key = content, None, None
    for share in way:
        if not isinstance(here, dict | list) or not here:
            break
        keys = [*here] if isinstance(here, dict) else range(len(here))
        place, key = here, keys[int(share * len(keys))]
        here = here[key]
    place[key] = value
    files = {**finished, "result.json": json.dumps(content)}
    reported(capsys, tmp_path_factory.getbasetemp() / "numbers", files)
