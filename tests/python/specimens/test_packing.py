# SPDX-License-Identifier: GPL-3.0-or-later
"""Packings: at rest, inside the outline, repeatable to the bit, no trace in the caller's scene."""

import os
import sys

import numpy as np
import pytest
from processes import captured, wait_for
from refusals import refusal

from flexpm import _flexpm
from flexpm.errors import InputError, SimulationError
from flexpm.specimens import packing
from flexpm.specimens.space.frame import SolidFrame
from flexpm.specimens.space.spec import SolidSpec
from flexpm.specimens.spec import SpecimenSpec
from flexpm.specimens.specimen import Specimen

UNIT = 3e-3


def radii_of(count, seed=1):
    return _flexpm.disc_radii(count, 2e-3, 4e-3, seed)


def overlaps(centres, radii):
    """Overlap of each pair, positive where discs overlap."""
    apart = np.hypot(*(centres[:, None] - centres[None]).transpose(2, 0, 1))
    depth = radii[:, None] + radii[None] - apart
    return depth[np.triu_indices(len(radii), 1)]


@pytest.mark.parametrize(
    "frame", [packing.Frame(width=0.024, height=0.03), packing.Frame(radius=0.015)]
)
def test_relaxation_spreads_the_overlap_and_keeps_discs_inside(frame):
    area = np.pi * frame.radius**2 if frame.radius else frame.width * frame.height
    count = _flexpm.disc_count(area, 2e-3, 4e-3, 0.10)
    centres, radii = packing.pack(frame, radii_of(count), UNIT, seed=5)
    outline = frame.kernel_outline()
    assert all(outline.contains(x, y) for x, y in centres)
    assert sorted(radii) == sorted(radii_of(count))
    depth = overlaps(centres, radii)
    # 90 % of the area in discs: denser than random close packing (84 %), so all share some overlap
    assert 0.0 < depth.max() < 0.25 * UNIT
    assert np.mean(depth > 0.0) * len(depth) > 1.5 * count


def test_forces_balance_at_rest():
    frame = packing.Frame(width=0.03, height=0.03)
    centres, radii = packing.pack(frame, radii_of(110), UNIT, seed=2)
    apart = centres[:, None] - centres[None]
    distance = np.hypot(apart[..., 0], apart[..., 1])
    np.fill_diagonal(distance, 1.0)
    depth = np.clip(radii[:, None] + radii[None] - distance, 0.0, None)
    np.fill_diagonal(depth, 0.0)
    forces = (0.5 * depth / distance)[..., None] * apart
    total = forces.sum(axis=1)
    total[:, 0] += np.clip(radii - centres[:, 0], 0, None)
    total[:, 0] -= np.clip(radii + centres[:, 0] - 0.03, 0, None)
    total[:, 1] += np.clip(radii - centres[:, 1], 0, None)
    total[:, 1] -= np.clip(radii + centres[:, 1] - 0.03, 0, None)
    mean_contact = 0.5 * depth[depth > 0.0].mean()
    assert np.hypot(*total.T).mean() < 0.03 * mean_contact


def test_a_seed_gives_the_same_bits_and_another_seed_does_not():
    frame = packing.Frame(width=0.02, height=0.02)
    first = packing.pack(frame, radii_of(50), UNIT, seed=7)
    again = packing.pack(frame, radii_of(50), UNIT, seed=7)
    other = packing.pack(frame, radii_of(50), UNIT, seed=8)
    assert np.array_equal(first[0], again[0])
    assert np.array_equal(first[1], again[1])
    assert not np.array_equal(first[0], other[0])


def test_the_unit_of_length_does_not_matter():
    small = packing.Frame(width=0.25, height=0.5)
    radii = _flexpm.disc_radii(60, 1 / 32, 1 / 16, 3)
    centres, _ = packing.pack(small, radii, 3 / 64, seed=1)
    large, _ = packing.pack(small.scaled(1024.0), radii * 1024.0, 48.0, seed=1)
    assert np.array_equal(large, centres * 1024.0)


@pytest.mark.parametrize(
    "frame", [packing.Frame(width=0.03, height=0.04), packing.Frame(radius=0.017)]
)
def test_disc_loop_gives_the_bits_of_yades_loop(frame, monkeypatch):
    from yade import wrapper

    class YadesLoop(wrapper.InteractionLoop):
        mirror = True

    area = np.pi * frame.radius**2 if frame.radius else frame.width * frame.height
    count = _flexpm.disc_count(area, 2e-3, 4e-3, 0.10)
    ours = packing.pack(frame, radii_of(count), UNIT, seed=3)
    monkeypatch.setattr(wrapper, "DiscLoop", YadesLoop)
    theirs = packing.pack(frame, radii_of(count), UNIT, seed=3)
    assert np.array_equal(ours[0], theirs[0])
    assert np.array_equal(ours[1], theirs[1])


@pytest.mark.parametrize(
    ("kind", "sizes"), [("box", (0.012, 0.01, 0.015)), ("cylinder", (0.014, 0.012))]
)
def test_disc_loop_gives_the_bits_of_yades_loop_in_space(kind, sizes, monkeypatch):
    from yade import wrapper

    class YadesLoop(wrapper.InteractionLoop):
        mirror = True

    frame = SolidFrame(kind, sizes, UNIT)
    count = _flexpm.sphere_count(frame.solid().volume, 2e-3, 4e-3, 0.10)
    ours = packing.pack(frame, radii_of(count), UNIT, seed=3)
    assert ours[0].shape == (count, 3)
    assert all(frame.has_inside(place) for place in ours[0])
    monkeypatch.setattr(wrapper, "DiscLoop", YadesLoop)
    theirs = packing.pack(frame, radii_of(count), UNIT, seed=3)
    assert np.array_equal(ours[0], theirs[0])
    assert np.array_equal(ours[1], theirs[1])


def test_disc_loop_mirrors_forces_when_told():
    from yade import wrapper

    class YadesLoop(wrapper.InteractionLoop):
        mirror = True

    def forces(kind, mirror):
        frame, radii = packing.Frame(width=8.0, height=8.0), np.full(70, 0.5)
        centres = _flexpm.insert_discs(radii, frame.kernel_outline(), 0.5, 1)
        with packing._private_scene(scene), pytest.MonkeyPatch.context() as patch:
            patch.setattr(wrapper, "DiscLoop", kind)
            packing._fill_scene(scene, frame, centres, radii).mirror = mirror
            scene.dt = 0.1
            packing._advance(scene, 20)
            return {
                (contact.id1, contact.id2): tuple(contact.phys.normalForce)
                for contact in scene.interactions
                if contact.isReal
            }

    scene = wrapper.Omega()
    ours = forces(wrapper.DiscLoop, True)
    assert len(ours) > 70
    assert ours == forces(YadesLoop, True)
    assert ours != forces(wrapper.DiscLoop, False)


def test_disc_loop_leaves_shear_and_erased_bodies_to_the_functors():
    from yade import utils, wrapper

    def forces(kind):
        with packing._private_scene(scene):
            stiff = scene.materials.append(wrapper.FrictMat(young=1.0, poisson=0.3))
            places = ((0.0, 0.0), (0.9, 0.1), (0.2, 0.9), (-0.9, 0.2))
            for x, y in places:
                body = utils.sphere((x, y, 0.0), 0.5, material=stiff)
                body.state.blockedDOFs, body.state.mass = "zXY", 1.0
                body.state.inertia = (1.0, 1.0, 1.0)
                scene.bodies.append(body)
            scene.bodies[0].state.vel = (0.0, 0.1, 0.0)
            loop = kind(
                [wrapper.Ig2_Sphere_Sphere_ScGeom()],
                [wrapper.Ip2_FrictMat_FrictMat_FrictPhys()],
                [wrapper.Law2_ScGeom_FrictPhys_CundallStrack()],
            )
            collider = wrapper.InsertionSortCollider([wrapper.Bo1_Sphere_Aabb()], verletDist=0.1)
            newton = wrapper.NewtonIntegrator()
            scene.engines = [wrapper.ForceResetter(), collider, loop, newton]
            scene.dt = 0.05
            packing._advance(scene, 10)
            scene.interactions.erase(0, 1)
            packing._advance(scene, 10)
            scene.bodies.erase(3)
            packing._advance(scene, 10)
            return [tuple(scene.forces.f(k)) + tuple(scene.forces.t(k)) for k in range(3)]

    scene = wrapper.Omega()
    ours = forces(wrapper.DiscLoop)
    assert max(abs(force[5]) for force in ours) > 0.0
    assert ours == forces(wrapper.InteractionLoop)


@pytest.mark.long
def test_threads_do_not_matter(package_parent):
    code = (
        "import hashlib; from flexpm import _flexpm;"
        "from flexpm.specimens import packing as p;"
        "r = _flexpm.disc_radii(60, 2e-3, 4e-3, 1);"
        "c, _ = p.pack(p.Frame(width=0.02, height=0.025), r, 3e-3, 4);"
        "print(hashlib.sha256(c.tobytes()).hexdigest())"
    )
    prints = set()
    for threads in ("1", "2"):
        environment = dict(os.environ, OMP_NUM_THREADS=threads, PYTHONPATH=str(package_parent))
        run = captured([sys.executable, "-c", code], env=environment, check=True)
        prints.add(run.stdout.strip())
    assert len(prints) == 1


def test_the_callers_scene_is_not_touched():
    from yade import utils, wrapper

    scene = wrapper.Omega()
    scene.bodies.append(utils.sphere((1, 2, 3), 0.5))
    scene.engines = [wrapper.ForceResetter()]
    scene.dt = 0.125
    scene.step()
    number, tag = scene.thisScene, scene.tags["id"]
    packing.pack(packing.Frame(width=0.02, height=0.02), radii_of(40), UNIT, seed=1)
    assert (scene.thisScene, scene.tags["id"]) == (number, tag)
    assert (len(scene.bodies), len(scene.engines), scene.dt, scene.iter) == (1, 1, 0.125, 1)
    assert scene.bodies[0].shape.radius == 0.5


def test_scenes_do_not_pile_up_and_a_reset_does_no_harm(capfd):
    from yade import wrapper

    scene = wrapper.Omega()
    frame = packing.Frame(width=0.02, height=0.02)
    packing.pack(frame, radii_of(40), UNIT, seed=1)
    before = scene.addScene()
    packing.pack(frame, radii_of(40), UNIT, seed=1)
    assert scene.addScene() == before + 1
    scene.reset()
    packing.pack(frame, radii_of(40), UNIT, seed=1)
    assert scene.thisScene == 0
    text = capfd.readouterr()
    assert "ERROR" not in text.out + text.err


def test_a_scene_of_the_caller_in_the_old_place_is_not_used():
    from yade import utils, wrapper

    scene = wrapper.Omega()
    frame = packing.Frame(width=0.02, height=0.02)
    packing.pack(frame, radii_of(40), UNIT, seed=1)
    scene.reset()
    own = scene.addScene()
    scene.switchToScene(own)
    scene.bodies.append(utils.sphere((0, 0, 0), 1))
    scene.switchToScene(0)
    packing.pack(frame, radii_of(40), UNIT, seed=1)
    scene.switchToScene(own)
    assert len(scene.bodies) == 1


def test_an_error_returns_to_the_callers_scene():
    from yade import wrapper

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        packing.pack(packing.Frame(width=0.02, height=0.02), radii_of(40), UNIT, 1, stop)
    assert wrapper.Omega().thisScene == 0


def test_progress_is_reported():
    seen = []
    frame = packing.Frame(width=0.02, height=0.02)
    packing.pack(frame, radii_of(40), UNIT, 1, lambda *call: seen.append(call))
    done = [call[0] for call in seen]
    assert done == sorted(done)
    assert all(0 < steps <= expected and text == "packing" for steps, expected, text in seen)


def test_a_packing_in_a_running_simulation_is_refused():
    from yade import wrapper

    scene = wrapper.Omega()
    scene.engines = [wrapper.ForceResetter()]
    scene.run()
    # YADE crashes if a scene goes before the thread of its run has begun
    wait_for(lambda: scene.iter)
    try:
        with pytest.raises(SimulationError, match=r"O\.pause"):
            packing.pack(packing.Frame(width=0.02, height=0.02), radii_of(40), UNIT, 1)
    finally:
        scene.pause()


def test_discs_that_cannot_be_inserted_are_refused():
    with pytest.raises((InputError, ValueError), match="must fit into the outline"):
        packing.pack(packing.Frame(width=0.004, height=0.004), radii_of(40), UNIT, 1)


def test_spatial_order_keeps_neighbours_close():
    points = np.random.RandomState(0).rand(400, 2) * 20.0
    order = packing.spatial_order(points, 2.5)
    assert sorted(order) == list(range(400))
    steps = np.hypot(*np.diff(points[order], axis=0).T)
    assert steps.mean() < 2.5


@pytest.mark.parametrize(
    "make",
    [
        lambda: Specimen.rectangle(1e4, 1e4, 0.08),
        lambda: Specimen.disc(1e4, 0.08),
        lambda: Specimen.half_disc(1e5, 0.08),
        lambda: Specimen.polygon([(0, 0), (1e4, 0), (1e4, 1e4), (5e3, 2e4)], 0.08),
        lambda: Specimen.box(10.0, 10.0, 10.0),
        lambda: Specimen.cylinder(10.0, 20.0),
        lambda: Specimen.solid_disc(10.0, 10.0),
        lambda: Specimen.solid_half_disc(10.0, 10.0),
    ],
)
def test_all_shapes_are_asked_for_their_memory_before_they_are_packed(monkeypatch, make):
    monkeypatch.setattr(packing, "pack", lambda *_: 1 / 0)  # nothing is packed
    refusal(r"grains = .*, need .* GB of memory, must be at most", make)


def test_a_spec_of_a_larger_machine_can_be_read():
    """Only who packs needs the memory."""
    assert SpecimenSpec("rectangle", width=1e4, height=1e4).sizes["width"] == 1e4
    assert SolidSpec("box", 10.0, 10.0, 10.0).volume == pytest.approx(1e3)
