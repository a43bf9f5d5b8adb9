# SPDX-License-Identifier: GPL-3.0-or-later
"""No call from Python ends the process: an exception of one line says what is wrong."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from forks import Ending, Forks

#: A line of a message has these many characters at most.
_LONGEST = 400


@pytest.fixture(scope="module")
def forks(package_parent: Path) -> Iterator[Forks]:
    process = Forks(package_parent)
    yield process
    process.close()


def is_one_line(ending: Ending) -> bool:
    return ending.lines == 1 and 0 < len(ending.message) < _LONGEST


#: What ends in an exception, and a part of its message: quantity and value.
REFUSED = {
    # a solver without grains, in and out of the scene
    "wrapper.GrainSolver().gravity = (0, 0, 0)": "grains = 0",
    "O.engines = [wrapper.GrainSolver()]; O.step()": "grains = 0",
    "O.engines = [wrapper.GrainSolver()]; O.saveTmp(); O.loadTmp(); O.step()": "grains = 0",
    "wrapper.GrainSolver()()": "grains = 0",
    "pickle.loads(pickle.dumps(build().solver)).counts()": "grains = 0",
    "build(); O.engines = [wrapper.GrainSolver(), *O.engines]; O.step()": "grains = 0",
    "b = build(); O.engines = [*O.engines, wrapper.GrainSolver()]; b.run(3)": "grains = 0",
    "O.engines = [wrapper.AxialRecorder()]; O.step()": "no engine with grains",
    "O.engines = [wrapper.ConfinementController()]; O.step()": "no engine with grains",
    "O.engines = [wrapper.PlateController()]; O.step()": "no engine with grains",
    "O.engines = [wrapper.EndDisplacementController()]; O.step()": "no engine with grains",
    "O.engines = [wrapper.LoadingRateController()]; O.step()": "no engine with grains",
    # steps before all is done that flexpm.build does
    "O.engines = [assemble(cells())]; O.step()": "bodyIds = 0 bodies",
    "g = assemble(cells()); g.addToScene(); O.engines = [g]; O.step()": "masses = none",
    "build().solver.addToScene()": "bodyIds = 37 bodies",
    # arrays and options that do not fit, arrays that are looked at
    "v = build() and O.bodies[0].shape.velocities; O.engines[1].assemble("
    "cells(), [wrapper.GrainMat()])": "grains = 37",
    "flexpm._flexpm.grain_meshes(specimen.tessellation, centres[:3], radii[:3], 'fan')": "= 3",
    "assemble(cells(centres[:5], radii[:5]))": "discs of the cells = 5",
    "cells(centres[:5])": "radii = 37 values",
    "assemble(cells(radii=nan * radii))": "radius = nan m",
    "assemble(cells(), [None])": "material 0 = another class",
    "assemble(cells(mesh='fans'))": "mesh = fans",
    "assemble(cells(rigid='no'))": "rigid = of type str, must be True or False",
    "assemble(cells(points=2.5))": "points = of type float",
    "assemble(cells(points=4))": "points",
    "assemble(cells(minerals=radii))": "minerals = array of type d",
    "n = len(specimen.tessellation.shared_edges); assemble(cells(outer=np.ones(n, 'i4'), "
    "edge_normals=True, parent=np.full(37, 2**31 - 1, 'i4')))": "particle",
    "gauge = flexpm._flexpm.StrainGauge(0.0, 0.024, 0.002, [(99, 1.0)], [(0, 1.0)]); "
    "gauge.strains(centres, centres)": "grain of a strain gauge = 99",
    "gauge = flexpm._flexpm.StrainGauge(0.0, 0.024, 0.002, [(0, 1.0)], [(0, 1.0)]); "
    "gauge.strains(centres, centres[:3])": "displacements = 3",
    # scenes that have changed under a run
    "b = build(); O.bodies.clear(); b.run(300)": "grains in O.bodies = 0",
    "b = build(); O.bodies.clear(); O.bodies.append([utils.sphere((0, 0, 0), 1) for _ in "
    "range(99)]); b.run(300)": "grains in O.bodies = 0",
    "b = build(); O.reset(); b.run(1)": "solver in O.engines = none",
    "flexpm.run('uniaxial', specimen, rate=8.0, progress=lambda *_: O.reset())": "0 bodies",
    "flexpm.run('uniaxial', specimen, rate=8.0, progress=lambda *_: O.bodies.clear())": "0 bodies",
    "flexpm.run('uniaxial', specimen, rate=8.0, progress=lambda *_: O.step())": "progress: ",
    # threads
    "b = build(); b.solver.ompThreads = 2**31 - 1; b.run(2)": "ompThreads = 2147483647",
    "b = build(); b.solver.ompThreads = 0; b.run(2)": "ompThreads = 0",
    "b = build(); b.solver.ompThreads = -5; b.run(2)": "ompThreads = -5",
    # writes that would be without effect
    "b = build(); b.solver.damping = 5; b.run(1)": "damping = 5",
    "b = build(); b.solver.damping = -1; b.run(1)": "damping = -1",
    "b = build(); b.solver.damping = nan; b.run(1)": "damping = nan",
    "b = build(); b.solver.damping = 0.9; b.run(1)": "damping = 0.9",
    "b = build(); O.dt = 5; b.run(1)": "O.dt = 5 s",
    "b = build(); O.dt = 0; b.run(1)": "O.dt = 0 s",
    "b = build(); O.dt = nan; b.run(1)": "O.dt = nan s",
    "b = build(dynamic=True); O.dt *= 2; b.run(1)": "O.dt = ",
    "build().solver.sideNodes(99)": "side = 99",
    "build().solver.clearPressure(99)": "side = 99",
    "build().solver.holdSide(99, x=True)": "side = 99",
    "build().solver.addSidePlates(99)": "side = 99",
    "b = build(); b.add_engines(before=(wrapper.ConfinementController(sides=[99]),)); "
    "b.run(1)": "side = 99",
    "b = build(); b.add_engines(before=(wrapper.ConfinementController(sides=[-1]),)); "
    "b.run(1)": "side = -1",
    "b = build(); r = wrapper.ReleaseController(nodes=[2**31 - 1], forces=[(1, 0, 0)], part=1); "
    "b.add_engines(before=(r,)); b.run(1)": "node of outer forces = 2147483647",
    "b = build(); r = wrapper.ReleaseController(nodes=[0, 0], forces=[(1, 0, 0)], part=1); "
    "b.add_engines(before=(r,)); b.run(1)": "outer forces = 1, must be 2",
    "build().solver.wallForces([99])": "grain = 99",
    "build().solver.setMachine(0, 1.0)": "plate = 0",
    "b = build(); b.add_engines(after=(wrapper.AxialRecorder(stopRatio=nan),)); "
    "b.run(100)": "stop ratio = nan",
    "b = build(); b.add_engines(after=(wrapper.AxialRecorder(maxStrain=nan),)); "
    "b.run(100)": "largest strain = nan",
    "b = build(); disc = wrapper.DiscFrame(diameter=nan); "
    "b.add_engines(after=(wrapper.AxialRecorder(frame=disc),)); b.run(100)": "diameter = nan m",
    "build(); wrapper.AxialRecorder(frame=wrapper.TestFrame()).scales()": "frame = TestFrame",
    "build(); wrapper.AxialRecorder(frame=None).names": "frame = None",
    "build().solver.crossingSteps(-1.0)": "diameter = -1 m",
    "build(); disc = wrapper.DiscFrame(diameter=nan); "
    "wrapper.AxialRecorder(frame=disc).scales()": "diameter = nan m",
    "b = build(); O.bodies[0].material.young = 1.0; b.run(1)": "GrainMat.young = 1 Pa",
    "b = build(); O.bodies[0].material.friction = 1.0; b.run(1)": "GrainMat.friction = 1",
    "b = build(); O.bodies[0].material.planeStrain = True; b.run(1)": "GrainMat.planeStrain = 1",
    "build(); O.saveTmp(); O.loadTmp(); O.bodies[0].material.density = 1.0; O.step()": "density",
    "b = build(); O.bodies[3].material = wrapper.GrainMat(); b.run(101)": "O.bodies[3].material",
    "build() and O.bodies[0].shape.positions.fill(1)": "read-only",
    # engines of a test
    "build(); wrapper.EndDisplacementController().release()": "velocity of the preload = 0",
    "flexpm.build(disc); wrapper.EndDisplacementController().release()": "edges of side 1 = 0",
    "build(); wrapper.EndDisplacementController().preload(nan, 1)": "= nan",
    "b = build(); b.add_engines(before=(wrapper.PlateController(plates=[7]),)); "
    "b.run(1)": "plate = 7",
    "b = build(); b.add_engines(before=(wrapper.PressureController(plates=[7]),)); "
    "b.run(1)": "plate = 7",
    "build(); O.bodies[0].shape.setMotion((0, 0, 0), 0)": "grain = 0, is deformable",
    "build(); wrapper.LaguerreCell(grain=37).positions": "grain = 37",
    "build(); wrapper.LobattoPhys().opening": "contact = -1",
}


@pytest.mark.parametrize("snippet", REFUSED)
def test_what_cannot_be_done_is_refused_in_one_line(forks, snippet):
    ending = forks.run(snippet)
    assert ending.error not in ("", "exit"), ending
    assert REFUSED[snippet] in ending.message, ending
    assert is_one_line(ending), ending


@pytest.mark.parametrize(
    "snippet",
    [
        "b = wrapper.Body(); b.shape = wrapper.LaguerreCell(); O.bodies.append(b); O.engines = ["
        "wrapper.InsertionSortCollider([wrapper.Bo1_LaguerreCell_Aabb()], verletDist=0.1), "
        "wrapper.NewtonIntegrator()]; O.run(3, True)",
        "O.engines = [wrapper.DiscLoop()]; O.step()",
        # O.wait() loses an exception that comes before it, with engines of YADE too
        "O.engines = [wrapper.GrainSolver()]; O.run(10, False)",
        "b = build(); O.dt = 1.0; b.solver.damping = 0.5; b.run(1)",
        "b = build(dynamic=True); O.dt *= 0.5; b.run(1)",
        "b = build(); b.solver.damping = 0.9; b.solver.scaleMasses(); b.run(1)",
        "b = build(); O.dt = 2.0; b.solver.scaleMasses(); b.run(1)",
        "b = build(); v = O.bodies[0].shape.velocities; O.reset(); b = build(); v[:] = 1.0; "
        "b.run(200)",
        "b = build(); seen = [i.phys.opening for i in O.interactions]; pairs = [(i.id1, i.id2) for "
        "i in O.interactions]; [O.interactions.erase(*p) for p in pairs]; b.run(201); "
        "assert not sum(x.sum() for x in seen)",
    ],
)
def test_what_can_be_done_goes_on(forks, snippet):
    ending = forks.run(snippet)
    assert ending == Ending(signal=0), ending


#: A call with a value of each type that the signature in its documentation names; a list of
#: numbers is an object there.
CALLS = """
kinds = {"float": FLOAT, "int": INT, "bool": True, "Vector3": (FLOAT, FLOAT, 0.0), "object": None,
         "list": [], "dict": {}, "tuple": (), "str": "x"}
lists = {"nodes": [INT], "grains": [INT], "pressed": [INT], "pressures": [FLOAT],
         "floating": [INT]}
def arguments(method):
    signature = method.__doc__.split("->")[0].split("(", 1)[1]
    found = re.findall(r"\\((?:[\\w.]*[.])?(\\w+)\\)(\\w+)", signature)[1:]
    return [lists.get(name, kinds[kind]) for kind, name in found]
told = []
def look(thing, name):
    try:
        found = getattr(thing, name)
        if callable(found):
            found(*arguments(getattr(type(thing), name)))
    except Exception as error:
        text = str(error)
        assert text and "\\n" not in text and len(text) < 400, (name, type(error), text)
        told.append(name)
"""
EVERY_METHOD = """
for kind in flexpm._flexpm.register_classes():
    cls = getattr(wrapper, kind)
    for name in [n for n in vars(cls) if not n.startswith("_")]:
        look(cls(), name)
"""
#: A solver of its own has no grains: each of its methods says so.
ALL_REFUSED = """
methods = [n for n, m in vars(wrapper.GrainSolver).items() if callable(m) and n[0] != "_"]
assert len(methods) > 15 and not set(methods) - set(told), set(methods) - set(told)
"""


@pytest.mark.parametrize(("real", "whole"), [("0.0", "0"), ("nan", "-1"), ("1e308", "2**31 - 1")])
@pytest.mark.parametrize("scene", ["bare", "built", "reset"])
def test_every_method_of_every_class_returns_or_raises(forks, scene, real, whole):
    first = {"bare": "", "built": "b = build()", "reset": "b = build(); O.reset()"}[scene]
    calls = CALLS.replace("FLOAT", real).replace("INT", whole)
    ending = forks.run("\n".join((first, calls, EVERY_METHOD, ALL_REFUSED)))
    assert ending == Ending(signal=0), ending


ATTRIBUTES = """
def nonsense(value):
    if isinstance(value, bool): return [not value]
    if isinstance(value, int): return [-1, 0, 2**31 - 1]
    if isinstance(value, float): return [nan, -1.0, inf, 1e308]
    if isinstance(value, list): return [[], [-1], [2**31 - 1]]
    if type(value).__name__ == "Vector3": return [(nan, 0, 0), (1e308, 0, 0)]
    return [None]
cls = getattr(wrapper, KIND)
def present(thing, name):
    try:
        return getattr(thing, name)
    except RuntimeError:
        return print  # of grains, which it has not
for name in [n for n in vars(cls) if n[0] != "_" and not callable(present(cls(), n))]:
    for value in nonsense(getattr(cls(), name)):
        O.reset()
        b = build()
        b.solver.measurePeriod = 5
        engine = b.solver if KIND == "GrainSolver" else cls()
        try:
            setattr(engine, name, value)
        except (AttributeError, TypeError):
            continue  # read-only, or of a type of its own
        if engine is not b.solver:
            b.add_engines(before=(engine,))
        try:
            b.run(12)
        except Exception as error:
            text = str(error)
            assert text and "\\n" not in text and len(text) < 400, (name, value, text)
"""


@pytest.mark.parametrize(
    "kind",
    [
        *("GrainSolver", "AxialRecorder", "ConfinementController", "EndDisplacementController"),
        *("PlateController", "PressureController", "LoadingRateController", "ReleaseController"),
    ],
)
def test_no_value_of_an_attribute_ends_the_process(forks, kind):
    ending = forks.run(f"KIND = {kind!r}\n{ATTRIBUTES}")
    assert ending == Ending(signal=0), ending
