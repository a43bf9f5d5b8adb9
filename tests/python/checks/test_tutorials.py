# SPDX-License-Identifier: GPL-3.0-or-later
"""The tutorials run as they stand and show what they say."""

import ast
import math
import os
import re
import sys
from pathlib import Path

import pytest
from processes import captured

TUTORIALS = Path(__file__).resolve().parents[3] / "scripts" / "tutorials"


def printed(name, package_parent, *arguments):
    return captured(
        [sys.executable, str(TUTORIALS / name), *arguments],
        env={
            **os.environ,
            "PYTHONPATH": str(package_parent),
            "OMP_NUM_THREADS": "1",
            "MPLBACKEND": "Agg",
        },
        check=True,
    ).stdout


@pytest.mark.long
def test_two_minerals(package_parent, tmp_path):
    text = printed("two_minerals.py", package_parent, str(tmp_path))
    found = re.search(r"both .* ([\d.]+) GPa, between ([\d.]+) and (.*)", text)
    modulus, lower, upper = found.groups()
    assert float(lower) < float(modulus) < float(upper)
    cracked = dict(re.findall(r"^(\w+ - \w+) +([\d.]+) % of the points", text, re.MULTILINE))
    assert float(cracked["quartz - quartz"]) < float(cracked["feldspar - feldspar"])
    for rock in ("feldspar", "two-minerals"):
        assert (tmp_path / rock / "cracks.png").stat().st_size > 10000


@pytest.mark.long
def test_thin_section(package_parent, tmp_path):
    text = printed("thin_section.py", package_parent, str(tmp_path))
    made, drawn = map(
        float, re.search(r"quartz ([\d.]+) mm2, in the image ([\d.]+)", text).groups()
    )
    assert made == pytest.approx(drawn, rel=0.005)
    mixed, weak = map(float, re.findall(r"strength (\d+) MPa", text))
    assert weak < 0.95 * mixed
    first, second = map(int, re.findall(r"feldspar/quartz +(\d+) points", text))
    assert second > first
    assert (tmp_path / "weak" / "cracks.png").stat().st_size > 10000


@pytest.mark.long
def test_label_volume(package_parent, tmp_path):
    text = printed("label_volume.py", package_parent, str(tmp_path))
    kept, grains, agree = re.search(r"(\d+) of (\d+) grains, ([\d.]+) %", text).groups()
    assert 150 < int(kept) <= int(grains) <= 170 and float(agree) > 98.0
    made, drawn = map(float, re.search(r"pore ([\d.]+) %, in the scan ([\d.]+) %", text).groups())
    assert made == pytest.approx(drawn, abs=0.2)
    pairs = dict(re.findall(r"^(\w+/\w+) +(\d+) points", text, re.MULTILINE))
    assert {*pairs} == {"feldspar/feldspar", "feldspar/quartz", "quartz/quartz"}
    assert int(pairs["quartz/quartz"]) < int(pairs["feldspar/feldspar"])
    for name in ("volume.png", "core/outside.png", "core/cracks.csv"):
        assert (tmp_path / name).stat().st_size > 1000
    assert "no map" not in (tmp_path / "core" / "report.html").read_text()


@pytest.mark.long
def test_first_test(package_parent, tmp_path):
    text = printed("first_test.py", package_parent, str(tmp_path))
    solved, tested = map(float, re.findall(r"E = ([\d.]+) GPa", text))
    assert tested == pytest.approx(solved, rel=0.02)
    assert "status ok" in text
    assert (tmp_path / "report.html").is_file()


@pytest.mark.long
def test_envelope(package_parent, tmp_path):
    text = printed("envelope.py", package_parent, str(tmp_path))
    peaks = [float(peak) for peak in re.findall(r"peak +([\d.]+) MPa", text)]
    assert len(peaks) == 3
    assert peaks == sorted(peaks)
    assert 20.0 < float(re.search(r"phi = (\d+) degrees", text)[1]) < 70.0
    assert (tmp_path / "envelope.png").stat().st_size > 5000


@pytest.mark.long
def test_first_core(package_parent, tmp_path):
    text = printed("first_core.py", package_parent, str(tmp_path))
    solved, tested = map(float, re.search(r"E = ([\d.]+) .* ([\d.]+) GPa", text).groups())
    assert tested == pytest.approx(solved, rel=0.02)
    assert "status ok" in text
    assert 0.3 < float(re.search(r"initiation at ([\d.]+) of the peak", text)[1]) < 1.0
    assert (tmp_path / "report.html").is_file()
    assert (tmp_path / "outside.png").stat().st_size > 10000


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "pattern"), [("triaxial_envelope", "peak +"), ("true_triaxial", "strength ")]
)
def test_pressures_on_solids(package_parent, tmp_path, name, pattern):
    text = printed(f"{name}.py", package_parent, str(tmp_path))
    peaks = [float(peak) for peak in re.findall(rf"{pattern}([\d.]+) MPa", text)]
    assert len(peaks) == 3
    assert peaks == sorted(peaks)
    assert Path(re.search(r"open (\S+)", text)[1]).is_file()


@pytest.mark.long
def test_own_spheres(package_parent, tmp_path):
    text = printed("own_spheres.py", package_parent, str(tmp_path))
    above, height = map(float, re.search(r"above (\d+) of (\d+) mm", text).groups())
    assert above > 0.7 * height
    assert "status ok" in text
    assert (tmp_path / "outside.png").stat().st_size > 10000


@pytest.mark.long
def test_brazilian(package_parent, tmp_path):
    text = printed("brazilian.py", package_parent, str(tmp_path))
    direct, split = (float(peak) for peak in re.findall(r"([\d.]+) MPa", text))
    ratio = float(re.search(r"to indirect strength ([\d.]+)", text)[1])
    assert ratio == pytest.approx(direct / split, abs=0.01)
    assert float(re.search(r"(\d+) % of the cracked points", text)[1]) > 70.0


@pytest.mark.long
def test_own_discs(package_parent, tmp_path):
    text = printed("own_discs.py", package_parent, str(tmp_path))
    below, above = map(int, re.search(r"(\d+) grains below the middle, (\d+)", text).groups())
    assert below > 1.5 * above
    assert (tmp_path / "cracks.png").stat().st_size > 10000


@pytest.mark.long
def test_joints(package_parent, tmp_path):
    text = printed("joints.py", package_parent, str(tmp_path))
    found = re.findall(r"strength +([\d.]+) MPa, plane of weakness +([\d.]+) MPa", text)
    assert len(found) == 3
    for strength, plane in found:
        assert float(strength) == pytest.approx(float(plane), rel=0.06)


@pytest.mark.long
def test_jointed_core(package_parent, tmp_path):
    text = printed("jointed_core.py", package_parent, str(tmp_path))
    found = re.findall(r"sliding at ([\d.]+) MPa, plane of weakness ([\d.]+) MPa", text)
    assert len(found) == 3
    assert text.count("deviation 0 m") == 3
    for stress, plane in found:
        assert float(stress) == pytest.approx(float(plane), rel=0.02)


def test_wedge(package_parent):
    """The factor of Hoek and Bray is met within a degree, the acceleration within 1 %."""
    text = printed("wedge.py", package_parent)
    assert "friction angle of 30.95 degrees" in text
    found = re.findall(
        r"limit ([+-]\d) degrees: slip +(-?[\d.]+) nm in 1 ms, rigid wedge ([\d.]+)", text
    )
    slips = {int(beyond): (float(slip), float(free)) for beyond, slip, free in found}
    assert abs(slips[1][0]) < 0.1
    for beyond in (-1, -3):
        assert slips[beyond][0] == pytest.approx(slips[beyond][1], rel=0.01)


@pytest.mark.slow
def test_collapse(package_parent, tmp_path):
    """The pile is wider than the column, and comes to rest."""
    text = printed("collapse.py", package_parent, str(tmp_path))
    widths = [float(width) for width in re.findall(r"floor, ([\d.]+) mm wide", text)]
    speeds = [float(speed) for speed in re.findall(r"mean speed ([\d.]+) mm/s", text)]
    assert widths[-1] > 1.3 * widths[0]
    assert speeds[-1] < 0.1 * max(speeds)
    assert (tmp_path / "collapse.png").stat().st_size > 10_000


@pytest.mark.long
def test_fracture_network(package_parent, tmp_path):
    """Two networks at two dips: joints near 60 degrees slide, level ones hardly weaken."""
    text = printed("fracture_network.py", package_parent, str(tmp_path), "2", "0,60")
    level, steep = (float(number) for number in re.findall(r"strength +([\d.]+)", text))
    assert steep < 0.8 * level
    assert "P21 target 150" in text
    assert (tmp_path / "dip-60" / "network-2" / "network.png").stat().st_size > 10000
    assert (tmp_path / "strengths.png").stat().st_size > 10000


@pytest.mark.long
def test_incline(package_parent):
    text = printed("incline.py", package_parent)
    found = re.findall(r"([+-]\d+) degrees: +([\d.]+) nm in 1 ms, Coulomb ([\d.]+)", text)
    ways = {int(beyond): (float(way), float(free)) for beyond, way, free in found}
    assert ways[-1][0] < 1.0
    for beyond in (2, 10):
        assert ways[beyond][0] == pytest.approx(ways[beyond][1], rel=0.02)


@pytest.mark.long
def test_toppling(package_parent):
    text = printed("toppling.py", package_parent)
    assert "dip = 26.07 degrees: stable, with a weight of 16" in text
    assert "dip = 27.07 degrees: settle: missing reactions =" in text
    assert "topples by 5 degrees after 0." in text


@pytest.mark.slow
def test_calibration(package_parent, tmp_path):
    text = printed("calibration.py", package_parent, str(tmp_path / "rock"))
    assert text.count(": met") == 3
    assert float(re.search(r"E = ([\d.]+) GPa", text)[1]) == pytest.approx(30.0, rel=0.1)
    assert (tmp_path / "rock" / "my-rock.toml").is_file()


@pytest.mark.long
def test_load_unload_reload(package_parent, tmp_path):
    text = printed("load_unload_reload.py", package_parent, str(tmp_path))
    assert (tmp_path / "curves.png").stat().st_size > 5000
    for model in ("flexible", "rigid", "jcfpm"):
        slopes = re.findall(rf"^{model} +\w+ +E = +([\d.]+) GPa", text, re.MULTILINE)
        load, unload, reload = map(float, slopes)
        assert unload == pytest.approx(load, rel=0.01)
        assert reload == pytest.approx(unload, rel=0.005)
    assert [float(error) < 1e-6 for error in re.findall("energy error (.*)", text)] == [True, True]


@pytest.mark.long
def test_notched_beam(package_parent):
    text = printed("notched_beam.py", package_parent)
    toughness = float(re.search(r"toughness ([\d.]+) MPa", text)[1])
    assert 0.3 < toughness < 3.0
    first, last = (float(number) for number in re.findall(r"open by ([\d.]+) um", text))
    assert last > 1.2 * first
    left, right = map(float, re.search(r"reactions (\S+) N (\S+) N$", text, re.MULTILINE).groups())
    assert left == pytest.approx(right, rel=0.1)


def test_cyclic_loading(package_parent):
    text = printed("cyclic_loading.py", package_parent)
    found = re.findall(r"cycle \d: ([\d.]+) MPa, ([\d.]+) mJ", text)
    stresses, losses = zip(*((float(stress), float(lost)) for stress, lost in found), strict=True)
    assert stresses == tuple(sorted(stresses))
    assert len(losses) == 3
    assert losses[0] < losses[2]


@pytest.mark.long
def test_direct_shear(package_parent, tmp_path):
    text = printed("direct_shear.py", package_parent, str(tmp_path))
    peak, most, residual, least = map(float, re.findall(r"([\d.]+) MPa", text))
    assert 0.9 * most < peak <= most
    assert residual == pytest.approx(least, rel=0.01)
    opened = float(re.search(r"opened by ([\d.]+) um$", text, re.MULTILINE)[1])
    assert opened == pytest.approx(60.0 * math.tan(math.radians(15.0)), rel=0.01)
    assert (tmp_path / "direct_shear.png").stat().st_size > 10000
    tree = ast.parse((TUTORIALS / "direct_shear.py").read_text())
    statements = [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]
    assert len(statements) <= 1 + 25  # the text at its head


@pytest.mark.long
def test_class_two(package_parent, tmp_path):
    text = printed("class_two.py", package_parent, str(tmp_path))
    found = re.findall(r"peak ([\d.]+) MPa at ([\d.]+) permille, end at ([\d.]+).* ok", text)
    axial, lateral = ([float(number) for number in line] for line in found)
    assert lateral[0] == pytest.approx(axial[0], rel=0.05)
    assert axial[2] > axial[1]
    assert lateral[2] < 0.7 * lateral[1]
    assert (tmp_path / "class_two.png").stat().st_size > 10000


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_snap_back(package_parent, tmp_path, model):
    """A bar longer than snaps back returns the law of its weak line while the ends go back."""
    text = printed("snap_back.py", package_parent, str(tmp_path), model)
    first, last = map(float, re.search(r"from ([\d.]+) to ([\d.]+) um", text).groups())
    assert last < 0.8 * first
    assert float(re.search(r"deviation from the law ([\d.]+) %", text)[1]) < 2.0
    followed = re.search(r"set point: ([\d.]+) % of the rows$", text, re.MULTILINE)
    assert float(followed[1]) > 95.0  # and no warning after it
    assert (tmp_path / "snap_back.png").stat().st_size > 10000


@pytest.mark.parametrize(
    ("name", "most"), [("load_unload_reload", 30), ("notched_beam", 30), ("cyclic_loading", 15)]
)
def test_a_test_of_ones_own_takes_few_lines(name, most):
    """Without comments and blank lines."""
    text = (TUTORIALS / f"{name}.py").read_text().split('"""')[2]
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    assert len(lines) <= most


@pytest.mark.long
def test_four_point_beam(package_parent, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = printed("four_point_beam.py", package_parent)
    assert float(re.search(r"bending strength ([\d.]+) MPa", text)[1]) > 5.0
    assert (tmp_path / "beam" / "report.html").is_file()
    assert printed("four_point_beam.py", package_parent) == text  # it is there already
