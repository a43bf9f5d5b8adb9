# SPDX-License-Identifier: GPL-3.0-or-later
"""What scenes hold of flexpm changes its number with it, and all of flexpm's classes have it."""

import re

import pytest
import saved_state
import yade
from scenes import fresh

import flexpm
from flexpm import _plugin
from flexpm._flexpm import saved_state as number_here

#: Attributes of GrainSolver that scenes leave out.
NOT_SAVED = {"stepsToCome", "diverged", "stopReason"}


def test_what_scenes_hold_is_listed_with_its_number():
    """Else: raise assemblyVersion, then run tests/helpers/saved_state.py."""
    number, members = saved_state.listed()
    assert saved_state.members() == members
    assert saved_state.number() == number == number_here


def test_the_list_has_each_attribute_that_python_sees():
    listed = set(saved_state.listed()[1])
    for name in _plugin.load():
        made = getattr(yade.wrapper, name)()
        own = {line.split()[-1] for line in listed if line.startswith(f"{name}: ")}
        inherited = getattr(yade.wrapper, type(made).__bases__[0].__name__)().dict()
        assert set(made.dict()) - set(inherited) - NOT_SAVED <= own, name


@pytest.mark.parametrize("name", _plugin.load())
def test_a_scene_with_a_class_of_another_build_is_refused(tmp_path, name):
    file = tmp_path / "scene.xml"
    yade.O.reset()
    yade.O.miscParams = [getattr(yade.wrapper, name)()]
    yade.O.save(str(file), quiet=True)
    yade.O.load(str(file), quiet=True)
    found = re.subn(
        rf'(class_name="yade::{name}" [^>]*version=")(\d+)"',
        rf'\g<1>{number_here - 1}"',
        file.read_text(),
    )
    assert found[1] == 1
    file.write_text(found[0])
    told = (
        f"scene = {name} of state {number_here - 1}, must be {number_here}: another build of flexpm"
    )
    with pytest.raises(RuntimeError, match=f"{told} saved it; run it again, or load it with that"):
        yade.O.load(str(file), quiet=True)
    # what is left takes what comes
    fresh(flexpm.Specimen.rectangle(0.012, 0.016, 0.01, seed=1)).run(3)
