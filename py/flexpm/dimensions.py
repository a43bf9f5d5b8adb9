# SPDX-License-Identifier: GPL-3.0-or-later
"""Dimension of a shape, and the features that are available in 2D or in 3D only.

The table makes the refusals and the page "Available in 2D and 3D". Nothing heavy is loaded here.
"""

from __future__ import annotations

from dataclasses import dataclass

from .errors import InputError

#: Shapes of 3D specimens.
SOLIDS = ("box", "cylinder", "solid-disc", "solid-half-disc")


def is_solid(shape: object) -> bool:
    """Whether a shape is one of 3D specimens."""
    return shape in SOLIDS


@dataclass(frozen=True)
class Feature:
    """A feature that specimens of the other dimension do not have."""

    words: str  #: its name, a plural
    dimension: int  #: in which it is available
    asked: tuple[str, ...]  #: calls, arguments and options that ask for it
    instead: str  #: advice for a specimen of the other dimension

    @property
    def refusal(self) -> str:
        """The rule and the advice, for the end of a message."""
        return f"{self.words} are available in {self.dimension}D only; {self.instead}"


#: Features of one dimension; an option of ``flexpm run`` has its own name.
FEATURES = {
    "thickness": Feature(
        "thicknesses", 2, ("--thickness",), "leave it out, the sizes of a 3D specimen include it"
    ),
    "joint_maps": Feature(
        "maps of joints",
        2,
        ("Specimen.joints_from_geojson", "--joints with a .geojson file", "--name", "--origin"),
        "give planes, discs or polygons as a CSV file, or take a 2D specimen",
    ),
    "dfnworks": Feature(
        "polygons of dfnWorks",
        3,
        ("joints_from_dfnworks of a 3D specimen", "--joints with a .dat file", "--joint"),
        "give lines as a CSV file or a map, or take a 3D specimen",
    ),
    "removed_grains": Feature(
        "specimens without some of their grains",
        3,
        ("without_grains of a 3D specimen",),
        "erase grains after flexpm.build, or take a 3D specimen",
    ),
    "excavation": Feature(
        "excavations",
        2,
        ("Specimen.with_excavations", "Specimen.excavation", "PartRig.excavate"),
        "leave them out or take a 2D specimen",
    ),
    "strengths": Feature(
        "strengths of single contacts",
        2,
        ("Specimen.with_strengths", "Specimen.with_weibull_strengths"),
        "leave them out or take a 2D specimen; minerals of different strength, and a material with "
        "weibull, are available",
    ),
    "holes": Feature(
        "holes cut into a specimen",
        3,
        ("with_holes of a 3D specimen",),
        "give holes to Specimen.polygon, or take a 3D specimen",
    ),
    "points": Feature(
        "other numbers of contact points",
        2,
        ("points", "--points"),
        "leave it out, the contacts of a 3D specimen have their corners and an inner point",
    ),
    "mesh": Feature(
        "other meshes of the grains",
        2,
        ("mesh", "--mesh"),
        "leave it out, the grains of a 3D specimen are meshed as fans",
    ),
    "inner": Feature(
        "inner particles", 2, ("model inner", "model inner-un"), "take flexible or rigid grains"
    ),
    "end_friction": Feature(
        "rough ends",
        3,
        ("end_friction", "--end-friction"),
        "leave it out (ends are smooth), or place platens with flexpm.PartRig",
    ),
    "jaw_radius": Feature(
        "jaws of a named test",
        3,
        ("jaw_radius", "--jaw-radius"),
        "place jaws with flexpm.PartRig, or give a depth",
    ),
}


def refused(asked: str, name: str) -> InputError:
    """The error for a feature that the dimension of a specimen does not have.

    Args:
        asked: Call or quantity, its value and the rule that it breaks.
        name: Name of the feature.
    """
    return InputError(f"{asked}: {FEATURES[name].refusal}")
