# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's classes are laid out as in the headers of the build; any difference stops the import."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from processes import captured

from flexpm import _flexpm, _plugin

SIZES = {name: detail for name, check, _, detail in _flexpm.abi_report() if check == "size"}


def rows(fault: str = "") -> list[tuple[str, str, bool, str]]:
    return [tuple(row) for row in _flexpm.abi_report(fault)]


def test_all_checks_pass() -> None:
    report = rows()
    assert [row for row in report if not row[2]] == []
    assert {check.split()[0] for _, check, _, _ in report} == {"size", "vtable", "attribute"}


def test_each_class_that_adapters_use_is_covered() -> None:
    # read from the sources, not from a second list
    folder = Path(__file__).resolve().parents[2] / "pkg/flexpm/yade"
    text = "".join(p.read_text() for p in folder.glob("*.[ch]pp") if not p.name.startswith("abi"))
    text = re.sub(r'R"""\(.*?\)"""', "", text, flags=re.DOTALL)
    text = re.sub(r'^\s*#include.*$|//.*$|"(\\.|[^"\\\n])*"', "", text, flags=re.MULTILINE)
    import yade

    used = {word for word in re.findall(r"\b[A-Z]\w+\b", text) if hasattr(yade.wrapper, word)}
    own = set(_flexpm.register_classes())
    # Omega is a singleton of the library, Serializable the common base without data
    assert used - own - {"Omega", "Serializable"} <= set(SIZES)


@pytest.mark.parametrize("name", sorted(SIZES))
def test_wrong_size_is_caught(name: str) -> None:
    failed = [row for row in rows(f"size:{name}") if not row[2]]
    assert [row[:2] for row in failed] == [(name, "size")]
    size = int(SIZES[name].split()[0])
    assert f"{size} bytes in YADE, {size + 8} in its headers" == failed[0][3]


@pytest.mark.parametrize(
    "name", ["State", "Body", "Shape", "GlobalEngine", "BoundFunctor", "ScGeom"]
)
def test_wrong_virtual_table_is_caught(name: str) -> None:
    failed = [row for row in rows(f"vtable:{name}") if not row[2]]
    assert [row[:2] for row in failed] == [(name, "vtable")]


@pytest.mark.long
def test_each_attribute_check_can_fail() -> None:
    names = [(c, k.split()[1]) for c, k, _, _ in rows() if k.startswith("attribute ")]
    assert len(names) > 70
    for owner, attribute in names:
        failed = [row for row in rows(f"attribute:{owner}.{attribute}") if not row[2]]
        assert [row[:2] for row in failed] == [(owner, f"attribute {attribute}")]


def test_mismatch_stops_the_import_with_one_line() -> None:
    with pytest.raises(ImportError) as caught:
        _plugin.require_same_layout(rows("size:State"))
    message = str(caught.value)
    assert "State" in message and "scripts/setup" in message and "\n" not in message
    assert "320 bytes in YADE, 328" in message


@pytest.mark.parametrize("folder", ["/usr/lib/x86_64-linux-gnu/yade-long-double", "/usr/lib/yade"])
def test_other_precision_is_refused(folder: str) -> None:
    with pytest.raises(ImportError, match="must end in yade-double"):
        _plugin.require_double(folder)


@pytest.mark.skipif(shutil.which("objdump") is None, reason="needs objdump (package binutils)")
@pytest.mark.parametrize("name", ["State", "Shape", "Engine", "Scene", "Material"])
def test_size_read_from_code_equals_disassembly(name: str) -> None:
    import yade

    library = Path(yade.config.libDir) / "libyade.so"
    command = [
        "objdump",
        "-d",
        "--no-show-raw-insn",
        f"--disassemble=_ZN4yade{6 + len(name)}Create{name}Ev",
    ]
    text = captured([*command, str(library)], check=True).stdout
    size = int(re.search(r"mov\s+\$0x([0-9a-f]+),%edi", text).group(1), 16)
    assert SIZES[name] == f"{size} bytes"


class TestLiveScene:
    """The plugin's code and YADE's see the same scene."""

    @pytest.fixture(autouse=True)
    def _two_spheres(self) -> None:
        from yade import utils
        from yade.wrapper import FrictMat, Omega

        self.scene = Omega()
        self.scene.reset()
        self.scene.materials.append(FrictMat())
        self.scene.bodies.append([utils.sphere((1.5, -2, 3), 1), utils.sphere((7, 8, 9.25), 1)])

    def test_bodies(self) -> None:
        seen = _flexpm.abi_scene()["bodies"]
        assert [(i, tuple(p), s) for i, p, s in seen] == [
            (0, (1.5, -2.0, 3.0), "Sphere"),
            (1, (7.0, 8.0, 9.25), "Sphere"),
        ]

    def test_clock(self) -> None:
        self.scene.engines = []
        self.scene.dt = 0.25
        self.scene.run(6, True)
        seen = _flexpm.abi_scene()
        assert (seen["dt"], seen["iter"], seen["time"]) == (0.25, 6, 1.5)

    def test_forces_added_here_are_seen_there(self) -> None:
        _flexpm.abi_add_force(1, (1, 2, 3), (4, 5, 6))
        _flexpm.abi_add_force(1, (1, 0, 0), (0, 0, 1))
        assert tuple(self.scene.forces.f(1)) == (2, 2, 3)
        assert tuple(self.scene.forces.t(1)) == (4, 5, 7)
        assert tuple(self.scene.forces.f(0)) == (0, 0, 0)

    def test_forces_added_there_are_seen_here(self) -> None:
        self.scene.forces.addF(0, (3, 2, 1))
        self.scene.forces.addT(0, (6, 5, 4))
        force, torque = _flexpm.abi_get_force(0)
        assert (tuple(force), tuple(torque)) == ((3, 2, 1), (6, 5, 4))

    def test_energies(self) -> None:
        self.scene.trackEnergy = True
        _flexpm.abi_add_energy("probe", 1.5)
        _flexpm.abi_add_energy("probe", 2.0)
        assert dict(self.scene.energy.items())["probe"] == 3.5
        assert self.scene.energy.total() == 3.5

    def test_interactions(self) -> None:
        assert _flexpm.abi_insert_interaction(0, 1)
        assert not _flexpm.abi_insert_interaction(0, 1)  # there is one already
        assert self.scene.interactions.has(0, 1)
        assert _flexpm.abi_scene()["interactions"] == [(0, 1, False)]
        self.scene.interactions.clear()
        assert _flexpm.abi_scene()["interactions"] == []
