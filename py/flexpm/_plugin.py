# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads YADE and the plugin's classes, silently, after checking that their layouts agree."""

from __future__ import annotations

import atexit
import contextlib
import importlib.util
import io
import os
import pwd
import re
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path
from types import ModuleType

_PRECISION = "yade-double"
#: Where Debian has the packages of Python.
_DEBIAN = Path("/usr/lib/python3/dist-packages")
_WAITING = "OMP_WAIT_POLICY"
REMEDY = "rebuild flexpm against the installed YADE (scripts/setup)"

_classes: list[str] | None = None


def load() -> list[str]:
    """Load the plugin into YADE; a second call does nothing.

    Returns:
        Names of the plugin's classes, which are then attributes of ``yade`` and ``yade.wrapper``.

    Raises:
        ImportError: if YADE is missing, of another precision, or laid out differently.
    """
    global _classes
    if _classes is None:
        yade = import_yade()
        require_double(yade.config.libDir)
        module = import_plugin()
        require_same_layout(module.abi_report())
        _classes = _register(yade, module)
    return list(_classes)


def import_yade() -> ModuleType:
    """Import YADE as a Python module, without its greeting.

    Returns:
        The package ``yade``.

    Raises:
        ImportError: if it is not installed.
    """
    if "yade" in sys.modules:
        return sys.modules["yade"]
    require_debian()
    _give_home()
    folder = str(yade_folder() / "py")
    if folder not in sys.path:
        sys.path.append(folder)
    try:
        with contextlib.redirect_stdout(io.StringIO()), _patient_threads(), _number_of_ipython():
            import yade
    except ImportError as error:
        raise ImportError(
            f"flexpm: YADE cannot be imported from {folder} ({error}); install the package yade"
        ) from error
    # The program yade removes its temporary folder itself; plain Python needs this.
    atexit.register(yade.boot.finalize)
    return yade


@contextlib.contextmanager
def _patient_threads() -> Iterator[None]:
    """Let threads of OpenMP, which is loaded now, sleep while they wait.

    Else they keep the cores that those need for which they wait. Settings of the user are kept.
    """
    if _WAITING in os.environ:
        yield
        return
    os.environ[_WAITING] = "passive"
    try:
        yield
    finally:
        del os.environ[_WAITING]  # programs that are started from here have their own


@contextlib.contextmanager
def _number_of_ipython() -> Iterator[None]:
    """Let YADE see the version of IPython alone, which is all that it asks for.

    Its interactive program uses the rest. To import that takes a third of the time that YADE takes.
    """
    name = "IPython"
    if name in sys.modules or importlib.util.find_spec(name) is None:
        yield
        return
    number = sys.modules[name] = ModuleType(name)
    vars(number)["__version__"] = metadata.version(name)
    try:
        yield
    finally:
        del sys.modules[name]  # who imports it later gets all of it


def require_debian() -> None:
    """Check that this Python is Debian's, for which YADE is built, and sees its packages.

    Raises:
        ImportError: if it is another one, or a numpy of its own hides Debian's.
    """
    if not yade_folder().is_dir():
        return  # nothing is installed, which the import says
    if Path(sys.base_prefix) != Path("/usr") or _DEBIAN not in map(Path, sys.path):
        raise ImportError(
            f"flexpm: python = {sys.executable} ({sys.version.split()[0]}), must be Debian's, "
            "which sees its packages; use /usr/bin/python3, or a venv with --system-site-packages"
        )
    known = {one.version for one in metadata.distributions(name="numpy", path=[str(_DEBIAN)])}
    first = next(iter(metadata.distributions(name="numpy")), None)
    if first is None or not known or first.version in known:
        return
    theirs = known.pop()
    # other packages of Debian are built for its numpy and later ones of the same number
    if _numbers(first.version)[0] != _numbers(theirs)[0] or (
        _numbers(first.version) < _numbers(theirs)
    ):
        raise ImportError(
            f"flexpm: numpy = {first.version} in {first.locate_file('')}, must be Debian's "
            f"{theirs}, for which YADE and scipy are built; remove it from there"
        )


def _numbers(version: str) -> list[int]:
    return [int(part) for part in re.findall(r"[0-9]+", version)[:2]]


def _give_home() -> None:
    """Set HOME, which YADE needs and services (cron, systemd) may not have."""
    if not os.environ.get("HOME"):
        home = str(Path("~").expanduser()) if _is_known_user() else tempfile.gettempdir()
        os.environ["HOME"] = home


def _is_known_user() -> bool:
    try:
        pwd.getpwuid(os.getuid())
    except KeyError:
        return False
    return True


def yade_folder() -> Path:
    """Return the library folder of the double-precision YADE of this architecture."""
    return Path("/usr/lib") / (sysconfig.get_config_var("MULTIARCH") or "") / _PRECISION


def require_double(library_folder: str) -> None:
    """Check that YADE computes in double precision: other builds have other class layouts.

    Args:
        library_folder: ``yade.config.libDir`` of the running YADE.

    Raises:
        ImportError: if it is another build.
    """
    if not library_folder.endswith(_PRECISION):
        raise ImportError(
            f"flexpm: YADE library folder = {library_folder}, must end in {_PRECISION}; "
            "start the double-precision program (yade)"
        )


def require_same_layout(report: list[tuple[str, str, bool, str]]) -> None:
    """Check that each class of YADE is laid out as in the headers of the build.

    Args:
        report: Rows (class, check, ok, detail) of ``_flexpm.abi_report()``.

    Raises:
        ImportError: naming the first class that differs.
    """
    for name, check, ok, detail in report:
        if not ok:
            raise ImportError(f"flexpm: YADE class {name}: {check} differs: {detail}; {REMEDY}")


def import_plugin() -> ModuleType:
    """Import the compiled module; YADE must be imported before.

    Returns:
        The module ``flexpm._flexpm``, its classes not yet registered.

    Raises:
        ImportError: if it is not built or does not fit YADE's libraries.
    """
    try:
        import flexpm._flexpm as module
    except ImportError as error:
        if isinstance(error, ModuleNotFoundError):
            raise ImportError("flexpm: _flexpm is not built; run scripts/setup") from error
        raise ImportError(f"flexpm: _flexpm does not fit YADE ({error}); {REMEDY}") from error
    return module


def _register(yade: ModuleType, module: ModuleType) -> list[str]:
    names = list(module.register_classes())
    for name in names:
        setattr(yade, name, getattr(yade.wrapper, name))
    exported: list[str] = vars(yade)["__all__"]  # of scripts that take all names of YADE
    exported += [name for name in names if name not in exported]
    if names and "yade.qt" in sys.modules:
        # The 3D window exists before scripts run; it must learn about shapes that came later.
        module.refresh_renderer(sys.modules["yade.qt"].Renderer())
    return names
