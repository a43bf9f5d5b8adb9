# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of a run that a disk or an editor has changed: refused in one line, or read as they are."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sample_snapshot import read_vtu as read_by_vtk
from sample_snapshot import wall

import flexpm
from flexpm.cli import main as cli
from flexpm.errors import InputError
from flexpm.results.vtu import read_vtu, write_vtu
from flexpm.results.vtu_reader import grid_of

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
