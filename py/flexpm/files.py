# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: output is complete or absent, input is read up to a largest size.

Plain files are written under a temporary name, then renamed. A folder that a process writes to for
long is locked, so that no second process does the same.
"""

from __future__ import annotations

import contextlib
import csv
import errno
import fcntl
import io
import json
import math
import os
import secrets
import shutil
import stat
import sys
import tempfile
import tomllib
import weakref
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NoReturn

from .errors import BusyError, InputError

#: A table of a TOML or JSON file: values, lists and tables.
Table = dict[str, Any]

#: Size of the largest file of inputs, and of the largest table or state of a run [byte].
_LARGEST, _LARGEST_TABLE = 64 * 10**6, 10**9
#: Bytes that are read at a time.
_CHUNK = 2**20
#: Begins the name of each temporary file.
_TEMPORARY = ".flexpm-"
#: Rights of a new file, less the user's umask; ``mkstemp`` makes files for the owner alone.
_MODE = 0o666
_LOCK = ".flexpm.lock"
#: Errors of a disk or a machine that is full or broken, not of what the user has named.
DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.ENFILE, errno.EMFILE)
#: Errors of file systems that have no locks; runs there go on without.
_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)


@contextlib.contextmanager
def whole_file(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path; the written content replaces `path` if the block succeeds.

    The temporary name keeps the suffix of `path`, since some writers choose the format by it.
    A plain file is replaced, at the end of links that lead to it: a reader never sees a part of it,
    also when the process is killed while it writes. Devices and pipes are written into.

    Args:
        path: Name of the file; its folder must exist.

    Raises:
        InputError: if it is a socket.
        OSError: if it is a folder, or cannot be written.
    """
    path = Path(path)
    target = _replaced(path)
    temporary = _beside(target or Path(tempfile.gettempdir(), path.name))
    try:  # the file is made within: a signal may come as soon as it is there
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, _MODE))
        yield temporary
        if target is None:
            _pour(temporary, path)
        else:
            with temporary.open("rb") as written:
                os.fsync(written.fileno())
            temporary.replace(target)
    except OSError as error:
        if error.filename is not None or error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error  # a full disk, by name
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def _replaced(path: Path) -> Path | None:
    """Return the plain file, existing or new, to which `path` leads; None if it is not plain."""
    try:
        found = path.stat()
    except FileNotFoundError:
        found = None
    if found is None or (stat.S_ISREG(found.st_mode) and _stream_of(found) is None):
        return Path(os.path.realpath(path)) if path.is_symlink() else path
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, "is a folder, must be a file", str(path))
    if stat.S_ISSOCK(found.st_mode) and _stream_of(found) is None:
        raise InputError(
            f"file = {str(path)!r}, is a socket, must be a file, a device or a pipe; choose "
            "another path"
        )
    return None


def _stream_of(found: os.stat_result) -> int | None:
    """Return standard output or error if a path leads to it; writing continues at its position."""
    for number in (1, 2):
        with contextlib.suppress(OSError):
            if os.path.samestat(os.fstat(number), found):
                return number
    return None


def _pour(temporary: Path, path: Path) -> None:
    """Write a file into a device, a pipe or a stream of this process."""
    stream = _stream_of(path.stat())
    if stream is None:
        handle = os.open(path, os.O_WRONLY | os.O_NOCTTY)
    else:
        (sys.stdout if stream == 1 else sys.stderr).flush()
        handle = os.dup(stream)
    with temporary.open("rb") as written, os.fdopen(handle, "wb") as into:
        shutil.copyfileobj(written, into)


def remove_earlier(path: Path | str) -> None:
    """Remove a file of an earlier run; only plain files are removed."""
    if Path(path).is_file():
        Path(path).unlink(missing_ok=True)


def require_writable(path: Path) -> bool:
    """Check that a file can be written before the work begins; return whether it is a plain file.

    Raises:
        InputError: if it is a socket, or its folder does not accept a file.
        OSError: if it is a folder.
    """
    target = _replaced(path)
    if target is not None:
        output_folder(target.parent)
    return target is not None


def write_parts(path: Path | str, parts: Iterable[bytes | memoryview]) -> None:
    """Write a file part by part, completely or not at all; each part is made when it is due."""
    with whole_file(path) as temporary, temporary.open("wb") as file:
        file.writelines(parts)


@contextlib.contextmanager
def scratch_beside(path: Path | str) -> Iterator[Path]:
    """Yield the name of a temporary file next to `path`, which is removed after the block."""
    path = Path(path)
    target = _replaced(path)
    scratch = _beside(target or Path(tempfile.gettempdir(), path.name))
    try:
        yield scratch
    finally:
        with contextlib.suppress(OSError):
            scratch.unlink()


def require_room(path: Path, size: int) -> None:
    """Ask the disk for room for a file that a library is about to write.

    Args:
        path: The file.
        size: Its largest size [byte], > 0.

    Raises:
        OSError: if the disk, a quota or a limit of the process refuses it.
    """
    handle = os.open(path, os.O_CREAT | os.O_WRONLY, _MODE)
    try:
        os.posix_fallocate(handle, 0, size)
    finally:
        os.close(handle)


def lines_of(path: Path, longest: int) -> Iterator[bytes]:
    """Yield the lines of a file; longer lines in parts of `longest` bytes."""
    with path.open("rb") as file:
        while line := file.readline(longest):
            yield line


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
        names: Names of the columns.
        rows: Cells in the order of the columns; None makes an empty cell.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
    return text.getvalue()


def read_bytes(path: Path, largest: int = _LARGEST_TABLE) -> bytes:
    """Content of a file, which is read no further than its largest size.

    Args:
        path: The file; also a device or a pipe.
        largest: Its largest size [byte].

    Raises:
        OSError: if it cannot be read.
        ValueError: if it is larger, or its name can be none.
    """
    content = bytearray()
    with path.open("rb") as file:
        while len(content) <= largest and (chunk := file.read(_CHUNK)):
            content += chunk
    if len(content) > largest:
        raise ValueError(f"it is larger than {largest // 10**6} MB")
    return bytes(content)


def read_text(path: Path, largest: int = _LARGEST) -> str:
    """Text of a file, as ``read_bytes`` and ``text_of``.

    Raises:
        OSError: if it cannot be read.
        ValueError: if it is larger, no UTF-8, or its name can be none.
    """
    return text_of(read_bytes(path, largest))


def text_of(content: bytes) -> str:
    """Text of a file that any program on any system has written.

    A byte-order mark is removed, and each line ends with a new line alone.

    Raises:
        ValueError: if it is no UTF-8.
    """
    return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def csv_rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the line number and the cells of each row of a table, without blanks around cells.

    Rows without any content, with which spreadsheets end their tables, are left out.

    Raises:
        csv.Error: if it is no table.
    """
    reader = csv.reader(io.StringIO(text, newline=""), skipinitialspace=True)
    for row in reader:
        cells = [cell.strip() for cell in row]
        if any(cells):
            yield reader.line_num, cells


def read_json(path: Path) -> Any:
    """Content of a JSON file; its numbers are finite.

    Raises:
        OSError: if it cannot be read.
        ValueError, RecursionError: if it is no JSON.
    """
    return json.loads(read_text(path), parse_constant=_refuse_constant, parse_float=_finite)


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is not a finite number")


def _finite(text: str) -> float:
    number = float(text)
    return number if math.isfinite(number) else _refuse_constant(text)


def load_toml(path: Path, what: str) -> Table:
    """Read a TOML file.

    Args:
        path: The file.
        what: Type of the file, for messages.

    Raises:
        InputError: if it cannot be read or is not valid TOML.
    """
    try:
        return tomllib.loads(read_text(path))
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a TOML file"
        ) from None
    except RecursionError:
        raise InputError(
            f"{what} = {str(path)!r}, is nested too deeply; use fewer levels of tables"
        ) from None
    except ValueError as error:  # of TOML, of UTF-8, of a number or of a name
        raise InputError(
            f"{what} = {str(path)!r}, is not a valid TOML file: {error}; correct the file"
        ) from None


def load_csv(path: Path, what: str) -> tuple[list[str], list[list[str]]]:
    """Read a table with a header: names of the columns and rows of text.

    Raises:
        InputError: if it cannot be read or a row has another length than the header.
    """
    try:
        lines = [cells for _, cells in csv_rows(read_text(path, _LARGEST_TABLE))]
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a file of flexpm"
        ) from None
    except (ValueError, csv.Error) as error:
        raise InputError(
            f"{what} = {str(path)!r}, is not a CSV table: {error}; give a file of flexpm"
        ) from None
    if not lines or any(len(line) != len(lines[0]) for line in lines):
        raise InputError(
            f"{what} = {str(path)!r}, must have rows as long as its header; give a complete file"
        )
    if len({*lines[0]}) < len(lines[0]):
        raise InputError(
            f"{what} = {str(path)!r}, must have columns of different names; rename a column"
        )
    return lines[0], lines[1:]


def load_json(path: Path, what: str) -> Table:
    """Read a JSON file with a table of finite numbers.

    Args:
        path: The file.
        what: Type of the file, for messages.

    Raises:
        InputError: if it cannot be read or has other content.
    """
    reason = ""
    try:
        content = read_json(path)
    except OSError as error:
        raise InputError(
            f"{what} = {str(path)!r}, cannot be read ({error.strerror}); give a file of flexpm"
        ) from None
    except (ValueError, RecursionError) as error:
        content, reason = None, f" ({error})"
    if not isinstance(content, dict):
        raise InputError(
            f"{what} = {str(path)!r}, is not a JSON table{reason}; give a file of flexpm"
        )
    return content


def output_folder(path: Path | str) -> Path:
    """Make the folder `path` if it does not exist and check that files can be written there.

    Raises:
        InputError: if it cannot be made, is not a folder, or does not accept a file.
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
                f"out = {str(folder)!r}, contains a folder {name}, must not: a file of this name "
                "is written there; choose another folder"
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
        """Unlock the folder for other processes, even if this process still refers to the lock."""
        self._held.pop(self._place, None)
        if self._finalizer is not None:
            self._finalizer()


def _locked(file: Path, folder: Path) -> int | None:
    """Open and lock a file; None if the file system cannot."""
    while True:
        handle = os.open(file, os.O_RDWR | os.O_CREAT, _MODE)
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


def _beside(path: Path) -> Path:
    """Return an unused name next to `path`."""
    return path.with_name(f"{_TEMPORARY}{path.stem}-{secrets.token_hex(8)}{path.suffix}")
