# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimen files whose checksum is right and whose content is not: refused, in one line."""

from __future__ import annotations

import copy
import json

import numpy as np
import pytest
from fuzz_child import drawing
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal, refused_command

import flexpm
from flexpm.errors import InputError
from flexpm.specimens.files import specimen_file
from flexpm.specimens.space import file as solid_file

SQUARES = [[[x, 0.0], [x + 0.01, 0.0], [x + 0.01, 0.01], [x, 0.01]] for x in (0.0, 0.01)]
FRAME = [[0.0, 0.0], [0.02, 0.0], [0.02, 0.02], [0.0, 0.02]]
HOLE = [[0.008, 0.008], [0.012, 0.008], [0.012, 0.012], [0.008, 0.012]]


def made(kind):
    """A specimen of each way in which they are made."""
    new = flexpm.Specimen
    packed = new.rectangle(0.012, 0.016, 0.01)
    if kind == "given":
        return new.from_discs(packed.centres, packed.radii, packed.outline, 0.01)
    if kind == "minerals":
        return packed.with_minerals(np.arange(len(packed.discs)) % 2)
    if kind == "cut":
        cut = packed.with_joints({"a": [[0.0, 0.004], [0.012, 0.012]]})
        cut = cut.with_joints({"b": [[0.006, 0.0], [0.006, 0.006]]})
        return cut.with_weibull_strengths(8.0)
    return {
        "packed": lambda: packed,
        "disc": lambda: new.disc(0.016, 0.01),
        "half-disc": lambda: new.half_disc(0.024, 0.01),
        "hole": lambda: new.polygon(FRAME, 0.01, holes=[HOLE]),
        "own": lambda: new.from_polygons(SQUARES, 0.01),
        "within": lambda: new.from_polygons([FRAME, HOLE], 0.01),
        "hidden": lambda: new.from_discs(
            np.vstack((packed.centres, packed.centres[:2] + 1e-6)),
            np.append(packed.radii, (1e-4, 1e-4)),
            packed.outline,
            0.01,
            drop_hidden=True,
        ),
    }[kind]()


KINDS = ("packed", "disc", "half-disc", "hole", "own", "within", "hidden", "given", "minerals")
KINDS += ("cut",)


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    """Content of the file of each kind, without its checksum."""
    found = {}
    for kind in KINDS:
        path = tmp_path_factory.mktemp("specimens") / f"{kind}.json"
        made(kind).save(path)
        found[kind] = json.loads(path.read_text())
        del found[kind]["checksum"], found[kind]["format"]
    return found


def load(content, path):
    """The specimen of a content with its right checksum."""
    specimen_file.write(path, content)
    return flexpm.Specimen.load(path)


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_saved_is_loaded(contents, tmp_path, kind):
    assert load(contents[kind], tmp_path / "it.json").statistics()["grains"] > 1


def change(content, kind):
    """Make one of the changes that were once taken without a word."""
    spec = content["spec"]
    if kind == "vertex":
        content["vertices"][len(content["vertices"]) // 2][0] += 1e-4
    elif kind == "swapped":
        discs = content["discs"]
        discs[0], discs[-1] = discs[-1], discs[0]
    elif kind == "far":
        content["discs"][0][0] += 5.0
    elif kind == "wrapped":
        content["cells"][0][0] = 2**40 + content["cells"][0][0]
    elif kind == "side":
        content["sides"][0][2] = -1
    elif kind == "other side":
        content["sides"][0][2] += 1
    elif kind == "no sides":
        content["sides"] = content["sides"][:-1]
    elif kind == "vertex of a side":
        content["sides"][0][0] = 10**6
    elif kind == "outline":
        content["outline"] = (
            {**content["outline"], "radius": 0.1}
            if isinstance(content["outline"], dict)
            else [[x + 1e-3, y] for x, y in content["outline"]]
        )
    elif kind == "two points":
        content["outline"] = [[0.0, 0.0], [1.0, 1.0]]
    elif kind == "holes":
        content["holes"] = [] if content["holes"] else [HOLE]
    elif kind == "width":
        name = "diameter" if spec["diameter"] else "width"
        spec[name] = 5.0
    elif kind == "thickness":
        spec["thickness"] = -1.0
    elif kind == "strengths":
        content["strengths"] = []
    elif kind == "a strength":
        content["strengths"] = [0.5] + (content["strengths"] or [1.0])[1:]
    elif kind == "joints":
        content["joints"] = [[0, 10**5, 0]]
    elif kind == "number of a joint":
        start, end = content["cells"][0][:2]
        content["joints"] = [*content["joints"], [start, end, 7]]
    elif kind == "names":
        spec["joint_names"] = ["x", "y"]
    elif kind == "lines":
        content["lines"] = {name: [[[0.0, 0.0], [1e-3, 1e-3]]] for name in content["lines"] or "a"}
    elif kind == "minerals":
        content["minerals"] = [0] * len(content["cells"])
    elif kind == "grains":
        content["grains"] = [0] * len(content["cells"])
    elif kind == "checksum":
        spec["outline"] = "0" * 16
    elif kind == "seed of none":
        spec["discs"] = "0" * 16
    elif kind == "not finite":
        content["discs"][0][2] = 0.0
    return content


CHANGES = """vertex|swapped|far|wrapped|side|other side|no sides|vertex of a side|outline
    |two points|holes|width|thickness|strengths|a strength|joints|number of a joint|names|lines
    |minerals|grains|checksum|seed of none|not finite"""
#: What makes another specimen that is as good as the one before: no file says that it is not.
AS_GOOD = {("hole", "vertex"), ("half-disc", "vertex"), ("cut", "vertex")}


@pytest.mark.parametrize("what", [one.strip() for one in CHANGES.split("|")])
@pytest.mark.parametrize("kind", KINDS)
def test_a_changed_specimen_with_a_right_checksum_is_refused(contents, tmp_path, kind, what):
    if (kind, what) in AS_GOOD:
        pytest.skip("an inner vertex of cells that no disc and no checksum gives again")
    content = change(copy.deepcopy(contents[kind]), what)
    refusal("", load, content, tmp_path / "it.json")


@pytest.mark.parametrize("text", ['{"format": "flexpm specimen 1", "x": NaN}', '{"x": 1e999}'])
def test_numbers_that_are_not_finite_are_one_line(capsys, tmp_path, text):
    (tmp_path / "it.json").write_text(text)
    command = ["elastic", "--specimen", str(tmp_path / "it.json")]
    refused_command(capsys, "is not a finite number", *command)


ODD = st.sampled_from(
    [None, True, -1, 0, 1, 7, 2**31, 2**40, -0.5, 1e-300, 1e300, "", "a", [], {}, [0], [[0, 0]]]
)


@st.composite
def edits(draw):
    """A way into a content, by shares of lengths, and what is done there."""
    way = draw(st.lists(st.floats(0.0, 1.0, exclude_max=True), min_size=1, max_size=4))
    return way, draw(st.sampled_from(["set", "remove", "scale"])), draw(ODD)


def edited(content, edit):
    """Follow a way through tables and lists, and change what is at its end."""
    way, kind, value = edit
    place, key = None, None
    here = content
    for share in way:
        if not isinstance(here, dict | list) or not here:
            break
        keys = [*here] if isinstance(here, dict) else range(len(here))
        place, key = here, keys[int(share * len(keys))]
        here = here[key]
    if kind == "remove":
        del place[key]
    elif kind == "scale" and isinstance(here, int | float) and not isinstance(here, bool):
        place[key] = here * 1.01 if isinstance(here, float) else here + 1
    else:
        place[key] = copy.deepcopy(value)


@given(kind=st.sampled_from(KINDS), changes=st.lists(edits(), min_size=1, max_size=3))
@drawing(400)
def test_any_change_is_refused_in_one_line_or_leaves_a_specimen(
    contents, tmp_path_factory, kind, changes
):
    content = copy.deepcopy(contents[kind])
    for one in changes:
        edited(content, one)
    try:
        found = load(content, tmp_path_factory.getbasetemp() / "edited.json")
    except InputError as error:
        assert "\n" not in str(error)
        return
    outline = found.outline
    if not hasattr(outline, "radius"):
        x, y = outline.T
        area = 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        area -= 1.6e-5 * len(found.holes)
        assert found.tessellation.cell_areas.sum() == pytest.approx(area, rel=1e-9)
    assert found.statistics()["grains"] == len(found.discs)


SOLIDS = ("box", "cylinder", "given", "hidden")


@pytest.fixture(scope="module")
def solids(tmp_path_factory):
    """Content of the file of each kind of solid, without its checksum."""
    new = flexpm.Specimen
    box = new.box(0.008, 0.008, 0.009)
    size = {"width": 0.008, "depth": 0.008, "height": 0.009}
    hidden = np.vstack((box.spheres, box.spheres[:2] + [1e-6, 0.0, 0.0, -9e-4]))
    made = (
        box,
        new.cylinder(0.009, 0.009),
        new.from_spheres(box.spheres, **size),
        new.from_spheres(hidden, **size, drop_hidden=True),
    )
    found = {}
    for kind, specimen in zip(SOLIDS, made, strict=True):
        path = tmp_path_factory.mktemp("solids") / f"{kind}.json"
        specimen.save(path)
        found[kind] = json.loads(path.read_text())
        del found[kind]["checksum"], found[kind]["format"]
    assert found["hidden"]["removed_spheres"] == 2
    return found


def load_solid(content, path):
    """The solid of a content with its right checksum."""
    whole = {"format": solid_file.FORMAT, **content}
    path.write_text(json.dumps({**whole, "checksum": solid_file.checksum(whole)}))
    return flexpm.Specimen.load_solid(path)


@pytest.mark.parametrize("kind", SOLIDS)
@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda solid: solid.pop("spec"), "spec is missing"),
        (lambda solid: solid.pop("removed_spheres"), "removed_spheres is missing"),
        (lambda solid: solid.update(removed_spheres="a"), "removed_spheres = 'a', is not valid"),
        (lambda solid: solid["spec"].update(kind=[]), r"spec kind = \[\], is not valid"),
        (lambda solid: solid["spec"].update(depht=1.0), "spec 'depht', is unknown"),
        (lambda solid: solid["spec"].update(spheres=5), "spec spheres = 5, is not valid"),
        (lambda solid: solid["spheres"].pop(), "spheres (=|do not)"),
        (lambda solid: solid["spheres"][3].pop(), "is not valid"),
        (lambda solid: solid["spheres"][3].__setitem__(3, 0.01), "diameters = |spheres do not fit"),
    ],
)
def test_a_changed_solid_with_a_right_checksum_is_refused(solids, tmp_path, kind, change, says):
    content = copy.deepcopy(solids[kind])
    change(content)
    refusal(f"specimen file: .*{says}", load_solid, content, tmp_path / "it.json")


@given(kind=st.sampled_from(SOLIDS), changes=st.lists(edits(), min_size=1, max_size=3))
@drawing(100)
def test_any_change_of_a_solid_is_refused_in_one_line_or_leaves_one(
    solids, tmp_path_factory, kind, changes
):
    content = copy.deepcopy(solids[kind])
    for one in changes:
        edited(content, one)
    try:
        found = load_solid(content, tmp_path_factory.getbasetemp() / "edited_solid.json")
    except InputError as error:
        assert "\n" not in str(error)
        return
    assert np.sum(found.cells.volumes) == pytest.approx(found.outline().volume, rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_marks_of_whole_cells_are_kept_and_older_files_have_none_but_of_packings(
    contents, tmp_path, kind
):
    path = tmp_path / "it.json"
    marks = made(kind).tessellation.laguerre
    assert np.array_equal(load(contents[kind], path).tessellation.laguerre, marks)
    whole = kind in ("packed", "disc", "given", "hidden", "minerals")
    assert marks.all() == whole and ("laguerre" in contents[kind]) != whole
    assert marks.any() == (kind not in ("own", "within"))
    older = {key: value for key, value in contents[kind].items() if key != "laguerre"}
    assert (load(older, path).tessellation.laguerre == whole).all()


def test_marks_that_cannot_be_are_refused(contents, tmp_path):
    for kind, marks, message in (
        ("own", [0, 2], "laguerre"),
        ("own", [0], "laguerre = 1, must be one for each of 2 cells"),
        ("packed", [0] * len(contents["packed"]["cells"]), "laguerre = 0, must be 1"),
    ):
        refusal(message, load, contents[kind] | {"laguerre": marks}, tmp_path / "it.json")
