"""Bodies other than spheres: the real contacts that YADE's collider has when it runs every step. Other shapes, and those of
facets and boxes at random places: test_every_shape.py, test_funnel.py."""
import math

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, setEngines
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Vector3

kSteps = 30


def realAtEachStep(makeCollider, build, steps=kSteps, **attributes):
    """[set of real pairs] per step, of the scene that `build(rng)` makes."""
    scenes.clear()
    O.dt = 1
    more = build(np.random.default_rng(1)) or {}
    functors = more.pop('functors', None)
    setEngines(makeCollider(functors, **attributes), *more.pop('engines', ()), **more)
    history = []
    for _ in range(steps):
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
    addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.5, 1, n) * radius,
               rng.normal(size=(n, 3)) * speed)


def flatFacets(rng):
    """Boxes of no thickness, all in one plane, on the border of one another."""
    flying(rng)
    for x in np.arange(0, 1, .25):
        for y in np.arange(0, 1, .25):
            O.bodies.append(utils.facet([(x, y, .5), (x + .25, y, .5), (x, y + .25, .5)]))


def walls(rng):
    flying(rng)
    for axis in range(3):
        for sense in (-1, 0, 1):
            O.bodies.append(utils.wall(float(rng.uniform(0, 1)), axis=axis, sense=sense))


def wallsOnly(rng):
    """Nothing but walls and one sphere: no finite extent to build a grid on."""
    for axis in range(3):
        O.bodies.append(utils.wall(.1, axis=axis))
    addSpheres([(0, 0, 0)], [.05], [(.013, .0131, .0132)])


def hugeFloor(rng):
    flying(rng)
    O.bodies.append(utils.box((0, 0, .5), (1e6, 1e6, .01), fixed=True))
    O.bodies.append(utils.facet([(-1e7, -1e7, .2), (1e7, -1e7, .2), (0, 1e7, .2)]))


def movingWalls(rng):
    """Walls, boxes and facets that fly through spheres at rest."""
    addSpheres(rng.uniform(0, 1, (80, 3)), [.04] * 80)
    bodies = [utils.wall(0., axis=0), utils.box((.5, .5, -.1), (.3, .3, .02)),
              utils.facet([(0, -.1, 0), (1, -.1, 0), (.5, -.1, 1)])]
    O.bodies.append(bodies)
    for body, v in zip(bodies, ((.05, 0, 0), (0, 0, .04), (0, .06, 0))):
        body.state.blockedDOFs = 'xyzXYZ'
        body.state.vel = Vector3(*v)


@pytest.mark.parametrize('build', [flatFacets, walls, hugeFloor, movingWalls],
                         ids=lambda f: f.__name__)
@pytest.mark.parametrize('verletDist', [-.5, 0, .1])
def testShapes(collider, build, verletDist):
    sameContacts(collider, build, verletDist=verletDist)


def testWallsOnly(collider):
    sameContacts(collider, wallsOnly, atLeast=1, verletDist=0)


def testWallsDoNotMeetEachOther(collider):
    """Bounds with infinite extents overlap, and may be interactions, but harm nothing."""
    wallsOnly(None)
    setEngines(collider())
    for _ in range(5):
        O.step()
    assert all(math.isfinite(x) for x in O.bodies[3].state.pos)


@pytest.mark.rivalFails('its strides see only positions, not rotation')
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
