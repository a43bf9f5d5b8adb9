# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: output is whole or absent, written under a temporary name, then renamed; TOML input."""

from __future__ import annotations

import contextlib
import csv
import io
import json
import os
import tempfile
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from .errors import InputError

#: A table of a TOML or JSON file: values, lists and tables.
Table = dict[str, Any]


@contextlib.contextmanager
def whole_file(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path beside `path`; rename it to `path` if the block succeeds.

    The temporary name keeps the suffix of `path`, since some writers choose the format by it.
    A reader never sees a part of a file, also when the process is killed while it writes.

    Args:
        path: Final name of the file; its folder must exist.
    """
    path = Path(path)
    handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        with temporary.open("rb") as written:
            os.fsync(written.fileno())
        temporary.chmod(0o666 & ~_umask())  # mkstemp makes files that only the owner can read
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path | str, text: str) -> None:
    """Write `text` as UTF-8 with Unix line ends, whole or not at all."""
    with whole_file(path) as temporary:
        temporary.write_bytes(text.encode("utf-8"))


def json_text(content: object) -> str:
    """`content` as readable JSON that ends with a new line; only finite numbers are allowed."""
    return json.dumps(content, indent=2, allow_nan=False) + "\n"


def csv_text(names: Iterable[str], rows: Iterable[Sequence[object]]) -> str:
    """A table as CSV text, numbers so that they read back unchanged.

    Args:
        names: Of the columns.
        rows: Cells in the order of the columns; None makes an empty cell.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
    return text.getvalue()


def load_toml(path: Path, what: str) -> Table:
    """Read a TOML file.

    Args:
        path: The file.
        what: What it is, for messages.

    Raises:
        InputError: if it cannot be read or is no valid TOML.
    """
    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a TOML file"
        ) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{what} = {str(path)!r}, is no valid TOML file: {error}") from None


def output_folder(path: Path | str) -> Path:
    """Make the folder `path` if it does not exist and check that files can be written there.

    Raises:
        InputError: if it cannot be made, is no folder, or refuses a file.
    """
    path = Path(path)
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        raise InputError(
            f"out = {str(path)!r}, must be a folder that can be written to "
            f"({error.strerror}); choose another folder"
        ) from None
    return path


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
