# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures: the geometry they draw in closed form, and what can be seen in them."""

import dataclasses
import os
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.image import imread
from processes import captured
from sample_snapshot import GRADIENT, HEIGHT, WIDTH, wall

from flexpm.report import comparison, curves, joint_colours, maps, style
from flexpm.results.cracks import SHEAR, TENSILE
from flexpm.results.record import COLUMNS, Curve
from flexpm.results.result import Result
from flexpm.results.strength import Envelope


def pixels_like(path, colour):
    """Number of pixels of a picture that have `colour`."""
    picture = imread(path)[..., :3]
    return int(np.count_nonzero(np.all(np.abs(picture - to_rgb(colour)) < 0.02, axis=-1)))


def area(corners):
    x, y = corners.T
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


def jointed(snapshot, names):
    """The state with joints: the name of the joint of some contacts, by their row."""
    every = tuple(dict.fromkeys(names.values()))
    joints = np.full(len(snapshot.contact), -1)
    joints[[*names]] = [every.index(name) for name in names.values()]
    return dataclasses.replace(snapshot, contact_joint=joints, joint_names=every)


def result_with_peak(stresses, cracks=0.0):
    record = Curve()
    for step, stress in enumerate(stresses):
        values = {"step": step, "axial_strain": 1e-5 * step, "axial_stress": stress}
        values |= {"tensile_cracks": cracks * step, "shear_cracks": cracks * step / 2}
        record.append(**(dict.fromkeys(COLUMNS, 0.0) | values))
    result = Result(
        "0.1", "2023.02a", "uniaxial", "flexible", {"name": "rock"}, 1, 2, 1, 10, 8, curve=record
    )
    result.measure(max_unbalanced=1.5e-3)
    return result


def test_grain_corners_are_counter_clockwise_polygons_of_the_right_area():
    snapshot = wall(columns=3, rows=4)
    polygons = maps.grain_corners(snapshot.triangles)
    assert sorted(tuple(sorted(polygon)) for polygon in polygons) == [
        tuple(5 * grain + corner for corner in range(4)) for grain in range(12)
    ]
    stretched = WIDTH * HEIGHT * np.linalg.det(np.eye(2) + GRADIENT)
    for polygon in polygons:
        assert area(snapshot.positions[polygon]) == pytest.approx(stretched, rel=1e-10)


@pytest.mark.parametrize(("points", "share"), [(1, 1.0), (2, 0.5), (3, 1 / 6)])
def test_a_cracked_point_covers_its_share_of_the_contact(points, share):
    snapshot = wall(points=points)
    segments = maps.crack_segments(snapshot)
    for mode in (TENSILE, SHEAR):
        contacts = snapshot.point_contact[snapshot.crack_mode == mode]
        ends = snapshot.contact_ends[contacts]
        assert np.array_equal(segments[mode][:, 0], ends[:, 0])
        expected = share * (ends[:, 1] - ends[:, 0])
        assert np.allclose(segments[mode][:, 1] - segments[mode][:, 0], expected, atol=1e-15)


def test_cracks_appear_in_their_colours(tmp_path):
    snapshot = wall()
    maps.crack_picture(tmp_path / "cracks.png", snapshot, "wall")
    modes = np.where(snapshot.crack_mode == SHEAR, 0, snapshot.crack_mode)
    snapshot = dataclasses.replace(snapshot, crack_mode=modes)
    maps.crack_picture(tmp_path / "tensile.png", snapshot, "wall")
    for mode in (TENSILE, SHEAR):
        colour = style.COLOURS[mode]
        both = pixels_like(tmp_path / "cracks.png", colour)
        without_shear = pixels_like(tmp_path / "tensile.png", colour)
        assert both > 0
        assert (without_shear < both) == (mode == SHEAR)


def test_a_notch_is_seen_and_later_touches_are_none(tmp_path):
    snapshot = wall()
    assert len(snapshot.cuts) == 0
    damage, mode = snapshot.point_damage.copy(), snapshot.crack_mode.copy()
    there = np.isin(snapshot.point_contact, [4, 6])
    damage[there], mode[there] = 1.0, 0  # of these one was cut before the test
    cut = dataclasses.replace(snapshot, point_damage=damage, crack_mode=mode)
    assert cut.cuts.tolist() == [4, 6]
    maps.crack_picture(tmp_path / "whole.png", cut)
    maps.crack_picture(tmp_path / "cut.png", jointed(cut, {4: "notch"}), notches=["notch"])
    plain = pixels_like(tmp_path / "whole.png", style.CUT)  # edges of the text
    assert pixels_like(tmp_path / "cut.png", style.CUT) > 2 * plain + 500


def test_joints_have_their_colours_and_a_legend(tmp_path, monkeypatch):
    figures = []
    save = style.save
    monkeypatch.setattr(
        maps, "save", lambda figure, path: (figures.append(figure), save(figure, path))
    )
    names = dict.fromkeys(range(6), "fault") | dict.fromkeys(range(8, 12), "bedding")
    snapshot = jointed(wall(), names)
    maps.crack_picture(tmp_path / "whole.png", wall())
    maps.crack_picture(tmp_path / "joints.png", snapshot)
    ends = np.split(1e3 * snapshot.contact_ends[[*names]], [6])
    axes = figures[-1].axes[0]
    for number, expected in enumerate(ends):
        colour = joint_colours.joint_colour(number)
        assert pixels_like(tmp_path / "whole.png", colour) == 0
        assert pixels_like(tmp_path / "joints.png", colour) > 500
        (lines,) = (one for one in axes.collections if to_hex(one.get_edgecolor()[0]) == colour)
        assert np.array(lines.get_segments()) == pytest.approx(expected)
    told = [one.get_text() for one in axes.get_legend().get_texts()]
    assert told[-2:] == ["joint fault", "joint bedding"]


def test_a_legend_names_the_first_joints_and_counts_the_others():
    handles = joint_colours.joint_handles({number: f"f{number}" for number in range(11)})
    assert [one.get_label() for one in handles] == [
        *(f"joint f{number}" for number in range(8)),
        "and 3 more joints",
    ]
    cracks = {style.COLOURS[mode] for mode in (TENSILE, SHEAR)}
    assert cracks.isdisjoint(joint_colours.JOINTS)


def test_joints_are_seen_below_their_cracks(tmp_path):
    snapshot = wall()
    cracked = np.isin(snapshot.point_contact, [0, 1, 2, 3, 4, 5])
    broken = dataclasses.replace(
        snapshot, crack_mode=np.where(cracked, SHEAR, 0), point_damage=1.0 * cracked
    )
    maps.crack_picture(tmp_path / "plain.png", broken)
    joints = dict.fromkeys(range(6), "fault")
    maps.crack_picture(tmp_path / "broken.png", jointed(broken, joints))
    colour = style.COLOURS[SHEAR]
    assert pixels_like(tmp_path / "broken.png", colour) > 0.9 * pixels_like(
        tmp_path / "plain.png", colour
    )


def test_the_peaks_label_stays_within_the_axes(tmp_path, monkeypatch):
    figures = []
    monkeypatch.setattr(curves, "save", lambda figure, _: figures.append(figure))
    curves.curve_picture(
        tmp_path / "late.png", result_with_peak([*np.linspace(0.0, 9.9e6, 40), 5e6])
    )
    (figure,) = figures
    figure.draw_without_rendering()
    axes = figure.axes[0]
    (label,) = (text for text in axes.texts if "MPa" in text.get_text())
    inside, box = label.get_window_extent(), axes.get_window_extent()
    assert box.x0 <= inside.x0
    assert inside.x1 <= box.x1
    legend = axes.get_legend().get_window_extent()
    assert legend.y1 < box.y0  # below: over neither the curve nor the label


def test_erased_bonds_are_black_lines_where_both_grains_are_left(tmp_path):
    snapshot = wall()
    maps.crack_picture(tmp_path / "whole.png", snapshot)
    for name, ends in (("cut", snapshot.contact_ends[:4]), ("hole", np.full((4, 2, 2), np.nan))):
        erased = dataclasses.replace(snapshot, erased_ends=ends)
        maps.crack_picture(tmp_path / f"{name}.png", erased)
    black = {
        name: pixels_like(tmp_path / f"{name}.png", "black") for name in ("whole", "cut", "hole")
    }
    assert black["whole"] == black["hole"] < black["cut"] - 1000


def test_the_mesh_is_drawn_on_request(tmp_path):
    snapshot = wall()
    polygons = [snapshot.positions[corners] for corners in maps.grain_corners(snapshot.triangles)]
    maps.specimen_picture(tmp_path / "plain.png", polygons, caption="12 grains")
    mesh = (snapshot.positions, snapshot.triangles)
    maps.specimen_picture(tmp_path / "mesh.png", polygons, mesh)
    plain, meshed = imread(tmp_path / "plain.png"), imread(tmp_path / "mesh.png")
    assert min(plain.shape[:2]) > 300
    rows = slice(int(0.15 * plain.shape[0]), int(0.8 * plain.shape[0]))
    assert meshed[rows].mean() < plain[rows].mean()


def test_curve_shows_cracks_and_peak(tmp_path):
    rising = np.linspace(0.0, 100e6, 200)
    loaded = result_with_peak([*rising, *rising[::-4]], cracks=3.0)
    curves.curve_picture(tmp_path / "curve.png", loaded)
    for colour in style.COLOURS.values():
        assert pixels_like(tmp_path / "curve.png", colour) > 100


@pytest.mark.parametrize("stresses", [[], [0.0], [0.0, 1e6], [0.0, np.nan], np.linspace(0, 1, 9)])
def test_records_without_a_peak_are_drawn_too(tmp_path, stresses):
    curves.curve_picture(tmp_path / "curve.png", result_with_peak(stresses))
    assert imread(tmp_path / "curve.png").shape[0] > 300


def test_pictures_need_neither_a_display_nor_pyplot():
    code = (
        "import sys; from flexpm.report import curves; "
        "assert 'matplotlib.pyplot' not in sys.modules; "
        "print('matplotlib' in sys.modules)"
    )
    package = str(Path(curves.__file__).parents[2])
    found = captured(
        [sys.executable, "-c", code], check=True, env={**os.environ, "PYTHONPATH": package}
    )
    assert found.stdout.strip() == "True"


@pytest.mark.parametrize(
    ("test", "strain"),
    [("uniaxial", "axial strain [%]"), ("bending", "strain of the outer fibre [%]")],
)
def test_axes_are_named_in_the_words_of_the_test(test, strain, tmp_path, monkeypatch):
    labels = []
    monkeypatch.setattr(
        curves, "save", lambda figure, _: labels.extend(a.get_xlabel() for a in figure.axes)
    )
    result = dataclasses.replace(result_with_peak([0.0, 1e6, 2e6, 1e6]), test=test)
    curves.curve_picture(tmp_path / "curve.png", result)
    assert strain in labels


def test_a_core_has_its_volumetric_strain_below_the_stress(tmp_path, monkeypatch):
    """E of 100 GPa and nu of 0.2: the area shrinks by 0.8 of the axial strain, none by cracks."""
    figures = []
    monkeypatch.setattr(curves, "save", lambda figure, _: figures.append(figure))
    made = result_with_peak([*np.linspace(0.0, 40e6, 41), 30e6, 10e6])
    record = Curve.from_array(made.curve.array.copy())
    record["lateral_strain"][:] = 0.2 * record["axial_strain"]
    core = dataclasses.replace(made, curve=record, youngs_modulus=1e11, poissons_ratio=0.2)
    for result in (core, dataclasses.replace(core, test="bending")):
        curves.curve_picture(tmp_path / "curve.png", result)
    with_volume, without = figures
    assert len(without.axes) == 2  # stress and numbers of cracks
    stress, below = with_volume.axes[:2]
    assert below.get_ylabel() == "area strain [%]"
    assert below.get_xlabel() == "axial strain [%]"
    assert below.get_xlim() == stress.get_xlim()
    total, elastic, cracks = (line for line in below.lines if len(line.get_xdata()) == 41)
    assert total.get_ydata() == pytest.approx(0.8 * total.get_xdata())
    assert elastic.get_ydata() == pytest.approx(0.8 * total.get_xdata())
    assert cracks.get_ydata() == pytest.approx(np.zeros(41), abs=1e-12)


def test_a_core_without_moduli_or_a_peak_has_the_total_alone(tmp_path):
    found = curves.volumes_of(result_with_peak(np.linspace(0.0, 40e6, 41)))
    assert [line.label for line in found.lines] == ["total"]
    assert found.title == "Area strain"
    curves.curve_picture(tmp_path / "curve.png", result_with_peak([0.0, 1e6]))
    nowhere = Curve.from_array(np.full((3, len(COLUMNS)), np.nan))
    assert curves.volumes_of(dataclasses.replace(result_with_peak([0.0]), curve=nowhere)) is None


def test_a_shear_test_is_drawn_over_its_displacement(tmp_path, monkeypatch):
    """Its line, its peak and places of its strains, which are a hundred times as large in µm."""
    drawn = []
    monkeypatch.setattr(curves, "save", lambda figure, _: drawn.extend(figure.axes))
    record = Curve(("displacement",))
    for step, stress in enumerate([0.0, 1e6, 3e6, 1e6]):
        strain = 1e-5 * step
        values = {"step": step, "axial_strain": strain, "axial_stress": stress}
        record.append(**dict.fromkeys(COLUMNS, 0.0) | values, displacement=0.04 * strain)
    result = dataclasses.replace(
        result_with_peak([0.0]), test="shear", curve=record, peak_stress=3e6, peak_strain=2e-5
    )
    curves.curve_picture(tmp_path / "curve.png", result)
    line, peak = drawn[0].lines
    assert line.get_xdata() == pytest.approx([0.0, 0.4, 0.8, 1.2])
    assert (*peak.get_xdata(), *peak.get_ydata()) == pytest.approx((0.8, 3.0))
    assert curves.places_of(result, 1.5e-5) == pytest.approx(0.6)
    assert drawn[0].get_xlabel() == "displacement [µm]"


@pytest.mark.parametrize("loc", ["left", "center"])
@pytest.mark.parametrize("words", [3, 14, 30])
def test_a_title_stays_within_its_picture(tmp_path, loc, words):
    """Also that of a narrow map, whose axes begin far from the left edge."""
    text = " ".join(["granite,"] * words)
    figure = Figure(figsize=(2.2, 6.0), layout="constrained")
    axes = figure.add_subplot()
    axes.set_ylabel("stress [MPa]")
    axes.set_title(text, loc=loc)
    style.save(figure, tmp_path / "a.png")
    (title,) = style._titles_of(axes)
    figure.draw_without_rendering()
    box = title.get_window_extent()
    assert box.x1 < figure.bbox.width and (loc == "left" or box.x0 > 0.0)
    assert title.get_text().split() == text.split()


def test_an_envelope_says_what_it_shows(tmp_path, monkeypatch):
    shown = {}
    monkeypatch.setattr(comparison, "save", lambda figure, _: shown.update(axes=figure.axes[0]))
    peaks = {0.0: 120e6, 4e6: 150e6, 8e6: 172e6}
    one = Envelope.of("flexible", list(peaks), list(peaks.values()))
    runs = [(c, peak, "not_quasistatic" if c else "ok") for c, peak in peaks.items()]
    runs.append((12e6, None, "no_peak"))
    comparison.envelope_picture(tmp_path / "a.png", [one], None, "biaxial, augig-table7", runs)
    axes = shown["axes"]
    assert axes.get_title("left").splitlines() == [
        "biaxial, augig-table7",
        "1 of 4 runs have no peak and are not plotted",
    ]
    lines = {line.get_label(): line for line in axes.lines}
    named = [text.get_text() for text in axes.get_legend().get_texts()]
    assert len(named) == len(axes.lines) == 4  # peaks, both criteria, doubtful peaks
    assert lines["not_quasistatic"].get_xydata().tolist() == [[4.0, 150.0], [8.0, 172.0]]
    assert any(label.startswith("flexible: c = ") for label in named)
