# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls that users write, for scripts/checks/types alone: wrong keywords must not pass.

A line below that passes is reported, as its comment ignores no error then.
"""

import flexpm


def wrong(specimen: flexpm.Specimen) -> None:
    """Calls with a keyword that does not exist or a value of another type."""
    flexpm.run("biaxial", specimen, confinment=1e6)  # type: ignore[call-arg]
    flexpm.run("biaxial", specimen, confinement="1 MPa")  # type: ignore[arg-type]
    flexpm.compare("tension", specimen, spam=1)  # type: ignore[call-arg]


def right(specimen: flexpm.Specimen) -> None:
    """Calls that pass."""
    flexpm.run("biaxial", specimen, confinement=1e6, rate="auto", points=1, frames=10)
    flexpm.compare("tension", specimen, rate=2.0, stop_ratio=None)
