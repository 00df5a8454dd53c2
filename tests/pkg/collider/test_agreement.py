"""The same scene with YADE's collider and with ours: bit-identical where the order of summation
cannot matter, the same sets of contacts where it can."""
import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, setEngines
import yade.wrapper as w
from yade import geom, utils
from yade.minieigenHP import Vector3


def run(make, build, steps, every=1, **attributes):
    """(history of real pairs with their overlap, final positions)."""
    scenes.clear()
    more = build(np.random.default_rng(4)) or {}
    setEngines(make(**attributes), **more)
    history = []
    for k in range(steps):
        O.step()
        if k % every == 0:
            history.append({(i.id1, i.id2): i.geom.penetrationDepth for i in O.interactions})
    return history, scenes.positions()


def separatePairs(rng):
    """Two-body collisions far from one another: every force is one term."""
    O.dt = 1e-4
    for k in range(60):
        home = np.array([k % 8, k // 8, 0]) * 10.
        aim = rng.normal(size=3)
        aim /= np.linalg.norm(aim)
        miss = rng.normal(size=3) * .2
        addSpheres([home, home + 2.2 * aim + miss], [1, 1], [40 * aim, -40 * aim], dynamic=True)


def sphereOnFloor(rng):
    """Spheres dropped one by one on a facet floor, walls and a box: one contact each."""
    O.dt = 1e-4
    O.bodies.append([utils.facet([(-99, -99, 0), (99, -99, 0), (0, 99, 0)]),
                     utils.box((30, 0, 0), (5, 5, .5), fixed=True), utils.wall(-.5, axis=2)])
    centres = [(x, y, 1.05) for x in range(-8, 9, 4) for y in range(-8, 9, 4)]
    centres += [(30 + x, y, 1.55) for x in (-3, 0, 3) for y in (-3, 0, 3)]
    addSpheres(centres, [1] * len(centres), [(0, 0, -20.)] * len(centres), dynamic=True)


@pytest.mark.parametrize('build', [separatePairs, sphereOnFloor], ids=lambda f: f.__name__)
def testContactsOfOneTerm(collider, build):
    expected, found = run(collider.rival, build, 300), run(collider, build, 300)
    assert expected[0] == found[0]
    assert (expected[1] == found[1]).all()
    assert max(map(len, expected[0])) > 20


def pile(rng):
    """A dense box of spheres under gravity, on a floor of facets."""
    O.dt = 1e-4
    O.bodies.append(geom.facetBox((.5, .5, .5), (.6, .6, .6)))
    grid = np.stack(np.meshgrid(*[np.arange(6)] * 3), -1).reshape(-1, 3) * .162 + .08
    addSpheres(grid + rng.normal(size=grid.shape) * .003, rng.uniform(.079, .083, len(grid)),
               dynamic=True)
    return dict(newton=w.NewtonIntegrator(gravity=(0, 0, -9.81), damping=.2))


@pytest.mark.parametrize('attributes', [{}, dict(verletDist=0), dict(verletDist=.02)], ids=str)
def testPile(collider, attributes):
    expected, found = run(collider.rival, pile, 400, 20), run(collider, pile, 400, 20, **attributes)
    assert max(map(len, expected[0])) > 200
    for a, b in zip(expected[0], found[0]):
        lost = {k for k in a if k not in b and a[k] > 1e-8}
        gained = {k for k in b if k not in a and b[k] > 1e-8}
        assert not lost and not gained
    assert np.allclose(expected[1], found[1], rtol=0, atol=1e-7)


def testSmallerIdFirst(collider):
    """Pairs of like bodies are made as (smaller, larger), which fixes the signs in every law."""
    rng = np.random.default_rng(6)
    addSpheres(rng.uniform(0, 1, (100, 3)), [.08] * 100)
    setEngines(collider())
    O.step()
    pairs = [(i.id1, i.id2) for i in O.interactions.all()]
    assert len(pairs) > 50 and all(a < b for a, b in pairs)
    assert len(set(pairs)) == len(pairs)


def testPotentialPairsCoverTheBoxes(collider):
    """trueHalo=False: every pair of boxes that overlap is an interaction, touching or not."""
    rng = np.random.default_rng(8)
    addSpheres(rng.uniform(0, 1, (150, 3)), rng.uniform(.02, .06, 150))
    O.bodies.append(utils.facet([(0, 0, .3), (1, 0, .4), (.3, 1, .5)]))
    O.bodies.append(utils.wall(.5, axis=1))
    setEngines(collider(verletDist=0, trueHalo=False))
    O.step()
    low = np.array([b.bound.min for b in O.bodies])
    high = np.array([b.bound.max for b in O.bodies])
    overlap = ((low[:, None] <= high[None]) & (high[:, None] >= low[None])).all(axis=2)
    expected = {(int(i), int(j)) for i, j in np.argwhere(overlap) if i < j}
    assert scenes.allPairs() == expected
    assert len(expected) > 100


def testFarAway(collider):
    """Two swarms and outliers that stretch the scene: nothing lost by a coarse grid."""
    rng = np.random.default_rng(10)
    centres = np.r_[rng.uniform(0, 1, (80, 3)), rng.uniform(0, 1, (80, 3)) + [1e7, 0, -1e7],
                    rng.normal(size=(10, 3)) * 1e9]
    addSpheres(centres, [.06] * 170, rng.normal(size=(170, 3)) * .01)
    O.dt = 1
    setEngines(collider())
    assert scenes.stepAndCheck(steps=20) > 100


def testVectorOfOneSlowOneFast(collider):
    """One projectile at a thousand times the speed of the rest."""
    rng = np.random.default_rng(12)
    addSpheres(rng.uniform(0, 1, (200, 3)), [.02] * 200, rng.normal(size=(200, 3)) * 1e-5)
    O.bodies[0].state.vel = Vector3(.03, .02, .01)
    O.bodies[0].state.pos = Vector3(-.2, -.1, 0)
    O.dt = 1
    setEngines(collider())
    scenes.stepAndCheck(steps=60)
