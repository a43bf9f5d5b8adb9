# SPDX-License-Identifier: GPL-3.0-or-later
"""Ends of the command: one line, the documented exit code, and files that are finished."""

from __future__ import annotations

import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import self_signals
from processes import captured, running, wait_for
from sample_snapshot import read_vtu

import flexpm
from flexpm.cli import main as cli
from flexpm.files import FolderLock

ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": str(Path(flexpm.__file__).parent.parent),
    "OMP_NUM_THREADS": "1",
    "FLEXPM_DEFER": "1",
}
COMMAND = [sys.executable, "-P", "-m", "flexpm"]
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
TINY = ["--width", "0.012", "--height", "0.024", "--quiet"]
SOON = ["tension", *TINY, "--rate", "8", "--max-strain", "1e-5"]
#: A run of some thousand steps.
RUN = ["run", "uniaxial", *TINY]
#: A run of 1.8e9 steps.
ENDLESS = [*RUN, "--rate", "2e-5", "--loading", "constant"]


@pytest.fixture(autouse=True)
def handlers():
    """Give back the signal handlers of the test runner."""
    saved = {number: signal.getsignal(number) for number in SIGNALS}
    yield
    for number, handler in saved.items():
        signal.signal(number, handler)


def one_line(errors: str) -> str:
    assert errors.startswith("flexpm: ")
    assert errors.count("\n") == 1
    return errors


@pytest.mark.parametrize(
    ("error", "code", "text"),
    [
        (TypeError("two\nlines"), 1, "internal error: TypeError: two lines; set FLEXPM_DEBUG=1"),
        (RecursionError("deep"), 1, "internal error: RecursionError"),
        (RuntimeError("solve_static: pivot"), 3, "simulation failed: solve_static: pivot"),
        (OverflowError("too large"), 3, "simulation failed: too large"),
        (MemoryError(), 1, "memory = exhausted"),
        (OSError(errno.ENOSPC, "No space left on device", "curve.csv"), 1, "No space left"),
        (IsADirectoryError(errno.EISDIR, "Is a directory", "curve.csv"), 2, "curve.csv"),
        (PermissionError(errno.EACCES, "Permission denied", "x"), 2, "Permission denied"),
        (flexpm.errors.BusyError("out = 'x', is in use"), 1, "is in use"),
    ],
)
def test_any_exception_is_one_line(capsys, monkeypatch, error, code, text):
    def fail(*arguments):
        raise error

    monkeypatch.setattr(cli.inputs, "material", fail)
    assert cli.main(["elastic"]) == code
    assert text in one_line(capsys.readouterr().err)


def test_a_traceback_is_shown_if_it_is_asked_for(capsys, monkeypatch):
    monkeypatch.setattr(cli.inputs, "material", lambda *_: 1 / None)
    monkeypatch.setenv("FLEXPM_DEBUG", "1")
    assert cli.main(["elastic"]) == 1
    errors = capsys.readouterr().err
    assert errors.startswith("Traceback")
    assert "internal error: TypeError" in errors.splitlines()[-1]


def test_control_characters_do_not_reach_the_terminal(capsys):
    assert cli.main(["run", "uni\x1b[31maxial\x07"]) == 2
    assert "\x1b" not in one_line(capsys.readouterr().err)


@pytest.mark.long
@pytest.mark.parametrize("test", ["uniaxial", "brazilian"])
def test_a_diverged_run_writes_what_it_has(capsys, tmp_path, test):
    size = ["--diameter", "0.016", "--quiet"] if test == "brazilian" else TINY
    fast = ["--max-strain", "1e-9", "--rate", "1e10"] if test == "uniaxial" else ["--rate", "1e10"]
    (tmp_path / "cracks.png").write_text("of an earlier run")
    assert cli.main(["run", test, *size, *fast, "--out", str(tmp_path)]) == 3
    one_line(capsys.readouterr().err)
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["status"] == "diverged"
    # the record ends before the first row with a number that is none
    header, *rows = (tmp_path / "curve.csv").read_text().splitlines()
    assert header.startswith("step,axial_strain")
    assert not any("inf" in row.split(",")[3] or "nan" in row.split(",")[3] for row in rows)
    assert not (tmp_path / "cracks.png").exists()
    assert not (tmp_path / "fragments.png").exists()
    _, points, cells = read_vtu(tmp_path / "final.vtu")
    assert (cells["kind"] == 0).sum() == result["triangles"]


@pytest.mark.long
@pytest.mark.parametrize("model", ["flexible", "rigid"])
def test_a_run_that_diverges_under_its_confinement_writes_what_it_has(capsys, tmp_path, model):
    pressed = ["biaxial", *TINY, "--model", model, "--confinement", "1e15"]
    assert cli.main(["run", *pressed, "--out", str(tmp_path)]) == 3
    assert "status = diverged" in one_line(capsys.readouterr().err)
    assert json.loads((tmp_path / "result.json").read_text())["status"] == "diverged"
    assert {"curve.csv", "final.vtu"} <= {file.name for file in tmp_path.iterdir()}


@pytest.mark.long
def test_a_solid_whose_faces_turn_over_writes_what_it_has(capsys, tmp_path):
    box = ["--shape", "box", "--width", "0.012", "--depth", "0.012", "--height", "0.024"]
    fast = ["--rate", "1000", "--max-strain", "0.9", "--material", "augig3d-calibrated"]
    assert cli.main(["run", "uniaxial", *box, *fast, "--seed", "1", "--out", str(tmp_path)]) == 3
    assert "status = diverged" in one_line(capsys.readouterr().err)
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["status"] == "diverged"
    assert len((tmp_path / "curve.csv").read_text().splitlines()) > 2
    _, _, cells = read_vtu(tmp_path / "final.vtu")
    assert (cells["kind"] == 0).any()


@pytest.mark.long
@pytest.mark.parametrize("redirection", [">&-", "| true", "> /dev/full"])
def test_files_are_finished_when_nobody_reads_stdout(tmp_path, redirection):
    line = f'"$@" --out {tmp_path} {redirection}; exit ${{PIPESTATUS[0]}}'
    command = ["bash", "-c", line, "bash", *COMMAND, "elastic", *TINY]
    done = subprocess.run(command, env=ENVIRONMENT, stderr=subprocess.PIPE, text=True)
    if "full" in redirection:
        assert done.returncode == 1
        assert "standard output" in one_line(done.stderr)
    else:
        assert (done.returncode, done.stderr) == (0, "")
    assert json.loads((tmp_path / "result.json").read_text())["youngs_modulus"] > 0


def test_the_exit_code_is_right_without_stderr():
    command = ["bash", "-c", '"$@" 2>&-', "bash", *COMMAND, "run", "nothing"]
    assert subprocess.run(command, env=ENVIRONMENT).returncode == 2


@pytest.mark.parametrize("change", [{"HOME": None}, {"MPLBACKEND": "nothing"}])
def test_the_surroundings_do_not_matter(tmp_path, change):
    surroundings = {k: v for k, v in (ENVIRONMENT | change).items() if v is not None}
    command = [*COMMAND, "run", *SOON, "--out", str(tmp_path)]
    done = captured(command, env=surroundings)
    assert done.returncode == 3, done.stderr
    assert "no strength was found" in one_line(done.stderr)


def test_the_command_needs_no_path(launcher):
    command = [shutil.which(launcher[0]), *launcher[1:], "elastic", *TINY]
    surroundings = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = captured(command, env=surroundings | {"PATH": ""})
    assert (done.returncode, done.stderr) == (0, "")
    assert "Young's modulus" in done.stdout


def test_a_file_that_is_a_folder_is_named(capsys, tmp_path):
    (tmp_path / "result.json").mkdir()
    assert cli.main(["elastic", *TINY, "--out", str(tmp_path)]) == 2
    assert "result.json" in one_line(capsys.readouterr().err)


@pytest.mark.parametrize("name", ["curve.csv", "result.json", "final.vtu", "checkpoint.json"])
def test_a_folder_in_place_of_a_file_is_named_before_the_run(capsys, tmp_path, name):
    (tmp_path / name).mkdir()
    assert cli.main(["run", *SOON, "--out", str(tmp_path)]) == 2
    assert f"contains a folder {name}" in one_line(capsys.readouterr().err)
    assert [file.name for file in tmp_path.iterdir()] == [name]


def test_a_folder_of_no_valid_name_is_refused(capsys):
    assert cli.main(["elastic", *TINY, "--out", os.fsdecode(b"\xff\xfe")]) == 2
    assert "valid characters" in one_line(capsys.readouterr().err)


@pytest.mark.long
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("library", ["libyade", "_minieigenHP", "_flexpm.so", "_multiarray"])
def test_a_signal_while_libraries_are_loaded_is_one_line(tmp_path, number, code, library):
    with running([*COMMAND, *ENDLESS, "--out", str(tmp_path)], env=ENVIRONMENT) as process:
        maps = Path(f"/proc/{process.pid}/maps")
        wait_for(lambda: library in maps.read_text(), process, each=0.001)
        process.send_signal(number)
        errors = process.communicate(timeout=600)[1]
    assert process.returncode == code, errors
    one_line(errors)


def blocks(process: int, number: int) -> bool:
    """Whether a signal has to wait, as it does from the first line of the launcher on.

    Signals wait for a moment before, too, in the copy of this process that becomes the launcher.
    """
    if "uniaxial" not in Path(f"/proc/{process}/cmdline").read_text():
        return False
    lines = Path(f"/proc/{process}/status").read_text().splitlines()
    mask = next(line.split()[1] for line in lines if line.startswith("SigBlk:"))
    return bool(int(mask, 16) >> (number - 1) & 1)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("delay", [0.0, 0.01, 0.02, 0.04, 0.08])
def test_a_signal_while_python_starts_is_one_line(tmp_path, number, code, delay, launcher):
    """From the first line of the launcher on, to which a busy machine takes its time."""
    steps = tmp_path / "specimen.vtu"  # there before the first step
    command = [*launcher, *ENDLESS, "--out", str(tmp_path)]
    with running(command, stdout=subprocess.PIPE) as process:
        wait_for(lambda: blocks(process.pid, number) or steps.exists(), process, each=0.001)
        time.sleep(delay)  # noqa: TID251 - it still starts, or steps already
        process.send_signal(number)
        errors = process.communicate(timeout=600)[1]
    assert process.returncode == code, errors
    one_line(errors)


@pytest.mark.long
@pytest.mark.parametrize("kind", ["elastic", "specimen rectangle"])
def test_what_a_killed_process_left_is_removed_and_a_second_one_is_refused(tmp_path, kind):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / ".flexpm-specimen-0a1b2c3d.png").write_text("half")
    command = [*COMMAND, *kind.split(), *TINY, "--out", str(tmp_path / "out")]
    surroundings = ENVIRONMENT | {"TMPDIR": str(tmp_path / "tmp")}
    (tmp_path / "tmp").mkdir()
    lock = FolderLock(tmp_path / "out")
    (tmp_path / "out" / ".flexpm-specimen-0a1b2c3d.png").write_text("half")
    refused = subprocess.run(command, env=surroundings, stderr=subprocess.PIPE, text=True)
    assert refused.returncode == 1
    assert "is in use by another process" in one_line(refused.stderr)
    del lock
    assert subprocess.run(command, env=surroundings, stdout=subprocess.DEVNULL).returncode == 0
    assert not [file for file in (tmp_path / "out").iterdir() if file.name.startswith(".flexpm")]


@pytest.mark.long
def test_a_killed_process_leaves_no_temporary_folder_of_yade(tmp_path):
    (tmp_path / "tmp").mkdir()
    surroundings = ENVIRONMENT | {"TMPDIR": str(tmp_path / "tmp")}
    killed = self_signals.command(*RUN, "--out", tmp_path / "out", at_steps=[(100, signal.SIGKILL)])
    assert captured(killed, env=surroundings).returncode == -signal.SIGKILL
    assert not list((tmp_path / "tmp").glob("yade*"))


@pytest.fixture
def heard():
    """Processes that are started here end by SIGHUP, also where the tests themselves ignore it."""
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    signal.signal(signal.SIGHUP, before)


@pytest.mark.long
@pytest.mark.usefixtures("heard")
def test_a_run_whose_terminal_is_closed_saves_its_state(tmp_path):
    hung_up = [*RUN, "--frames", 100, "--out", "out"]
    closed = self_signals.command(*hung_up, at_steps=[(100, signal.SIGHUP)])
    done = captured(closed, env=ENVIRONMENT, cwd=tmp_path)
    assert done.returncode == 129, done.stderr
    assert "terminated" in one_line(done.stderr)
    left = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"checkpoint.json", "checkpoint-100.bin"} <= left
    assert not [name for name in left if name.startswith(".flexpm")]


@pytest.mark.long
def test_a_run_that_ignores_its_terminal_goes_on(tmp_path):
    moments = [(100, signal.SIGHUP), (300, signal.SIGTERM)]
    kept = ["nohup", *self_signals.command(*RUN, "--out", "out", at_steps=moments)]
    done = captured(kept, env=ENVIRONMENT, cwd=tmp_path)
    assert done.returncode == 143, done.stderr
    assert (tmp_path / "out" / "checkpoint-300.bin").exists()


STUCK = """
import ctypes, itertools, os, sys
from flexpm.cli import signals
signals.end_in_time()
signals.catch_signals()
asked = map(ctypes.CDLL(None).kill, [os.getpid()], [int(sys.argv[1])])
sum(itertools.chain(asked, iter(int, 1)))  # never comes back to Python's own loop
"""


@pytest.mark.long
@pytest.mark.usefixtures("heard")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_process_in_a_library_that_loops_is_ended(number):
    """It is asked to end within the loop; nobody else holds its output open."""
    stuck = [sys.executable, "-c", STUCK, str(int(number))]
    assert captured(stuck, env=ENVIRONMENT, timeout=600).returncode == -signal.SIGKILL


def test_a_process_that_has_ended_leaves_nobody_who_watches(tmp_path):
    script = "import os; from flexpm.cli import signals; signals.end_in_time(); print(os.getpid())"
    done = subprocess.run(
        [sys.executable, "-c", script], env=ENVIRONMENT, capture_output=True, timeout=600
    )
    assert done.returncode == 0  # with its output closed, so that the watcher is gone, too


@pytest.mark.parametrize("workers", ["0", "1000000", "20000"])
@pytest.mark.parametrize("kind", ["run", "study"])
def test_more_workers_than_the_machine_can_bear_are_refused(capsys, tmp_path, workers, kind):
    plan = tmp_path / "plan.toml"
    plan.write_text('[common]\ntest = "tension"\nwidth = 0.012\nheight = 0.024\n[grid]\nseed = [1]')
    command = ["run", *SOON, "--seeds", "1-2"] if kind == "run" else ["study", str(plan)]
    out = ["--out", str(tmp_path / "out"), "--workers", workers]
    assert cli.main([*command, *out]) == 2
    assert "workers" in one_line(capsys.readouterr().err)
    assert not list(tmp_path.rglob("result.json"))


@pytest.mark.parametrize("program", [["-P", "-m", "flexpm", "elastic"], ["-c", "import flexpm"]])
@pytest.mark.parametrize("kind", ["bare", "numpy"])
def test_a_python_that_is_not_debians_is_named(tmp_path, program, kind):
    options = [] if kind == "bare" else ["--system-site-packages"]
    subprocess.run(
        ["/usr/bin/python3", "-m", "venv", "--without-pip", *options, tmp_path], check=True
    )
    if kind == "numpy":
        (packages,) = tmp_path.glob("lib/python3*/site-packages")
        for name, file, text in (
            ("numpy", "__init__.py", "raise AttributeError('_ARRAY_API not found')"),
            ("numpy-9.1.0.dist-info", "METADATA", "Metadata-Version: 2.1\nName: numpy"),
        ):
            (packages / name).mkdir()
            (packages / name / file).write_text(text + "\nVersion: 9.1.0\n" * (name != "numpy"))
    # flexpm alone: beside the one that is installed lies all that Debian's Python has
    (tmp_path / "alone").mkdir()
    (tmp_path / "alone" / "flexpm").symlink_to(Path(flexpm.__file__).parent)
    surroundings = ENVIRONMENT | {"PYTHONPATH": str(tmp_path / "alone")}
    if "-c" in program:
        del surroundings["FLEXPM_DEFER"]
    done = captured([tmp_path / "bin" / "python3", *program], env=surroundings)
    assert done.returncode == 1
    line = done.stderr.splitlines()[-1]
    if "-m" in program:
        one_line(done.stderr)
    if kind == "bare":
        assert "use /usr/bin/python3, or a venv with --system-site-packages" in line
    else:
        assert "numpy = 9.1.0 in " in line
        assert "remove it from there" in line
