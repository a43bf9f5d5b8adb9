# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of progress where stderr is no terminal: of all commands that take long."""

from __future__ import annotations

import re
import threading

import pytest
from processes import HUNG, wait_for
from step_clock import step_clock

from flexpm.cli import main as cli
from flexpm.cli import terminal

FLAT = ["--width", "0.016", "--height", "0.032", "--thickness", "0.01"]
#: A line of a loading: steps so far, and the stress as part of the peak.
STEPS = re.compile(
    r"progress after [\d.]+ \w+: (?P<text>.*peak +[\d.]+ MPa, now +-?\d+ % of it), "
    r"(?P<done>\d+) of about (?P<all>\d+) steps, \d+ %"
)


@pytest.fixture(autouse=True)
def _soon(monkeypatch):
    """Each reported state waits until a line has shown it."""
    monkeypatch.setattr(terminal, "LINES_EVERY", 0.001)
    step_clock(monkeypatch.setattr, look=100)
    written, tell, write = threading.Event(), terminal.Progress.__call__, terminal.Progress._line

    def told(progress, *state):
        tell(progress, *state)
        for _ in range(2 * progress._lined):  # the first may have been begun before
            written.clear()
            assert written.wait(HUNG)

    def line(progress):
        made = write(progress)
        written.set()
        return made

    monkeypatch.setattr(terminal.Progress, "__call__", told)
    monkeypatch.setattr(terminal.Progress, "_line", line)


def told(capsys):
    return [one for one in capsys.readouterr().err.splitlines() if one.startswith("progress")]


@pytest.mark.parametrize(
    ("command", "start"),
    [(["run", "tension"], "peak"), (["compare", "uniaxial", "--rate", "8"], "1/2 flexible: peak")],
)
def test_a_loading_tells_its_steps_and_its_part_of_the_peak(command, start, tmp_path, capsys):
    assert cli.main([*command, *FLAT, "--no-report", "--out", str(tmp_path)]) == 0
    found = [match for one in told(capsys) if (match := STEPS.fullmatch(one))]
    assert found and any(one["text"].startswith(start) for one in found)
    done = [int(one["done"]) for one in found if one["text"].startswith(start)]
    assert done == sorted(done) and all(int(one["done"]) <= int(one["all"]) for one in found)


def test_a_packing_tells_its_steps(tmp_path, capsys):
    size = ["--width", "0.06", "--height", "0.12", "--thickness", "0.01"]
    assert cli.main(["specimen", "rectangle", *size, "--out", str(tmp_path)]) == 0
    assert any(": packing, " in one for one in told(capsys))


def test_a_quiet_command_tells_none(tmp_path, capsys):
    assert cli.main(["run", "tension", *FLAT, "--quiet", "--out", str(tmp_path)]) == 0
    assert told(capsys) == []


def test_what_reports_seldom_is_told_all_the_same(capsys):
    lines = []

    def waited_for(ending: str, times: int) -> None:
        def there() -> bool:
            lines.extend(told(capsys))
            return sum(one.endswith(ending) for one in lines) >= times

        wait_for(there, each=0.001)

    with terminal.Progress(unit="sets") as progress:
        waited_for(": working", 1)
        progress(3, 16, "calibrating")
        waited_for(": calibrating, 3 of about 16 sets, 19 %", 2)


def test_no_line_comes_after_the_end(capsys, monkeypatch):
    begun, write = threading.Event(), terminal.Progress._line

    def slow(progress):
        begun.set()
        progress._over.wait(HUNG)  # the end comes while a line is being made
        return write(progress)

    monkeypatch.setattr(terminal.Progress, "_line", slow)
    with terminal.Progress() as progress:
        join = progress._writer.join
        monkeypatch.setattr(progress._writer, "join", lambda timeout: join(HUNG))
        assert begun.wait(HUNG)
    assert told(capsys)
    assert not progress._writer.is_alive()
