"""The same scene with YADE's collider and with ours: bit-identical where the order of summation cannot matter (where it
can: test_lifecycle.py). Bodies other than spheres: the real contacts that YADE's collider has when it runs every
step."""
import numpy as np
import pytest
import yade.wrapper as w
from yade import utils

import scenes
from scenes import addSpheres, O, setEngines


def run(make, build):
    """(history of real pairs with their overlap, final positions) of 300 steps."""
    scenes.clear()
    build(np.random.default_rng(4))
    setEngines(make())
    history = []
    for _ in range(300):
        O.step()
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
    expected, found = run(collider.rival, build), run(collider, build)
    assert expected[0] == found[0]
    assert (expected[1] == found[1]).all()
    assert max(map(len, expected[0])) > 20


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


# --- other shapes

kSteps = 30


def realAtEachStep(makeCollider, build, seed=1, **attributes):
    """[set of real pairs] per step, of the scene that `build(rng)` makes; ids are those of both runs."""
    scenes.clear()
    O.dt = 1
    more = build(np.random.default_rng(seed)) or {}
    setEngines(makeCollider(more.pop('functors', None), **attributes), *more.pop('engines', ()), **more)
    history = []
    for _ in range(kSteps):
        O.step()
        history.append(set(scenes.realPairs()))
    return history


def sameContacts(collider, build, atLeast=20, **attributes):
    expected = realAtEachStep(collider.rival, build, verletDist=0)
    found = realAtEachStep(collider, build, **attributes)
    for k, (a, b) in enumerate(zip(expected, found)):
        assert a == b, f'step {k}: missing {sorted(a - b)[:5]}, extra {sorted(b - a)[:5]}'
    assert len(set().union(*expected)) >= atLeast


def flying(rng, n=80, speed=.02, radius=.05):
    addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.5, 1, n) * radius, rng.normal(size=(n, 3)) * speed)


def flatFacets(rng):
    """Boxes of no thickness, all in one plane, on the border of one another."""
    flying(rng)
    for x in np.arange(0, 1, .25):
        for y in np.arange(0, 1, .25):
            O.bodies.append(utils.facet([(x, y, .5), (x + .25, y, .5), (x, y + .25, .5)]))


def wallsOnly(rng):
    """Nothing but walls and one sphere: no finite extent to build a grid on."""
    for axis in range(3):
        O.bodies.append(utils.wall(.1, axis=axis))
    addSpheres([(0, 0, 0)], [.05], [(.013, .0131, .0132)])


def hugeFloor(rng):
    flying(rng)
    O.bodies.append(utils.box((0, 0, .5), (1e6, 1e6, .01), fixed=True))
    O.bodies.append(utils.facet([(-1e7, -1e7, .2), (1e7, -1e7, .2), (0, 1e7, .2)]))


@pytest.mark.parametrize('build', [flatFacets, hugeFloor, wallsOnly], ids=lambda f: f.__name__)
@pytest.mark.parametrize('verletDist', [-.5, 0, .1])
def testShapes(collider, build, verletDist):
    sameContacts(collider, build, atLeast=1 if build is wallsOnly else 20, verletDist=verletDist)


@pytest.mark.parametrize('shape', ['facet', 'box'])
def testSpinningBody(collider, shape):
    """A body that turns about its own centre into a sphere at rest must be found."""
    if shape == 'facet':
        body = utils.facet([(-1, -.1, 0), (1, -.1, 0), (0, .2, 0)])
    else:
        body = utils.box((0, 0, 0), (1, .1, .02))
    O.bodies.append(body)
    body.state.blockedDOFs = 'xyzXYZ'
    addSpheres([(0, 0, .8), (0, 0, 5)], [.05, .05])
    O.dt = .01
    setEngines(collider(), w.RotationEngine(ids=[0], rotationAxis=(0, 1, 0), angularVelocity=1,
                                            rotateAroundZero=True, zeroPoint=body.state.pos))
    met = False
    for _ in range(200):
        O.step()
        met = met or (0, 1) in scenes.realPairs()
    assert met


@pytest.mark.parametrize('strides', [True, False])
def testMovedByAnotherEngine(collider, strides):
    """TranslationEngine pushes a facet and a box through spheres at rest."""
    def build(rng):
        addSpheres(rng.uniform(0, 1, (60, 3)), [.04] * 60)
        ids = O.bodies.append([utils.facet([(-.1, -1, 0), (-.1, 2, 0), (-.1, .5, 2)]),
                               utils.box((.5, .5, 1.2), (.5, .5, .01))])
        return dict(engines=[
            w.TranslationEngine(ids=[ids[0]], translationAxis=(1, 0, 0), velocity=.04),
            w.TranslationEngine(ids=[ids[1]], translationAxis=(0, 0, -1), velocity=.03)])
    sameContacts(collider, build, verletDist=-.5 if strides else 0)


def testMaskedIntegrator(collider):
    """Bodies that NewtonIntegrator.mask leaves out stay where they are and are still met."""
    def build(rng):
        flying(rng, 100)
        for body in O.bodies:
            body.mask = 1 + int(rng.integers(0, 2)) * 2
        return dict(newton=w.NewtonIntegrator(mask=2))
    sameContacts(collider, build)
