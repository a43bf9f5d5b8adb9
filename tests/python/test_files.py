# SPDX-License-Identifier: GPL-3.0-or-later
"""Files are for those whom the umask allows, whole or absent."""

from __future__ import annotations

import os
import socket
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from refusals import refusal

import flexpm
from flexpm import files
from flexpm.files import (
    load_csv,
    load_json,
    load_toml,
    remove_earlier,
    require_writable,
    whole_file,
    write_text,
)
from flexpm.rigs.stages.history import history_of

ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": str(Path(flexpm.__file__).parent.parent),
    "FLEXPM_DEFER": "1",
}


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_a_file_is_for_those_whom_the_umask_allows(tmp_path, mask, monkeypatch):
    before = os.umask(mask)
    with monkeypatch.context() as held:
        held.setattr(os, "umask", None)  # nobody may change it, not for a moment
        write_text(tmp_path / "it.csv", "1\n")
    os.umask(before)
    assert stat.S_IMODE((tmp_path / "it.csv").stat().st_mode) == 0o666 & ~mask


def test_a_file_that_failed_leaves_the_one_before_and_nothing_else(tmp_path):
    write_text(tmp_path / "it.csv", "1\n")
    with pytest.raises(ZeroDivisionError), whole_file(tmp_path / "it.csv") as temporary:
        temporary.write_text("2")
        raise ZeroDivisionError
    assert [file.name for file in tmp_path.iterdir()] == ["it.csv"]
    assert (tmp_path / "it.csv").read_text() == "1\n"


def test_a_link_to_a_file_writes_the_file_behind_it(tmp_path):
    behind, link = tmp_path / "behind.csv", tmp_path / "link.csv"
    for name in (behind, tmp_path / "new.csv"):  # there, and not yet
        link.unlink(missing_ok=True)
        link.symlink_to(name)
        write_text(link, "1\n")
        assert link.is_symlink()
        assert name.read_text() == "1\n"


def test_a_device_is_written_into_and_stays_one(tmp_path):
    (tmp_path / "null").symlink_to("/dev/null")
    write_text(tmp_path / "null", "1\n")
    remove_earlier(tmp_path / "null")
    assert (tmp_path / "null").is_symlink()  # else the next lines would replace the device
    write_text("/dev/null", "1\n")
    remove_earlier("/dev/null")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)
    with pytest.raises(OSError, match="No space left on device: '/dev/full'"):
        write_text("/dev/full", "1\n")


def test_a_pipe_is_written_into(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    reader = os.open(tmp_path / "pipe", os.O_RDONLY | os.O_NONBLOCK)
    write_text(tmp_path / "pipe", "1\n")
    assert os.read(reader, 9) == b"1\n"
    os.close(reader)
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)


def test_what_is_no_file_is_refused(tmp_path):
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(tmp_path / "socket"))
        for check in (require_writable, lambda path: write_text(path, "1\n")):
            refusal("is a socket, must be a file", check, tmp_path / "socket")
            with pytest.raises(IsADirectoryError, match="is a folder"):
                check(tmp_path)
    assert stat.S_ISSOCK((tmp_path / "socket").stat().st_mode)


@pytest.mark.parametrize("kind", ["file", "pipe"])
def test_standard_output_is_written_into_where_it_stands(tmp_path, kind):
    """`--json /dev/stdout > log` must neither tear the log off nor write over it."""
    script = (
        "from flexpm.files import write_text; print('before', flush=True)\n"
        "write_text('/dev/stdout', 'it\\n'); print('after')"
    )
    command = [sys.executable, "-c", script]
    with (tmp_path / "log").open("wb") as log:
        into = log if kind == "file" else subprocess.PIPE
        done = subprocess.run(command, env=ENVIRONMENT, stdout=into, check=True)
    said = (tmp_path / "log").read_bytes() if kind == "file" else done.stdout
    assert said == b"before\nit\nafter\n"


@pytest.mark.parametrize("read", [load_toml, load_json, load_csv])
@pytest.mark.parametrize("name", ["/dev/zero", "endless", "a\0b", "\ud800"])
def test_a_file_is_read_no_further_than_the_largest(tmp_path, read, name, monkeypatch):
    if name == "endless":
        name = tmp_path / name
        with name.open("wb") as file:
            file.truncate(files._LARGEST + 1)
    monkeypatch.setattr(files, "_LARGEST_TABLE", files._LARGEST)
    refusal("it = ", read, Path(name), "it")  # or it never ends


@pytest.mark.parametrize("name", ["/dev/zero", "a\0b", "\ud800"])
@pytest.mark.parametrize(
    "read",
    [
        lambda name: history_of(name, None, "N"),
        lambda name: flexpm.Specimen.from_spheres(name, diameter=0.01, height=0.02),
        lambda name: flexpm.Specimen.load_solid(name),
    ],
    ids=["history", "spheres", "solid"],
)
def test_other_readers_have_the_same_limit(read, name):
    refusal("", read, name)


@pytest.mark.parametrize("text", ['{"x": NaN}', '{"x": -Infinity}', '{"x": 1e999}', "[1]", "{"])
def test_a_json_table_has_finite_numbers(tmp_path, text):
    (tmp_path / "it.json").write_text(text)
    refusal("is not a JSON table", load_json, tmp_path / "it.json", "it")
