# SPDX-License-Identifier: GPL-3.0-or-later
"""How often a run is saved: at its interval, or less often where a checkpoint takes long."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from flexpm.runs import checkpoint  # isort: skip  (first: it makes YADE importable)
import yade

SPEC = SimpleNamespace(results=1, to_json=lambda: {"specimen": {}, "material": {}})


@pytest.mark.parametrize(("takes", "pause"), [(0.4, 30.0), (2.0, 30.0), (11.0, 200.0)])
def test_what_takes_long_to_save_is_saved_less_often(tmp_path, monkeypatch, takes, pause):
    now = [1000.0]
    clock = SimpleNamespace(monotonic=lambda: now[0])
    monkeypatch.setattr(checkpoint, "time", clock)  # its own: a save takes time
    checksum = checkpoint._checksum

    def slow(*given):
        now[0] += takes
        return checksum(*given)

    monkeypatch.setattr(checkpoint, "_checksum", slow)
    yade.O.reset()
    kept = checkpoint.Checkpoint(tmp_path, SPEC)
    try:
        now[0] += 30.5
        assert kept.due
        kept.save()
        now[0] += pause - 0.5
        assert not kept.due
        now[0] += 1.0
        assert kept.due
    finally:
        kept.release()
