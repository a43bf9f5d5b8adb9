# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens, materials, results and records as a notebook shows them. SI units.

Each is a picture beside a table.
"""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..errors import InputError
from ..materials.keys import ELASTIC_SET, UNITS
from ..materials.material import Law, Material
from ..notebook import html_of
from ..results.record import Curve
from ..results.result import Result
from ..specimens.specimen import Specimen
from ..text import label_of, name_of, words_of
from .curves import curve_picture, fits_a_picture
from .maps import cell_polygons, specimen_picture
from .pages.page import rendered
from .pages.page_run import with_unit
from .style import CYCLE, drawing
from .tables import result_rows, size_text, test_text

#: Model by which the elastic set of each name is asked for.
_MODEL_OF = {name: model for model, name in reversed(ELASTIC_SET.items())}


@html_of.register
def _of_result(result: Result) -> str:
    picture = _picture(lambda path: curve_picture(path, result)) if len(result.curve) else ""
    title = f"{test_text(result)}; {size_text(result)}"
    return _html(title, result_rows(result), picture, result.warnings)


@html_of.register
def _of_curve(curve: Curve) -> str:
    known = [name for name in curve if not np.all(np.isnan(curve[name]))]
    rows = [
        (name, *(f"{value:.6g}" for value in _looks(curve[name]))) for name in known if len(curve)
    ]
    picture = _picture(lambda path: _draw_record(path, curve)) if len(curve) else ""
    title = f"Record, {len(curve)} rows"
    return _html(title, [("", "first", "last", "smallest", "largest"), *rows], picture)


def _looks(values: FloatArray) -> list[float]:
    """First, last, smallest and largest value."""
    return [float(one) for one in (values[0], values[-1], np.nanmin(values), np.nanmax(values))]


def _draw_record(path: Path, curve: Curve) -> None:
    """Draw stress over strain, if they are numbers that a picture has room for."""
    if not fits_a_picture(curve):
        return
    with drawing(path, (4.4, 2.9)) as axes:
        axes.plot(curve["axial_strain"], curve["axial_stress"], color="black")
        axes.set(xlabel="axial_strain", ylabel="axial_stress")  # of an own test in units of its own


@html_of.register
def _of_specimen(specimen: Specimen) -> str:
    polygons = cell_polygons(specimen.tessellation)
    found = specimen.statistics()
    sizes = {**specimen.dimensions, "thickness": specimen.thickness}
    rows = [(words_of(name), with_unit(value, "m")) for name, value in sizes.items()]
    rows += [(name, str(found[name])) for name in ("grains", "contacts")]
    rows.append(("mean diameter", with_unit(specimen.mean_diameter, "m")))
    rows.append(("seed", "given grains" if specimen.seed is None else str(specimen.seed)))
    picture = _picture(lambda path: specimen_picture(path, polygons))
    return _html(f"Specimen, {specimen.kind}", rows, picture)


@html_of.register
def _of_material(material: Material) -> str:
    laws = _laws(material)
    rows = [
        (words_of(key), *(_shown(law.get(key), key) for law in laws.values()))
        for key in UNITS
        if any(law.get(key) is not None for law in laws.values())
    ]
    if material.weibull is not None:
        rows.append(("Weibull modulus", *[f"{material.weibull:g}"] * len(laws)))
    kinds = [(f"mineral {kind.name}", f"{100.0 * kind.fraction:g} %") for kind in material.minerals]
    picture = _picture(lambda path: _draw_law(path, next(iter(laws.values())))) if laws else ""
    title = f"Material {name_of(material.name)}"
    return _html(title, [("", *laws), *rows, *kinds] if laws else kinds, picture)


def _laws(material: Material) -> dict[str, Law]:
    """Parameters of each elastic set that a model can take."""
    found = {}
    for name in material.elastic:
        try:
            found[name] = material.law(_MODEL_OF[name])
        except InputError:  # it lacks what its model needs
            continue
    return found


def _shown(value: object, key: str) -> str:
    return "-" if value is None else with_unit(value, (UNITS[key] or "").removeprefix("-"))


def _draw_law(path: Path, law: Law) -> None:
    """Draw the traction over the opening, and over the slip without a normal force."""
    normal, shear = law["normal_stiffness"], law["shear_ratio"] * law["normal_stiffness"]
    branches = (
        ("tension", law["tensile_strength"], normal, law["tensile_fracture_energy"]),
        ("shear, no normal force", law["cohesion"], shear, law["shear_fracture_energy"]),
    )
    with drawing(path, (4.4, 2.9)) as axes:
        for colour, (label, strength, stiffness, energy) in zip(CYCLE, branches, strict=False):
            way = 1e6 * np.array([0.0, strength / stiffness, 2.0 * energy / strength])
            axes.plot(way, 1e-6 * np.array([0.0, strength, 0.0]), color=colour, label=label)
        axes.set(xlabel="opening, slip [µm]", ylabel="traction [MPa]", xlim=(0, None))
        axes.set_ylim(bottom=0.0)
        axes.legend(frameon=False)
        axes.set_title(label_of("law of a contact point"), fontsize=9.5, loc="left")


def _picture(draw: Callable[[Path], None]) -> str:
    """Return the picture that a function plots, in base64; empty without a plot."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        draw(path)
        return base64.b64encode(path.read_bytes()).decode() if path.exists() else ""


def _html(
    title: str, rows: Sequence[Sequence[str]], picture: str, warnings: Sequence[str] = ()
) -> str:
    return rendered("notebook.html", title=title, rows=rows, picture=picture, warnings=warnings)
