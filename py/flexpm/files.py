# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: output is whole or absent, written under a temporary name, then renamed; TOML input.

A folder that a process writes to for long is locked, so that no second one does the same.
"""

from __future__ import annotations

import contextlib
import csv
import errno
import fcntl
import io
import json
import os
import secrets
import tempfile
import tomllib
import weakref
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from .errors import BusyError, InputError

#: A table of a TOML or JSON file: values, lists and tables.
Table = dict[str, Any]

#: Size of the largest TOML file [byte].
_LARGEST_TOML = 10**7
#: Begins the name of each temporary file.
_TEMPORARY = ".flexpm-"
_LOCK = ".flexpm.lock"
#: Errors of a disk or a machine that is full or broken, not of what the user has named.
DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.ENFILE, errno.EMFILE)
#: Errors of file systems that have no locks; runs there go on without.
_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)


@contextlib.contextmanager
def whole_file(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path beside `path`; rename it to `path` if the block succeeds.

    The temporary name keeps the suffix of `path`, since some writers choose the format by it.
    A reader never sees a part of a file, also when the process is killed while it writes.

    Args:
        path: Final name of the file; its folder must exist.
    """
    path = Path(path)
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a folder, must be a file", str(path))
    temporary = _new_file(path)
    try:
        yield temporary
        with temporary.open("rb") as written:
            os.fsync(written.fileno())
        temporary.replace(path)
    except OSError as error:
        if error.filename is not None or error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error  # a full disk, by name
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
            content = file.read(_LARGEST_TOML + 1)
        if len(content) > _LARGEST_TOML:
            raise ValueError(f"it is larger than {_LARGEST_TOML // 10**6} MB")
        return tomllib.loads(content.decode())
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a TOML file"
        ) from None
    except RecursionError:
        raise InputError(f"{what} = {str(path)!r}, is nested too deeply") from None
    except ValueError as error:  # of TOML, of UTF-8, of a number or of a name
        raise InputError(f"{what} = {str(path)!r}, is no valid TOML file: {error}") from None


def load_csv(path: Path, what: str) -> tuple[list[str], list[list[str]]]:
    """Read a table with a header: names of the columns and rows of text.

    Raises:
        InputError: if it cannot be read or a row has another length than the header.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            lines = list(csv.reader(file))
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a file of flexpm"
        ) from None
    except (ValueError, csv.Error) as error:
        raise InputError(f"{what} = {str(path)!r}, is no table: {error}") from None
    if not lines or any(len(line) != len(lines[0]) for line in lines):
        raise InputError(f"{what} = {str(path)!r}, must have rows as long as its header")
    return lines[0], lines[1:]


def load_json(path: Path, what: str) -> Table:
    """Read a JSON file that holds a table.

    Args:
        path: The file.
        what: What it is, for messages.

    Raises:
        InputError: if it cannot be read or holds something else.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a file of flexpm"
        ) from None
    except (ValueError, RecursionError):
        content = None
    if not isinstance(content, dict):
        raise InputError(f"{what} = {str(path)!r}, is no JSON table; give a file of flexpm")
    return content


def output_folder(path: Path | str) -> Path:
    """Make the folder `path` if it does not exist and check that files can be written there.

    Raises:
        InputError: if it cannot be made, is no folder, or refuses a file.
    """
    path = Path(path)
    try:
        str(path).encode()  # other libraries take names as text only
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        if error.errno in DISK_ERRORS:
            raise
        raise InputError(
            f"out = {str(path)!r}, must be a folder that can be written to "
            f"({error.strerror}); choose another folder"
        ) from None
    except ValueError:
        raise InputError(
            f"out = {str(path)!r}, must be a name of valid characters; choose another folder"
        ) from None
    return path


def refuse_folders(folder: Path, names: Iterable[str]) -> None:
    """Raise InputError if a folder lies where a file will be written, before the work is done."""
    for name in names:
        if (folder / name).is_dir():
            raise InputError(
                f"out = {str(folder)!r}, holds a folder {name}, must be free for the file of this "
                "name; choose another folder"
            )


class FolderLock:
    """Keeps other processes out of a folder as long as it lives.

    The lock is the kernel's (flock): it ends with the process, however that ends. Within one
    process a folder can be locked several times. Temporary files that are found in the folder have
    been left by dead processes and are removed.
    """

    _held: weakref.WeakValueDictionary[Path, FolderLock] = weakref.WeakValueDictionary()
    _place: Path
    _finalizer: Callable[[], object] | None

    def __new__(cls, folder: Path) -> FolderLock:
        """Lock `folder`, which exists, or take the lock that this process has.

        Raises:
            BusyError: if another process has it.
        """
        place = folder.resolve()
        held = cls._held.get(place)
        if held is not None:
            return held
        made = super().__new__(cls)
        made._place = place
        handle = _locked(place / _LOCK, folder)
        made._finalizer = None
        if handle is not None:
            finalizer = weakref.finalize(made, _unlock, place / _LOCK, handle, os.getpid())
            made._finalizer = finalizer
        for left in place.glob(f"{_TEMPORARY}*"):
            with contextlib.suppress(OSError):
                left.unlink()
        cls._held[place] = made
        return made

    def release(self) -> None:
        """Let other processes in, whatever still refers to the lock in this one."""
        self._held.pop(self._place, None)
        if self._finalizer is not None:
            self._finalizer()


def _locked(file: Path, folder: Path) -> int | None:
    """Open and lock a file; None if the file system cannot."""
    while True:
        handle = os.open(file, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            # the one who had it may have removed the file in the meantime
            if file.stat().st_ino == os.fstat(handle).st_ino:
                return handle
        except BlockingIOError:
            os.close(handle)
            raise BusyError(
                f"out = {str(folder)!r}, is in use by another process of flexpm; wait for its end "
                "or choose another folder"
            ) from None
        except OSError as error:
            os.close(handle)
            if error.errno in _NO_LOCKS:
                file.unlink(missing_ok=True)
                return None
            if isinstance(error, FileNotFoundError):
                continue
            raise
        os.close(handle)


def _unlock(file: Path, handle: int, owner: int) -> None:
    if os.getpid() == owner:  # not in a child that has inherited it
        with contextlib.suppress(OSError):
            file.unlink()  # while it is locked: nobody else can have the same file
        os.close(handle)


def _new_file(path: Path) -> Path:
    """Make an empty file beside `path`, readable for those that the user's umask allows.

    ``mkstemp`` makes files for the owner alone, and the umask can only be asked for by changing it,
    which other threads would notice.
    """
    while True:
        name = f"{_TEMPORARY}{path.stem}-{secrets.token_hex(4)}{path.suffix}"
        with contextlib.suppress(FileExistsError):
            os.close(os.open(path.with_name(name), os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            return path.with_name(name)
