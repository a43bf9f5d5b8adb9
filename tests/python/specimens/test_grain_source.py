# SPDX-License-Identifier: GPL-3.0-or-later
"""File from which the grains of a specimen come: in its file, in results and in the report."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from neper_files import tess_of
from refusals import refusal

from flexpm import Specimen
from flexpm.cli import main as cli
from flexpm.report.tables import source_text
from flexpm.runs.run_spec import RunSpec
from flexpm.specimens.space.spec import SolidSpec


def bricks():
    """Labels of 16 bricks of 4 x 4 x 4 voxels."""
    z, y, x = np.indices((16, 8, 8)) // 4
    return (1 + x + 2 * y + 4 * z).astype(np.uint8)


def test_a_run_names_the_scan(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", bricks())
    assert cli.main(["specimen", "volume", "scan.npy", "--voxel", "1e-3", "--out", "made"]) == 0
    run = ["run", "uniaxial", "--specimen", "made/solid.json", "--out", "out"]
    cli.main([*run, "--rate", "20", "--max-strain", "0.002"])
    source = {
        "file": "scan.npy",
        "voxel_size": [1e-3] * 3,
        "agreement": 1.0,
        "grains": 16,
    }
    result = json.loads((tmp_path / "out" / "result.json").read_text())
    assert result["inputs"]["specimen"]["source"] == source
    assert Specimen.load_solid("made/solid.json").spec.source == source
    page = (tmp_path / "out" / "report.html").read_text()
    words = "scan.npy, 16 grains, voxel 1 x 1 x 1 mm, 100.00 % of the voxels"
    assert f"source of the grains</td><td>{words}" in page
    # a run of the same grains from elsewhere has the same key
    spec = RunSpec.from_json(result["inputs"])
    assert spec.specimen.source == source
    without = replace(spec, specimen=replace(spec.specimen, source=None))
    assert without.key() == spec.key()


def test_images_maps_and_tessellations_name_their_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("image.npy", bricks()[8])
    assert cli.main(["specimen", "image", "image.npy", "--pixel", "1e-3", "--out", "made"]) == 0
    made = Specimen.load("made/grains.json")
    assert made.spec.source == {"file": "image.npy", "pixel_size": [1e-3]}
    (tmp_path / "a.tess").write_text(tess_of(made))
    assert Specimen.from_tess(tmp_path / "a.tess", 0.01).spec.source == {"file": "a.tess"}
    assert Specimen.rectangle(0.012, 0.024, 0.01).spec.source is None


def test_names_of_files_are_text_of_one_line():
    named = source_text({"file": "a\n\x1b[2Jb.tif", "voxel_size": [1e-3, 2e-3, 1.5e-6]})
    assert named == "a ?[2Jb.tif, voxel 1 x 2 x 0.0015 mm"


@pytest.mark.parametrize(
    "source",
    [{}, "scan.tif", {"file": 3}, {"file": "a", "voxel_size": [1.0, 2.0]}, {"file": "a", "b": 1}],
)
def test_sources_of_another_shape_are_refused(source):
    refusal("source = ", SolidSpec, "box", source=source)
    spec = Specimen.rectangle(0.012, 0.024, 0.01).spec
    refusal("must be a table of file, grains", replace, spec, source=source)
