# SPDX-License-Identifier: GPL-3.0-or-later
"""What notebooks show of a specimen, a material and a result."""

from __future__ import annotations

import base64
import io
import re

import numpy as np
import pytest
from matplotlib.image import imread

import flexpm
from flexpm.materials.material import preset_names
from flexpm.notebook import Shown, html_of
from flexpm.results.record import Curve
from flexpm.results.result import Result


def picture_of(html: str) -> np.ndarray:
    """The picture in HTML, as an array."""
    data = re.search(r"data:image/png;base64,([^\"]+)", html)[1]
    return imread(io.BytesIO(base64.b64decode(data)))


def rows_of(html: str) -> dict[str, list[str]]:
    """Cells of its table by the first of their row."""
    rows = (re.findall(r"<td[^>]*>([^<]*)", row) for row in html.split("<tr>")[1:])
    return {first: rest for first, *rest in rows}


def test_a_specimen_is_shown_with_its_picture_and_size():
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 0.01, seed=3)
    html = specimen._repr_html_()
    rows = rows_of(html)
    assert rows["width"] == ["12 mm"]
    assert rows["grains"] == [str(len(specimen.discs))]
    assert rows["seed"] == ["3"]
    height, width = picture_of(html).shape[:2]
    assert height > 1.3 * width


@pytest.mark.parametrize("name", preset_names())
def test_a_material_is_shown_with_its_law_and_values(name):
    material = flexpm.materials.load(name)
    html = material._repr_html_()
    assert picture_of(html).std() > 0.01
    rows = rows_of(html)
    value, unit = rows["tensile strength"][0].split()
    assert float(value) * {"kPa": 1e3, "MPa": 1e6}[unit] == pytest.approx(material.tensile_strength)
    assert len(rows["cohesion"]) == len(rows[""])


def test_a_result_is_shown_with_its_curve_and_its_warnings(tmp_path):
    specimen = flexpm.Specimen.rectangle(0.012, 0.024, 10.0)
    result = flexpm.run("uniaxial", specimen, rate=16.0, out=tmp_path)
    for one in (result, Result.read(tmp_path)):
        html = one._repr_html_()
        assert picture_of(html).std() > 0.01
        assert rows_of(html)["status"] == [result.status]
        assert "thickness = 10 m, unusual" in html


def test_a_result_without_a_record_is_a_table():
    html = Result("", "", "uniaxial", "flexible", {"name": "<b>"}, 1, 1, 1, 1, 1)._repr_html_()
    assert "<img" not in html
    assert "&lt;b&gt;" in html


def test_a_notebook_takes_the_html_of_what_is_shown():
    formatter = pytest.importorskip("IPython.core.formatters").HTMLFormatter()
    assert "<table>" in formatter(flexpm.materials.load("augig-table7"))


def test_what_nothing_is_registered_for_is_shown_by_its_repr():
    assert html_of(3) is None
    assert Shown()._repr_html_() is None


def test_a_record_is_shown_with_its_curve_and_the_ends_of_its_columns():
    record = Curve(own=["load"])
    for row in range(5):
        record.append(**dict.fromkeys(record.keys(), float(row)) | {"lateral_strain": np.nan})
    html = record._repr_html_()
    assert picture_of(html).std() > 0.01
    rows = rows_of(html)
    assert rows["load"] == ["0", "4", "0", "4"]
    assert "lateral_strain" not in rows
    assert "Record, 5 rows" in html
    assert "Record, 0 rows" in Curve()._repr_html_()
