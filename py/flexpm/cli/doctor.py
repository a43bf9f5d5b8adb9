# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the installation: YADE, the plugin's fit to it, compiler run time, Python packages."""

from __future__ import annotations

import ctypes
import importlib.metadata
import importlib.util
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

from .. import _plugin, _vendor
from ..report.pages.page import CHARTS, TURNING

Check = tuple[str, bool, str]

# module, what to install, what needs it
_PACKAGES = (
    ("numpy", "the package python3-numpy", "specimens and results"),
    ("scipy", "the package python3-scipy", "strength criteria, calibrations"),
    ("click", "the package python3-click", "the command flexpm"),
    ("tqdm", "the package python3-tqdm", "progress bars"),
    ("matplotlib", "the package python3-matplotlib", "pictures"),
    ("vtkmodules", "the package python3-vtk9", "files for ParaView"),
    ("pandas", "the package python3-pandas", "tables of studies"),
    ("distributed", "the package python3-distributed", "studies"),
    ("tomli_w", "the package python3-tomli-w", "calibrated materials"),
    ("jinja2", "the package python3-jinja2", "pages of results"),
    ("dfols", "DFO-LS from PyPI", "calibrations"),
)


def checks() -> Iterator[Check]:
    """Examine the installation, one part after the other.

    Yields:
        Name of the check, whether it passed, and the finding or a remedy in one line.
    """
    yield _python()
    yield from _packages()
    yield from _libraries_of_pages()
    yade, found = _yade()
    yield found
    if yade is None:
        return
    yield _precision(yade)
    module, found = _compiled()
    yield found
    if module is None:
        return
    yield _run_time(module)
    yield from _layouts(module)
    yield _live_scene(yade, module)
    sets = ", ".join(module.instruction_sets())
    yield "instruction set", True, f"{module.instruction_set()} (this machine has {sets})"
    yield _threads()


def _python() -> Check:
    version = ".".join(map(str, sys.version_info[:3]))
    ok = Path(sys.executable).resolve().parent == Path("/usr/bin")  # the one of YADE
    return "python", ok, f"{version} ({sys.executable})" + ("" if ok else "; use /usr/bin/python3")


def _packages() -> Iterator[Check]:
    _vendor.on_path()
    for name, source, purpose in _PACKAGES:
        # found, not imported: some take a second to load
        if importlib.util.find_spec(name) is None:
            yield name, False, f"missing, needed for {purpose}; install {source}"
        else:
            yield name, True, f"{_version(name)} ({purpose})"


def _libraries_of_pages() -> Iterator[Check]:
    for name, files, purpose in (
        ("libjs-chart.js", (CHARTS,), "curves in HTML reports"),
        ("libjs-three", TURNING, "rotatable 3D specimens in HTML reports"),
    ):
        if all(file.is_file() for file in files):
            yield name, True, f"{files[0]} ({purpose})"
        else:
            yield name, False, f"missing, needed for {purpose}; install the package {name}"


def _version(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "installed"  # Debian's VTK carries no version for Python's metadata


def _yade() -> tuple[ModuleType | None, Check]:
    try:
        yade = _plugin.import_yade()
    except ImportError as error:
        return None, ("yade", False, str(error))
    return yade, ("yade", True, f"{yade.config.version} ({yade.config.libDir})")


def _precision(yade: ModuleType) -> Check:
    try:
        _plugin.require_double(yade.config.libDir)
    except ImportError as error:
        return "precision", False, str(error)
    return "precision", True, "double"


def _compiled() -> tuple[ModuleType | None, Check]:
    try:
        module = _plugin.import_plugin()
    except ImportError as error:
        return None, ("plugin", False, str(error))
    info = module.build_info
    text = f"{info['version']} ({module.__file__}, headers of YADE {info['yade_headers']})"
    return module, ("plugin", True, text)


def _run_time(module: ModuleType) -> Check:
    info = module.build_info
    libc = ctypes.CDLL(None)
    libc.gnu_get_libc_version.restype = ctypes.c_char_p
    running = libc.gnu_get_libc_version().decode()
    ok = tuple(map(int, running.split("."))) >= tuple(map(int, info["glibc"].split(".")))
    text = f"{info['compiler']}, glibc {info['glibc']} at build, {running} now"
    return "compiler run time", ok, text if ok else f"{text}; run scripts/setup on this machine"


def _layouts(module: ModuleType) -> Iterator[Check]:
    report = list(module.abi_report())
    for kind, text in (
        ("size", "sizes of classes"),
        ("vtable", "virtual tables"),
        ("attribute", "attribute offsets"),
    ):
        rows = [row for row in report if row[1].split()[0] == kind]
        wrong = [f"{name} ({check}: {detail})" for name, check, ok, detail in rows if not ok]
        if wrong:
            yield text, False, f"{', '.join(wrong)} differ; {_plugin.REMEDY}"
        elif not rows:
            yield text, False, "not examined, an earlier check failed"
        else:
            yield text, True, f"{len(rows)} agree with YADE's libraries"


def _live_scene(yade: ModuleType, module: ModuleType) -> Check:
    name = "forces and energies"
    scene = yade.wrapper.Omega()
    if len(scene.bodies) or scene.iter:
        return name, True, "not examined, a simulation is loaded"
    scene.materials.append(yade.wrapper.FrictMat())
    scene.bodies.append(yade.utils.sphere((0.5, 1.5, 2.5), 1.0))
    scene.trackEnergy = True
    module.abi_add_force(0, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    module.abi_add_energy("probe", 0.25)
    agree = (
        tuple(scene.forces.f(0)) == (1.0, 2.0, 3.0)
        and tuple(scene.forces.t(0)) == (4.0, 5.0, 6.0)
        and scene.energy["probe"] == 0.25
        and [tuple(body[1]) for body in module.abi_scene()["bodies"]] == [(0.5, 1.5, 2.5)]
    )
    scene.reset()
    if agree:
        return name, True, "the plugin and YADE see the same scene"
    return name, False, f"the plugin and YADE see different values; {_plugin.REMEDY}"


def _threads() -> Check:
    return "threads", True, f"{len(os.sched_getaffinity(0))} processors available"
