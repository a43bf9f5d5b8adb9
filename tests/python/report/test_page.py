# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of results: one file, what it says, and how it works in a browser without a network."""

from __future__ import annotations

import dataclasses
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from browser import opened, shown, slide
from refusals import refusal

import flexpm
from flexpm.cli import inputs, runs
from flexpm.cli import main as cli
from flexpm.materials.material import load
from flexpm.report.emission import emission_picture
from flexpm.report.pages import page, page_map, page_run, statuses
from flexpm.report.pages.page_core import volume_chart
from flexpm.results.emission import EventRule, find_events
from flexpm.results.result import Result
from flexpm.results.vtu import read_vtu
from flexpm.runs import asked
from flexpm.runs.run_spec import RunSpec
from flexpm.studies import pages

SIZE = ["--width", "0.012", "--height", "0.024", "--thickness", "0.01"]
#: Elements of HTML that have no end.
EMPTY = ("meta", "link", "img", "input", "path", "br")


class Balanced(HTMLParser):
    """Checks that each element that begins also ends."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.ids += [value for name, value in attrs if name == "id"]
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in EMPTY:
            assert self.open.pop() == tag


def parsed(file: Path) -> Balanced:
    parser = Balanced()
    parser.feed(file.read_text(encoding="utf-8"))
    assert parser.open == []
    assert len(set(parser.ids)) == len(parser.ids)
    return parser


@pytest.fixture(scope="module")
def ended(tmp_path_factory) -> Path:
    """Folder of a small fast run that has cracked and come apart."""
    folder = tmp_path_factory.mktemp("page") / "out"
    command = ["run", "uniaxial", *SIZE, "--rate", "8", "--quiet", "--out", str(folder)]
    # a thickness that is surely in another unit, for a warning
    assert cli.main([*command, "--set", "cohesion=29e6", "--thickness", "10"]) == 0
    return folder


@pytest.fixture(scope="module")
def compared(tmp_path_factory) -> Path:
    """Folder of a comparison."""
    folder = tmp_path_factory.mktemp("page") / "compared"
    command = ["compare", "tension", *SIZE, "--models", "flexible,jcfpm", "--quiet"]
    assert cli.main([*command, "--out", str(folder)]) == 0
    return folder


def test_a_page_says_what_was_asked_and_what_came_out(ended):
    text = (ended / page.FILE).read_text(encoding="utf-8")
    parsed(ended / page.FILE)
    result = Result.read(ended)
    assert f"<h2>{result.status}</h2>" in text
    assert statuses.STATUS[result.status].advice in text
    assert f"{1e-6 * result.peak_stress:.1f} MPa" in text
    assert "<td>cohesion</td><td>29 MPa</td><td>given</td>" in text
    assert "<td>friction</td><td>0.4</td><td>preset augig-table7</td>" in text
    assert "<td>height</td><td>24 mm</td><td>given</td>" in text
    assert "<td>porosity</td><td>0.1</td><td>default</td>" in text
    assert "flexpm rerun result.json" in text
    assert "10.3390/geotechnics2030026" in text
    assert "thickness = 10 m, unusual" in text


def test_the_strain_of_area_names_its_state(ended, tmp_path):
    """Grains without triangles and solids have none."""
    command = ["run", "uniaxial", *SIZE, "--rate", "20", "--quiet", "--out", str(tmp_path)]
    assert cli.main([*command, "--set", "plane=strain"]) in (0, 3)
    for folder, state, other in ((ended, "stress", "strain"), (tmp_path, "strain", "stress")):
        text = (folder / page.FILE).read_text(encoding="utf-8")
        assert f"Area strain up to the peak, plane {state}" in text
        assert f"plane {other}" not in text
    result = Result.read(ended)
    for changed in ({"model": "rigid"}, {"tetrahedra": 10}):
        title = volume_chart(dataclasses.replace(result, **changed)).title
        assert title.endswith("up to the peak")


def test_a_page_is_the_same_when_made_again_and_needs_no_yade(ended, package_parent):
    before = (ended / page.FILE).read_bytes()
    (ended / page.FILE).unlink()
    code = (
        "import sys; from flexpm.cli.main import main; assert main(sys.argv[1:]) == 0; "
        "assert 'yade' not in sys.modules"
    )
    environment = {"PYTHONPATH": str(package_parent), "FLEXPM_DEFER": "1", "PATH": "/usr/bin"}
    command = [sys.executable, "-c", code, "report", str(ended)]
    subprocess.run(command, check=True, env=environment, capture_output=True)
    assert (ended / page.FILE).read_bytes() == before


def test_a_command_without_a_page_does_not_load_what_makes_it(package_parent):
    code = "import flexpm.laboratory.protocols, sys; assert 'jinja2' not in sys.modules"
    subprocess.run(
        [sys.executable, "-c", code], check=True, env={"PYTHONPATH": str(package_parent)}
    )


def test_no_report_writes_none(tmp_path):
    command = ["run", "tension", *SIZE, "--max-strain", "2e-5", "--quiet"]
    assert cli.main([*command, "--no-report", "--out", str(tmp_path)]) == 3
    assert not (tmp_path / page.FILE).exists()
    assert cli.main(["report", str(tmp_path)]) == 0
    text = (tmp_path / page.FILE).read_text(encoding="utf-8")
    assert statuses.STATUS[Result.read(tmp_path).status].advice in text


def test_runs_of_a_comparison_have_no_page_of_their_own(compared):
    assert [file.parent for file in compared.rglob(page.FILE)] == [compared]
    text = (compared / page.FILE).read_text(encoding="utf-8")
    assert parsed(compared / page.FILE).ids.count("map-1-slider") == 1
    assert "flexpm rerun jcfpm/result.json" in text


@pytest.mark.long
def test_packings_and_studies_have_a_page_and_their_runs_none(tmp_path):
    command = ["run", "tension", *SIZE, "--seeds", "1,2", "--quiet", "--out", str(tmp_path / "p")]
    assert cli.main(command) == 0
    assert "mean and standard deviation".capitalize() in (tmp_path / "p" / page.FILE).read_text()
    study = tmp_path / "it.toml"
    common = "test = 'tension'\nwidth = 0.012\nheight = 0.024\nthickness = 0.01"
    study.write_text(f"[common]\n{common}\n[grid]\n'set.cohesion' = [28e6, 3e7]\n")
    assert cli.main(["study", str(study), "--quiet", "--out", str(tmp_path / "s")]) == 0
    parsed(tmp_path / "s" / page.FILE)
    text = (tmp_path / "s" / page.FILE).read_text()
    assert "<th>set.cohesion</th>" in text
    assert '"label": "set.cohesion 2.8e+07"' in text  # a line has the name of its input
    assert "data:image/png;base64," in text
    assert len(list(tmp_path.rglob(page.FILE))) == 2


def test_a_calibration_has_a_page(tmp_path):
    (tmp_path / "history.csv").write_text("stage,cohesion,objective\nfit,3e7,0.125\n")
    (tmp_path / "rock.toml").write_text("cohesion = 3e7 # <met>\n")
    text = pages.write(tmp_path).read_text()
    assert "<td>fit</td><td>3e+07</td><td>0.125</td>" in text
    assert "cohesion = 3e7 # &lt;met&gt;" in text


def test_a_folder_without_results_is_refused_in_one_line(capsys, tmp_path):
    assert cli.main(["report", str(tmp_path)]) == 2
    assert cli.main(["report", str(tmp_path / "none")]) == 2
    assert capsys.readouterr().err.count("\n") == 2
    assert not (tmp_path / "none").exists()


def test_a_page_of_a_run_that_diverged_is_the_same_when_made_again(tmp_path):
    command = ["run", "uniaxial", *SIZE, "--rate", "1e9", "--quiet", "--out", str(tmp_path)]
    assert cli.main(command) == 3
    before = (tmp_path / page.FILE).read_text(encoding="utf-8")
    parsed(tmp_path / page.FILE)
    assert "<h2>diverged</h2>" in before
    assert "<td>nan" not in before
    assert pages.write(tmp_path).read_text(encoding="utf-8") == before


@pytest.mark.parametrize("status", ["ok", "no_peak", "not_quasistatic", "diverged"])
def test_each_status_has_its_meaning_and_advice(status):
    found = statuses.STATUS[status]
    assert found.name == status
    assert found.good == (status == "ok")
    assert len(found.meaning) > 40 < len(found.advice)


def test_acoustic_emission_is_shown_where_there_is_a_picture_of_it(ended, tmp_path):
    for name in ("result.json", "curve.csv", "cracks.csv", "events.csv"):
        (tmp_path / name).write_bytes((ended / name).read_bytes())
    assert "<h2>Acoustic emission</h2>" not in pages.write(tmp_path).read_text()
    (tmp_path / "events.png").write_bytes((ended / "events.png").read_bytes())
    text = pages.write(tmp_path).read_text()
    assert "<h2>Acoustic emission</h2>" in text
    assert "Acoustic emission: the largest events" in text
    parsed(tmp_path / page.FILE)


def test_a_name_from_a_file_is_text_and_no_program(ended, tmp_path):
    for file in ended.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    content = json.loads((tmp_path / "result.json").read_text())
    name = "</script><script>alert(1)</script>"
    content["material"]["name"] = content["inputs"]["material"]["name"] = name
    (tmp_path / "result.json").write_text(json.dumps(content))
    text = pages.write(tmp_path).read_text(encoding="utf-8")
    assert "alert(1)" in text
    assert "<script>alert" not in text


def test_fragments_at_the_end_of_the_slider_are_those_of_the_result(ended):
    result = Result.read(ended)
    found = page_run.run_map(ended, result, "map", "", None)
    assert result.fragments > 1
    assert found.texts[-1].endswith(f"fragments: {result.fragments}")
    letters = found.fragments[-1]
    assert len(letters) == len(found.grains) == result.grains
    assert found.fragments[0] == "0" * result.grains
    lines = (ended / "fragments.csv").read_text().splitlines()[1:]
    assert letters.count("0") == int(lines[0].split(",")[1])
    assert letters.count("x") == sum(line.split(",")[1] == "1" for line in lines[1:])


def test_each_crack_has_a_line_from_its_step_on(ended):
    result = Result.read(ended)
    found = page_run.run_map(ended, result, "map", "", None)
    steps = [int(re.match(r"step (\d+)", text)[1]) for text in found.texts]
    for mode, number in (("tensile", 1), ("shear", 2)):
        drawn = np.zeros(len(steps), dtype=int)
        for name, at, path in found.cracks:
            if name == mode:
                drawn[at:] += path.count("M")
        cracked = np.sort([crack.step for crack in result.cracks if crack.mode == number])
        assert np.array_equal(drawn, np.searchsorted(cracked, steps, side="right"))


@pytest.mark.parametrize("model", ["flexible", "inner", "jcfpm", "solid"])
def test_outlines_of_the_grains_fill_the_specimen(tmp_path, model):
    """The edge of the prism of a cylinder lies in its section, where triangles become lines."""
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    if model == "solid":
        specimen, model = flexpm.Specimen.cylinder(0.015, 0.03), "flexible"
    flexpm.run("tension", specimen, model=model, max_strain=2e-5, out=tmp_path)
    found = page_run.run_map(tmp_path, Result.read(tmp_path), "map", "", None)
    area = sum(map(shown_area, found.grains))
    width, height = found.size
    assert area == pytest.approx(width * height, rel=2e-3)  # rounded to the map's units
    assert len(read_vtu(tmp_path / "specimen.vtu").contact) > 50


def shown_area(path: str) -> float:
    """Area inside the loops of a path of SVG."""
    total = 0.0
    for loop in path.split("z")[:-1]:
        start, steps = loop.removeprefix("M").split("l")
        ways = np.array(re.findall(r"-?\d+", steps), dtype=float).reshape(-1, 2)
        places = np.cumsum([np.array(start.split(), dtype=float), *ways], axis=0)
        x, y = places.T
        total += 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    return total


def test_points_of_a_curve_keep_its_shape_and_its_peak():
    strain = np.linspace(0.0, 1.0, 20001)
    stress = np.where(strain < 0.7, strain, 0.7 - np.sqrt(np.maximum(strain - 0.7, 0.0)))
    peak = int(np.argmax(stress))
    rows = page.rows_to_draw(np.column_stack([strain, stress]), 300, [peak])
    assert {0, peak, len(strain) - 1} <= set(rows.tolist())
    assert len(rows) <= 303
    drawn = np.interp(strain, strain[rows], stress[rows])
    assert np.max(np.abs(drawn - stress)) < 0.02 * np.ptp(stress)
    assert len(page.rows_to_draw(np.zeros((0, 2)), 10)) == 0
    assert page.rows_to_draw(np.full((5, 2), np.nan), 10).tolist() == [0, 4]


@pytest.mark.parametrize(
    "arguments",
    [
        ["uniaxial"],
        ["tension", "--model", "rigid", "--seed", "4", "--start", "rest"],
        ["biaxial", "--confinement", "4e6", "--diameters", "0.001,0.002", "--points", "2"],
        ["brazilian", "--diameter", "0.03", "--model", "jcfpm", "--set", "cohesion=31e6"],
        ["uniaxial", "--material", "augig-table2-brittle", "--dynamic", "--gravity", "9.81"],
        ["tension", "--loading", "constant", "--max-strain", "1e-3", "--rate", "0.5"],
    ],
)
def test_the_command_of_a_page_asks_for_the_same_run(arguments):
    spec = spec_of(arguments)
    words = asked.command(spec).split()
    assert words[:2] == ["flexpm", "run"]
    assert spec_of(words[2:]) == spec


def spec_of(arguments: list[str]) -> RunSpec:
    with runs.run.make_context("run", list(arguments)) as context:
        options = dict(context.params)
        test = options.pop("test")
        source = inputs.source(test, options)
        chosen = inputs.material(options, source.plain.kind)
        return inputs.run_spec(test, options, chosen, source)


def test_a_specimen_with_a_joint_has_its_parts_from_the_start_and_is_run_again(tmp_path):
    line = {"weak": np.array([[-0.001, 0.009], [0.013, 0.015]])}
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01).with_joints(line)
    law = {"normal_stiffness": 1e14, "shear_stiffness": 3e13, "friction": 0.6}
    weak = load("augig-table7").with_set({f"joint.weak.{key}": law[key] for key in law})
    result = flexpm.run("uniaxial", specimen, weak, max_strain=5e-4, out=tmp_path / "first")
    found = page_run.run_map(tmp_path / "first", result, "map", "", None)
    assert found.texts[0].endswith("fragments: 2")
    assert found.texts[-1].endswith(f"fragments: {result.fragments}")
    text = (tmp_path / "first" / page.FILE).read_text(encoding="utf-8")
    assert "<td>joint weak: shear stiffness</td><td>30 TPa/m</td>" in text
    assert "<td>joint names</td><td>weak</td>" in text
    command = ["rerun", str(tmp_path / "first"), "--quiet", "--out", str(tmp_path / "second")]
    assert cli.main(command) == 3
    curves = [(tmp_path / name / "curve.csv").read_bytes() for name in ("first", "second")]
    assert curves[0] == curves[1]


def test_what_nobody_has_asked_for_is_told_by_what_stands_for_it():
    told = {one.name: one.value for one in asked.told(spec_of(["uniaxial"]))}
    assert told["control"] == "displacement of the ends"
    assert told["max_strain"] == "from the reference strength"


def test_a_run_that_no_command_describes_has_none():
    spec = spec_of(["uniaxial"])
    short = dataclasses.replace(spec.specimen, short_edge=0.2)
    assert asked.command(dataclasses.replace(spec, specimen=short)) == ""
    own = dataclasses.replace(spec, material=spec.material | {"name": "own"})
    assert asked.command(own) == ""


def test_the_command_for_a_given_specimen_names_its_file(tmp_path):
    packed = flexpm.Specimen.rectangle(0.012, 0.024, 0.01)
    own = flexpm.Specimen.from_discs(packed.centres, packed.radii, packed.outline, 0.01)
    flexpm.run("tension", own, max_strain=2e-5, out=tmp_path)
    text = (tmp_path / page.FILE).read_text(encoding="utf-8")
    assert "flexpm run tension --specimen grains.json --max-strain 2e-05" in text
    assert "checksum of the content of grains.json" in text


def test_what_is_no_specimen_is_refused(tmp_path):
    refusal("cannot be read", read_vtu, tmp_path / "specimen.vtu")


@pytest.mark.long
def test_a_page_of_the_papers_size_has_at_most_two_megabytes(tmp_path):
    specimen = flexpm.Specimen.rectangle(0.08, 0.16, 0.08)
    result = flexpm.run("uniaxial", specimen, max_strain=1e-6, out=tmp_path)
    assert result.grains == 1630
    state = read_vtu(tmp_path / "specimen.vtu")
    places = zip(state.contact, state.contact_ends.mean(axis=1), strict=True)
    # more cracks and events than a test has had, and a record as long
    lines = [
        f"{n},1e-7,{x},{y},tensile,{c},{n % 3},1e-3" for n, (c, (x, y)) in enumerate([*places] * 3)
    ]
    head = (tmp_path / "cracks.csv").read_text()
    (tmp_path / "cracks.csv").write_text(head + "\n".join(lines) + "\n")
    names, *rows = (tmp_path / "curve.csv").read_text().splitlines()
    tail = rows[-1].split(",")[1:]
    steps = [",".join([str(step), *tail]) for step in range(0, 14000, 3)]
    (tmp_path / "curve.csv").write_text("\n".join([names, *steps]) + "\n")
    found = Result.read(tmp_path)
    found.snapshot, found.emission = state, find_events(found.cracks, EventRule(3e-3, 0.5))
    assert len(found.emission) == len(lines)
    emission_picture(tmp_path / "events.png", found)
    assert pages.write(tmp_path).stat().st_size < 2e6


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    """A browser without a window, whose messages and requests are kept."""
    yield from opened("--disable-gpu")


def count(browser: object, selector: str) -> int:
    """Elements of a selector that are shown."""
    return browser.execute_script(
        "return [...document.querySelectorAll(arguments[0])]"
        ".filter((one) => getComputedStyle(one).display !== 'none').length",
        selector,
    )


def test_a_page_asks_for_nothing_and_complains_of_nothing(browser, ended, compared):
    for folder in (ended, compared):
        file = folder / page.FILE
        asked_for = [url for url in shown(browser, file) if not url.startswith("data:")]
        assert asked_for == [file.as_uri()]
        assert browser.get_log("browser") == []


def test_the_slider_moves_the_maps_and_the_mark_on_the_curve(browser, ended):
    shown(browser, ended / page.FILE)
    cracks, loose = "#map-cracks [data-at]", "#map-fragments path:not(.f0)"
    at_end = count(browser, cracks), count(browser, loose)
    said = browser.find_element("id", "map-text").text
    mark = "return charts.stress.data.datasets[0].now"
    place = browser.execute_script(mark)
    assert min(at_end) > 0
    slide(browser, "map-slider", 0)
    assert (count(browser, cracks), count(browser, loose)) == (0, 0)
    assert browser.find_element("id", "map-text").text != said
    assert browser.execute_script(mark) < place
    slide(browser, "map-slider", page_map._POSITIONS)
    assert (count(browser, cracks), count(browser, loose)) == at_end


def test_the_pointer_shows_the_values_of_the_record(browser, ended):
    shown(browser, ended / page.FILE)
    actions = pytest.importorskip("selenium.webdriver.common.action_chains").ActionChains
    actions(browser).move_to_element(browser.find_element("id", "stress")).perform()
    tooltip = browser.execute_script(
        "const t = charts.stress.tooltip;"
        "return [t.opacity, t.title[0], ...t.body.map((part) => part.lines[0])]"
    )
    assert tooltip[0] > 0
    strain = float(tooltip[1].split(":")[1])
    assert tooltip[2].startswith("axial stress [MPa]: ")
    stress = float(tooltip[2].split(":")[1])
    record = Result.read(ended).curve
    row = np.argmin(np.abs(100.0 * record["axial_strain"] - strain))
    assert stress == pytest.approx(1e-6 * record["axial_stress"][row], rel=1e-4)


def test_a_page_says_how_far_its_numbers_are_those_of_the_rock(ended):
    result = Result.read(ended)
    assert "while they move" in (ended / page.FILE).read_text(encoding="utf-8")
    confined = dataclasses.replace(result, confinement=4e6, model="rigid", youngs_modulus=2e10)
    confined.material = {**result.material, "joints": [{"name": "a"}]}
    assert page_run._reading(confined).split(". ")[1:] == [
        "Under a confining pressure only the peak is valid: the curve after the peak also depends "
        "on the loading",
        "Young's modulus is measured in the middle half of the specimen, with joints (D21).",
    ]
