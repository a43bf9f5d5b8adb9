# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the schema of result.json that no class of the package describes: nested tables."""

from __future__ import annotations

from typing import Any

from flexpm.results.joint_states import MEASURES

Entry = dict[str, Any]


def entry(kind: str | list[str], words: str = "", **rules: object) -> Entry:
    """Return the entry of a key with its type, its description and further rules."""
    return {"type": kind, **({"description": words} if words else {}), **rules}


def reference(name: str, words: str = "") -> Entry:
    """Return the entry of a key that is a table of the schema's definitions."""
    return {"$ref": f"#/$defs/{name}"} | ({"description": words} if words else {})


def table(properties: dict[str, Entry], words: str = "", closed: bool = True) -> Entry:
    """Return a table that must have all of these keys, and no other one if it is closed."""
    rules: Entry = {"properties": properties, "required": [*properties]}
    return entry("object", words, **rules, **({"additionalProperties": False} if closed else {}))


def named(value: Entry, words: str = "") -> Entry:
    """Return a table whose keys are names given by users, or null."""
    return entry(["object", "null"], words, additionalProperties=value)


def rows(value: Entry, words: str = "") -> Entry:
    """Return a list of tables."""
    return entry("array", words, items=value)


def needed(name: str, *others: str) -> Entry:
    """Return a table of which only some keys are fixed."""
    return entry("object", required=[name, *others])


SPECIMEN = {"oneOf": [reference("specimen"), reference("solid")]}

JOINT_CUT = table(
    {
        "lines": entry("integer", "Lines that were asked for", minimum=0),
        "idle": entry("integer", "Of these, the ones that cut nothing", minimum=0),
        "length": entry("number", "Of all lines as they were asked for [m]", minimum=0),
        "cut": entry("number", "Where they have made contacts of the joint [m]", minimum=0),
        "taken": entry(
            "number", "Where they lie on contacts that a joint had before [m]", minimum=0
        ),
        "outside": entry("number", "Outside of the specimen [m]", minimum=0),
        "on": entry(["string", "null"], "The joint on which most of taken lies"),
        "reason": entry("string", "Why not more of it is cut"),
    }
)

POLES = {
    **dict.fromkeys(("p10_x", "p10_y", "p10_z"), entry("number", "Planes per length [1/m]")),
    "planes": entry("integer", "Planes in the specimen", minimum=0),
    "dip": entry("number", "Of the mean plane [degrees]"),
    "dip_direction": entry("number", "Of the mean plane [degrees]"),
    "concentration": entry(["number", "null"], "Estimate of Fisher's concentration [-]"),
}
#: Intensities of a set, then their old names.
INTENSITIES = ("target", "generated", "cut", "asked", "drawn")

JOINT_STATE = {
    **table(
        {
            "length": entry(
                "number", "Of the contacts of the joint before the test, in 2D [m]", minimum=0
            ),
            "area": entry(
                "number", "Of the contacts of the joint before the test, in 3D [m2]", minimum=0
            ),
            **{key: entry(["number", "null"], words) for key, words in MEASURES.items()},
        }
    ),
    "required": [*MEASURES],
}

CALL = needed("call", "with") | {
    "properties": {
        "call": entry("string", "Name of the method"),
        "with": entry("object", "Its arguments by name; parts of the rig by kind and number"),
        "over": entry("boolean", "Whether it has ended"),
        "raised": entry(
            "array",
            "Class and text of the error by which it ended, and the stages begun by then",
        ),
    }
}

OWN_INPUTS = needed(
    *("test", "schema", "repeatable", "model", "specimen", "material", "rate", "stages", "doubts")
) | {
    "description": "What a script's own test was; with a folder of its own (out=) also its calls",
    "properties": {
        "test": {"const": "own"},
        "schema": {
            "const": 1,
            "description": "Number of the way in which these inputs are written",
        },
        "repeatable": entry(
            "boolean", "Whether flexpm rerun makes it again from its calls; false of rig.save()"
        ),
        "reason": entry("string", "Why it is not repeatable, else empty"),
        "calls": rows(CALL, "What the script asked of its rig, in order: first the rig itself"),
        "model": {"description": "Name of the model"},
        "specimen": SPECIMEN,
        "material": reference("material"),
        "rate": entry("number", "Of the last loading, factor on the default loading rate [-]"),
        "ends": entry(
            "object", "Of flexpm.rig: the test with the same ends, and whether they pull"
        ),
        "parts": rows(
            needed("part", "position", "place"),
            "Of flexpm.PartRig: plates, then held nodes, by their numbers; place is the old name "
            "of position, removed in 0.4",
        ),
        "drive": entry(
            "object", "Which parts load and hold; area [m2] and length [m] of stress and strain"
        ),
        "gauges": rows(needed("gauge", "direction")),
        "stages": rows(
            needed("stage"),
            "What was done, in order, with the steps at both ends; crossings is the old name of "
            "transits, removed in 0.4",
        ),
        "doubts": rows(entry("string"), "Warnings of the rig, see rig.warnings"),
    },
}

LOADING = table(
    {
        "rate": entry("number", "Factor on the loading rate [-]"),
        "status": {},
        "peak_stress": entry(["number", "null"], "[Pa]"),
        "steps": entry("integer", "Steps of the loading, without settling"),
        "seconds": entry("number", "Wall time of these steps at the median pace [s]"),
    }
)

MATERIAL = {
    "description": "Name and the parameters in effect for the model, SI units",
    "properties": {
        "name": entry("string"),
        "made_for": entry(
            "object",
            "Specimens and model of the material's calibration; missing if unknown",
            properties={
                "dimension": {"enum": ["2D", "3D"]},
                "model": entry("string"),
                "mean_diameter": entry("number", "Mean diameter of the grains [m]"),
            },
            required=["dimension", "model"],
            additionalProperties=False,
        ),
        "minerals": rows(reference("mineral")),
        "interfaces": rows(reference("interface")),
        "joints": rows(reference("joint")),
    },
    "required": ["name"],
}

MINERAL = {
    "properties": {
        "name": entry("string"),
        "fraction": entry("number", "Share of the area that was asked for [-]"),
        "area_fraction": entry("number", "Share of the area that it has got [-]"),
        "volume_fraction": entry("number", "Share of the volume of a solid that it has got [-]"),
    },
    "required": ["name", "fraction"],
}

JOINT = {
    "description": "Law of the contacts along a joint",
    "properties": {
        "open": entry("boolean", "A notch"),
        "dilation_angle": entry(
            ["number", "null"], "Angle by which plastic slip opens the joint [degrees]"
        ),
        "dilation_slip": entry(["number", "null"], "Plastic slip up to which it does [m]"),
        "residual_friction": entry(
            ["number", "null"], "Friction after a slip of slip_length since the crack [-]"
        ),
        "slip_length": entry(["number", "null"], "Slip since the crack until then [m]"),
    },
}

INTERFACE = {
    "properties": {
        "pair": entry(
            "array",
            "Names of two minerals, or of one twice",
            items=entry("string"),
            minItems=2,
            maxItems=2,
        )
    }
}

NETWORK = table(
    {
        "seed": entry("integer"),
        "set": entry(
            "object",
            additionalProperties=table(
                {
                    "intensity": entry("number"),
                    "length": entry("object"),
                    "orientation": entry("object"),
                }
            ),
        ),
    }
)

#: Joined with the keys that classes have; a key here replaces or adds to the one of the class.
TABLES: Entry = {
    "description": "Numbers of one test and all that determined it, in SI units; null where a "
    "quantity is not defined or was not reached",
    "properties": {
        "null_reasons": named(entry("string")),
        "ended_by": {"enum": ["drop", "plateau", "largest_strain", "equilibrium", None]},
        "cracks_by_pair": named(
            table({"tensile": entry("integer"), "shear": entry("integer")}),
            "Cracked points by mode of each pair of minerals that has any, names with a slash "
            "between; null if all grains are alike or nothing has cracked",
        ),
        "joint_cuts": named(
            {"oneOf": [reference("joint_cut"), reference("planes_cut")]},
            "What came of the lines, in 3D planes of each joint, by its name",
        ),
        "joint_states": named(reference("joint_state"), "State of each joint at the end, by name"),
        "networks": named(
            {"oneOf": [reference("traces"), reference("poles")]},
            "P21, in 3D P32 requested, generated and cut of each set, by its joint [1/m]; asked "
            "and drawn are old names of target and generated, removed in 0.4",
        ),
        "rates": entry(
            ["array", "null"],
            "Loadings of a test whose rate is halved, the fastest first",
            items=reference("loading"),
        ),
        "inputs": {"oneOf": [reference("run_spec"), reference("own_inputs")]},
        "material": reference("material"),
        "warnings": {"description": "What makes the numbers doubtful, one line each"},
    },
    "$defs": {
        "run_spec": {"properties": {"specimen": SPECIMEN, "material": reference("material")}},
        "specimen": {"properties": {"networks": {"items": NETWORK}, "joint_origin": {}}},
        "material": MATERIAL,
        "mineral": MINERAL,
        "joint": JOINT,
        "interface": INTERFACE,
        "joint_cut": JOINT_CUT,
        "joint_state": JOINT_STATE,
        "traces": table({name: entry("number") for name in INTENSITIES}),
        "poles": table({name: entry(["number", "null"]) for name in INTENSITIES} | POLES)
        | {"required": [*INTENSITIES, "p10_x", "p10_y", "p10_z", "planes"]},
        "own_inputs": OWN_INPUTS,
        "loading": LOADING,
    },
}
