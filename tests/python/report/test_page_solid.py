# SPDX-License-Identifier: GPL-3.0-or-later
"""A solid that turns on its page: its faces, its arrays, and how it looks in a browser."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from browser import opened, shown, slide
from processes import wait_for

import flexpm
from flexpm.cli import main as cli
from flexpm.report.pages import page, page_map, page_run, page_solid
from flexpm.results.result import Result
from flexpm.results.vtu import read_state, write_vtu

SIZES = (0.008, 0.008, 0.016)


@pytest.fixture(scope="module")
def ended(tmp_path_factory) -> Path:
    """Folder of a small fast run of a box that has cracked."""
    folder = tmp_path_factory.mktemp("solid") / "out"
    sizes = zip(("width", "depth", "height"), map(str, SIZES), strict=True)
    command = ["run", "uniaxial", "--shape", "box", *(f"--{name}={one}" for name, one in sizes)]
    assert cli.main([*command, "--rate", "4", "--quiet", "--out", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    """A browser that draws WebGL by its processor."""
    yield from opened("--use-angle=swiftshader", "--enable-unsafe-swiftshader")


@pytest.fixture(scope="module")
def without_webgl() -> Iterator[object]:
    yield from opened("--disable-3d-apis")


def view_of(folder: Path):
    return page_run.run_map(folder, Result.read(folder), "map", "", None, turns=True).view


def copied(folder: Path, to: Path) -> Path:
    """Folder with what a page is made of."""
    to.mkdir()
    for file in folder.iterdir():
        if file.suffix in (".json", ".csv", ".vtu", ".png"):
            (to / file.name).write_bytes(file.read_bytes())
    return to


def numbers(data: bytes, count: int) -> tuple[np.ndarray, bytes]:
    """Whole numbers of seven bits a byte, read one by one, and the bytes after them."""
    found, at = [], 0
    while len(found) < count:
        value = shift = 0
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        found.append(-(value + 1) // 2 if value % 2 else value // 2)
    return np.array(found), data[at:]


def test_minerals_of_grains_beyond_a_section_are_left_out():
    """A section ends with the last grain that it cuts; the minerals are those of all grains."""
    drawing = SimpleNamespace(grain_mineral=np.array([0, 1, 0, 1]))
    found = page_map._rock(drawing, ["a", "", "c"], ["quartz", "feldspar"])
    assert [(name, path) for name, _, path in found] == [("quartz", "ac"), ("feldspar", "")]


def test_whole_numbers_come_back():
    values = np.array([0, 1, -1, 63, -64, 64, 8191, -8192, 2**27, -(2**27) - 5, 2**31, -(2**31)])
    found, rest = numbers(page_solid._varints(values) + b"rest", len(values))
    assert found.tolist() == values.tolist()
    assert rest == b"rest"


def test_faces_close_the_solid_and_are_those_of_its_contacts(ended):
    solid = read_state(ended / "specimen.vtu")
    faces = page_solid._faces(solid)
    contacts = len(solid.contact_grains)
    corners = faces.vertices[faces.corners[faces.sizes[:contacts].sum() :].reshape(-1, 3)]
    normals = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    width, depth, height = SIZES
    area = 2.0 * (width * depth + width * height + depth * height)
    assert np.linalg.norm(normals, axis=1).sum() == pytest.approx(area, rel=1e-12)
    assert np.abs(normals.sum(axis=0)).max() < 1e-12 * area
    first = faces.vertices[faces.corners[: faces.sizes[0]]]
    assert first == pytest.approx(solid.corner_reference[: len(first)], abs=1e-9)
    assert faces.grains[:contacts].tolist() == solid.contact_grains.tolist()


def test_arrays_hold_places_faces_and_the_position_of_cracks(ended):
    view = view_of(ended)
    solid, cracks = read_state(ended / "specimen.vtu"), Result.read(ended).cracks
    data = zlib.decompress(base64.b64decode(view.data))
    count, places = view.counts, []
    for _ in range(3):
        grown, data = numbers(data, count["vertices"])
        places.append(np.cumsum(grown))
    longest = 1e-3 * max(view.size)
    assert 1e-3 * np.array(view.size) == pytest.approx(SIZES, rel=1e-5)
    assert [one.max() * longest / count["steps"] for one in places] == pytest.approx(
        SIZES, rel=1e-4
    )
    sizes, data = np.frombuffer(data, np.uint8, count["faces"]), data[count["faces"] :]
    for length in (sizes.sum(), count["faces"], count["faces"]):
        _, data = numbers(data, length)
    time_of = np.frombuffer(data, np.uint8, count["faces"])
    per_contact = np.bincount([one.contact for one in cracks], minlength=len(solid.contact_grains))
    halves = per_contact >= (np.diff(solid.point_offsets) + 1) // 2
    assert 0 < halves.sum() < len(halves)
    assert (time_of[: len(halves)] < 255).tolist() == halves.tolist()
    assert np.all(time_of[len(halves) :] == 255)
    joints = np.frombuffer(data, np.uint8)[2 * count["faces"] : 3 * count["faces"]]
    assert np.all(joints == 255)
    rest = 3 * count["faces"] + count["grains"] * (1 + count["positions"])
    assert len(data) == rest


def test_a_large_solid_leaves_out_what_no_cut_needs_to_show(ended, monkeypatch):
    whole = view_of(ended)
    monkeypatch.setattr(page_solid, "LARGEST_WHOLE", 1)
    part = view_of(ended)
    assert part.counts["faces"] < whole.counts["faces"]
    assert len(part.data) < len(whole.data)
    assert "are not shown" in part.note
    assert whole.note == ""


def test_a_very_large_solid_has_no_map_and_its_page_says_so(ended, tmp_path, monkeypatch):
    folder = copied(ended, tmp_path / "copy")
    grains = Result.read(folder).grains
    monkeypatch.setattr(page_run, "LARGEST_SOLID", grains - 1)
    assert cli.main(["report", str(folder)]) == 0
    text = (folder / page.FILE).read_text()
    assert f"no map: grains = {grains}, must be at most {grains - 1}" in text
    assert "map-solid" not in text
    monkeypatch.setattr(page_run, "LARGEST_SOLID", grains)
    assert cli.main(["report", str(folder)]) == 0
    assert "no map" not in (folder / page.FILE).read_text()


@pytest.mark.night
@pytest.mark.parametrize("kind", ["gone", "torn", "of the plane"])
def test_without_its_last_state_a_solid_has_no_stress(browser, ended, tmp_path, kind):
    folder = copied(ended, tmp_path / "copy")
    final = folder / "final.vtu"
    if kind == "gone":
        final.unlink()
    elif kind == "torn":
        final.write_bytes(final.read_bytes()[:3000])
    else:
        write_vtu(final, flexpm.build(flexpm.Specimen.rectangle(0.012, 0.012, 0.01)).snapshot())
    assert cli.main(["report", str(folder)]) == 0
    drawn(browser, folder / page.FILE)
    assert "No stress: final.vtu is missing" in browser.find_element("id", "map-solid-shown").text
    assert not browser.find_elements("css selector", "#map-solid-colour [value=stress]")
    assert len(view_of(ended).stress) == 2


def pixels(browser: object) -> str:
    return browser.execute_script("return document.getElementById('map-solid-canvas').toDataURL()")


def drawn(browser: object, file: Path) -> list[str]:
    asked_for = shown(browser, file)
    wait_for(lambda: browser.execute_script("return Boolean(views['map-solid'])"), each=0.1)
    return asked_for


def test_slider_cut_and_colours_change_what_is_seen(browser, ended):
    file = ended / page.FILE
    asked_for = drawn(browser, file)
    assert [url for url in asked_for if not url.startswith("data:")] == [file.as_uri()]
    seen = {pixels(browser)}
    for name, value in (
        *(("map-slider", 0), ("map-solid-axis", "y"), ("map-solid-cut", 30)),
        *(("map-solid-colour", "stress"), ("map-solid-colour", "fragment")),
        *(("map-slider", 100), ("map-solid-axis", "none"), ("map-solid-show", "cracks")),
    ):
        slide(browser, name, value)
        now = pixels(browser)
        assert now not in seen, f"{name} = {value} changes nothing"
        seen.add(now)
    assert not browser.find_element("id", "map-solid-missing").is_displayed()
    assert browser.get_log("browser") == []


def test_a_browser_without_webgl_says_so(without_webgl, ended):
    shown(without_webgl, ended / page.FILE)
    missing = without_webgl.find_element("id", "map-solid-missing")
    wait_for(missing.is_displayed, each=0.1)
    assert "no WebGL" in missing.text
    assert not without_webgl.find_element("id", "map-solid-shown").is_displayed()


@pytest.mark.night
def test_a_page_without_the_library_says_so(browser, ended, tmp_path, monkeypatch):
    assert "Permission is hereby granted" in (ended / page.FILE).read_text(encoding="utf-8")
    monkeypatch.setattr(page, "TURNING", (tmp_path / "none.js",))
    folder = copied(ended, tmp_path / "copy")
    assert cli.main(["report", str(folder)]) == 0
    shown(browser, folder / page.FILE)
    assert "libjs-three was not installed" in browser.find_element("id", "map-solid-missing").text
    assert browser.get_log("browser") == []


def test_a_large_picture_keeps_its_look_in_a_third_of_its_bytes(tmp_path):
    image = pytest.importorskip("PIL.Image")
    random = np.random.default_rng(1)
    colours = random.integers(90, 200, (16, 3))
    grains = np.kron(colours[random.integers(0, 16, (60, 60))], np.ones((16, 16, 1)))
    noisy = (grains + random.normal(0.0, 3.0, grains.shape)).clip(0, 255).astype(np.uint8)
    large, small = tmp_path / "outside.png", tmp_path / "curve.png"
    image.fromarray(noisy).save(large)
    image.new("RGB", (40, 40)).save(small)
    assert large.stat().st_size > 200_000
    kind, text = page.Picture("Outside", large).source.split(";base64,")
    assert kind == "data:image/webp"
    data = base64.b64decode(text)
    assert len(data) < 0.35 * large.stat().st_size
    (tmp_path / "page.webp").write_bytes(data)
    seen = np.asarray(image.open(tmp_path / "page.webp").convert("RGB"), dtype=float)
    assert np.abs(seen - grains).mean() < 6.0
    kind, text = page.Picture("Curve", small).source.split(";base64,")
    assert (kind, base64.b64decode(text)) == ("data:image/png", small.read_bytes())
