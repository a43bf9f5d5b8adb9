# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the result of a run: numbers, record, cracks, state and figures."""

from __future__ import annotations

from pathlib import Path

from .._version import __version__
from ..files import Table, remove_earlier
from ..kinds.registry import OWN, kind_of
from ..kinds.test_kind import Rig
from ..report.curves import curve_picture, wave_picture
from ..report.emission import emission_picture
from ..report.maps import crack_picture, fragment_picture
from ..report.outside import draw_solid
from ..report.pages.page import FILE as REPORT
from ..report.tables import size_text
from ..results.result import Result
from ..results.result_checks import SO_FAR, UNFINISHED
from ..results.solids.state import SolidSnapshot, drawn_state
from ..results.vtu import write_vtu
from ..specimens.files import given
from . import kept_packing

#: Picture of the outside of a solid.
OUTSIDE = "outside.png"
#: Names of the files of a test.
FILES = (
    SO_FAR,
    *("result.json", "curve.csv", "cracks.csv", "events.csv", "fragments.csv"),
    *("final.vtu", given.FILE, kept_packing.FILE),
    *("curve.png", "cracks.png", "events.png", "fragments.png"),
    REPORT,
    OUTSIDE,
)


def write_files(folder: Path, result: Result) -> None:
    """Write numbers, record, cracks, final state and pictures of a result into `folder`.

    Args:
        folder: It exists.
        result: The result.
    """
    write_numbers(folder, result)
    draw_pictures(folder, result)


def write_so_far(folder: Path, result: Result) -> None:
    """Write numbers, record and cracks of a run that has not ended into `folder`, which exists.

    The numbers are written to unfinished.json: a folder without result.json has an unfinished run.
    """
    result.status = UNFINISHED
    result.write(folder, SO_FAR)


def write_numbers(folder: Path, result: Result) -> None:
    """Write numbers, record, cracks and final state of a result into `folder`, which exists."""
    result.write(folder)
    if (folder / SO_FAR).is_file():
        for name in (REPORT, SO_FAR):  # a page that was made before the end
            remove_earlier(folder / name)
    if result.snapshot is not None:
        write_vtu(folder / "final.vtu", result.snapshot, about(result.inputs))


def draw_pictures(folder: Path, result: Result) -> None:
    """Draw the pictures of a result into `folder`; arguments as for `write_files`."""
    kind, curve = kind_of(result.test), folder / "curve.png"
    if kind is OWN and not len(result.curve):  # a script need not drive anything
        remove_earlier(curve)
    else:
        (wave_picture if kind.rig is Rig.WAVE else curve_picture)(curve, result)
    if isinstance(result.snapshot, SolidSnapshot):
        draw_solid(folder / OUTSIDE, result.snapshot, size_text(result))
    if result.snapshot is not None:
        plane = drawn_state(result.snapshot)
        assert plane is not None
        minerals = [kind["name"] for kind in result.material.get("minerals", ())]
        caption = size_text(result)
        broken = result.cracks_by_pair
        parts = (result.inputs or {}).get("parts", ())
        notches = result.notches
        picture = folder / "cracks.png"
        crack_picture(picture, plane, caption, minerals, notches, broken, parts)
        fragment_picture(folder / "fragments.png", plane, caption, result.snapshot.fragments)
        emission_picture(folder / "events.png", result, caption)


def about(inputs: Table | None) -> Table:
    """Return the description of a run for a ParaView file."""
    if inputs is None:
        return {}
    specimen, material = inputs["specimen"], inputs["material"]
    about = {name: inputs[name] for name in ("test", "model", "confinement")}
    if inputs.get("second_confinement") is not None:
        about["second_confinement"] = inputs["second_confinement"]
    if specimen.get("joint_names"):
        about["joints"] = ", ".join(specimen["joint_names"])
    return {**about, "material": material["name"], "seed": specimen["seed"], "flexpm": __version__}
