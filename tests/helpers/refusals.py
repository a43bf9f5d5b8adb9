# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls and commands that are refused: the one line that says why."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest

from flexpm.cli import main as cli
from flexpm.errors import InputError, SimulationError


def refusal(words: str, call: Callable[..., Any], *arguments: Any, **options: Any) -> str:
    """Line with which a call refuses its input: it has `words`, as a text or as a pattern."""
    return line_of(InputError, words, lambda: call(*arguments, **options))


def failure(words: str, call: Callable[..., Any], *arguments: Any, **options: Any) -> str:
    """Line with which a simulation fails: it has `words`, as a text or as a pattern."""
    return line_of(SimulationError, words, lambda: call(*arguments, **options))


def line_of(kind: type[Exception], words: str, call: Callable[[], Any]) -> str:
    """Text of the error that a call raises, which must be one line with these words."""
    with pytest.raises(kind) as caught:
        call()
    line = str(caught.value)
    assert "\n" not in line
    assert words in line or re.search(words, line), line
    return line


def refused_command(capsys: pytest.CaptureFixture[str], words: str, *command: Any) -> str:
    """Line with which the command flexpm refuses its arguments, with exit code 2."""
    assert cli.main([str(word) for word in command]) == 2
    line = capsys.readouterr().err
    assert line.count("\n") == 1, line
    assert words in line or re.search(words, line), line
    return line
