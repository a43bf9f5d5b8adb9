# SPDX-License-Identifier: GPL-3.0-or-later
"""A resumed run takes its packing from its folder, to the same bits, or packs from its seed."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
import yade
from step_clock import step_clock

from flexpm.cli import main as cli
from flexpm.runs.checkpoint import Checkpoint
from flexpm.specimens import packing
from flexpm.specimens.spec import GRAINS_FILE, PACKING_FILE

#: Specimens: packings in 2D and in 3D, one that is sawn, and one that is cut by a joint.
RUNS = {
    "rectangle": ["tension", "--width", "0.012", "--height", "0.024", "--thickness", "0.01"],
    "half-disc": ["scb", "--diameter", "0.03", "--thickness", "0.01", "--notch", "0.007"],
    "joints": ["tension", "--width", "0.012", "--height", "0.024", "--thickness", "0.01"],
    "box": [
        *("tension", "--shape", "box", "--width", "0.009", "--depth", "0.009"),
        *("--height", "0.018"),
    ],
}
#: Ends within a second, before a peak.
SHORT = ["--max-strain", "2e-5", "--no-report", "--quiet"]
FILES = ("curve.csv", "cracks.csv", "final.vtu", "specimen.vtu")


@pytest.fixture
def packed(monkeypatch) -> list[int]:
    """Numbers of the grains of each packing that is made."""
    made: list[int] = []
    pack = packing.pack

    def counted(frame, radii, *others):
        made.append(len(radii))
        return pack(frame, radii, *others)

    monkeypatch.setattr(packing, "pack", counted)
    return made


def command(name: str, folder: Path, seed: int = 1) -> list[str]:
    """The command of a run into a folder."""
    asked = ["run", *RUNS[name], *SHORT, "--seed", str(seed), "--out", str(folder)]
    if name == "joints":
        lines = folder.parent / "joints.csv"
        lines.write_text("x1,y1,x2,y2,name\n0.004,0.011,0.008,0.013,bed\n")
        asked += ["--joints", str(lines), "--set", "joint.bed.open=true"]
    return asked


def interrupt(monkeypatch, asked: list[str]) -> None:
    """Start a run and interrupt it as soon as it has saved a checkpoint under way."""
    save = Checkpoint.save

    def saved(checkpoint):
        save(checkpoint)
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        step_clock(patched.setattr, look=10)
        patched.setattr(Checkpoint, "due", property(lambda _: yade.O.iter > 0))
        patched.setattr(Checkpoint, "save", saved)
        assert cli.main(asked) == 130


def other_packing(file: Path) -> None:
    """Put a whole packing of another seed in the place of a run's."""
    other = file.parent.parent / "other"
    name = "joints" if file.name == GRAINS_FILE else json.loads(file.read_text())["spec"]["kind"]
    assert cli.main(command(name, other, seed=2)) == 3
    file.write_bytes((other / file.name).read_bytes())


def flip(file: Path) -> None:
    """Change one digit of a number in the middle of a file."""
    text = file.read_text()
    place = text.index("1", len(text) // 2)
    file.write_text(text[:place] + "2" + text[place + 1 :])


HARMS: dict[str, tuple[Callable[[Path], object], str]] = {
    "kept": (lambda file: None, ""),
    "missing": (Path.unlink, "cannot be read (No such file or directory)"),
    "damaged": (flip, "is damaged or of another run"),
    "foreign": (other_packing, "is damaged or of another run"),
}


@pytest.mark.parametrize("harm", HARMS)
@pytest.mark.parametrize("name", RUNS)
def test_a_resumed_run_ends_with_the_same_bits(monkeypatch, capsys, tmp_path, packed, name, harm):
    whole, out = tmp_path / "whole", tmp_path / "out"
    assert cli.main(command(name, whole)) == 3
    interrupt(monkeypatch, command(name, out))
    file = out / (GRAINS_FILE if name == "joints" else PACKING_FILE)
    kept = file.read_bytes()
    change, told = HARMS[harm]
    change(file)
    packed.clear()
    capsys.readouterr()
    assert cli.main(command(name, out)) == 3
    lines = [line for line in capsys.readouterr().out.splitlines() if "packs from" in line]
    assert json.loads((out / "result.json").read_text())
    assert (out / "checkpoint.json").is_file()
    assert len(packed) == (harm != "kept")
    assert lines == ([f"packs from the seed again: {file} {told}"] if told else [])
    assert file.read_bytes() == kept
    for one in FILES:
        assert (out / one).read_bytes() == (whole / one).read_bytes(), one


def test_a_packing_without_a_checkpoint_is_not_used(capsys, tmp_path, packed):
    out = tmp_path / "out"
    assert cli.main(command("box", out)) == 3
    for file in (*out.glob("checkpoint*"), out / "result.json"):
        file.unlink()
    packed.clear()
    capsys.readouterr()
    assert cli.main(command("box", out)) == 3
    assert len(packed) == 1
    assert "packs from" not in capsys.readouterr().out


@pytest.mark.parametrize("value", [1, None, [], "0" * 64])
def test_a_checkpoint_with_another_packing_is_refused(tmp_path, capsys, value):
    out = tmp_path / "out"
    assert cli.main(command("box", out)) == 3
    file = out / "checkpoint.json"
    file.write_text(json.dumps(json.loads(file.read_text()) | {"packing": value}))
    capsys.readouterr()
    assert cli.main(command("box", out)) == 2
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert "checkpoint" in told.err
    assert told.out.startswith("packs from the seed again: ")
