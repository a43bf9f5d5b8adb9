# SPDX-License-Identifier: GPL-3.0-or-later
"""The schema of result.json as the documentation makes it, for tests of what runs write."""

from __future__ import annotations

import functools
import sys
from pathlib import Path

import pytest

EXTENSIONS = Path(__file__).resolve().parents[2] / "doc" / "extensions"


@functools.cache
def schema() -> dict:
    """The schema; a test is skipped where sphinx is not installed."""
    pytest.importorskip("sphinx", reason="needs python3-sphinx")
    sys.path.insert(0, str(EXTENSIONS))
    try:
        import result_schema
    finally:
        sys.path.remove(str(EXTENSIONS))
    return result_schema.made()


def validator():
    """What compares a result with the schema."""
    jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")
    jsonschema.Draft202012Validator.check_schema(schema())
    return jsonschema.Draft202012Validator(schema())
